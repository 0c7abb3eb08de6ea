//! Detection of kinks: abrupt changes of the rate of a prescribed motion within a step.

use crate::integrators::Interval;
use crate::loads::{MotionInStep, PrescribedMotion};

/// Largest jump of the rate of a motion between steps that does not count as a kink, as a fraction of the largest rate in the step [-].
const LARGEST_SMOOTH_CHANGE: f64 = 0.1;

/// Kink of a prescribed motion: an abrupt change of its rate within a step. Integrators assume a smooth motion within each step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionCurvature {
    /// Start time of the step with the kink [time].
    pub time: f64,
    /// Prescribed rates at the end of the previous step and at the start of this step [length/time, rad/time].
    pub rates: [f64; 2],
}

impl MotionCurvature {
    /// Detects a kink of a script function at the start of a step or within it.
    /// For a smooth motion, the rates at the end of a step and at the start of the next step agree up to the fifth power of the step length.
    /// The two rates differ if the rate jumps, or if the motion is much faster than the step. Declared breaks are not kinks.
    pub fn of(
        motion: &PrescribedMotion,
        interval: Interval,
        before: f64,
        step: &MotionInStep,
    ) -> Self {
        let schedule = motion.schedule();
        let size = [before, step.first_rate, step.rate]
            .iter()
            .fold(0.0, |size: f64, rate| size.max(rate.abs()));
        let missed = (step.first_rate - before).abs();
        if missed <= LARGEST_SMOOTH_CHANGE * size
            || missed <= step.rounding
            || schedule.functions() == 0
            || schedule.is_sampled()
            || schedule.breaks().contains(&interval.start)
        {
            return Self::default();
        }
        Self { time: interval.start, rates: [before, step.first_rate] }
    }

    /// Change of the rate at the kink [length/time, rad/time].
    pub fn size(&self) -> f64 {
        (self.rates[1] - self.rates[0]).abs()
    }
}
