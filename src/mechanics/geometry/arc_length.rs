//! Arc length by quadrature of the speed `|dx/dξ|`, and its inverse.

use super::GaussRule;
use std::sync::LazyLock;

/// Largest number of successive halvings of an interval. Only curves with cusps need this number.
const DEPTH: usize = 48;

/// Largest number of iterations. Newton's method needs about five, and bisection alone about 60.
const STEPS: usize = 100;

static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::legendre(16));

/// Integral `∫ speed dξ` from `start` to `end`.
/// Intervals are halved until the 16-point Gauss rule on an interval and on its two halves agree within `tolerance`.
pub(super) fn integrate(speed: &impl Fn(f64) -> f64, start: f64, end: f64, tolerance: f64) -> f64 {
    refine(speed, (start, end), gauss(speed, start, end), tolerance, DEPTH)
}

fn gauss(speed: &impl Fn(f64) -> f64, start: f64, end: f64) -> f64 {
    RULE.iter_on(start, end).map(|(xi, weight)| weight * speed(xi)).sum()
}

fn refine(
    speed: &impl Fn(f64) -> f64,
    (start, end): (f64, f64),
    whole: f64,
    tolerance: f64,
    depth: usize,
) -> f64 {
    let middle = 0.5 * (start + end);
    let (left, right) = (gauss(speed, start, middle), gauss(speed, middle, end));
    if depth > 0 && (left + right - whole).abs() > tolerance {
        refine(speed, (start, middle), left, tolerance, depth - 1)
            + refine(speed, (middle, end), right, tolerance, depth - 1)
    } else {
        left + right
    }
}

/// Parameter `ξ` in `[start, end]` for which the integral of `speed` from `start` to `ξ` equals `length`.
pub(super) fn invert(
    speed: &impl Fn(f64) -> f64,
    start: f64,
    end: f64,
    length: f64,
    tolerance: f64,
) -> f64 {
    let smallest_step = f64::EPSILON * (end - start);
    let (mut low, mut high) = (start, end);
    let mut xi = 0.5 * (start + end);
    for _ in 0..STEPS {
        let excess = integrate(speed, start, xi, tolerance) - length;
        if excess < 0.0 {
            low = xi
        } else {
            high = xi
        }
        let newton = xi - excess / speed(xi);
        let next = if low <= newton && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - xi).abs() <= smallest_step {
            return next;
        }
        xi = next;
    }
    xi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_kinked_speeds_are_integrated_to_rounding() {
        let smooth = integrate(&|xi: f64| (1.0 + 4.0 * xi * xi).sqrt(), 0.0, 1.0, 1e-15);
        let exact = 0.5 * 5f64.sqrt() + 0.25 * 2f64.asinh();
        assert!((smooth - exact).abs() < 1e-14);
        let kinked = integrate(&|xi: f64| (xi - 0.3).abs(), 0.0, 1.0, 1e-15);
        assert!((kinked - 0.5 * (0.09 + 0.49)).abs() < 1e-14);
    }

    #[test]
    fn arc_length_is_inverted_where_the_speed_is_zero() {
        for length in [0.0, 1e-12, 1e-3, 0.25, 1.0] {
            let xi = invert(&|xi: f64| 2.0 * xi, 0.0, 1.0, length, 1e-16);
            assert!((xi - length.sqrt()).abs() < 1e-14, "{length}: {xi}");
        }
    }
}
