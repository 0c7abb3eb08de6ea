//! Newton's method with a full tangent at every iteration, and corrections with old factors where these do as well.

use serde::{Deserialize, Serialize};

use super::{Equations, NewtonError, ResidualNorms};
use crate::elementary::whole_power;
use crate::linalg::{BorderShape, BorderedLu, BorderedMatrix};

/// Imbalances below this are corrected with the factors at hand, as long as that gets on.
const NEAR: f64 = 1e-4;

/// So many corrections cost about as much as an iteration with new factors, which squares the imbalance.
const MOST_CORRECTIONS: i32 = 5;

/// With the factors of equations near by so many corrections are tried; each should gain some digits.
const MOST_FOLLOWING: usize = 12;

/// Imbalances [-] below this are small enough beside equations near by: what is left of them is a billionth of the change that is looked for.
const FOLLOWED: f64 = 1e-14;

/// A correction that leaves more than this part of an imbalance has met rounding.
const STANDSTILL: f64 = 0.1;

/// The tolerance of Newton's method: when a solution is good enough, and when to give up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// The largest relative force imbalance [-] at which iteration ends.
    pub force: f64,
    /// The largest strain mismatch [-] at which iteration ends.
    pub strain: f64,
    /// The largest relative violation of a constraint [-] at which iteration ends.
    pub constraint: f64,
    /// The imbalance [-] above which a solution is corrected with the last factors, which takes it to rounding.
    pub polish: f64,
    /// The largest number of iterations of a solve.
    pub iterations: usize,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { force: 1e-11, strain: 1e-11, constraint: 1e-11, polish: 5e-16, iterations: 15 }
    }
}

impl Tolerance {
    /// Whether to correct once more with the factors at hand, when the last correction has reduced the imbalance by a factor
    /// and so many may follow.
    fn is_worth_correcting(
        &self,
        imbalance: &ResidualNorms,
        factor: f64,
        corrections: i32,
    ) -> bool {
        let largest = imbalance.largest();
        if self.accepts(imbalance) {
            return largest > self.polish && factor < STANDSTILL;
        }
        largest <= NEAR && largest * whole_power(factor, corrections) <= self.polish
    }

    fn accepts(&self, imbalance: &ResidualNorms) -> bool {
        imbalance.force <= self.force
            && imbalance.strain <= self.strain
            && imbalance.constraint <= self.constraint
    }
}

/// The work of a Newton solve, and what was left of its equations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NewtonReport {
    /// The number of iterations of the solve, each with one factorisation.
    pub iterations: usize,
    /// The number of corrections of the solve with factors at hand, about a third of the work of an iteration each.
    pub corrections: usize,
    /// The imbalance that the solve has left.
    pub imbalance: ResidualNorms,
}

impl NewtonReport {
    /// The report of two solves together, one after the other: work adds up, the imbalance is that of the second.
    pub fn then(self, next: Self) -> Self {
        Self {
            iterations: self.iterations + next.iterations,
            corrections: self.corrections + next.corrections,
            imbalance: next.imbalance,
        }
    }
}

/// Newton's method with its work space; solving allocates nothing unless it fails.
#[derive(Debug, Clone)]
pub struct Newton {
    tolerance: Tolerance,
    tangent: BorderedMatrix,
    correction: Vec<f64>,
    /// After each iteration and the corrections that followed it.
    history: Vec<ResidualNorms>,
}

impl Newton {
    /// A solver for `unknowns` unknowns whose tangent has the given half-bandwidth, and those of a border behind them.
    pub fn new(
        unknowns: usize,
        half_bandwidth: usize,
        border: BorderShape,
        tolerance: Tolerance,
    ) -> Self {
        Self::of(BorderedMatrix::zeros(unknowns, half_bandwidth, border), tolerance)
    }

    /// A solver with room for a tangent, which says how it is eliminated.
    pub fn of(tangent: BorderedMatrix, tolerance: Tolerance) -> Self {
        Self {
            correction: Vec::with_capacity(tangent.size()),
            tangent,
            history: Vec::with_capacity(tolerance.iterations),
            tolerance,
        }
    }

