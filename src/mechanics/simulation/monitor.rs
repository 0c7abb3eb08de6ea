//! Watching a run.

/// A monitor: what watches a run after every step, and may stop it.
pub trait Monitor {
    /// Asked after every step and every failed try of a run, with the present time; `false` stops the run there.
    fn goes_on(&mut self, time: f64) -> bool;
}

/// A monitor that never stops a run.
#[derive(Debug, Clone, Copy)]
pub struct NoMonitor;

impl Monitor for NoMonitor {
    fn goes_on(&mut self, _time: f64) -> bool {
        true
    }
}
