//! Sparse symmetric matrices.

use pulp::{Arch, Simd, WithSimd};

use super::strips::VectorStrip;

#[derive(Debug, Clone)]
pub struct SymmetricSparse {
    /// Index of the first entry of each row, followed by the total number of entries.
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl SymmetricSparse {
    /// Creates the matrix from entries (row, column, value) of both triangles, given in any order.
    /// Values for the same row and column are added up.
    /// The callback `give` is called twice, first to count the entries and then to store them.
    ///
    /// # Panics
    /// Panics if there are 2³² or more rows.
    pub fn new(size: usize, give: impl Fn(&mut dyn FnMut(usize, usize, f64))) -> Self {
        assert!(u32::try_from(size).is_ok(), "{size} rows");
        let mut starts = vec![0; size + 1];
        give(&mut |row, _, _| starts[row + 1] += 1);
        (0..size).for_each(|row| starts[row + 1] += starts[row]);
        let mut next = starts.clone();
        let (mut columns, mut values) = (vec![0_u32; starts[size]], vec![0.0; starts[size]]);
        give(&mut |row, column, value| {
            let (first, mut at) = (starts[row], next[row]);
            while at > first && columns[at - 1] as usize > column {
                (columns[at], values[at]) = (columns[at - 1], values[at - 1]);
                at -= 1;
            }
            (columns[at], values[at]) = (column as u32, value);
            next[row] += 1;
        });
        let mut matrix = Self { starts, columns, values };
        matrix.compact();
        matrix
    }

    fn compact(&mut self) {
        let Self { starts, columns, values } = self;
        let (mut kept, mut first) = (0, 0);
        for row in 0..starts.len() - 1 {
            let last = starts[row + 1];
            let begin = kept;
            for at in first..last {
                if kept > begin && columns[kept - 1] == columns[at] {
                    values[kept - 1] += values[at];
                } else {
                    (columns[kept], values[kept]) = (columns[at], values[at]);
                    kept += 1;
                }
            }
            (first, starts[row + 1]) = (last, kept);
        }
        columns.truncate(kept);
        values.truncate(kept);
    }

    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Entries of a row as pairs of column and value, sorted by column.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let entries = self.starts[row]..self.starts[row + 1];
        self.columns[entries.clone()]
            .iter()
            .map(|&at| at as usize)
            .zip(self.values[entries].iter().copied())
    }

    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        self.row(row).find(|(column, _)| *column == row).map_or(0.0, |(_, value)| value)
    }

    /// Multiplies the matrix by the four vectors of `x`. Entries of `product` beyond the size of the matrix are set to zero.
    pub fn times(&self, x: &VectorStrip, product: &mut VectorStrip) {
        Arch::new().dispatch(SparseProduct { matrix: self, x, product });
    }
}

struct SparseProduct<'a> {
    matrix: &'a SymmetricSparse,
    x: &'a VectorStrip,
    product: &'a mut VectorStrip,
}

impl WithSimd for SparseProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix, x, product } = self;
        let size = matrix.size();
        for (out, ends) in product[..size].iter_mut().zip(matrix.starts.windows(2)) {
            let entries = ends[0]..ends[1];
            let mut sum = [0.0; 4];
            for (column, value) in
                matrix.columns[entries.clone()].iter().zip(&matrix.values[entries])
            {
                for (sum, x) in sum.iter_mut().zip(&x[*column as usize]) {
                    *sum += value * x;
                }
            }
            *out = sum;
        }
        product[size..].fill([0.0; 4]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sparse_entries_at_one_position_are_summed() {
        let entries = [(2, 0, 3.0), (0, 0, 1.0), (0, 2, 3.0), (0, 0, 4.0)];
        let matrix = SymmetricSparse::new(3, |add| entries.iter().for_each(|e| add(e.0, e.1, e.2)));
        assert_eq!(matrix.row(0).collect::<Vec<_>>(), [(0, 5.0), (2, 3.0)]);
        assert_eq!((matrix.row(1).count(), matrix.diagonal(1)), (0, 0.0));
        let (x, mut product) = (vec![[1.0, 2.0, 0.0, -1.0]; 4], vec![[9.0; 4]; 4]);
        matrix.times(&x, &mut product);
        assert_eq!(product, [[8.0, 16.0, 0.0, -8.0], [0.0; 4], [3.0, 6.0, 0.0, -3.0], [0.0; 4]]);
    }
}
