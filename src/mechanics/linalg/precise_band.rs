//! A symmetric banded matrix with about 32 digits, and the elimination of it.
//!
//! The stiffness of a slender beam is a sum `Bᵀ C B` of squares of very different weight. What its soft movements meet is what is
//! left of the large numbers, and a sum that is rounded to 16 digits has lost it. With 32 digits it is there, and so are the signs of the
//! pivots of `L D Lᵀ`.

use pulp::{Arch, Simd, WithSimd};

use super::double_double::{DoubleDouble, DoubleDoublesMut, add_multiple};
use super::symmetric_factors::{Pivots, SymmetricFactors, eliminate};
use super::{LinearError, SymmetricSparse};

/// A symmetric matrix with numbers of about 32 digits whose entries `(i, j)` vanish for `|i - j|` above the half-bandwidth.
#[derive(Debug, Clone)]
pub struct PreciseBand {
    pub(super) size: usize,
    pub(super) half_bandwidth: usize,
    /// The high parts of the upper triangle: row `i` holds the columns `i ..= i + b`, and zeros behind them for whole vectors.
    pub(super) high: Vec<f64>,
    pub(super) low: Vec<f64>,
}

/// The number of zeros behind the entries of a row of a precise banded matrix, for whole vectors.
pub(super) const MARGIN: usize = 3;

impl PreciseBand {
    /// The zero matrix of `size` rows with entries up to `half_bandwidth` places off the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize) -> Self {
        let count = size * (half_bandwidth + 1 + MARGIN);
        Self { size, half_bandwidth, high: vec![0.0; count], low: vec![0.0; count] }
    }

    /// The number of rows of the matrix, and of its columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The half-bandwidth of the matrix: how many places off the diagonal entries may be.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    pub(super) fn stride(&self) -> usize {
        self.half_bandwidth + 1 + MARGIN
    }

    /// The diagonal entry of a row of the matrix, rounded to 16 digits.
    pub fn diagonal(&self, row: usize) -> f64 {
        self.high[row * self.stride()]
    }

    /// Adds `factor r rᵀ` to the matrix; entry `k` of `r` stands for the unknown `unknowns[k]`, and counts where that is below the size.
    pub fn add_square(&mut self, unknowns: &[usize], factor: f64, r: &[f64]) {
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
                    // Each pair of different unknowns comes by twice, and is taken once.
                    if row <= column && column < self.size {
                        self.add_twofold(row, column, a.times(b));
                    }
                }
            }
        }
    }

    /// Adds `p qᵀ + q pᵀ` to the matrix; entries `k` of `p` and `q` stand for the unknown `unknowns[k]`, as far as that is below the size.
    pub fn add_product(&mut self, unknowns: &[usize], p: &[f64], q: &[f64]) {
        for ((&row, &p_a), &q_a) in unknowns.iter().zip(p).zip(q) {
            for ((&column, &p_b), &q_b) in unknowns.iter().zip(p).zip(q) {
                if row <= column && column < self.size {
                    let value =
                        DoubleDouble::product(p_a, q_b).plus(DoubleDouble::product(q_a, p_b));
                    self.add_twofold(row, column, value);
                }
            }
        }
    }

    fn add_twofold(&mut self, row: usize, column: usize, value: DoubleDouble) {
        let at = row * self.stride() + column - row;
        let sum = DoubleDouble { high: self.high[at], low: self.low[at] }.plus(value);
        (self.high[at], self.low[at]) = (sum.high, sum.low);
    }

    /// The factors of `A + σ M`, this matrix plus `shift` times another, with which systems are solved.
    ///
    /// # Errors
    /// When a pivot is zero or not finite.
    pub fn factorise(
        &self,
        shift: f64,
        other: &SymmetricSparse,
    ) -> Result<SymmetricFactors, LinearError> {
        SymmetricFactors::of(self, shift, other)
    }

    /// The signs of the pivots of `A + σ M`, this matrix plus `shift` times another; a row of nothing but zeros counts for neither sign.
    ///
    /// # Errors
    /// When another pivot is zero, or one not finite.
    pub fn pivots(&self, shift: f64, other: &SymmetricSparse) -> Result<Pivots, LinearError> {
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
