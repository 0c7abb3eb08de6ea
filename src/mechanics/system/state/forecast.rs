//! Selection of the rates from which the increments of the next step are predicted.

use serde::{Deserialize, Serialize};

use super::resolution::GuessErrors;

/// Rates from which the increments of the next step are predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Prediction {
    /// Prediction from the start rates, because no step has been taken.
    #[default]
    Unknown,
    /// Prediction from the rates at the start of the step.
    Smooth,
    /// Prediction from the mean rates of the last step, because the rates at the ends of steps alternate from step to step.
    FromMeanRates,
}

/// Limit of the squared error of the prediction from mean rates, as a fraction of the squared error of the prediction from start rates.
/// Below this limit, the next increments are predicted from mean rates.
const SELECTION_RATIO: f64 = 0.8;

#[derive(Debug, Clone)]
pub struct IncrementPrediction {
    mean_rates: Vec<f64>,
    prediction: Prediction,
    inertia: Vec<f64>,
}

impl IncrementPrediction {
    pub fn new(rates: &[f64], inertia: Vec<f64>) -> Self {
        Self { mean_rates: rates.to_vec(), prediction: Prediction::Unknown, inertia }
    }

    pub fn rates<'a>(&'a self, at_start: &'a [f64]) -> &'a [f64] {
        match self.prediction {
            Prediction::Unknown | Prediction::Smooth => at_start,
            Prediction::FromMeanRates => &self.mean_rates,
        }
    }

    /// Compares the increments of a step with the predictions from start rates and from mean rates, and selects the better prediction.
    /// Returns the errors of the two predictions in the norm of the diagonal inertia.
    pub fn update(&mut self, at_start: &[f64], increments: &[f64], duration: f64) -> GuessErrors {
        let inverse = 1.0 / duration;
        let mut missed = GuessErrors::default();
        let guesses = at_start.iter().zip(&mut self.mean_rates);
        for ((u, (rate, mean)), inertia) in increments.iter().zip(guesses).zip(&self.inertia) {
            let found = u * inverse;
            missed.add(*inertia, found, [*rate, *mean]);
            *mean = found;
        }
        self.prediction = match self.prediction {
            // The start velocities may be nonzero at a few nodes only. The mean rates of the first step are therefore the better prediction.
            Prediction::Unknown => Prediction::FromMeanRates,
            _ if missed.by_mean < SELECTION_RATIO * missed.by_start => Prediction::FromMeanRates,
            _ => Prediction::Smooth,
        };
        missed
    }

    /// Adds a jump of all rates to the mean rates [length/time, 1/time].
    pub fn jump(&mut self, change: &[f64]) {
        self.mean_rates.iter_mut().zip(change).for_each(|(rate, change)| *rate += change);
    }

    /// Errors of the two predictions of the increments, from the rates at the start and from the mean rates, at the given degrees of freedom.
    /// This function must be called before `update`, which overwrites the mean rates.
    pub fn prediction_errors(
        &self,
        movements: &[usize],
        at_start: &[f64],
        increments: &[f64],
        duration: f64,
    ) -> GuessErrors {
        let inverse = 1.0 / duration;
        let mut missed = GuessErrors::default();
        for &at in movements {
            let guesses = [at_start[at], self.mean_rates[at]];
            missed.add(self.inertia[at], increments[at] * inverse, guesses);
        }
        missed
    }

    pub fn trend(&self) -> Prediction {
        self.prediction
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend(&self.mean_rates);
    }

    pub fn restore(&mut self, trend: Prediction, next: &mut dyn FnMut() -> f64) {
        self.prediction = trend;
        self.mean_rates.iter_mut().for_each(|rate| *rate = next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alternating_rates_are_averaged_and_growing_rates_are_not() {
        let mut forecast = IncrementPrediction::new(&[0.0], vec![1.0]);
        for step in 0..5 {
            let (start, end) = (f64::from(step), f64::from(step + 1));
            forecast.update(&[start], &[0.5 * (start + end)], 1.0);
        }
        assert_eq!(forecast.rates(&[5.0]), [5.0]);
        for sign in [1.0, -1.0, 1.0] {
            forecast.update(&[3.0 + sign], &[3.0], 1.0);
        }
        assert_eq!(forecast.rates(&[4.0]), [3.0]);
    }
}
