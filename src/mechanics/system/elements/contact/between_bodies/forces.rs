//! Contact forces between the bodies of an element in a step.
//!
//! A pair of a contact point and a body is created in the first iterate with contact, and removed at the end of a step in which the contact opens.
//! Every iterate looks for new pairs at its own positions. Bodies that pass through each other in a step are detected by `crosses`.

use super::pair::{ContactPair, LocalRows, PairIndex};
use super::shape::{Bounds, CrossingPath, Foot, NearestSearch, Shape};
use super::smallest_gap::GapSearch;
use crate::beams::{ForceSummary, Movement, SpanStiffness};
use crate::elementary::square;
use crate::geometry::{Vec2, larger};
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;
use crate::system::elements::contact::{ContactState, ContactTime, NormalLaw, Penetration};
use crate::system::elements::contact_watch::{ContactWatch, ShortBounce};
use crate::system::elements::internal_force::InternalForce;
use crate::system::elements::rate_history::RateHistory;
use crate::system::elements::{TrialState, WorkAndImpulse};

#[derive(Debug, Clone, Copy)]
pub(super) struct CandidatePair {
    pub(super) shape: usize,
    pub(super) target: usize,
    pub(super) law: NormalLaw,
    pub(super) friction: Option<FrictionOfPair>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct FrictionOfPair {
    pub(super) coefficient: f64,
    /// Fractions of the moment of friction that act on `shape` and on `target` [-]. The sum of the fractions is one.
    pub(super) shares: [f64; 2],
}

impl CandidatePair {
    pub(super) fn at(&self, site: usize) -> PairIndex {
        PairIndex { shape: self.shape, site, target: self.target }
    }
}

pub(super) struct PairForces {
    name: String,
    shapes: Vec<Shape>,
    candidates: Vec<CandidatePair>,
    pairs: Vec<ContactPair>,
    rate_history: RateHistory,
    stage: (Stage, f64),
    last_force: Vec2,
    dissipated: f64,
    /// Lower bound of the gap between any two bodies in the configuration `start` of the shapes [length].
    /// The bound of the gap is zero if the boxes around two bodies overlap.
    clearance: f64,
    is_current: bool,
    watch: ContactWatch,
    last_rate: f64,
    rows: LocalRows,
}

impl PairForces {
    pub(super) fn new(name: String, shapes: Vec<Shape>, candidates: Vec<CandidatePair>) -> Self {
        Self {
            name,
            shapes,
            candidates,
            pairs: Vec::new(),
            rate_history: RateHistory::default(),
            stage: (Stage::Midpoint, 1.0),
            last_force: Vec2::zeros(),
            dissipated: 0.0,
            clearance: 0.0,
            is_current: false,
            watch: ContactWatch::default(),
            last_rate: 0.0,
            rows: LocalRows::default(),
        }
    }

    fn set_configuration(&mut self, bodies: &[Body]) {
        for shape in &mut self.shapes {
            shape.begin(bodies[shape.body].dynamics.control_points());
        }
        self.is_current = true;
        self.update_clearance();
    }

    fn update_clearance(&mut self) {
        let distance = |&CandidatePair { shape, target, .. }: &CandidatePair| {
            let [own, other] = [&self.shapes[shape], &self.shapes[target]];
            let apart = own.start.bounds().squared_distance(&other.start.bounds()).sqrt();
            apart - (own.radius + other.radius)
        };
        let distances = self.candidates.iter().map(distance);
        self.clearance = distances.fold(f64::INFINITY, f64::min).max(0.0);
    }

    /// Returns true if no bodies can touch, because all control points are close to their positions in the configuration `start`.
    fn is_clear(&self, bodies: &[Body], movement: impl Fn(&Body, usize) -> Vec2) -> bool {
        let is_near_start = |shape: &Shape| {
            let body = &bodies[shape.body];
            let controls = body.dynamics.control_points().iter().zip(&shape.start.points);
            let apart =
                controls.enumerate().map(|(at, (now, start))| now + movement(body, at) - start);
            let farthest = apart.map(|by| by.norm_squared()).fold(0.0, larger);
            farthest * square(2.0 * shape.amplification()) < square(self.clearance)
        };
        self.clearance > 0.0 && self.pairs.is_empty() && self.shapes.iter().all(is_near_start)
    }

    fn is_clear_with(&self, bodies: &[Body], increments: &[f64]) -> bool {
        self.is_clear(bodies, |body, at| body.vector_at(at, increments))
    }

