//! A square banded matrix and its LU factorisation with partial pivoting.
//!
//! A row is stored contiguously, with room for the fill-in that row exchanges cause, so that elimination is a
//! sequence of short vector updates (Golub & Van Loan, Matrix Computations, 4th ed., section 4.3.5).

use super::LinearError;

/// A square matrix whose entries `(i, j)` vanish for `|i - j|` above the half-bandwidth.
#[derive(Debug, Clone)]
pub struct BandedMatrix {
    size: usize,
    half_bandwidth: usize,
    /// Row `i` holds the columns `i - b ..= i + 2 b`, `b` being the half-bandwidth.
    rows: Vec<f64>,
    pivots: Vec<usize>,
}

/// The factors of a [`BandedMatrix`], kept in its storage.
#[derive(Debug)]
pub struct BandedLu<'a> {
    factors: &'a BandedMatrix,
}

impl BandedMatrix {
    /// The zero matrix of `size` rows with entries up to `half_bandwidth` places off the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize) -> Self {
        let stride = 3 * half_bandwidth + 1;
        Self { size, half_bandwidth, rows: vec![0.0; size * stride], pivots: vec![0; size] }
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// How far off the diagonal entries may be.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    fn stride(&self) -> usize {
        3 * self.half_bandwidth + 1
    }

    fn offset(&self, row: usize, column: usize) -> usize {
        debug_assert!(
            row.abs_diff(column) <= self.half_bandwidth,
            "({row}, {column}) is outside the band"
        );
        row * self.stride() + column + self.half_bandwidth - row
    }

    /// Adds `value` to the entry at `(row, column)`, which must lie in the band.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.offset(row, column);
        self.rows[at] += value;
    }

    /// Adds `values` to the entries of `row` that begin at `first_column`.
    #[inline]
    pub fn add_to_row(&mut self, row: usize, first_column: usize, values: &[f64]) {
        let at = self.offset(row, first_column);
        for (entry, value) in self.rows[at..at + values.len()].iter_mut().zip(values) {
            *entry += value;
        }
    }

    /// The entry at `(row, column)`; zero outside the band.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        if row.abs_diff(column) > self.half_bandwidth {
            0.0
        } else {
            self.rows[self.offset(row, column)]
        }
    }

    /// Replaces the entries by the factors of `P A = L U`.
    ///
    /// # Errors
    /// When a column has no non-zero or no finite pivot; the entries are then lost.
    pub fn factorise(&mut self) -> Result<BandedLu<'_>, LinearError> {
        let (n, b, stride) = (self.size, self.half_bandwidth, self.stride());
        let mut reach = 0;
        for column in 0..n {
            let last_row = (column + b).min(n - 1);
            let diagonal = column * stride + b;
            let (mut pivot_row, mut magnitude) = (column, self.rows[diagonal].abs());
            // One row down, the entry of the same column lies `stride - 1` further on.
            for row in column + 1..=last_row {
                let candidate = self.rows[diagonal + (row - column) * (stride - 1)].abs();
                if candidate > magnitude {
                    (pivot_row, magnitude) = (row, candidate);
                }
            }
            if magnitude == 0.0 {
                return Err(LinearError::Singular { unknown: column, size: n });
            }
            if !magnitude.is_finite() {
                return Err(LinearError::NotFinite { unknown: column, size: n });
            }
            self.pivots[column] = pivot_row;
            reach = reach.max((pivot_row + b).min(n - 1));
            let width = reach - column + 1;

            let (upper, lower) = self.rows.split_at_mut((column + 1) * stride);
            let row = &mut upper[diagonal..diagonal + width];
            if pivot_row > column {
                let start = (pivot_row - column - 1) * stride + b - (pivot_row - column);
                row.swap_with_slice(&mut lower[start..start + width]);
            }
            let inverse = 1.0 / row[0];
            let row = &row[1..];
            for below in 0..last_row - column {
                let start = below * stride + b - (below + 1);
                let target = &mut lower[start..start + width];
                let (head, tail) = target.split_at_mut(1);
                if head[0] == 0.0 {
                    continue;
                }
                let factor = head[0] * inverse;
                head[0] = factor;
                for (entry, above) in tail.iter_mut().zip(row.iter()) {
                    *entry -= factor * above;
                }
            }
        }
        Ok(BandedLu { factors: self })
    }
}

