//! Short number formats for human readers, without artefacts of binary arithmetic.

use crate::elementary::rounded_to;

/// Shortest text from which `x` can be read back exactly: decimal for `1e-4 ≤ |x| < 1e7`, otherwise with a power of ten.
pub fn format_number(x: f64) -> String {
    if x.is_nan() {
        "nan".into()
    } else if x == 0.0 {
        "0".into()
    } else if x.is_infinite() || (1e-4..1e7).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Text of `x`, rounded to `digits` significant digits (at least one).
/// For example, `significant(1/3, 3)` is `0.333`, and `significant(2.0, 3)` is `2`.
pub fn significant(x: f64, digits: usize) -> String {
    format_number(rounded_to(digits, x))
}

/// Text of `x` with a power of ten and exactly `digits` significant digits (at least one), or `0` for zero.
/// For example, `scientific(3.14e-15, 2)` is `3.1e-15`.
pub fn scientific(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        format_number(x)
    } else {
        format!("{:.*e}", decimals(digits), x)
    }
}

fn decimals(digits: usize) -> usize {
    digits.clamp(1, 17) - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_are_formatted_in_their_shortest_form() {
        let cases = [
            (1e-12, "1e-12"),
            (0.05, "0.05"),
            (374.28285, "374.28285"),
            (2.5, "2.5"),
            (3.0, "3"),
            (-0.0, "0"),
            (1.5e-7, "1.5e-7"),
            (1e10, "1e10"),
            (1e-4, "0.0001"),
            (9999999.0, "9999999"),
            (1e7, "1e7"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
        ];
        for (x, text) in cases {
            assert_eq!(format_number(x), text);
        }
    }

    #[test]
    fn rounded_numbers_keep_the_format() {
        assert_eq!(significant(1.0 / 3.0, 6), "0.333333");
        assert_eq!(significant(0.1 + 0.2, 6), "0.3");
        assert_eq!(significant(123456789.0, 3), "1.23e8");
        assert_eq!(significant(2.0, 0), "2");
        assert_eq!(significant(f64::NAN, 3), "nan");
        assert_eq!(scientific(3.14159e-15, 2), "3.1e-15");
        assert_eq!(scientific(2.0, 3), "2.00e0");
        assert_eq!(scientific(0.0, 2), "0");
        assert_eq!(scientific(f64::INFINITY, 2), "inf");
    }

    proptest! {
        #[test]
        fn formatted_numbers_are_read_back_bit_for_bit(x in proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL) {
            prop_assert_eq!(format_number(x).parse::<f64>().unwrap().to_bits(), x.to_bits());
        }
    }
}
