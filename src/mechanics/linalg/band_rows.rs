//! Views of the rows of a banded matrix, for adding entries. Views can be split for threads.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

#[derive(Debug)]
pub struct BandRows<'a> {
    pub(super) rows: Range<usize>,
    pub(super) entries: &'a mut [f64],
    pub(super) stride: usize,
    pub(super) centre: usize,
    pub(super) half_bandwidth: usize,
}

pub struct BandRow<'a> {
    entries: &'a mut [f64],
    row: usize,
    centre: usize,
    half_bandwidth: usize,
}

impl BandRow<'_> {
    /// Adds `value` to the entry in a column, which must lie in the band.
    #[inline]
    pub fn add(&mut self, column: usize, value: f64) {
        debug_assert!(self.row.abs_diff(column) <= self.half_bandwidth);
        self.entries[column + self.centre - self.row] += value;
    }
}

impl BandRows<'_> {
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    pub(crate) fn reborrow(&mut self) -> BandRows<'_> {
        BandRows { rows: self.rows.clone(), entries: self.entries, ..*self }
    }

    pub fn split_at(self, row: usize) -> (Self, Self) {
        let Self { rows, entries, stride, centre, half_bandwidth } = self;
        let (before, behind) = entries.split_at_mut((row - rows.start) * stride);
        let part = |rows, entries| Self { rows, entries, stride, centre, half_bandwidth };
        (part(rows.start..row, before), part(row..rows.end, behind))
    }

    #[inline]
    fn offset(&self, row: usize, column: usize) -> usize {
        debug_assert!(
            row.abs_diff(column) <= self.half_bandwidth,
            "({row}, {column}) is outside the band"
        );
        (row - self.rows.start) * self.stride + column + self.centre - row
    }

    /// Adds `value` to the entry at `(row, column)`, which must lie in the band and in the view.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.offset(row, column);
        self.entries[at] += value;
    }

    #[inline]
    pub fn row(&mut self, row: usize) -> BandRow<'_> {
        let first = (row - self.rows.start) * self.stride;
        let entries = &mut self.entries[first..first + self.stride];
        BandRow { entries, row, centre: self.centre, half_bandwidth: self.half_bandwidth }
    }

    #[inline]
    pub fn add_to_row(&mut self, row: usize, first_column: usize, values: &[f64]) {
        let at = self.offset(row, first_column);
        for (entry, value) in self.entries[at..at + values.len()].iter_mut().zip(values) {
            *entry += value;
        }
    }

    pub(crate) fn add_block(&mut self, first: usize, width: usize, values: &[f64]) {
        match width {
            6 => self.add_fixed_block::<6>(first, values),
            9 => self.add_fixed_block::<9>(first, values),
            12 => self.add_fixed_block::<12>(first, values),
            _ => {
                for (row, values) in values.chunks_exact(width).enumerate() {
                    self.add_to_row(first + row, first, values);
                }
            }
        }
    }

    fn add_fixed_block<const WIDTH: usize>(&mut self, first: usize, values: &[f64]) {
        let (at, stride) = (self.offset(first, first), self.stride);
        Arch::new().dispatch(AddBlock::<WIDTH> { entries: self.entries, at, stride, values });
    }

    #[inline]
    pub(crate) fn add_to_diagonal(&mut self, row: usize, offset: isize, values: &[f64]) {
        if !values.is_empty() {
            let at = self.offset(row, row.strict_add_signed(offset));
            let entries = self.entries[at..].iter_mut().step_by(self.stride);
            entries.zip(values).for_each(|(entry, value)| *entry += value);
        }
    }
}

struct AddBlock<'a, const WIDTH: usize> {
    entries: &'a mut [f64],
    at: usize,
    stride: usize,
    values: &'a [f64],
}

impl<const WIDTH: usize> WithSimd for AddBlock<'_, WIDTH> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut at = self.at;
        for values in self.values.chunks_exact(WIDTH) {
            let (values, values_rest) = S::as_simd_f64s(values);
            let (entries, rest) = S::as_mut_simd_f64s(&mut self.entries[at..at + WIDTH]);
            for (entry, value) in entries.iter_mut().zip(values) {
                *entry = simd.add_f64s(*entry, *value);
            }
            for (entry, value) in rest.iter_mut().zip(values_rest) {
                *entry += value;
            }
            at += self.stride - 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::BandedMatrix;

    #[test]
    fn split_rows_write_into_the_matrix() {
        let (mut whole, mut parted) = (BandedMatrix::zeros(9, 3), BandedMatrix::zeros(9, 3));
        let (before, behind) = parted.rows_mut().split_at(4);
        assert_eq!((before.rows(), behind.rows()), (0..4, 4..9));
        for mut part in [before, behind] {
            for row in part.rows() {
                for column in row.saturating_sub(3)..(row + 4).min(9) {
                    let value = (10 * row + column) as f64;
                    part.add(row, column, value);
                    whole.add(row, column, value);
                }
            }
        }
        for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
            assert_eq!(parted.get(row, column), whole.get(row, column), "({row}, {column})");
        }
    }

    #[test]
    fn values_are_added_along_a_diagonal() {
        for offset in [-3, 0, 2] {
            let mut matrix = BandedMatrix::zeros(12, 4);
            let values = [1.0, 2.0, 3.0, 4.0, 5.0];
            matrix.rows_mut().add_to_diagonal(4, offset, &values);
            matrix.rows_mut().add_to_diagonal(4, offset, &[]);
            for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
                let is_there = (4..9).contains(&row) && column as isize - row as isize == offset;
                let expected = if is_there { values[row - 4] } else { 0.0 };
                assert_eq!(matrix.get(row, column), expected, "({row}, {column})");
            }
        }
    }

    #[test]
    fn blocks_of_any_width_are_added_row_by_row() {
        for width in 1..14 {
            let mut matrix = BandedMatrix::zeros(20, 14);
            let values: Vec<f64> = (0..width * width).map(|index| index as f64).collect();
            matrix.rows_mut().add_block(3, width, &values);
            matrix.rows_mut().add_block(3, width, &values);
            assert_eq!(matrix.get(2, 3), 0.0);
            for (index, value) in values.iter().enumerate() {
                assert_eq!(matrix.get(3 + index / width, 3 + index % width), 2.0 * value);
            }
        }
    }
}
