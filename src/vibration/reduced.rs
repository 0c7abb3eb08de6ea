//! The dense eigenproblem.

use nalgebra::{DMatrix, SymmetricEigen};

/// Eigenvalues `μ = 1/(ω² + σ)` and their vectors.
pub(super) struct Pairs {
    /// In falling order: the lowest frequency first.
    pub(super) values: Vec<f64>,
    /// One vector a column, with `φᵀ (K + σ M) φ = 1`.
    pub(super) vectors: DMatrix<f64>,
}

/// All pairs of `M φ = μ (K + σ M) φ`; none if the shifted stiffness is not positive definite.
///
/// Inverted as it is, movements without inertia do no harm: theirs is `μ = 0`.
pub(super) fn pairs(shifted: DMatrix<f64>, inertia: &DMatrix<f64>) -> Option<Pairs> {
    let lower = shifted.cholesky()?.unpack();
    let half = lower.solve_lower_triangular(inertia)?;
    let inverted = lower.solve_lower_triangular(&half.transpose())?;
    let symmetric = (&inverted + inverted.transpose()) * 0.5;
    let SymmetricEigen { eigenvalues, eigenvectors } = symmetric.symmetric_eigen();
    let mut order: Vec<usize> = (0..eigenvalues.len()).collect();
    order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
    let sorted = eigenvectors.select_columns(&order);
    let vectors = lower.tr_solve_lower_triangular(&sorted)?;
    Some(Pairs { values: order.iter().map(|at| eigenvalues[*at]).collect(), vectors })
}
