//! What finds steps as long as a tolerance allows.

use super::StepControl;
use super::controller::{StepController, StepSizeState};
use super::error_estimate::StepDoubling;
use super::first_step::{first_step, length_of};
use super::resampling::Resampling;
use crate::elementary::power;
use crate::integrators::{Interval, Method};
use crate::system::{Scene, System};

/// The smallest step where none is given, as a part of the first one.
const SMALLEST: f64 = 1e-6;

/// The largest one where none is given, as a multiple of the first: a scene at rest sets no other bound.
const LARGEST: f64 = 1e6;

/// No step is shorter than so many times what rounds a time.
const ROUNDINGS: f64 = 64.0;

/// How a run finds steps of varying size: what does not change from step to step.
pub(super) struct Adaptive {
    pub(super) controller: StepController,
    pub(super) doubling: StepDoubling,
    /// Where controllers are asked.
    pub(super) resampling: Option<Resampling>,
    pub(super) tolerance: f64,
}

/// Where the next step of varying size is to end.
pub(super) struct StepPlan {
    pub(super) interval: Interval,
    /// Whether the step would be longer if something else, such as a jump of a load, did not cut it.
    pub(super) is_cut: bool,
    /// Whether the step is the shortest one allowed.
    pub(super) is_least: bool,
}

/// The order of a method in a scene. What damps vibration by strains is of second order where nothing strains: it damps nothing there.
fn order_of(method: Method, scene: &Scene) -> u32 {
    let strains = !scene.beams.is_empty() || scene.springs().next().is_some();
    match method {
        Method::EnergyDecaying { .. } if !strains => Method::EnergyMomentum.entry().claims.order,
        method => method.entry().claims.order,
    }
}

impl Adaptive {
    /// The control of steps of varying size for a scene at its start.
    pub(super) fn new(
        control: &StepControl,
        method: Method,
        scene: &Scene,
        model: &System,
    ) -> Self {
        let order = order_of(method, scene);
        let least = control.smallest.unwrap_or(0.0);
        let most = control.largest.unwrap_or(f64::INFINITY);
        let first = control.first.unwrap_or_else(|| first_step(scene, model).clamp(least, most));
        let largest = control.largest.unwrap_or(LARGEST * first);
        let smallest = control.smallest.unwrap_or(SMALLEST * first);
        let controller = StepController { order: f64::from(order + 1), first, smallest, largest };
        let allowed = power(control.tolerance, 1.0 + 1.0 / f64::from(order));
        let length = length_of(scene);
        let doubling = StepDoubling::new(order, length, allowed);
        let resampling = Resampling::of(scene, length, control.tolerance);
        Self { controller, doubling, resampling, tolerance: control.tolerance }
    }

    /// The next step from `now` on, when something stops it at the time `stop` at the latest [time].
    pub(super) fn plan(&self, pace: &StepSizeState, now: f64, stop: f64) -> StepPlan {
        let least = self.controller.smallest.max(ROUNDINGS * f64::EPSILON * now);
        let wish = pace.wish.max(least);
        let left = stop - now;
        let (end, is_cut) = if stop <= now + wish {
            (stop, stop < now + wish)
        } else if left < 2.0 * wish {
            // Two equal ones, and not a long and a short one.
            (now + 0.5 * left, true)
        } else {
            (now + wish, false)
        };
        let interval = Interval::between(now, end);
        // The duration is rounded as times are, the wish is not.
        let is_least = wish <= least || interval.duration() <= least;
        StepPlan { interval, is_cut, is_least }
    }
}
