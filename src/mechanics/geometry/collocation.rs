//! Linear systems of equations for the collocation of splines.

use std::ops::{AddAssign, Div, Mul, SubAssign};

pub(super) struct CollocationRow<R> {
    pub(super) first: usize,
    pub(super) entries: Vec<f64>,
    pub(super) right_side: R,
}

/// Solves a banded system by Gaussian elimination without row exchanges.
/// The elimination is stable for the totally positive matrices of B-spline collocation (de Boor & Pinkus 1977, Numer. Math. 27).
pub(super) fn solve<R>(mut rows: Vec<CollocationRow<R>>) -> Vec<R>
where
    R: Copy + Default + AddAssign + SubAssign + Mul<f64, Output = R> + Div<f64, Output = R>,
{
    for r in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(r);
        let row = &mut rest[0];
        for (k, pivot) in done.iter().enumerate().skip(row.first) {
            let factor = row.entries[k - row.first] / pivot.entries[k - pivot.first];
            let tail = &pivot.entries[k - pivot.first..];
            for (entry, above) in row.entries[k - row.first..].iter_mut().zip(tail) {
                *entry -= factor * above;
            }
            row.right_side -= pivot.right_side * factor;
        }
    }
    let mut solution = vec![R::default(); rows.len()];
    for (r, row) in rows.iter().enumerate().rev() {
        let (pivot, beyond) = (row.entries[r - row.first], &row.entries[r - row.first + 1..]);
        let mut known = R::default();
        for (entry, value) in beyond.iter().zip(&solution[r + 1..]) {
            known += *value * *entry;
        }
        let mut right_side = row.right_side;
        right_side -= known;
        solution[r] = right_side / pivot;
    }
    solution
}
