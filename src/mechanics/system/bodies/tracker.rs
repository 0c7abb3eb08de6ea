//! Tracked rotations of sections, used for stations and follower loads.

use crate::beams::{BodyPoint, Movement, Rotation, RotationIncrement};

/// Point of a body at which the rotation of the section is added up from step to step.
#[derive(Debug, Clone, Copy)]
pub struct Tracker {
    pub place: BodyPoint,
    /// Angle of the section, counted over full turns [rad].
    pub angle: f64,
    pub rotation: Rotation,
}

impl Tracker {
    pub fn new(place: BodyPoint) -> Self {
        Self { place, angle: place.tangent_angle, rotation: Rotation::by(place.tangent_angle) }
    }

    /// Rotation increment `Δω` of the section in a step.
    pub fn increment(&self, moved: &[Movement]) -> f64 {
        self.place.weights().map(|(point, weight)| weight * moved[point][2]).sum()
    }

    pub fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let increment = self.increment(moved);
        self.angle += rotations.angle(increment);
        self.rotation = self.rotation.turned(rotations, increment).normalised();
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.angle, self.rotation.cos, self.rotation.sin]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.angle = next();
        self.rotation = Rotation { cos: next(), sin: next() };
    }
}
