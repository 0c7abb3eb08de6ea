//! Square banded matrix, and its LU factorisation with row exchanges.
//!
//! The elimination is a sequence of short vector operations (Golub & Van Loan, Matrix Computations, 4th ed., section 4.3.5).

use pulp::Arch;

use super::distant::DistantBlocks;
use super::elimination::Elimination;
use super::storage::{Factors, Storage};
use super::substitution::{StripSubstitution, Substitution};
use super::{BandRows, LinearError};

/// Square matrix whose entries `(i, j)` are zero if `|i - j|` exceeds the half-bandwidth, except in the dense blocks of distant couplings.
#[derive(Debug, Clone)]
pub struct BandedMatrix {
    size: usize,
    half_bandwidth: usize,
    storage: Storage,
    distant: DistantBlocks,
}

/// Factors `P A = L U` of a [`BandedMatrix`], stored in the memory of its entries.
#[derive(Debug)]
pub struct BandedLu<'a> {
    factors: Factors<'a>,
}

impl BandedMatrix {
    /// Creates a zero matrix of `size` rows. Entries can be up to `half_bandwidth` columns away from the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize) -> Self {
        let storage = Storage::zeros(size, half_bandwidth);
        Self { size, half_bandwidth, storage, distant: DistantBlocks::default() }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Half-bandwidth.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.storage.clear();
        self.distant.clear();
    }

    pub(crate) fn add_block(&mut self, unknowns: &[usize], entries: impl Iterator<Item = f64>) {
        self.distant.add(unknowns, entries);
    }

    pub(super) fn distant(&self) -> &DistantBlocks {
        &self.distant
    }

    #[inline]
    pub(crate) fn rows_mut(&mut self) -> BandRows<'_> {
        let (stride, centre) = (self.storage.stride(), self.storage.centre());
        let (rows, half_bandwidth) = (0..self.size, self.half_bandwidth);
        BandRows { rows, entries: &mut self.storage.rows, stride, centre, half_bandwidth }
    }

    /// Adds `value` to the entry at `(row, column)`, which must lie in the band.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows_mut().add(row, column, value);
    }

    /// Entry at `(row, column)`; zero outside the band and outside the dense blocks of distant couplings.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let here = |(r, c, _): &(usize, usize, f64)| (*r, *c) == (row, column);
        let distant: f64 = self.distant.iter().filter(here).map(|(.., value)| value).sum();
        distant + self.in_band(row, column)
    }

    pub(super) fn in_band(&self, row: usize, column: usize) -> f64 {
        if row.abs_diff(column) > self.half_bandwidth {
            0.0
        } else {
            self.storage.rows[row * self.storage.stride() + column + self.storage.centre() - row]
        }
    }

    pub(super) fn row(&self, row: usize) -> (usize, &[f64]) {
        let first = row.saturating_sub(self.half_bandwidth);
        let last = (row + self.half_bandwidth).min(self.size - 1);
        let at = row * self.storage.stride() + first + self.storage.centre() - row;
        (first, &self.storage.rows[at..=at + last - first])
    }

    pub(super) fn storage(&self) -> &Storage {
        &self.storage
    }

    pub(super) fn storage_mut(&mut self) -> &mut Storage {
        &mut self.storage
    }

    pub(crate) fn weigh_rows(&mut self) {
        self.storage.weigh_rows();
    }

    pub(super) fn set_row_sizes(&mut self, sizes: impl Iterator<Item = f64>) {
        self.storage.sizes.iter_mut().zip(sizes).for_each(|(size, given)| *size = given);
    }

    /// Replaces the entries of the matrix `A` by the factors `P A = L U`.
    ///
    /// # Errors
    /// Fails if a column has no nonzero finite pivot. The entries of the matrix are then lost.
    pub fn factorise(&mut self) -> Result<BandedLu<'_>, LinearError> {
        debug_assert!(self.distant.is_empty(), "entries outside the band");
        Arch::new().dispatch(Elimination(self.storage.rows_mut()))?;
        Ok(self.factors())
    }

    pub(crate) fn factors(&self) -> BandedLu<'_> {
        BandedLu { factors: self.storage.factors() }
    }
}

