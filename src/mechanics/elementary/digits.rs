//! Decimal rounding.

/// Rounds a number to the given number of significant digits, at least 1 and at most 17. With 17 digits, a float is unchanged.
pub fn rounded_to(digits: usize, number: f64) -> f64 {
    format!("{number:.*e}", digits.clamp(1, 17) - 1).parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_counts_digits_from_the_first_nonzero_one() {
        assert_eq!(rounded_to(3, 0.012_345), 0.0123);
        assert_eq!(rounded_to(1, -47.0), -50.0);
        assert_eq!(rounded_to(0, 47.0), 50.0);
        assert!(rounded_to(6, f64::NAN).is_nan());
        assert_eq!(rounded_to(6, f64::INFINITY), f64::INFINITY);
    }
}
