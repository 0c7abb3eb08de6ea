//! The lowest modes of a large scene, by subspace iteration with a shifted and inverted stiffness.
//!
//! K.-J. Bathe, Finite Element Procedures, 2nd ed. (2014), section 11.6.

use nalgebra::DMatrix;

use super::pencil::Pencil;
use super::reduced::{Pairs, pairs};

/// Iterations end when the eigenvalues change by less than this part of themselves.
const SETTLED: f64 = 1e-13;

/// Most iterations. With twice as many vectors as modes the error of a beam's falls by 256 in each.
const MOST_ITERATIONS: usize = 60;

/// The pairs of a few more than `count` modes; none if the shifted stiffness cannot be factorised or is not positive definite.
pub(super) fn lowest_pairs(pencil: &Pencil, shift: f64, count: usize) -> Option<Pairs> {
    let size = pencil.size();
    let width = (2 * count).max(count + 8).min(size);
    let mut matrix = pencil.shifted_band(shift);
    let factors = matrix.factorise().ok()?;
    let mut vectors = DMatrix::from_fn(size, width, scattered);
    let mut loads = DMatrix::zeros(size, width);
    let mut before = vec![0.0; count];
    for _ in 0..MOST_ITERATIONS {
        for (vector, mut load) in vectors.column_iter().zip(loads.column_iter_mut()) {
            pencil.inertia_times(vector.as_slice(), load.as_mut_slice());
        }
        vectors.copy_from(&loads);
        vectors.column_iter_mut().for_each(|mut vector| factors.solve(vector.as_mut_slice()));
        let stiffness = vectors.tr_mul(&loads);
        for (vector, mut load) in vectors.column_iter().zip(loads.column_iter_mut()) {
            pencil.inertia_times(vector.as_slice(), load.as_mut_slice());
        }
        let inertia = vectors.tr_mul(&loads);
        let symmetric = |of: DMatrix<f64>| (&of + of.transpose()) * 0.5;
        let Pairs { values, vectors: turned } = pairs(symmetric(stiffness), &symmetric(inertia))?;
        vectors *= turned;
        let is_settled = before
            .iter()
            .zip(&values)
            .all(|(before, value)| (before - value).abs() <= SETTLED * value.abs());
        if is_settled {
            return Some(Pairs { values, vectors });
        }
        before.copy_from_slice(&values[..count]);
    }
    None
}

/// Numbers without pattern, always the same.
fn scattered(row: usize, column: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    ((row + 1) as f64 * golden * (column + 1) as f64).fract() - 0.5
}
