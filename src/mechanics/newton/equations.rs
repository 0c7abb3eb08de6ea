//! What the Newton solver asks of a set of equations.

use crate::linalg::BorderedMatrix;

/// How far a set of equations is from being satisfied.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResidualNorms {
    /// The largest unbalanced force, relative to the forces that should balance [-].
    pub force: f64,
    /// The largest mismatch between the strain of the section forces and that of the configuration [-].
    pub strain: f64,
    /// The largest violation of a constraint, relative to its size [-].
    pub constraint: f64,
}

impl ResidualNorms {
    /// Whether all parts of the imbalance are finite numbers.
    pub fn is_finite(&self) -> bool {
        [self.force, self.strain, self.constraint].iter().all(|part| part.is_finite())
    }

    /// Which part of the imbalance is the largest, or no number.
    pub fn worst(&self) -> ResidualPart {
        let others =
            [(ResidualPart::Strain, self.strain), (ResidualPart::Constraint, self.constraint)];
        let worst = |worst: (ResidualPart, f64), other: (ResidualPart, f64)| {
            if other.1 > worst.1 || other.1.is_nan() { other } else { worst }
        };
        others.into_iter().fold((ResidualPart::Force, self.force), worst).0
    }

    /// The largest part of the imbalance [-]; NaN if one of them is not a number.
    pub fn largest(&self) -> f64 {
        [self.strain, self.constraint].into_iter().fold(self.force, |largest, part| {
            if part > largest || part.is_nan() { part } else { largest }
        })
    }
}

/// A part of an imbalance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResidualPart {
    /// Forces that are not balanced.
    Force,
    /// Strains that do not match.
    Strain,
    /// Constraints that are violated.
    Constraint,
}

/// Nonlinear equations `R(u) = 0` in which unknowns of the integration points may hide.
///
/// The hidden ones (section forces) are condensed: they enter the linear system through
/// [`linearise`](Equations::linearise) and are updated by [`correct`](Equations::correct)
/// (Magisano, Leonetti & Garcea 2017, "mixed integration point" Newton).
pub trait Equations {
    /// Fills the condensed residual and tangent at `u`; both come zeroed.
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix);

    /// Condenses a residual that [`imbalance`](Equations::imbalance) has just filled in the manner of the last
    /// linearisation, whose factors can then correct it once more.
    fn condense(&mut self, residual: &mut [f64]);

    /// Carries a correction of `u`, found from the last linearisation, over to the hidden unknowns.
    fn correct(&mut self, correction: &[f64]);

    /// Fills the residual at `u` with the hidden unknowns as they are, and measures the imbalance.
    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms;
}