    fn begin_configuration(&mut self, bodies: &[Body]) {
        self.is_current = false;
        if self.is_clear_with(bodies, &[]) {
            return;
        }
        self.set_configuration(bodies);
        self.pairs.iter_mut().for_each(|pair| pair.begin_configuration(&self.shapes));
        self.find_pairs();
    }

    fn use_present_start(&mut self, bodies: &[Body]) {
        if !self.is_current {
            self.set_configuration(bodies);
        }
    }

    fn move_to(&mut self, bodies: &[Body], increments: &[f64]) {
        if self.is_clear_with(bodies, increments) {
            return;
        }
        self.use_present_start(bodies);
        for shape in &mut self.shapes {
            shape.move_by(bodies[shape.body].by_control_point(increments));
        }
        self.find_pairs();
    }

    fn find_pairs(&mut self) {
        self.prepare_pairs();
        for candidate in &self.candidates {
            let CandidatePair { shape, target, .. } = *candidate;
            let is_near = |shapes: &[Shape], bounds: fn(&Shape) -> Bounds| {
                let [own, other] = [&shapes[shape], &shapes[target]];
                let reach = own.radius + other.radius;
                bounds(own).squared_distance(&bounds(other)) < square(reach)
            };
            if !is_near(&self.shapes, Shape::swept_bounds) {
                continue;
            }
            self.shapes[target].prepare_search();
            if !is_near(&self.shapes, |shape| shape.end.bounds()) {
                continue;
            }
            for site in 0..self.shapes[shape].sites.len() {
                if let Some(foot) = self.touched_foot(candidate.at(site)) {
                    self.shapes[shape].sites[site].touched.push(target);
                    self.pairs.push(ContactPair::new(candidate, site, &self.shapes, foot));
                }
            }
        }
    }

    fn prepare_pairs(&mut self) {
        self.pairs.iter().for_each(|pair| self.shapes[pair.index.target].prepare_search());
    }

    /// Nearest point (foot of the perpendicular) on the axis of a body that a contact point touches in the present iterate.
    /// The result is `None` without contact, or if a pair of the contact point and this body already exists.
    fn touched_foot(&self, index: PairIndex) -> Option<Foot> {
        let PairIndex { shape, site, target } = index;
        let (own, other) = (&self.shapes[shape], &self.shapes[target]);
        if own.sites[site].touched.contains(&target) {
            return None;
        }
        let position = index.place(&self.shapes).interpolate(&own.end.points);
        let limit = index.reach(&self.shapes);
        if other.end.is_beyond(position, limit) {
            return None;
        }
        let search =
            NearestSearch { position, allowed: index.allowed(&self.shapes), limit, hint: 0 };
        other.nearest(&other.end, &search)
    }

    fn closed(&self) -> impl Iterator<Item = &ContactPair> {
        self.pairs.iter().filter(|pair| pair.normal.is_closed())
    }

    /// Removes the pairs that are open at the end of a step. The elastic energy of their friction counts as dissipated.
    fn remove_open_pairs(&mut self) {
        let open = self.pairs.iter().filter(|pair| !pair.normal.is_closed());
        self.dissipated += open.map(ContactPair::energy).fold(0.0, |sum, energy| sum + energy);
        self.pairs.retain(|pair| pair.normal.is_closed());
        for site in self.shapes.iter_mut().flat_map(|shape| &mut shape.sites) {
            site.touched.clear();
        }
        for PairIndex { shape, site, target } in self.pairs.iter().map(|pair| pair.index) {
            self.shapes[shape].sites[site].touched.push(target);
        }
    }
}

impl InternalForce for PairForces {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin(&mut self, bodies: &[Body], inertia: &[f64]) {
        for shape in &mut self.shapes {
            let degrees = bodies[shape.body].degrees_of_freedom.iter();
            let of = |degree: usize| inertia.get(degree).copied().unwrap_or(f64::INFINITY);
            shape.set_masses(degrees.map(|at| [of(at[0]), of(at[2])]));
        }
        self.begin_configuration(bodies);
        self.pairs.iter_mut().for_each(|pair| pair.measure_gap(&self.shapes));
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.rate_history.begin(interval.duration());
        self.begin_configuration(bodies);
        for shape in &mut self.shapes {
            shape.set_velocities(bodies[shape.body].by_control_point(rates));
        }
        self.pairs.iter_mut().for_each(|pair| pair.begin_step(&self.shapes));
        Ok(())
    }

