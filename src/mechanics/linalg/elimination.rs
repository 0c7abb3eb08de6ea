//! Gaussian elimination of a banded matrix, several columns at a time.
//!
//! A panel of columns is eliminated without row exchanges where no multiplier is large, which a pass over the panel alone
//! finds out (threshold pivoting: Duff, Erisman & Reid, Direct Methods for Sparse Matrices, 2nd ed., section 5.2). The rows
//! below are then updated once for the whole panel, and nothing fills in. Where a multiplier is large, the columns of the
//! panel are eliminated one by one with partial pivoting.
//!
//! Where the entries of a matrix end at a profile of their own, column by column, rows and columns beyond it are left out: row exchanges
//! and fill-in stay inside a profile that never falls.

use pulp::{Simd, WithSimd};

use super::LinearError;
use super::banded::Storage;

/// The number of columns of a banded matrix that are eliminated together: those of a control point.
pub(super) const PANEL: usize = 3;

/// Numbers that vector instructions treat at once.
const LANES: usize = 4;

/// The smallest half-bandwidth for which a row of a banded matrix has room for a panel, and for whole vectors behind it.
pub(super) const SMALLEST_REACH: usize = PANEL + LANES - 2;

/// The largest multiplier for which rows are not exchanged.
const LARGEST_MULTIPLIER: f64 = 8.0;

/// Gauss's elimination with row exchanges, which replaces a banded matrix by its factors, panel by panel.
pub(super) struct Elimination<'a>(pub(super) &'a mut Storage);

impl WithSimd for Elimination<'_> {
    type Output = Result<(), LinearError>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        // The half-bandwidths of beams of degree 1 to 3 are known to the compiler.
        match self.0.reach {
            5 => eliminate(simd, self.0, 5),
            8 => eliminate(simd, self.0, 8),
            11 => eliminate(simd, self.0, 11),
            reach => eliminate(simd, self.0, reach),
        }
    }
}

/// The same where the entries of a matrix end at a profile: for each index the last row with an entry in the column, which is the last column with
/// one in the row. It never falls, and goes on for a panel behind the last row.
pub(super) struct ProfileElimination<'a>(pub(super) &'a mut Storage, pub(super) &'a [usize]);

impl WithSimd for ProfileElimination<'_> {
    type Output = Result<(), LinearError>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        eliminate_in_profile(simd, self.0, self.1)
    }
}

/// `reach` is that of the storage.
#[inline(always)]
fn eliminate<S: Simd>(simd: S, storage: &mut Storage, reach: usize) -> Result<(), LinearError> {
    // The last column in which a row above has an entry.
    let mut filled = 0;
    for first in (0..storage.size).step_by(PANEL) {
        let next = first + PANEL;
        let width = filled.max(next - 1 + reach) + 1 - next;
        let is_eliminated = if width == reach {
            // Behind the last column with an entry there are zeros.
            let width = reach.next_multiple_of(LANES);
            eliminate_panel(simd, storage, first, [reach, reach], width)
        } else {
            eliminate_panel(simd, storage, first, [reach, reach], width)
        };
        let columns = first..next.min(storage.size);
        if is_eliminated {
            for column in columns {
                filled = filled.max(column + reach);
                storage.pivots[column] = column;
                storage.last_columns[column] = filled;
            }
        } else {
            for column in columns {
                filled = eliminate_column(storage, column, filled, |index| index + reach)?;
            }
        }
    }
    Ok(())
}

#[inline(always)]
fn eliminate_in_profile<S: Simd>(
    simd: S,
    storage: &mut Storage,
    ends: &[usize],
) -> Result<(), LinearError> {
    let reach = storage.reach;
    let mut filled = 0;
    for first in (0..storage.size).step_by(PANEL) {
        let next = first + PANEL;
        let below = ends[next - 1] + 1 - next;
        let width = filled.max(ends[next - 1]) + 1 - next;
        // Zeros stand behind the last column, and below the last row, with an entry; those of cubic beams and of a point that slides from one
        // span to the next are known to the compiler.
        let is_eliminated = match below.max(width) {
            ..=9 if reach > 10 => eliminate_panel(simd, storage, first, [reach, 9], 12),
            ..=11 if reach > 10 => eliminate_panel(simd, storage, first, [reach, 11], 12),
            12 if reach > 11 => eliminate_panel(simd, storage, first, [reach, 12], 12),
            _ => {
                let whole = width.next_multiple_of(LANES);
                let width = if whole < 2 * reach { whole } else { width };
                eliminate_panel(simd, storage, first, [reach, below], width)
            }
        };
        for column in first..next.min(storage.size) {
            if is_eliminated {
                filled = filled.max(ends[column]);
                storage.pivots[column] = column;
                storage.last_columns[column] = filled;
            } else {
                filled = eliminate_column(storage, column, filled, |index| ends[index])?;
            }
        }
    }
    Ok(())
}

