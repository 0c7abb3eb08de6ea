//! The rates of a step, for what resists them.

use super::collocation;
use crate::beams::RateCollocation;
use crate::integrators::Stage;

/// How long the present step and the one before are [time]; a movement that takes no time has no rates.
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
    /// Begins a step of a duration [time].
    pub fn begin(&mut self, duration: f64) {
        self.duration = duration;
    }

    /// The duration of the present step, infinite in a movement that takes no time [time].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Ends the step.
    pub fn end(&mut self) {
        self.before = if self.duration.is_finite() { self.duration } else { 0.0 };
    }

    /// Where rates are taken by a method that takes forces of a stage with a weight; none where it has those of its start from elsewhere.
    ///
    /// They are taken once a step. A method that takes forces at both ends of it balances those of one time, `weight` of the step after
    /// its start: the rate there follows from those in the middles of this step and of the last one.
    pub fn at(&self, stage: Stage, weight: f64) -> Option<RateCollocation> {
        let by_change = 1.0 / self.duration;
        let rotations = collocation(stage).rotations;
        let middle = RateCollocation { share: 0.5, by_change, by_last: 0.0, rotations };
        match stage {
            Stage::Start => None,
            Stage::Midpoint | Stage::DampedMidpoint(_) => Some(middle),
            Stage::End if self.duration.is_infinite() => {
                Some(RateCollocation { share: 1.0, ..middle })
            }
            Stage::End => {
                let late = 2.0 * (weight - 0.5) * self.duration / (self.duration + self.before);
                let by_change = (1.0 + late) * by_change;
                Some(RateCollocation { share: weight, by_change, by_last: late, rotations })
            }
        }
    }

    /// Appends the rates at the start of a step to a state.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.before);
    }

    /// Takes the rates at the start of a step back from a state.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.before = next();
    }
}