    /// Improves `u` until the equations hold; `residual` is left as it was found last.
    ///
    /// `residual` may be longer than the unknowns: what follows them (reactions) is not solved for.
    ///
    /// # Errors
    /// When the iteration limit is reached, the tangent is singular, or a number is no longer finite.
    pub fn solve(
        &mut self,
        equations: &mut impl Equations,
        u: &mut [f64],
        residual: &mut [f64],
    ) -> Result<NewtonReport, NewtonError> {
        self.solve_and(equations, u, residual, |_, _| ())
    }

    /// Improves `u` as [`solve`](Self::solve) does, and hands on the solution and the factors that it was last corrected with, before these are lost.
    ///
    /// # Errors
    /// As those of [`solve`](Self::solve); then nothing is handed on.
    pub fn solve_and(
        &mut self,
        equations: &mut impl Equations,
        u: &mut [f64],
        residual: &mut [f64],
        hand_on: impl FnOnce(&[f64], &mut BorderedLu<'_>),
    ) -> Result<NewtonReport, NewtonError> {
        self.history.clear();
        let mut corrections = 0;
        while self.history.len() < self.tolerance.iterations {
            self.tangent.clear();
            residual.fill(0.0);
            equations.linearise(u, residual, &mut self.tangent);
            let mut factors = match self.tangent.factorise() {
                Ok(factors) => factors,
                Err(source) => {
                    return Err(NewtonError::Linear { source, history: self.history.clone() });
                }
            };
            let mut imbalance = correct(equations, &mut factors, &mut self.correction, u, residual);
            let mut factor = 0.0;
            for left in (0..MOST_CORRECTIONS).rev() {
                if !self.tolerance.is_worth_correcting(&imbalance, factor, left + 1) {
                    break;
                }
                let before = imbalance.largest();
                equations.condense(residual);
                imbalance = correct(equations, &mut factors, &mut self.correction, u, residual);
                factor = imbalance.largest() / before;
                corrections += 1;
            }
            // What is not finite is not worth correcting, so that no correction hides it.
            self.history.push(imbalance);
            if !imbalance.is_finite() {
                return Err(NewtonError::NotFinite { history: self.history.clone() });
            }
            if self.tolerance.accepts(&imbalance) {
                let iterations = self.history.len();
                hand_on(u, &mut factors);
                return Ok(NewtonReport { iterations, corrections, imbalance });
            }
        }
        Err(NewtonError::NotConverged { history: self.history.clone() })
    }

    /// Improves `u`, which solves equations near by, with the factors of these, nearly to rounding; where that does not get on, as [`solve`](Self::solve)
    /// does.
    ///
    /// # Errors
    /// As those of [`solve`](Self::solve).
    pub fn follow(
        &mut self,
        equations: &mut impl Equations,
        factors: &mut BorderedLu<'_>,
        u: &mut [f64],
        residual: &mut [f64],
    ) -> Result<NewtonReport, NewtonError> {
        self.tangent.clear();
        residual.fill(0.0);
        // The tangent is not needed; what hidden unknowns are condensed by is.
        equations.linearise(u, residual, &mut self.tangent);
        let mut before = f64::INFINITY;
        for corrections in 1..=MOST_FOLLOWING {
            let imbalance = correct(equations, factors, &mut self.correction, u, residual);
            let largest = imbalance.largest();
            let stands_still = largest > STANDSTILL * before;
            if self.tolerance.accepts(&imbalance) && (largest <= FOLLOWED || stands_still) {
                return Ok(NewtonReport { iterations: 0, corrections, imbalance });
            }
            if !imbalance.is_finite() || largest >= before {
                break;
            }
            before = largest;
            equations.condense(residual);
        }
        self.solve(equations, u, residual)
    }
}

/// Corrects `u` and the hidden unknowns for a condensed residual; leaves the residual and the imbalance after it.
fn correct(
    equations: &mut impl Equations,
    factors: &mut BorderedLu<'_>,
    correction: &mut Vec<f64>,
    u: &mut [f64],
    residual: &mut [f64],
) -> ResidualNorms {
    correction.clear();
    correction.extend(residual[..u.len()].iter().map(|r| -r));
    factors.solve(correction);
    u.iter_mut().zip(correction.iter()).for_each(|(u, correction)| *u += correction);
    equations.correct(correction);
    residual.fill(0.0);
    equations.imbalance(u, residual)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `x² = 2` and `x y = 1`, with no hidden unknowns.
    struct SquareRoot;

    impl Equations for SquareRoot {
        fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
            self.imbalance(u, residual);
            let tangent = tangent.band_mut();
            tangent.add(0, 0, 2.0 * u[0]);
            tangent.add(1, 0, u[1]);
            tangent.add(1, 1, u[0]);
        }
        fn condense(&mut self, _residual: &mut [f64]) {}
        fn correct(&mut self, _correction: &[f64]) {}
        fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms {
            residual[0] = u[0] * u[0] - 2.0;
            residual[1] = u[0] * u[1] - 1.0;
            ResidualNorms {
                force: residual[0].abs().max(residual[1].abs()),
                ..ResidualNorms::default()
            }
        }
    }

