//! `L D Lᵀ` factorisation of a symmetric band matrix. The elimination uses 32 digits; storage and substitution use 16 digits.
//!
//! Rounding the factors to 16 digits has the effect of small relative changes of the stiffness terms (docs/theory.md, section 15).

use pulp::{Arch, Simd, WithSimd};

use super::double_double::{DoubleDouble, DoubleDoubles, DoubleDoublesMut, subtract_multiple};
use super::precise_band::{MARGIN, PreciseBand};
use super::strips::VectorStrip;
use super::{LinearError, SymmetricSparse};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivots {
    /// Number of negative pivots, equal to the number of negative eigenvalues (Sylvester's law of inertia; Golub & Van Loan, 4th ed., section 4.4).
    pub negative: usize,
    /// Largest reduction of a diagonal entry in the elimination, as a multiple of the entry [-].
    /// The elimination multiplies the rounding error of the matrix by the growth factor, which is at most 1 for a positive definite matrix.
    pub growth: f64,
}

#[derive(Debug, Clone)]
pub struct SymmetricFactors {
    size: usize,
    reach: usize,
    multipliers: Vec<f64>,
    inverse_pivots: Vec<f64>,
    pivots: Pivots,
}

impl SymmetricFactors {
    pub(super) fn of(
        band: &PreciseBand,
        shift: f64,
        other: &SymmetricSparse,
    ) -> Result<Self, LinearError> {
        let (size, reach) = (band.size, band.half_bandwidth);
        let (mut multipliers, mut inverse_pivots) = (vec![0.0; size * reach], vec![0.0; size]);
        let pivots = eliminate(band, shift, other, Some((&mut multipliers, &mut inverse_pivots)))?;
        Ok(Self { size, reach, multipliers, inverse_pivots, pivots })
    }

    pub(crate) fn pivots(&self) -> Pivots {
        self.pivots
    }

    pub fn column(&self, column: usize) -> (&[f64], f64) {
        (&self.multipliers[column * self.reach..][..self.reach], self.inverse_pivots[column])
    }

    /// Replaces four right-hand sides by their solutions.
    /// The right-hand sides must be followed in memory by as many zeros as the half-bandwidth.
    pub fn solve(&self, x: &mut VectorStrip) {
        assert!(x.len() >= self.size + self.reach, "a strip has a margin");
        Arch::new().dispatch(SymmetricSubstitution { factors: self, x });
    }

    /// Replaces four vectors `x` by `R⁻ᵀ x`. The matrix is `Rᵀ R` with the upper triangular factor `R = D^½ Lᵀ`, and is positive definite.
    pub(crate) fn solve_root_transposed(&self, x: &mut VectorStrip) {
        substitute_forwards(self, self.reach, x);
        for (row, inverse) in x.iter_mut().zip(&self.inverse_pivots) {
            row.iter_mut().for_each(|entry| *entry *= inverse.sqrt());
        }
    }

    /// Replaces four vectors `x` by `R⁻¹ x`, with the factor of [`solve_root_transposed`](Self::solve_root_transposed).
    pub(crate) fn solve_root(&self, x: &mut VectorStrip) {
        substitute_backwards(self, self.reach, x, f64::sqrt);
    }
}

type Kept<'a> = (&'a mut [f64], &'a mut [f64]);

pub(super) fn eliminate(
    band: &PreciseBand,
    shift: f64,
    other: &SymmetricSparse,
    kept: Option<Kept<'_>>,
) -> Result<Pivots, LinearError> {
    Arch::new().dispatch(SymmetricElimination { band, shift, other, kept })
}

struct SymmetricElimination<'a> {
    band: &'a PreciseBand,
    shift: f64,
    other: &'a SymmetricSparse,
    kept: Option<Kept<'a>>,
}

impl WithSimd for SymmetricElimination<'_> {
    type Output = Result<Pivots, LinearError>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        match self.band.half_bandwidth {
            5 => self.run(simd, 5),
            8 => self.run(simd, 8),
            11 => self.run(simd, 11),
            reach => self.run(simd, reach),
        }
    }
}

const LANES: usize = MARGIN + 1;

