//! Contact forces of an obstacle in a step.
//!
//! `docs/theory.md`, section 9.7, derives the forces.
//! The tension of each contact point is an independent unknown.
//! Each iteration determines the force and the gap of a contact point from two equations: the contact law,
//! and the linear relation between force and gap that follows from the inertia of the body at this point.

use super::definition::ObstacleShape;
use super::point::{ClosedContact, ContactPoint, Surface};
use crate::beams::{ForceSummary, Movement, SpanStiffness};
use crate::geometry::{Vec2, larger, perpendicular};
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;
use crate::system::elements::contact::{ContactState, ContactTime, Penetration};
use crate::system::elements::contact_watch::{ContactWatch, ShortBounce};
use crate::system::elements::internal_force::InternalForce;
use crate::system::elements::rate_history::RateHistory;
use crate::system::elements::{TrialState, WorkAndImpulse};

pub(super) struct TouchingBody {
    body: usize,
    points: Vec<ContactPoint>,
    /// True if all contact points lie in the convex hull of the control points of the body, as on B-splines.
    is_convex: bool,
    /// True if the convex hull of the control points does not touch the obstacle at the start of the step.
    is_far: bool,
    /// True if the contact points are updated in this step. False if no contact is possible: the points then have no forces.
    /// A body becomes active if the convex hull of its control points touches the obstacle at the start of the step or in an iterate.
    /// A body with contact points outside this hull is always active.
    is_active: bool,
    watch: ContactWatch,
    /// Mean rate of the gap at the contact point with the largest force in the last step [length/time].
    last_rate: f64,
}

impl TouchingBody {
    pub(super) fn new(points: Vec<ContactPoint>) -> Self {
        let is_positive = |point: &ContactPoint| point.place.shape().iter().all(|n| *n >= 0.0);
        let is_convex = points.iter().all(is_positive);
        let body = points[0].place.body;
        let watch = ContactWatch::default();
        Self { body, points, is_convex, is_far: false, is_active: true, watch, last_rate: 0.0 }
    }

    fn is_separated(
        &self,
        surface: &Surface,
        position: impl Fn(usize) -> Vec2,
        count: usize,
    ) -> bool {
        let middle = (position(0) + position(count - 1)) * 0.5;
        self.is_convex && surface.is_beyond(middle, (0..count).map(position))
    }

    fn crosses(&self, surface: &Surface, body: &Body, increments: &[f64]) -> bool {
        if matches!(surface.shape, ObstacleShape::HalfPlane { .. }) {
            return false;
        }
        let controls = body.dynamics.control_points();
        let middle = (controls[0] + controls[controls.len() - 1]) * 0.5;
        let control_points = controls.iter().enumerate();
        let ends = control_points.map(|(at, start)| start + body.vector_at(at, increments));
        let is_clear = self.is_far && surface.is_beyond(middle, ends);
        let movement = |point: &ContactPoint| point.vector(body, increments);
        !is_clear && self.points.iter().any(|point| point.crosses(surface, body, movement(point)))
    }

    fn begin(&mut self, surface: &Surface, body: &Body, rates: Option<&[f64]>) {
        let controls = body.dynamics.control_points();
        let is_closed = self.points.iter().any(ContactPoint::is_closed);
        self.is_far = !is_closed && self.is_separated(surface, |at| controls[at], controls.len());
        // A point that has left the obstacle dissipates the energy of its friction in the next step.
        let has_energy = |point: &ContactPoint| point.energy(surface) > 0.0;
        match self.is_far && !(self.is_active && self.points.iter().any(has_energy)) {
            true => self.deactivate(),
            false => self.activate(surface, body, rates),
        }
    }

    /// Prepares the contact points for a step or a static increment from their present positions.
    /// `rates` are the rates at the start of a step; `None` for a static increment.
    fn activate(&mut self, surface: &Surface, body: &Body, rates: Option<&[f64]>) {
        self.is_active = true;
        for point in &mut self.points {
            let was_closed = point.is_closed();
            point.begin_movement(surface, body);
            if let Some(rates) = rates {
                point.begin_step();
                if !was_closed {
                    point.set_approach(surface, point.vector(body, rates));
                }
            }
        }
    }

    fn active_points(&self) -> &[ContactPoint] {
        if self.is_active { &self.points } else { &[] }
    }

    fn active_points_mut(&mut self) -> &mut [ContactPoint] {
        if self.is_active { &mut self.points } else { &mut [] }
    }

    fn deactivate(&mut self) {
        self.active_points_mut().iter_mut().for_each(ContactPoint::open);
        self.is_active = false;
    }

