//! Equations of one step and the memory to solve them, used by all integrators.

use super::prescribed::BalancedAt;
use super::{FailureSource, Interval, Mechanism, Solution, Stage, StepError};
use crate::elementary::square;
use crate::linalg::BorderedMatrix;
use crate::newton::{Equations, Newton, NewtonError, NewtonReport, ResidualNorms, Tolerance};

/// Largest allowed rotation increment `Δω` [rad]. For larger rotation increments, the direction of rotation is ambiguous.
const LARGEST_INCREMENT: f64 = std::f64::consts::PI;

/// Smallest allowed chord of the path of a slider in the mean configuration, as a fraction of the length of the path.
/// A master that rotates by about π in a step has an almost zero chord, and the contact equations have spurious solutions.
const SHORTEST_CHORD: f64 = 1e-3;

#[derive(Debug, Clone, Copy)]
pub(super) struct BalanceCoefficients {
    /// Factor by which inertia forces are multiplied in the balance of the step [-].
    pub(super) inertia: f64,
    pub(super) stage: Stage,
    /// Factor by which the forces of the stage are multiplied in the balance of the step [-].
    pub(super) weight: f64,
    pub(super) prescribed: BalancedAt,
}

impl BalanceCoefficients {
    pub(super) fn mean(stage: Stage, weight: f64) -> Self {
        Self { inertia: 2.0, stage, weight, prescribed: BalancedAt::Mean }
    }
}

/// Balance of a step, as equations for the increments and the constraint multipliers.
/// The unknowns are the deviations of the increments from a motion with constant velocity.
/// The rounding error of the final velocity is proportional to the deviation from constant velocity, so that momenta do not drift.
pub(super) struct StepBalance<'a> {
    mechanism: &'a mut dyn Mechanism,
    rule: BalanceCoefficients,
    duration: f64,
    constant_residual: &'a [f64],
    free_increments: &'a [f64],
    increments: &'a mut [f64],
    movements: usize,
}

impl StepBalance<'_> {
    fn split<'u>(&self, unknowns: &'u [f64]) -> (&'u [f64], &'u [f64]) {
        unknowns.split_at(self.movements)
    }

    fn begin(&mut self, deviation: &[f64], residual: &mut [f64]) {
        for ((u, coasting), d) in
            self.increments.iter_mut().zip(self.free_increments).zip(deviation)
        {
            *u = coasting + d;
        }
        residual.iter_mut().zip(self.constant_residual).for_each(|(r, carried)| *r += carried);
        self.mechanism.add_inertia(self.inertia(), deviation, residual);
    }

    fn failure_source(&self, error: &NewtonError, residual: &[f64]) -> Option<FailureSource> {
        if let NewtonError::Linear { source, .. } = error {
            return Some(FailureSource::Unknown(source.unknown()));
        }
        let part = error.history().last()?.worst();
        self.mechanism.worst(part, residual)
    }

    fn inertia(&self) -> f64 {
        self.rule.inertia / square(self.duration)
    }
}

