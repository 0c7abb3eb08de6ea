//! Least squares by a Levenberg–Marquardt method with bounds on the parameters.

use nalgebra::{DMatrix, DVector};

use super::evaluator::{CountedEvaluator, EvaluatedPoint};
use super::{Estimate, Evaluate, RELATIVE_STEP, SearchRange, Slopes};

const MOST_ITERATIONS: usize = 30;
/// Number of steps, in addition to the number of parameters, after which the derivatives are computed again.
const MORE_STEPS: usize = 6;
/// Largest change of a parameter at which the search counts as converged, as a fraction of the size of the parameter.
const SETTLED: f64 = 1e-7;
/// Largest change of a parameter for which the derivatives still count as accurate, as a fraction of the size of the parameter.
const NEAR: f64 = 0.02;
/// Largest cosine of the angle between the residuals and a column of the Jacobian at which the search counts as converged.
const ORTHOGONAL: f64 = 1e-7;
/// Smallest predicted relative reduction of the sum of squares for which the search continues.
const NOTHING: f64 = 1e-6;
/// Sum of squares that is attributed to rounding, as a fraction of its initial value.
const ROUNDING: f64 = 1e-26;
const DAMPING: (f64, f64, f64) = (1e-3, 1e-14, 1e12);

#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares {
    pub ranges: Vec<SearchRange>,
    /// Perturbation for finite differences, as a fraction of the size of a parameter.
    pub relative_step: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TerminationReason {
    Settled,
    /// No step reduces the sum of squares as the derivatives predict, because of noise of the runs or a discontinuity.
    Stalled,
    Unfinished,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    pub parameters: Vec<f64>,
    pub residuals: Vec<f64>,
    /// Uncertainty of the parameters; `None` if it cannot be estimated.
    pub estimate: Option<Estimate>,
    pub settling: TerminationReason,
    pub runs: usize,
    /// Number of evaluations with derivatives, which are also counted in `runs`.
    pub gradient_runs: usize,
    /// Reason why finite differences were used; `None` if the function provided all derivatives.
    pub differences: Option<String>,
    pub steps: usize,
}

struct LeastSquaresState {
    x: Vec<f64>,
    residuals: DVector<f64>,
    derivatives: DMatrix<f64>,
    /// Largest norm so far of each column of the Jacobian, by which the parameters are scaled.
    sizes: Vec<f64>,
    damping: f64,
}

impl LeastSquaresState {
    fn squares(&self) -> f64 {
        self.residuals.norm_squared()
    }

    fn free(&self, ranges: &[SearchRange]) -> Vec<bool> {
        let gradient = self.derivatives.tr_mul(&self.residuals);
        let is_free = |at: usize| {
            let (x, slope) = (self.x[at], gradient[at]);
            let changes_something = self.derivatives.column(at).iter().any(|slope| *slope != 0.0);
            let is_held = x <= ranges[at].low && slope > 0.0 || x >= ranges[at].high && slope < 0.0;
            changes_something && !is_held
        };
        (0..self.x.len()).map(is_free).collect()
    }

    fn cosine(&self, ranges: &[SearchRange]) -> f64 {
        let length = self.residuals.norm();
        let columns = self.derivatives.column_iter().zip(self.free(ranges));
        let cosines = columns.filter(|(_, free)| *free).map(|(column, _)| {
            let product = column.norm() * length;
            if product > 0.0 { column.dot(&self.residuals).abs() / product } else { 0.0 }
        });
        cosines.fold(0.0, f64::max)
    }

    /// Step `δ` of the free parameters that minimises `|r + J δ|² + λ |D δ|²`.
    /// Here `r` are the residuals, `J` the Jacobian, `λ` the damping and `D` the diagonal scaling.
    /// A parameter that would exceed a bound is fixed at the bound, and the step of the others is computed again.
    fn step(&self, ranges: &[SearchRange]) -> DVector<f64> {
        let mut free = self.free(ranges);
        let mut step = DVector::zeros(self.x.len());
        loop {
            let columns: Vec<usize> = (0..free.len()).filter(|at| free[*at]).collect();
            if columns.is_empty() {
                return step;
            }
            let solution = self.step_of(&columns, &(&self.residuals + &self.derivatives * &step));
            let reached = |(at, column): (usize, &usize)| {
                let (x, range) = (self.x[*column] + solution[at], ranges[*column]);
                (range.clip(x) != x).then(|| (*column, range.clip(x) - self.x[*column]))
            };
            let beyond: Vec<(usize, f64)> =
                columns.iter().enumerate().filter_map(reached).collect();
            if beyond.is_empty() {
                for (at, column) in columns.into_iter().enumerate() {
                    step[column] = solution[at];
                }
                return step;
            }
            for (column, length) in beyond {
                step[column] = length;
                free[column] = false;
            }
        }
    }

