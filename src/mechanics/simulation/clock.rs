//! When the steps of a run end.

use super::TimeGrid;
use super::controller::StepSizeState;
use super::step_retry::StepRetry;

/// When the steps of a run end: its grid, and how far the present step and the present run have got.
#[derive(Debug, Clone)]
pub(super) struct StepClock {
    pub(super) grid: TimeGrid,
    /// How long the next step is to be, where steps vary in size.
    pub(super) pace: Option<StepSizeState>,
    /// The step of the grid that is covered in part, if there is one.
    pub(super) under_way: Option<StepRetry>,
    /// The time at which the present run ends; infinite for single steps [time].
    pub(super) goal: f64,
}

impl StepClock {
    /// The clock of a run at the start of its grid.
    pub(super) fn new(grid: TimeGrid, pace: Option<StepSizeState>) -> Self {
        Self { grid, pace, under_way: None, goal: f64::INFINITY }
    }

    /// The size that the next step has if nothing cuts it [time].
    pub(super) fn dt(&self) -> f64 {
        self.pace.map_or(self.grid.dt(), |pace| pace.wish)
    }
}
