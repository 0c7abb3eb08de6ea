use std::convert::Infallible;

use super::*;
use crate::elementary::{cos, exp};
use crate::fitting::Evaluation;

fn range(start: f64, low: f64, high: f64) -> SearchRange {
    SearchRange { start, low, high }
}

fn free(start: f64) -> SearchRange {
    range(start, f64::NEG_INFINITY, f64::INFINITY)
}

fn solved(ranges: Vec<SearchRange>, function: impl Fn(&[f64]) -> Evaluation) -> Fitted {
    let mut evaluate = |points: &[Vec<f64>]| -> Result<Vec<Evaluation>, Infallible> {
        Ok(points.iter().map(|x| function(x)).collect())
    };
    let Ok(found) = LeastSquares::new(ranges).solve(&mut evaluate);
    found.unwrap()
}

/// Problem 1 of J. J. Moré, B. S. Garbow, K. E. Hillstrom (1981): Rosenbrock's valley.
#[test]
fn least_squares_finds_the_rosenbrock_minimum() {
    let found =
        solved(vec![free(-1.2), free(1.0)], |x| Ok(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]));
    assert_eq!(found.settling, TerminationReason::Settled);
    assert!(found.parameters.iter().all(|x| (x - 1.0).abs() < 1e-6), "{found:?}");
}

/// Data set Misra1a (lower difficulty) of the NIST Statistical Reference Datasets, with certified parameters and standard errors.
#[test]
fn misra1a_fit_agrees_with_certified_values_and_errors() {
    let y = [
        10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
        81.78,
    ];
    let x = [
        77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
        760.0,
    ];
    let found = solved(vec![free(500.0), free(1e-4)], |b| {
        Ok(x.iter().zip(y).map(|(x, y)| b[0] * (1.0 - exp(-b[1] * x)) - y).collect())
    });
    let [a, b] = [found.parameters[0], found.parameters[1]];
    assert!((a / 2.389_421_291_8e2 - 1.0).abs() < 1e-6, "{found:?}");
    assert!((b / 5.501_564_317_8e-4 - 1.0).abs() < 1e-6, "{found:?}");
    let estimate = found.estimate.unwrap();
    assert!((estimate.error(0).unwrap() / 2.707_007_524_1 - 1.0).abs() < 1e-5, "{estimate:?}");
    assert!((estimate.error(1).unwrap() / 7.266_868_868_2e-6 - 1.0).abs() < 1e-5, "{estimate:?}");
    assert!((estimate.deviation / 1.018_787_633_0e-1 - 1.0).abs() < 1e-7, "{estimate:?}");
}

#[test]
fn fit_of_a_decaying_oscillation_needs_few_runs() {
    let wave = |b: &[f64], t: f64| exp(-b[1] * t) * cos(b[0] * t);
    let times: Vec<f64> = (0..100).map(|at| f64::from(at) * 0.05).collect();
    let ranges = vec![range(3.0, 1.0, 10.0), range(0.1, 0.0, 1.0)];
    let found = solved(ranges, |b| {
        Ok(times.iter().map(|t| wave(b, *t) - wave(&[3.3, 0.25], *t)).collect())
    });
    assert!((found.parameters[0] - 3.3).abs() < 1e-6 && (found.parameters[1] - 0.25).abs() < 1e-6);
    assert!(found.runs <= 20, "{} runs, {} steps", found.runs, found.steps);
}

#[test]
fn parameter_at_its_bound_does_not_hinder_the_others() {
    let found = solved(vec![range(0.5, 0.0, 1.0), free(0.0)], |x| {
        Ok(vec![x[0] - 2.0, x[1] - 3.0 * x[0], 0.1 * x[1]])
    });
    assert_eq!(found.parameters[0], 1.0);
    assert!((found.parameters[1] - 3.0 / 1.01).abs() < 1e-6, "{found:?}");
    assert_eq!(found.settling, TerminationReason::Settled);
}

#[test]
fn failed_steps_are_shortened_and_failed_starts_are_reported() {
    let root = |x: &[f64]| -> Evaluation {
        if x[0] <= 0.0 { Err("negative".into()) } else { Ok(vec![x[0].sqrt() - 0.1]) }
    };
    let found = solved(vec![free(4.0)], root);
    assert!((found.parameters[0] - 0.01).abs() < 1e-6, "{found:?}");
    let mut evaluate = |points: &[Vec<f64>]| -> Result<Vec<Evaluation>, Infallible> {
        Ok(points.iter().map(|x| root(x)).collect())
    };
    let Ok(found) = LeastSquares::new(vec![free(-1.0)]).solve(&mut evaluate);
    assert_eq!(found.unwrap_err(), "negative");
}
