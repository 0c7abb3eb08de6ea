//! Sliders of a model: their positions, and their contributions to the equations of a step.

use super::{
    Connection, ImpactBar, KinkedAxis, MasterCurve, MasterEnd, Sleeve, SliderState, TrackPath,
};
use crate::beams::RotationIncrement;
use crate::geometry::{Basis, ContactPath, Vec2, larger};
use crate::integrators::{Interval, IntervalEnd};
use crate::joints::{
    CONTACT_UNKNOWNS, Contact, ContactUnknowns, EndAction, Frozen, HeldSlider, KinkState,
    MovingSleeve, Released, Slider, SlidingLaw, SlidingRule, Unit, Wrench,
};
use crate::linalg::Border;
use crate::system::bodies::Body;
use crate::system::step_mean::StepMean;

mod at_rest;
mod friction;
mod kinematics;
mod passing;
mod place;
mod saved;
mod seams;
mod sleeve;
mod static_friction;
mod stops;
mod unilateral;

pub use friction::{FrictionTransition, SliderFriction};
pub use passing::{AtRest, InStep, Passing};
pub use unilateral::{ContactChange, UnilateralContact};

#[derive(Debug, Clone)]
pub struct SliderContact {
    pub name: String,
    pub connection: Connection,
    pub rule: SlidingRule,
    pub ends: EndAction,
    /// Coefficient of restitution [-].
    pub restitution: f64,
    pub state: SliderState,
    /// Energy stored in the stop that holds the slider [energy].
    pub stop_energy: f64,
    /// Energy lost by the slider in impacts at stops and landings, by friction, and by a release from a stop so far [energy].
    pub lost_energy: f64,
    /// Impulse on the master in the last impact [mass·length/time].
    pub impulse: Vec2,
    /// Time at which the slider last left a stop [time]; [`NEVER`] if it has not left any stop.
    pub stop_left_at: f64,
    pub stop_may_pull: bool,
    /// True if the stop force was tensile in the last attempted step.
    pub is_pulled: bool,
    /// Parameter of the master at the slider [-].
    pub parameter: f64,
    pub unknowns: ContactUnknowns,
    /// Mean contact force and couple on the master in the last step [force, force·length].
    mean_force: StepMean<Wrench>,
    /// Largest number of spans of the master that the slider has passed in one step [-].
    pub most_spans: f64,
    /// Largest ratio of step length to impact duration at an elastic impact of the slider on a stop [-].
    pub impacts_per_step: f64,
    /// Friction along the master; `None` without friction.
    pub friction: Option<Box<SliderFriction>>,
    /// State of a unilateral contact; `None` for a slider that never leaves its master.
    pub unilateral: Option<Box<UnilateralContact>>,
    /// State of a sleeve, which restrains the direction of the slave; `None` for other sliders.
    sleeve: Option<Box<Sleeve>>,
    master: MasterCurve,
    /// Path of the slider along its track; `None` for a slider on a single beam.
    track: Option<Box<TrackPath>>,
    /// Properties of master and slave that determine the duration of impacts; the second entry is `None` if the slave is not a beam.
    bars: (ImpactBar, Option<ImpactBar>),
    kinked_axis: Option<KinkedAxis>,
    kink_at_end: KinkState,
    /// Length of the master per unit of its parameter [length].
    length: f64,
    start_path: ContactPath,
    path: ContactPath,
    before: Vec<Vec2>,
    before_first: usize,
    movements: Vec<Vec2>,
    units: [Unit; CONTACT_UNKNOWNS],
    size: f64,
    chord: f64,
    push: f64,
    push_beyond: f64,
    /// True if the contact force pulls a slider that is held at a seam onto the beam beyond the seam.
    pub crosses_seam: bool,
    /// Magnitude of the contact force for the last trial values of the unknowns [force].
    contact_force: f64,
}

/// Placeholder time for a slider that has not left a stop [time]. It is finite, because states are saved to files.
pub(super) const NEVER: f64 = f64::MAX;

/// Largest tensile stop force that counts as zero, as a fraction of the contact force.
const PULL: f64 = 1e-9;

pub(super) fn is_tensile(push: f64, force: f64, length: f64) -> bool {
    push < -PULL * force * length
}

