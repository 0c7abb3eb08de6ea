//! Maximum and minimum that propagate NaN.

/// Larger of two numbers. Unlike `f64::max`, this function returns NaN if either number is NaN.
#[inline]
pub fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Smaller of two numbers. Unlike `f64::min`, this function returns NaN if either number is NaN.
#[inline]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a <= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_are_nan_if_a_value_is_nan() {
        assert_eq!((larger(1.0, 2.0), smaller(1.0, 2.0)), (2.0, 1.0));
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
            assert!(larger(a, b).is_nan() && smaller(a, b).is_nan());
        }
    }
}
