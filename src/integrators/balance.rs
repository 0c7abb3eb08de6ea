//! The equations of one step, and the work space to solve them: what all integrators here share.

use super::{Interval, Mechanism, Stage, StepError};
use crate::linalg::BandedMatrix;
use crate::newton::{Equations, Imbalance, Newton, NewtonReport, Tolerance};

/// A rotation increment at which half a turn is taken in one step.
const HALF_TURN: f64 = std::f64::consts::PI;

/// `R(u) = 2/Δt² M u + weight · F(stage, u) + carried`, for increments `u` with `(v0 + v1)/2 = u/Δt`.
struct StepBalance<'a> {
    mechanism: &'a mut dyn Mechanism,
    stage: Stage,
    weight: f64,
    duration: f64,
    carried: &'a [f64],
}

impl StepBalance<'_> {
    fn add_known_part(&mut self, u: &[f64], residual: &mut [f64]) {
        self.mechanism.add_inertia(2.0 / self.duration.powi(2), u, residual);
        residual.iter_mut().zip(self.carried).for_each(|(r, carried)| *r += carried);
    }
}

impl Equations for StepBalance<'_> {
    fn unknowns(&self) -> usize {
        self.mechanism.unknowns()
    }

    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BandedMatrix) {
        self.add_known_part(u, residual);
        self.mechanism.add_inertia_tangent(2.0 / self.duration.powi(2), tangent);
        self.mechanism.add_linearised_forces(self.stage, u, self.weight, residual, tangent);
    }

    fn correct(&mut self, correction: &[f64]) {
        self.mechanism.correct_section_forces(correction);
    }

    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> Imbalance {
        self.add_known_part(u, residual);
        let strain = self.mechanism.add_forces(self.stage, u, self.weight, residual);
        Imbalance { force: self.mechanism.relative_imbalance(residual), strain }
    }
}

/// The vectors of a step and the Newton solver, allocated once.
#[derive(Debug, Clone)]
pub(super) struct StepSolver {
    newton: Newton,
    increments: Vec<f64>,
    /// The part of the residual that does not depend on the increments.
    pub(super) carried: Vec<f64>,
    rates: Vec<f64>,
    residual: Vec<f64>,
}

impl StepSolver {
    pub(super) fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        let (unknowns, all) = (mechanism.unknowns(), mechanism.degrees_of_freedom());
        Self {
            newton: Newton::new(unknowns, mechanism.half_bandwidth(), tolerance),
            increments: vec![0.0; unknowns],
            carried: vec![0.0; all],
            rates: vec![0.0; unknowns],
            residual: vec![0.0; all],
        }
    }

    /// Predicts that every rate stays as it is, and carries the momentum of the start: `-2/Δt M v0`.
    pub(super) fn predict(&mut self, mechanism: &mut dyn Mechanism, interval: Interval) {
        let duration = interval.duration();
        self.increments.iter_mut().zip(mechanism.rates()).for_each(|(u, rate)| *u = duration * rate);
        self.carried.fill(0.0);
        mechanism.add_momentum(-2.0 / duration, &mut self.carried);
    }

    /// Solves for the increments with the forces of `stage`.
    pub(super) fn solve(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
        stage: Stage,
        weight: f64,
    ) -> Result<NewtonReport, StepError> {
        let mut balance =
            StepBalance { mechanism, stage, weight, duration: interval.duration(), carried: &self.carried };
        let report = self
            .newton
            .solve(&mut balance, &mut self.increments, &mut self.residual)
            .map_err(|source| StepError::Newton { interval, source })?;
        let rotation = balance.mechanism.largest_rotation();
        if rotation < HALF_TURN { Ok(report) } else { Err(StepError::Rotation { interval, rotation }) }
    }

    /// Accepts the increments: `v1 = 2 u/Δt - v0`.
    pub(super) fn correct(&mut self, mechanism: &mut dyn Mechanism, interval: Interval) {
        let twice_inverse = 2.0 / interval.duration();
        for ((v1, u), v0) in self.rates.iter_mut().zip(&self.increments).zip(mechanism.rates()) {
            *v1 = twice_inverse * u - v0;
        }
        mechanism.advance(&self.increments, &self.rates, &self.residual);
    }
}
