//! Newton's method, with corrections between iterations that reuse earlier matrix factors.

use serde::{Deserialize, Serialize};

use super::{Equations, NewtonError, ResidualNorms};
use crate::elementary::whole_power;
use crate::linalg::{BorderShape, BorderedLu, BorderedMatrix};

/// Largest residual norm after an iteration for which corrections with the same factors are tried [-].
const NEAR: f64 = 1e-4;

/// Largest number of corrections that reuse the factors of an iteration.
/// An iteration with new factors squares the residual norm. A correction with earlier factors multiplies the norm by a constant factor.
const MOST_CORRECTIONS: i32 = 5;

/// Largest number of corrections that reuse the factorised tangent of similar equations.
const MOST_SHARED_CORRECTIONS: usize = 12;

/// Residual norm at which a solution with the factorised tangent of similar equations is accepted [-].
/// The similar equations have other parameters, which changes the residual norm by about 1e-5. The limit must be far below this change.
const FOLLOWED: f64 = 1e-14;

/// Limit of the ratio of two successive residual norms [-]. If the ratio exceeds this value, the residual consists of rounding errors.
/// Further corrections then have no effect.
const STANDSTILL: f64 = 0.1;

/// Convergence tolerances and iteration limit of Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Tolerance of the relative residual force [-].
    pub force: f64,
    /// Tolerance of the strain residual [-].
    pub strain: f64,
    /// Tolerance of the relative constraint violation [-].
    pub constraint: f64,
    /// Largest residual norm that is attributed to rounding [-].
    /// A converged solution whose residual norm exceeds `polish` is corrected again with the last factors.
    pub polish: f64,
    /// Largest number of iterations.
    pub iterations: usize,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { force: 1e-11, strain: 1e-11, constraint: 1e-11, polish: 5e-16, iterations: 15 }
    }
}

impl Tolerance {
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

/// Statistics of a solution, with its final residual norms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NewtonReport {
    /// Number of iterations. Each iteration has one factorisation.
    pub iterations: usize,
    /// Number of corrections that reuse factors. A correction takes about a third of the time of an iteration.
    pub corrections: usize,
    /// Final residual norms.
    pub imbalance: ResidualNorms,
}

impl NewtonReport {
    /// Combines the reports of two consecutive solutions: the sums of the work, and the residual norms of the second solution.
    pub fn then(self, next: Self) -> Self {
        Self {
            iterations: self.iterations + next.iterations,
            corrections: self.corrections + next.corrections,
            imbalance: next.imbalance,
        }
    }
}

/// Newton's method with preallocated memory. A solution allocates no memory unless it fails or uses joint elimination.
#[derive(Debug, Clone)]
pub struct Newton {
    tolerance: Tolerance,
    tangent: BorderedMatrix,
    correction: Vec<f64>,
    history: Vec<ResidualNorms>,
}

impl Newton {
    /// Creates a solver for `unknowns` unknowns. The tangent is a band with the given half-bandwidth, and a border.
    pub fn new(
        unknowns: usize,
        half_bandwidth: usize,
        border: BorderShape,
        tolerance: Tolerance,
    ) -> Self {
        Self::of(BorderedMatrix::zeros(unknowns, half_bandwidth, border), tolerance)
    }

    /// Creates a solver with the given tangent. The type of the border of the tangent determines the method of elimination.
    pub fn of(tangent: BorderedMatrix, tolerance: Tolerance) -> Self {
        Self {
            correction: Vec::with_capacity(tangent.size()),
            tangent,
            history: Vec::with_capacity(tolerance.iterations),
            tolerance,
        }
    }

    /// Iterates the unknowns `u` until the equations are satisfied. Afterwards, `residual` contains the last residual.
    ///
    /// The vector `residual` may be longer than the unknowns. Its additional entries are reactions, which need not be zero.
    ///
    /// # Errors
    /// Fails if the iteration limit is reached, the tangent is singular, a number is not finite, or the equations stop the solution.
    pub fn solve(
        &mut self,
        equations: &mut impl Equations,
        u: &mut [f64],
        residual: &mut [f64],
    ) -> Result<NewtonReport, NewtonError> {
        self.solve_and(equations, u, residual, |_, _| ())
    }

    pub(crate) fn solve_and(
        &mut self,
        equations: &mut impl Equations,
        u: &mut [f64],
        residual: &mut [f64],
        hand_on: impl FnOnce(&[f64], &mut BorderedLu<'_>),
    ) -> Result<NewtonReport, NewtonError> {
        self.history.clear();
        let mut corrections = 0;
        while self.history.len() < self.tolerance.iterations {
            if !equations.goes_on() {
                return Err(NewtonError::Interrupted { history: self.history.clone() });
            }
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
            // If the residual is not finite, no corrections are made, because they might hide the invalid number.
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

    /// Solves the equations almost to rounding error with the factorised tangent of similar equations.
    /// If the iteration with shared factors does not converge, it is continued by [`solve`](Self::solve).
    pub(crate) fn solve_with_shared_factors(
        &mut self,
        equations: &mut impl Equations,
        factors: &mut BorderedLu<'_>,
        u: &mut [f64],
        residual: &mut [f64],
    ) -> Result<NewtonReport, NewtonError> {
        self.tangent.clear();
        residual.fill(0.0);
        // The method `linearise` is called to eliminate the internal unknowns. The tangent is not used.
        equations.linearise(u, residual, &mut self.tangent);
        let mut before = f64::INFINITY;
        for corrections in 1..=MOST_SHARED_CORRECTIONS {
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
    fn newton_converges_quadratically_to_rounding() {
        let (report, u) = solve([1.5, 1.0]);
        assert!(report.unwrap().iterations <= 5);
        assert!((u[0] - 2.0_f64.sqrt()).abs() < 1e-15 && (u[1] - 0.5_f64.sqrt()).abs() < 1e-15);
    }

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
    fn nonfinite_residual_is_an_error_with_its_history() {
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
    fn singular_tangent_and_nan_start_are_errors_with_history() {
        assert!(matches!(solve([0.0, 1.0]).0, Err(NewtonError::Linear { .. })));
        let error = solve([f64::NAN, 1.0]).0.unwrap_err();
        assert!(error.history().len() <= 1, "{error}");
    }
}
