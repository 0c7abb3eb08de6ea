//! Sliders of the model: where they are, and what they add to the equations of a step.

use super::{Connection, ImpactBar, KinkedAxis, MasterCurve, MasterEnd, SliderState, TrackPath};
use crate::geometry::{Basis, ContactPath, Vec2, larger};
use crate::integrators::{Interval, IntervalEnd};
use crate::joints::{
    CONTACT_UNKNOWNS, Contact, ContactUnknowns, EndAction, Frozen, HeldSlider, KinkState, Released,
    Slider, SlidingLaw, SlidingRule, Unit,
};
use crate::linalg::Border;
use crate::system::bodies::Body;

mod at_rest;
mod kinematics;
mod passing;
mod place;
mod saved;
mod seams;
mod stops;

pub use passing::{AtRest, InStep, Passing};

/// A slider of a model with its contact: where it is, and what acts there.
#[derive(Debug, Clone)]
pub struct SliderContact {
    pub name: String,
    pub connection: Connection,
    pub rule: SlidingRule,
    pub ends: EndAction,
    /// How much of its speed the slider keeps where it bounces [-].
    pub restitution: f64,
    pub state: SliderState,
    /// What the stop has stored on which the slider leans [energy].
    pub stored: f64,
    /// What was lost in blows against stops so far [energy].
    pub lost: f64,
    /// What the slider gave its master in the last impact [mass·length/time].
    pub impulse: Vec2,
    /// When the slider left a stop last; [`NEVER`] before it did [time].
    pub left_at: f64,
    /// Whether the stop may pull in the step to come: the slider has left it just now, and every step leads back.
    pub stop_may_pull: bool,
    /// Whether the stop would have had to pull in the last step that was tried.
    pub is_pulled: bool,
    /// The parameter `ξ` of the master at which the slider is [-].
    pub parameter: f64,
    /// The unknowns of the contact that the last step has found: force, couple and way.
    pub unknowns: ContactUnknowns,
    /// The most spans of its master that the slider passed in a step [-].
    pub most_spans: f64,
    /// How many times as long as a blow a step was, at the bounce of the slider where that is most [-].
    pub blows_in_a_step: f64,
    /// The master as drawn.
    rail: MasterCurve,
    /// The way from beam to beam, for a slider on a track.
    route: Option<Box<TrackPath>>,
    /// Master and slave as blows run through them; the slave may be no beam.
    bars: (ImpactBar, Option<ImpactBar>),
    /// The axis of the master as the contact force kinks it, where the rule knows of that.
    kinked_axis: Option<KinkedAxis>,
    /// The kink of that axis at the end of the step.
    kink_at_end: KinkState,
    /// The length of the master for a parameter of one [length].
    length: f64,
    /// Where it is at the start of the step.
    here: ContactPath,
    /// Its way in the iterate of the step.
    passage: ContactPath,
    /// Control points of the master in the window of the passage, counted from the slave.
    before: Vec<Vec2>,
    moved: Vec<Vec2>,
    units: [Unit; CONTACT_UNKNOWNS],
    /// The length of the master and the way of the slave in the iterate: what rounding of places is relative to [length].
    size: f64,
    /// How long the chord of the way is in the mean configuration of the iterate, relative to the master for that way.
    chord: f64,
    /// How much the stop pushes in the iterate, where the slider leans on it, times the tangent [force·length].
    push: f64,
    /// How much a seam on which the slider leans pushes it away from the beam on the other side, likewise.
    push_beyond: f64,
    /// Whether it is that other beam along which the slider is drawn off.
    pub leaves_beyond: bool,
    /// The contact force in the iterate [force].
    pressing: f64,
}

/// The time at which a slider that has left no stop yet left one: later than any, and finite, as it is saved [time].
pub(super) const NEVER: f64 = f64::MAX;

/// A stop that pulls by less than this part of its contact force does not pull.
const PULL: f64 = 1e-9;

/// Whether a stop would have to pull under a contact force [force], by what it pushes times the tangent [force·length] of a master of such a length for a
/// parameter of one [length].
pub(super) fn would_pull(push: f64, force: f64, length: f64) -> bool {
    push < -PULL * force * length
}

