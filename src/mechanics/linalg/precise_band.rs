//! Symmetric band matrix with about 32 digits, and its elimination.
//!
//! The stiffness of a slender beam is a sum `Bᵀ C B` of terms with very different magnitudes. For soft modes, the large terms cancel.
//! With 32 digits, the stiffness of soft modes and the signs of the pivots of `L D Lᵀ` are accurate.

use pulp::{Arch, Simd, WithSimd};

use super::double_double::{DoubleDouble, DoubleDoublesMut, add_multiple};
use super::symmetric_factors::{Pivots, SymmetricFactors, eliminate};
use super::{LinearError, SymmetricSparse};

/// Symmetric band matrix of double-double numbers. Entries `(i, j)` are zero if `|i - j|` exceeds the half-bandwidth.
#[derive(Debug, Clone)]
pub struct PreciseBand {
    pub(super) size: usize,
    pub(super) half_bandwidth: usize,
    pub(super) high: Vec<f64>,
    pub(super) low: Vec<f64>,
}

/// Number of zeros stored after each row.
pub(super) const MARGIN: usize = 3;

impl PreciseBand {
    /// Creates a zero matrix of `size` rows. Entries can be up to `half_bandwidth` columns away from the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize) -> Self {
        let count = size * (half_bandwidth + 1 + MARGIN);
        Self { size, half_bandwidth, high: vec![0.0; count], low: vec![0.0; count] }
    }

    pub fn size(&self) -> usize {
        self.size
    }

    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    pub(super) fn stride(&self) -> usize {
        self.half_bandwidth + 1 + MARGIN
    }

    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        self.high[row * self.stride()]
    }

    /// Adds `factor r rᵀ` to the matrix. Entry `k` of the vector `r` belongs to the unknown `unknowns[k]`.
    /// Unknowns with a number not below the size of the matrix are ignored.
    pub(crate) fn add_square(&mut self, unknowns: &[usize], factor: f64, r: &[f64]) {
        let is_consecutive = unknowns.windows(2).all(|pair| pair[1] == pair[0] + 1);
        if is_consecutive && unknowns.last().is_some_and(|last| *last < self.size) {
            return Arch::new().dispatch(PreciseSquare {
                band: self,
                first: unknowns[0],
                factor,
                r,
            });
        }
        for (&row, &a) in unknowns.iter().zip(r) {
            if row < self.size && a != 0.0 {
                let a = DoubleDouble::product(factor, a);
                for (&column, &b) in unknowns.iter().zip(r) {
                    if row <= column && column < self.size {
                        self.add_double_double(row, column, a.times(b));
                    }
                }
            }
        }
    }

    /// Adds `p qᵀ + q pᵀ` to the matrix. Entry `k` of the vectors `p` and `q` belongs to the unknown `unknowns[k]`.
    /// Unknowns with a number not below the size of the matrix are ignored.
    pub(crate) fn add_product(&mut self, unknowns: &[usize], p: &[f64], q: &[f64]) {
        for ((&row, &p_a), &q_a) in unknowns.iter().zip(p).zip(q) {
            for ((&column, &p_b), &q_b) in unknowns.iter().zip(p).zip(q) {
                if row <= column && column < self.size {
                    let value =
                        DoubleDouble::product(p_a, q_b).plus(DoubleDouble::product(q_a, p_b));
                    self.add_double_double(row, column, value);
                }
            }
        }
    }

    fn add_double_double(&mut self, row: usize, column: usize, value: DoubleDouble) {
        let at = row * self.stride() + column - row;
        let sum = DoubleDouble { high: self.high[at], low: self.low[at] }.plus(value);
        (self.high[at], self.low[at]) = (sum.high, sum.low);
    }

    /// Factorises the sum of this matrix and `shift` times the matrix `other`.
    pub fn factorise(
        &self,
        shift: f64,
        other: &SymmetricSparse,
    ) -> Result<SymmetricFactors, LinearError> {
        SymmetricFactors::of(self, shift, other)
    }

    /// Signs of the pivots of the sum of this matrix and `shift` times the matrix `other`. Zero rows have no sign.
    ///
    /// # Errors
    /// Fails if the pivot of a nonzero row is zero, or a pivot is not finite.
    pub(crate) fn pivots(
        &self,
        shift: f64,
        other: &SymmetricSparse,
    ) -> Result<Pivots, LinearError> {
        eliminate(self, shift, other, None)
    }
}

struct PreciseSquare<'a> {
    band: &'a mut PreciseBand,
    first: usize,
    factor: f64,
    r: &'a [f64],
}

impl WithSimd for PreciseSquare<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { band, first, factor, r } = self;
        let stride = band.stride();
        for (at, &entry) in r.iter().enumerate() {
            if entry != 0.0 {
                let (start, of) = ((first + at) * stride, &r[at..]);
                let to = DoubleDoublesMut {
                    high: &mut band.high[start..][..of.len()],
                    low: &mut band.low[start..][..of.len()],
                };
                add_multiple(simd, DoubleDouble::product(factor, entry), of, to);
            }
        }
    }
}