    fn step_of(&self, columns: &[usize], residuals: &DVector<f64>) -> DVector<f64> {
        let (rows, count) = (residuals.len(), columns.len());
        let root = self.damping.sqrt();
        let matrix = DMatrix::from_fn(rows + count, count, |row, column| match row {
            row if row < rows => {
                self.derivatives[(row, columns[column])] / self.sizes[columns[column]]
            }
            row if row - rows == column => root,
            _ => 0.0,
        });
        let mut right = DVector::from_fn(rows + count, |row, _| match row {
            row if row < rows => -residuals[row],
            _ => 0.0,
        });
        let factors = matrix.qr();
        factors.q_tr_mul(&mut right);
        let solution = factors.r().solve_upper_triangular(&right.rows(0, count));
        let solution = solution.unwrap_or_else(|| DVector::zeros(count));
        DVector::from_fn(count, |at, _| solution[at] / self.sizes[columns[at]])
    }

    /// Updates the derivatives after a step by the rank-one correction of C. G. Broyden (1965), in scaled parameters.
    fn update_derivatives(&mut self, step: &DVector<f64>, change: &DVector<f64>) {
        let scaled =
            DVector::from_fn(step.len(), |at, _| step[at] * self.sizes[at] * self.sizes[at]);
        let length = scaled.dot(step);
        if length > 0.0 {
            let missed = change - &self.derivatives * step;
            self.derivatives += missed * scaled.transpose() / length;
        }
    }

    fn measure(&mut self, derivatives: DMatrix<f64>) {
        for (size, column) in self.sizes.iter_mut().zip(derivatives.column_iter()) {
            *size = size.max(column.norm());
        }
        self.derivatives = derivatives;
    }
}

enum Round {
    Converged,
    NeedsDerivatives(Option<DMatrix<f64>>),
    Stalled,
}

impl LeastSquares {
    pub fn new(ranges: Vec<SearchRange>) -> Self {
        Self { ranges, relative_step: RELATIVE_STEP }
    }

    /// Minimises the sum of squares of the residuals.
    /// Derivatives are finite differences, central except near bounds. Rank-one corrections update them as long as the sum of squares decreases.
    ///
    /// # Errors
    /// Returns an error of `evaluate`.
    /// The inner error is the reason why an evaluation failed or a value was not finite.
    pub fn solve<E>(&self, evaluate: &mut Evaluate<'_, E>) -> Result<Result<Fitted, String>, E> {
        self.solve_with(evaluate, &mut |_| Ok(Err("differences are wanted".into())))
    }

