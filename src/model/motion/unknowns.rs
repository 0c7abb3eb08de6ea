//! The unknown movements of a model.

use crate::geometry::larger;

/// The unknown movements of a model: how many there are, which are rotations, and how far they reach in a matrix.
pub struct Unknowns {
    is_rotation: Vec<bool>,
    half_bandwidth: usize,
}

impl Unknowns {
    /// The unknown movements of a model, of which some are rotations, with the half-bandwidth of the matrices of a step.
    pub fn new(is_rotation: Vec<bool>, half_bandwidth: usize) -> Self {
        Self { is_rotation, half_bandwidth }
    }

    /// The number of unknown movements of the model.
    pub fn count(&self) -> usize {
        self.is_rotation.len()
    }

    /// The half-bandwidth of the matrices of a step: how far from the diagonal they have entries.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Which unknown movements are rotations, one entry for each.
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
