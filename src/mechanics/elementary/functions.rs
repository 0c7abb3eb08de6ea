//! Trigonometric, hyperbolic and exponential functions and their inverses, by the crate `libm`: musl's and FreeBSD's in Rust.
//!
//! Errors are below one unit in the last place for most of them, below two for the hyperbolic ones. Angles are in radians; undefined
//! values are NaN, as in IEEE 754.

/// The sine of an angle [rad], with the same bits on every machine.
#[inline]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// The cosine of an angle [rad], with the same bits on every machine.
#[inline]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine, in this order, of an angle [rad]: those of [`sin`] and [`cos`], for little more than the price of one.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// The tangent of an angle [rad], with the same bits on every machine.
#[inline]
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// The angle in `[-π/2, π/2]` [rad] whose sine is `x`; NaN outside `[-1, 1]`.
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// The angle in `[0, π]` [rad] whose cosine is `x`; NaN outside `[-1, 1]`.
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// The angle in `[-π/2, π/2]` [rad] whose tangent is `x`.
#[inline]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// The angle in `[-π, π]` [rad] from the first axis to the vector `(x, y)`.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// The hyperbolic sine of a number.
#[inline]
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// The hyperbolic cosine of a number.
#[inline]
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// The hyperbolic tangent of a number.
#[inline]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// The number whose hyperbolic sine is `x`.
#[inline]
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}

/// The number of zero or more whose hyperbolic cosine is `x`; NaN for `x` below 1.
#[inline]
pub fn acosh(x: f64) -> f64 {
    libm::acosh(x)
}

/// The number whose hyperbolic tangent is `x`; NaN outside `[-1, 1]`.
#[inline]
pub fn atanh(x: f64) -> f64 {
    libm::atanh(x)
}

/// The exponential `eˣ` of a number.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The natural logarithm of a number; NaN for a negative one.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The logarithm of a number to base 2; exact for powers of 2.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// The logarithm of a number to base 10; exact for powers of 10 that are whole.
#[inline]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// The logarithm of a number to any base: a quotient of natural logarithms.
#[inline]
pub fn log(x: f64, base: f64) -> f64 {
    ln(x) / ln(base)
}

/// The length of the vector `(x, y)`, without overflow on the way.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The distance of two numbers in units in the last place.
    fn apart(a: f64, b: f64) -> u64 {
        let place = |x: f64| match x.to_bits() as i64 {
            bits if bits < 0 => i64::MIN - bits,
            bits => bits,
        };
        if a.is_nan() && b.is_nan() { 0 } else { place(a).abs_diff(place(b)) }
    }

    #[test]
    fn logarithms_of_powers_are_whole() {
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
    fn undefined_values_are_nan_and_special_ones_exact() {
        assert!(asin(1.5).is_nan() && ln(-1.0).is_nan() && acosh(0.5).is_nan());
        assert_eq!((exp(f64::NEG_INFINITY), ln(0.0)), (0.0, f64::NEG_INFINITY));
        assert_eq!(
            (atan2(0.0, -1.0), atan2(-0.0, -1.0)),
            (std::f64::consts::PI, -std::f64::consts::PI)
        );
        // Their squares are beyond all numbers.
        let large = 2_f64.powi(900);
        assert_eq!((hypot(3.0, 4.0), hypot(3.0 * large, 4.0 * large)), (5.0, 5.0 * large));
        assert_eq!((sin(-0.0).to_bits(), cos(0.0)), ((-0.0_f64).to_bits(), 1.0));
    }

    // The machine's own functions are right to about one unit: ours may not be far from them.
    proptest! {
        #[test]
        fn they_are_those_of_the_machine_but_for_the_last_bits(
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
