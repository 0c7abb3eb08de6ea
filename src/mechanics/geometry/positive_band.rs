//! Symmetric positive definite band matrices, and entries of their inverse near the diagonal.

/// Smallest ratio of a pivot to its diagonal entry for which a matrix counts as nonsingular [-].
const ROUNDING: f64 = 1e-11;

#[derive(Debug, Clone)]
pub struct PositiveBand {
    /// Rows of the upper triangle: row `i` contains the entries `(i, i), (i, i + 1), …`.
    rows: Vec<Vec<f64>>,
}

#[derive(Debug, Clone)]
pub struct PositiveFactors {
    /// Columns of the factors: column `i` contains `D_i` and the entries `(i + 1, i), (i + 2, i), …` of `L`.
    columns: Vec<Vec<f64>>,
}

impl PositiveBand {
    /// Creates a zero matrix of the given size. Entries can be up to `half_bandwidth` columns away from the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize) -> Self {
        Self { rows: vec![vec![0.0; half_bandwidth + 1]; size] }
    }

    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// Adds `factor · v vᵀ` to the matrix. The first entry of the vector `v` belongs to the row and column `first`.
    pub(crate) fn add_square(&mut self, first: usize, factor: f64, v: &[f64]) {
        for (row, (left, a)) in self.rows[first..].iter_mut().zip(v.iter().enumerate()) {
            row.iter_mut().zip(&v[left..]).for_each(|(entry, b)| *entry += factor * a * b);
        }
    }

    pub fn get(&self, row: usize, column: usize) -> f64 {
        let (low, high) = (row.min(column), row.max(column));
        self.rows[low].get(high - low).copied().unwrap_or(0.0)
    }

    /// Computes the factors `L D Lᵀ` of the matrix. Returns `None` if a pivot is not positive, or so small that it is due to rounding.
    pub fn factorise(&self) -> Option<PositiveFactors> {
        let mut columns = self.rows.clone();
        for at in 0..columns.len() {
            let (done, rest) = columns.split_at_mut(at + 1);
            let column = &mut done[at];
            let pivot = column[0];
            // If rows are linearly dependent, the pivot consists of rounding errors.
            if !(pivot > ROUNDING * self.rows[at][0] && pivot.is_finite()) {
                return None;
            }
            for (by, row) in rest.iter_mut().enumerate().take(column.len() - 1) {
                let factor = column[by + 1] / pivot;
                row.iter_mut().zip(&column[by + 1..]).for_each(|(to, from)| *to -= factor * from);
            }
            column[1..].iter_mut().for_each(|entry| *entry /= pivot);
        }
        Some(PositiveFactors { columns })
    }
}

impl PositiveFactors {
    pub fn solve(&self, x: &mut [f64]) {
        for (at, column) in self.columns.iter().enumerate() {
            let (done, rest) = x.split_at_mut(at + 1);
            rest.iter_mut().zip(&column[1..]).for_each(|(to, factor)| *to -= factor * done[at]);
        }
        for (at, column) in self.columns.iter().enumerate().rev() {
            let (to, known) = x.split_at_mut(at + 1);
            let products = known.iter().zip(&column[1..]).map(|(x, factor)| x * factor);
            to[at] = to[at] / column[0] - products.sum::<f64>();
        }
    }

    /// Entries of the inverse that are up to `width` columns away from its diagonal. `width` must be at least the half-bandwidth.
    ///
    /// The entries of the inverse `Z` follow from `Lᵀ Z = D⁻¹ L⁻¹`, starting with the last row (Erisman & Tinney 1975).
    pub fn inverse(&self, width: usize) -> PositiveBand {
        let size = self.columns.len();
        let mut inverse = PositiveBand::zeros(size, width);
        for (row, column) in self.columns.iter().enumerate().rev() {
            // The diagonal entry of a row of the inverse is computed last, because it depends on the other entries of the row.
            for away in (0..=width.min(size - 1 - row)).rev() {
                let known = (row + 1..size).zip(&column[1..]);
                let products = known.map(|(at, factor)| factor * inverse.get(at, row + away));
                let pivot = if away == 0 { 1.0 / column[0] } else { 0.0 };
                inverse.rows[row][away] = pivot - products.sum::<f64>();
            }
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band() -> PositiveBand {
        let mut band = PositiveBand::zeros(7, 2);
        for first in 0..5 {
            let at = first as f64;
            band.add_square(first, 1.0 + at, &[1.0, 0.3 - 0.1 * at, 0.2]);
        }
        (0..7).for_each(|at| band.add_square(at, 0.5, &[1.0]));
        band
    }

    #[test]
    fn band_solution_satisfies_the_equations() {
        let band = band();
        let right: Vec<f64> = (0..7).map(|at| f64::from(at).powi(2) - 3.0).collect();
        let mut x = right.clone();
        band.factorise().unwrap().solve(&mut x);
        for (row, wanted) in right.iter().enumerate() {
            let found: f64 = (0..7).map(|column| band.get(row, column) * x[column]).sum();
            assert!((found - wanted).abs() < 1e-13, "{found} is not {wanted}");
        }
    }

    #[test]
    fn band_of_the_inverse_agrees_with_column_solutions() {
        let factors = band().factorise().unwrap();
        for width in 2..6 {
            let inverse = factors.inverse(width);
            for column in 0..7_usize {
                let mut unit = vec![0.0; 7];
                unit[column] = 1.0;
                factors.solve(&mut unit);
                for (row, wanted) in unit.iter().enumerate() {
                    let expected = if row.abs_diff(column) <= width { *wanted } else { 0.0 };
                    assert!((inverse.get(row, column) - expected).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn matrix_that_is_not_positive_definite_has_no_factors() {
        let mut band = PositiveBand::zeros(2, 1);
        band.add_square(0, 1.0, &[1.0, 1.0]);
        assert!(band.factorise().is_none());
    }
}
