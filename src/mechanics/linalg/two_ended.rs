//! Elimination of a long band from both ends in two concurrent threads.
//!
//! The rows after the middle are stored in reverse (last row and last column first) and eliminated like the first rows.
//! A small dense matrix remains in the middle ("burn at both ends" factorisation: Golub & Van Loan, 4th ed., section 4.3; van der Vorst 1987).
//! With one thread, the same operations are executed in the same order, so the results are identical.

use pulp::Arch;

use super::elimination::{Elimination, PANEL, SMALLEST_HALF_BANDWIDTH};
use super::storage::{ActiveRows, Factors};
use super::substitution::{Backward, Forward};
use super::{BandedLu, BandedMatrix, LinearError};
use crate::threads::both;

/// Smallest number of rows for elimination from both ends. For shorter bands, a second thread saves little time.
const FEWEST_ROWS: usize = 6000;

#[derive(Debug, Clone)]
pub(super) struct TwoEnded {
    cut: BandCut,
    threads: usize,
    multipliers: Vec<[f64; PANEL]>,
    middle: BandedMatrix,
    right: Vec<f64>,
    /// Unknowns of the middle and after the middle, in reverse order.
    reversed: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct BandCut {
    size: usize,
    reach: usize,
    /// Number of columns that are eliminated forwards, starting with the first column. It is a multiple of the panel width.
    upper: usize,
    /// Number of columns that are eliminated backwards, starting with the last column. It is a multiple of the panel width.
    lower: usize,
}

#[derive(Debug)]
pub(super) struct TwoEndedLu<'a> {
    cut: BandCut,
    threads: usize,
    upper: Factors<'a>,
    lower: Factors<'a>,
    middle: BandedLu<'a>,
    right: &'a mut [f64],
    reversed: &'a mut [f64],
}

impl BandCut {
    fn new(size: usize, reach: usize) -> Self {
        let both = size - (2 * reach + 1);
        let upper = both / 2 / PANEL * PANEL;
        Self { size, reach, upper, lower: (both - upper) / PANEL * PANEL }
    }

    fn middle(&self) -> usize {
        self.size - self.upper - self.lower
    }

    fn upper_rows(&self) -> usize {
        self.upper + self.reach
    }

    fn lower_rows(&self) -> usize {
        self.size - self.upper_rows() - 1
    }
}

impl TwoEnded {
    pub(super) fn worthwhile(size: usize, half_bandwidth: usize) -> Option<Self> {
        (size >= FEWEST_ROWS && size > 16 * half_bandwidth).then(|| Self::new(size, half_bandwidth))
    }

    fn new(size: usize, half_bandwidth: usize) -> Self {
        let reach = half_bandwidth.max(SMALLEST_HALF_BANDWIDTH);
        let cut = BandCut::new(size, reach);
        let middle = cut.middle();
        Self {
            cut,
            threads: 1,
            multipliers: vec![[0.0; PANEL]; reach],
            middle: BandedMatrix::zeros(middle, middle - 1),
            right: vec![0.0; middle],
            reversed: vec![0.0; cut.lower + middle],
        }
    }

    pub(super) fn use_threads(&mut self, threads: usize) {
        self.threads = threads;
    }

    pub(super) fn clear(&self, band: &mut BandedMatrix) {
        let storage = band.storage_mut();
        let middle = self.cut.size / 2 * storage.stride();
        let (before, behind) = storage.rows.split_at_mut(middle);
        both(self.threads, || before.fill(0.0), || behind.fill(0.0));
        storage.end_with_the_identity();
    }

    /// Replaces the entries of a matrix by its factors.
    ///
    /// # Errors
    /// Fails if a column has no nonzero finite pivot. The entries of the matrix are then lost.
    pub(super) fn factorise<'a>(
        &'a mut self,
        band: &'a mut BandedMatrix,
    ) -> Result<TwoEndedLu<'a>, LinearError> {
        let Self { cut, threads, multipliers, middle, right, reversed: turned } = self;
        let (cut, threads) = (*cut, *threads);
        let BandCut { size, reach, .. } = cut;
        band.weigh_rows();
        let storage = band.storage_mut();
        let (stride, centre) = (storage.stride(), storage.centre());
        let (before, behind) = (cut.upper_rows(), size - cut.lower_rows());
        let shift = 2 * reach - centre;
        let (rows, lower) = storage.rows[..size * stride].split_at_mut(behind * stride - shift);
        let (pivots, lower_pivots) = storage.pivots.split_at_mut(behind);
        let (last_columns, lower_last_columns) = storage.last_columns.split_at_mut(behind);
        let (sizes, lower_sizes) = storage.sizes[..size].split_at_mut(behind);
        lower_sizes.reverse();
        let upper = ActiveRows {
            size: before,
            columns: cut.upper,
            reach,
            rows: &mut rows[..before * stride],
            pivots,
            last_columns,
            multipliers: &mut storage.multipliers,
            sizes,
        };
        let mut results = [Ok(()), Ok(())];
        let [of_upper, of_lower] = &mut results;
        let mut from_below = |rows: &mut [f64], result: &mut Result<(), LinearError>| {
            rows.reverse();
            let lower = ActiveRows {
                size: cut.lower_rows(),
                columns: cut.lower,
                reach,
                rows: &mut rows[shift..],
                pivots: lower_pivots,
                last_columns: lower_last_columns,
                multipliers,
                sizes: lower_sizes,
            };
            *result = Arch::new().dispatch(Elimination(lower));
        };
        let from_above = || *of_upper = Arch::new().dispatch(Elimination(upper));
        both(threads, from_above, || from_below(lower, of_lower));
        let [of_upper, of_lower] = results;
        of_upper.map_err(|error| error.at(error.unknown(), size))?;
        of_lower.map_err(|error| error.at(size - 1 - error.unknown(), size))?;

        let entry = |row: usize, column: usize| {
            let (first, row, column) = match row < behind {
                true => (0, row, column),
                false => (behind, size - 1 - row, size - 1 - column),
            };
            let is_stored = column <= row + 2 * reach;
            if is_stored {
                storage.rows[(first + row) * stride + column + centre - row]
            } else {
                0.0
            }
        };
        middle.clear();
        for row in 0..cut.middle() {
            for column in 0..cut.middle() {
                let (i, j) = (cut.upper + row, cut.upper + column);
                if i != before || i.abs_diff(j) <= reach {
                    middle.add(row, column, entry(i, j));
                }
            }
        }
        middle.weigh_rows();
        let middle =
            middle.factorise().map_err(|error| error.at(cut.upper + error.unknown(), size))?;
        let storage = band.storage();
        let factors = |rows, columns, of: std::ops::Range<usize>, first: usize| Factors {
            size: rows,
            columns,
            reach,
            rows: &storage.rows[first * stride..][..rows * stride],
            pivots: &storage.pivots[of.clone()],
            last_columns: &storage.last_columns[of],
        };
        Ok(TwoEndedLu {
            cut,
            threads,
            upper: factors(before, cut.upper, 0..behind, 0),
            lower: factors(cut.lower_rows(), cut.lower, behind..size, behind),
            middle,
            right,
            reversed: turned,
        })
    }
}

