//! Progress reports of simulations and studies.

/// Display of the progress of a simulation or study: a bar on a terminal, nothing in a pipe.
pub trait Progress {
    /// Starts the progress of the simulation `name` from time `from` to time `to`.
    fn begin(&self, name: &str, from: f64, to: f64);
    /// Reports the current time `t`. It is cheap enough to be called at every step.
    fn report_time(&self, t: f64);
    /// Starts the progress of the study `name` with `count` cases.
    fn begin_cases(&self, name: &str, count: usize);
    /// Reports the number of finished cases. It is cheap enough for many calls per second.
    fn report_case(&self, done: usize);
    /// Ends the progress, whether or not the end was reached.
    fn end(&self);
    /// Calls `write`, which writes to the terminal, such that its text does not mix with the progress display.
    fn without_progress_bar(&self, write: &mut dyn FnMut()) {
        write();
    }
}

pub struct NoProgress;

impl Progress for NoProgress {
    fn begin(&self, _name: &str, _from: f64, _to: f64) {}
    fn report_time(&self, _t: f64) {}
    fn begin_cases(&self, _name: &str, _count: usize) {}
    fn report_case(&self, _done: usize) {}
    fn end(&self) {}
}
