//! Trigonometric, hyperbolic and exponential functions and their inverses.
//! The functions come from the crate `libm`, a Rust port of the functions of musl and FreeBSD.
//!
//! Errors are mostly below one unit in the last place, and below two units for hyperbolic functions. Angles are in radians.
//! Undefined values are NaN as required by IEEE 754.

/// Sine of an angle [rad], identical on every machine.
#[inline]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// Cosine of an angle [rad], identical on every machine.
#[inline]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine of an angle [rad], equal to [`sin`] and [`cos`]. One call is faster than two.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Tangent of an angle [rad], identical on every machine.
#[inline]
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// Angle in `[-π/2, π/2]` [rad] whose sine is `x`; NaN outside `[-1, 1]`.
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Angle in `[0, π]` [rad] whose cosine is `x`; NaN outside `[-1, 1]`.
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Angle in `[-π/2, π/2]` [rad] whose tangent is `x`.
#[inline]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Angle in `[-π, π]` [rad] from the first axis to the vector `(x, y)`.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Hyperbolic sine.
#[inline]
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// Hyperbolic cosine.
#[inline]
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// Hyperbolic tangent.
#[inline]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// Inverse hyperbolic sine.
#[inline]
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}

/// Inverse hyperbolic cosine, zero or more; NaN for `x` below 1.
#[inline]
pub fn acosh(x: f64) -> f64 {
    libm::acosh(x)
}

/// Inverse hyperbolic tangent; NaN outside `[-1, 1]`.
#[inline]
pub fn atanh(x: f64) -> f64 {
    libm::atanh(x)
}

/// Exponential `eˣ`.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm; NaN for negative numbers.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Logarithm to base 2; exact for powers of 2.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// Logarithm to base 10; exact for integer powers of 10.
#[inline]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// Logarithm to any base, as a quotient of natural logarithms.
#[inline]
pub fn log(x: f64, base: f64) -> f64 {
    ln(x) / ln(base)
}

/// Length of the vector `(x, y)`, without intermediate overflow.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn apart(a: f64, b: f64) -> u64 {
        let place = |x: f64| match x.to_bits() as i64 {
            bits if bits < 0 => i64::MIN - bits,
            bits => bits,
        };
        if a.is_nan() && b.is_nan() { 0 } else { place(a).abs_diff(place(b)) }
    }

    #[test]
    fn logarithms_of_powers_are_exact_integers() {
        for n in 0..=22_u32 {
            let power: f64 = format!("1e{n}").parse().unwrap();
            assert_eq!(log10(power), f64::from(n), "1e{n}");
        }
        for n in -1074..1024_i32 {
            let power = if n < -1022 { f64::from_bits(1 << (n + 1074)) } else { 2_f64.powi(n) };
            assert_eq!(log2(power), f64::from(n), "2^{n}");
        }
    }

    #[test]
    fn undefined_function_values_are_nan_and_special_values_exact() {
        assert!(asin(1.5).is_nan() && ln(-1.0).is_nan() && acosh(0.5).is_nan());
        assert_eq!((exp(f64::NEG_INFINITY), ln(0.0)), (0.0, f64::NEG_INFINITY));
        assert_eq!(
            (atan2(0.0, -1.0), atan2(-0.0, -1.0)),
            (std::f64::consts::PI, -std::f64::consts::PI)
        );
        let large = 2_f64.powi(900);
        assert_eq!((hypot(3.0, 4.0), hypot(3.0 * large, 4.0 * large)), (5.0, 5.0 * large));
        assert_eq!((sin(-0.0).to_bits(), cos(0.0)), ((-0.0_f64).to_bits(), 1.0));
    }

    proptest! {
        #[test]
        fn elementary_functions_agree_with_libm_to_the_last_bits(
            x in -700.0..700.0_f64, y in -10.0..10.0_f64, u in -1.0..1.0_f64, large in 1.0..1e300_f64,
        ) {
            let pairs = [
                (sin(x), x.sin()), (cos(x), x.cos()), (tan(x), x.tan()), (sin(large), large.sin()), (cos(large), large.cos()),
                (asin(u), u.asin()), (acos(u), u.acos()), (atan(x), x.atan()), (atan2(x, y), x.atan2(y)),
                (exp(x), x.exp()), (ln(large), large.ln()), (log2(large), large.log2()), (log10(large), large.log10()),
                (hypot(x, y), x.hypot(y)), (cosh(x), x.cosh()), (sinh(x), x.sinh()), (tanh(y), y.tanh()),
            ];
            for angle in [x, y, u, 1e-9 * u, large] {
                prop_assert_eq!(sin_cos(angle), (sin(angle), cos(angle)));
            }
            for (at, (ours, theirs)) in pairs.into_iter().enumerate() {
                prop_assert!(apart(ours, theirs) <= 3, "{at}: {ours:e} {theirs:e}");
            }
            prop_assert!((sinh(asinh(y)) - y).abs() < 1e-13 && (tanh(atanh(u)) - u).abs() < 1e-14);
            prop_assert!((cosh(acosh(1.0 + y.abs())) - 1.0 - y.abs()).abs() < 1e-13);
        }
    }
}
