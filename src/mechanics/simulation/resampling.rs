//! Error of variable steps due to controllers that are sampled only at the start of a step.

use super::adaptive::StepPlan;
use super::error_estimate::{DoubledStep, FailedStep, StepDoubling};
use crate::elementary::{power, whole_power};
use crate::geometry::larger;
use crate::integrators::{Integrator, Interval};
use crate::system::{Drive, Placement, Scene, System, SystemState};

/// Allowed difference between two results of the second half step: with controller values sampled at the start and in the middle of the step.
/// The difference is given as a multiple of the length scale times a power of the tolerance.
/// The multiple 4 makes the accumulated sampling error about half the tolerance (docs/theory.md, section 13.1).
const SHARE: f64 = 4.0;

/// Error estimate for steps in which controllers are sampled at the start of each half (docs/theory.md, section 13.1).
///
/// The error of the integration method is the difference between a whole step and two half steps with the same controller values.
/// The second half step is repeated with controller values that are sampled in the middle of the step.
/// The error due to sampling is the difference between the original and the repeated second half step.
pub(super) struct Resampling {
    /// Order in the step length of the difference between the original and the repeated second half step [-].
    order: i32,
    allowed: f64,
    length: f64,
    middle: SystemState,
    held: Placement,
    resampled: Placement,
    half_step: Option<HalfStep>,
}

struct HalfStep {
    plan: StepPlan,
    doubled: DoubledStep,
}

impl Resampling {
    pub(super) fn of(scene: &Scene, length: f64, tolerance: f64) -> Option<Self> {
        let all =
            scene.schedules().filter(|(_, schedule)| schedule.is_sampled_every_step()).count();
        let of_drives = scene.drives.iter().flat_map(Drive::schedules);
        let rates = of_drives.filter(|schedule| schedule.is_sampled_every_step()).count();
        let order = if all > rates { 3 } else { 2 };
        (all > 0).then(|| Self {
            order,
            allowed: SHARE * whole_power(tolerance, order),
            length,
            middle: SystemState::default(),
            held: Placement::default(),
            resampled: Placement::default(),
            half_step: None,
        })
    }

    pub(super) fn middle_mut(&mut self) -> &mut SystemState {
        &mut self.middle
    }

    pub(super) fn is_paused(&self) -> bool {
        self.half_step.is_some()
    }

    pub(super) fn pause_at_middle(
        &mut self,
        model: &mut System,
        plan: StepPlan,
        doubled: DoubledStep,
    ) {
        model.write_placement(&mut self.held);
        model.restore(&self.middle);
        self.half_step = Some(HalfStep { plan, doubled });
    }

    pub(super) fn resume(
        &mut self,
        doubling: &mut StepDoubling,
        integrator: &mut dyn Integrator,
        model: &mut System,
        order: f64,
    ) -> Option<(StepPlan, Result<DoubledStep, FailedStep>)> {
        let HalfStep { plan, doubled } = self.half_step.take()?;
        let half = Interval::between(model.time(), plan.interval.end);
        let taken = doubling.take_or_restore(integrator, model, half, doubled.report);
        let taken = taken.map(|report| {
            model.write_placement(&mut self.resampled);
            let distance = self.held.distance(&self.resampled);
            let apart = larger(distance.length / self.length, distance.angle) / self.allowed;
            let error = power(apart, order / f64::from(self.order));
            doubled.resampled(report, error)
        });
        Some((plan, taken))
    }

    pub(super) fn abandon(&mut self) -> bool {
        self.half_step.take().is_some()
    }
}
