//! Computation of the largest eigenvalues of a symmetric operator by the block Lanczos method.
//!
//! References: Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994; Wu & Simon, SIAM J. Matrix Anal. Appl. 22 (2000) 602–616 (thick restarts).

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::VibrationError;
use super::elastic::FourVectors;
use crate::elementary::square;
use crate::linalg::{STRIP_WIDTH, Square4, VectorStrip, combine, products, subtract_combination};

/// Largest residual of a converged pair, as a fraction of its eigenvalue.
/// The error of the eigenvalue is of the order of the squared residual.
const SETTLED: f64 = 1e-8;

/// Largest ratio of the lengths of a vector after and before orthogonalisation for which the result consists of rounding errors.
const ROUNDING_REDUCTION: f64 = 1e-11;

/// Smallest ratio of the length of a vector after orthogonalisation to its largest removed component that makes a second orthogonalisation unnecessary.
const SHRUNK: f64 = 1e-4;

/// Largest component in the basis that may remain after orthogonalisation, as a fraction of the length of the vector.
/// A vector with a component above `TRACE` in the basis is orthogonalised again.
const TRACE: f64 = 1e-8;

const ORTHONORMAL: f64 = 1e-14;

const MOST_RESTARTS: usize = 60;

/// Linear operator that is self-adjoint in the scalar product of a positive semidefinite matrix `M`, the metric.
pub(super) trait SymmetricOperator {
    /// Number of unknowns.
    fn size(&self) -> usize;

    /// Four zero vectors with the margin that the substitutions need.
    fn zeros(&self) -> Vec<FourVectors>;

    /// Multiplies four vectors by the metric `M`.
    fn metric_times(&self, x: &VectorStrip, product: &mut VectorStrip);

    /// Threshold below which eigenvalues are discarded. `largest` is the largest absolute eigenvalue.
    fn threshold(&self, _largest: f64) -> f64 {
        0.0
    }

    /// Replaces the products of four vectors with the metric `M` by the images of the vectors.
    fn images(&self, momenta: &mut VectorStrip);
}

/// Pairs of an eigenvalue and a shape that is normalised with respect to the metric, in decreasing order of the eigenvalues.
pub(super) struct Pairs {
    pub(super) values: Vec<f64>,
    pub(super) strips: Vec<Vec<FourVectors>>,
}

pub(super) struct Lanczos<'a> {
    operator: &'a dyn SymmetricOperator,
    basis: Vec<Vec<FourVectors>>,
    projected: DMatrix<f64>,
    next: Vec<FourVectors>,
    next_momenta: Vec<FourVectors>,
    coupling: Square4,
    momenta: Vec<FourVectors>,
    seed: u64,
}

impl<'a> Lanczos<'a> {
    /// Creates a search whose first block consists of random vectors, which are the same in every run.
    pub(super) fn new(operator: &'a dyn SymmetricOperator) -> Self {
        let mut search = Self {
            operator,
            basis: Vec::new(),
            projected: DMatrix::zeros(0, 0),
            next: Vec::new(),
            next_momenta: Vec::new(),
            coupling: Square4::default(),
            momenta: operator.zeros(),
            seed: 0,
        };
        search.restart_randomly();
        search
    }

    pub(super) fn width(count: usize) -> usize {
        (2 * count + 32).next_multiple_of(STRIP_WIDTH)
    }

