//! Rule that selects the states of a run to be recorded.

use std::num::NonZeroUsize;

use serde::{Deserialize, Serialize};

/// Rule that selects the recorded states of a run. The start, the ends of runs and the arrivals of sliders are always recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Recording {
    /// Every n-th step is recorded.
    Every(NonZeroUsize),
    /// Only the start, the ends of runs and arrivals are recorded.
    Nothing,
}

impl Default for Recording {
    fn default() -> Self {
        Self::Every(NonZeroUsize::MIN)
    }
}

impl Recording {
    /// Returns true if the state after the given number of steps is recorded.
    pub fn is_due(self, steps: usize) -> bool {
        match self {
            Self::Every(count) => steps.is_multiple_of(count.get()),
            Self::Nothing => false,
        }
    }

    /// Returns true if every step is recorded.
    pub fn is_complete(self) -> bool {
        self == Self::default()
    }

    /// Description of the rule, such as `every 100 steps`.
    pub fn describe(self) -> String {
        match self {
            Self::Every(count) if count == NonZeroUsize::MIN => "every step".to_owned(),
            Self::Every(count) => format!("every {count} steps"),
            Self::Nothing => "only the ends of a run".to_owned(),
        }
    }

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
    fn recording_states_which_and_how_many_rows_are_due() {
        let every = |count| Recording::Every(NonZeroUsize::new(count).unwrap());
        assert!(Recording::default().is_due(7) && Recording::default().is_complete());
        assert!(every(3).is_due(6) && !every(3).is_due(7) && !every(3).is_complete());
        assert!(!Recording::Nothing.is_due(0) && !Recording::Nothing.is_complete());
        assert_eq!((every(3).rows_of(10), Recording::Nothing.rows_of(10)), (5, 2));
        assert_eq!(every(3).describe(), "every 3 steps");
        assert_eq!(Recording::default().describe(), "every step");
    }
}
