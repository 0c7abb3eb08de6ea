//! Bends of given motions within a step.

use crate::integrators::Interval;
use crate::loads::{MotionInStep, PrescribedMotion};

/// Rates that miss each other by less than this part of them are those of a smooth motion.
const SHARPEST: f64 = 0.1;

/// A bend of a given motion within a step, which takes it for smooth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionCurvature {
    /// When the step begins [time].
    pub time: f64,
    /// The rate with which the step before ended, and the one with which this one begins [length/time, rad/time].
    pub rates: [f64; 2],
}

impl MotionCurvature {
    /// The bend of a function from outside at the start of a step or in it, where the rate of the step before was this one. What smooth steps find
    /// there agrees to the fifth power of their length; a jump of the rate does not, nor does what is much faster than a step. At times at which a
    /// function is said to bend it may.
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
        if missed <= SHARPEST * size
            || missed <= step.rounding
            || schedule.functions() == 0
            || schedule.is_sampled()
            || schedule.breaks().contains(&interval.start)
        {
            return Self::default();
        }
        Self { time: interval.start, rates: [before, step.first_rate] }
    }

    /// By how much the rate changes [length/time, rad/time].
    pub fn size(&self) -> f64 {
        (self.rates[1] - self.rates[0]).abs()
    }
}