impl SliderContact {
    /// A slider at a parameter of the mesh of its master.
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
            stored: 0.0,
            lost: 0.0,
            impulse: Vec2::zeros(),
            left_at: NEVER,
            stop_may_pull: false,
            is_pulled: false,
            parameter,
            unknowns: ContactUnknowns::zeros(),
            most_spans: 0.0,
            blows_in_a_step: 0.0,
            length: rail.length() / (last - first),
            size: rail.length(),
            rail,
            route: None,
            bars,
            kinked_axis,
            kink_at_end: KinkState::default(),
            here: passage.clone(),
            passage,
            before: Vec::with_capacity(functions),
            moved: Vec::with_capacity(functions),
            units: [Unit::Force; CONTACT_UNKNOWNS],
            chord: 1.0,
            push: 0.0,
            push_beyond: 0.0,
            leaves_beyond: false,
            pressing: 0.0,
        };
        new.stand_at(parameter);
        new
    }

    /// The most entries that the equations of the contact have.
    pub fn row_entries(&self) -> usize {
        CONTACT_UNKNOWNS * 2 * (1 + self.most_of_masters(Basis::functions))
    }

    /// The most entries that they have in a step in which the slider passes no more than two spans of its master.
    pub fn usual_entries(&self) -> usize {
        let usual = |basis: &Basis| (basis.degree() + 3).min(basis.functions());
        CONTACT_UNKNOWNS * 2 * (1 + self.most_of_masters(usual))
    }

    /// Puts the slider at a parameter of its master.
    fn stand_at(&mut self, parameter: f64) {
        self.parameter = parameter;
        self.here.go(parameter, parameter);
        self.kinked_axis.iter_mut().for_each(|axis| axis.arrive(&self.here));
    }

    fn law(&self) -> &'static dyn SlidingLaw {
        match self.state {
            SliderState::Sliding if self.is_frozen() => &Frozen,
            SliderState::Sliding => self.rule.law(),
            SliderState::Held(_) => &HeldSlider,
            SliderState::Released => &Released,
        }
    }

    pub fn is_sliding(&self) -> bool {
        self.state == SliderState::Sliding
    }

    /// Lets the slider leave its master.
    pub fn release(&mut self) {
        self.state = SliderState::Released;
        self.lost += std::mem::take(&mut self.stored);
        self.unknowns = ContactUnknowns::zeros();
        // At an end of the master there is no kink, and no energy in it.
        self.kinked_axis.iter_mut().for_each(KinkedAxis::straighten);
    }

    /// The contact force on the master: where the axis is kinked by it, at present, else the mean of the last step [force].
    pub fn contact_force(&self) -> Vec2 {
        let axis = self.kinked_axis.as_ref().filter(|_| !self.is_frozen());
        axis.map_or(self.unknowns.force, KinkedAxis::force)
    }

    /// Whether the kink of the master stays as it is while the slider slides, whatever the contact force.
    pub fn is_frozen(&self) -> bool {
        self.is_sliding() && self.kinked_axis.as_ref().is_some_and(KinkedAxis::is_frozen)
    }

    /// The speed along the master up to which its kink follows the contact force, where there is one [length/time].
    pub fn fastest_on_kink(&self) -> Option<f64> {
        self.kinked_axis.as_ref().map(KinkedAxis::fastest)
    }

    /// Keeps the kink of the master as it is in steps to come; gives whether that is another law for the next step.
    pub fn keep_kink(&mut self) -> bool {
        let sliding = self.is_sliding();
        self.kinked_axis.as_mut().is_some_and(|axis| axis.keep() && sliding)
    }

    /// Lets the kink of the master follow the contact force again.
    pub fn let_kink_follow(&mut self) {
        self.kinked_axis.iter_mut().for_each(KinkedAxis::follow);
    }

    /// Whether the contact force follows from how far the axis of the master is kinked, so that the contact transmits no impulse.
    pub fn gives_way(&self) -> bool {
        self.kinked_axis.as_ref().is_some_and(KinkedAxis::gives)
    }

    /// The energy of the kink under the contact force, and of the stop on which the slider leans [energy].
    pub fn strain_energy(&self) -> f64 {
        self.kinked_axis.as_ref().map_or(0.0, KinkedAxis::energy) + self.stored
    }

    /// The energy with which the kink under the contact force moves along the master [energy].
    pub fn kinetic_energy(&self) -> f64 {
        self.kinked_axis.as_ref().map_or(0.0, KinkedAxis::kinetic_energy)
    }

    fn read(&self, unknowns: &[f64]) -> ContactUnknowns {
        let mut own = [0.0; CONTACT_UNKNOWNS];
        own.copy_from_slice(&unknowns[self.connection.places()]);
        ContactUnknowns::of(own)
    }

    /// Begins a step.
    pub fn begin_step(&mut self, bodies: &[Body], rates: &[f64], interval: Interval) {
        if self.kinked_axis.is_some() {
            let rate = self.rate(bodies, rates);
            self.kinked_axis.iter_mut().for_each(|axis| axis.begin_step(interval.duration(), rate));
        }
    }

    /// Guesses the unknowns of the contact for a step: the slider slides on as it does, and its force stays.
    pub fn predict(
        &self,
        bodies: &[Body],
        rates: &[f64],
        interval: Interval,
        unknowns: &mut [f64],
    ) {
        let (start, end) = self.rail.domain();
        let ahead = self.parameter + interval.duration() * self.rate(bodies, rates);
        let way = ahead.clamp(start, end) - self.parameter;
        let force = if self.gives_way() { self.contact_force() } else { self.unknowns.force };
        let guess = ContactUnknowns { force, way, ..self.unknowns };
        unknowns[self.connection.places()].copy_from_slice(&guess.to_array());
    }

    /// The contact in the iterate of a step.
    fn take(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) -> Contact<'_> {
        let unknowns = self.read(unknowns);
        self.passage.go(self.parameter, self.parameter + unknowns.way);
        self.contact(bodies, increments, unknowns)
    }

    /// The contact in an iterate of the way of the passage.
    fn contact(
        &mut self,
        bodies: &[Body],
        increments: &[f64],
        unknowns: ContactUnknowns,
    ) -> Contact<'_> {
        let Connection { master, slave: (body, point), .. } = self.connection;
        let (slave, master) = (&bodies[body], &bodies[master]);
        let (origin, cut_off) = slave.precise_point(point);
        let window = self.passage.first()..self.passage.first() + self.passage.end().len();
        self.before.clear();
        let positions = &master.dynamics.control_points()[window.clone()];
        let precise = positions.iter().zip(&master.dynamics.remainders()[window.clone()]);
        self.before.extend(
            precise.map(|(position, remainder)| (position - origin) + (remainder - cut_off)),
        );
        self.moved.clear();
        self.moved.extend(window.map(|at| master.vector_at(at, increments)));
        let slave_moved = slave.vector_at(point, increments);
        let Self { passage, before, moved, length, kinked_axis, .. } = self;
        let kink = kinked_axis.as_ref().map(|axis| axis.along(passage));
        Contact { passage, master: (before, moved), slave_moved, unknowns, kink, length: *length }
    }

    /// Adds the forces on slave and master to a residual, and behind so many unknown movements the equations of the contact; gives the contact force [force].
    pub fn add<P: Passing>(
        &mut self,
        bodies: &[Body],
        movements: usize,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
    ) -> f64 {
        let (connection, state) = (self.connection, self.state);
        let leans_on_nothing = self.leans_on_nothing(bodies);
        let (contact, equations) = P::iterate_values(self, bodies, increments, unknowns);
        let values = equations.map(|(value, _)| value);
        connection.add_values(bodies, &contact, P::forces(&contact), values, movements, out);
        let (pressing, chord) = (contact.unknowns.force, P::chord(&contact));
        let force = pressing.norm();
        let push = match state {
            // What pulls without end lets go at once.
            SliderState::Held(_) if leans_on_nothing => f64::NEG_INFINITY,
            SliderState::Held(end) => contact.push(end.outward()),
            SliderState::Sliding | SliderState::Released => 0.0,
        };
        (self.size, self.chord) = (contact.length + contact.slave_moved.norm(), chord);
        self.units = equations.map(|(_, unit)| unit);
        (self.push, self.pressing) = (push, force);
        self.push_beyond = self.push_beyond_seam(bodies, increments, pressing);
        force
    }

    /// Adds forces and equations of the contact to a residual, and their derivatives by movements and contact unknowns to the tangent.
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
    }

    /// The largest violations of the contact's equations: of lengths relative to the lengths met [-], and of forces [force].
    pub fn violation(&self, equations: &[f64]) -> (f64, f64) {
        let values = equations[self.connection.places()].iter().zip(self.units);
        values.fold((0.0, 0.0), |(length, force), (value, unit)| match unit {
            Unit::Length => (larger(length, value.abs() / self.size), force),
            Unit::Force => (length, larger(force, value.abs())),
        })
    }

    /// The length of the chord of the slider's way in the mean configuration, relative to the length of the master for that way [-].
    pub fn chord(&self) -> f64 {
        if self.is_sliding() { self.chord } else { 1.0 }
    }

    /// How far beyond an end of the master the unknowns of the contact lead, relative to the master's parameters [-].
    pub fn beyond(&self, unknowns: &[f64], end: MasterEnd) -> f64 {
        self.rail.beyond(self.parameter + self.read(unknowns).way, end)
    }

    /// Looks at the contact at the end of a step that is accepted; the bodies are at its start still.
    pub fn close(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) {
        if self.kinked_axis.is_none() {
            return;
        }
        let law = self.law();
        self.kink_at_end = law.kink_at_end(&self.take(bodies, increments, unknowns));
    }

    /// Lets the slider accept a step; the bodies are at its end already.
    pub fn advance(&mut self, unknowns: &[f64], ending: IntervalEnd) {
        self.unknowns = self.read(unknowns);
        let before = self.parameter;
        let passed = self.passage.spans_between(before, before + self.unknowns.way);
        self.most_spans = self.most_spans.max(passed);
        let is_frozen = self.is_frozen();
        self.stand_at(before + self.unknowns.way);
        let (mean, kink) = (self.unknowns.force, self.kink_at_end);
        self.kinked_axis.iter_mut().for_each(|axis| match is_frozen {
            true => axis.turn(kink),
            false => axis.advance(mean, kink),
        });
        if ending == IntervalEnd::OfStep {
            self.stop_may_pull = false;
        }
    }
}
