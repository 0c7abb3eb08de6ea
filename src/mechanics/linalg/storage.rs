//! The rows of a banded matrix as elimination and substitution know them.

use std::ops::Range;

use super::elimination::{PANEL, SMALLEST_REACH};

/// The rows of a banded matrix, and what elimination notes about them.
///
/// Behind the last row stand rows of the identity, so that the last panel is whole, and behind these rows of zeros, which elimination may touch.
#[derive(Debug, Clone)]
pub(super) struct Storage {
    pub(super) size: usize,
    /// The half-bandwidth `b`, at least [`SMALLEST_REACH`].
    pub(super) reach: usize,
    /// Row `i` holds the columns `i - b - (PANEL - 1) ..= i + 2 b`. In factors, the multipliers stand left of the diagonal,
    /// on the diagonal the inverse of the pivot.
    pub(super) rows: Vec<f64>,
    /// The row that the pivot of each column came from, by column.
    pub(super) pivots: Vec<usize>,
    /// The last column with an entry in each row of the upper factor, by row.
    pub(super) last_columns: Vec<usize>,
    /// The multipliers of the rows below a panel, until the panel is accepted.
    pub(super) multipliers: Vec<[f64; PANEL]>,
}

/// Rows of a banded matrix of which the first columns are eliminated, as [`Storage`] has them.
#[derive(Debug)]
pub(super) struct ActiveRows<'a> {
    /// The number of rows without those of the identity.
    pub(super) size: usize,
    /// The number of columns to eliminate: all, or a multiple of the panel with as many rows behind it as a column reaches.
    pub(super) columns: usize,
    pub(super) reach: usize,
    pub(super) rows: &'a mut [f64],
    pub(super) pivots: &'a mut [usize],
    pub(super) last_columns: &'a mut [usize],
    pub(super) multipliers: &'a mut [[f64; PANEL]],
}

/// The same when they are eliminated.
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
        };
        storage.remake(size, half_bandwidth);
        storage
    }

    /// Makes room for the rows of another matrix, all zero; takes more memory only where there never were as many.
    pub(super) fn remake(&mut self, size: usize, half_bandwidth: usize) {
        (self.size, self.reach) = (size, half_bandwidth.max(SMALLEST_REACH));
        self.pivots.resize(size, 0);
        self.last_columns.resize(size, 0);
        self.multipliers.resize(self.reach, [0.0; PANEL]);
        self.rows.clear();
        self.rows.resize((size + PANEL + self.reach) * self.stride(), 0.0);
        self.end_with_the_identity();
    }

    /// The place of the diagonal entry among the stored entries of a row.
    #[inline(always)]
    pub(super) fn centre(&self) -> usize {
        self.reach + PANEL - 1
    }

    /// The number of stored entries of a row.
    #[inline(always)]
    pub(super) fn stride(&self) -> usize {
        3 * self.reach + PANEL
    }

    /// All rows, to be eliminated.
    pub(super) fn rows_mut(&mut self) -> ActiveRows<'_> {
        let Self { size, reach, .. } = *self;
        let Self { rows, pivots, last_columns, multipliers, .. } = self;
        ActiveRows { size, columns: size, reach, rows, pivots, last_columns, multipliers }
    }

    /// The factors, where all rows are eliminated.
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
}

impl Factors<'_> {
    /// Whether the pivot of one of these columns came from another row.
    #[inline(always)]
    pub(super) fn is_exchanged(&self, mut columns: Range<usize>) -> bool {
        columns.any(|column| self.pivots[column] != column)
    }
}
