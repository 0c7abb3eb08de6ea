//! Probability distributions of parameters.

use super::normal_quantile;
use crate::elementary::{exp, ln};

#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    Uniform {
        from: f64,
        to: f64,
    },
    /// Distribution whose logarithm is uniform between the logarithms of the positive numbers `from` and `to`.
    LogUniform {
        from: f64,
        to: f64,
    },
    Normal {
        mean: f64,
        deviation: f64,
    },
    LogNormal {
        median: f64,
        deviation: f64,
    },
    Triangular {
        from: f64,
        mode: f64,
        to: f64,
    },
}

impl Distribution {
    pub fn is_of_logarithms(&self) -> bool {
        matches!(self, Self::LogUniform { .. } | Self::LogNormal { .. })
    }

    /// Quantile of a probability, which must lie strictly between 0 and 1.
    pub fn quantile(&self, probability: f64) -> f64 {
        let between = |from: f64, to: f64| from * (1.0 - probability) + to * probability;
        match *self {
            Self::Uniform { from, to } => between(from, to),
            Self::LogUniform { from, to } => exp(between(ln(from), ln(to))).clamp(from, to),
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(probability),
            Self::LogNormal { median, deviation } => {
                median * exp(deviation * normal_quantile(probability))
            }
            Self::Triangular { from, mode, to } => {
                let (width, rise, fall) = (to - from, mode - from, to - mode);
                match probability * width <= rise {
                    true => from + (probability * width * rise).sqrt(),
                    false => to - ((1.0 - probability) * width * fall).sqrt(),
                }
            }
        }
    }

    pub fn describe(&self) -> String {
        match self {
            Self::Uniform { from, to } => format!("uniform({from}, {to})"),
            Self::LogUniform { from, to } => format!("log_uniform({from}, {to})"),
            Self::Normal { mean, deviation } => format!("normal({mean}, {deviation})"),
            Self::LogNormal { median, deviation } => format!("log_normal({median}, {deviation})"),
            Self::Triangular { from, mode, to } => format!("triangular({from}, {mode}, {to})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sobol;
    use super::*;

    #[test]
    fn sampled_moments_agree_with_the_distribution() {
        let points = sobol(1 << 15, 1, 5).remove(0);
        let one_percent = |found: f64, expected: f64| (found - expected).abs() < 0.01 * expected;
        let e = std::f64::consts::E;
        for (of, mean, deviation) in [
            (Distribution::Uniform { from: 1.0, to: 3.0 }, 2.0, 1.0 / 3.0_f64.sqrt()),
            (Distribution::LogUniform { from: 1.0, to: e }, e - 1.0, 0.492_043_7),
            (Distribution::Normal { mean: 2.0, deviation: 0.5 }, 2.0, 0.5),
            (
                Distribution::LogNormal { median: 1.0, deviation: 0.5 },
                crate::elementary::exp(0.125),
                0.603_900_6,
            ),
            (
                Distribution::Triangular { from: 0.0, mode: 1.0, to: 4.0 },
                5.0 / 3.0,
                (13.0_f64 / 18.0).sqrt(),
            ),
        ] {
            let values: Vec<f64> = points.iter().map(|point| of.quantile(*point)).collect();
            let count = values.len() as f64;
            let found = values.iter().sum::<f64>() / count;
            let square = values.iter().map(|x| (x - found) * (x - found)).sum::<f64>() / count;
            assert!(one_percent(found, mean), "{}: {found}", of.describe());
            assert!(one_percent(square.sqrt(), deviation), "{}: {}", of.describe(), square.sqrt());
        }
    }
}
