//! Substitution with the factors of a banded matrix.
//!
//! Each sum adds the most recently computed value last, so that the processor can evaluate the sums of several rows concurrently.

use pulp::{Simd, WithSimd};

use super::elimination::PANEL;
use super::fixed_band;
use super::storage::Factors;

pub(super) struct Substitution<'a> {
    pub(super) factors: Factors<'a>,
    pub(super) x: &'a mut [f64],
}

impl WithSimd for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factors, x } = self;
        Forward { factors, x: &mut *x }.with_simd(simd);
        Backward { factors, x }.with_simd(simd);
    }
}

pub(super) struct Forward<'a> {
    pub(super) factors: Factors<'a>,
    pub(super) x: &'a mut [f64],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, x } = self;
        match factors.reach {
            6 => substitute_forward_fixed::<6, 22>(&factors, x),
            8 => substitute_forward_fixed::<8, 28>(&factors, x),
            11 => substitute_forward_fixed::<11, 37>(&factors, x),
            reach => substitute_forward(&factors, reach, x, |column| column + reach),
        }
    }
}

pub(super) struct Backward<'a> {
    pub(super) factors: Factors<'a>,
    pub(super) x: &'a mut [f64],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, x } = self;
        match factors.reach {
            6 => substitute_backward_fixed::<6, 22>(&factors, x),
            8 => substitute_backward_fixed::<8, 28>(&factors, x),
            11 => substitute_backward_fixed::<11, 37>(&factors, x),
            reach => substitute_backward(&factors, reach, x),
        }
    }
}

pub(super) struct ProfileSubstitution<'a> {
    pub(super) factors: Factors<'a>,
    pub(super) ends: &'a [usize],
    pub(super) x: &'a mut [f64],
}

impl WithSimd for ProfileSubstitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, ends, x } = self;
        substitute_forward(&factors, factors.reach, x, |column| ends[column]);
        substitute_backward(&factors, factors.reach, x);
    }
}

pub(super) struct StripSubstitution<'a, const W: usize> {
    pub(super) factors: Factors<'a>,
    pub(super) x: &'a mut [[f64; W]],
    pub(super) first: usize,
}

impl<const W: usize> WithSimd for StripSubstitution<'_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        substitute_strip(&self.factors, self.x, self.first);
    }
}

#[inline(always)]
fn substitute_forward(
    factors: &Factors<'_>,
    reach: usize,
    x: &mut [f64],
    end: impl Fn(usize) -> usize,
) {
    for first in (0..factors.columns).step_by(PANEL) {
        substitute_panel(factors, reach, x, first, &end);
    }
}

#[inline(always)]
fn substitute_backward(factors: &Factors<'_>, reach: usize, x: &mut [f64]) {
    for row in (0..factors.columns).rev() {
        substitute_row(factors, reach, x, row);
    }
}

#[inline(always)]
fn substitute_forward_fixed<const REACH: usize, const STRIDE: usize>(
    factors: &Factors<'_>,
    x: &mut [f64],
) {
    let (columns, end) = (factors.columns, |column| column + REACH);
    let (rows, _) = factors.rows.as_chunks::<STRIDE>();
    for first in (0..columns).step_by(PANEL) {
        if factors.is_exchanged(first..(first + PANEL).min(columns)) {
            substitute_panel(factors, REACH, x, first, &end);
            continue;
        }
        let (panel, below) = rows[first..].split_first_chunk().expect("rows of a panel");
        let below = below.first_chunk().expect("rows below it, or of the identity behind the last");
        let (known, unknown) = x[first..].split_at_mut(PANEL.min(columns - first));
        match (known.first_chunk_mut(), unknown.first_chunk_mut()) {
            (Some(known), Some(unknown)) => {
                fixed_band::substitute_forward::<REACH, STRIDE>(panel, below, known, unknown);
            }
            _ => substitute_panel(factors, REACH, x, first, &end),
        }
    }
}

