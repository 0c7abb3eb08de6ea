//! Implementation of the interface [`Mechanism`] for a model, for use by integrators.

use super::System;
use crate::beams::{Collocation, ForceSummary};
use crate::geometry::{cross, larger};
use crate::integrators::{
    Accelerated, Checkpoint, Constraints, ExternalError, FailureSource, Forces, Interval,
    Mechanism, Overshoot, PrescribedKinematics, Solution, Stage, StepError,
};
use crate::linalg::{BandedMatrix, BlockLayout, Border, BorderShape};
use crate::newton::ResidualPart;
use crate::system::elements::{TrialState, WorkAndImpulse, collocation};
use crate::system::links::ArmRule;
use crate::system::sliders::InStep;

/// Rule for the arms of rigid links: they are evaluated at the fraction of the step at which the integrator evaluates the balance.
/// Evaluation of the arms at any other fraction would reduce the integrator to first order.
fn arm_rule(stage: Stage, weight: f64) -> ArmRule {
    let Collocation { rotations, configuration, .. } = collocation(stage);
    let share = if stage == Stage::End { weight } else { configuration };
    ArmRule { rotations, fraction: share }
}

impl System {
    pub(super) fn add_internal_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> ForceSummary {
        let mut summary = self.bodies.add_forces(collocation(stage), increments, weight, out);
        let at = TrialState { bodies: &self.bodies, stage, increments, weight };
        self.elements.add_resistance(at, out, &mut summary);
        if stage != Stage::Start {
            let arms = arm_rule(stage, weight);
            self.links.add(&self.bodies, arms, increments, out, &mut summary);
        }
        summary
    }

    pub(super) fn subtract_loads(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        let at = TrialState { bodies: &self.bodies, stage, increments, weight };
        self.elements.subtract_from(at, out)
    }

    pub(super) fn add_linearised(
        &mut self,
        stage: Stage,
        increments: &[f64],
        (weight, share): (f64, f64),
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        let at = collocation(stage);
        self.bodies.add_linearised_forces(at, increments, weight, out, tangent);
        let (at, unknowns) =
            (TrialState { bodies: &self.bodies, stage, increments, weight }, self.unknowns.count());
        self.elements.add_linearised_resistance(at, out, unknowns, tangent);
        let (arms, none) = (arm_rule(stage, weight), &mut ForceSummary::default());
        self.links.add(&self.bodies, arms, increments, out, none);
        self.links.add_tangent(&self.bodies, arms, increments, unknowns, tangent);
        self.subtract_loads(stage, increments, share, out);
        let at = TrialState { bodies: &self.bodies, stage, increments, weight: share };
        self.elements.add_tangent(at, unknowns, tangent);
    }

    fn exchange_in_step(&self, increments: &[f64], residual: &[f64]) -> WorkAndImpulse {
        let duration = self.step.interval.duration();
        let mut sum = self.elements.exchange(&self.bodies, duration);
        sum += self.supports.exchange(&self.bodies, residual, duration);
        for (unknown, roller) in self.links.rollers() {
            let impulse = roller.force_of(increments[unknown]);
            sum +=
                WorkAndImpulse::of(0.0, impulse, cross(roller.mean_place(&self.bodies), impulse));
        }
        if duration < 0.0 { sum.negated() } else { sum }
    }

    fn add_prescribed_inertia(&mut self, rates: &[f64]) {
        let Self { bodies, elements, supports, motion, step, .. } = self;
        let movements = supports.prescribed_mut();
        let before = &motion.rates;
        let (change, struck) = (movements.fill(|at| rates[at] - before[at]), step.no_forces());
        bodies.add_inertia(1.0, change, struck);
        elements.add_inertia(bodies, 1.0, change, struck);
        movements.store_impact_momentum(struck);
        let mean = movements.fill(|at| 0.5 * (before[at] + rates[at]));
        let momentum = step.no_forces();
        bodies.add_inertia(1.0, mean, momentum);
        elements.add_inertia(bodies, 1.0, mean, momentum);
        movements.store_mean_momentum(bodies, momentum);
    }

    fn exchange_of_drives(&mut self, rates: &[f64], residual: &[f64]) -> WorkAndImpulse {
        let duration = self.step.interval.duration();
        let in_step = (duration, self.step.rotations);
        let before = &self.motion.rates;
        let mean = |at: usize| 0.5 * (before[at] + rates[at]);
        let movements = self.supports.prescribed_mut();
        let sum = movements.exchange(&self.bodies, residual, in_step, mean);
        if duration < 0.0 { sum.negated() } else { sum }
    }
}

impl Forces for System {
    fn add_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> f64 {
        let summary = self.add_internal_forces(stage, increments, weight, out);
        self.step.loads = self.subtract_loads(stage, increments, weight, out);
        self.step.summary = summary;
        self.step.rotations = collocation(stage).rotations;
        summary.strain_mismatch
    }

    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.add_linearised(stage, increments, (weight, weight), out, tangent);
    }

    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        self.bodies.add_mismatch_forces(weight, out);
        self.elements.add_mismatch_forces(&self.bodies, weight, out);
    }

    fn correct_section_forces(&mut self, correction: &[f64]) {
        self.bodies.correct_section_forces(correction);
        self.elements.correct(&self.bodies, correction);
    }

    fn relative_imbalance(&self, residual: &[f64]) -> f64 {
        let (force, moment) = self.unknowns.largest(residual);
        larger(self.step.relative_force(force), self.step.relative_moment(moment))
    }

    fn worst(&self, part: ResidualPart, residual: &[f64]) -> Option<FailureSource> {
        self.worst_of(part, residual)
    }

    fn crossed_obstacle(&self, increments: &[f64]) -> Option<&str> {
        let mut all = self.elements.resistances();
        Some(all.find(|one| one.crosses(&self.bodies, increments))?.name())
    }

    fn largest_rotation(&self) -> f64 {
        larger(self.step.summary.rotation, self.supports.prescribed().largest_rotation())
    }
}