impl TwoEndedLu<'_> {
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        let Self { cut, threads, upper, lower, middle, right, reversed: turned } = self;
        let (cut, upper, lower) = (*cut, *upper, *lower);
        let threads = *threads;
        let before = cut.upper_rows();
        let (above, below) = x.split_at_mut(before + 1);
        let turned_rows = &mut turned[..cut.lower_rows()];
        both(
            threads,
            || Arch::new().dispatch(Forward { factors: upper, x: &mut above[..before] }),
            || {
                let entries = turned_rows.iter_mut().zip(below.iter().rev());
                entries.for_each(|(turned, x)| *turned = *x);
                Arch::new().dispatch(Forward { factors: lower, x: turned_rows });
            },
        );
        let (left, behind) = right.split_at_mut(cut.reach + 1);
        left.copy_from_slice(&x[cut.upper..=before]);
        let rest = turned[cut.lower..cut.lower_rows()].iter().rev();
        behind.iter_mut().zip(rest).for_each(|(right, x)| *right = *x);
        middle.solve(right);
        x[cut.upper..][..right.len()].copy_from_slice(right);
        let known = turned[cut.lower..].iter_mut().zip(right.iter().rev());
        known.for_each(|(turned, x)| *turned = *x);
        let (above, below) = x.split_at_mut(cut.upper + right.len());
        both(
            threads,
            || Arch::new().dispatch(Backward { factors: upper, x: above }),
            || {
                Arch::new().dispatch(Backward { factors: lower, x: turned });
                below.iter_mut().rev().zip(turned.iter()).for_each(|(x, turned)| *x = *turned);
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;
    use proptest::prelude::*;

    fn solved(band: &BandedMatrix, threads: usize, right: &[f64]) -> Vec<f64> {
        let mut band = band.clone();
        let mut ends = TwoEnded::new(band.size(), band.half_bandwidth());
        ends.use_threads(threads);
        let mut x = right.to_vec();
        let mut factors = ends.factorise(&mut band).unwrap();
        factors.solve(&mut x);
        x.copy_from_slice(right);
        factors.solve(&mut x);
        x
    }

    proptest! {
        #[test]
        fn two_ended_solution_is_accurate_and_bit_identical_on_two_threads(
            size in 60_usize..200, half_bandwidth in prop::sample::select(vec![1_usize, 5, 6, 8, 11, 14]),
            entries in prop::collection::vec(-1.0..1.0_f64, 2000),
            diagonal in prop::sample::select(vec![0.0, 0.5, 3.0, 30.0]),
        ) {
            let mut matrix = BandedMatrix::zeros(size, half_bandwidth);
            let mut entry = entries.iter().cycle();
            for i in 0..size {
                for j in i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size) {
                    matrix.add(i, j, *entry.next().unwrap());
                }
                matrix.add(i, i, diagonal);
            }
            let right: Vec<f64> = (0..size).map(|i| (i as f64 + 1.0).sin()).collect();
            let mut reference = right.clone();
            matrix.clone().factorise().unwrap().solve(&mut reference);
            let residual = |x: &[f64]| {
                let row = |i: usize| {
                    let columns = i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size);
                    columns.map(|j| matrix.get(i, j) * x[j]).sum::<f64>() - right[i]
                };
                DVector::from_fn(size, |i, _| row(i)).amax()
            };
            let x = solved(&matrix, 1, &right);
            let largest = DVector::from_column_slice(&reference).amax().max(1.0);
            prop_assume!(largest < 1e6);
            prop_assert!(residual(&x) < 1e-10 * largest, "{:e} of {:e}", residual(&x), residual(&reference));
            let again = solved(&matrix, 2, &right);
            prop_assert!(x.iter().zip(&again).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    #[test]
    fn singular_column_at_any_position_is_named() {
        for zero in [3, 40, 50, 55, 60, 99] {
            let mut matrix = BandedMatrix::zeros(100, 6);
            (0..100).filter(|row| *row != zero).for_each(|row| matrix.add(row, row, 2.0));
            let mut ends = TwoEnded::new(100, 6);
            let error = ends.factorise(&mut matrix).unwrap_err();
            assert_eq!(error, LinearError::Singular { unknown: zero, size: 100 });
        }
    }
}
