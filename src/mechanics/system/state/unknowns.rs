//! Unknowns of a model: free degrees of freedom, and forces of rigid links and rollers.

use crate::joints::Releasable;

/// Type of an unknown, which determines the unit of the unknown and of its equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnknownKind {
    /// Displacement along an axis [length]. Its equation is a force balance.
    Position,
    /// Rotation [rad]. Its equation is a moment balance.
    Rotation,
    /// Constraint force [force], or impulse of this force in a time step [force·time]. Its equation is a condition on a length.
    Force,
}

pub struct Unknowns {
    kinds: Vec<UnknownKind>,
    half_bandwidth: usize,
    released: Vec<Releasable>,
}

impl Unknowns {
    pub fn new(kinds: Vec<UnknownKind>, half_bandwidth: usize, released: &[Releasable]) -> Self {
        Self { kinds, half_bandwidth, released: released.to_vec() }
    }

    pub fn count(&self) -> usize {
        self.kinds.len()
    }

    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Returns true if the given joint or drive had been released when the unknowns were numbered.
    pub fn are_free_of(&self, hold: Releasable) -> bool {
        self.released.contains(&hold)
    }

    pub fn kinds(&self) -> &[UnknownKind] {
        &self.kinds
    }

    pub fn largest(&self, values: &[f64]) -> (f64, f64) {
        // The bit patterns of magnitudes, read as integers, are ordered like the magnitudes. NaN is the largest.
        let magnitude = |value: &f64| value.abs().to_bits();
        let (mut position, mut rotation) = (0, 0);
        for (value, kind) in values.iter().zip(&self.kinds) {
            let of = |wanted| if *kind == wanted { magnitude(value) } else { 0 };
            position = position.max(of(UnknownKind::Position));
            rotation = rotation.max(of(UnknownKind::Rotation));
        }
        (f64::from_bits(position), f64::from_bits(rotation))
    }
}