impl SymmetricElimination<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S, reach: usize) -> Result<Pivots, LinearError> {
        let Self { band, shift, other, mut kept } = self;
        let (size, stride) = (band.size, reach + 1 + MARGIN);
        let rows = reach + 1;
        let (mut high, mut low) = (vec![0.0; rows * stride], vec![0.0; rows * stride]);
        let (mut start, mut taken) = (vec![0.0_f64; rows], vec![0.0_f64; rows]);
        let mut pivots = Pivots { negative: 0, growth: 0.0 };
        let mut loaded = 0;
        let (mut pivot_high, mut pivot_low) = (vec![0.0; stride], vec![0.0; stride]);
        for at in 0..size {
            while loaded < size.min(at + rows) {
                let place = loaded % rows;
                let row = place * stride..(place + 1) * stride;
                high[row.clone()].copy_from_slice(&band.high[loaded * stride..][..stride]);
                low[row].copy_from_slice(&band.low[loaded * stride..][..stride]);
                for (column, value) in other.row(loaded) {
                    if column >= loaded {
                        let entry = place * stride + column - loaded;
                        let sum = DoubleDouble { high: high[entry], low: low[entry] }
                            .plus(DoubleDouble::product(shift, value));
                        (high[entry], low[entry]) = (sum.high, sum.low);
                    }
                }
                (start[place], taken[place]) = (high[place * stride].abs(), 0.0);
                loaded += 1;
            }
            let place = at % rows;
            pivot_high.copy_from_slice(&high[place * stride..][..stride]);
            pivot_low.copy_from_slice(&low[place * stride..][..stride]);
            let pivot = DoubleDouble { high: pivot_high[0], low: pivot_low[0] };
            if pivot.high == 0.0 {
                let is_alone = pivot_high.iter().all(|entry| *entry == 0.0);
                if kept.is_none() && is_alone {
                    // The pivot of a zero row counts neither as positive nor as negative.
                    continue;
                }
                return Err(LinearError::Singular { unknown: at, size });
            }
            if !pivot.high.is_finite() {
                return Err(LinearError::NotFinite { unknown: at, size });
            }
            pivots.negative += usize::from(pivot.high < 0.0);
            if start[place] > 0.0 {
                pivots.growth = pivots.growth.max(taken[place] / start[place]);
            }
            let inverse = pivot.inverse();
            for below in 1..=reach.min(size - 1 - at) {
                let entry = DoubleDouble { high: pivot_high[below], low: pivot_low[below] };
                if entry.high == 0.0 {
                    continue;
                }
                let factor = entry.multiply_double_double(inverse);
                let to = (at + below) % rows;
                taken[to] += (factor.high * entry.high).abs();
                let width = (reach + 1 - below).next_multiple_of(LANES);
                let of = DoubleDoubles {
                    high: &pivot_high[below..][..width],
                    low: &pivot_low[below..][..width],
                };
                let from = DoubleDoublesMut {
                    high: &mut high[to * stride..][..width],
                    low: &mut low[to * stride..][..width],
                };
                subtract_multiple(simd, factor, &of, from);
                if let Some((multipliers, _)) = &mut kept {
                    multipliers[at * reach + below - 1] = factor.high;
                }
            }
            if let Some((_, inverse_pivots)) = &mut kept {
                inverse_pivots[at] = inverse.high;
            }
        }
        Ok(pivots)
    }
}

struct SymmetricSubstitution<'a> {
    factors: &'a SymmetricFactors,
    x: &'a mut VectorStrip,
}

impl WithSimd for SymmetricSubstitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factors, x } = self;
        match factors.reach {
            5 => substitute(factors, 5, x),
            8 => substitute(factors, 8, x),
            11 => substitute(factors, 11, x),
            reach => substitute(factors, reach, x),
        }
    }
}

#[inline(always)]
fn substitute(factors: &SymmetricFactors, reach: usize, x: &mut VectorStrip) {
    substitute_forwards(factors, reach, x);
    substitute_backwards(factors, reach, x, |inverse_pivot| inverse_pivot);
}

#[inline(always)]
fn substitute_forwards(factors: &SymmetricFactors, reach: usize, x: &mut VectorStrip) {
    for column in 0..factors.size {
        let multipliers = &factors.multipliers[column * reach..][..reach];
        let (known, below) = x[column..].split_at_mut(1);
        let known = known[0];
        for (entry, multiplier) in below[..reach].iter_mut().zip(multipliers) {
            for (entry, known) in entry.iter_mut().zip(&known) {
                *entry -= multiplier * known;
            }
        }
    }
    // The forward elimination has written entries after the last row, which are reset to zero.
    x[factors.size..].fill([0.0; 4]);
}

