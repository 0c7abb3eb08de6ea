//! The unknowns of a model: movements, and forces of rigid links among them.

use crate::joints::Releasable;

/// What an unknown is, and with it the equation of the same number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnknownKind {
    /// A movement along an axis [length], balanced by forces.
    Position,
    /// A rotation [rad], balanced by moments.
    Rotation,
    /// The force of a rigid link, in steps its impulse [force, force·time]; its equation is a length.
    Force,
}

/// The unknowns of a model: how many there are, of which kinds, and how far they reach in a matrix.
pub struct Unknowns {
    kinds: Vec<UnknownKind>,
    half_bandwidth: usize,
    /// What has let go, so that its movements are unknowns of their own.
    released: Vec<Releasable>,
}

impl Unknowns {
    /// The unknowns of a model of these kinds, with the half-bandwidth of the matrices of a step, where these joints and drives have let go.
    pub fn new(kinds: Vec<UnknownKind>, half_bandwidth: usize, released: &[Releasable]) -> Self {
        Self { kinds, half_bandwidth, released: released.to_vec() }
    }

    /// The number of unknowns of the model.
    pub fn count(&self) -> usize {
        self.kinds.len()
    }

    /// The half-bandwidth of the matrices of a step: how far from the diagonal they have entries.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Whether a joint or a drive has let go.
    pub fn are_free_of(&self, hold: Releasable) -> bool {
        self.released.contains(&hold)
    }

    /// What the unknowns are, one entry for each.
    pub fn kinds(&self) -> &[UnknownKind] {
        &self.kinds
    }

    /// The largest magnitudes among the entries of positions and among those of rotations.
    pub fn largest(&self, values: &[f64]) -> (f64, f64) {
        // As whole numbers, magnitudes are in the same order, and what is no number is the largest.
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