impl Equations for StepBalance<'_> {
    fn linearise(&mut self, unknowns: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        let (deviation, constraints) = self.split(unknowns);
        self.begin(deviation, residual);
        let inertia = self.inertia();
        let Self { mechanism, rule, increments, .. } = self;
        tangent.use_threads(mechanism.threads());
        let band = tangent.band_mut();
        mechanism.add_inertia_tangent(inertia, band);
        mechanism.add_linearised_forces(rule.stage, increments, rule.weight, residual, band);
        let border = tangent.border_mut();
        mechanism.add_linearised_constraints(increments, constraints, residual, border);
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.mechanism.add_mismatch_forces(self.rule.weight, residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        self.mechanism.correct_section_forces(self.split(correction).0);
    }

    fn imbalance(&mut self, unknowns: &[f64], residual: &mut [f64]) -> ResidualNorms {
        let (deviation, constraints) = self.split(unknowns);
        self.begin(deviation, residual);
        let BalanceCoefficients { stage, weight, .. } = self.rule;
        let strain = self.mechanism.add_forces(stage, self.increments, weight, residual);
        self.mechanism.add_constraints(self.increments, constraints, residual);
        ResidualNorms {
            force: self.mechanism.relative_imbalance(residual),
            strain,
            constraint: self.mechanism.relative_violation(residual),
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct StepSolver {
    newton: Newton,
    free_increments: Vec<f64>,
    unknowns: Vec<f64>,
    increments: Vec<f64>,
    constant_residual: Vec<f64>,
    rates: Vec<f64>,
    residual: Vec<f64>,
    balanced: Vec<(Stage, f64)>,
    /// True if the integrator balances changes of momentum. False if the integrator balances accelerations.
    balances_rates: bool,
}

impl StepSolver {
    pub(super) fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        let (movements, all) = (mechanism.unknowns(), mechanism.degrees_of_freedom());
        let border = mechanism.constraint_shape();
        let moving = movements + mechanism.prescribed().width();
        let half_bandwidth = mechanism.half_bandwidth();
        let tangent = match mechanism.constraint_blocks() {
            None => BorderedMatrix::zeros(movements, half_bandwidth, border),
            Some(blocks) => BorderedMatrix::with_blocks(movements, half_bandwidth, blocks.clone()),
        };
        Self {
            newton: Newton::of(tangent, tolerance),
            free_increments: vec![0.0; movements],
            unknowns: vec![0.0; movements + border.width],
            increments: vec![0.0; moving],
            constant_residual: vec![0.0; all],
            rates: vec![0.0; moving],
            residual: vec![0.0; all],
            balanced: Vec::with_capacity(Stage::ALL.len()),
            balances_rates: true,
        }
    }

    pub(super) fn predict(&mut self, mechanism: &mut dyn Mechanism, interval: Interval) {
        let duration = interval.duration();
        self.free_increments
            .iter_mut()
            .zip(mechanism.rates())
            .for_each(|(u, rate)| *u = duration * rate);
        let (deviation, constraints) = self.unknowns.split_at_mut(self.free_increments.len());
        let expected = mechanism.expected_rates().iter().zip(mechanism.rates());
        deviation
            .iter_mut()
            .zip(expected)
            .for_each(|(d, (expected, rate))| *d = duration * (expected - rate));
        mechanism.predict_constraints(interval, constraints);
        self.constant_residual.fill(0.0);
        self.balanced.clear();
        self.balances_rates = true;
    }

    pub(super) fn carry(&mut self, mechanism: &mut dyn Mechanism, stage: Stage, share: f64) {
        self.increments.fill(0.0);
        mechanism.add_forces(stage, &self.increments, share, &mut self.constant_residual);
        self.balanced.push((stage, share));
    }

    pub(super) fn carry_inertia(
        &mut self,
        mechanism: &mut dyn Mechanism,
        factor: f64,
        accelerations: &[f64],
    ) {
        mechanism.add_inertia(factor, accelerations, &mut self.constant_residual);
        self.balances_rates = false;
    }

    pub(super) fn solve(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
        rule: BalanceCoefficients,
    ) -> Result<NewtonReport, StepError> {
        self.solve_by(mechanism, interval, rule, |newton, balance, unknowns, residual| {
            newton.solve(balance, unknowns, residual)
        })
    }

    pub(super) fn begin_at(&mut self, solution: &[f64]) {
        self.unknowns.copy_from_slice(solution);
    }

    pub(super) fn solve_by(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
        rule: BalanceCoefficients,
        way: impl FnOnce(
            &mut Newton,
            &mut StepBalance<'_>,
            &mut [f64],
            &mut [f64],
        ) -> Result<NewtonReport, NewtonError>,
    ) -> Result<NewtonReport, StepError> {
        self.take_prescribed(mechanism, rule.prescribed);
        self.balanced.push((rule.stage, rule.weight));
        let mut balance = StepBalance {
            mechanism,
            rule,
            duration: interval.duration(),
            constant_residual: &self.constant_residual,
            free_increments: &self.free_increments,
            increments: &mut self.increments,
            movements: self.free_increments.len(),
        };
        let solved = way(&mut self.newton, &mut balance, &mut self.unknowns, &mut self.residual);
        let report = match solved {
            Ok(report) => report,
            Err(source) => {
                let failure_source = balance.failure_source(&source, &self.residual);
                let source = Box::new(source);
                return Err(StepError::Newton {
                    interval,
                    source,
                    before: 0,
                    failure_source: failure_source.map(Box::new),
                });
            }
        };
        let rotation = balance.mechanism.largest_rotation();
        let is_resolved = rotation < LARGEST_INCREMENT;
        if !is_resolved {
            return Err(StepError::Rotation { interval, rotation, iterations: report.iterations });
        }
        let chord = balance.mechanism.shortest_chord();
        if chord < SHORTEST_CHORD {
            return Err(StepError::Chord { interval, chord, iterations: report.iterations });
        }
        if let Some(obstacle) = balance.mechanism.crossed_obstacle(balance.increments) {
            let obstacle = obstacle.to_owned();
            return Err(StepError::Crossing { interval, obstacle, iterations: report.iterations });
        }
        let (_, constraints) = self.unknowns.split_at(self.free_increments.len());
        match mechanism.check_constraints(constraints) {
            Ok(()) => Ok(report),
            Err(overshoot) => {
                Err(StepError::Overshoot { interval, overshoot, iterations: report.iterations })
            }
        }
    }

    fn take_prescribed(&mut self, mechanism: &mut dyn Mechanism, at: BalancedAt) {
        let movements = self.free_increments.len();
        let prescribed = mechanism.prescribed();
        if prescribed.width() == 0 {
            return;
        }
        self.increments[movements..].copy_from_slice(&prescribed.increments);
        let (unknown, behind) = self.rates.split_at_mut(movements);
        unknown.fill(0.0);
        behind
            .iter_mut()
            .zip(prescribed.balanced(at))
            .for_each(|(entry, balanced)| *entry = balanced);
        mechanism.add_inertia(1.0, &self.rates, &mut self.constant_residual);
    }

    pub(super) fn correct(&mut self, mechanism: &mut dyn Mechanism, interval: Interval) {
        let twice_inverse = 2.0 / interval.duration();
        self.accept(mechanism, |_, v0, d| v0 + twice_inverse * d);
    }

    /// Ends the step with the present increments.
    /// The callback `rate` returns the rate of an unknown at the end of the step.
    /// The arguments of `rate` are the index of the unknown, its rate at the start, and its deviation from constant velocity.
    pub(super) fn accept(
        &mut self,
        mechanism: &mut dyn Mechanism,
        mut rate: impl FnMut(usize, f64, f64) -> f64,
    ) {
        let (deviation, constraints) = self.unknowns.split_at(self.free_increments.len());
        let known = mechanism.rates().iter().zip(deviation).enumerate();
        for (v1, (at, (v0, d))) in self.rates.iter_mut().zip(known) {
            *v1 = rate(at, *v0, *d);
        }
        let movements = self.free_increments.len();
        self.rates[movements..].copy_from_slice(&mechanism.prescribed().rates);
        let Self { increments, rates, residual, .. } = self;
        let balanced = if self.balances_rates { &*self.balanced } else { &[] };
        mechanism.advance(&Solution { increments, constraints, rates, residual, balanced });
    }
}
