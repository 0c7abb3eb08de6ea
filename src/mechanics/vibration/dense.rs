//! Computation of all modes of a small scene together (docs/theory.md, section 15).
//!
//! One-sided Jacobi rotations compute large and small singular values to almost full accuracy (J. Demmel & K. Veselić 1992).

use nalgebra::DMatrix;

use super::VibrationError;
use super::elastic::FourVectors;
use super::lanczos::Pairs;
use super::pencil::Pencil;
use crate::elementary::hypot;
use crate::linalg::{STRIP_WIDTH, SymmetricFactors};

/// Largest scalar product of two columns that count as orthogonal, as a fraction of the product of their lengths.
const ORTHOGONAL: f64 = 1e-15;

/// Largest number of passes over all pairs of columns. About twelve passes are usual.
const MOST_SWEEPS: usize = 60;

/// Largest inertia that counts as zero after elimination, as a fraction of the diagonal entry of the inertia matrix.
const WITHOUT_INERTIA: f64 = 1e-13;

/// Computes an eigenvalue and a shape for each mode of a small scene, in decreasing order of the eigenvalues.
/// Degrees of freedom without inertia have the eigenvalue zero and are left out.
pub(super) fn all_pairs(
    pencil: &Pencil,
    factors: &SymmetricFactors,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Pairs, VibrationError> {
    let size = pencil.size();
    let mut columns = inertia_root(pencil);
    for mut column in columns.column_iter_mut() {
        for at in 0..size {
            let known = column[at];
            let (multipliers, inverse) = factors.column(at);
            for (below, multiplier) in (at + 1..size).zip(multipliers) {
                column[below] -= multiplier * known;
            }
            column[at] = known * inverse.sqrt();
        }
    }
    let values = rotate(&mut columns, goes_on)?;
    let mut order: Vec<usize> = (0..values.len()).filter(|at| values[*at] > 0.0).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    for (&at, value) in order.iter().zip(order.iter().map(|at| values[*at])) {
        let mut column = columns.column_mut(at);
        for row in (0..size).rev() {
            let (multipliers, inverse) = factors.column(row);
            let known = column.as_slice()[row + 1..].iter().zip(multipliers);
            let known: f64 = known.map(|(below, multiplier)| below * multiplier).sum();
            column[row] = column[row] / value * inverse.sqrt() - known;
        }
    }
    let mut shapes = columns.select_columns(&order);
    orthogonalise(pencil, &mut shapes);
    let strip = |first: usize| {
        let mut strip = pencil.zeros();
        for lane in 0..STRIP_WIDTH.min(order.len() - first) {
            for (to, from) in strip.iter_mut().zip(shapes.column(first + lane).iter()) {
                to[lane] = *from;
            }
        }
        strip
    };
    let strips: Vec<Vec<FourVectors>> = (0..order.len()).step_by(STRIP_WIDTH).map(strip).collect();
    Ok(Pairs { values: order.iter().map(|at| values[*at]).collect(), strips })
}

/// Orthogonalises the shapes of higher modes with respect to lower modes, and normalises all shapes with respect to the inertia.
/// The shapes must be orthogonalised, because their rounding errors may have little strain energy but much kinetic energy.
fn orthogonalise(pencil: &Pencil, shapes: &mut DMatrix<f64>) {
    let size = pencil.size();
    let mut momenta = vec![0.0; size];
    for at in 0..shapes.ncols() {
        let (lower, mut rest) = shapes.columns_range_pair_mut(..at, at..);
        let mut shape = rest.column_mut(0);
        for _ in 0..2 {
            for (row, momentum) in momenta.iter_mut().enumerate() {
                *momentum = pencil
                    .right_hand_matrix
                    .row(row)
                    .map(|(column, mass)| mass * shape[column])
                    .sum();
            }
            let square: f64 = shape.iter().zip(&momenta).map(|(x, m)| x * m).sum();
            let scale = 1.0 / square.sqrt();
            shape *= scale;
            for other in lower.column_iter() {
                let part: f64 = other.iter().zip(&momenta).map(|(x, m)| x * m).sum();
                shape.axpy(-part * scale, &other, 1.0);
            }
        }
    }
}

fn inertia_root(pencil: &Pencil) -> DMatrix<f64> {
    let size = pencil.size();
    let mut root = DMatrix::zeros(size, size);
    for row in 0..size {
        for (column, mass) in pencil.right_hand_matrix.row(row) {
            root[(row, column)] = if column <= row { mass } else { 0.0 };
        }
    }
    for column in 0..size {
        let whole = pencil.right_hand_matrix.diagonal(column);
        let left: f64 = root[(column, column)];
        let pivot = if left > WITHOUT_INERTIA * whole { left.sqrt() } else { 0.0 };
        for row in column..size {
            let entry: f64 = root[(row, column)];
            root[(row, column)] = if pivot > 0.0 { entry / pivot } else { 0.0 };
        }
        for to in column + 1..size {
            let factor: f64 = root[(to, column)];
            if factor != 0.0 {
                for row in to..size {
                    let entry: f64 = root[(row, column)];
                    root[(row, to)] -= factor * entry;
                }
            }
        }
    }
    root
}

pub(super) fn rotate(
    columns: &mut DMatrix<f64>,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<f64>, VibrationError> {
    let (rows, count) = columns.shape();
    let square = |column: &[f64]| column.iter().map(|entry| entry * entry).sum::<f64>();
    let mut sizes = Vec::new();
    for _ in 0..MOST_SWEEPS {
        // The column lengths are computed again in each pass, because updated lengths would accumulate rounding errors.
        sizes = columns.as_slice().chunks_exact(rows).map(square).collect();
        let mut is_turned = false;
        for first in 0..count {
            if !goes_on() {
                return Err(VibrationError::Interrupted);
            }
            let (before, behind) = columns.as_mut_slice().split_at_mut((first + 1) * rows);
            let one = &mut before[first * rows..];
            for (second, other) in (first + 1..count).zip(behind.chunks_exact_mut(rows)) {
                let product = one.iter().zip(&*other).map(|(a, b)| a * b).sum::<f64>();
                let (a, b) = (sizes[first], sizes[second]);
                if a * b == 0.0 || product.abs() <= ORTHOGONAL * (a * b).sqrt() {
                    continue;
                }
                is_turned = true;
                let cotangent = (b - a) / (2.0 * product);
                let tangent = cotangent.signum() / (cotangent.abs() + hypot(cotangent, 1.0));
                let cosine = 1.0 / hypot(tangent, 1.0);
                let sine = cosine * tangent;
                for (x, y) in one.iter_mut().zip(other) {
                    (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
                }
                sizes[first] = (a - tangent * product).max(0.0);
                sizes[second] = b + tangent * product;
            }
        }
        if !is_turned {
            return Ok(sizes);
        }
    }
    Ok(sizes)
}
