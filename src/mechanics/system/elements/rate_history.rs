//! Rates of the present and the last step, from which dissipative elements compute their forces.

use super::collocation;
use crate::beams::RateCollocation;
use crate::integrators::Stage;

/// Durations of the current step and the previous one [time]. An increment of zero duration has no rates.
#[derive(Debug, Clone, Copy)]
pub struct RateHistory {
    duration: f64,
    before: f64,
}

impl Default for RateHistory {
    fn default() -> Self {
        Self { duration: f64::INFINITY, before: 0.0 }
    }
}

impl RateHistory {
    pub fn begin(&mut self, duration: f64) {
        self.duration = duration;
    }

    /// Duration of the current step; infinite for an increment of zero duration [time].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    pub fn end(&mut self) {
        self.before = if self.duration.is_finite() { self.duration } else { 0.0 };
    }

    /// Coefficients of the rates for a stage with a weight; `None` at the start of a step, where no rates are used.
    ///
    /// Rates are evaluated once per step. A method with forces at both ends of the step balances forces at the fraction `weight` of the step.
    /// The rate at that time is extrapolated from the rates at the middle of this step and of the last one.
    pub fn at(&self, stage: Stage, weight: f64) -> Option<RateCollocation> {
        let by_change = 1.0 / self.duration;
        let rotations = collocation(stage).rotations;
        let middle = RateCollocation { fraction: 0.5, by_change, by_last: 0.0, rotations };
        match stage {
            Stage::Start => None,
            Stage::Midpoint | Stage::DampedMidpoint(_) => Some(middle),
            Stage::End if self.duration.is_infinite() => {
                Some(RateCollocation { fraction: 1.0, ..middle })
            }
            Stage::End => {
                let late = 2.0 * (weight - 0.5) * self.duration / (self.duration + self.before);
                let by_change = (1.0 + late) * by_change;
                Some(RateCollocation { fraction: weight, by_change, by_last: late, rotations })
            }
        }
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.before);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.before = next();
    }
}
