//! Interface between the Newton solver and the equations to be solved.

use crate::linalg::BorderedMatrix;

/// Relative norms of the parts of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResidualNorms {
    /// Largest residual force, as a fraction of the scale of the forces [-].
    pub force: f64,
    /// Largest strain residual: strain of the configuration minus the strain that belongs to the section force [-].
    pub strain: f64,
    /// Largest constraint violation, as a fraction of the scale of the constraint [-].
    pub constraint: f64,
}

impl ResidualNorms {
    /// Returns true if the norms of all parts of the residual are finite.
    pub fn is_finite(&self) -> bool {
        [self.force, self.strain, self.constraint].iter().all(|part| part.is_finite())
    }

    /// Part of the residual with the largest norm, or with a norm that is NaN.
    pub fn worst(&self) -> ResidualPart {
        let others =
            [(ResidualPart::Strain, self.strain), (ResidualPart::Constraint, self.constraint)];
        let worst = |worst: (ResidualPart, f64), other: (ResidualPart, f64)| {
            if other.1 > worst.1 || other.1.is_nan() { other } else { worst }
        };
        others.into_iter().fold((ResidualPart::Force, self.force), worst).0
    }

    /// Largest norm of the parts of the residual [-]; NaN if a norm is NaN.
    pub fn largest(&self) -> f64 {
        [self.strain, self.constraint].into_iter().fold(self.force, |largest, part| {
            if part > largest || part.is_nan() { part } else { largest }
        })
    }
}

/// Part of the residual of the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResidualPart {
    /// Residual of the force balance.
    Force,
    /// Strain residual.
    Strain,
    /// Constraint violation.
    Constraint,
}

/// Nonlinear equations `R(u) = 0` for the unknowns `u`, which may have internal unknowns at quadrature points.
///
/// The internal unknowns (section forces) are eliminated from the linear system.
/// The elimination is the "mixed integration point" Newton method (Magisano, Leonetti & Garcea 2017).
pub trait Equations {
    /// Computes residual and tangent at the unknowns `u`, with the internal unknowns eliminated.
    /// Residual and tangent must be zero on entry.
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix);

    /// Eliminates internal unknowns from a residual, for a correction with earlier matrix factors.
    /// The residual must be the result of the last call of [`imbalance`](Equations::imbalance).
    fn condense(&mut self, residual: &mut [f64]);

    /// Updates the internal unknowns after a correction of the unknowns `u`, using the last linearisation.
    fn correct(&mut self, correction: &[f64]);

    /// Computes the residual at the unknowns `u` with the present internal unknowns, and returns its norms.
    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms;

    /// Callback before every iteration. If it returns false, the solution is stopped.
    fn goes_on(&mut self) -> bool {
        true
    }
}
