//! With which rates the next step is best guessed.

use serde::{Deserialize, Serialize};

use super::resolution::GuessErrors;

/// What the next step of a model is best guessed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Trend {
    /// No step has been taken: the rates at the start of the next one are all there is.
    #[default]
    Unknown,
    /// The next step is best guessed from the rates at its start.
    Smooth,
    /// The next step is best guessed from the mean rates of the last one: those at its end alternate from step to step.
    Rough,
}

/// By how much the mean of the last step must have been the better guess, in squares, to be taken for the next.
const CLEARLY_LESS: f64 = 0.8;

/// The mean motion of the last step, and whether that or its end tells more about the next one.
#[derive(Debug, Clone)]
pub struct Forecast {
    /// Increments over duration.
    mean_rates: Vec<f64>,
    trend: Trend,
    /// The diagonal of the inertia matrix.
    inertia: Vec<f64>,
}

impl Forecast {
    /// The forecast before the first step.
    pub fn new(rates: &[f64], inertia: Vec<f64>) -> Self {
        Self { mean_rates: rates.to_vec(), trend: Trend::Unknown, inertia }
    }

    /// The rates to guess the next step with, given those at its start [length/time, 1/time].
    pub fn rates<'a>(&'a self, at_start: &'a [f64]) -> &'a [f64] {
        match self.trend {
            Trend::Unknown | Trend::Smooth => at_start,
            Trend::Rough => &self.mean_rates,
        }
    }

    /// Learns from the increments of a step and the rates at its start which guess would have been the better one for it,
    /// in a norm with the diagonal of the inertia matrix; tells how far both missed.
    pub fn learn(&mut self, at_start: &[f64], increments: &[f64], duration: f64) -> GuessErrors {
        let inverse = 1.0 / duration;
        let mut missed = GuessErrors::default();
        let guesses = at_start.iter().zip(&mut self.mean_rates);
        for ((u, (rate, mean)), inertia) in increments.iter().zip(guesses).zip(&self.inertia) {
            let found = u * inverse;
            missed.add(*inertia, found, [*rate, *mean]);
            *mean = found;
        }
        self.trend = match self.trend {
            // Start velocities may be those of single nodes; how these go on, the first step has told.
            Trend::Unknown => Trend::Rough,
            _ if missed.by_mean < CLEARLY_LESS * missed.by_start => Trend::Rough,
            _ => Trend::Smooth,
        };
        missed
    }

    /// Takes over a sudden change of all rates [length/time, 1/time].
    pub fn jump(&mut self, change: &[f64]) {
        self.mean_rates.iter_mut().zip(change).for_each(|(rate, change)| *rate += change);
    }

    /// How far the guesses for a step missed some of the movements, before this learns from it.
    pub fn missed(
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

    /// What the next step is best guessed from.
    pub fn trend(&self) -> Trend {
        self.trend
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend(&self.mean_rates);
    }

    pub fn restore(&mut self, trend: Trend, next: &mut dyn FnMut() -> f64) {
        self.trend = trend;
        self.mean_rates.iter_mut().for_each(|rate| *rate = next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_that_alternate_are_averaged_and_rates_that_grow_are_not() {
        let mut forecast = Forecast::new(&[0.0], vec![1.0]);
        for step in 0..5 {
            let (start, end) = (f64::from(step), f64::from(step + 1));
            forecast.learn(&[start], &[0.5 * (start + end)], 1.0);
        }
        assert_eq!(forecast.rates(&[5.0]), [5.0]);
        for sign in [1.0, -1.0, 1.0] {
            forecast.learn(&[3.0 + sign], &[3.0], 1.0);
        }
        assert_eq!(forecast.rates(&[4.0]), [3.0]);
    }
}
