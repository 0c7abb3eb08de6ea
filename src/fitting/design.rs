//! Constrained minimisation without derivatives. The module [`descent`](super::descent) minimises with derivatives.

use std::cell::RefCell;

use cobyla::{RhoBeg, StopTols, minimize};

use super::SearchRange;

/// Length of the first step of the search, as a fraction of the size of the parameters.
const FIRST_STEP: f64 = 0.1;
const MET: f64 = 1e-6;
/// Bound of an unbounded parameter in the search, as a multiple of the size of the parameter.
/// A parameter that comes near the bound counts as diverged.
const FARTHEST: f64 = 1e15;
pub(super) const PENALTY: f64 = 10.0;

#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    pub ranges: Vec<SearchRange>,
    pub constraints: usize,
    pub tolerance: f64,
    pub most_runs: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Rating {
    pub objective: f64,
    /// Values of the constraints, scaled to order one. A constraint is satisfied if its value is not negative.
    pub constraints: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    pub parameters: Vec<f64>,
    pub rating: Rating,
    pub is_feasible: bool,
    pub is_settled: bool,
    /// Index of the unbounded parameter that diverged because the objective decreases without limit; `None` without divergence.
    pub runaway: Option<usize>,
    pub runs: usize,
    /// Number of evaluations with derivatives, which are also counted in `runs`.
    pub gradient_runs: usize,
    pub derivative_free_reason: Option<String>,
}

pub(super) struct Scaled {
    pub(super) start: Vec<f64>,
    pub(super) bounds: Vec<(f64, f64)>,
}

struct DesignSearch<E> {
    best: Option<(Vec<f64>, Rating)>,
    last: Option<(Vec<f64>, Rating)>,
    worst: f64,
    runs: usize,
    error: Option<E>,
}

impl Rating {
    pub fn largest_violation(&self) -> f64 {
        let missed = self.constraints.iter().map(|value| (-value).max(0.0));
        missed.fold(0.0, f64::max)
    }

    pub(super) fn is_feasible(&self) -> bool {
        self.largest_violation() <= MET
    }

    /// Returns true if this design has a lower objective than `other`, or a smaller violation if both are infeasible.
    /// A feasible design is better than any infeasible design.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        match (self.is_feasible(), other.is_feasible()) {
            (true, true) => self.objective < other.objective,
            (false, false) => self.largest_violation() < other.largest_violation(),
            (own, _) => own,
        }
    }
}

impl Design {
    /// Finds the feasible design with the lowest objective by COBYLA (M. J. D. Powell, 1994).
    ///
    /// The result is the best of all evaluated designs; `None` if all runs fail.
    /// `rate` must return `None` if a run fails; the search then avoids this design.
    pub fn solve<E>(
        &self,
        rate: impl FnMut(&[f64]) -> Result<Option<Rating>, E>,
    ) -> Result<Option<Designed>, E> {
        let Scaled { start, bounds } = self.scaled();
        let unscaled = |u: &[f64]| self.unscaled(u);
        let rate = RefCell::new(rate);
        let search =
            RefCell::new(DesignSearch { best: None, last: None, worst: 0.0, runs: 0, error: None });
        // The last result is stored, because COBYLA requests the objective and each constraint of a design in separate calls.
        let rated = |u: &[f64]| -> Rating {
            let mut search = search.borrow_mut();
            if let Some((at, rating)) = &search.last
                && at == u
            {
                return rating.clone();
            }
            let worst = search.worst;
            let lost =
                || Rating { objective: worst + PENALTY, constraints: vec![-1.0; self.constraints] };
            if search.error.is_some() {
                return lost();
            }
            search.runs += 1;
            let x = unscaled(u);
            let found = match (rate.borrow_mut())(&x) {
                Ok(found) => found,
                Err(error) => {
                    search.error = Some(error);
                    return lost();
                }
            };
            let rating = found.clone().unwrap_or_else(lost);
            if let Some(rating) = found {
                search.worst = search.worst.max(rating.objective);
                if search.best.as_ref().is_none_or(|(_, best)| rating.is_better_than(best)) {
                    search.best = Some((x, rating));
                }
            }
            search.last = Some((u.to_vec(), rating.clone()));
            rating
        };
        let constraint = |which: usize| {
            let rated = &rated;
            move |u: &[f64], _: &mut ()| rated(u).constraints[which]
        };
        let constraints: Vec<_> = (0..self.constraints).map(constraint).collect();
        let stop = StopTols { xtol_abs: vec![self.tolerance; start.len()], ..StopTols::default() };
        let objective = |u: &[f64], _: &mut ()| rated(u).objective;
        let ended = minimize(
            objective,
            &start,
            &bounds,
            &constraints,
            (),
            self.most_runs,
            RhoBeg::All(FIRST_STEP),
            Some(stop),
        );
        drop(constraints);
        let DesignSearch { best, runs, error, .. } = search.into_inner();
        if let Some(error) = error {
            return Err(error);
        }
        let is_settled = ended.is_ok() && runs < self.most_runs;
        Ok(best.map(|(parameters, rating)| Designed {
            runaway: self.runaway(&parameters),
            is_settled: is_settled && self.runaway(&parameters).is_none(),
            parameters,
            is_feasible: rating.is_feasible(),
            rating,
            runs,
            gradient_runs: 0,
            derivative_free_reason: None,
        }))
    }