impl Constraints for System {
    fn constraint_shape(&self) -> BorderShape {
        self.sliders.border()
    }

    fn constraint_blocks(&self) -> Option<&BlockLayout> {
        self.sliders.blocks()
    }

    fn predict_constraints(&mut self, interval: Interval, unknowns: &mut [f64]) {
        self.sliders.predict(&self.bodies, &self.motion.rates, interval, unknowns);
    }

    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]) {
        let movements = self.unknowns.count();
        self.step.contact =
            self.sliders.add::<InStep>(&self.bodies, movements, increments, unknowns, out);
    }

    fn add_linearised_constraints(
        &mut self,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        let movements = self.unknowns.count();
        self.sliders.add_linearised::<InStep>(
            &self.bodies,
            movements,
            increments,
            unknowns,
            out,
            border,
        );
    }

    fn relative_violation(&self, residual: &[f64]) -> f64 {
        let equations = &residual[self.unknowns.count()..];
        let contacts = self.sliders.violation(equations, |force| self.step.relative_force(force));
        larger(contacts, self.links.violation(residual))
    }

    fn check_constraints(&mut self, unknowns: &[f64]) -> Result<(), Overshoot> {
        self.sliders.check(unknowns, self.step.interval.ending())
    }

    fn has_end_conditions(&self) -> bool {
        self.sliders.iter().any(|slider| slider.unilateral.is_some())
    }

    fn check_end(&mut self) -> Result<(), Overshoot> {
        self.check_contact_forces()
    }

    fn shortest_chord(&self) -> f64 {
        self.sliders.shortest_chord()
    }
}

impl Mechanism for System {
    fn unknowns(&self) -> usize {
        self.unknowns.count()
    }

    fn degrees_of_freedom(&self) -> usize {
        self.unknowns.count() + self.sliders.border().width + self.supports.count()
    }

    fn half_bandwidth(&self) -> usize {
        self.unknowns.half_bandwidth()
    }

    fn threads(&self) -> usize {
        self.bodies.threads()
    }

    fn rates(&self) -> &[f64] {
        &self.motion.rates
    }

    fn expected_rates(&self) -> &[f64] {
        self.motion.expected_rates()
    }

    fn prescribed(&self) -> &PrescribedKinematics {
        self.supports.prescribed().in_step()
    }

    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError> {
        if self.has_friction() {
            self.measure_inertia_across();
        }
        let Self { bodies, elements, links, sliders, supports, motion, step, unknowns, .. } = self;
        let refused =
            |(load, error)| StepError::Load { interval, load, source: ExternalError::new(error) };
        let rotations = collocation(stages.first().copied().unwrap_or(Stage::Midpoint)).rotations;
        let movements = supports.prescribed_mut();
        movements.begin_step(interval, rotations, &motion.rates).map_err(refused)?;
        links.begin_step(interval.duration());
        sliders.begin_step(bodies, &motion.rates, (interval, rotations));
        elements.begin_step((interval, stages), bodies, &motion.rates).map_err(refused)?;
        bodies.begin_step();
        let knows_accelerations = motion.accelerations.known().is_some();
        let may_jump = knows_accelerations && elements.may_jump_at(interval.start);
        step.begin(interval, links.largest_arm(), may_jump);
        let (factor, inertia) = (2.0 / interval.duration(), step.no_forces());
        bodies.add_inertia(factor, &motion.rates, inertia);
        elements.add_inertia(bodies, factor, &motion.rates, inertia);
        step.inertia = unknowns.largest(inertia);
        Ok(())
    }

    fn advance(&mut self, solution: &Solution<'_>) {
        let Solution { increments, constraints, rates, residual, .. } = *solution;
        self.add_impulses_of_step(solution);
        let is_driven = self.supports.prescribed().count() > 0;
        if is_driven {
            self.add_prescribed_inertia(rates);
        }
        self.bodies.gather(increments);
        self.exchanged.total += self.exchange_in_step(increments, residual);
        if is_driven {
            let prescribed = self.exchange_of_drives(rates, residual);
            self.exchanged.total += prescribed;
        }
        self.sliders.evaluate_end(&self.bodies, increments, constraints);
        let is_backward = self.step.interval.duration() < 0.0;
        let taken = if is_backward { self.elements.dissipated() } else { 0.0 };
        self.elements.advance(&self.bodies, self.step.rotations);
        if is_backward {
            self.step.returned = taken - self.elements.dissipated();
        }
        self.bodies.advance(self.step.rotations);
        let arms = ArmRule { rotations: self.step.rotations, fraction: 0.5 };
        self.links.advance(&self.bodies, arms, increments);
        self.sliders.advance(constraints, self.step.interval);
        self.motion.advance(&self.step, increments, rates);
        self.links.write_forces(&mut self.motion.rates);
    }

    fn checkpoint(&mut self) -> &mut dyn Checkpoint {
        self
    }

    fn accelerated(&mut self) -> &mut dyn Accelerated {
        self
    }
}
