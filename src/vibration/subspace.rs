//! The lowest modes of a large scene, by subspace iteration with a shifted and inverted stiffness.
//!
//! K.-J. Bathe, Finite Element Procedures, 2nd ed. (2014), section 11.6.

use nalgebra::DMatrix;

use super::VibrationError;
use super::pencil::Pencil;
use super::reduced::{Pairs, pairs};
use crate::linalg::negative_eigenvalues;

/// Why there are no pairs.
pub(super) enum Refusal {
    /// A larger shift may help.
    NotDefinite,
    /// Nothing will.
    Final(VibrationError),
}

/// Iterations end when no shifted square changes by more than this part of itself, and rounding.
const SETTLED: f64 = 1e-12;

/// By how many times what rounding may add to a square it may go on changing.
const SETTLED_ROUNDING: f64 = 16.0;

/// Most iterations. With twice as many vectors as modes the error of a beam's falls by 256 in each.
const MOST_ITERATIONS: usize = 60;

/// The pairs of a few more than `count` modes.
///
/// # Errors
/// When the shifted stiffness cannot be factorised or is not positive definite, the iteration does not settle, or is stopped.
pub(super) fn lowest_pairs(
    pencil: &Pencil,
    shift: f64,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Pairs, Refusal> {
    let size = pencil.size();
    let mut matrix = pencil.shifted_band(shift);
    // Iteration would pass by an unstable mode far below the shift.
    if negative_eigenvalues(&matrix) > 0 {
        return Err(Refusal::NotDefinite);
    }
    let width = width(size, count);
    let factors = matrix.factorise().map_err(|_| Refusal::NotDefinite)?;
    let mut vectors = DMatrix::from_fn(size, width, scattered);
    let mut before = vec![f64::INFINITY; count];
    for _ in 0..MOST_ITERATIONS {
        if !goes_on() {
            return Err(Refusal::Final(VibrationError::Interrupted));
        }
        vectors = pencil.inertia_times(&vectors);
        vectors.column_iter_mut().for_each(|mut vector| factors.solve(vector.as_mut_slice()));
        // Rigid motions outgrow all others by far: what is left of these shows beside them only after orthogonalisation.
        vectors = vectors.qr().q();
        let project = |of: DMatrix<f64>| {
            let projected = vectors.tr_mul(&of);
            (&projected + projected.transpose()) * 0.5
        };
        let stiffness = project(pencil.shifted_times(shift, &vectors));
        let inertia = project(pencil.inertia_times(&vectors));
        let Pairs { values, vectors: turned } =
            pairs(stiffness, &inertia).ok_or(Refusal::NotDefinite)?;
        vectors *= turned;
        let shifted_squares: Vec<f64> = values[..count].iter().map(|value| 1.0 / value).collect();
        let is_settled = before.iter().zip(&shifted_squares).all(|(before, now)| {
            (before - now).abs() <= SETTLED * now.abs() + SETTLED_ROUNDING * pencil.rounding
        });
        if is_settled {
            return Ok(Pairs { values, vectors });
        }
        before = shifted_squares;
    }
    Err(Refusal::Final(VibrationError::Unsettled { iterations: MOST_ITERATIONS }))
}

/// How many vectors are iterated for so many modes.
pub(super) fn width(size: usize, count: usize) -> usize {
    (2 * count).max(count + 8).min(size)
}

/// Numbers without pattern, always the same.
fn scattered(row: usize, column: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    ((row + 1) as f64 * golden * (column + 1) as f64).fract() - 0.5
}