    fn begin_movement(&mut self, bodies: &[Body]) {
        self.rate_history.begin(f64::INFINITY);
        self.shapes.iter_mut().for_each(|shape| shape.velocities.clear());
        self.begin_configuration(bodies);
        self.pairs.iter_mut().for_each(ContactPair::begin_movement);
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let time = ContactTime::new(&self.rate_history, (at.stage, at.weight));
        self.stage = (at.stage, at.weight);
        self.move_to(at.bodies, at.increments);
        let mut summary = ForceSummary::default();
        for pair in &mut self.pairs {
            summary.join(&pair.add_force(&self.shapes, time, at.bodies, out));
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
        self.move_to(at.bodies, at.increments);
        let Self { pairs, shapes, rows, .. } = self;
        for pair in pairs {
            let derivatives = pair.add_linearised(shapes, time, at.bodies, out);
            pair.collect(shapes, at.bodies, rows, unknowns);
            tangent.add_block(&rows.unknowns, rows.entries(&derivatives));
            if let Some(derivatives) = pair.add_linearised_friction(shapes, time, at.bodies, out) {
                tangent.add_block(&rows.unknowns, rows.entries(&derivatives));
            }
        }
    }

    fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]) {
        let pairs = self.pairs.iter();
        pairs.for_each(|pair| pair.add_mismatch_force(&self.shapes, bodies, weight, out));
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        let Self { pairs, shapes, .. } = self;
        pairs.iter_mut().for_each(|pair| pair.correct(shapes, bodies, correction));
    }

    fn exchange(&self, _bodies: &[Body], _duration: f64) -> WorkAndImpulse {
        WorkAndImpulse::default()
    }

    fn advance(&mut self, bodies: &[Body]) {
        let time = ContactTime::new(&self.rate_history, self.stage);
        let is_clear = self.is_clear(bodies, |body, at| {
            let [x, y, _] = body.moved()[at];
            Vec2::new(x, y)
        });
        if !is_clear {
            self.use_present_start(bodies);
            for shape in &mut self.shapes {
                shape.move_by(bodies[shape.body].moved().iter().copied());
            }
            self.prepare_pairs();
        }
        let was_open = !self.pairs.iter().any(|pair| pair.normal.is_closed());
        let (mut force, mut rate) = (0.0, 0.0);
        let (mut on_first, mut lost) = (Vec2::zeros(), 0.0);
        for pair in &mut self.pairs {
            lost += pair.advance(&self.shapes, time);
            let is_on_first = pair.index.shape == 0;
            let is_by_first = pair.index.target == 0;
            match (is_on_first, is_by_first) {
                (true, false) => on_first += pair.mean_force(),
                (false, true) => on_first -= pair.mean_force(),
                _ => {}
            }
            if pair.normal.last() >= force {
                (force, rate) = (pair.normal.last(), pair.normal.last_rate);
            }
        }
        self.dissipated += lost;
        self.last_force = on_first;
        let is_open = !self.pairs.iter().any(|pair| pair.normal.is_closed());
        if time.duration.is_finite() {
            self.watch.add([was_open, is_open], [self.last_rate, rate], (force, time.duration));
            self.last_rate = rate;
        }
        if !is_clear {
            self.shapes.iter_mut().for_each(Shape::end_step);
            self.update_clearance();
            self.pairs.iter_mut().for_each(|pair| pair.end_step(&self.shapes));
            self.remove_open_pairs();
        }
        self.is_current = false;
        self.rate_history.end();
    }

