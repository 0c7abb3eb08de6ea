//! Mechanisms that take the same steps as another one, with the factors of its equations.

use super::balance::{BalanceCoefficients, StepSolver};
use super::fourth_order::in_parts;
use super::{EnergyMomentum, Interval, Mechanism, Method, Stage, StepError};
use crate::linalg::BorderedLu;
use crate::newton::{NewtonReport, Tolerance};

/// A method whose steps take companions along: mechanisms of the same form, with parameters and states that differ little from those of the one that
/// leads.
///
/// The balance of a companion, `R(u; p + δ) = 0`, is solved from the solution of the leader with the factors of the leader's last Newton iteration: each
/// correction leaves a part of the error that is as small as `δ` and that iteration's step, so that a few lead to rounding. Nothing is factorised for it.
#[derive(Debug, Clone)]
pub struct SharedFactorStepper {
    leader: StepSolver,
    follower: StepSolver,
    parts: SubstepCount,
}

/// Of how many energy–momentum steps a step is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SubstepCount {
    One,
    OfFourthOrder,
}

/// The work of a step in company.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedFactorWork {
    /// The work for the mechanism that leads, as without company.
    pub leader: NewtonReport,
    /// The work for all companions together, or why one could not follow; iterations are those in which the factors of the leader did not do.
    pub companions: Result<NewtonReport, StepError>,
}

impl SharedFactorStepper {
    /// A method with work space for a mechanism and companions of its form, if steps of the method can be taken in company.
    pub fn of(method: Method, leader: &mut dyn Mechanism, tolerance: Tolerance) -> Option<Self> {
        let parts = match method {
            Method::EnergyMomentum => SubstepCount::One,
            Method::FourthOrder => SubstepCount::OfFourthOrder,
            _ => return None,
        };
        leader.checkpoint().keep();
        let [leader, follower] = [(); 2].map(|()| StepSolver::new(leader, tolerance));
        Some(Self { leader, follower, parts })
    }

    /// Advances the mechanism that leads over the interval, bit for bit as without company, and the companions with it. Where one of these cannot
    /// follow, all of them are left anywhere, and the one that leads goes on.
    ///
    /// # Errors
    /// As those of a step of the mechanism that leads, which is then left as it was, and companions anywhere.
    pub fn step(
        &mut self,
        leader: &mut dyn Mechanism,
        companions: &mut [&mut dyn Mechanism],
        interval: Interval,
    ) -> Result<SharedFactorWork, StepError> {
        let mut followed = Ok(NewtonReport::default());
        let parts = self.parts;
        let mut part = |leader: &mut dyn Mechanism, part: Interval| {
            self.part(leader, companions, part, &mut followed)
        };
        let leader = match parts {
            SubstepCount::One => part(leader, interval)?,
            SubstepCount::OfFourthOrder => in_parts(leader, interval, part)?,
        };
        Ok(SharedFactorWork { leader, companions: followed })
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
                    *followed = follow(follower, companions, step, solution, factors)
                        .map(|work| before.then(work));
                }
            })
        })?;
        solver.correct(leader, interval);
        Ok(report)
    }
}

/// Takes a step of all companions from the solution of the one that leads, with its factors.
fn follow(
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
                newton.follow(balance, factors, u, residual)
            })?;
        solver.correct(*companion, interval);
        work = work.then(report);
    }
    Ok(work)
}
