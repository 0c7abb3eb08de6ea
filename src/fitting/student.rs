//! Student's t distribution.

use crate::elementary::{exp, ln, power};

const TERMS: usize = 500;
const HALVINGS: usize = 200;

/// Logarithm of the gamma function of a positive number, by the approximation of C. Lanczos (1964) with nine terms and g = 7.
/// The gamma function has a relative error of about 1e-15.
fn ln_gamma(x: f64) -> f64 {
    const TERMS: [f64; 9] = [
        0.999_999_999_999_809_9,
        676.520_368_121_885_1,
        -1_259.139_216_722_402_8,
        771.323_428_777_653_1,
        -176.615_029_162_140_6,
        12.507_343_278_686_905,
        -0.138_571_095_265_720_12,
        9.984_369_578_019_572e-6,
        1.505_632_735_149_311_6e-7,
    ];
    let x = x - 1.0;
    let base = x + 7.5;
    let sum = TERMS.iter().enumerate().skip(1).map(|(k, term)| term / (x + k as f64));
    let sum = TERMS[0] + sum.sum::<f64>();
    0.5 * ln(2.0 * std::f64::consts::PI) + (x + 0.5) * ln(base) - base + ln(sum)
}

/// Regularised incomplete beta function `I_x(a, b)`.
/// The continued fraction of W. H. Press et al., Numerical Recipes, section 6.4, is evaluated by Lentz's method.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let front = exp(ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * ln(x) + b * ln(1.0 - x)) / a;
    let away = |x: f64| if x.abs() < 1e-300 { 1e-300 } else { x };
    let (mut c, mut d) = (1.0, 1.0 / away(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in 1..TERMS {
        let m = m as f64;
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / away(1.0 + even * d);
        c = away(1.0 + even / c);
        fraction *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / away(1.0 + odd * d);
        c = away(1.0 + odd / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-16 {
            break;
        }
    }
    front * fraction
}

/// Quantile of Student's distribution with `freedom` degrees of freedom. `probability` must be above one half.
pub fn student_quantile(probability: f64, freedom: f64) -> f64 {
    let tail = 2.0 * (1.0 - probability);
    // Bisection solves `I_x(ν/2, 1/2) = P` for `x = ν/(ν + t²)`.
    // Here `t` is the quantile, `ν` is the number of degrees of freedom, and `P` is the probability of the two tails together.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        match incomplete_beta(middle, freedom / 2.0, 0.5) < tail {
            true => low = middle,
            false => high = middle,
        }
    }
    let x = (low + high) / 2.0;
    power(freedom * (1.0 - x) / x, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of published tables. For one degree of freedom, the quantile is `tan(π (p - 1/2))`.
    #[test]
    fn student_quantiles_agree_with_published_tables() {
        for (probability, freedom, expected) in [
            (0.975, 1.0, 12.706_204_736_174_7),
            (0.975, 2.0, 4.302_652_729_749_46),
            (0.975, 10.0, 2.228_138_851_964_94),
            (0.95, 30.0, 1.697_260_886_593_96),
            (0.975, 1000.0, 1.962_339_080_8),
        ] {
            let found = student_quantile(probability, freedom);
            assert!((found - expected).abs() < 1e-9 * expected, "{freedom}: {found}");
        }
    }
}
