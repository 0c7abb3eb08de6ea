//! All elements of a model, and the sums of their forces, work and energies in a step.

use super::element::BuiltElement;
use super::point_mass::NodalMass;
use super::{ExternalForce, InternalForce, TrialState, Weight, WorkAndImpulse};
use crate::beams::{ForceSummary, Movement, RotationIncrement, SpanStiffness};
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::{Body, Momenta};

#[derive(Default)]
pub struct Elements {
    masses: Vec<NodalMass>,
    weight: Option<Weight>,
    forces: Vec<Box<dyn ExternalForce>>,
    resistances: Vec<Box<dyn InternalForce>>,
    largest_mismatch: (f64, usize),
}

impl Elements {
    pub fn new(parts: impl Iterator<Item = BuiltElement>, mut weight: Option<Weight>) -> Self {
        let (mut masses, mut forces, mut resistances) = (Vec::new(), Vec::new(), Vec::new());
        for part in parts {
            match part {
                BuiltElement::PointMass(mass) => masses.push(mass),
                BuiltElement::Force(force) => forces.push(force),
                BuiltElement::Resistance(resistance) => resistances.push(resistance),
            }
        }
        weight.iter_mut().for_each(|weight| masses.iter().for_each(|mass| weight.add(mass)));
        Self { masses, weight, forces, resistances, largest_mismatch: (0.0, 0) }
    }

    pub fn mass(&self) -> f64 {
        self.masses.iter().map(|mass| mass.mass).sum()
    }

    pub fn weight(&self) -> Option<&dyn ExternalForce> {
        self.weight.as_ref().map(|weight| weight as &dyn ExternalForce)
    }

    pub fn forces(&self) -> impl Iterator<Item = &dyn ExternalForce> + Clone {
        self.forces.iter().map(|force| &**force)
    }

    pub fn external_force(&self, at: usize) -> &dyn ExternalForce {
        &*self.forces[at]
    }

    pub fn internal_force(&self, at: usize) -> &dyn InternalForce {
        &*self.resistances[at]
    }

    pub fn resistances(&self) -> impl Iterator<Item = &dyn InternalForce> + Clone {
        self.resistances.iter().map(|resistance| &**resistance)
    }

    fn springs_mut(&mut self) -> impl Iterator<Item = &mut Box<dyn InternalForce>> {
        self.resistances.iter_mut().filter(|resistance| resistance.stretched().is_some())
    }

    pub fn release(&mut self, spring: usize) {
        self.springs_mut().nth(spring).into_iter().for_each(|spring| spring.release());
    }

    pub fn detach_only(&mut self, is_released: impl Fn(usize) -> bool) {
        for (at, spring) in self.springs_mut().enumerate() {
            if is_released(at) { spring.detach() } else { spring.attach() }
        }
    }

    /// Prepares all elements for the start of a simulation.
    /// `inertia` is the diagonal of the inertia matrix, from which the elements compute effective masses at points.
    pub fn begin(&mut self, bodies: &[Body], inertia: &[f64]) {
        self.resistances.iter_mut().for_each(|one| one.begin(bodies, inertia));
    }

    /// Prepares all elements for a step that starts with the given rates of the unknowns.
    ///
    /// # Errors
    /// Returns the name of the first element whose schedule has no valid value, and the error of the schedule.
    pub fn begin_step(
        &mut self,
        (interval, stages): (Interval, &[Stage]),
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), (String, LoadError)> {
        for resistance in &mut self.resistances {
            let prepared = resistance.begin_step(interval, bodies, rates);
            prepared.map_err(|error| (resistance.name().to_owned(), error))?;
        }
        self.forces.iter_mut().try_for_each(|force| {
            force.begin_step(interval, stages).map_err(|error| (force.name().to_owned(), error))
        })
    }

    /// Sets the longest interval in which a load schedule is sampled with one set of points [time]. In longer steps, several intervals are sampled.
    pub fn sample_in_parts(&mut self, longest: f64) {
        self.forces.iter_mut().for_each(|force| force.sample_in_parts(longest));
    }

    /// Evaluates all loads just after a time. If a load jumps at this time, the value after the jump is used.
    ///
    /// # Errors
    /// Returns the name of the first element whose schedule has no valid value, and the error of the schedule.
    pub fn evaluate_after(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.forces.iter_mut().try_for_each(|force| {
            force.evaluate_after(time).map_err(|error| (force.name().to_owned(), error))
        })
    }