    fn stored(&self) -> f64 {
        self.pairs.iter().map(ContactPair::energy).fold(0.0, |sum, energy| sum + energy)
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn contact(&self) -> Option<ContactState> {
        let closed = self.closed().count();
        let is_on_first = |pair: &&ContactPair| (pair.index.shape == 0) != (pair.index.target == 0);
        let on_first = self.pairs.iter().filter(is_on_first);
        let friction = on_first.map(ContactPair::friction_force).fold(0.0, |sum, of| sum + of);
        Some(ContactState { force: self.last_force, friction, closed })
    }

    fn smallest_gap(&self, bodies: &[Body]) -> Option<f64> {
        let closed = self.closed().map(|pair| pair.normal.gap.value);
        Some(GapSearch::new(&self.shapes, bodies).smallest(&self.candidates, closed))
    }

    fn penetrations(&self, _bodies: &[Body]) -> Vec<Penetration> {
        let of_shape = |index: usize, shape: &Shape| {
            let (mut depth, mut energy, mut force) = (0.0, 0.0, Vec2::zeros());
            for pair in self.closed().filter(|pair| pair.index.shape == index) {
                depth = larger(depth, -pair.normal.gap.value);
                energy +=
                    if pair.has_direction(&self.shapes) { pair.energy() } else { f64::INFINITY };
                force += pair.elastic_force();
            }
            Penetration { body: shape.body, depth, force: force.norm(), energy }
        };
        let all = self.shapes.iter().enumerate().map(|(index, shape)| of_shape(index, shape));
        all.filter(|one| one.depth > 0.0).collect()
    }

    /// Returns false without a search if the configuration `start` was not updated in this step: no bodies are then near each other.
    fn crosses(&self, bodies: &[Body], increments: &[f64]) -> bool {
        if !self.is_current || self.is_clear_with(bodies, increments) {
            return false;
        }
        self.candidates.iter().any(|&CandidatePair { shape, target, .. }| {
            let (own, other) = (&self.shapes[shape], &self.shapes[target]);
            let radius = own.radius + other.radius;
            let reach = if other.is_disc() { radius } else { 0.0 };
            let apart = own.swept_bounds().squared_distance(&other.swept_bounds());
            let is_near = apart <= square(reach);
            is_near
                && (0..own.sites.len()).any(|site| {
                    let index = PairIndex { shape, site, target };
                    let place = index.place(&self.shapes);
                    let from = place.interpolate(&own.start.points);
                    let to = from + place.interpolate(&own.movements);
                    let allowed = index.allowed(&self.shapes);
                    other.is_crossed(&CrossingPath { from, to, allowed, radius })
                })
        })
    }

    fn short_bounce(&self) -> Option<ShortBounce> {
        self.watch.short_bounce()
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        let rate = |shape: usize, at: usize| rates[self.shapes[shape].body][at];
        let closed = self.closed();
        closed.for_each(|pair| pair.add_force_at_start(&self.shapes, rate, bodies, out));
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        for pair in self.closed().filter(|pair| pair.law.damping > 0.0) {
            let rate =
                |shape: usize, at: usize| bodies[self.shapes[shape].body].vector_at(at, rates);
            let (damping, rate) = pair.damped_rate(pair.relative(&self.shapes, rate));
            take(damping, rate);
        }
    }

    fn static_stiffness(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        let mut rows = LocalRows::default();
        for pair in self.closed() {
            let stiffness = pair.static_stiffness(&self.shapes, bodies, &mut rows);
            take(&rows.unknowns, &stiffness);
        }
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.rate_history.save(state);
        self.watch.save(state);
        let Self { last_rate, last_force, dissipated, .. } = self;
        state.extend([*last_rate, last_force.x, last_force.y, *dissipated]);
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rate_history.restore(next);
        self.watch.restore(next);
        self.last_rate = next();
        self.last_force = Vec2::new(next(), next());
        self.dissipated = next();
    }

    fn save_contacts(&self, contacts: &mut Vec<f64>) {
        contacts.push(self.pairs.len() as f64);
        self.pairs.iter().for_each(|pair| pair.save(contacts));
    }

    fn restore_contacts(
        &mut self,
        bodies: &[Body],
        next: &mut dyn FnMut() -> Option<f64>,
    ) -> Option<()> {
        self.pairs.clear();
        self.set_configuration(bodies);
        self.shapes.iter_mut().for_each(Shape::prepare_search);
        for _ in 0..next()? as usize {
            self.pairs.push(ContactPair::restored(&self.shapes, &self.candidates, next)?);
        }
        self.remove_open_pairs();
        Some(())
    }

    fn explain(&self) -> String {
        let bodies = match self.shapes.len() {
            1 => "a beam with itself".to_owned(),
            count => format!("{count} bodies"),
        };
        let points = crate::system::errors::plural(self.closed().count(), "point");
        let is_damped = |one: &CandidatePair| one.law.damping > 0.0;
        let damped = if self.candidates.iter().any(is_damped) { ", damped" } else { "" };
        let has_friction = self.candidates.iter().any(|one| one.friction.is_some());
        let friction = if has_friction { ", with friction" } else { "" };
        format!(
            "contact of {bodies}{damped}{friction}, at {points} at present; the contact forces are additional unknowns"
        )
    }
}