impl BandedLu<'_> {
    /// Replaces the right-hand side `x` by the solution of `A x = b`.
    pub fn solve(&self, x: &mut [f64]) {
        Arch::new().dispatch(Substitution { factors: self.factors, x });
    }

    /// Replaces `W` right-hand sides by their solutions. The entries of the right-hand sides are interleaved.
    ///
    /// The right-hand sides must be zero before row `first`.
    pub(crate) fn solve_strip<const W: usize>(&self, x: &mut [[f64; W]], first: usize) {
        Arch::new().dispatch(StripSubstitution { factors: self.factors, x, first });
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
        fn banded_solution_agrees_with_the_dense_solution(
            size in 1_usize..40, half_bandwidth in 0_usize..12, entries in prop::collection::vec(-1.0..1.0_f64, 2000),
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
            let right = DVector::from_fn(size, |i, _| (i as f64 + 1.0).sin());
            let reference = dense(&matrix);
            let condition = reference.clone().svd(false, false).singular_values;
            prop_assume!(condition.min() > 1e-6);
            let mut x = right.as_slice().to_vec();
            matrix.factorise().unwrap().solve(&mut x);
            let solution = DVector::from_vec(x);
            let size = solution.amax().max(1.0);
            let error = reference * solution - right;
            prop_assert!(error.amax() < 1e-11 * size, "residual {}", error.amax());
        }
    }

    #[test]
    fn diagonally_dominant_matrix_needs_no_row_exchange_and_no_fill() {
        let (size, half_bandwidth) = (50, 11);
        let mut matrix = BandedMatrix::zeros(size, half_bandwidth);
        for i in 0..size {
            for j in i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size) {
                matrix.add(i, j, if i == j { 30.0 } else { ((i + 3 * j) as f64).sin() });
            }
        }
        let factors = matrix.factorise().unwrap().factors;
        assert!(factors.pivots.iter().copied().eq(0..size));
        assert!(factors.last_columns.iter().copied().eq((0..size).map(|row| row + half_bandwidth)));
    }

    #[test]
    fn matrix_with_a_zero_on_the_diagonal_is_solved() {
        let mut matrix = BandedMatrix::zeros(2, 1);
        matrix.rows_mut().add_to_row(0, 0, &[0.0, 2.0]);
        matrix.rows_mut().add_to_row(1, 0, &[4.0, 1.0]);
        let mut x = [6.0, 7.0];
        matrix.factorise().unwrap().solve(&mut x);
        assert_eq!(x, [1.0, 3.0]);
    }

    #[test]
    fn singular_banded_matrix_error_names_the_unknown() {
        let mut matrix = BandedMatrix::zeros(3, 1);
        matrix.add(0, 0, 1.0);
        matrix.add(2, 2, 1.0);
        assert_eq!(matrix.factorise().unwrap_err(), LinearError::Singular { unknown: 1, size: 3 });
    }

    fn whole_numbers(size: usize, half_bandwidth: usize) -> BandedMatrix {
        let mut matrix = BandedMatrix::zeros(size, half_bandwidth);
        for i in 0..size {
            for j in i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size) {
                let entry = ((5 * i * i + 3 * j + i * j) % 7) as f64 - 3.0;
                matrix.add(i, j, if i == j { 11.0 } else { entry });
            }
        }
        matrix
    }

    #[test]
    fn zero_row_or_column_is_singular_in_every_panel() {
        for zero in 3..12_usize {
            let (mut row, mut column) = (whole_numbers(12, 5), whole_numbers(12, 5));
            for i in zero.saturating_sub(5)..(zero + 6).min(12) {
                row.add(zero, i, -row.get(zero, i));
                column.add(i, zero, -column.get(i, zero));
            }
            let singular = |unknown| LinearError::Singular { unknown, size: 12 };
            assert_eq!(column.factorise().unwrap_err(), singular(zero));
            assert_eq!(row.factorise().unwrap_err(), singular(zero.max(10)));
        }
    }

    #[test]
    fn nan_entries_always_reach_the_result_or_an_error() {
        for row in 0..12_usize {
            for column in row.saturating_sub(5)..(row + 6).min(12) {
                let mut matrix = whole_numbers(12, 5);
                matrix.add(row, column, f64::NAN);
                let mut x = [1.0; 12];
                match matrix.factorise() {
                    Ok(factors) => factors.solve(&mut x),
                    Err(error) => {
                        assert!(matches!(error, LinearError::NotFinite { .. }), "{error}");
                        continue;
                    }
                }
                assert!(x.iter().any(|x| !x.is_finite()), "({row}, {column})");
            }
        }
    }

    #[test]
    fn graded_rows_are_solved_as_accurately_as_with_dense_pivoting() {
        let size = 24;
        let gradings: [fn(i32) -> i32; 4] =
            [|_| 0, |i| 40 * i / 23, |i| 40 - 40 * i / 23, |i| 7 * i % 41];
        for (number, grading) in gradings.into_iter().enumerate() {
            let base = whole_numbers(size, 5);
            let mut matrix = BandedMatrix::zeros(size, 5);
            for i in 0..size {
                for j in i.saturating_sub(5)..(i + 6).min(size) {
                    matrix.add(i, j, base.get(i, j) * 2_f64.powi(grading(i as i32)));
                }
            }
            let reference = dense(&matrix);
            let right = &reference * DVector::repeat(size, 1.0);
            let error = |x: &[f64]| x.iter().fold(0.0, |most: f64, x| most.max((x - 1.0).abs()));
            let mut x = right.as_slice().to_vec();
            matrix.factorise().unwrap().solve(&mut x);
            let pivoted = reference.lu().solve(&right).unwrap();
            let (banded, pivoted) = (error(&x), error(pivoted.as_slice()));
            println!("grading {number}: error {banded:.1e}, dense {pivoted:.1e}");
            assert!(banded <= 10.0 * pivoted + 1e-14, "{number}: {banded:e} {pivoted:e}");
        }
    }

    fn linked_point(h: f64, k: f64, order: &[usize; 7]) -> (BandedMatrix, [f64; 7], [f64; 7]) {
        let [px, py, fx, fy, x, y, turn] = *order;
        let (arm, inertia) = ([0.25, -0.5], 2.0 / (h * h));
        let mut matrix = BandedMatrix::zeros(7, 6);
        for (at, diagonal) in [(px, k), (py, k), (x, inertia), (y, inertia), (turn, inertia)] {
            matrix.add(at, at, diagonal);
        }
        let links = [(px, fx, x, arm[0]), (py, fy, y, arm[1])];
        for (point, force, centre, arm) in links {
            for (at, share) in [(point, 1.0), (centre, -1.0), (turn, -arm)] {
                matrix.add(at, force, share / h);
                matrix.add(force, at, share);
            }
        }
        let mut solution = [1.0; 7];
        let mut right = [0.0; 7];
        for (point, force, centre, arm) in links {
            (solution[point], solution[force]) = (1.0 + arm, 2.0 * h);
            right[point] = k * (1.0 + arm) + 2.0;
            right[centre] = inertia - 2.0;
            right[turn] -= 2.0 * arm;
        }
        right[turn] += inertia;
        (matrix, right, solution)
    }

    #[test]
    fn point_of_tiny_stiffness_is_solved_accurately_through_its_link() {
        let orders = [[0, 1, 2, 3, 4, 5, 6], [6, 5, 4, 3, 2, 1, 0], [3, 5, 0, 6, 1, 2, 4]];
        for power in (0..42).step_by(3) {
            let h = 2_f64.powi(-power);
            for stiffness in [0.0, 1e-300, 1e-100, 1e-12, 1e-6, 1.0, 1e6, 1e12] {
                for order in &orders {
                    let (mut matrix, mut x, solution) = linked_point(h, stiffness / (h * h), order);
                    matrix.weigh_rows();
                    matrix.factorise().unwrap().solve(&mut x);
                    let forces = [order[2], order[3]];
                    let size =
                        |at: usize| if forces.contains(&at) { (2.0 + stiffness) / h } else { 1.0 };
                    let errors = (0..7).map(|at| (x[at] - solution[at]).abs() / size(at));
                    let worst = errors.fold(0.0, f64::max);
                    assert!(worst < 1e-5, "h {h:e}, k {stiffness:e}, {order:?}: {worst:e} {x:?}");
                }
            }
        }
    }

    #[test]
    fn infinite_matrix_entry_is_rejected() {
        let mut matrix = BandedMatrix::zeros(2, 1);
        matrix.add(0, 0, f64::INFINITY);
        matrix.add(1, 1, 1.0);
        assert_eq!(matrix.factorise().unwrap_err(), LinearError::NotFinite { unknown: 0, size: 2 });
    }

    fn worked_on(arch: Arch, matrix: &BandedMatrix, right: &[f64]) -> Option<Vec<u64>> {
        let mut storage = matrix.storage.clone();
        arch.dispatch(Elimination(storage.rows_mut())).ok()?;
        let (factors, mut x) = (storage.factors(), right.to_vec());
        let mut strip: Vec<_> = right.iter().map(|x| [*x, 1.0 - x, 0.3 * x]).collect();
        arch.dispatch(Substitution { factors, x: &mut x });
        arch.dispatch(StripSubstitution { factors, x: &mut strip, first: 0 });
        let all = storage.rows.iter().chain(&x).chain(strip.as_flattened());
        Some(all.map(|x| x.to_bits()).collect())
    }

    proptest! {
        #[test]
        fn banded_solutions_are_bit_identical_without_vector_instructions(
            size in 1_usize..60, half_bandwidth in 0_usize..20, entries in prop::collection::vec(-1.0..1.0_f64, 2000),
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
            let right: Vec<f64> = entries.iter().cycle().skip(7).copied().take(size).collect();
            let scalar = worked_on(Arch::Scalar, &matrix, &right);
            prop_assert!(scalar == worked_on(Arch::new(), &matrix, &right));
            prop_assert!(scalar.is_some() || diagonal == 0.0);
        }
    }
}
