//! Monitors, which observe and may stop runs.

/// Observer of a run that may stop it.
pub trait Monitor {
    /// Receives the present time after every step and every failed attempt. Returns `false` to stop the run.
    fn continues(&mut self, time: f64) -> bool;
}

/// Monitor that never stops a run.
#[derive(Debug, Clone, Copy)]
pub struct NoMonitor;

impl Monitor for NoMonitor {
    fn continues(&mut self, _time: f64) -> bool {
        true
    }
}