    /// Prepares the points for an iterate. Returns false if no point can touch the obstacle.
    fn follow(
        &mut self,
        surface: &Surface,
        (body, increments): (&Body, &[f64]),
        rates: Option<&[f64]>,
    ) -> bool {
        let controls = body.dynamics.control_points();
        let position = |at: usize| controls[at] + body.vector_at(at, increments);
        let is_separated = self.is_far && self.is_separated(surface, position, controls.len());
        match (is_separated, self.is_active) {
            (true, true) => self.points.iter_mut().for_each(ContactPoint::open),
            (false, false) => self.activate(surface, body, rates),
            _ => {}
        }
        !is_separated
    }
}

pub(super) struct ObstacleForces {
    name: String,
    surface: Surface,
    bodies: Vec<TouchingBody>,
    rate_history: RateHistory,
    /// Rates of all unknowns at the start of the step; empty in a static increment.
    rates: Vec<f64>,
    stage: (Stage, f64),
    last_force: Vec2,
    dissipated: f64,
}

fn step_rates(rates: &[f64]) -> Option<&[f64]> {
    (!rates.is_empty()).then_some(rates)
}

impl ObstacleForces {
    pub(super) fn new(name: String, surface: Surface, bodies: Vec<TouchingBody>) -> Self {
        Self {
            name,
            surface,
            bodies,
            rate_history: RateHistory::default(),
            rates: Vec::new(),
            stage: (Stage::Midpoint, 1.0),
            last_force: Vec2::zeros(),
            dissipated: 0.0,
        }
    }

    fn points(&self) -> impl Iterator<Item = &ContactPoint> {
        self.bodies.iter().flat_map(|body| &body.points)
    }

    fn active_points(&self) -> impl Iterator<Item = &ContactPoint> {
        self.bodies.iter().flat_map(TouchingBody::active_points)
    }

    fn begin_increment(&mut self, bodies: &[Body]) {
        let rates = step_rates(&self.rates);
        for own in &mut self.bodies {
            own.begin(&self.surface, &bodies[own.body], rates);
        }
    }

    fn points_mut(&mut self) -> impl Iterator<Item = &mut ContactPoint> {
        self.bodies.iter_mut().flat_map(|body| &mut body.points)
    }

    fn closed<'s>(
        &'s self,
        bodies: &'s [Body],
    ) -> impl Iterator<Item = (&'s ContactPoint, ClosedContact)> {
        self.points().filter_map(|point| {
            Some((point, point.closed(&self.surface, &bodies[point.place.body])?))
        })
    }
}

impl InternalForce for ObstacleForces {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin(&mut self, bodies: &[Body], inertia: &[f64]) {
        let surface = self.surface;
        for point in self.points_mut() {
            point.begin(&surface, &bodies[point.place.body], inertia);
        }
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.rate_history.begin(interval.duration());
        self.rates.clear();
        self.rates.extend_from_slice(rates);
        self.begin_increment(bodies);
        Ok(())
    }

    fn begin_movement(&mut self, bodies: &[Body]) {
        self.rate_history.begin(f64::INFINITY);
        self.rates.clear();
        self.begin_increment(bodies);
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let time = ContactTime::new(&self.rate_history, (at.stage, at.weight));
        self.stage = (at.stage, at.weight);
        let mut summary = ForceSummary::default();
        let rates = step_rates(&self.rates);
        for own in &mut self.bodies {
            let body = &at.bodies[own.body];
            if !own.follow(&self.surface, (body, at.increments), rates) {
                continue;
            }
            for point in &mut own.points {
                summary.join(&point.add_force(&self.surface, time, (body, at.increments), out));
            }
        }
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let time = ContactTime::new(&self.rate_history, (at.stage, at.weight));
        let rates = step_rates(&self.rates);
        for own in &mut self.bodies {
            let body = &at.bodies[own.body];
            if !own.follow(&self.surface, (body, at.increments), rates) {
                continue;
            }
            for point in &mut own.points {
                let on = (body, at.increments);
                point.add_linearised(&self.surface, time, on, out, &mut |row, column, by| {
                    if row < unknowns && column < unknowns {
                        tangent.add(row, column, by);
                    }
                });
            }
        }
    }

    fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]) {
        self.active_points()
            .for_each(|point| point.add_mismatch_force(&bodies[point.place.body], weight, out));
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        for own in &mut self.bodies {
            let body = &bodies[own.body];
            own.active_points_mut().iter_mut().for_each(|point| point.correct(body, correction));
        }
    }

    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for point in self.active_points() {
            let angular_impulse = point.angular_impulse(&bodies[point.place.body], duration);
            sum += WorkAndImpulse::of(0.0, point.mean_force() * duration, angular_impulse);
        }
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        let time = ContactTime::new(&self.rate_history, self.stage);
        self.last_force = Vec2::zeros();
        for own in &mut self.bodies {
            let was_open = !own.points.iter().any(ContactPoint::is_closed);
            let (mut force, mut rate) = (0.0, 0.0);
            let body = &bodies[own.body];
            for point in own.active_points_mut() {
                self.last_force += point.mean_force();
                self.dissipated += point.advance(&self.surface, time, body);
                if point.force() >= force {
                    (force, rate) = (point.force(), point.rate());
                }
            }
            let is_open = !own.points.iter().any(ContactPoint::is_closed);
            if time.duration.is_finite() {
                own.watch.add([was_open, is_open], [own.last_rate, rate], (force, time.duration));
                own.last_rate = rate;
            }
        }
        self.rate_history.end();
    }

    fn stored(&self) -> f64 {
        self.active_points().map(|point| point.energy(&self.surface)).sum()
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn contact(&self) -> Option<ContactState> {
        let closed = self.active_points().filter(|point| point.is_closed()).count();
        let friction = self.active_points().map(ContactPoint::friction_force).sum();
        Some(ContactState { force: self.last_force, friction, closed })
    }

    fn smallest_gap(&self, bodies: &[Body]) -> Option<f64> {
        let gap =
            |point: &ContactPoint| point.present_gap(&self.surface, &bodies[point.place.body]);
        Some(self.points().map(gap).fold(f64::INFINITY, f64::min))
    }

    fn penetrations(&self, bodies: &[Body]) -> Vec<Penetration> {
        let all = self.bodies.iter().map(|own| {
            let body = &bodies[own.body];
            let (mut depth, mut energy, mut force) = (0.0, 0.0, Vec2::zeros());
            for point in &own.points {
                if let Some(contact) = point.closed(&self.surface, body) {
                    depth = larger(depth, -point.present_gap(&self.surface, body));
                    energy += point.energy(&self.surface);
                    force += contact.gradient * contact.tension.force;
                }
            }
            Penetration { body: own.body, depth, force: force.norm(), energy }
        });
        all.filter(|one| one.depth > 0.0).collect()
    }

    fn crosses(&self, bodies: &[Body], increments: &[f64]) -> bool {
        let crosses =
            |own: &TouchingBody| own.crosses(&self.surface, &bodies[own.body], increments);
        self.bodies.iter().any(crosses)
    }

    fn short_bounce(&self) -> Option<ShortBounce> {
        let bounces = self.bodies.iter().filter_map(|own| own.watch.short_bounce());
        bounces.max_by(|a, b| a.force.total_cmp(&b.force))
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        for (point, contact) in self.closed(bodies) {
            let body = point.place.body;
            point.add_force_at_start(&contact, &bodies[body], &rates[body], out);
        }
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        if self.surface.law.damping > 0.0 {
            for (point, contact) in self.closed(bodies) {
                let velocity = point.vector(&bodies[point.place.body], rates);
                take(contact.damping, contact.gradient.dot(&velocity));
            }
        }
    }

    fn static_stiffness(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        for (point, contact) in self.closed(bodies) {
            let body = &bodies[point.place.body];
            let (mut degrees, mut normal, mut across) = (Vec::new(), Vec::new(), Vec::new());
            let tangent = perpendicular(contact.gradient);
            for (at, share) in point.place.weights() {
                for component in 0..2 {
                    degrees.push(body.degrees_of_freedom[at][component]);
                    normal.push(share * contact.gradient[component]);
                    across.push(share * tangent[component]);
                }
            }
            let mut rows = SpanStiffness::default();
            rows.strains.extend(normal);
            rows.stiffness.push(contact.tension.stiffness);
            if contact.radius_of_curvature.is_finite() {
                let factor = 0.5 * contact.tension.force / contact.radius_of_curvature;
                rows.twists.extend(across.iter().map(|by| factor * by));
                rows.twists.extend(across);
                rows.rounding_fractions.push(0.0);
            }
            take(&degrees, &rows);
        }
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.rate_history.save(state);
        for own in &self.bodies {
            own.points.iter().for_each(|point| point.save(state));
            own.watch.save(state);
            state.push(own.last_rate);
        }
        state.extend([self.last_force.x, self.last_force.y, self.dissipated]);
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rate_history.restore(next);
        for own in &mut self.bodies {
            own.points.iter_mut().for_each(|point| point.restore(next));
            own.watch.restore(next);
            own.last_rate = next();
            own.is_active = true;
        }
        self.last_force = Vec2::new(next(), next());
        self.dissipated = next();
    }

    fn explain(&self) -> String {
        let points = crate::system::errors::plural(self.points().count(), "contact point");
        let shape = match self.surface.shape {
            ObstacleShape::HalfPlane { .. } => "half-plane",
            ObstacleShape::Disc { .. } => "disc",
        };
        let damped = if self.surface.law.damping > 0.0 { ", damped" } else { "" };
        let friction = if self.surface.friction > 0.0 { ", with friction" } else { "" };
        format!(
            "{shape} with {points}{damped}{friction}; the contact forces are additional unknowns"
        )
    }
}
