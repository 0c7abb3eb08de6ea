//! Evaluates a function and its derivatives, and counts the calls.

use nalgebra::{DMatrix, DVector};

use super::differences::{derivatives, only};
use super::gradient_check::{REJECTED_DERIVATIVES, matches_derivatives, test_points};
use super::{Evaluate, Evaluation, SearchRange, Slopes};

pub struct CountedEvaluator<'a, 'e, E> {
    evaluate: &'a mut Evaluate<'e, E>,
    slopes: &'a mut Slopes<'e, E>,
    ranges: &'a [SearchRange],
    pub runs: usize,
    pub gradient_runs: usize,
    /// Reason for finite differences instead of derivatives of the function; `None` while derivatives of the function are requested.
    pub differences: Option<String>,
}

pub struct EvaluatedPoint {
    pub values: Evaluation,
    pub derivatives: Option<DMatrix<f64>>,
}

impl<'a, 'e, E> CountedEvaluator<'a, 'e, E> {
    pub fn new(
        evaluate: &'a mut Evaluate<'e, E>,
        slopes: &'a mut Slopes<'e, E>,
        ranges: &'a [SearchRange],
    ) -> Self {
        Self { evaluate, slopes, ranges, runs: 0, gradient_runs: 0, differences: None }
    }

    /// Values at a point, with derivatives if the function provides them.
    /// Derivatives of the first call are checked against finite differences.
    pub fn at(&mut self, x: &[f64]) -> Result<EvaluatedPoint, E> {
        let mut unknown = None;
        if self.differences.is_none() {
            self.runs += 1;
            match (self.slopes)(x)?.and_then(|found| matrix(found, x.len())) {
                Ok((values, derivatives)) => {
                    self.gradient_runs += 1;
                    if self.gradient_runs > 1 || self.are_true(x, &values, &derivatives)? {
                        return Ok(EvaluatedPoint {
                            values: Ok(values),
                            derivatives: Some(derivatives),
                        });
                    }
                    unknown = Some(REJECTED_DERIVATIVES.to_owned());
                }
                Err(reason) => unknown = Some(reason),
            }
        }
        self.runs += 1;
        let values = only((self.evaluate)(&[x.to_vec()])?);
        // Finite differences replace derivatives from now on only if the evaluation without derivatives succeeds. Otherwise, the run fails for another reason.
        if values.is_ok() && self.differences.is_none() {
            self.differences = unknown;
        }
        Ok(EvaluatedPoint { values, derivatives: None })
    }

    fn are_true(&mut self, x: &[f64], here: &[f64], slopes: &DMatrix<f64>) -> Result<bool, E> {
        let [low, high] = test_points(self.ranges, x);
        let step = DVector::from_fn(x.len(), |at, _| high[at] - low[at]);
        let change = slopes * step;
        self.runs += 2;
        let found = (self.evaluate)(&[low, high])?;
        let [Ok(low), Ok(high)] = &found[..] else { return Ok(true) };
        Ok(matches_derivatives([low, high], here, |at| change[at]))
    }

    /// Derivatives at a point by finite differences. `here` contains the values at the point.
    ///
    /// # Errors
    /// Returns an error of the evaluated function. The inner `Err` is the reason why an evaluation failed.
    pub fn differences(
        &mut self,
        ranges: &[SearchRange],
        x: &[f64],
        here: &DVector<f64>,
        relative: f64,
    ) -> Result<Result<DMatrix<f64>, String>, E> {
        let Self { evaluate, runs, .. } = self;
        let mut counted = |points: &[Vec<f64>]| {
            *runs += points.len();
            evaluate(points)
        };
        derivatives(ranges, (x, here), relative, &mut counted)
    }
}

fn matrix(
    found: Vec<(f64, Vec<f64>)>,
    parameters: usize,
) -> Result<(Vec<f64>, DMatrix<f64>), String> {
    if found.iter().any(|(_, row)| row.len() != parameters) {
        return Err("derivatives with respect to a different number of parameters".into());
    }
    let matrix = DMatrix::from_fn(found.len(), parameters, |row, column| found[row].1[column]);
    if !matrix.iter().all(|slope| slope.is_finite()) {
        return Err("a derivative is not finite".into());
    }
    if matrix.column_iter().any(|column| column.norm() == 0.0) {
        return Err("all derivatives with respect to a parameter are zero".into());
    }
    Ok((found.into_iter().map(|(value, _)| value).collect(), matrix))
}
