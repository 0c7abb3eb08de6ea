//! Solving with the factors of a banded matrix.
//!
//! What was found last enters a sum last: the sums of several rows are then under way at the same time.

use pulp::{Simd, WithSimd};

use super::banded::Storage;
use super::elimination::PANEL;

/// Forward and backward substitution with the factors of a banded matrix: replaces a right-hand side by the solution.
pub(super) struct Substitution<'a> {
    pub(super) factors: &'a Storage,
    pub(super) x: &'a mut [f64],
}

impl WithSimd for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, x } = self;
        match factors.reach {
            5 => substitute(factors, 5, x, |column| column + 5),
            8 => substitute(factors, 8, x, |column| column + 8),
            11 => substitute(factors, 11, x, |column| column + 11),
            reach => substitute(factors, reach, x, |column| column + reach),
        }
    }
}

/// The same with the factors of a matrix whose entries end at a profile.
pub(super) struct ProfileSubstitution<'a> {
    pub(super) factors: &'a Storage,
    pub(super) ends: &'a [usize],
    pub(super) x: &'a mut [f64],
}

impl WithSimd for ProfileSubstitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, ends, x } = self;
        substitute(factors, factors.reach, x, |column| ends[column]);
    }
}

/// Substitution with the factors of a banded matrix for several right-hand sides, the entries of a row side by side; rows before `first` must be zero.
pub(super) struct StripSubstitution<'a, const W: usize> {
    pub(super) factors: &'a Storage,
    pub(super) x: &'a mut [[f64; W]],
    pub(super) first: usize,
}

impl<const W: usize> WithSimd for StripSubstitution<'_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        substitute_strip(self.factors, self.x, self.first);
    }
}

/// `reach` is that of the factors; the multipliers of a column end in the row that `end` tells.
#[inline(always)]
fn substitute(factors: &Storage, reach: usize, x: &mut [f64], end: impl Fn(usize) -> usize) {
    let (size, stride, centre) = (factors.size, 3 * reach + PANEL, reach + PANEL - 1);
    let rows = factors.rows.as_slice();
    for first in (0..size).step_by(PANEL) {
        let columns = first..(first + PANEL).min(size);
        let is_exchanged = columns.clone().any(|column| factors.pivots[column] != column);
        if is_exchanged || columns.len() < PANEL {
            for column in columns {
                x.swap(column, factors.pivots[column]);
                let value = x[column];
                let multipliers = rows[column * stride + centre..].iter().step_by(stride - 1);
                let below = end(column) - column;
                for (entry, multiplier) in
                    x[column + 1..].iter_mut().take(below).zip(multipliers.skip(1))
                {
                    *entry -= multiplier * value;
                }
            }
            continue;
        }
        let below = end(first + PANEL - 1) + 1 - (first + PANEL);
        let panel = &rows[first * stride..][..(PANEL + below) * stride];
        let (row1, row2) = (&panel[stride + centre - 1..], &panel[2 * stride + centre - 2..]);
        let (known, unknown) = x[first..].split_at_mut(PANEL);
        let x0 = known[0];
        let x1 = known[1] - row1[0] * x0;
        let x2 = known[2] - row2[0] * x0 - row2[1] * x1;
        (known[1], known[2]) = (x1, x2);
        let rows_below = panel[PANEL * stride..].chunks_exact(stride);
        for (index, (row, entry)) in rows_below.zip(unknown.iter_mut().take(below)).enumerate() {
            let multipliers = &row[reach - 1 - index..][..PANEL];
            *entry = *entry - multipliers[0] * x0 - multipliers[1] * x1 - multipliers[2] * x2;
        }
    }
    for row in (0..size).rev() {
        let last = factors.last_columns[row].min(size - 1);
        let diagonal = row * stride + centre;
        let upper = &rows[diagonal..][..=last - row];
        let known = &x[row..=last];
        x[row] = if known.len() == reach + 1 {
            back_substitute(&upper[..=reach], &known[..=reach])
        } else {
            back_substitute(upper, known)
        };
    }
}

/// The unknown of a row, the first of those that stand in it.
#[inline(always)]
fn back_substitute(row: &[f64], x: &[f64]) -> f64 {
    let known = row[1..].iter().zip(&x[1..]).rev();
    known.fold(x[0], |rest, (entry, x)| rest - entry * x) * row[0]
}

#[inline(always)]
fn substitute_strip<const W: usize>(factors: &Storage, x: &mut [[f64; W]], first: usize) {
    let (size, reach, stride) = (factors.size, factors.reach, factors.stride());
    let rows = factors.rows.as_slice();
    // Row exchanges reach back by at most the half-bandwidth.
    for column in first.saturating_sub(reach)..size {
        x.swap(column, factors.pivots[column]);
        let value = x[column];
        let multipliers = rows[column * stride + factors.centre()..].iter().step_by(stride - 1);
        for (target, multiplier) in x[column + 1..].iter_mut().take(reach).zip(multipliers.skip(1))
        {
            target.iter_mut().zip(&value).for_each(|(x, value)| *x -= multiplier * value);
        }
    }
    for row in (0..size).rev() {
        let last = factors.last_columns[row].min(size - 1);
        let diagonal = row * stride + factors.centre();
        let upper = &rows[diagonal + 1..][..last - row];
        let mut value = x[row];
        for (entry, known) in upper.iter().zip(&x[row + 1..=last]).rev() {
            value.iter_mut().zip(known).for_each(|(x, known)| *x -= entry * known);
        }
        let inverse = rows[diagonal];
        x[row] = value.map(|x| x * inverse);
    }
}