    /// Continues the search until `count` pairs of eigenvalue and shape have converged. Returns all converged pairs.
    ///
    /// # Errors
    /// Fails if the pairs do not converge, or if the search is stopped.
    pub(super) fn find_pairs(
        &mut self,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Pairs, VibrationError> {
        let most = Self::width(count);
        for _ in 0..MOST_RESTARTS {
            // Eigenvalues are computed only in some steps, because the cost increases with the third power of their number.
            let mut look = count + 1;
            loop {
                if !goes_on() {
                    return Err(VibrationError::Interrupted);
                }
                self.step();
                let width = self.projected.nrows();
                if width >= look || width >= most {
                    let (values, vectors) = self.ritz();
                    let settled = self.settled(&values, &vectors);
                    if settled >= count.min(width) && width >= count {
                        return Ok(self.pairs(&values, &vectors, settled));
                    }
                    if width >= most {
                        self.check_count(&values, count)?;
                        self.restart(&values, &vectors, count + (most - count) / 2);
                        break;
                    }
                    look = width + 1 + width / 16;
                }
            }
        }
        Err(VibrationError::NotConverged { restarts: MOST_RESTARTS })
    }

    fn check_count(&self, values: &[f64], count: usize) -> Result<(), VibrationError> {
        let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let least = self.operator.threshold(largest);
        match values.iter().filter(|value| **value > least).count() {
            available if available < count => {
                Err(VibrationError::FewEigenvalues { requested: count, available })
            }
            _ => Ok(()),
        }
    }

    /// Continues the search with the pairs found so far and new random vectors.
    /// Random vectors are needed, because the multiplicity of an eigenvalue may exceed the number of vectors in a block.
    pub(super) fn continue_with_random(&mut self, found: Pairs) {
        self.projected = DMatrix::from_diagonal(&DVector::from_vec(found.values));
        self.basis = found.strips;
        let width = STRIP_WIDTH * self.basis.len();
        self.projected.resize_mut(width, width, 0.0);
        self.restart_randomly();
    }

    fn metric_times(&self, x: &VectorStrip) -> Vec<FourVectors> {
        let mut product = self.operator.zeros();
        self.operator.metric_times(x, &mut product);
        product
    }

    fn step(&mut self) {
        let old = self.projected.nrows();
        self.basis.push(std::mem::take(&mut self.next));
        let new = STRIP_WIDTH * self.basis.len();
        self.projected.resize_mut(new, new, 0.0);
        let mut image = std::mem::take(&mut self.next_momenta);
        self.operator.images(&mut image);
        let size = self.project(&mut image, Some(old));
        let mut momenta = self.metric_times(&image);
        self.coupling = orthonormalise(&mut image, &mut momenta);
        let left = (0..STRIP_WIDTH).map(|at| self.coupling[at][at]).fold(f64::INFINITY, f64::min);
        if left < SHRUNK * size {
            // Rounding leaves a fraction of the removed components in the orthogonalised image.
            let again = self.project(&mut image, None);
            self.operator.metric_times(&image, &mut momenta);
            let turn = orthonormalise(&mut image, &mut momenta);
            if again > TRACE {
                self.project(&mut image, None);
                self.operator.metric_times(&image, &mut momenta);
                orthonormalise(&mut image, &mut momenta);
            }
            self.coupling = product(&turn, &self.coupling);
        }
        let lost: Vec<usize> =
            (0..STRIP_WIDTH).filter(|&lane| self.coupling[lane][lane] == 0.0).collect();
        if !lost.is_empty() {
            self.replace(&mut image, &lost);
            self.operator.metric_times(&image, &mut momenta);
        }
        (self.next, self.next_momenta) = (image, momenta);
    }

    fn project(&mut self, image: &mut [FourVectors], columns: Option<usize>) -> f64 {
        self.operator.metric_times(image, &mut self.momenta);
        let mut largest = 0.0_f64;
        for (at, block) in self.basis.iter().enumerate() {
            let parts = products(block, &self.momenta);
            subtract_combination(block, &parts, image);
            for (i, row) in parts.iter().enumerate() {
                for (j, part) in row.iter().enumerate() {
                    largest = largest.max(part.abs());
                    if let Some(old) = columns {
                        let (row, column) = (STRIP_WIDTH * at + i, old + j);
                        self.projected[(row, column)] += part;
                        if row < old {
                            self.projected[(column, row)] += part;
                        }
                    }
                }
            }
        }
        largest
    }

    fn replace(&mut self, block: &mut [FourVectors], lost: &[usize]) {
        let mut fresh = self.scattered();
        let keep_lost = |strip: &mut [FourVectors]| {
            for row in strip {
                (0..STRIP_WIDTH).filter(|at| !lost.contains(at)).for_each(|at| row[at] = 0.0);
            }
        };
        keep_lost(&mut fresh);
        for _ in 0..2 {
            let mut momenta = self.metric_times(&fresh);
            for other in self.basis.iter().map(Vec::as_slice).chain([&*block]) {
                subtract_combination(other, &products(other, &momenta), &mut fresh);
            }
            self.operator.metric_times(&fresh, &mut momenta);
            orthonormalise(&mut fresh, &mut momenta);
        }
        for (row, fresh) in block.iter_mut().zip(&fresh) {
            lost.iter().for_each(|&at| row[at] = fresh[at]);
        }
    }

    fn restart_randomly(&mut self) {
        let mut block = self.operator.zeros();
        self.replace(&mut block, &[0, 1, 2, 3]);
        self.next_momenta = self.metric_times(&block);
        self.next = block;
        self.coupling = Square4::default();
    }

    fn scattered(&mut self) -> Vec<FourVectors> {
        let size = self.operator.size();
        let mut block = self.operator.zeros();
        for entry in block[..size].as_flattened_mut() {
            // Pseudorandom numbers: Weyl's sequence, scrambled (Steele, Lea & Flood, SplitMix64, OOPSLA 2014).
            self.seed = self.seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut bits = self.seed;
            bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            *entry = ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        }
        let mut block = self.metric_times(&block);
        self.operator.images(&mut block);
        block
    }

    fn ritz(&self) -> (Vec<f64>, DMatrix<f64>) {
        let symmetric = (&self.projected + self.projected.transpose()) * 0.5;
        let SymmetricEigen { eigenvalues, eigenvectors } = symmetric.symmetric_eigen();
        let mut order: Vec<usize> = (0..eigenvalues.len()).collect();
        order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
        (order.iter().map(|at| eigenvalues[*at]).collect(), eigenvectors.select_columns(&order))
    }

    fn settled(&self, values: &[f64], vectors: &DMatrix<f64>) -> usize {
        let first = vectors.nrows() - STRIP_WIDTH;
        let rest = |column: usize| {
            let row = |row: &FourVectors| -> f64 {
                (0..STRIP_WIDTH).map(|lane| row[lane] * vectors[(first + lane, column)]).sum()
            };
            self.coupling.iter().map(|of| square(row(of))).sum::<f64>().sqrt()
        };
        let is_settled = |(column, value): (usize, &f64)| rest(column) <= SETTLED * value;
        values.iter().enumerate().take_while(|pair| is_settled(*pair)).count()
    }

    fn combined(&self, vectors: &DMatrix<f64>, count: usize) -> Vec<Vec<FourVectors>> {
        let strip = |first: usize| {
            let mut strip = self.operator.zeros();
            for (at, block) in self.basis.iter().enumerate() {
                let by: Square4 = std::array::from_fn(|i| {
                    std::array::from_fn(|j| {
                        let column = first + j;
                        if column < count { -vectors[(STRIP_WIDTH * at + i, column)] } else { 0.0 }
                    })
                });
                subtract_combination(block, &by, &mut strip);
            }
            strip
        };
        (0..count).step_by(STRIP_WIDTH).map(strip).collect()
    }

    fn pairs(&self, values: &[f64], vectors: &DMatrix<f64>, count: usize) -> Pairs {
        Pairs { values: values[..count].to_vec(), strips: self.combined(vectors, count) }
    }

    fn restart(&mut self, values: &[f64], vectors: &DMatrix<f64>, keep: usize) {
        let keep = keep.next_multiple_of(STRIP_WIDTH).min(values.len());
        self.basis = self.combined(vectors, keep);
        self.projected = DMatrix::from_diagonal(&DVector::from_column_slice(&values[..keep]));
    }
}

fn orthonormalise(block: &mut [FourVectors], momenta: &mut [FourVectors]) -> Square4 {
    let mut triangle = Square4::default();
    (0..STRIP_WIDTH).for_each(|at| triangle[at][at] = 1.0);
    let mut sizes = None;
    // The second pass of the orthogonalisation removes the errors of the first pass, which increase with the condition number of the block.
    // Almost parallel vectors need a third pass of the orthogonalisation.
    for pass in 0..3 {
        let gram = products(block, momenta);
        let sizes = sizes.get_or_insert_with(|| std::array::from_fn(|at| gram[at][at]));
        if pass == 2 && is_orthonormal(&gram) {
            break;
        }
        let (upper, inverse) = cholesky(&gram, sizes);
        combine(block, &inverse);
        combine(momenta, &inverse);
        triangle = product(&upper, &triangle);
    }
    triangle
}

fn is_orthonormal(gram: &Square4) -> bool {
    let expected = |i: usize, j: usize| f64::from(u8::from(i == j && gram[i][i] > 0.0));
    (0..STRIP_WIDTH)
        .all(|i| (0..STRIP_WIDTH).all(|j| (gram[i][j] - expected(i, j)).abs() < ORTHONORMAL))
}

fn product(a: &Square4, b: &Square4) -> Square4 {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..STRIP_WIDTH).map(|k| a[i][k] * b[k][j]).sum())
    })
}

