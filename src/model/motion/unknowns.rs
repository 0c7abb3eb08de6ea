//! The unknown movements of a model.

use crate::geometry::larger;

/// The unknown movements of a model: how many there are, which are rotations, and how far they reach in a matrix.
pub struct Unknowns {
    is_rotation: Vec<bool>,
    half_bandwidth: usize,
}

impl Unknowns {
    /// Unknowns of which some are rotations, with the half-bandwidth of the matrices of a step.
    pub fn new(is_rotation: Vec<bool>, half_bandwidth: usize) -> Self {
        Self { is_rotation, half_bandwidth }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.is_rotation.len()
    }

    /// How far from the diagonal matrices reach.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Which are rotations.
    pub fn rotations(&self) -> &[bool] {
        &self.is_rotation
    }

    /// The largest magnitudes among the entries of positions and among those of rotations.
    pub fn largest(&self, values: &[f64]) -> (f64, f64) {
        let entries = values.iter().zip(&self.is_rotation);
        entries.fold((0.0, 0.0), |(force, moment), (value, rotation)| {
            if *rotation {
                (force, larger(moment, value.abs()))
            } else {
                (larger(force, value.abs()), moment)
            }
        })
    }
}
