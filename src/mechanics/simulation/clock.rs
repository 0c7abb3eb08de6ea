//! Times at which the steps of a run end.

use super::TimeGrid;
use super::controller::StepSizeState;
use super::step_retry::StepRetry;

#[derive(Debug, Clone)]
pub(super) struct StepClock {
    pub(super) grid: TimeGrid,
    pub(super) step_size: Option<StepSizeState>,
    pub(super) retry: Option<StepRetry>,
    /// End time of the present run [time]; infinite for single steps.
    pub(super) goal: f64,
}

impl StepClock {
    pub(super) fn new(grid: TimeGrid, step_size: Option<StepSizeState>) -> Self {
        Self { grid, step_size, retry: None, goal: f64::INFINITY }
    }

    pub(super) fn dt(&self) -> f64 {
        self.step_size.map_or(self.grid.dt(), |state| state.unconstrained_size)
    }
}
