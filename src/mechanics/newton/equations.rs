//! Interface between the Newton solver and the equations to be solved.

use crate::linalg::BorderedMatrix;

/// Relative norms of the parts of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResidualNorms {
    /// Largest residual force, as a fraction of the scale of the forces [-].
    pub force: f64,
    /// Largest difference between the strains of the section forces and the strains of the configuration [-].
    pub strain: f64,
    /// Largest constraint violation, as a fraction of its scale [-].
    pub constraint: f64,
}

impl ResidualNorms {
    /// Returns true if all norms are finite.
    pub fn is_finite(&self) -> bool {
        [self.force, self.strain, self.constraint].iter().all(|part| part.is_finite())
    }

    /// Part whose norm is the largest, or NaN.
    pub fn worst(&self) -> ResidualPart {
        let others =
            [(ResidualPart::Strain, self.strain), (ResidualPart::Constraint, self.constraint)];
        let worst = |worst: (ResidualPart, f64), other: (ResidualPart, f64)| {
            if other.1 > worst.1 || other.1.is_nan() { other } else { worst }
        };
        others.into_iter().fold((ResidualPart::Force, self.force), worst).0
    }

    /// Largest norm [-]; NaN if one is NaN.
    pub fn largest(&self) -> f64 {
        [self.strain, self.constraint].into_iter().fold(self.force, |largest, part| {
            if part > largest || part.is_nan() { part } else { largest }
        })
    }
}

/// Part of the residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResidualPart {
    /// Force balance.
    Force,
    /// Strain mismatch.
    Strain,
    /// Constraint violation.
    Constraint,
}

/// Nonlinear equations `R(u) = 0`. They may have internal unknowns at integration points.
///
/// The internal unknowns (section forces) are condensed out.
/// They enter the linear system through [`linearise`](Equations::linearise) and are updated by [`correct`](Equations::correct) (Magisano,
/// Leonetti & Garcea 2017, "mixed integration point" Newton).
pub trait Equations {
    /// Computes residual and tangent at `u`, with internal unknowns condensed out. Both are zero on entry.
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix);

    /// Prepares a correction with the factors of the last linearisation:
    /// condenses the internal unknowns out of the residual that the last call of [`imbalance`](Equations::imbalance) computed.
    fn condense(&mut self, residual: &mut [f64]);

    /// Updates the internal unknowns after a correction of `u`, by means of the last linearisation.
    fn correct(&mut self, correction: &[f64]);

    /// Computes the residual at `u` with the present internal unknowns, and returns its norms.
    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms;

    /// Called before every iteration. Returns false to stop the solution.
    fn goes_on(&mut self) -> bool {
        true
    }
}