#[inline(always)]
fn substitute_backward_fixed<const REACH: usize, const STRIDE: usize>(
    factors: &Factors<'_>,
    x: &mut [f64],
) {
    let (rows, _) = factors.rows.as_chunks::<STRIDE>();
    for row in (0..factors.columns).rev() {
        match x[row + 1..].first_chunk() {
            Some(behind) if factors.last_columns[row] == row + REACH => {
                x[row] =
                    fixed_band::substitute_backward::<REACH, STRIDE>(&rows[row], x[row], behind);
            }
            _ => substitute_row(factors, REACH, x, row),
        }
    }
}

#[inline(always)]
fn substitute_panel(
    factors: &Factors<'_>,
    reach: usize,
    x: &mut [f64],
    first: usize,
    end: &impl Fn(usize) -> usize,
) {
    let (stride, centre) = (3 * reach + PANEL, reach + PANEL - 1);
    let rows = factors.rows;
    let columns = first..(first + PANEL).min(factors.columns);
    if columns.len() < PANEL || factors.is_exchanged(columns.clone()) {
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
        return;
    }
    let below = end(first + PANEL - 1) + 1 - (first + PANEL);
    let panel = &rows[first * stride..][..(PANEL + below) * stride];
    let (known, unknown) = x[first..].split_at_mut(PANEL);
    let Some(known) = known.first_chunk_mut::<PANEL>() else {
        return;
    };
    for index in 1..PANEL {
        for column in 0..index {
            known[index] -= panel[index * stride + centre - index + column] * known[column];
        }
    }
    let rows_below = panel[PANEL * stride..].chunks_exact(stride);
    for (index, (row, entry)) in rows_below.zip(unknown.iter_mut().take(below)).enumerate() {
        let multipliers = &row[reach - 1 - index..][..PANEL];
        for (multiplier, known) in multipliers.iter().zip(&*known) {
            *entry -= multiplier * known;
        }
    }
}

#[inline(always)]
fn substitute_row(factors: &Factors<'_>, reach: usize, x: &mut [f64], row: usize) {
    let (stride, centre) = (3 * reach + PANEL, reach + PANEL - 1);
    let last = factors.last_columns[row].min(x.len() - 1);
    let upper = &factors.rows[row * stride + centre..][..=last - row];
    let known = &x[row..=last];
    x[row] = if known.len() == reach + 1 {
        back_substitute(&upper[..=reach], &known[..=reach])
    } else {
        back_substitute(upper, known)
    };
}

#[inline(always)]
fn back_substitute(row: &[f64], x: &[f64]) -> f64 {
    let known = row[1..].iter().zip(&x[1..]).rev();
    known.fold(x[0], |rest, (entry, x)| rest - entry * x) * row[0]
}

#[inline(always)]
fn substitute_strip<const W: usize>(factors: &Factors<'_>, x: &mut [[f64; W]], first: usize) {
    let (size, reach, rows) = (factors.size, factors.reach, factors.rows);
    let (stride, centre) = (3 * reach + PANEL, reach + PANEL - 1);
    for column in first.saturating_sub(reach)..size {
        x.swap(column, factors.pivots[column]);
        let value = x[column];
        let multipliers = rows[column * stride + centre..].iter().step_by(stride - 1);
        for (target, multiplier) in x[column + 1..].iter_mut().take(reach).zip(multipliers.skip(1))
        {
            target.iter_mut().zip(&value).for_each(|(x, value)| *x -= multiplier * value);
        }
    }
    for row in (0..size).rev() {
        let last = factors.last_columns[row].min(size - 1);
        let diagonal = row * stride + centre;
        let upper = &rows[diagonal + 1..][..last - row];
        let mut value = x[row];
        for (entry, known) in upper.iter().zip(&x[row + 1..=last]).rev() {
            value.iter_mut().zip(known).for_each(|(x, known)| *x -= entry * known);
        }
        let inverse = rows[diagonal];
        x[row] = value.map(|x| x * inverse);
    }
}
