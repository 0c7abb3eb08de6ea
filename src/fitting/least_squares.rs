//! Least squares: K. Levenberg's and D. W. Marquardt's method within bounds, with few runs.

use nalgebra::{DMatrix, DVector};

use super::evaluator::{CountedEvaluator, EvaluatedPoint};
use super::{Estimate, Evaluate, RELATIVE_STEP, SearchRange, Slopes};

/// Rounds of steps from fresh derivatives.
const MOST_ROUNDS: usize = 30;
/// Steps from derivatives that were only corrected, for each parameter and so many more.
const MORE_STEPS: usize = 6;
/// A parameter that changes by less than this part of its size has settled.
const SETTLED: f64 = 1e-7;
/// As long as parameters have changed by less than this part of their sizes, derivatives are as good as fresh ones.
const NEAR: f64 = 0.02;
/// Cosine of the angle between residuals and the changes that parameters can make, below which nothing is gained.
const ORTHOGONAL: f64 = 1e-7;
/// Part of the squares that a step must promise: less changes parameters by less than `1e-3 √(n - p)` of their
/// standard errors, for `n` residuals and `p` parameters.
const NOTHING: f64 = 1e-6;
/// Part of the first squares below which they are rounding.
const ROUNDING: f64 = 1e-26;
/// Damping at the start, at least, and at most before it is given up.
const DAMPING: (f64, f64, f64) = (1e-3, 1e-14, 1e12);

/// A problem of least squares.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares {
    /// The parameters.
    pub ranges: Vec<SearchRange>,
    /// The distance of differences as a part of the size of a parameter.
    pub relative_step: f64,
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TerminationReason {
    /// Nothing is to be gained any more.
    Settled,
    /// No step makes the squares less, though the derivatives promise it: they are as good as the noise of the runs allows, or the function jumps.
    Stuck,
    /// It went on for too long.
    Unfinished,
}

/// What a fit found.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The parameters with the least sum of squares.
    pub parameters: Vec<f64>,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// How well they are known, where that can be told.
    pub estimate: Option<Estimate>,
    /// How it ended.
    pub settling: TerminationReason,
    /// How often the function was called.
    pub runs: usize,
    /// How often it was called for its derivatives, which are among all calls.
    pub gradient_runs: usize,
    /// Why derivatives are differences of calls, where they are.
    pub differences: Option<String>,
    /// How many steps made the squares less.
    pub steps: usize,
}

/// Where a search stands.
struct LeastSquaresState {
    x: Vec<f64>,
    residuals: DVector<f64>,
    derivatives: DMatrix<f64>,
    /// The largest norms of the columns of derivatives so far: sizes of parameters.
    sizes: Vec<f64>,
    damping: f64,
}

impl LeastSquaresState {
    fn squares(&self) -> f64 {
        self.residuals.norm_squared()
    }

    /// Whether a parameter may move in the direction that makes the squares less; one on which nothing depends stays where it is.
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

    /// The largest cosine of an angle between the residuals and what a free parameter changes.
    fn cosine(&self, ranges: &[SearchRange]) -> f64 {
        let length = self.residuals.norm();
        let columns = self.derivatives.column_iter().zip(self.free(ranges));
        let cosines = columns.filter(|(_, free)| *free).map(|(column, _)| {
            let product = column.norm() * length;
            if product > 0.0 { column.dot(&self.residuals).abs() / product } else { 0.0 }
        });
        cosines.fold(0.0, f64::max)
    }

    /// The step of the free parameters that makes `|r + J δ|² + λ |D δ|²` least; those that it would take beyond a bound go there, and the others do what is best
    /// then.
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

    /// The step of some parameters from given residuals.
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

    /// Keeps what a step has shown of the derivatives: C. G. Broyden's correction (1965), in the sizes of the parameters.
    fn learn(&mut self, step: &DVector<f64>, change: &DVector<f64>) {
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

/// How far a round of steps has come.
enum Round {
    /// The parameters no longer move, or nothing more is promised.
    Rests,
    /// Derivatives are to be found anew, or are known.
    Goes(Option<DMatrix<f64>>),
    /// Fresh derivatives promise what no step finds.
    Sticks,
}

impl LeastSquares {
    /// A problem with these parameters.
    pub fn new(ranges: Vec<SearchRange>) -> Self {
        Self { ranges, relative_step: RELATIVE_STEP }
    }

    /// Makes the sum of the squares of what the function gives least: derivatives by central differences at the start, after that corrected by what each step
    /// shows, and found anew where that no longer helps and at the end. Steps that fail are shortened.
    ///
    /// # Errors
    /// Those of the function; the inner one tells why it gave nothing where it must.
    pub fn solve<E>(&self, evaluate: &mut Evaluate<'_, E>) -> Result<Result<Fitted, String>, E> {
        self.solve_with(evaluate, &mut |_| Ok(Err("differences are wanted".into())))
    }

    /// Makes the squares least as [`solve`](Self::solve) does, with the derivatives that the function knows; where it does not, with differences.
    ///
    /// # Errors
    /// As those of [`solve`](Self::solve), and those of the derivatives.
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
        for _ in 0..MOST_ROUNDS {
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
            match self.round(&mut state, least, &mut steps, &mut asking)? {
                Round::Goes(found) => known = found,
                Round::Sticks => {
                    settling = TerminationReason::Stuck;
                    break;
                }
                Round::Rests => {
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

    /// Steps from fresh derivatives on.
    fn round<E>(
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
                return Ok(if is_near { Round::Rests } else { Round::Goes(None) });
            }
            let x: Vec<f64> = state.x.iter().zip(step.iter()).map(|(x, step)| x + step).collect();
            // A bound may stand in the way of what the others promise: a shorter step does not reach it.
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
                return Ok(Round::Rests);
            }
            let share = gained / promised;
            let Some(found) = found.filter(|_| share > 1e-4) else {
                // The derivatives may be too old for the step that they promise.
                if !is_fresh {
                    return Ok(Round::Goes(None));
                }
                state.damping *= 10.0;
                if state.damping > DAMPING.2 {
                    return Ok(Round::Sticks);
                }
                continue;
            };
            let change = &found - &state.residuals;
            state.learn(&step, &change);
            (state.x, state.residuals) = (x, found);
            state.damping = match share {
                good if good > 0.75 => (state.damping / 10.0).max(DAMPING.1),
                bad if bad < 0.25 => state.damping * 4.0,
                _ => state.damping,
            };
            *steps += 1;
            taken += 1;
            is_fresh = false;
            // Derivatives that are known are better than corrected ones.
            if state.squares() <= least || derivatives.is_some() {
                return Ok(Round::Goes(derivatives));
            }
        }
        Ok(Round::Goes(None))
    }
}

#[cfg(test)]
mod tests;
