//! Which states of a run are recorded: a row in its history, a configuration in its trajectory.

use std::num::NonZeroUsize;

use serde::{Deserialize, Serialize};

use super::columns::extra_values;
use super::run::coordinates;
use super::{Sample, Simulation};

/// Which states of a run are recorded besides its start, the ends of its runs and the arrivals of sliders, which always are.
///
/// What is not recorded is not measured either. The present has a row as long as it is the present.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Recording {
    /// Those after every so many steps.
    Every(NonZeroUsize),
    /// No others.
    Nothing,
}

impl Default for Recording {
    fn default() -> Self {
        Self::Every(NonZeroUsize::MIN)
    }
}

impl Recording {
    /// Whether the state after so many steps is recorded.
    pub fn is_due(self, steps: usize) -> bool {
        match self {
            Self::Every(count) => steps.is_multiple_of(count.get()),
            Self::Nothing => false,
        }
    }

    /// Whether every step is recorded.
    pub fn is_complete(self) -> bool {
        self == Self::default()
    }

    /// In words: `every 100 steps`.
    pub fn describe(self) -> String {
        match self {
            Self::Every(count) if count == NonZeroUsize::MIN => "every step".to_owned(),
            Self::Every(count) => format!("every {count} steps"),
            Self::Nothing => "nothing between the ends of a run".to_owned(),
        }
    }

    /// Most rows that so many steps add.
    pub(super) fn rows_of(self, steps: usize) -> usize {
        match self {
            Self::Every(count) => steps / count.get() + 2,
            Self::Nothing => 2,
        }
    }
}

/// What the last step took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct StepTaken {
    /// The length of the step; zero before there is one [time].
    pub(super) dt: f64,
    pub(super) newton_iterations: usize,
    pub(super) retries: usize,
}

impl StepTaken {
    /// That of a row of the history.
    pub(super) fn of(row: &Sample) -> Self {
        Self { dt: row.dt, newton_iterations: row.newton_iterations, retries: row.retries }
    }
}

impl Simulation {
    /// Which states are recorded.
    pub fn recording(&self) -> Recording {
        self.recording
    }

    /// Changes which states are recorded, from here on.
    pub fn record(&mut self, recording: Recording) {
        self.recording = recording;
    }

    /// Whether the history has a row for every step.
    pub fn has_all_rows(&self) -> bool {
        self.history.samples().len() == self.counts.steps + 1
    }

    /// Whether the state that was just reached is to be recorded.
    pub(super) fn is_worth_a_row(&self) -> bool {
        self.recording.is_due(self.counts.steps) || self.has_reached(self.goal)
    }

    /// Gives the present a row that stays.
    pub(super) fn keep_row(&mut self) {
        self.add_row();
        self.rows_kept = self.history.samples().len();
    }

    /// Gives the present a row until it is past, unless it has one.
    pub(super) fn show_present(&mut self) {
        let last = self.history.samples().last().map(|row| row.measures.time);
        if last != Some(self.time()) {
            self.add_row();
        }
    }

    fn add_row(&mut self) {
        self.history.truncate(self.rows_kept);
        self.trajectory.go_back(self.rows_kept);
        let StepTaken { dt, newton_iterations, retries } = self.last_step;
        let sample = Sample { measures: self.model.measure(), dt, newton_iterations, retries };
        self.history.push(sample, extra_values(&self.model));
        self.trajectory.push(self.model.time(), coordinates(&self.model));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_due_and_how_much_that_is() {
        let every = |count| Recording::Every(NonZeroUsize::new(count).unwrap());
        assert!(Recording::default().is_due(7) && Recording::default().is_complete());
        assert!(every(3).is_due(6) && !every(3).is_due(7) && !every(3).is_complete());
        assert!(!Recording::Nothing.is_due(0) && !Recording::Nothing.is_complete());
        assert_eq!((every(3).rows_of(10), Recording::Nothing.rows_of(10)), (5, 2));
        assert_eq!(every(3).describe(), "every 3 steps");
        assert_eq!(Recording::default().describe(), "every step");
    }
}
