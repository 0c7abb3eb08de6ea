//! Progress reports of simulations and studies.

/// Display of the progress of a simulation or study: a bar on a terminal, and nothing in a pipe.
pub trait Progress {
    fn begin(&self, name: &str, from: f64, to: f64);
    /// Shows the present simulation time `t`. Implementations must be fast, because this function is called at every step.
    fn report_time(&self, t: f64);
    fn begin_cases(&self, name: &str, count: usize);
    /// Shows the number of completed cases. Implementations must be fast, because this function is called many times per second.
    fn report_case(&self, done: usize);
    fn end(&self);
    /// Calls `write`, which writes to the terminal, while the progress display is hidden.
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