    /// Minimises with derivatives from `slopes`, or with finite differences if derivatives are missing.
    pub fn solve_with<E>(
        &self,
        evaluate: &mut Evaluate<'_, E>,
        slopes: &mut Slopes<'_, E>,
    ) -> Result<Result<Fitted, String>, E> {
        let mut asking = CountedEvaluator::new(evaluate, slopes, &self.ranges);
        let x: Vec<f64> = self.ranges.iter().map(|range| range.first()).collect();
        let EvaluatedPoint { values, derivatives: mut known } = asking.at(&x)?;
        let residuals = match values {
            Ok(residuals) => DVector::from_vec(residuals),
            Err(reason) => return Ok(Err(reason)),
        };
        if !residuals.norm_squared().is_finite() {
            return Ok(Err("the sum of the squares of its residuals is not finite".into()));
        }
        let sizes = vec![f64::MIN_POSITIVE; x.len()];
        let empty = DMatrix::zeros(residuals.len(), x.len());
        let mut state =
            LeastSquaresState { x, residuals, derivatives: empty, sizes, damping: DAMPING.0 };
        let least = ROUNDING * state.squares();
        let (mut steps, mut settling) = (0, TerminationReason::Unfinished);
        for _ in 0..MOST_ITERATIONS {
            let found = match known.take() {
                Some(known) => Ok(known),
                None => {
                    let step = self.relative_step;
                    asking.differences(&self.ranges, &state.x, &state.residuals, step)?
                }
            };
            match found {
                Ok(found) if !found.norm_squared().is_finite() => {
                    return Ok(Err("the squares of its derivatives are not finite".into()));
                }
                Ok(found) => state.measure(found),
                Err(reason) => return Ok(Err(reason)),
            }
            if state.squares() <= least || state.cosine(&self.ranges) <= ORTHOGONAL {
                settling = TerminationReason::Settled;
                break;
            }
            match self.iterate(&mut state, least, &mut steps, &mut asking)? {
                Round::NeedsDerivatives(found) => known = found,
                Round::Stalled => {
                    settling = TerminationReason::Stalled;
                    break;
                }
                Round::Converged => {
                    settling = TerminationReason::Settled;
                    break;
                }
            }
        }
        let free: Vec<bool> = state.free(&self.ranges);
        let estimate = Estimate::of(&state.derivatives, state.squares(), &free);
        let residuals = state.residuals.iter().copied().collect();
        Ok(Ok(Fitted {
            parameters: state.x,
            residuals,
            estimate,
            settling,
            runs: asking.runs,
            gradient_runs: asking.gradient_runs,
            differences: asking.differences,
            steps,
        }))
    }

    fn iterate<E>(
        &self,
        state: &mut LeastSquaresState,
        least: f64,
        steps: &mut usize,
        asking: &mut CountedEvaluator<'_, '_, E>,
    ) -> Result<Round, E> {
        let (mut is_fresh, mut taken, start) = (true, 0, state.x.clone());
        while taken < self.ranges.len() + MORE_STEPS {
            let step = state.step(&self.ranges);
            let promised =
                state.squares() - (&state.residuals + &state.derivatives * &step).norm_squared();
            let is_small = step
                .iter()
                .zip(&state.x)
                .zip(&self.ranges)
                .all(|((step, x), range)| step.abs() <= SETTLED * range.size(*x));
            let is_last = is_small || promised.abs() <= NOTHING * state.squares();
            if is_last && !is_fresh {
                let is_near = (0..start.len()).all(|at| {
                    (state.x[at] - start[at]).abs() <= NEAR * self.ranges[at].size(state.x[at])
                });
                return Ok(if is_near { Round::Converged } else { Round::NeedsDerivatives(None) });
            }
            let x: Vec<f64> = state.x.iter().zip(step.iter()).map(|(x, step)| x + step).collect();
            // A step with a predicted reduction of zero, for example at a bound, is not evaluated.
            let nothing =
                || EvaluatedPoint { values: Err("nothing is promised".into()), derivatives: None };
            let EvaluatedPoint { values: found, derivatives } =
                if promised > 0.0 { asking.at(&x)? } else { nothing() };
            let found = found.ok().filter(|found| found.len() == state.residuals.len());
            let found = found.map(DVector::from_vec);
            let gained =
                found.as_ref().map_or(f64::NEG_INFINITY, |r| state.squares() - r.norm_squared());
            if is_last {
                if let Some(found) = found.filter(|_| gained > 0.0) {
                    (state.x, state.residuals) = (x, found);
                }
                return Ok(Round::Converged);
            }
            let gain_ratio = gained / promised;
            let Some(found) = found.filter(|_| gain_ratio > 1e-4) else {
                if !is_fresh {
                    return Ok(Round::NeedsDerivatives(None));
                }
                state.damping *= 10.0;
                if state.damping > DAMPING.2 {
                    return Ok(Round::Stalled);
                }
                continue;
            };
            let change = &found - &state.residuals;
            state.update_derivatives(&step, &change);
            (state.x, state.residuals) = (x, found);
            state.damping = match gain_ratio {
                good if good > 0.75 => (state.damping / 10.0).max(DAMPING.1),
                bad if bad < 0.25 => state.damping * 4.0,
                _ => state.damping,
            };
            *steps += 1;
            taken += 1;
            is_fresh = false;
            if state.squares() <= least || derivatives.is_some() {
                return Ok(Round::NeedsDerivatives(derivatives));
            }
        }
        Ok(Round::NeedsDerivatives(None))
    }
}

#[cfg(test)]
mod tests;