    fn solve(start: [f64; 2]) -> (Result<NewtonReport, NewtonError>, [f64; 2]) {
        let mut u = start;
        let report = Newton::new(2, 1, BorderShape::default(), Tolerance::default()).solve(
            &mut SquareRoot,
            &mut u,
            &mut [0.0; 2],
        );
        (report, u)
    }

    #[test]
    fn it_converges_quadratically_to_rounding() {
        let (report, u) = solve([1.5, 1.0]);
        assert!(report.unwrap().iterations <= 5);
        assert!((u[0] - 2.0_f64.sqrt()).abs() < 1e-15 && (u[1] - 0.5_f64.sqrt()).abs() < 1e-15);
    }

    /// `x = 0`, with imbalances that come from a list.
    struct SpoiltByCorrections {
        imbalances: std::vec::IntoIter<ResidualNorms>,
    }

    impl Equations for SpoiltByCorrections {
        fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
            residual[0] = u[0];
            tangent.band_mut().add(0, 0, 1.0);
        }
        fn condense(&mut self, _residual: &mut [f64]) {}
        fn correct(&mut self, _correction: &[f64]) {}
        fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms {
            residual[0] = u[0];
            self.imbalances.next().unwrap()
        }
    }

    #[test]
    fn a_correction_that_leaves_the_finite_numbers_is_an_error_that_shows_it() {
        let near = ResidualNorms { force: 1e-12, ..ResidualNorms::default() };
        let spoilt = [
            ResidualNorms { force: f64::NAN, ..near },
            ResidualNorms { strain: f64::NAN, ..near },
            ResidualNorms { constraint: f64::NAN, ..near },
            ResidualNorms { strain: f64::INFINITY, ..near },
        ];
        for spoilt in spoilt {
            assert!(!spoilt.largest().is_finite());
            let mut equations = SpoiltByCorrections { imbalances: vec![near, spoilt].into_iter() };
            let mut newton = Newton::new(1, 0, BorderShape::default(), Tolerance::default());
            let error = newton.solve(&mut equations, &mut [1.0], &mut [0.0]).unwrap_err();
            assert!(matches!(error, NewtonError::NotFinite { .. }), "{error}");
            let [last] = error.history() else { panic!("{error}") };
            assert!(!last.is_finite() && equations.imbalances.len() == 0);
        }
    }

    #[test]
    fn a_singular_tangent_and_a_lost_iteration_are_errors_with_their_history() {
        assert!(matches!(solve([0.0, 1.0]).0, Err(NewtonError::Linear { .. })));
        let error = solve([f64::NAN, 1.0]).0.unwrap_err();
        assert!(error.history().len() <= 1, "{error}");
    }
}