impl SliderContact {
    pub fn new(
        slider: &Slider,
        connection: Connection,
        passage: ContactPath,
        parameter: f64,
        rail: MasterCurve,
        bars: (ImpactBar, Option<ImpactBar>),
        kinked_axis: Option<KinkedAxis>,
    ) -> Self {
        let (first, last) = rail.domain();
        let functions = passage.basis().functions();
        let mut new = Self {
            name: slider.name.clone(),
            connection,
            rule: slider.rule,
            ends: slider.ends,
            restitution: slider.restitution,
            state: SliderState::Sliding,
            stop_energy: 0.0,
            lost_energy: 0.0,
            impulse: Vec2::zeros(),
            stop_left_at: NEVER,
            stop_may_pull: false,
            is_pulled: false,
            parameter,
            unknowns: ContactUnknowns::zeros(),
            mean_force: StepMean::default(),
            most_spans: 0.0,
            impacts_per_step: 0.0,
            length: rail.length() / (last - first),
            size: rail.length(),
            friction: slider.has_friction().then(|| Box::new(SliderFriction::of(slider))),
            unilateral: slider.side().map(|side| Box::new(UnilateralContact::new(side.sign()))),
            sleeve: None,
            master: rail,
            track: None,
            bars,
            kinked_axis,
            kink_at_end: KinkState::default(),
            start_path: passage.clone(),
            path: passage,
            before: Vec::with_capacity(functions),
            before_first: 0,
            movements: Vec::with_capacity(functions),
            units: [Unit::Force; CONTACT_UNKNOWNS],
            chord: 1.0,
            push: 0.0,
            push_beyond: 0.0,
            crosses_seam: false,
            contact_force: 0.0,
        };
        new.set_parameter(parameter);
        new
    }

    pub fn row_entries(&self) -> usize {
        CONTACT_UNKNOWNS * self.components() * (1 + self.most_of_masters(Basis::functions))
    }

    pub fn usual_entries(&self) -> usize {
        let usual = |basis: &Basis| (basis.degree() + 3).min(basis.functions());
        CONTACT_UNKNOWNS * self.components() * (1 + self.most_of_masters(usual))
    }

    /// Number of components of a control point that the contact couples: two displacements, and the rotation for a sleeve.
    pub(super) fn components(&self) -> usize {
        if self.sleeve.is_some() { 3 } else { 2 }
    }

    fn set_parameter(&mut self, parameter: f64) {
        self.parameter = parameter;
        self.before.clear();
        self.start_path.set_interval(parameter, parameter);
        self.kinked_axis.iter_mut().for_each(|axis| axis.accept_end(&self.start_path));
    }

