//! Gaussian elimination of a banded matrix by panels of columns.
//!
//! A panel of columns is eliminated without row exchanges if all its multipliers are small. The multipliers depend only on entries of the panel.
//! Reference for threshold pivoting: Duff, Erisman & Reid, Direct Methods for Sparse Matrices, section 5.2.
//! If a multiplier is large, the columns of the panel are eliminated one by one with partial pivoting.
//!
//! Below the diagonal, row exchanges and additional nonzero entries stay inside the profile, because the last rows of successive columns do not decrease.
//! Right of the diagonal, row exchanges create entries beyond the profile.

use pulp::{Simd, WithSimd};

use super::storage::ActiveRows;
use super::{LinearError, fixed_band};

const LANES: usize = 4;

/// Number of columns that are eliminated together, equal to the vector length, so that successive panels read and write the same vectors of a row.
/// A read that overlaps two recently written vectors would stall the processor.
pub(super) const PANEL: usize = LANES;

/// Smallest half-bandwidth for which the storage of a row has space for a panel and the vectors that are read after the panel.
pub(super) const SMALLEST_HALF_BANDWIDTH: usize = PANEL + LANES - 2;

/// Square of the largest multiplier that is accepted without a row exchange, for rows of equal reference size (see `Storage::weigh_rows`).
const LARGEST_SQUARE: f64 = 64.0;

/// Returns true if a multiplier is so small that no row exchange is needed.
/// The arguments are the multiplier, and the squared reference sizes of the pivot row and of the eliminated row (see `Storage::weigh_rows`).
#[inline(always)]
pub(super) fn is_small(multiplier: f64, pivot_row: f64, row: f64) -> bool {
    multiplier * multiplier * pivot_row <= LARGEST_SQUARE * row
}

pub(super) struct Elimination<'a>(pub(super) ActiveRows<'a>);

impl WithSimd for Elimination<'_> {
    type Output = Result<(), LinearError>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        // The half-bandwidths of beams of degree 2 and 3 are compile-time constants. For degree 1, constants would not save time.
        match self.0.reach {
            8 => eliminate(simd, &mut self.0, 8, eliminate_fixed::<S, 8, 8, 28>),
            11 => eliminate(simd, &mut self.0, 11, eliminate_fixed::<S, 11, 12, 37>),
            reach => {
                let width = reach.next_multiple_of(LANES);
                eliminate(simd, &mut self.0, reach, |simd, storage, first| {
                    eliminate_panel(simd, storage, first, [reach, reach], width)
                })
            }
        }
    }
}

/// Elimination of a matrix with a symmetric profile.
/// The profile gives, for each index, the last row with an entry in the column of this index. The profile never decreases.
pub(super) struct ProfileElimination<'a>(pub(super) ActiveRows<'a>, pub(super) &'a [usize]);

impl WithSimd for ProfileElimination<'_> {
    type Output = Result<(), LinearError>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        eliminate_in_profile(simd, &mut self.0, self.1)
    }
}

#[inline(always)]
fn eliminate_fixed<S: Simd, const REACH: usize, const WIDTH: usize, const STRIDE: usize>(
    simd: S,
    storage: &mut ActiveRows<'_>,
    first: usize,
) -> bool {
    let (rows, _) = storage.rows.as_chunks_mut::<STRIDE>();
    let sizes = &storage.sizes[first..];
    fixed_band::eliminate_panel::<S, REACH, WIDTH, STRIDE>(simd, &mut rows[first..], sizes)
}

