//! What it does to a step of varying size that controllers are asked only at its start.

use super::adaptive::StepPlan;
use super::error_estimate::{DoubledStep, FailedStep, StepDoubling};
use crate::elementary::{power, whole_power};
use crate::geometry::larger;
use crate::integrators::{Integrator, Interval};
use crate::system::{Drive, Placement, Scene, System, SystemState};

/// How far the second halves may be apart, as a multiple of the length of the scene times a power of the tolerance: as measured, by this number the
/// error that gathers in the time scale of a motion is about half the tolerance (theory.md, section 13.1).
const SHARE: f64 = 4.0;

/// Steps of which each half asks the controllers as a step of its own.
///
/// Whole step and half steps are compared under the values of the start, which shows the error of the method. Then the run pauses in the middle,
/// controllers are asked there, and the second half is taken again. A held force is late by half a step in the mean, which moves places by a third
/// power of the step size at first, and in the long run by the first; of a held rate it is the second power. So the difference between both second
/// halves may be that power of the tolerance.
pub(super) struct Resampling {
    /// The power of the step size with which places differ [-].
    order: i32,
    allowed: f64,
    length: f64,
    middle: SystemState,
    held: Placement,
    resampled: Placement,
    under_way: Option<HalfStep>,
}

/// A step that has been taken as far as its middle, where controllers are asked.
struct HalfStep {
    plan: StepPlan,
    doubled: DoubledStep,
}

impl Resampling {
    /// The comparison for a scene of such a length; none where none is asked at every step.
    pub(super) fn of(scene: &Scene, length: f64, tolerance: f64) -> Option<Self> {
        let all = scene.schedules().filter(|(_, schedule)| schedule.is_asked_every_step()).count();
        let of_drives = scene.drives.iter().flat_map(Drive::schedules);
        let rates = of_drives.filter(|schedule| schedule.is_asked_every_step()).count();
        let order = if all > rates { 3 } else { 2 };
        (all > 0).then(|| Self {
            order,
            allowed: SHARE * whole_power(tolerance, order),
            length,
            middle: SystemState::default(),
            held: Placement::default(),
            resampled: Placement::default(),
            under_way: None,
        })
    }

    /// Room for the state in the middle of the step.
    pub(super) fn middle_mut(&mut self) -> &mut SystemState {
        &mut self.middle
    }

    /// Whether a step waits in its middle.
    pub(super) fn is_half_way(&self) -> bool {
        self.under_way.is_some()
    }

    /// Goes back to the middle of a step that was taken to its end.
    pub(super) fn wait_half_way(
        &mut self,
        model: &mut System,
        plan: StepPlan,
        doubled: DoubledStep,
    ) {
        model.write_placement(&mut self.held);
        model.restore(&self.middle);
        self.under_way = Some(HalfStep { plan, doubled });
    }

    /// Takes the second half of the step that waits, if one does, with the values that controllers have now; the step is the worse of both comparisons.
    pub(super) fn go_on(
        &mut self,
        doubling: &mut StepDoubling,
        integrator: &mut dyn Integrator,
        model: &mut System,
        order: f64,
    ) -> Option<(StepPlan, Result<DoubledStep, FailedStep>)> {
        let HalfStep { plan, doubled } = self.under_way.take()?;
        let half = Interval::between(model.time(), plan.interval.end);
        let taken = doubling.take_or_go_back(integrator, model, half, doubled.report);
        let taken = taken.map(|report| {
            model.write_placement(&mut self.resampled);
            let distance = self.held.distance(&self.resampled);
            let apart = larger(distance.length / self.length, distance.angle) / self.allowed;
            let error = power(apart, order / f64::from(self.order));
            doubled.resampled(report, error)
        });
        Some((plan, taken))
    }

    /// Forgets a step that waits in its middle; gives whether there was one.
    pub(super) fn abandon(&mut self) -> bool {
        self.under_way.take().is_some()
    }
}
