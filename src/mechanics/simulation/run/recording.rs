//! Recording the present.

use super::Simulation;
use crate::simulation::Recording;

impl Simulation {
    /// Which states of the simulation are recorded.
    pub fn recording(&self) -> Recording {
        self.record.recording
    }

    /// Changes which states of the simulation are recorded, from here on.
    pub fn record(&mut self, recording: Recording) {
        self.record.recording = recording;
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.record(recording);
        }
    }

    /// Whether the history has a row for every step.
    pub fn has_all_rows(&self) -> bool {
        self.record.history.samples().len() == self.progress.counts.steps + 1
    }

    /// Whether the state of the simulation that was just reached is to be recorded.
    pub(super) fn is_worth_a_row(&self) -> bool {
        self.record.recording.is_due(self.progress.counts.steps)
            || self.has_reached(self.clock.goal)
    }

    /// Gives the present state of the simulation a row of the history that stays.
    pub(in crate::simulation) fn keep_row(&mut self) {
        self.record.keep_row(&mut self.model, self.progress.last_step);
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.keep_row();
        }
    }

    /// Records the state of the simulation that was just reached, if it is due, and remembers it, if states are kept.
    pub(super) fn keep_present(&mut self) {
        if self.is_worth_a_row() {
            self.keep_row();
        }
        self.remember();
    }

    /// Gives the present state of the simulation a row of the history until it is past, unless it has one, or is the middle of a step.
    pub(in crate::simulation) fn show_present(&mut self) {
        if self.is_half_way() {
            return;
        }
        self.record.show_present(&mut self.model, self.progress.last_step);
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.show_present();
        }
    }
}
