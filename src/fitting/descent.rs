//! Constrained minimisation with derivatives of the objective and the constraints.

use std::cell::RefCell;

use slsqp::{FailStatus, StopTols, minimize};

use super::design::{PENALTY, Scaled};
use super::gradient_check::{REJECTED_DERIVATIVES, matches_derivatives, test_points};
use super::{Design, Designed, Rating};

/// Maximum number of runs of SLSQP. Each further run starts from a slightly infeasible solution, with tightened constraints.
const RESTARTS: usize = 4;
/// Step size at which SLSQP stops, as a fraction of the tolerance; small, because convergence is fast near the solution.
const SHORTER: f64 = 0.1;

#[derive(Clone, Debug, PartialEq)]
pub struct SlopedRating {
    pub rating: Rating,
    pub objective: Vec<f64>,
    pub constraints: Vec<Vec<f64>>,
}

pub type SlopesOfRating = Result<SlopedRating, String>;

/// Function that evaluates a design; `None` if the run fails.
pub type Rate<'r, E> = dyn FnMut(&[f64]) -> Result<Option<Rating>, E> + 'r;

pub type RateWithSlopes<'r, E> = dyn FnMut(&[f64]) -> Result<SlopesOfRating, E> + 'r;

struct Descent<'d, 'f, E> {
    design: &'d Design,
    rate_with_slopes: &'d mut RateWithSlopes<'f, E>,
    rate: &'d mut Rate<'f, E>,
    best: Option<(Vec<f64>, Rating)>,
    last: Option<(Vec<f64>, SlopedRating)>,
    worst: f64,
    runs: usize,
    gradient_runs: usize,
    ended: Option<Ended<E>>,
}

enum Ended<E> {
    Unknown(String),
    Error(E),
}

impl<E> Descent<'_, '_, E> {
    fn at(&mut self, scaled: &[f64]) -> SlopedRating {
        if let Some((at, found)) = &self.last
            && at == scaled
        {
            return found.clone();
        }
        let found = match self.ended {
            Some(_) => None,
            None => self.evaluate(scaled).unwrap_or_else(|ended| {
                self.ended = Some(ended);
                None
            }),
        };
        let found = found.unwrap_or_else(|| self.failed());
        self.last = Some((scaled.to_vec(), found.clone()));
        found
    }

    fn evaluate(&mut self, scaled: &[f64]) -> Result<Option<SlopedRating>, Ended<E>> {
        let x = self.design.unscaled(scaled);
        self.runs += 1;
        match (self.rate_with_slopes)(&x).map_err(Ended::Error)? {
            Ok(mut found) => {
                self.gradient_runs += 1;
                if self.gradient_runs == 1 && !self.are_true(&x, &found)? {
                    if let Some(rating) = (self.rate)(&x).map_err(Ended::Error)? {
                        self.store_best(x, &rating);
                    }
                    return Err(Ended::Unknown(REJECTED_DERIVATIVES.to_owned()));
                }
                self.store_best(x, &found.rating);
                let sizes: Vec<f64> = self.design.ranges.iter().map(|of| of.width()).collect();
                for slopes in found.constraints.iter_mut().chain([&mut found.objective]) {
                    slopes.iter_mut().zip(&sizes).for_each(|(slope, size)| *slope *= size);
                }
                Ok(Some(found))
            }
            Err(reason) => match (self.rate)(&x).map_err(Ended::Error)? {
                None => Ok(None),
                Some(rating) => {
                    self.store_best(x, &rating);
                    Err(Ended::Unknown(reason))
                }
            },
        }
    }

    fn are_true(&mut self, x: &[f64], found: &SlopedRating) -> Result<bool, Ended<E>> {
        let [low, high] = test_points(&self.design.ranges, x);
        self.runs += 2;
        let mut rate = |x: &[f64]| (self.rate)(x).map_err(Ended::Error);
        let (Some(before), Some(behind)) = (rate(&low)?, rate(&high)?) else { return Ok(true) };
        let rows = [&found.objective].into_iter().chain(&found.constraints);
        let all = |rating: &Rating| -> Vec<f64> {
            [rating.objective].into_iter().chain(rating.constraints.iter().copied()).collect()
        };
        let (before, here, behind) = (all(&before), all(&found.rating), all(&behind));
        let agrees = |(at, row): (usize, &Vec<f64>)| {
            let change =
                row.iter().zip(low.iter().zip(&high)).map(|(slope, (a, b))| slope * (b - a));
            let change: f64 = change.sum();
            matches_derivatives([&before[at..=at], &behind[at..=at]], &here[at..=at], |_| change)
        };
        Ok(before.len() == here.len() && behind.len() == here.len() && rows.enumerate().all(agrees))
    }

    fn store_best(&mut self, x: Vec<f64>, rating: &Rating) {
        self.worst = self.worst.max(rating.objective);
        if self.best.as_ref().is_none_or(|(_, best)| rating.is_better_than(best)) {
            self.best = Some((x, rating.clone()));
        }
    }

