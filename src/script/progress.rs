//! How far a simulation is, for whoever shows it.

/// Something that shows how far a simulation is: a bar on a terminal, nothing in a pipe.
pub trait Progress {
    /// A simulation called `name` goes from time `from` to time `to`.
    fn begin(&self, name: &str, from: f64, to: f64);
    /// It has reached time `t`. Cheap enough to be told after every step.
    fn reach(&self, t: f64);
    /// It has stopped, at its end or before.
    fn end(&self);
    /// Lets `write` write to the terminal without mixing its text with what is shown.
    fn step_aside(&self, write: &mut dyn FnMut()) {
        write();
    }
}

/// Shows nothing.
pub struct NoProgress;

impl Progress for NoProgress {
    fn begin(&self, _name: &str, _from: f64, _to: f64) {}
    fn reach(&self, _t: f64) {}
    fn end(&self) {}
}