/// Cholesky factor of a matrix of scalar products, and the inverse of this factor.
/// Rows and columns that consist of rounding errors are set to zero.
fn cholesky(gram: &Square4, sizes: &FourVectors) -> (Square4, Square4) {
    let (mut upper, mut inverse) = (Square4::default(), Square4::default());
    for j in 0..STRIP_WIDTH {
        for i in 0..j {
            let known: f64 = (0..i).map(|k| upper[k][i] * upper[k][j]).sum();
            if upper[i][i] > 0.0 {
                upper[i][j] = (gram[i][j] - known) / upper[i][i];
            }
        }
        let left = gram[j][j] - (0..j).map(|k| square(upper[k][j])).sum::<f64>();
        let is_left =
            left > 1e-14 * gram[j][j] && left > ROUNDING_REDUCTION * ROUNDING_REDUCTION * sizes[j];
        if is_left {
            upper[j][j] = left.sqrt();
            inverse[j][j] = 1.0 / upper[j][j];
            for i in (0..j).rev() {
                if upper[i][i] > 0.0 {
                    let known: f64 = (i + 1..=j).map(|k| upper[i][k] * inverse[k][j]).sum();
                    inverse[i][j] = -known / upper[i][i];
                }
            }
        } else {
            (0..j).for_each(|i| upper[i][j] = if upper[i][i] > 0.0 { upper[i][j] } else { 0.0 });
        }
    }
    (upper, inverse)
}
