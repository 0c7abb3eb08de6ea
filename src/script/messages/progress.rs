//! How far a simulation or a study is, for whoever shows it.

/// Something that shows how far a simulation or a study has got: a bar on a terminal, nothing in a pipe.
pub trait Progress {
    /// Begins to show that a simulation called `name` goes from time `from` to time `to`.
    fn begin(&self, name: &str, from: f64, to: f64);
    /// Shows that the simulation has reached time `t`. Cheap enough to be told after every step.
    fn reach(&self, t: f64);
    /// Begins to show that a study called `name` has `count` cases to work on.
    fn begin_cases(&self, name: &str, count: usize);
    /// Shows that `done` cases of the study are done. Cheap enough to be told many times a second.
    fn reach_case(&self, done: usize);
    /// Ends what is shown: the simulation or the study has stopped, at its end or before.
    fn end(&self);
    /// Lets `write` write to the terminal without mixing its text with the progress that is shown.
    fn step_aside(&self, write: &mut dyn FnMut()) {
        write();
    }
}

/// A progress that shows nothing.
pub struct NoProgress;

impl Progress for NoProgress {
    fn begin(&self, _name: &str, _from: f64, _to: f64) {}
    fn reach(&self, _t: f64) {}
    fn begin_cases(&self, _name: &str, _count: usize) {}
    fn reach_case(&self, _done: usize) {}
    fn end(&self) {}
}