    fn failed(&self) -> SlopedRating {
        let Design { ranges, constraints, .. } = self.design;
        SlopedRating {
            rating: Rating {
                objective: self.worst + PENALTY,
                constraints: vec![-1.0; *constraints],
            },
            objective: vec![0.0; ranges.len()],
            constraints: vec![vec![0.0; ranges.len()]; *constraints],
        }
    }
}

impl Design {
    /// Minimises with derivatives by SLSQP (D. Kraft, 1988).
    /// If derivatives are missing or SLSQP fails, the minimisation continues without derivatives from the best design found.
    pub fn solve_with<'f, E>(
        &self,
        sloped: &mut RateWithSlopes<'f, E>,
        rate: &mut Rate<'f, E>,
    ) -> Result<Option<Designed>, E> {
        let descent = RefCell::new(Descent {
            design: self,
            rate_with_slopes: sloped,
            rate,
            best: None,
            last: None,
            worst: 0.0,
            runs: 0,
            gradient_runs: 0,
            ended: None,
        });
        let came_to_an_end = self.descend(&descent);
        let Descent { rate, best, runs, gradient_runs, ended, .. } = descent.into_inner();
        let without = match ended {
            Some(Ended::Error(error)) => return Err(error),
            Some(Ended::Unknown(reason)) => Some(reason),
            None if came_to_an_end || runs >= self.most_runs => None,
            None => Some("no step along the gradient reduces the objective".to_owned()),
        };
        let found = best.map(|(parameters, rating)| Designed {
            runaway: self.runaway(&parameters),
            is_settled: came_to_an_end
                && runs < self.most_runs
                && self.runaway(&parameters).is_none(),
            parameters,
            is_feasible: rating.is_feasible(),
            rating,
            runs,
            gradient_runs,
            derivative_free_reason: without.clone(),
        });
        if without.is_none() || runs >= self.most_runs {
            return Ok(found);
        }
        // The first design of `solve` is the best of SLSQP, which need not be evaluated again.
        let mut known = found.as_ref().map(|found| found.rating.clone());
        let asked_again = usize::from(known.is_some());
        let mut rest = Self { most_runs: self.most_runs - runs + asked_again, ..self.clone() };
        if let Some(found) = found.filter(|found| found.gradient_runs > 0) {
            let starts = rest.ranges.iter_mut().zip(found.parameters);
            starts.for_each(|(range, x)| range.start = x);
        }
        let more = rest.solve(|x| match known.take() {
            Some(rating) => Ok(Some(rating)),
            None => rate(x),
        })?;
        Ok(more.map(|more| Designed {
            runs: runs + more.runs - asked_again,
            gradient_runs,
            derivative_free_reason: without,
            ..more
        }))
    }

    fn descend<E>(&self, descent: &RefCell<Descent<'_, '_, E>>) -> bool {
        let Scaled { mut start, bounds } = self.scaled();
        let mut margin = 0.0;
        for _ in 0..RESTARTS {
            let left = self.most_runs.saturating_sub(descent.borrow().runs);
            let objective = |u: &[f64], slopes: Option<&mut [f64]>, _: &mut ()| {
                let found = descent.borrow_mut().at(u);
                if let Some(slopes) = slopes {
                    slopes.copy_from_slice(&found.objective);
                }
                found.rating.objective
            };
            let constraint = |which: usize| {
                move |u: &[f64], slopes: Option<&mut [f64]>, _: &mut ()| {
                    let found = descent.borrow_mut().at(u);
                    if let Some(slopes) = slopes {
                        let pairs = slopes.iter_mut().zip(&found.constraints[which]);
                        pairs.for_each(|(slope, known)| *slope = -known);
                    }
                    margin - found.rating.constraints[which]
                }
            };
            let constraints: Vec<_> = (0..self.constraints).map(constraint).collect();
            let shortest = SHORTER * self.tolerance;
            let stop = StopTols { xtol_abs: vec![shortest; start.len()], ..StopTols::default() };
            let ended = minimize(objective, &start, &bounds, &constraints, (), left, Some(stop));
            drop(constraints);
            let at = match ended {
                Ok((_, at, _)) | Err((FailStatus::RoundoffLimited, at, _)) => at,
                Err(_) => return false,
            };
            if descent.borrow().ended.is_some() || descent.borrow().runs >= self.most_runs {
                return false;
            }
            let missed = descent.borrow_mut().at(&at);
            if missed.rating.is_feasible() {
                return true;
            }
            // All constraints are tightened by twice the largest violation, because SLSQP may end slightly on either side of a limit.
            margin += 2.0 * missed.rating.largest_violation();
            start = at;
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;
    use crate::fitting::SearchRange;

    fn design(ranges: &[(f64, f64, f64)], constraints: usize) -> Design {
        let ranges = ranges.iter().map(|(start, low, high)| SearchRange {
            start: *start,
            low: *low,
            high: *high,
        });
        Design { ranges: ranges.collect(), constraints, tolerance: 1e-4, most_runs: 500 }
    }

    /// Test problem 2 of M. J. D. Powell (1994): on the unit disc, the product x y has the minimum -1/2.
    fn product(x: &[f64]) -> SlopedRating {
        SlopedRating {
            rating: Rating {
                objective: x[0] * x[1],
                constraints: vec![1.0 - x[0] * x[0] - x[1] * x[1]],
            },
            objective: vec![x[1], x[0]],
            constraints: vec![vec![-2.0 * x[0], -2.0 * x[1]]],
        }
    }

    #[test]
    fn descent_with_derivatives_needs_fewer_runs_for_powells_problem() {
        let design = design(&[(1.0, -2.0, 2.0), (0.5, -2.0, 2.0)], 1);
        let Ok(found) = design.solve_with(&mut |x| Ok::<_, Infallible>(Ok(product(x))), &mut |x| {
            Ok(Some(product(x).rating))
        });
        let found = found.unwrap();
        assert!(
            found.is_feasible && found.is_settled && found.derivative_free_reason.is_none(),
            "{found:?}"
        );
        assert!((found.rating.objective + 0.5).abs() < 1e-5, "{found:?}");
        let Ok(without) = design.solve(|x| Ok::<_, Infallible>(Some(product(x).rating)));
        assert!(2 * found.runs < without.unwrap().runs, "{found:?}");
    }

    /// Rosenbrock's valley (H. H. Rosenbrock, 1960), also with a bound that excludes its minimum.
    #[test]
    fn rosenbrock_minimum_is_found_with_and_without_an_active_bound() {
        let rosenbrock = |x: &[f64]| {
            let (a, b) = (1.0 - x[0], x[1] - x[0] * x[0]);
            SlopedRating {
                rating: Rating { objective: a * a + 100.0 * b * b, constraints: vec![] },
                objective: vec![-2.0 * a - 400.0 * x[0] * b, 200.0 * b],
                constraints: vec![],
            }
        };
        for (high, least) in [(2.0, [1.0, 1.0]), (0.5, [0.5, 0.25])] {
            let design = design(&[(-1.2, -2.0, high), (1.0, -2.0, 2.0)], 0);
            let Ok(found) = design
                .solve_with(&mut |x| Ok::<_, Infallible>(Ok(rosenbrock(x))), &mut |x| {
                    Ok(Some(rosenbrock(x).rating))
                });
            let found = found.unwrap();
            for (x, expected) in found.parameters.iter().zip(least) {
                assert!((x - expected).abs() < 1e-3, "{found:?}");
            }
            assert!(found.runs < 60, "{found:?}");
        }
    }

    #[test]
    fn descent_continues_without_derivatives_after_a_failed_derivative() {
        let square = |x: f64| SlopedRating {
            rating: Rating { objective: (x - 1.0) * (x - 1.0), constraints: vec![] },
            objective: vec![2.0 * (x - 1.0)],
            constraints: vec![],
        };
        let design = design(&[(3.0, 0.0, 5.0)], 0);
        let Ok(found) = design.solve_with(
            &mut |x| {
                Ok::<_, Infallible>(if x[0] < 1.5 { Err("lost".into()) } else { Ok(square(x[0])) })
            },
            &mut |x| Ok((x[0] > 0.8).then(|| square(x[0]).rating)),
        );
        let found = found.unwrap();
        assert!((found.parameters[0] - 1.0).abs() < 1e-3, "{found:?}");
        assert_eq!(found.derivative_free_reason.as_deref(), Some("lost"));
        let Ok(none) =
            design.solve_with(&mut |_| Ok::<_, Infallible>(Err("no".into())), &mut |_| Ok(None));
        assert!(none.is_none());
    }

    #[test]
    fn unbounded_descent_reports_the_runaway_parameter() {
        let design = design(&[(2.0, f64::NEG_INFINITY, f64::INFINITY)], 0);
        let slope = |x: &[f64]| SlopedRating {
            rating: Rating { objective: -x[0], constraints: vec![] },
            objective: vec![-1.0],
            constraints: vec![],
        };
        let Ok(found) = design.solve_with(&mut |x| Ok::<_, Infallible>(Ok(slope(x))), &mut |x| {
            Ok(Some(slope(x).rating))
        });
        let found = found.unwrap();
        assert_eq!((found.runaway, found.is_settled), (Some(0), false), "{found:?}");
    }

    #[test]
    fn unsatisfiable_constraint_is_reported_by_descent() {
        let design = design(&[(0.5, 0.0, 1.0)], 1);
        let one = |x: f64| SlopedRating {
            rating: Rating { objective: x, constraints: vec![x - 2.0] },
            objective: vec![1.0],
            constraints: vec![vec![1.0]],
        };
        let Ok(found) = design.solve_with(&mut |x| Ok::<_, Infallible>(Ok(one(x[0]))), &mut |x| {
            Ok(Some(one(x[0]).rating))
        });
        assert!(!found.unwrap().is_feasible);
    }
}