    /// Sets prescribed rest lengths and rest angles of springs to their values at a time.
    ///
    /// # Errors
    /// Returns the name of the first spring whose function has no finite value, and the error of the function.
    pub fn set_rest_lengths_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.resistances.iter_mut().try_for_each(|spring| {
            spring.set_rest_at(time).map_err(|error| (spring.name().to_owned(), error))
        })
    }

    pub fn may_jump_at(&self, time: f64) -> bool {
        let by_forces = self.forces.iter().any(|force| force.may_jump_at(time));
        by_forces || self.resistances.iter().any(|resistance| resistance.may_jump_at(time))
    }

    pub fn tracked_sections(&self) -> usize {
        self.forces.iter().map(|force| force.tracked_sections()).sum()
    }

    pub fn add_inertia(&self, bodies: &[Body], factor: f64, rates: &[f64], out: &mut [f64]) {
        self.masses.iter().for_each(|mass| mass.add_inertia(bodies, factor, rates, out));
    }

    pub fn inertia_entries(
        &self,
        bodies: &[Body],
        factor: f64,
        unknowns: usize,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        let masses = self.masses.iter();
        masses.for_each(|mass| mass.inertia_entries(bodies, factor, unknowns, add));
    }

    pub fn add_momenta(&self, bodies: &[Body], rates: &[f64], sum: &mut Momenta) {
        self.masses.iter().for_each(|mass| *sum += mass.momenta(bodies, rates));
    }

    pub fn double_kinetic_energy(&self, bodies: &[Body], body: usize, rates: &[f64]) -> f64 {
        let on_body = self.masses.iter().filter(|mass| mass.place.body == body);
        on_body.map(|mass| mass.momenta(bodies, rates).twice_kinetic).sum()
    }

    /// Potential energy of the weight of a body, including its point masses [energy].
    pub fn potential_of(&self, bodies: &[Body], body: usize) -> f64 {
        self.weight.as_ref().map_or(0.0, |weight| weight.energy_of(bodies, body))
    }

    pub fn subtract_from(&mut self, at: TrialState<'_>, out: &mut [f64]) -> (f64, f64) {
        let weight = self.weight.iter_mut().map(|weight| weight as &mut dyn ExternalForce);
        let forces = self.forces.iter_mut().map(|force| &mut **force as &mut dyn ExternalForce);
        weight.chain(forces).fold((0.0, 0.0), |largest: (f64, f64), element| {
            let (force, moment) = element.subtract_from(at, out);
            (largest.0.max(force), largest.1.max(moment))
        })
    }

    /// Adds the tangent stiffness of all external forces to `tangent`.
    /// The tangent stiffness is the negative derivative of the forces with respect to the increments of the unknowns.
    pub fn add_tangent(&self, at: TrialState<'_>, unknowns: usize, tangent: &mut BandedMatrix) {
        self.forces.iter().for_each(|force| force.add_tangent(at, unknowns, tangent));
    }

    pub fn save_contacts(&self, contacts: &mut Vec<f64>) {
        self.resistances.iter().for_each(|resistance| resistance.save_contacts(contacts));
    }

    /// Restores the contacts between bodies from a saved state. Returns `None` if the saved contacts do not fit the elements.
    pub fn restore_contacts(&mut self, bodies: &[Body], contacts: &[f64]) -> Option<()> {
        let mut numbers = contacts.iter().copied();
        let next = &mut || numbers.next();
        let mut all = self.resistances.iter_mut();
        all.try_for_each(|resistance| resistance.restore_contacts(bodies, next))?;
        numbers.next().is_none().then_some(())
    }

    pub fn begin_movement(&mut self, bodies: &[Body]) {
        self.resistances.iter_mut().for_each(|resistance| resistance.begin_movement(bodies));
    }

    pub fn clear_rate_history(&mut self) {
        self.resistances.iter_mut().for_each(|resistance| resistance.clear_rate_history());
    }

    pub fn add_resistance(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        summary: &mut ForceSummary,
    ) {
        self.largest_mismatch = (0.0, 0);
        for (index, resistance) in self.resistances.iter_mut().enumerate() {
            let own = resistance.add_forces(at, out);
            if own.strain_mismatch.is_nan() || own.strain_mismatch > self.largest_mismatch.0 {
                self.largest_mismatch = (own.strain_mismatch, index);
            }
            summary.join(&own);
        }
    }

    pub fn farthest(&self) -> Option<(&str, f64)> {
        let (missing, index) = self.largest_mismatch;
        let resistance = self.resistances.get(index)?;
        (missing != 0.0).then(|| (resistance.name(), missing))
    }

    pub fn add_linearised_resistance(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        for resistance in &mut self.resistances {
            resistance.add_linearised_forces(at, out, unknowns, tangent);
        }
    }

    /// Adds `weight` times the corrections of the internal forces that would satisfy all force laws in the present iterate to `out`.
    pub fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]) {
        self.resistances.iter().for_each(|resistance| {
            resistance.add_mismatch_forces(bodies, weight, out);
        });
    }

    pub fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        self.resistances.iter_mut().for_each(|resistance| resistance.correct(bodies, correction));
    }

    pub fn stored(&self) -> f64 {
        self.resistances().map(InternalForce::stored).fold(0.0, |sum, stored| sum + stored)
    }

    pub fn dissipated(&self) -> f64 {
        self.resistances()
            .map(InternalForce::dissipated)
            .fold(0.0, |sum, dissipated| sum + dissipated)
    }

    pub fn add_resistance_at_start(
        &self,
        bodies: &[Body],
        rates: &[Vec<Movement>],
        out: &mut [f64],
    ) {
        self.resistances()
            .for_each(|resistance| resistance.add_forces_at_start(bodies, rates, out));
    }

    pub fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        self.resistances().for_each(|resistance| resistance.each_damped_rate(bodies, rates, take));
    }

    pub fn for_each_static_stiffness(
        &self,
        bodies: &[Body],
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        self.resistances().for_each(|resistance| resistance.static_stiffness(bodies, take));
    }

    pub fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for element in self.forces().chain(self.weight()) {
            sum += element.exchange(bodies, duration);
        }
        for resistance in self.resistances() {
            sum += resistance.exchange(bodies, duration);
        }
        sum
    }

    /// Potential energy of weight and external forces [energy].
    pub fn energy(&self, bodies: &[Body]) -> f64 {
        let stored = self.weight().into_iter().chain(self.forces());
        stored.filter_map(|element| element.energy(bodies)).reduce(|a, b| a + b).unwrap_or(0.0)
    }

    pub fn advance(&mut self, bodies: &[Body], rotations: RotationIncrement) {
        self.forces.iter_mut().for_each(|force| force.advance(bodies, rotations));
        self.resistances.iter_mut().for_each(|resistance| resistance.advance(bodies));
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        self.forces.iter().for_each(|force| force.save(state));
        self.resistances.iter().for_each(|resistance| resistance.save(state));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.forces.iter_mut().for_each(|force| force.restore(next));
        self.resistances.iter_mut().for_each(|resistance| resistance.restore(next));
    }
}