    fn law(&self) -> &'static dyn SlidingLaw {
        match (self.state, &self.sleeve) {
            (SliderState::Released | SliderState::Separated, _) => &Released,
            (SliderState::Sliding, Some(_)) => &MovingSleeve::Sliding,
            (SliderState::Held(_), Some(_)) => &MovingSleeve::Held,
            (SliderState::Sliding, None) if self.is_frozen() => &Frozen,
            (SliderState::Sliding, None) => self.rule.law(),
            (SliderState::Held(_), None) => &HeldSlider,
        }
    }

    pub fn exchange_kinked_axis(&mut self, axis: Option<KinkedAxis>) -> Option<KinkedAxis> {
        std::mem::replace(&mut self.kinked_axis, axis)
    }

    /// Returns true if the slider may lose energy at the ends of its master, by friction, or when it lands on its master.
    pub fn dissipates(&self) -> bool {
        self.restitution < 1.0 || self.friction.is_some() || self.unilateral.is_some()
    }

    pub fn is_sliding(&self) -> bool {
        self.state == SliderState::Sliding
    }

    pub fn release(&mut self) {
        self.state = SliderState::Released;
        self.lost_energy += std::mem::take(&mut self.stop_energy);
        self.unknowns = ContactUnknowns::zeros();
        self.mean_force = StepMean::default();
        self.kinked_axis.iter_mut().for_each(KinkedAxis::straighten);
    }

    /// Mean contact force on the master in the last step [force].
    pub fn contact_force(&self) -> Vec2 {
        self.mean_force.value.force
    }

    /// Mean couple of a sleeve on its master in the last step [force·length]; zero for other sliders.
    pub fn mean_couple(&self) -> f64 {
        self.mean_force.value.couple
    }

    /// Sets the mean contact force and couple before the first step [force, force·length].
    pub fn start_mean_force(&mut self, force: Wrench) {
        self.mean_force = StepMean::at_start(force);
    }

    pub fn end_step(&mut self) {
        self.mean_force.end_step();
    }

    /// Contact force on the master at the present time [force], determined from the kink of the master.
    /// Returns the contact force of the last step if there is no kink, or if the kink is kept constant.
    pub fn force_of_state(&self) -> Vec2 {
        let axis = self.kinked_axis.as_ref().filter(|_| !self.is_frozen());
        axis.map_or(self.unknowns.force, KinkedAxis::force)
    }

    pub fn is_frozen(&self) -> bool {
        self.is_sliding() && self.kinked_axis.as_ref().is_some_and(KinkedAxis::is_frozen)
    }

    /// Largest speed along the master at which the kink varies with the contact force [length/time]; `None` without a kink.
    pub fn kink_speed_limit(&self) -> Option<f64> {
        self.kinked_axis.as_ref().map(KinkedAxis::fastest)
    }

    pub fn freeze(&mut self) -> bool {
        let sliding = self.is_sliding();
        let kink = self.kinked_axis.as_mut().is_some_and(|axis| axis.freeze() && sliding);
        let friction = self.friction.as_mut().is_some_and(|friction| friction.freeze() && sliding);
        kink | friction
    }

    pub fn unfreeze(&mut self) {
        self.kinked_axis.iter_mut().for_each(KinkedAxis::unfreeze);
        self.friction.iter_mut().for_each(|friction| friction.unfreeze());
    }

    /// Returns true if the kink of the master determines the contact force. Such a contact transmits no impulse.
    pub fn is_compliant(&self) -> bool {
        self.kinked_axis.as_ref().is_some_and(KinkedAxis::is_compliant)
    }

    /// Strain energy of the kink, plus the energy of the stop that holds the slider [energy].
    pub fn strain_energy(&self) -> f64 {
        self.kinked_axis.as_ref().map_or(0.0, KinkedAxis::energy) + self.stop_energy
    }

    /// Kinetic energy of the moving kink [energy].
    pub fn kinetic_energy(&self) -> f64 {
        self.kinked_axis.as_ref().map_or(0.0, KinkedAxis::kinetic_energy)
    }

    fn read(&self, unknowns: &[f64]) -> ContactUnknowns {
        let mut own = [0.0; CONTACT_UNKNOWNS];
        own.copy_from_slice(&unknowns[self.connection.places()]);
        ContactUnknowns::of(own)
    }

    pub fn begin_step(
        &mut self,
        bodies: &[Body],
        rates: &[f64],
        (interval, rotations): (Interval, RotationIncrement),
    ) {
        self.before.clear();
        self.sleeve.iter_mut().for_each(|sleeve| sleeve.begin_step(rotations));
        if self.kinked_axis.is_some() {
            let rate = self.rate(bodies, rates);
            self.kinked_axis.iter_mut().for_each(|axis| axis.begin_step(interval.duration(), rate));
        }
        self.begin_friction(bodies, rates, interval);
    }

    pub fn predict(
        &self,
        bodies: &[Body],
        rates: &[f64],
        interval: Interval,
        unknowns: &mut [f64],
    ) {
        let (start, end) = self.master.domain();
        let ahead = self.parameter + interval.duration() * self.rate(bodies, rates);
        let way = ahead.clamp(start, end) - self.parameter;
        let force = if self.is_compliant() { self.force_of_state() } else { self.unknowns.force };
        let guess = ContactUnknowns { force, increment: way, ..self.unknowns };
        unknowns[self.connection.places()].copy_from_slice(&guess.to_array());
    }

    fn evaluate(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) -> Contact<'_> {
        let unknowns = self.read(unknowns);
        self.path.set_interval(self.parameter, self.parameter + unknowns.increment);
        let sleeve = self.sleeve_rotations(bodies, increments);
        Contact { sleeve, ..self.contact(bodies, increments, unknowns) }
    }

    fn contact(
        &mut self,
        bodies: &[Body],
        increments: &[f64],
        unknowns: ContactUnknowns,
    ) -> Contact<'_> {
        let Connection { master, slave: (body, point), .. } = self.connection;
        let (slave, master) = (&bodies[body], &bodies[master]);
        let window = self.path.first()..self.path.first() + self.path.end().len();
        if (self.before_first, self.before.len()) != (window.start, window.len()) {
            let (origin, cut_off) = slave.precise_point(point);
            let positions = &master.dynamics.control_points()[window.clone()];
            let precise = positions.iter().zip(&master.dynamics.remainders()[window.clone()]);
            self.before.clear();
            self.before.extend(
                precise.map(|(position, remainder)| (position - origin) + (remainder - cut_off)),
            );
            self.before_first = window.start;
        }
        self.movements.clear();
        self.movements.extend(window.clone().map(|at| master.vector_at(at, increments)));
        let slave_moved = slave.vector_at(point, increments);
        let is_sliding = self.is_sliding();
        let Self { path: passage, before, movements: moved, length, kinked_axis, friction, .. } =
            self;
        let friction = friction.as_deref().filter(|_| is_sliding);
        let kink = kinked_axis.as_ref().map(|axis| axis.along(passage));
        Contact {
            path: passage,
            master: (before, moved),
            slave_movement: slave_moved,
            unknowns,
            kink,
            friction: friction.and_then(|friction| friction.in_step(window)),
            sleeve: None,
            length: *length,
        }
    }

    pub fn add<P: Passing>(
        &mut self,
        bodies: &[Body],
        movements: usize,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
    ) -> f64 {
        let (connection, state) = (self.connection, self.state);
        let leans_on_nothing = self.is_held_at_open_end(bodies);
        let (contact, equations) = P::iterate_values(self, bodies, increments, unknowns);
        let values = equations.map(|(value, _)| value);
        connection.add_values(bodies, &contact, P::forces(&contact), values, movements, out);
        let couple = contact.unknowns.couple;
        let (pressing, chord) = (contact.unknowns.force, P::chord(&contact));
        let friction = contact.friction.as_ref().map(|friction| contact.friction_forces(friction));
        let force = pressing.norm();
        let push = match state {
            SliderState::Held(_) if leans_on_nothing => f64::NEG_INFINITY,
            SliderState::Held(end) => contact.outward_push(end.outward()),
            SliderState::Sliding | SliderState::Separated | SliderState::Released => 0.0,
        };
        (self.size, self.chord) = (contact.length + contact.slave_movement.norm(), chord);
        self.units = equations.map(|(_, unit)| unit);
        (self.push, self.contact_force) = (push, force);
        self.add_moments(bodies, couple, out);
        self.record_friction(friction);
        self.push_beyond = self.seam_push(bodies, increments, pressing);
        self.follow_master(bodies, increments);
        force
    }

    /// Adds the forces and equations of the contact to a residual, and their derivatives to the tangent.
    pub fn add_linearised<P: Passing>(
        &mut self,
        bodies: &[Body],
        movements: usize,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        let connection = self.connection;
        let (contact, equations) = P::iterate(self, bodies, increments, unknowns);
        let values = equations.map(|equation| equation.value);
        connection.add_values(bodies, &contact, P::forces(&contact), values, movements, out);
        let slopes = P::slopes(&contact);
        connection.add_derivatives(bodies, &contact, slopes, &equations, movements, border);
        let couple = contact.unknowns.couple;
        if self.couples_rotations() {
            self.add_moments(bodies, couple, out);
            let slopes = P::rotation_slopes(self, bodies, increments, unknowns);
            self.add_rotations(bodies, slopes, (couple.x * P::MOMENT_SLOPE, movements), border);
        }
    }

    pub fn violation(&self, equations: &[f64]) -> (f64, f64) {
        let values = equations[self.connection.places()].iter().zip(self.units);
        values.fold((0.0, 0.0), |(length, force), (value, unit)| match unit {
            Unit::Length => (larger(length, value.abs() / self.size), force),
            Unit::Force => (length, larger(force, value.abs())),
        })
    }

    pub fn chord(&self) -> f64 {
        if self.is_sliding() { self.chord } else { 1.0 }
    }

    pub fn overshoot(&self, unknowns: &[f64], end: MasterEnd) -> f64 {
        self.master.overshoot(self.parameter + self.read(unknowns).increment, end)
    }

    pub fn evaluate_end(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) {
        if self.active_friction().is_some() {
            let contact = self.evaluate(bodies, increments, unknowns);
            let increment = contact.unknowns.increment;
            let forces = contact.friction.as_ref().map(|of| contact.friction_forces(of));
            self.record_friction(forces);
            self.dissipate(increment);
        }
        self.follow_master(bodies, increments);
        self.rotate_sleeve(bodies, increments);
        if self.kinked_axis.is_none() {
            return;
        }
        let law = self.law();
        self.kink_at_end = law.kink_at_end(&self.evaluate(bodies, increments, unknowns));
    }

    pub fn advance(&mut self, unknowns: &[f64], interval: Interval) {
        self.unknowns = self.read(unknowns);
        let wrench = Wrench { force: self.unknowns.force, couple: self.couple() };
        self.mean_force.add(wrench, interval.duration());
        let before = self.parameter;
        let passed = self.path.spans_between(before, before + self.unknowns.increment);
        self.most_spans = self.most_spans.max(passed);
        let is_frozen = self.is_frozen();
        self.set_parameter(before + self.unknowns.increment);
        let (mean, kink) = (self.unknowns.force, self.kink_at_end);
        self.kinked_axis.iter_mut().for_each(|axis| match is_frozen {
            true => axis.accept_frozen_jump(kink),
            false => axis.advance(mean, kink),
        });
        self.accept_flight();
        self.count_friction_step();
        if interval.ending() == IntervalEnd::Step {
            self.stop_may_pull = false;
        }
    }
}
