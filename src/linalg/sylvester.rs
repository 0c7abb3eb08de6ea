//! How many eigenvalues of a symmetric matrix are negative.

use super::BandedMatrix;

/// The number of negative eigenvalues of a symmetric matrix: that of negative pivots of `L D Lᵀ` (Sylvester's law of inertia; Golub & Van
/// Loan, Matrix Computations, 4th ed., section 4.4).
///
/// Without exchange of rows, an eigenvalue nearer to zero than rounding may be counted either way. Only the upper triangle is read.
pub fn negative_eigenvalues(matrix: &BandedMatrix) -> usize {
    let (size, reach) = (matrix.size(), matrix.half_bandwidth());
    // The rows of the upper triangle that the elimination of a row may touch, from the diagonal on.
    let row = |at: usize| -> Vec<f64> {
        (at..(at + reach + 1).min(size)).map(|column| matrix.get(at, column)).collect()
    };
    let mut rows: std::collections::VecDeque<Vec<f64>> =
        (0..size.min(reach + 1)).map(row).collect();
    let mut negative = 0;
    for at in 0..size {
        let Some(pivot_row) = rows.pop_front() else { break };
        let pivot = pivot_row[0];
        negative += usize::from(pivot < 0.0);
        // A pivot of zero stands for one that rounding would have made; its sign is as good as the other.
        let inverse = if pivot == 0.0 { 0.0 } else { 1.0 / pivot };
        for (below, rest) in rows.iter_mut().zip(1..pivot_row.len()) {
            let factor = pivot_row[rest] * inverse;
            for (entry, above) in below.iter_mut().zip(&pivot_row[rest..]) {
                *entry -= factor * above;
            }
        }
        if at + reach + 1 < size {
            rows.push_back(row(at + reach + 1));
        }
    }
    negative
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn they_are_those_of_the_dense_matrix(
            size in 1_usize..25, reach in 0_usize..6, entries in prop::collection::vec(-1.0..1.0_f64, 997),
        ) {
            let mut matrix = BandedMatrix::zeros(size, reach);
            let mut entries = entries.iter().cycle();
            for i in 0..size {
                for j in i..(i + reach + 1).min(size) {
                    let value = *entries.next().unwrap();
                    matrix.add(i, j, value);
                    if i != j {
                        matrix.add(j, i, value);
                    }
                }
            }
            let dense = DMatrix::from_fn(size, size, |i, j| matrix.get(i, j));
            let values = dense.symmetric_eigenvalues();
            prop_assume!(values.iter().all(|value| value.abs() > 1e-6));
            let expected = values.iter().filter(|value| **value < 0.0).count();
            prop_assert_eq!(negative_eigenvalues(&matrix), expected);
        }
    }
}
