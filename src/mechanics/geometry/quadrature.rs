//! Gauss–Legendre quadrature.

use super::GeometryError;
use crate::elementary::cos;
use std::f64::consts::PI;

const MOST_POINTS: usize = 64;

/// Gauss–Legendre rule with `n` points, exact for polynomials up to degree `2n - 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussRule {
    /// Points on `[-1, 1]`, increasing and exactly symmetric about 0.
    pub points: Vec<f64>,
    /// Positive weights with sum 2.
    pub weights: Vec<f64>,
}

impl GaussRule {
    /// Returns the Gauss–Legendre rule with `n` points, accurate to rounding.
    ///
    /// # Errors
    /// Fails for `n` outside 1 to 64.
    pub fn new(n: usize) -> Result<Self, GeometryError> {
        if (1..=MOST_POINTS).contains(&n) {
            Ok(Self::legendre(n))
        } else {
            Err(GeometryError::QuadraturePoints { points: n, largest: MOST_POINTS })
        }
    }

    /// Gauss–Legendre rule with `n` points (Abramowitz & Stegun 25.4.29), computed by Newton's method from Tricomi's estimate.
    pub(super) fn legendre(n: usize) -> Self {
        let (mut points, mut weights) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n.div_ceil(2) {
            let mut x = cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
            for _ in 0..8 {
                let (value, slope) = legendre_polynomial(n, x);
                x -= value / slope;
            }
            if 2 * i + 1 == n {
                x = 0.0;
            }
            let (_, slope) = legendre_polynomial(n, x);
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (points[i], points[n - 1 - i]) = (-x, x);
            (weights[i], weights[n - 1 - i]) = (weight, weight);
        }
        Self { points, weights }
    }

    /// Points and weights of the rule on `[start, end]`: `∫ f dξ ≈ Σ weight · f(point)`.
    pub fn iter_on(&self, start: f64, end: f64) -> impl Iterator<Item = (f64, f64)> {
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        self.points
            .iter()
            .zip(&self.weights)
            .map(move |(x, weight)| (middle + half * x, half * weight))
    }
}

fn legendre_polynomial(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (before - x * value) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_gauss_rules_have_known_points_and_weights() {
        let one = GaussRule::new(1).unwrap();
        assert_eq!((one.points[0], one.weights[0]), (0.0, 2.0));
        let three = GaussRule::new(3).unwrap();
        assert!((three.points[2] - 0.6f64.sqrt()).abs() < 1e-16 && three.points[1] == 0.0);
        assert!((three.weights[1] - 8.0 / 9.0).abs() < 1e-15);
    }

    #[test]
    fn rules_are_symmetric_and_exact_to_degree_2n_minus_1() {
        for n in 1..=MOST_POINTS {
            let rule = GaussRule::new(n).unwrap();
            assert!(rule.points.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(rule.points.iter().zip(rule.points.iter().rev()).all(|(a, b)| *a == -b), "{n}");
            for power in 0..2 * n as i32 {
                let sum: f64 =
                    rule.iter_on(0.0, 1.0).map(|(x, weight)| weight * x.powi(power)).sum();
                assert!(
                    (sum - 1.0 / f64::from(power + 1)).abs() < 1e-14,
                    "{n} points, power {power}: {sum}"
                );
            }
        }
    }

    #[test]
    fn gauss_rule_is_not_exact_for_degree_2n() {
        let rule = GaussRule::new(2).unwrap();
        let sum: f64 = rule.iter_on(-1.0, 1.0).map(|(x, weight)| weight * x.powi(4)).sum();
        assert!((sum - 0.4).abs() > 0.1);
    }

    #[test]
    fn gauss_rules_outside_1_to_64_points_are_rejected() {
        let refusal = |n| GaussRule::new(n).unwrap_err().to_string();
        assert_eq!(refusal(0), "quadrature: 0 points requested, but 1 to 64 are allowed");
        assert_eq!(refusal(65), "quadrature: 65 points requested, but 1 to 64 are allowed");
    }
}