#[inline(always)]
fn eliminate<S: Simd>(
    simd: S,
    storage: &mut ActiveRows<'_>,
    reach: usize,
    eliminate_plain: impl Fn(S, &mut ActiveRows<'_>, usize) -> bool,
) -> Result<(), LinearError> {
    let mut filled = 0;
    for first in (0..storage.columns).step_by(PANEL) {
        let next = first + PANEL;
        let width = filled.max(next - 1 + reach) + 1 - next;
        let is_eliminated = if width == reach {
            eliminate_plain(simd, storage, first)
        } else {
            eliminate_panel(simd, storage, first, [reach, reach], width)
        };
        let columns = first..next.min(storage.columns);
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
    storage: &mut ActiveRows<'_>,
    ends: &[usize],
) -> Result<(), LinearError> {
    let reach = storage.reach;
    let mut filled = 0;
    for first in (0..storage.columns).step_by(PANEL) {
        let next = first + PANEL;
        let below = ends[next - 1] + 1 - next;
        let width = filled.max(ends[next - 1]) + 1 - next;
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
        for column in first..next.min(storage.columns) {
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

pub(super) struct PanelFactors {
    pub(super) factors: [[f64; PANEL]; PANEL],
    pub(super) inverses: [f64; PANEL],
    pub(super) is_stable: bool,
}

impl PanelFactors {
    #[inline(always)]
    pub(super) fn of(mut factors: [[f64; PANEL]; PANEL], sizes: &[f64]) -> Self {
        let mut inverses = [0.0; PANEL];
        let mut is_stable = true;
        for column in 0..PANEL {
            let pivot_row = factors[column];
            let inverse = 1.0 / pivot_row[column];
            is_stable &= pivot_row[column].is_finite();
            for (row, size) in factors[column + 1..].iter_mut().zip(&sizes[column + 1..]) {
                let multiplier = row[column] * inverse;
                is_stable &= is_small(multiplier, sizes[column], *size);
                row[column] = multiplier;
                for (entry, above) in row.iter_mut().zip(pivot_row).skip(column + 1) {
                    *entry -= multiplier * above;
                }
            }
            inverses[column] = inverse;
        }
        Self { factors, inverses, is_stable }
    }
}

#[inline(always)]
fn eliminate_panel<S: Simd>(
    simd: S,
    storage: &mut ActiveRows<'_>,
    first: usize,
    [reach, below]: [usize; 2],
    width: usize,
) -> bool {
    let (stride, centre) = (3 * reach + PANEL, reach + PANEL - 1);
    let rows = &mut storage.rows[first * stride..][..(PANEL + below) * stride];
    let (panel, rows_below) = rows.split_at_mut(PANEL * stride);
    let head = |row: usize| row * stride + centre - row;
    let mut heads = [[0.0; PANEL]; PANEL];
    for (row, entries) in heads.iter_mut().enumerate() {
        entries.copy_from_slice(&panel[head(row)..][..PANEL]);
    }
    let (sizes, sizes_below) = storage.sizes[first..][..PANEL + below].split_at(PANEL);
    let PanelFactors { factors, inverses, is_stable } = PanelFactors::of(heads, sizes);

    let mut are_small = is_stable;
    let multipliers = &mut storage.multipliers[..below];
    for (index, (row, found)) in rows_below.chunks_exact(stride).zip(&mut *multipliers).enumerate()
    {
        let entries = &row[reach - 1 - index..][..PANEL];
        for column in 0..PANEL {
            let mut entry = entries[column];
            for before in 0..column {
                entry -= found[before] * factors[before][column];
            }
            found[column] = entry * inverses[column];
            are_small &= is_small(found[column], sizes[column], sizes_below[index]);
        }
    }
    if !are_small {
        return false;
    }

    for index in 0..PANEL {
        panel[head(index)..][..PANEL].copy_from_slice(&factors[index]);
        panel[head(index) + index] = inverses[index];
    }
    let (row0, rest) = panel.split_at_mut(stride);
    let (row1, rest) = rest.split_at_mut(stride);
    let (row2, row3) = rest.split_at_mut(stride);
    let behind0 = &row0[head(0) + PANEL..][..width];
    let behind1 = &mut row1[centre + PANEL - 1..][..width];
    subtract(simd, [factors[1][0]], [behind0], behind1);
    let behind2 = &mut row2[centre + PANEL - 2..][..width];
    subtract(simd, [factors[2][0], factors[2][1]], [behind0, behind1], behind2);
    let behind3 = &mut row3[centre + PANEL - 3..][..width];
    let [l0, l1, l2, _] = factors[3];
    subtract(simd, [l0, l1, l2], [behind0, behind1, behind2], behind3);
    for (index, (row, found)) in rows_below.chunks_exact_mut(stride).zip(multipliers).enumerate() {
        let (head, tail) = row[reach - 1 - index..][..PANEL + width].split_at_mut(PANEL);
        head.copy_from_slice(found);
        subtract(simd, *found, [behind0, behind1, behind2, behind3], tail);
    }
    true
}

#[inline(always)]
pub(super) fn subtract<S: Simd, const COUNT: usize>(
    simd: S,
    multipliers: [f64; COUNT],
    rows: [&[f64]; COUNT],
    from: &mut [f64],
) {
    // A loop is used, because a closure that is not inlined would lose the vector instructions.
    let mut splat = [simd.splat_f64s(0.0); COUNT];
    let (mut heads, mut tails): ([&[S::f64s]; COUNT], [&[f64]; COUNT]) =
        ([&[]; COUNT], [&[]; COUNT]);
    for index in 0..COUNT {
        splat[index] = simd.splat_f64s(multipliers[index]);
        (heads[index], tails[index]) = S::as_simd_f64s(&rows[index][..from.len()]);
    }
    let (vectors, rest) = S::as_mut_simd_f64s(from);
    for (at, vector) in vectors.iter_mut().enumerate() {
        // The copy is needed, because the compiler cannot exclude that the target is one of the rows.
        let mut left = *vector;
        for (multiplier, row) in splat.iter().zip(&heads) {
            left = simd.sub_f64s(left, simd.mul_f64s(*multiplier, row[at]));
        }
        *vector = left;
    }
    for (at, entry) in rest.iter_mut().enumerate() {
        for (multiplier, row) in multipliers.iter().zip(&tails) {
            *entry -= multiplier * row[at];
        }
    }
}

fn eliminate_column(
    storage: &mut ActiveRows<'_>,
    column: usize,
    filled: usize,
    end: impl Fn(usize) -> usize,
) -> Result<usize, LinearError> {
    let (size, reach) = (storage.size, storage.reach);
    let (stride, rows) = (3 * reach + PANEL, &mut *storage.rows);
    let last_row = end(column).min(size - 1);
    let diagonal = column * stride + reach + PANEL - 1;
    let entry = |row: usize| rows[diagonal + (row - column) * (stride - 1)].abs();
    let relative = |row: usize| entry(row) / storage.sizes[row].sqrt();
    let (mut pivot_row, mut largest) = (column, relative(column));
    for row in column + 1..=last_row {
        let candidate = relative(row);
        if candidate > largest {
            (pivot_row, largest) = (row, candidate);
        }
    }
    let magnitude = entry(pivot_row);
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
        storage.sizes.swap(column, pivot_row);
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
