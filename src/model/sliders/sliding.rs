//! Sliders of the model: where they are, and what they add to the equations of a step.

use serde::{Deserialize, Serialize};

use crate::geometry::{Passage, Vec2, larger};
use crate::integrators::{Ending, Interval};
use crate::joints::{
    CONTACT_UNKNOWNS, Contact, ContactUnknowns, EndAction, Held, Released, Slider, SlidingLaw,
    SlidingRule, Unit,
};
use crate::linalg::Border;
use crate::model::bodies::Body;
use crate::model::sliders::Connection;

/// How far a slider may end beside the end of its master and still be there, relative to the master's parameters.
pub(in crate::model) const LANDED: f64 = 4e-15;

/// An end of the master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackEnd {
    /// Where its parameter starts.
    Start,
    /// Where its parameter ends.
    End,
}

impl TrackEnd {
    /// A word for messages and scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::End => "end",
        }
    }

    /// The sign of `dξ/dt` with which it is reached.
    pub(in crate::model) fn outward(self) -> f64 {
        match self {
            Self::Start => -1.0,
            Self::End => 1.0,
        }
    }
}

/// What a slider does at present.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SliderState {
    /// It slides.
    Sliding,
    /// It rests against the stop at an end.
    Held(TrackEnd),
    /// It has left its master.
    Released,
}

impl SliderState {
    /// A word for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sliding => "sliding",
            Self::Held(_) => "held",
            Self::Released => "released",
        }
    }
}

/// A slider with its contact.
#[derive(Debug, Clone)]
pub(in crate::model) struct Sliding {
    pub(in crate::model) name: String,
    pub(in crate::model) connection: Connection,
    pub(in crate::model) rule: SlidingRule,
    pub(in crate::model) ends: EndAction,
    pub(in crate::model) state: SliderState,
    /// Where on the master it is: `ξ`.
    pub(in crate::model) parameter: f64,
    /// Of the last step.
    pub(in crate::model) unknowns: ContactUnknowns,
    /// The most spans that it passed in a step.
    pub(in crate::model) most_spans: f64,
    /// How many times as long as a blow a step was, at the bounce where that is most.
    pub(in crate::model) blows_in_a_step: f64,
    domain: (f64, f64),
    /// The length of the master for a parameter of one [length].
    length: f64,
    /// Where it is at the start of the step.
    here: Passage,
    /// Its way in the iterate of the step.
    passage: Passage,
    /// Control points of the master in the window of the passage, counted from the slave.
    before: Vec<Vec2>,
    moved: Vec<Vec2>,
    units: [Unit; CONTACT_UNKNOWNS],
    /// The length of the master and the way of the slave in the iterate: what rounding of places is relative to [length].
    size: f64,
    /// How long the chord of the way is in the mean configuration of the iterate, relative to the master for that way.
    chord: f64,
}

impl Sliding {
    pub(in crate::model) fn new(
        slider: &Slider,
        connection: Connection,
        passage: Passage,
        parameter: f64,
        length: f64,
    ) -> Self {
        let domain = passage.basis().domain();
        let functions = passage.basis().functions();
        let mut new = Self {
            name: slider.name.clone(),
            connection,
            rule: slider.rule,
            ends: slider.ends,
            state: SliderState::Sliding,
            parameter,
            unknowns: ContactUnknowns::zeros(),
            most_spans: 0.0,
            blows_in_a_step: 0.0,
            domain,
            length: length / (domain.1 - domain.0),
            here: passage.clone(),
            passage,
            before: Vec::with_capacity(functions),
            moved: Vec::with_capacity(functions),
            units: [Unit::Force; CONTACT_UNKNOWNS],
            size: length,
            chord: 1.0,
        };
        new.here.go(parameter, parameter);
        new
    }

    /// The most entries that its equations have.
    pub(in crate::model) fn row_entries(&self) -> usize {
        CONTACT_UNKNOWNS * 2 * (1 + self.passage.basis().functions())
    }

