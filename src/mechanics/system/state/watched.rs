//! Bodies whose motion is judged by itself: what steps do not resolve of a small one is nothing beside what a large one does.

use super::Resolution;
use super::forecast::Forecast;
use crate::beams::RotationIncrement;

/// A body with its own movements among the unknowns, and how well steps resolve these.
#[derive(Debug, Clone)]
pub struct MonitoredBody {
    /// The body, by its number.
    pub body: usize,
    /// Where its movements stand among the unknowns; those that are none are left out.
    degrees: Vec<usize>,
    resolution: Resolution,
}

impl MonitoredBody {
    /// A body that has not moved, whose motions below an energy are rounding [energy].
    pub fn new(body: usize, degrees: Vec<usize>, noise: f64) -> Self {
        Self { body, degrees, resolution: Resolution::above(noise) }
    }

    /// Goes on where its movements stand elsewhere.
    pub fn renumber(&mut self, degrees: Vec<usize>) {
        self.degrees = degrees;
    }

    /// How far the steps so far resolve the motion of the body.
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// Takes in the increments of a step of a duration [time] before the forecast learns from them, with the rates at its start.
    pub(super) fn add(
        &mut self,
        forecast: &Forecast,
        at_start: &[f64],
        increments: &[f64],
        duration: f64,
    ) {
        let missed = forecast.missed(&self.degrees, at_start, increments, duration);
        self.resolution.add(&missed, duration, 0.0, RotationIncrement::Angle);
    }

    pub(super) fn save(&self, numbers: &mut Vec<f64>) {
        self.resolution.save(numbers);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.resolution.restore(next);
    }
}
