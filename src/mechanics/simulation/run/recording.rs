//! Recording of the states of a run.

use super::Simulation;
use crate::simulation::Recording;

impl Simulation {
    /// Rule that selects the recorded states.
    pub fn recording(&self) -> Recording {
        self.record.recording
    }

    /// Changes the rule that selects the recorded states, for the following steps.
    pub fn record(&mut self, recording: Recording) {
        self.record.recording = recording;
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.record(recording);
        }
    }

    /// Returns true if the history has a row for every step.
    pub fn has_all_rows(&self) -> bool {
        self.record.history.samples().len() == self.progress.counts.steps + 1
    }

    pub(super) fn is_worth_a_row(&self) -> bool {
        self.record.recording.is_due(self.progress.counts.steps)
            || self.has_reached(self.clock.goal)
    }

    pub(in crate::simulation) fn keep_row(&mut self) {
        self.record.store_row(&mut self.model, self.progress.last_step);
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.store_row();
        }
    }

    pub(super) fn store_present(&mut self) {
        if self.is_worth_a_row() {
            self.keep_row();
        }
        self.store_snapshot();
    }

    pub(in crate::simulation) fn show_present(&mut self) {
        if self.is_paused_in_step() {
            return;
        }
        self.record.append_present(&mut self.model, self.progress.last_step);
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.append_present();
        }
    }
}
