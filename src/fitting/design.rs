//! The least of a function within constraints: without derivatives here, with them in [`descent`](super::descent).

use std::cell::RefCell;

use cobyla::{RhoBeg, StopTols, minimize};

use super::SearchRange;

/// The first steps, as a part of the sizes of the parameters.
const FIRST_STEP: f64 = 0.1;
/// A constraint that is missed by less than this part of its size is met.
const MET: f64 = 1e-6;
/// A parameter without a bound has run off when it is so many of its sizes away from zero.
const FARTHEST: f64 = 1e15;
/// What a run that failed counts as, beside the worst so far.
pub(super) const PENALTY: f64 = 10.0;

/// A search for the least of a function.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The parameters.
    pub ranges: Vec<SearchRange>,
    /// How many constraints there are.
    pub constraints: usize,
    /// How well parameters are to be known, as a part of their sizes.
    pub tolerance: f64,
    /// The most runs.
    pub most_runs: usize,
}

/// What a run says of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Rating {
    /// What is to be least.
    pub objective: f64,
    /// The constraints: each is met where it is not negative, in numbers about as large as what it is about.
    pub constraints: Vec<f64>,
}

/// The best design that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    /// The parameters of the design.
    pub parameters: Vec<f64>,
    /// What the run says of the design.
    pub rating: Rating,
    /// Whether it meets all constraints.
    pub is_feasible: bool,
    /// Whether the search came to its end before the most runs were made, and no parameter ran off.
    pub is_settled: bool,
    /// The parameter without a bound that ran off, for the function gets less and less there.
    pub runaway: Option<usize>,
    /// How often the function was called.
    pub runs: usize,
    /// How often it was called for its derivatives too, which are among all calls.
    pub gradient_runs: usize,
    /// Why it was searched without derivatives, where it was.
    pub without: Option<String>,
}

/// Where a search begins and stays, in parts of the sizes of the parameters.
pub(super) struct Scaled {
    pub(super) start: Vec<f64>,
    pub(super) bounds: Vec<(f64, f64)>,
}

/// What is known during a search.
struct DesignSearch<E> {
    best: Option<(Vec<f64>, Rating)>,
    last: Option<(Vec<f64>, Rating)>,
    worst: f64,
    runs: usize,
    error: Option<E>,
}

impl Rating {
    /// By how much the constraints are missed: the most of them; zero where all are met.
    pub fn missed(&self) -> f64 {
        let missed = self.constraints.iter().map(|value| (-value).max(0.0));
        missed.fold(0.0, f64::max)
    }

    pub(super) fn is_feasible(&self) -> bool {
        self.missed() <= MET
    }

    /// Whether this one is better: feasible, and then less; else nearer to being feasible.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        match (self.is_feasible(), other.is_feasible()) {
            (true, true) => self.objective < other.objective,
            (false, false) => self.missed() < other.missed(),
            (own, _) => own,
        }
    }
}

impl Design {
    /// Finds the design with the least objective that meets the constraints: M. J. D. Powell's COBYLA (1994), which follows linear models of objective and
    /// constraints over a simplex of designs. Of all designs that were tried the best is given. Where a run fails, `rate` gives none, and the search keeps away
    /// from there. None where all runs fail.
    ///
    /// # Errors
    /// The first of `rate`.
    pub fn solve<E>(
        &self,
        rate: impl FnMut(&[f64]) -> Result<Option<Rating>, E>,
    ) -> Result<Option<Designed>, E> {
        let Scaled { start, bounds } = self.scaled();
        let unscaled = |u: &[f64]| self.unscaled(u);
        let rate = RefCell::new(rate);
        let search =
            RefCell::new(DesignSearch { best: None, last: None, worst: 0.0, runs: 0, error: None });
        // Objective and constraints are asked for one by one at the same design.
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
            without: None,
        }))
    }

    /// Start and bounds of the parameters, in parts of their sizes.
    pub(super) fn scaled(&self) -> Scaled {
        let of = |range: &SearchRange| {
            let size = range.width();
            let low = (range.low / size).max(-FARTHEST);
            (range.first() / size, (low, (range.high / size).min(FARTHEST)))
        };
        let (start, bounds) = self.ranges.iter().map(of).unzip();
        Scaled { start, bounds }
    }

    /// The first parameter that is beyond all its sizes, on a side where it has no bound.
    pub(super) fn runaway(&self, parameters: &[f64]) -> Option<usize> {
        self.ranges.iter().zip(parameters).position(|(range, x)| {
            let bound = if *x < 0.0 { range.low } else { range.high };
            bound.is_infinite() && x.abs() >= 0.1 * FARTHEST * range.width()
        })
    }

    /// Parameters that are given in parts of their sizes, within their bounds.
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

    /// The largest product of two numbers on the unit circle (Powell 1994, test problem 2).
    #[test]
    fn a_product_on_a_circle_is_least_where_both_are_equal() {
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
    fn bounds_are_kept_and_failed_runs_are_kept_away_from() {
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
    fn what_cannot_be_met_is_told() {
        let found = solved(&[(0.5, 0.0, 1.0)], 1, |x| {
            Some(Rating { objective: x[0], constraints: vec![x[0] - 2.0] })
        });
        assert!(!found.is_feasible && (found.parameters[0] - 1.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn what_has_no_least_is_told() {
        for slope in [1.0, -1.0] {
            let infinite = (2.0, f64::NEG_INFINITY, f64::INFINITY);
            let found = solved(&[infinite], 0, |x| {
                Some(Rating { objective: slope * x[0], constraints: vec![] })
            });
            assert_eq!((found.runaway, found.is_settled), (Some(0), false), "{found:?}");
        }
    }
}
