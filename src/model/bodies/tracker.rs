//! Sections whose rotation is followed: stations, and places where loads turn with the beam.

use crate::beams::{Movement, Place, Rotation, RotationIncrement};

/// A place whose rotation is advanced with the steps.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) struct Tracker {
    pub(in crate::model) place: Place,
    /// Unwrapped angle of the section [rad].
    pub(in crate::model) angle: f64,
    pub(in crate::model) rotation: Rotation,
}

impl Tracker {
    pub(in crate::model) fn new(place: Place) -> Self {
        Self { place, angle: place.tangent_angle, rotation: Rotation::by(place.tangent_angle) }
    }

    /// `Δω` of movements.
    pub(in crate::model) fn increment(&self, moved: &[Movement]) -> f64 {
        self.place.weights().map(|(point, weight)| weight * moved[point][2]).sum()
    }

    pub(in crate::model) fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let increment = self.increment(moved);
        self.angle += rotations.angle(increment);
        self.rotation = self.rotation.turned(rotations, increment).normalised();
    }

    pub(in crate::model) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.angle, self.rotation.cos, self.rotation.sin]);
    }

    pub(in crate::model) fn restore(&mut self, [angle, cos, sin]: [f64; 3]) {
        (self.angle, self.rotation) = (angle, Rotation { cos, sin });
    }
}