impl BandedLu<'_> {
    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let (n, b, stride) =
            (self.factors.size, self.factors.half_bandwidth, self.factors.stride());
        let rows = &self.factors.rows;
        for column in 0..n {
            x.swap(column, self.factors.pivots[column]);
            let value = x[column];
            let diagonal = column * stride + b;
            for below in 1..=b.min(n - 1 - column) {
                x[column + below] -= rows[diagonal + below * (stride - 1)] * value;
            }
        }
        for row in (0..n).rev() {
            let last = (row + 2 * b).min(n - 1);
            let diagonal = row * stride + b;
            let upper = &rows[diagonal + 1..diagonal + 1 + last - row];
            let known: f64 = upper.iter().zip(&x[row + 1..=last]).map(|(u, x)| u * x).sum();
            x[row] = (x[row] - known) / rows[diagonal];
        }
    }

    /// Replaces `W` right-hand sides, the entries of a row side by side, by their solutions.
    ///
    /// Rows before `first` must be zero: forward elimination begins there.
    pub fn solve_strip<const W: usize>(&self, x: &mut [[f64; W]], first: usize) {
        let (n, b, stride) =
            (self.factors.size, self.factors.half_bandwidth, self.factors.stride());
        let rows = &self.factors.rows;
        // Row exchanges reach back by at most the half-bandwidth.
        for column in first.saturating_sub(b)..n {
            x.swap(column, self.factors.pivots[column]);
            let value = x[column];
            let diagonal = column * stride + b;
            let below = x[column + 1..].iter_mut().take(b).enumerate();
            for (index, target) in below {
                let factor = rows[diagonal + (index + 1) * (stride - 1)];
                target.iter_mut().zip(&value).for_each(|(x, value)| *x -= factor * value);
            }
        }
        for row in (0..n).rev() {
            let last = (row + 2 * b).min(n - 1);
            let diagonal = row * stride + b;
            let upper = &rows[diagonal + 1..diagonal + 1 + last - row];
            let mut value = x[row];
            for (factor, known) in upper.iter().zip(&x[row + 1..=last]) {
                value.iter_mut().zip(known).for_each(|(x, known)| *x -= factor * known);
            }
            let pivot = rows[diagonal];
            x[row] = value.map(|x| x / pivot);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    fn dense(matrix: &BandedMatrix) -> DMatrix<f64> {
        DMatrix::from_fn(matrix.size(), matrix.size(), |i, j| matrix.get(i, j))
    }

    proptest! {
        #[test]
        fn the_banded_solution_is_the_dense_one(
            size in 1_usize..40, half_bandwidth in 0_usize..12, entries in prop::collection::vec(-1.0..1.0_f64, 2000),
        ) {
            let mut matrix = BandedMatrix::zeros(size, half_bandwidth);
            let mut entry = entries.iter().cycle();
            for i in 0..size {
                for j in i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size) {
                    matrix.add(i, j, *entry.next().unwrap());
                }
            }
            let right = DVector::from_fn(size, |i, _| (i as f64 + 1.0).sin());
            let reference = dense(&matrix);
            let condition = reference.clone().svd(false, false).singular_values;
            prop_assume!(condition.min() > 1e-6);
            let mut x = right.as_slice().to_vec();
            matrix.factorise().unwrap().solve(&mut x);
            let error = reference * DVector::from_vec(x) - right;
            prop_assert!(error.amax() < 1e-9, "residual {}", error.amax());
        }
    }

    #[test]
    fn a_singular_matrix_is_named_by_its_unknown() {
        let mut matrix = BandedMatrix::zeros(3, 1);
        matrix.add(0, 0, 1.0);
        matrix.add(2, 2, 1.0);
        assert_eq!(matrix.factorise().unwrap_err(), LinearError::Singular { unknown: 1, size: 3 });
    }

    #[test]
    fn an_infinite_entry_is_refused() {
        let mut matrix = BandedMatrix::zeros(2, 1);
        matrix.add(0, 0, f64::INFINITY);
        matrix.add(1, 1, 1.0);
        assert_eq!(matrix.factorise().unwrap_err(), LinearError::NotFinite { unknown: 0, size: 2 });
    }
}
