//! The equations of one step, and the work space to solve them: what all integrators here share.

use super::{Interval, Mechanism, Stage, StepError};
use crate::linalg::BandedMatrix;
use crate::newton::{Equations, Imbalance, Newton, NewtonReport, Tolerance};

/// The largest increment `Δω`, mean rate times step: beyond it a turn cannot be told from one the other way round.
const LARGEST_INCREMENT: f64 = std::f64::consts::PI;

/// `R(d) = 2/Δt² M d + weight · F(stage, u) + carried`, `u = Δt v0 + d`.
///
/// The unknown is the deviation `d` from coasting, not the increment `u`: `v1 = v0 + 2/Δt d` then rounds like the change
/// of the velocity, so that momenta do not creep over many steps.
struct StepBalance<'a> {
    mechanism: &'a mut dyn Mechanism,
    stage: Stage,
    weight: f64,
    duration: f64,
    carried: &'a [f64],
    coasting: &'a [f64],
    increments: &'a mut [f64],
}

impl StepBalance<'_> {
    fn begin(&mut self, deviation: &[f64], residual: &mut [f64]) {
        for ((u, coasting), d) in self.increments.iter_mut().zip(self.coasting).zip(deviation) {
            *u = coasting + d;
        }
        residual.iter_mut().zip(self.carried).for_each(|(r, carried)| *r += carried);
        self.mechanism.add_inertia(2.0 / self.duration.powi(2), deviation, residual);
    }
}

impl Equations for StepBalance<'_> {
    fn linearise(&mut self, deviation: &[f64], residual: &mut [f64], tangent: &mut BandedMatrix) {
        self.begin(deviation, residual);
        self.mechanism.add_inertia_tangent(2.0 / self.duration.powi(2), tangent);
        self.mechanism.add_linearised_forces(
            self.stage,
            self.increments,
            self.weight,
            residual,
            tangent,
        );
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.mechanism.add_mismatch_forces(self.weight, residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        self.mechanism.correct_section_forces(correction);
    }

    fn imbalance(&mut self, deviation: &[f64], residual: &mut [f64]) -> Imbalance {
        self.begin(deviation, residual);
        let strain = self.mechanism.add_forces(self.stage, self.increments, self.weight, residual);
        Imbalance { force: self.mechanism.relative_imbalance(residual), strain }
    }
}

/// The vectors of a step and the Newton solver, allocated once.
#[derive(Debug, Clone)]
pub(super) struct StepSolver {
    newton: Newton,
    /// `Δt v0`
    coasting: Vec<f64>,
    deviation: Vec<f64>,
    increments: Vec<f64>,
    /// The part of the residual that does not depend on the increments.
    carried: Vec<f64>,
    rates: Vec<f64>,
    residual: Vec<f64>,
}

impl StepSolver {
    pub(super) fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        let (unknowns, all) = (mechanism.unknowns(), mechanism.degrees_of_freedom());
        Self {
            newton: Newton::new(unknowns, mechanism.half_bandwidth(), tolerance),
            coasting: vec![0.0; unknowns],
            deviation: vec![0.0; unknowns],
            increments: vec![0.0; unknowns],
            carried: vec![0.0; all],
            rates: vec![0.0; unknowns],
            residual: vec![0.0; all],
        }
    }

    /// Predicts that every rate stays as it is.
    pub(super) fn predict(&mut self, mechanism: &dyn Mechanism, interval: Interval) {
        let duration = interval.duration();
        self.coasting.iter_mut().zip(mechanism.rates()).for_each(|(u, rate)| *u = duration * rate);
        self.deviation.fill(0.0);
        self.carried.fill(0.0);
    }

    /// Adds a share of the forces of a stage at which nothing has moved yet.
    pub(super) fn carry(&mut self, mechanism: &mut dyn Mechanism, stage: Stage, share: f64) {
        // The deviation is still zero: it serves as the increments of standing still.
        mechanism.add_forces(stage, &self.deviation, share, &mut self.carried);
    }

    /// Solves for the increments with the forces of `stage`.
    pub(super) fn solve(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
        stage: Stage,
        weight: f64,
    ) -> Result<NewtonReport, StepError> {
        let mut balance = StepBalance {
            mechanism,
            stage,
            weight,
            duration: interval.duration(),
            carried: &self.carried,
            coasting: &self.coasting,
            increments: &mut self.increments,
        };
        let report = self
            .newton
            .solve(&mut balance, &mut self.deviation, &mut self.residual)
            .map_err(|source| StepError::Newton { interval, source })?;
        let rotation = balance.mechanism.largest_rotation();
        if rotation < LARGEST_INCREMENT {
            Ok(report)
        } else {
            Err(StepError::Rotation { interval, rotation, iterations: report.iterations })
        }
    }

    /// Accepts the increments, with the rates `v1 = 2 u/Δt - v0`.
    pub(super) fn correct(&mut self, mechanism: &mut dyn Mechanism, interval: Interval) {
        let twice_inverse = 2.0 / interval.duration();
        for ((v1, d), v0) in self.rates.iter_mut().zip(&self.deviation).zip(mechanism.rates()) {
            *v1 = v0 + twice_inverse * d;
        }
        mechanism.advance(&self.increments, &self.rates, &self.residual);
    }
}
