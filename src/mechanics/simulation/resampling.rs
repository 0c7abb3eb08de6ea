//! Error of variable steps due to controllers that are sampled at the start of a step only.

use super::adaptive::StepPlan;
use super::error_estimate::{DoubledStep, FailedStep, StepDoubling};
use crate::elementary::{power, whole_power};
use crate::geometry::larger;
use crate::integrators::{Integrator, Interval};
use crate::system::{Drive, Placement, Scene, System, SystemState};

/// Allowed distance of the repeated second halves, in units of the length scale times a power of the tolerance. With this value, the measured
/// accumulated error in the time scale of a motion is about half the tolerance (theory.md, section 13.1).
const SHARE: f64 = 4.0;

/// Steps with a controller sample in each half.
///
/// The whole step and its halves are compared with the values of the start, which gives the error of the method. Then the run pauses in the middle,
/// the controllers are sampled there, and the second half is repeated. A held force is late by half a step on average, which changes positions by the
/// third power of the step size locally and by the first power globally; for a held rate it is the second power. The difference between both second
/// halves may therefore be that power of the tolerance.
pub(super) struct Resampling {
    /// Power of the step size in the position difference [-].
    order: i32,
    allowed: f64,
    length: f64,
    middle: SystemState,
    held: Placement,
    resampled: Placement,
    under_way: Option<HalfStep>,
}

/// Step that is paused in its middle to sample controllers.
struct HalfStep {
    plan: StepPlan,
    doubled: DoubledStep,
}

impl Resampling {
    /// Creates the estimate for a scene with a length scale; `None` without controllers that are sampled at every step.
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
            under_way: None,
        })
    }

    pub(super) fn middle_mut(&mut self) -> &mut SystemState {
        &mut self.middle
    }

    pub(super) fn is_paused(&self) -> bool {
        self.under_way.is_some()
    }

    /// Restores the middle of a completed step and pauses there.
    pub(super) fn pause_at_middle(
        &mut self,
        model: &mut System,
        plan: StepPlan,
        doubled: DoubledStep,
    ) {
        model.write_placement(&mut self.held);
        model.restore(&self.middle);
        self.under_way = Some(HalfStep { plan, doubled });
    }

    /// Repeats the second half of a paused step with new controller values. The larger of both errors counts.
    pub(super) fn resume(
        &mut self,
        doubling: &mut StepDoubling,
        integrator: &mut dyn Integrator,
        model: &mut System,
        order: f64,
    ) -> Option<(StepPlan, Result<DoubledStep, FailedStep>)> {
        let HalfStep { plan, doubled } = self.under_way.take()?;
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

    /// Discards a paused step. Returns true if there was one.
    pub(super) fn abandon(&mut self) -> bool {
        self.under_way.take().is_some()
    }
}
