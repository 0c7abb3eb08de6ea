//! Matrix with a profile, and its LU factorisation with row exchanges.
//!
//! The couplings of unknowns may change, so the profile can be changed without allocating memory.

use pulp::Arch;

use super::LinearError;
use super::elimination::{PANEL, ProfileElimination};
use super::storage::{Factors, Storage};
use super::substitution::ProfileSubstitution;

/// Square matrix with a profile.
/// The profile gives, for each index, the last row with an entry in the column of this index. The profile is symmetric.
#[derive(Debug, Clone)]
pub(super) struct ProfileMatrix {
    storage: Storage,
    ends: Vec<usize>,
}

/// Factors `P A = L U` of a [`ProfileMatrix`], stored in the memory of its entries.
#[derive(Debug)]
pub(super) struct ProfileLu<'a> {
    factors: Factors<'a>,
    ends: &'a [usize],
}

impl ProfileMatrix {
    pub(super) fn with_capacity(size: usize, half_bandwidth: usize) -> Self {
        let ends = Vec::with_capacity(size + PANEL);
        Self { storage: Storage::zeros(size, half_bandwidth), ends }
    }

    pub(super) fn remake(&mut self, ends: &[usize], half_bandwidth: usize) {
        self.ends.clear();
        let (mut furthest, mut reach) = (0, half_bandwidth);
        for (index, &end) in ends.iter().enumerate() {
            furthest = furthest.max(end).max(index);
            reach = reach.max(furthest - index);
            self.ends.push(furthest);
        }
        self.ends.extend(ends.len()..ends.len() + PANEL);
        self.storage.remake(ends.len(), reach);
    }

    #[inline]
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(self.ends[row.min(column)] >= row.max(column), "({row}, {column})");
        let at = row * self.storage.stride() + column + self.storage.centre() - row;
        self.storage.rows[at] += value;
    }

    #[inline]
    pub(super) fn copy_to_row(&mut self, row: usize, first: usize, values: &[f64]) {
        let at = row * self.storage.stride() + first + self.storage.centre() - row;
        self.storage.rows[at..at + values.len()].copy_from_slice(values);
    }

    pub(super) fn weigh_rows(&mut self) {
        self.storage.weigh_rows();
    }

    pub(super) fn set_row_size(&mut self, row: usize, size: f64) {
        self.storage.sizes[row] = size;
    }

    /// Replaces the entries of the matrix by its factors.
    ///
    /// # Errors
    /// Fails if a column has no nonzero finite pivot. The entries of the matrix are then lost.
    pub(super) fn factorise(&mut self) -> Result<ProfileLu<'_>, LinearError> {
        Arch::new().dispatch(ProfileElimination(self.storage.rows_mut(), &self.ends))?;
        Ok(ProfileLu { factors: self.storage.factors(), ends: &self.ends })
    }
}

impl ProfileLu<'_> {
    pub(super) fn solve(&self, x: &mut [f64]) {
        Arch::new().dispatch(ProfileSubstitution { factors: self.factors, ends: self.ends, x });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn reused_profile_matrix_agrees_with_the_dense_solution(
            reaches in prop::collection::vec(0_usize..15, 1..60), entries in prop::collection::vec(-1.0..1.0_f64, 2000),
            diagonal in prop::sample::select(vec![0.0, 0.5, 3.0, 30.0]),
        ) {
            let mut matrix = ProfileMatrix::with_capacity(1, 0);
            for shift in [0, 7] {
                let size = reaches.len();
                let ends: Vec<usize> =
                    (0..size).map(|i| (i + reaches[(i + shift) % size]).min(size - 1)).collect();
                matrix.remake(&ends, 0);
                let mut dense: DMatrix<f64> = DMatrix::zeros(size, size);
                let mut entry = entries.iter().skip(shift).cycle();
                for i in 0..size {
                    for j in 0..size {
                        let value = *entry.next().unwrap() + if i == j { diagonal } else { 0.0 };
                        if ends[i.min(j)] >= i.max(j) {
                            matrix.add(i, j, value);
                            dense[(i, j)] += value;
                        }
                    }
                }
                let right = DVector::from_fn(size, |i, _| (i as f64 + 1.0).sin());
                prop_assume!(dense.clone().svd(false, false).singular_values.min() > 1e-2);
                let mut x = right.as_slice().to_vec();
                matrix.factorise().unwrap().solve(&mut x);
                let error: DVector<f64> = dense * DVector::from_vec(x) - right;
                prop_assert!(error.amax() < 1e-9, "residual {}", error.amax());
            }
        }
    }

    #[test]
    fn zero_column_error_names_the_unknown() {
        let mut matrix = ProfileMatrix::with_capacity(3, 1);
        matrix.remake(&[1, 1, 2], 0);
        matrix.add(0, 0, 1.0);
        matrix.add(2, 2, 1.0);
        let error = matrix.factorise().unwrap_err();
        assert_eq!(error, LinearError::Singular { unknown: 1, size: 3 });
    }
}
