//! Coefficients for the rates of dissipative elements, computed from the durations of the present and the previous step.
//! The elements store the rates of the previous step themselves.

use super::collocation;
use crate::beams::RateCollocation;
use crate::integrators::Stage;

/// Durations of the present step and the previous step [time].
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

    /// Duration of the present step [time]; infinite for a static increment, in which all rates are zero.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    pub fn end(&mut self) {
        self.before = if self.duration.is_finite() { self.duration } else { 0.0 };
    }

    /// Coefficients of the rates for a stage and its weight; `None` at the start of a step, where rates are not used.
    ///
    /// At the middle of a step, the rate is the mean rate of the present step.
    /// At the stage `End`, the rate after the fraction `weight` of the step is extrapolated from the mean rates of the present and the previous step.
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
