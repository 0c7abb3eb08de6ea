//! Steps of several similar mechanisms that share the factorised matrix of one mechanism.

use super::balance::{BalanceCoefficients, StepSolver};
use super::end_check::accept_end;
use super::fourth_order::in_parts;
use super::{EnergyMomentum, Interval, Mechanism, Method, Stage, StepError};
use crate::linalg::BorderedLu;
use crate::newton::{NewtonReport, Tolerance};

/// Integrator that advances a mechanism, the leader, together with companions.
/// A companion is a mechanism with the structure of the leader, and slightly different parameters and states.
///
/// The step of a companion is solved iteratively, with the matrix factors of the last Newton iteration of the leader.
#[derive(Debug, Clone)]
pub struct SharedFactorStepper {
    leader: StepSolver,
    follower: StepSolver,
    parts: SubstepCount,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SubstepCount {
    One,
    OfFourthOrder,
}

/// Solver statistics of a step with companions.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedFactorWork {
    /// Statistics of the leader, which do not depend on the companions.
    pub leader: NewtonReport,
    /// Statistics of all companions together, or the error of a companion that failed.
    pub companions: Result<NewtonReport, StepError>,
}

impl SharedFactorStepper {
    /// Creates the integrator for a leader and its companions; `None` if the method does not support companions.
    pub fn of(method: Method, leader: &mut dyn Mechanism, tolerance: Tolerance) -> Option<Self> {
        let parts = match method {
            Method::EnergyMomentum => SubstepCount::One,
            Method::FourthOrder => SubstepCount::OfFourthOrder,
            _ => return None,
        };
        leader.checkpoint().save_state();
        let [leader, follower] = [(); 2].map(|()| StepSolver::new(leader, tolerance));
        Some(Self { leader, follower, parts })
    }

    /// Advances the leader and the companions over the interval. The result of the leader is bit for bit the same as without companions.
    /// If a companion fails, the states of all companions are undefined, and the leader continues.
    ///
    /// # Errors
    /// Fails if the step of the leader fails. The leader is then unchanged, and the states of the companions are undefined.
    pub fn step(
        &mut self,
        leader: &mut dyn Mechanism,
        companions: &mut [&mut dyn Mechanism],
        interval: Interval,
    ) -> Result<SharedFactorWork, StepError> {
        let mut followed = Ok(NewtonReport::default());
        let parts = self.parts;
        let has_end_conditions = leader.has_end_conditions();
        if has_end_conditions {
            leader.checkpoint().save_state();
        }
        let mut part = |leader: &mut dyn Mechanism, part: Interval| {
            self.part(leader, companions, part, &mut followed)
        };
        let report = match parts {
            SubstepCount::One => part(leader, interval)?,
            SubstepCount::OfFourthOrder => in_parts(leader, interval, part)?,
        };
        if has_end_conditions {
            accept_end(leader, interval, report.iterations)?;
        }
        Ok(SharedFactorWork { leader: report, companions: followed })
    }

    fn part(
        &mut self,
        leader: &mut dyn Mechanism,
        companions: &mut [&mut dyn Mechanism],
        interval: Interval,
        followed: &mut Result<NewtonReport, StepError>,
    ) -> Result<NewtonReport, StepError> {
        leader.begin_step(interval, EnergyMomentum::STAGES)?;
        let Self { leader: solver, follower, .. } = self;
        solver.predict(leader, interval);
        let rule = BalanceCoefficients::mean(Stage::Midpoint, 1.0);
        let report = solver.solve_by(leader, interval, rule, |newton, balance, u, residual| {
            newton.solve_and(balance, u, residual, |solution, factors| {
                if let Ok(before) = followed {
                    let step = (interval, rule);
                    *followed = step_companions(follower, companions, step, solution, factors)
                        .map(|work| before.then(work));
                }
            })
        })?;
        solver.correct(leader, interval);
        Ok(report)
    }
}

fn step_companions(
    solver: &mut StepSolver,
    companions: &mut [&mut dyn Mechanism],
    (interval, rule): (Interval, BalanceCoefficients),
    solution: &[f64],
    factors: &mut BorderedLu<'_>,
) -> Result<NewtonReport, StepError> {
    let mut work = NewtonReport::default();
    for companion in companions {
        companion.begin_step(interval, EnergyMomentum::STAGES)?;
        solver.predict(*companion, interval);
        solver.begin_at(solution);
        let report =
            solver.solve_by(*companion, interval, rule, |newton, balance, u, residual| {
                newton.solve_with_shared_factors(balance, factors, u, residual)
            })?;
        solver.correct(*companion, interval);
        work = work.then(report);
    }
    Ok(work)
}