#[inline(always)]
fn substitute_backwards(
    factors: &SymmetricFactors,
    reach: usize,
    x: &mut VectorStrip,
    scale: impl Fn(f64) -> f64,
) {
    for column in (0..factors.size).rev() {
        let multipliers = &factors.multipliers[column * reach..][..reach];
        let (value, known) = x[column..].split_at_mut(1);
        // Two sums are used, so that the processor evaluates them concurrently.
        let mut sums = [[0.0; 4]; 2];
        for (at, (multiplier, known)) in multipliers.iter().zip(&known[..reach]).enumerate() {
            for (sum, known) in sums[at % 2].iter_mut().zip(known) {
                *sum += multiplier * known;
            }
        }
        let factor = scale(factors.inverse_pivots[column]);
        for ((value, even), odd) in value[0].iter_mut().zip(sums[0]).zip(sums[1]) {
            *value = *value * factor - (even + odd);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    fn squares(
        size: usize,
        width: usize,
        entries: &[f64],
        signs: bool,
    ) -> (PreciseBand, DMatrix<f64>) {
        let mut band = PreciseBand::zeros(size, width - 1);
        let mut dense = DMatrix::zeros(size, size);
        let mut entries = entries.iter().cycle();
        for first in (0..=size - width).chain(0..=size - width) {
            let row: Vec<f64> = (0..width).map(|_| *entries.next().unwrap()).collect();
            let factor = if signs { *entries.next().unwrap() } else { 1.0 };
            let unknowns: Vec<usize> = (first..first + width).collect();
            band.add_square(&unknowns, factor, &row);
            let r = DVector::from_fn(size, |i, _| {
                i.checked_sub(first).and_then(|k| row.get(k)).copied().unwrap_or(0.0)
            });
            dense += factor * &r * r.transpose();
        }
        (band, dense)
    }

    proptest! {
        #[test]
        fn symmetric_solutions_and_inertia_agree_with_the_dense_matrix(
            size in 12_usize..30, width in 2_usize..12, shift in 0.5..2.0_f64, signs in any::<bool>(),
            entries in prop::collection::vec(-1.0..1.0_f64, 997),
        ) {
            let (band, dense) = squares(size, width, &entries, signs);
            let unit = SymmetricSparse::new(size, |add| (0..size).for_each(|i| add(i, i, 1.0)));
            let shift = if signs { 0.0 } else { shift };
            let dense = dense + DMatrix::identity(size, size) * shift;
            let values = dense.clone().symmetric_eigenvalues();
            prop_assume!(values.iter().all(|value| value.abs() > 1e-3));
            let factors = band.factorise(shift, &unit).unwrap();
            let negative = values.iter().filter(|value| **value < 0.0).count();
            prop_assert_eq!(factors.pivots().negative, negative);
            prop_assert_eq!(band.pivots(shift, &unit).unwrap(), factors.pivots());
            prop_assume!(factors.pivots().growth < 1e3);
            let mut x = vec![[0.0; 4]; size + width];
            for (i, x) in x[..size].iter_mut().enumerate() {
                *x = std::array::from_fn(|k| ((i + 1) as f64 * (k + 1) as f64).sin());
            }
            let right = x.clone();
            if factors.pivots().negative == 0 {
                let mut in_two = x.clone();
                factors.solve_root_transposed(&mut in_two);
                factors.solve_root(&mut in_two);
                factors.solve(&mut x);
                for (a, b) in in_two.as_flattened().iter().zip(x.as_flattened()) {
                    prop_assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} {b}");
                }
                x.clone_from(&right);
            }
            factors.solve(&mut x);
            for k in 0..4 {
                let solution = DVector::from_fn(size, |i, _| x[i][k]);
                let right = DVector::from_fn(size, |i, _| right[i][k]);
                let error = &dense * &solution - right;
                prop_assert!(error.amax() < 1e-9 * solution.amax().max(1.0), "{}", error.amax());
            }
        }

        #[test]
        fn band_products_are_summed_for_unknowns_in_any_order(entries in prop::collection::vec(-1.0..1.0_f64, 8)) {
            let (mut band, mut dense) = (PreciseBand::zeros(5, 4), DMatrix::<f64>::zeros(5, 5));
            let unknowns = [3, 1, 3, 7];
            let (p, q) = entries.split_at(4);
            band.add_square(&unknowns, 2.0, p);
            band.add_product(&unknowns, p, q);
            for a in 0..3 {
                for b in 0..3 {
                    dense[(unknowns[a], unknowns[b])] +=
                        2.0 * p[a] * p[b] + p[a] * q[b] + q[a] * p[b];
                }
            }
            for i in 0..5 {
                for j in i..5 {
                    prop_assert!((band.high[i * band.stride() + j - i] - dense[(i, j)]).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn zero_and_nan_pivots_are_errors() {
        let unit = SymmetricSparse::new(3, |add| [0, 2].into_iter().for_each(|i| add(i, i, 1.0)));
        let band = PreciseBand::zeros(3, 1);
        assert_eq!(band.pivots(-1.0, &unit).unwrap().negative, 2);
        let error = band.factorise(1.0, &unit).unwrap_err();
        assert_eq!(error, LinearError::Singular { unknown: 1, size: 3 });
        let error = band.factorise(f64::NAN, &unit).unwrap_err();
        assert_eq!(error, LinearError::NotFinite { unknown: 0, size: 3 });
    }
}
