//! What lets go in the course of a run, between two steps.
//!
//! A release belongs to the start of a step: the state at the end of the step before is that of a scene that still holds. So going back to
//! it and going on lets go again, at the same place.

use std::rc::Rc;

use super::Simulation;
use crate::joints::{Releasable, Release, Trigger};
use crate::simulation::{ReleaseEvent, SimulationError};

impl Simulation {
    /// What has let go so far, in the order in which it did.
    pub fn let_go(&self) -> &[ReleaseEvent] {
        &self.progress.let_go
    }

    /// Whether something waits for somebody outside to say that it lets go, by its index among the releases of the scene.
    pub fn waits_for_release(&self, release: usize) -> bool {
        let described = self.scene.releases.get(release);
        described.is_some_and(|described| described.trigger == Trigger::Outside)
            && !self.has_let_go(release)
    }

    fn has_let_go(&self, release: usize) -> bool {
        self.let_go().iter().any(|gone| gone.release == release)
    }

    /// Lets go at the present moment what a release of the scene, by its index, is about; once.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn release(&mut self, release: usize) -> Result<(), SimulationError> {
        let Some(Release { hold, .. }) = self.scene.releases.get(release).copied() else {
            return Ok(());
        };
        if self.has_let_go(release) {
            return Ok(());
        }
        self.lose_derivatives("something lets go");
        let before = self.holds_released(&self.progress.let_go);
        self.model.let_go(&self.scene, &before, hold)?;
        let gone = ReleaseEvent { release, time: self.time() };
        self.progress.let_go = self.let_go().iter().copied().chain([gone]).collect();
        self.take_up_model()?;
        if let (Some(adaptive), Some(pace)) = (&self.adaptive, &mut self.clock.pace) {
            adaptive.controller.restart(pace);
        }
        Ok(())
    }

    /// Lets go what is due at the present time, before the next step.
    pub(super) fn let_go_due(&mut self) -> Result<(), SimulationError> {
        for release in 0..self.scene.releases.len() {
            if let Trigger::Time(time) = self.scene.releases[release].trigger
                && self.has_reached(time)
            {
                self.release(release)?;
            }
        }
        Ok(())
    }

    /// Makes the model one in which this has let go, to be given a state of such a one.
    pub(super) fn stand_released(
        &mut self,
        let_go: &Rc<[ReleaseEvent]>,
    ) -> Result<(), SimulationError> {
        if self.progress.let_go == *let_go {
            return Ok(());
        }
        self.model.stand_released(&self.scene, &self.holds_released(let_go))?;
        self.progress.let_go = Rc::clone(let_go);
        self.take_up_model()
    }

    fn holds_released(&self, let_go: &[ReleaseEvent]) -> Vec<Releasable> {
        let_go.iter().map(|gone| self.scene.releases[gone.release].hold).collect()
    }

    /// Gives the method work space for a model whose movements have other numbers, and finds again what is recorded.
    fn take_up_model(&mut self) -> Result<(), SimulationError> {
        let Self { settings, model, record, scene, stepper, .. } = self;
        stepper.integrator = settings.method.build(model, settings.tolerance);
        Ok(record.look_again(scene, model)?)
    }

    /// Lets go of everything that waits for somebody outside, for a pretended run: scripts may wait for that.
    pub(super) fn pretend_releases(&mut self) -> Result<(), SimulationError> {
        for release in 0..self.scene.releases.len() {
            if self.waits_for_release(release) {
                self.release(release)?;
            }
        }
        Ok(())
    }
}
