//! Outputs of the controllers of a simulation.
//!
//! Simulations of one scene share the variables that contain the outputs. Therefore each simulation restores its own outputs before it is used.

use std::cell::RefCell;

/// Time [time] and new output at each change of the output of each controller.
#[derive(Debug, Clone, Default)]
pub(super) struct Commands(RefCell<Vec<Vec<(f64, f64)>>>);

impl Commands {
    pub(super) fn new(controllers: usize) -> Self {
        Self(RefCell::new(vec![Vec::new(); controllers]))
    }

    pub(super) fn copy_from(&self, other: &Self) {
        self.0.replace(other.0.borrow().clone());
    }

    pub(super) fn before(&self, controller: usize, time: f64) -> f64 {
        let all = self.0.borrow();
        let own = all.get(controller).map_or(&[][..], Vec::as_slice);
        let spoken = own.partition_point(|(from, _)| *from < time);
        spoken.checked_sub(1).map_or(0.0, |last| own[last].1)
    }

    /// Records the output of a controller after the time `time`.
    /// Outputs from this time on, which were computed before a rewind, are dropped.
    pub(super) fn record(&self, controller: usize, time: f64, command: f64) {
        let mut all = self.0.borrow_mut();
        let Some(own) = all.get_mut(controller) else { return };
        own.truncate(own.partition_point(|(from, _)| *from < time));
        if own.last().is_none_or(|(_, last)| *last != command) {
            own.push((time, command));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_before_a_time_are_known_after_rewinds_and_in_copies() {
        let commands = Commands::new(2);
        assert_eq!(commands.before(0, 1.0), 0.0);
        for (time, command) in [(0.0, 1.0), (0.1, 1.0), (0.2, 3.0), (0.3, 4.0)] {
            commands.record(0, time, command);
        }
        let outputs =
            |commands: &Commands| [0.0, 0.15, 0.2, 0.25, 9.0].map(|time| commands.before(0, time));
        assert_eq!(outputs(&commands), [0.0, 1.0, 1.0, 3.0, 4.0]);
        let copy = Commands::new(2);
        copy.copy_from(&commands);
        commands.record(0, 0.2, 5.0);
        assert_eq!(outputs(&commands), [0.0, 1.0, 1.0, 5.0, 5.0]);
        assert_eq!(outputs(&copy), [0.0, 1.0, 1.0, 3.0, 4.0]);
        assert_eq!(commands.before(1, 9.0), 0.0);
    }
}
