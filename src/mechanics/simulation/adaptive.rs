//! Step size selection by an error tolerance.

use super::StepControl;
use super::controller::{StepController, StepSizeState};
use super::error_estimate::StepDoubling;
use super::first_step::{first_step, length_of};
use super::resampling::Resampling;
use crate::elementary::power;
use crate::integrators::{Interval, Method};
use crate::system::{Scene, System};

/// Default smallest step, as a fraction of the first step.
const SMALLEST: f64 = 1e-6;

/// Default largest step, as a multiple of the first step. It limits the steps of a scene without motion.
const LARGEST: f64 = 1e6;

/// Longest interval in which a load schedule is sampled with one set of points, as a multiple of the first step.
/// In a longer step, several such intervals are sampled. Otherwise, a long step, as in a scene at rest, could miss a short pulse.
const SAMPLED_PART: f64 = 8.0;

/// Smallest step, as a multiple of the rounding error of the present time.
const ROUNDINGS: f64 = 64.0;

pub(super) struct Adaptive {
    pub(super) controller: StepController,
    pub(super) doubling: StepDoubling,
    pub(super) resampling: Option<Resampling>,
    pub(super) tolerance: f64,
    /// Length scale of position errors [length].
    pub(super) length: f64,
    pub(super) order: u32,
}

pub(super) struct StepPlan {
    pub(super) interval: Interval,
    /// True if the step was shortened because of the next required end time, such as a jump of a load or the end of a run.
    pub(super) is_cut: bool,
    pub(super) is_least: bool,
}

/// Order of accuracy of a method in a scene.
/// The method `energy_decaying` is of second order in scenes without beams and springs, because its damping acts on strains only.
fn order_of(method: Method, scene: &Scene) -> u32 {
    let strains = !scene.beams.is_empty() || scene.springs().next().is_some();
    match method {
        Method::EnergyDecaying { .. } if !strains => Method::EnergyMomentum.entry().claims.order,
        method => method.entry().claims.order,
    }
}

impl Adaptive {
    pub(super) fn new(
        control: &StepControl,
        method: Method,
        scene: &Scene,
        model: &mut System,
    ) -> Self {
        let order = order_of(method, scene);
        let least = control.smallest.unwrap_or(0.0);
        let most = control.largest.unwrap_or(f64::INFINITY);
        let first = control.first.unwrap_or_else(|| first_step(scene, model).clamp(least, most));
        model.sample_loads_in_parts(SAMPLED_PART * first);
        let largest = control.largest.unwrap_or(LARGEST * first);
        let smallest = control.smallest.unwrap_or(SMALLEST * first);
        let controller = StepController { order: f64::from(order + 1), first, smallest, largest };
        let allowed = power(control.tolerance, 1.0 + 1.0 / f64::from(order));
        let length = length_of(scene);
        let doubling = StepDoubling::new(order, length, allowed);
        let resampling = Resampling::of(scene, length, control.tolerance);
        let tolerance = control.tolerance;
        Self { controller, doubling, resampling, tolerance, length, order }
    }

    /// Plans the next step, which starts at `now` and ends at `stop` at the latest [time].
    pub(super) fn plan(&self, state: &StepSizeState, now: f64, stop: f64) -> StepPlan {
        let least = self.controller.smallest.max(ROUNDINGS * f64::EPSILON * now);
        let wish = state.unconstrained_size.max(least);
        let left = stop - now;
        let (end, is_cut) = if stop <= now + wish {
            (stop, stop < now + wish)
        } else if left < 2.0 * wish {
            (now + 0.5 * left, true)
        } else {
            (now + wish, false)
        };
        let interval = Interval::between(now, end);
        // The duration of the interval has the rounding error of its end times, so it may be smaller than the requested step size.
        let is_least = wish <= least || interval.duration() <= least;
        StepPlan { interval, is_cut, is_least }
    }
}