    pub(super) fn scaled(&self) -> Scaled {
        let of = |range: &SearchRange| {
            let size = range.width();
            let low = (range.low / size).max(-FARTHEST);
            (range.first() / size, (low, (range.high / size).min(FARTHEST)))
        };
        let (start, bounds) = self.ranges.iter().map(of).unzip();
        Scaled { start, bounds }
    }

    pub(super) fn runaway(&self, parameters: &[f64]) -> Option<usize> {
        self.ranges.iter().zip(parameters).position(|(range, x)| {
            let bound = if *x < 0.0 { range.low } else { range.high };
            bound.is_infinite() && x.abs() >= 0.1 * FARTHEST * range.width()
        })
    }

    pub(super) fn unscaled(&self, scaled: &[f64]) -> Vec<f64> {
        let pairs = scaled.iter().zip(&self.ranges);
        pairs.map(|(u, range)| range.clip(u * range.width())).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    fn solved(
        ranges: &[(f64, f64, f64)],
        constraints: usize,
        rate: impl Fn(&[f64]) -> Option<Rating>,
    ) -> Designed {
        let ranges = ranges.iter().map(|(start, low, high)| SearchRange {
            start: *start,
            low: *low,
            high: *high,
        });
        let design =
            Design { ranges: ranges.collect(), constraints, tolerance: 1e-6, most_runs: 500 };
        let Ok(found) = design.solve(|x| Ok::<_, Infallible>(rate(x)));
        found.unwrap()
    }

    /// Test problem 2 of M. J. D. Powell (1994): smallest product of the coordinates of a point on the unit circle.
    #[test]
    fn powells_problem_on_a_circle_is_solved() {
        let found = solved(&[(1.0, -2.0, 2.0), (0.5, -2.0, 2.0)], 1, |x| {
            Some(Rating {
                objective: x[0] * x[1],
                constraints: vec![1.0 - x[0] * x[0] - x[1] * x[1]],
            })
        });
        assert!(found.is_feasible && found.is_settled, "{found:?}");
        assert!((found.rating.objective + 0.5).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn search_stays_within_bounds_and_avoids_failed_runs() {
        let found = solved(&[(3.0, 0.0, 5.0)], 0, |x| {
            let value = (x[0] - 1.0) * (x[0] - 1.0);
            (x[0] > 0.8).then_some(Rating { objective: value, constraints: vec![] })
        });
        assert!((found.parameters[0] - 1.0).abs() < 1e-3, "{found:?}");
        let found = solved(&[(3.0, 2.0, 5.0)], 0, |x| {
            assert!((2.0..=5.0).contains(&x[0]));
            Some(Rating { objective: x[0], constraints: vec![] })
        });
        assert!((found.parameters[0] - 2.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn unsatisfiable_constraint_is_reported() {
        let found = solved(&[(0.5, 0.0, 1.0)], 1, |x| {
            Some(Rating { objective: x[0], constraints: vec![x[0] - 2.0] })
        });
        assert!(!found.is_feasible && (found.parameters[0] - 1.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn unbounded_objective_reports_the_runaway_parameter() {
        for slope in [1.0, -1.0] {
            let infinite = (2.0, f64::NEG_INFINITY, f64::INFINITY);
            let found = solved(&[infinite], 0, |x| {
                Some(Rating { objective: slope * x[0], constraints: vec![] })
            });
            assert_eq!((found.runaway, found.is_settled), (Some(0), false), "{found:?}");
        }
    }
}
