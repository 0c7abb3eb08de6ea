//! Storage of the rows of a banded matrix during elimination and substitution.

use std::ops::Range;

use super::elimination::{PANEL, SMALLEST_HALF_BANDWIDTH};
use crate::elementary::square;

/// Limit of the squared reference size of a constraint row (see `weigh_rows`), as a multiple of its second largest squared scaled entry [-].
/// With this limit, the elimination loses at most half of the digits, which corrections with the same factors recover.
const LARGEST_RATIO: f64 = 1e8;

/// Rows of a banded matrix, and data for the elimination.
///
/// The rows are followed by identity rows, which complete the last panel, and by zero rows, which the elimination may read.
#[derive(Debug, Clone)]
pub(super) struct Storage {
    pub(super) size: usize,
    /// Half-bandwidth `b`, at least `SMALLEST_HALF_BANDWIDTH`.
    pub(super) reach: usize,
    /// Entries row by row. After the factorisation, a row contains the multipliers, the inverse pivot and the upper factor.
    pub(super) rows: Vec<f64>,
    pub(super) pivots: Vec<usize>,
    pub(super) last_columns: Vec<usize>,
    pub(super) multipliers: Vec<[f64; PANEL]>,
    pub(super) sizes: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct ActiveRows<'a> {
    /// Number of rows, without the identity rows.
    pub(super) size: usize,
    pub(super) columns: usize,
    pub(super) reach: usize,
    pub(super) rows: &'a mut [f64],
    pub(super) pivots: &'a mut [usize],
    pub(super) last_columns: &'a mut [usize],
    pub(super) multipliers: &'a mut [[f64; PANEL]],
    pub(super) sizes: &'a mut [f64],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Factors<'a> {
    pub(super) size: usize,
    pub(super) columns: usize,
    pub(super) reach: usize,
    pub(super) rows: &'a [f64],
    pub(super) pivots: &'a [usize],
    pub(super) last_columns: &'a [usize],
}

impl Storage {
    pub(super) fn zeros(size: usize, half_bandwidth: usize) -> Self {
        let mut storage = Self {
            size: 0,
            reach: 0,
            rows: Vec::new(),
            pivots: Vec::new(),
            last_columns: Vec::new(),
            multipliers: Vec::new(),
            sizes: Vec::new(),
        };
        storage.remake(size, half_bandwidth);
        storage
    }

    pub(super) fn remake(&mut self, size: usize, half_bandwidth: usize) {
        (self.size, self.reach) = (size, half_bandwidth.max(SMALLEST_HALF_BANDWIDTH));
        self.pivots.resize(size, 0);
        self.last_columns.resize(size, 0);
        self.multipliers.resize(self.reach, [0.0; PANEL]);
        self.sizes.clear();
        self.sizes.resize(size + PANEL + self.reach, 1.0);
        self.rows.clear();
        self.rows.resize((size + PANEL + self.reach) * self.stride(), 0.0);
        self.end_with_the_identity();
    }

    #[inline(always)]
    pub(super) fn centre(&self) -> usize {
        self.reach + PANEL - 1
    }

    #[inline(always)]
    pub(super) fn stride(&self) -> usize {
        3 * self.reach + PANEL
    }

    pub(super) fn rows_mut(&mut self) -> ActiveRows<'_> {
        let Self { size, reach, .. } = *self;
        let Self { rows, pivots, last_columns, multipliers, sizes, .. } = self;
        ActiveRows { size, columns: size, reach, rows, pivots, last_columns, multipliers, sizes }
    }

    pub(super) fn factors(&self) -> Factors<'_> {
        let Self { size, reach, rows, pivots, last_columns, .. } = self;
        Factors { size: *size, columns: *size, reach: *reach, rows, pivots, last_columns }
    }

    pub(super) fn clear(&mut self) {
        self.rows.fill(0.0);
        self.end_with_the_identity();
    }

    pub(super) fn end_with_the_identity(&mut self) {
        for row in self.size..self.size + PANEL {
            let diagonal = row * self.stride() + self.centre();
            self.rows[diagonal] = 1.0;
        }
    }

    /// Computes a squared reference size of each row. The pivot search divides the squared entries of a row by this number.
    /// The squared reference size of a row is its diagonal entry, as if rows and columns were scaled to a unit diagonal.
    /// The row of a constraint has no diagonal entry. Its squared reference size is its largest squared scaled entry.
    /// If all unknowns in the row have diagonal entries, the squared reference size is limited by [`LARGEST_RATIO`].
    /// Without this limit, a negligible and therefore inaccurate diagonal entry could become a pivot.
    pub(super) fn weigh_rows(&mut self) {
        let (stride, centre) = (self.stride(), self.centre());
        let Self { size, reach, rows, sizes, .. } = self;
        let (size, reach) = (*size, *reach);
        let entry = |row: usize, column: usize| rows[row * stride + column + centre - row];
        let mut are_all_known = true;
        for (row, found) in sizes[..size].iter_mut().enumerate() {
            *found = entry(row, row).abs();
            are_all_known &= *found > 0.0;
        }
        if are_all_known {
            return;
        }
        let near = |at: usize| at.saturating_sub(reach)..(at + reach + 1).min(size);
        let known = |at: usize| near(at).filter(|other| entry(*other, *other) != 0.0);
        let largest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(0.0, f64::max);
        let of_column = |column: usize| {
            let of = |row| square(entry(row, column)) / entry(row, row).abs();
            largest(&mut known(column).map(of))
        };
        for (row, size) in sizes[..size].iter_mut().enumerate().filter(|(_, size)| **size == 0.0) {
            let by_known = |column| square(entry(row, column)) / entry(column, column).abs();
            let coupled = || near(row).filter(|column| entry(row, *column) != 0.0);
            let by_constraint = |column| square(entry(row, column)) / of_column(column);
            *size = if coupled().all(|column| entry(column, column) != 0.0) {
                largest_of_two(known(row).map(by_known))
            } else {
                largest(&mut known(row).map(by_known))
            };
            if *size == 0.0 {
                *size = largest(&mut coupled().map(by_constraint).filter(|size| size.is_finite()));
            }
            if *size == 0.0 {
                *size = 1.0;
            }
        }
    }
}

fn largest_of_two(values: impl Iterator<Item = f64>) -> f64 {
    let [largest, second] = values.fold([0.0, 0.0], |[largest, second], value: f64| {
        [value.max(largest), value.min(largest).max(second)]
    });
    if second > 0.0 { largest.min(LARGEST_RATIO * second) } else { largest }
}

impl Factors<'_> {
    #[inline(always)]
    pub(super) fn is_exchanged(&self, mut columns: Range<usize>) -> bool {
        columns.any(|column| self.pivots[column] != column)
    }
}
