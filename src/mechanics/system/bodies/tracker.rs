//! Sections whose rotation is followed: stations, and places where loads turn with the beam.

use crate::beams::{BodyPoint, Movement, Rotation, RotationIncrement};

/// A place of a beam whose angle is followed: it is advanced with the steps.
#[derive(Debug, Clone, Copy)]
pub struct Tracker {
    pub place: BodyPoint,
    /// The unwrapped angle of the followed section [rad].
    pub angle: f64,
    pub rotation: Rotation,
}

impl Tracker {
    pub fn new(place: BodyPoint) -> Self {
        Self { place, angle: place.tangent_angle, rotation: Rotation::by(place.tangent_angle) }
    }

    /// The rotation increment `Δω` of the followed section in some movements.
    pub fn increment(&self, moved: &[Movement]) -> f64 {
        self.place.weights().map(|(point, weight)| weight * moved[point][2]).sum()
    }

    pub fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let increment = self.increment(moved);
        self.angle += rotations.angle(increment);
        self.rotation = self.rotation.turned(rotations, increment).normalised();
    }

    /// Appends the angle that is followed to a state.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.angle, self.rotation.cos, self.rotation.sin]);
    }

    /// Takes the angle that is followed back from a state.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.angle = next();
        self.rotation = Rotation { cos: next(), sin: next() };
    }
}
