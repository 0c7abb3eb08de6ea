//! End times of the steps of a run.

use super::TimeGrid;
use super::controller::StepSizeState;
use super::step_retry::StepRetry;

/// Time grid with the progress of the present step and run.
#[derive(Debug, Clone)]
pub(super) struct StepClock {
    pub(super) grid: TimeGrid,
    /// Size of the next step; only for variable steps.
    pub(super) step_size: Option<StepSizeState>,
    pub(super) retry: Option<StepRetry>,
    /// End time of the present run; infinite for single steps [time].
    pub(super) goal: f64,
}

impl StepClock {
    pub(super) fn new(grid: TimeGrid, step_size: Option<StepSizeState>) -> Self {
        Self { grid, step_size, retry: None, goal: f64::INFINITY }
    }

    /// Planned size of the next step [time].
    pub(super) fn dt(&self) -> f64 {
        self.step_size.map_or(self.grid.dt(), |state| state.unconstrained_size)
    }
}
