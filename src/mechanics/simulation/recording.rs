//! Which states of a run are recorded: a row in its history, a configuration in its trajectory.

use std::num::NonZeroUsize;

use serde::{Deserialize, Serialize};

/// Which states of a run are recorded besides its start, the ends of its runs and the arrivals of sliders, which always are.
///
/// What is not recorded is not measured either. The present has a row as long as it is the present.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Recording {
    /// The states after every so many steps are recorded.
    Every(NonZeroUsize),
    /// No states are recorded besides those that always are.
    Nothing,
}

impl Default for Recording {
    fn default() -> Self {
        Self::Every(NonZeroUsize::MIN)
    }
}

impl Recording {
    /// Whether the state after so many steps of a run is recorded.
    pub fn is_due(self, steps: usize) -> bool {
        match self {
            Self::Every(count) => steps.is_multiple_of(count.get()),
            Self::Nothing => false,
        }
    }

    /// Whether the state after every step is recorded.
    pub fn is_complete(self) -> bool {
        self == Self::default()
    }

    /// Which states are recorded, in words: `every 100 steps`.
    pub fn describe(self) -> String {
        match self {
            Self::Every(count) if count == NonZeroUsize::MIN => "every step".to_owned(),
            Self::Every(count) => format!("every {count} steps"),
            Self::Nothing => "nothing between the ends of a run".to_owned(),
        }
    }

    /// The most rows that so many steps add to the history.
    pub(super) fn rows_of(self, steps: usize) -> usize {
        match self {
            Self::Every(count) => steps / count.get() + 2,
            Self::Nothing => 2,
        }
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
