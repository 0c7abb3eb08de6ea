//! Measures of the temporal resolution for single bodies.
//! These measures are needed because the unresolved motion of a small body hardly changes the measures of the whole scene.

use super::Resolution;
use super::forecast::IncrementPrediction;
use crate::beams::RotationIncrement;

#[derive(Debug, Clone)]
pub struct MonitoredBody {
    pub body: usize,
    degrees: Vec<usize>,
    resolution: Resolution,
}

impl MonitoredBody {
    pub fn new(body: usize, degrees: Vec<usize>, noise: f64) -> Self {
        Self { body, degrees, resolution: Resolution::above(noise) }
    }

    pub fn renumber(&mut self, degrees: Vec<usize>) {
        self.degrees = degrees;
    }

    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    pub(super) fn add(
        &mut self,
        forecast: &IncrementPrediction,
        at_start: &[f64],
        increments: &[f64],
        duration: f64,
    ) {
        let missed = forecast.prediction_errors(&self.degrees, at_start, increments, duration);
        self.resolution.add(&missed, duration, 0.0, RotationIncrement::Angle);
    }

    pub(super) fn save(&self, numbers: &mut Vec<f64>) {
        self.resolution.save(numbers);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.resolution.restore(next);
    }
}
