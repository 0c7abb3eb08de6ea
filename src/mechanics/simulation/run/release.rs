//! Releases between two steps of a run.
//!
//! A release occurs at the start of a step. The stored state at the end of the previous step is the state before the release.

use std::rc::Rc;

use super::Simulation;
use crate::joints::{Releasable, Release, Trigger};
use crate::simulation::{ReleaseEvent, SimulationError};

impl Simulation {
    /// Executed releases, in the order of their execution.
    pub fn releases(&self) -> &[ReleaseEvent] {
        &self.progress.releases
    }

    /// Returns true if the caller triggers this release and the release has not been executed yet.
    pub fn waits_for_release(&self, release: usize) -> bool {
        let described = self.scene.releases.get(release);
        described.is_some_and(|described| described.trigger == Trigger::Outside)
            && !self.is_released(release)
    }

    fn is_released(&self, release: usize) -> bool {
        self.releases().iter().any(|gone| gone.release == release)
    }

    /// Executes a release of the scene at the present time, unless the release has already been executed.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn release(&mut self, release: usize) -> Result<(), SimulationError> {
        let Some(Release { object: hold, trigger }) = self.scene.releases.get(release).copied()
        else {
            return Ok(());
        };
        if self.is_released(release) {
            return Ok(());
        }
        if !matches!(trigger, Trigger::Time(_)) {
            self.disable_derivatives("a joint, spring or support is released");
        }
        let before = self.released_objects(&self.progress.releases);
        self.model.release(&self.scene, &before, hold)?;
        let gone = ReleaseEvent { release, time: self.time() };
        self.progress.releases = self.releases().iter().copied().chain([gone]).collect();
        self.adapt_to_model()?;
        if let (Some(adaptive), Some(state)) = (&self.adaptive, &mut self.clock.step_size) {
            adaptive.controller.restart(state);
        }
        let Self { settings, model, stepper, .. } = self;
        match &mut stepper.sensitivities {
            Some(sensitivities) => sensitivities.release(release, model, settings),
            None => Ok(()),
        }
    }

    pub(super) fn execute_due_releases(&mut self) -> Result<(), SimulationError> {
        for release in 0..self.scene.releases.len() {
            if let Trigger::Time(time) = self.scene.releases[release].trigger
                && self.has_reached(time)
            {
                self.release(release)?;
            }
        }
        Ok(())
    }

    pub(super) fn restore_releases(
        &mut self,
        let_go: &Rc<[ReleaseEvent]>,
    ) -> Result<(), SimulationError> {
        if self.progress.releases == *let_go {
            return Ok(());
        }
        self.model.restore_releases(&self.scene, &self.released_objects(let_go))?;
        self.progress.releases = Rc::clone(let_go);
        self.adapt_to_model()
    }

    fn released_objects(&self, let_go: &[ReleaseEvent]) -> Vec<Releasable> {
        let_go.iter().map(|gone| self.scene.releases[gone.release].object).collect()
    }

    fn adapt_to_model(&mut self) -> Result<(), SimulationError> {
        let Self { settings, model, record, scene, stepper, .. } = self;
        stepper.integrator = settings.method.build(model, settings.tolerance);
        Ok(record.relocate_sensors(scene, model)?)
    }

    pub(super) fn dry_run_releases(&mut self) -> Result<(), SimulationError> {
        for release in 0..self.scene.releases.len() {
            if self.waits_for_release(release) {
                self.release(release)?;
            }
        }
        Ok(())
    }
}