    fn law(&self) -> &'static dyn SlidingLaw {
        match self.state {
            SliderState::Sliding => self.rule.law(),
            SliderState::Held(_) => &Held,
            SliderState::Released => &Released,
        }
    }

    pub(in crate::model) fn is_sliding(&self) -> bool {
        self.state == SliderState::Sliding
    }

    pub(in crate::model) fn domain(&self) -> (f64, f64) {
        self.domain
    }

    /// It leaves its master.
    pub(in crate::model) fn release(&mut self) {
        self.state = SliderState::Released;
        self.unknowns = ContactUnknowns::zeros();
    }

    /// How many numbers it saves.
    pub(in crate::model) const SAVED: usize = 4 + CONTACT_UNKNOWNS;

    pub(in crate::model) fn save(&self, state: &mut Vec<f64>) {
        let mark = match self.state {
            SliderState::Sliding => 0.0,
            SliderState::Held(TrackEnd::Start) => 1.0,
            SliderState::Held(TrackEnd::End) => 2.0,
            SliderState::Released => 3.0,
        };
        state.extend([mark, self.parameter, self.most_spans, self.blows_in_a_step]);
        state.extend(self.unknowns.to_array());
    }

    pub(in crate::model) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        let marks = [
            SliderState::Sliding,
            SliderState::Held(TrackEnd::Start),
            SliderState::Held(TrackEnd::End),
        ];
        self.state = marks.get(next() as usize).copied().unwrap_or(SliderState::Released);
        self.parameter = next();
        (self.most_spans, self.blows_in_a_step) = (next(), next());
        self.unknowns = ContactUnknowns::of(std::array::from_fn(|_| next()));
        self.here.go(self.parameter, self.parameter);
    }

    /// How far it is from an end of the master, as a part of the parameters of its master.
    pub(in crate::model) fn distance_to(&self, end: TrackEnd) -> f64 {
        let (first, last) = self.domain;
        (self.end_parameter(end) - self.parameter).abs() / (last - first)
    }

    /// Whether it is at an end of the master.
    pub(in crate::model) fn is_at(&self, end: TrackEnd) -> bool {
        self.distance_to(end) <= LANDED
    }

    pub(in crate::model) fn end_parameter(&self, end: TrackEnd) -> f64 {
        match end {
            TrackEnd::Start => self.domain.0,
            TrackEnd::End => self.domain.1,
        }
    }

    /// The control points of the master with their functions where the slider is.
    pub(in crate::model) fn weights(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.here.first()..).zip(self.here.end().iter().copied())
    }

    /// The derivative of the place on the master by the parameter, `Σ B_i'(ξ) x_i` [length].
    pub(in crate::model) fn tangent(&self, bodies: &[Body]) -> Vec2 {
        let points = &bodies[self.connection.master].dynamics.control_points()[self.here.first()..];
        // Slopes sum to zero: an origin amid the points changes nothing but the rounding.
        self.here
            .slope()
            .iter()
            .zip(points)
            .map(|(slope, point)| (point - points[0]) * *slope)
            .sum()
    }

    /// From the slave to its place on the master.
    pub(in crate::model) fn gap(&self, bodies: &[Body]) -> Vec2 {
        if self.state == SliderState::Released {
            return Vec2::zeros();
        }
        let (body, point) = self.connection.slave;
        let slave = bodies[body].dynamics.control_points()[point];
        let master = bodies[self.connection.master].dynamics.control_points();
        self.weights().map(|(index, weight)| (master[index] - slave) * weight).sum()
    }

    /// The velocity of the slave relative to its place on the master [length/time].
    pub(in crate::model) fn relative_velocity(&self, bodies: &[Body], rates: &[f64]) -> Vec2 {
        let Connection { master, slave: (body, point), .. } = self.connection;
        let on_master = |(index, weight)| bodies[master].vector_at(index, rates) * weight;
        bodies[body].vector_at(point, rates) - self.weights().map(on_master).sum::<Vec2>()
    }

    /// The velocity of the slave [length/time].
    pub(in crate::model) fn slave_velocity(&self, bodies: &[Body], rates: &[f64]) -> Vec2 {
        let (body, point) = self.connection.slave;
        bodies[body].vector_at(point, rates)
    }

    /// `dξ/dt` of the present velocities [1/time].
    pub(in crate::model) fn rate(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        match self.state {
            SliderState::Sliding => {
                let tangent = self.tangent(bodies);
                self.relative_velocity(bodies, rates).dot(&tangent) / tangent.norm_squared()
            }
            SliderState::Held(_) | SliderState::Released => 0.0,
        }
    }

    fn read(&self, unknowns: &[f64]) -> ContactUnknowns {
        let mut own = [0.0; CONTACT_UNKNOWNS];
        own.copy_from_slice(&unknowns[self.connection.places()]);
        ContactUnknowns::of(own)
    }

    /// Guesses that it slides on as it does, and that the contact force stays.
    pub(in crate::model) fn predict(
        &self,
        bodies: &[Body],
        rates: &[f64],
        interval: Interval,
        unknowns: &mut [f64],
    ) {
        let (start, end) = self.domain;
        let ahead = self.parameter + interval.duration() * self.rate(bodies, rates);
        let way = ahead.clamp(start, end) - self.parameter;
        let guess = ContactUnknowns { way, ..self.unknowns };
        unknowns[self.connection.places()].copy_from_slice(&guess.to_array());
    }

    /// The contact in the iterate of a step.
    fn take(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) -> Contact<'_> {
        let unknowns = self.read(unknowns);
        self.passage.go(self.parameter, self.parameter + unknowns.way);
        let Connection { master, slave: (body, point), .. } = self.connection;
        let (slave, master) = (&bodies[body], &bodies[master]);
        let (origin, cut_off) = slave.precise_point(point);
        let window = self.passage.first()..self.passage.first() + self.passage.end().len();
        self.before.clear();
        self.before.extend(window.clone().map(|at| {
            let (position, remainder) = master.precise_point(at);
            (position - origin) + (remainder - cut_off)
        }));
        self.moved.clear();
        self.moved.extend(window.map(|at| master.vector_at(at, increments)));
        let slave_moved = slave.vector_at(point, increments);
        let Self { passage, before, moved, length, .. } = self;
        Contact { passage, master: (before, moved), slave_moved, unknowns, length: *length }
    }

    /// Adds the forces on slave and master, and behind the movements the equations of the contact; returns the contact force.
    pub(in crate::model) fn add(
        &mut self,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
    ) -> f64 {
        let (law, connection) = (self.law(), self.connection);
        let contact = self.take(bodies, increments, unknowns);
        let equations = law.equations(&contact);
        connection.add_values(bodies, &contact, &equations, increments.len(), out);
        let force = contact.unknowns.force.norm();
        let chord = contact.tangent().value.norm() / contact.length;
        (self.size, self.chord) = (contact.length + contact.slave_moved.norm(), chord);
        self.units = equations.map(|equation| equation.unit);
        force
    }

    /// The same, with all derivatives.
    pub(in crate::model) fn add_linearised(
        &mut self,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        let (law, connection, movements) = (self.law(), self.connection, increments.len());
        let contact = self.take(bodies, increments, unknowns);
        let equations = law.equations(&contact);
        connection.add_values(bodies, &contact, &equations, movements, out);
        connection.add_derivatives(bodies, &contact, &equations, movements, border);
    }

    /// The largest violations: relative to the lengths met, and a force [force].
    pub(in crate::model) fn violation(&self, equations: &[f64]) -> (f64, f64) {
        let values = equations[self.connection.places()].iter().zip(self.units);
        values.fold((0.0, 0.0), |(length, force), (value, unit)| match unit {
            Unit::Length => (larger(length, value.abs() / self.size), force),
            Unit::Force => (length, larger(force, value.abs())),
        })
    }

    /// How long the chord of its way is in the mean configuration, relative to the length of the master for that way.
    pub(in crate::model) fn chord(&self) -> f64 {
        if self.is_sliding() { self.chord } else { 1.0 }
    }

    /// How far beyond an end of the master the unknowns lead, relative to its parameters.
    pub(in crate::model) fn beyond(&self, unknowns: &[f64], end: TrackEnd) -> f64 {
        let ahead = self.parameter + self.read(unknowns).way;
        let (first, last) = self.domain;
        let distance = match end {
            TrackEnd::Start => first - ahead,
            TrackEnd::End => ahead - last,
        };
        distance / (last - first)
    }

    /// Accepts a step; the bodies are at its end already.
    ///
    /// A stop that had to pull lets go, but not within a step.
    pub(in crate::model) fn advance(&mut self, bodies: &[Body], unknowns: &[f64], ending: Ending) {
        self.unknowns = self.read(unknowns);
        let before = self.parameter;
        self.parameter += self.unknowns.way;
        let passed = self.passage.spans_between(before, self.parameter);
        self.most_spans = self.most_spans.max(passed);
        self.here.go(self.parameter, self.parameter);
        if let (SliderState::Held(end), Ending::OfStep) = (self.state, ending) {
            let outward = self.unknowns.force.dot(&self.tangent(bodies)) * end.outward();
            if outward < 0.0 {
                self.state = SliderState::Sliding;
            }
        }
    }
}
