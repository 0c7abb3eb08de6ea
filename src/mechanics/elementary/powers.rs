//! Powers.

/// Square `x²`.
#[inline(always)]
pub fn square(x: f64) -> f64 {
    x * x
}

/// Integer power, computed by repeated squaring from the lowest bit of the exponent. A negative exponent `-n` gives `1/xⁿ`.
///
/// The order of multiplications is fixed, which also fixes every rounding error. For `f64::powi`, the compiler chooses the order.
#[inline]
pub fn whole_power(x: f64, exponent: i32) -> f64 {
    let (mut power, mut squares, mut left) = (1.0, x, exponent.unsigned_abs());
    loop {
        if left & 1 == 1 {
            power *= squares;
        }
        left >>= 1;
        if left == 0 {
            break;
        }
        squares *= squares;
    }
    if exponent < 0 { 1.0 / power } else { power }
}

/// Power with any exponent; NaN if the power is undefined. Integer powers of integers are exact if they have at most 53 bits.
#[inline]
pub fn power(x: f64, exponent: f64) -> f64 {
    libm::pow(x, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn integer_powers_of_integers_are_exact() {
        for base in -12..=12_i64 {
            for exponent in 0..=14_u32 {
                let exact = base.pow(exponent) as f64;
                assert_eq!(whole_power(base as f64, exponent as i32), exact, "{base}^{exponent}");
                assert_eq!(power(base as f64, f64::from(exponent)), exact, "{base}^{exponent}");
            }
        }
        assert_eq!((whole_power(2.0, -3), whole_power(0.0, 0), square(-3.0)), (0.125, 1.0, 9.0));
        assert_eq!(whole_power(2.0, i32::MIN), 0.0);
    }

    proptest! {
        #[test]
        fn powers_agree_with_libm_to_the_last_bits(x in 1e-3..1e3_f64, exponent in -40.0..40.0_f64) {
            let (ours, theirs) = (power(x, exponent), x.powf(exponent));
            prop_assert!((ours / theirs - 1.0).abs() < 5e-16, "{ours:e} {theirs:e}");
        }
    }
}