/// Eliminates the columns of a panel from so many rows below it, in so many columns behind it; false, with nothing changed,
/// when rows should be exchanged. The first of the `reach`es is that of the storage.
#[inline(always)]
fn eliminate_panel<S: Simd>(
    simd: S,
    storage: &mut Storage,
    first: usize,
    [reach, below]: [usize; 2],
    width: usize,
) -> bool {
    let (stride, centre) = (3 * reach + PANEL, reach + PANEL - 1);
    let rows = &mut storage.rows[first * stride..][..(PANEL + below) * stride];
    let (panel, rows_below) = rows.split_at_mut(PANEL * stride);
    let (row0, rest) = panel.split_at_mut(stride);
    let (row1, row2) = rest.split_at_mut(stride);
    let (row0, row1, row2) =
        (&mut row0[centre..], &mut row1[centre - 1..], &mut row2[centre - 2..]);

    let [u00, u01, u02] = [row0[0], row0[1], row0[2]];
    let inverse0 = 1.0 / u00;
    let l10 = row1[0] * inverse0;
    let [u11, u12] = [row1[1] - l10 * u01, row1[2] - l10 * u02];
    let inverse1 = 1.0 / u11;
    let l20 = row2[0] * inverse0;
    let l21 = (row2[1] - l20 * u01) * inverse1;
    let u22 = row2[2] - l20 * u02 - l21 * u12;
    let inverse2 = 1.0 / u22;

    let is_small = |multiplier: f64| multiplier.abs() <= LARGEST_MULTIPLIER;
    let mut is_stable = is_small(l10) & is_small(l20) & is_small(l21);
    is_stable &= u00.is_finite() & u11.is_finite() & u22.is_finite();
    let multipliers = &mut storage.multipliers[..below];
    for (index, (row, found)) in rows_below.chunks_exact(stride).zip(&mut *multipliers).enumerate()
    {
        let entries = &row[reach - 1 - index..][..PANEL];
        let l0 = entries[0] * inverse0;
        let l1 = (entries[1] - l0 * u01) * inverse1;
        let l2 = (entries[2] - l0 * u02 - l1 * u12) * inverse2;
        is_stable &= is_small(l0) & is_small(l1) & is_small(l2);
        *found = [l0, l1, l2];
    }
    if !is_stable {
        return false;
    }

    (row0[0], row1[1], row2[2]) = (inverse0, inverse1, inverse2);
    (row1[0], row2[0], row2[1]) = (l10, l20, l21);
    row1[2] = u12;
    let (row0, row1, row2) =
        (&row0[PANEL..][..width], &mut row1[PANEL..][..width], &mut row2[PANEL..][..width]);
    subtract(simd, [l10], [row0], row1);
    subtract(simd, [l20, l21], [row0, row1], row2);
    for (index, (row, found)) in rows_below.chunks_exact_mut(stride).zip(multipliers).enumerate() {
        let (head, tail) = row[reach - 1 - index..][..PANEL + width].split_at_mut(PANEL);
        head.copy_from_slice(found);
        subtract(simd, *found, [row0, row1, row2], tail);
    }
    true
}

/// Subtracts multiples of rows from a row of the same length, one after another.
#[inline(always)]
fn subtract<S: Simd, const COUNT: usize>(
    simd: S,
    multipliers: [f64; COUNT],
    rows: [&[f64]; COUNT],
    from: &mut [f64],
) {
    let rows = rows.map(|row| S::as_simd_f64s(&row[..from.len()]));
    let (vectors, rest) = S::as_mut_simd_f64s(from);
    let splat = multipliers.map(|multiplier| simd.splat_f64s(multiplier));
    for (at, vector) in vectors.iter_mut().enumerate() {
        for (multiplier, (row, _)) in splat.iter().zip(&rows) {
            *vector = simd.sub_f64s(*vector, simd.mul_f64s(*multiplier, row[at]));
        }
    }
    for (at, entry) in rest.iter_mut().enumerate() {
        for (multiplier, (_, row)) in multipliers.iter().zip(&rows) {
            *entry -= multiplier * row[at];
        }
    }
}

/// Eliminates one column with the largest of its entries as pivot; returns the last column in which a row has an entry now. Entries of a column, and
/// of a row, end where `end` has it.
fn eliminate_column(
    storage: &mut Storage,
    column: usize,
    filled: usize,
    end: impl Fn(usize) -> usize,
) -> Result<usize, LinearError> {
    let (size, stride, reach) = (storage.size, storage.stride(), storage.reach);
    let rows = &mut storage.rows;
    let last_row = end(column).min(size - 1);
    let diagonal = column * stride + reach + PANEL - 1;
    let (mut pivot_row, mut magnitude) = (column, rows[diagonal].abs());
    // One row down, the entry of the same column lies `stride - 1` further on.
    for row in column + 1..=last_row {
        let candidate = rows[diagonal + (row - column) * (stride - 1)].abs();
        if candidate > magnitude {
            (pivot_row, magnitude) = (row, candidate);
        }
    }
    if magnitude == 0.0 {
        return Err(LinearError::Singular { unknown: column, size });
    }
    if !magnitude.is_finite() {
        return Err(LinearError::NotFinite { unknown: column, size });
    }
    let filled = filled.max(end(pivot_row));
    let width = filled + 1 - column;
    storage.pivots[column] = pivot_row;
    storage.last_columns[column] = filled;

    let (upper, lower) = rows.split_at_mut((column + 1) * stride);
    let row = &mut upper[diagonal..][..width];
    let start = |below: usize| below * stride + reach + PANEL - 2 - below;
    if pivot_row > column {
        row.swap_with_slice(&mut lower[start(pivot_row - column - 1)..][..width]);
    }
    let inverse = 1.0 / row[0];
    row[0] = inverse;
    let row = &row[1..];
    for below in 0..last_row - column {
        let (head, tail) = lower[start(below)..][..width].split_at_mut(1);
        if head[0] == 0.0 {
            continue;
        }
        let factor = head[0] * inverse;
        head[0] = factor;
        for (entry, above) in tail.iter_mut().zip(row) {
            *entry -= factor * above;
        }
    }
    Ok(filled)
}
