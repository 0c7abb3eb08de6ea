//! Double-double arithmetic.
//!
//! References: T. J. Dekker, Numer. Math. 18 (1971) 224–242; Y. Hida, X. S. Li & D. H. Bailey, ARITH-15 (2001) 155–162.
//!
//! Implementations of fused multiply–add in hardware and software give identical results, because IEEE 754 requires a single rounding.
#![allow(clippy::disallowed_methods)]

use pulp::Simd;

/// Number with about 32 decimal digits: the unevaluated sum `high + low`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct DoubleDouble {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl DoubleDouble {
    #[inline(always)]
    pub(super) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    #[inline(always)]
    pub(super) fn plus(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let lost = (self.high - (sum - part)) + (other.high - part);
        Self::renormalised(sum, lost + (self.low + other.low))
    }

    #[inline(always)]
    pub(super) fn times(self, factor: f64) -> Self {
        let Self { high, low } = Self::product(self.high, factor);
        Self::renormalised(high, self.low.mul_add(factor, low))
    }

    #[inline(always)]
    pub(super) fn multiply_double_double(self, other: Self) -> Self {
        let Self { high, low } = Self::product(self.high, other.high);
        let low = self.high.mul_add(other.low, low);
        Self::renormalised(high, self.low.mul_add(other.high, low))
    }

    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        let guess = 1.0 / self.high;
        // The fused multiply–add computes `1 - guess · high` exactly, so that the remainder `1 - guess · self` has a small relative error.
        let rest = (-guess).mul_add(self.low, (-guess).mul_add(self.high, 1.0));
        Self::renormalised(guess, guess * rest)
    }

    #[inline(always)]
    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }
}

#[derive(Debug)]
pub(super) struct DoubleDoubles<'a> {
    pub(super) high: &'a [f64],
    pub(super) low: &'a [f64],
}

#[derive(Debug)]
pub(super) struct DoubleDoublesMut<'a> {
    pub(super) high: &'a mut [f64],
    pub(super) low: &'a mut [f64],
}

#[inline(always)]
pub(super) fn subtract_multiple<S: Simd>(
    simd: S,
    factor: DoubleDouble,
    of: &DoubleDoubles<'_>,
    from: DoubleDoublesMut<'_>,
) {
    let count = from.high.len();
    let (high, high_rest) = S::as_mut_simd_f64s(from.high);
    let (low, low_rest) = S::as_mut_simd_f64s(from.low);
    let (of_high, of_high_rest) = S::as_simd_f64s(&of.high[..count]);
    let (of_low, of_low_rest) = S::as_simd_f64s(&of.low[..count]);
    let (fh, fl) = (simd.splat_f64s(factor.high), simd.splat_f64s(factor.low));
    for (((high, low), ph), pl) in high.iter_mut().zip(low).zip(of_high).zip(of_low) {
        let product = simd.mul_f64s(fh, *ph);
        let lost = simd.mul_add_f64s(fh, *ph, simd.neg_f64s(product));
        let lost = simd.mul_add_f64s(fl, *ph, simd.mul_add_f64s(fh, *pl, lost));
        let difference = simd.sub_f64s(*high, product);
        let part = simd.sub_f64s(difference, *high);
        let rest = simd.sub_f64s(
            simd.sub_f64s(*high, simd.sub_f64s(difference, part)),
            simd.add_f64s(product, part),
        );
        let rest = simd.add_f64s(rest, simd.sub_f64s(*low, lost));
        *high = simd.add_f64s(difference, rest);
        *low = simd.sub_f64s(rest, simd.sub_f64s(*high, difference));
    }
    let minus = DoubleDouble { high: -factor.high, low: -factor.low };
    for (((high, low), ph), pl) in
        high_rest.iter_mut().zip(low_rest).zip(of_high_rest).zip(of_low_rest)
    {
        let product = minus.multiply_double_double(DoubleDouble { high: *ph, low: *pl });
        let sum = DoubleDouble { high: *high, low: *low }.plus(product);
        (*high, *low) = (sum.high, sum.low);
    }
}

#[inline(always)]
pub(super) fn add_multiple<S: Simd>(
    simd: S,
    factor: DoubleDouble,
    of: &[f64],
    to: DoubleDoublesMut<'_>,
) {
    let (of, of_rest) = S::as_simd_f64s(of);
    let (high, high_rest) = S::as_mut_simd_f64s(to.high);
    let (low, low_rest) = S::as_mut_simd_f64s(to.low);
    let (fh, fl) = (simd.splat_f64s(factor.high), simd.splat_f64s(factor.low));
    for ((high, low), p) in high.iter_mut().zip(low).zip(of) {
        let product = simd.mul_f64s(fh, *p);
        let lost = simd.mul_add_f64s(fh, *p, simd.neg_f64s(product));
        let lost = simd.mul_add_f64s(fl, *p, lost);
        let sum = simd.add_f64s(*high, product);
        let part = simd.sub_f64s(sum, *high);
        let rest = simd
            .add_f64s(simd.sub_f64s(*high, simd.sub_f64s(sum, part)), simd.sub_f64s(product, part));
        let rest = simd.add_f64s(rest, simd.add_f64s(*low, lost));
        *high = simd.add_f64s(sum, rest);
        *low = simd.sub_f64s(rest, simd.sub_f64s(*high, sum));
    }
    for ((high, low), p) in high_rest.iter_mut().zip(low_rest).zip(of_rest) {
        let sum = DoubleDouble { high: *high, low: *low }.plus(factor.times(*p));
        (*high, *low) = (sum.high, sum.low);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_part_keeps_the_rounding_error_of_the_high_part() {
        let third = DoubleDouble { high: 3.0, low: 0.0 }.inverse();
        assert_eq!(third.high, 1.0 / 3.0);
        let back = third.times(3.0).plus(DoubleDouble { high: -1.0, low: 0.0 });
        assert!(back.high.abs() < 1e-31, "{back:?}");
        let tiny = DoubleDouble::default()
            .plus(DoubleDouble { high: 1e20, low: 0.0 })
            .plus(DoubleDouble { high: 1e-5, low: 0.0 })
            .plus(DoubleDouble { high: -1e20, low: 0.0 });
        assert!((tiny.high - 1e-5).abs() < 1e-16, "{tiny:?}");
        let square = third
            .multiply_double_double(third)
            .times(9.0)
            .plus(DoubleDouble { high: -1.0, low: 0.0 });
        assert!(square.high.abs() < 1e-30, "{square:?}");
    }
}
