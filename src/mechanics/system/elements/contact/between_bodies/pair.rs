//! Contact of a point of one body with the axis of another body, in a step.

use std::array::from_fn;

use super::forces::{CandidatePair, FrictionOfPair};
use super::gap::{GapMovement, GapStart, GapTrial, LOCAL};
use super::shape::{AllowedParts, Foot, NearestSearch, Shape, WHOLE_AXIS};
use super::slip::{Rotations, WITH_ROTATIONS, slip_trial};
use crate::beams::{BodyPoint, ForceSummary, Movement, SpanStiffness};
use crate::elementary::square;
use crate::geometry::{MAX_DEGREE, Vec2, larger};
use crate::integrators::Stage;
use crate::system::bodies::Body;
use crate::system::elements::collocation;
use crate::system::elements::contact::{
    ContactTime, GapChange, NormalContact, NormalForce, NormalLaw, PointFriction,
};
use crate::system::elements::coordinate::Coordinate;
use crate::system::elements::mixed_force::ForceTarget;

/// Smallest distance between a point and an axis at which the contact force has a direction, as a fraction of the sum of radii.
const SMALLEST_DISTANCE: f64 = 1e-12;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PairIndex {
    pub(super) shape: usize,
    pub(super) site: usize,
    pub(super) target: usize,
}

impl PairIndex {
    pub(super) fn place(self, shapes: &[Shape]) -> &BodyPoint {
        &shapes[self.shape].sites[self.site].place
    }

    pub(super) fn reach(self, shapes: &[Shape]) -> f64 {
        shapes[self.shape].radius + shapes[self.target].radius
    }

    fn rotations(
        self,
        shapes: &[Shape],
        foot: &Foot,
        rotation: impl Fn(usize, usize) -> f64,
    ) -> [f64; 2] {
        let of_point = self.place(shapes).weights();
        let of_foot = foot.weights(0);
        [
            of_point.map(|(at, share)| rotation(self.shape, at) * share).sum(),
            of_foot.map(|(at, share)| rotation(self.target, at) * share).sum(),
        ]
    }

    pub(super) fn allowed(self, shapes: &[Shape]) -> AllowedParts {
        let is_own_axis = self.shape == self.target;
        if is_own_axis { shapes[self.shape].sites[self.site].allowed } else { WHOLE_AXIS }
    }
}

#[derive(Debug, Clone, Default)]
pub(super) struct LocalRows {
    pub(super) unknowns: Vec<usize>,
    columns: Vec<[f64; WITH_ROTATIONS]>,
}

#[derive(Debug, Clone)]
struct PairFriction {
    /// Fractions of the moment of friction that act on the body of the point and on the other body [-].
    shares: [f64; 2],
    force: PointFriction<WITH_ROTATIONS>,
}

#[derive(Debug, Clone)]
pub(super) struct ContactPair {
    pub(super) index: PairIndex,
    pub(super) law: NormalLaw,
    pub(super) normal: NormalForce,
    start: GapStart,
    trial: GapTrial,
    foot: Foot,
    linearised: GapTrial,
    linearised_foot: Foot,
    /// Internal forces (minus the forces on the point) at the start of the step and in the present iterate [force].
    applied: [Vec2; 2],
    friction: Option<Box<PairFriction>>,
}

impl ContactPair {
    /// Creates a pair with the gap in the configuration at the start of the step.
    /// The gap of a new pair can be negative if the nearest point was not part of earlier searches.
    /// A negative gap of a new pair is replaced by zero, so that the energy does not jump.
    pub(super) fn new(
        candidate: &CandidatePair,
        site: usize,
        shapes: &[Shape],
        foot: Foot,
    ) -> Self {
        let CandidatePair { law, friction, .. } = *candidate;
        let index = candidate.at(site);
        let weight = shapes[index.shape].sites[index.site].weight;
        let start = GapStart { apart: Vec2::zeros(), foot };
        let mut pair = Self {
            index,
            law,
            normal: NormalForce::new(weight),
            start,
            trial: GapTrial::NONE,
            foot,
            linearised: GapTrial::NONE,
            linearised_foot: foot,
            applied: [Vec2::zeros(); 2],
            friction: friction.map(|FrictionOfPair { coefficient, shares }| {
                Box::new(PairFriction { shares, force: PointFriction::new(coefficient) })
            }),
        };
        let position = pair.place(shapes).interpolate(&shapes[index.shape].start.points);
        let target = &shapes[index.target];
        let at_start = target.nearest(&target.start, &pair.search(shapes, position));
        pair.use_foot(shapes, at_start.unwrap_or(foot));
        let rate = pair.normal_at_start().dot(&pair.relative_velocity(shapes));
        (pair.normal.approach, pair.normal.last_rate) = (rate.abs(), rate);
        pair.measure_gap(shapes);
        pair.normal.gap.value = pair.normal.gap.value.max(0.0);
        pair.update_masses(shapes);
        pair
    }

    fn place<'s>(&self, shapes: &'s [Shape]) -> &'s BodyPoint {
        self.index.place(shapes)
    }

    /// Sets the contact position on the axis to its value at the end of the last accepted step, so that the gap is continuous.
    pub(super) fn begin_configuration(&mut self, shapes: &[Shape]) {
        self.use_foot(shapes, self.start.foot);
    }

    pub(super) fn end_step(&mut self, shapes: &[Shape]) {
        self.use_foot(shapes, self.foot);
    }

    fn use_foot(&mut self, shapes: &[Shape], foot: Foot) {
        let [own, other] = [self.index.shape, self.index.target].map(|at| &shapes[at].start.points);
        let apart = self.place(shapes).interpolate(own) - foot.combine(0, other);
        self.start = GapStart { apart, foot };
        self.foot = foot;
    }

    pub(super) fn measure_gap(&mut self, shapes: &[Shape]) {
        self.normal.gap = Coordinate::from(self.start.apart.norm() - self.index.reach(shapes));
    }

    fn search(&self, shapes: &[Shape], position: Vec2) -> NearestSearch {
        let (allowed, hint) = (self.index.allowed(shapes), self.foot.span);
        NearestSearch { position, allowed, limit: f64::INFINITY, hint }
    }

    pub(super) fn begin_step(&mut self, shapes: &[Shape]) {
        self.normal.tension.begin_step();
        self.update_masses(shapes);
        self.applied = [Vec2::zeros(); 2];
        if let Some(friction) = &mut self.friction {
            friction.force.begin_step();
        }
    }

    pub(super) fn begin_movement(&mut self) {
        self.normal.tension.force = self.normal.tension.last;
        self.applied = [Vec2::zeros(); 2];
        if let Some(friction) = &mut self.friction {
            friction.force.release();
        }
    }

    /// Returns true if the distance at the start of the step exceeds its rounding error. Otherwise, the contact force has no direction.
    pub(super) fn has_direction(&self, shapes: &[Shape]) -> bool {
        self.start.apart.norm() > SMALLEST_DISTANCE * self.index.reach(shapes)
    }

    fn normal_at_start(&self) -> Vec2 {
        let length = self.start.apart.norm();
        if length > 0.0 { self.start.apart / length } else { Vec2::zeros() }
    }

    fn relative_velocity(&self, shapes: &[Shape]) -> Vec2 {
        self.relative(shapes, |shape, at| {
            shapes[shape].velocities.get(at).copied().unwrap_or_default()
        })
    }

    pub(super) fn relative(
        &self,
        shapes: &[Shape],
        velocity: impl Fn(usize, usize) -> Vec2,
    ) -> Vec2 {
        let [point, foot] = self.velocities(shapes, velocity);
        point - foot
    }

    fn velocities(&self, shapes: &[Shape], velocity: impl Fn(usize, usize) -> Vec2) -> [Vec2; 2] {
        let PairIndex { shape, target, .. } = self.index;
        let at_point = self.place(shapes).weights().map(|(at, share)| velocity(shape, at) * share);
        let at_foot = self.start.foot.weights(0).map(|(at, share)| velocity(target, at) * share);
        [at_point.sum(), at_foot.sum()]
    }

    /// Updates the effective masses `m` along the normal and along the axis: `1/m = 1/m_point + 1/m_foot`.
    /// Along the axis, the rotations of both bodies add a term to `1/m`.
    fn update_masses(&mut self, shapes: &[Shape]) {
        let (own, other) = (&shapes[self.index.shape], &shapes[self.index.target]);
        let point = own.mobility(self.place(shapes).weights());
        let mobility = point + other.mobility(self.start.foot.weights(0));
        self.normal.mass = 1.0 / mobility;
        let mass = 1.0 / (mobility + self.angular_mobility(shapes));
        let stiffness = self.normal.stiffness(&self.law);
        if let Some(friction) = &mut self.friction {
            friction.force.set_scales(stiffness, mass, self.law.damping);
        }
    }

    /// Contribution of the rotations of both bodies to the inverse of the effective mass along the axis [1/mass].
    fn angular_mobility(&self, shapes: &[Shape]) -> f64 {
        let Some(friction) = &self.friction else { return 0.0 };
        let (own, other) = (&shapes[self.index.shape], &shapes[self.index.target]);
        let [point, foot] = friction.shares.map(|share| square(share * self.start.apart.norm()));
        point * own.angular_mobility(self.place(shapes).weights())
            + foot * other.angular_mobility(self.start.foot.weights(0))
    }

    /// Normal force in the present iterate, with the friction that it limits; `None` without friction, or for a static increment.
    fn friction_at(&mut self, time: ContactTime) -> Option<(NormalContact, &mut PairFriction)> {
        let (force, duration) = (-self.normal.tension.force, time.duration);
        let contact = NormalContact { force, duration, share: time.share() };
        let friction = self.friction.as_mut().filter(|_| duration.is_finite())?;
        Some((contact, friction))
    }

    pub(super) fn evaluate(&mut self, shapes: &[Shape], stage: Stage) {
        let (own, other) = (&shapes[self.index.shape], &shapes[self.index.target]);
        if stage == Stage::Start {
            self.foot = self.start.foot;
        } else {
            let position = self.place(shapes).interpolate(&own.end.points);
            match other.nearest(&other.end, &self.search(shapes, position)) {
                Some(foot) => self.foot = foot,
                // Without a nearest point, the contact force keeps its position on the axis.
                None => self.foot.is_free = false,
            }
        }
        let (from, to) = (&self.start.foot, &self.foot);
        let moved = match stage {
            Stage::Start => [Vec2::zeros(); 3],
            _ => [
                self.place(shapes).interpolate(&own.movements),
                from.combine(0, &other.movements),
                to.combine(0, &other.movements),
            ],
        };
        let (slid, increment) = slide(from, to, &other.start.points);
        let tangents = [
            to.combine(1, &other.start.points),
            to.combine(1, &other.end.points),
            to.combine(2, &other.end.points),
        ];
        let movement = GapMovement { foot: *to, moved, slid, increment, tangents };
        self.trial = GapTrial::new(&self.start, &movement, collocation(stage).rotations);
        if let Some(friction) = &mut self.friction {
            let turned = match stage {
                Stage::Start => [0.0; 2],
                _ => self.index.rotations(shapes, from, |shape, at| shapes[shape].rotations[at]),
            };
            let rotations = Rotations { turned, shares: friction.shares };
            friction.force.evaluate(slip_trial(&self.trial, &movement, rotations));
        }
    }

    pub(super) fn add_force(
        &mut self,
        shapes: &[Shape],
        time: ContactTime,
        bodies: &[Body],
        out: &mut [f64],
    ) -> ForceSummary {
        self.evaluate(shapes, time.stage);
        let target = self.normal.target(&self.law, time, self.trial.change);
        let (force, strain_mismatch, at) = match time.stage {
            Stage::Start => (target.force, 0.0, 0),
            _ => {
                let mismatch = self.normal.compare(&self.law, target, self.trial.moved);
                (self.normal.tension.force, mismatch, 1)
            }
        };
        let applied = self.trial.secant.map(|by| by * (time.weight * force));
        self.applied[at] = applied[0];
        self.scatter(shapes, bodies, (&self.foot, applied), out);
        let mut summary =
            ForceSummary { force: force.abs(), strain_mismatch, ..ForceSummary::default() };
        if let Some((contact, friction)) =
            self.friction_at(time).filter(|_| time.stage != Stage::Start)
        {
            summary.strain_mismatch = larger(strain_mismatch, friction.force.compare(contact));
            let forces = friction.force.present().map(|by| by * time.weight);
            self.applied[at] += Vec2::new(forces[0], forces[1]);
            // The scale of the moments includes the normal force, because its rounding error causes an error of the moments.
            summary.moment =
                forces[LOCAL].abs() + forces[LOCAL + 1].abs() + self.trial.arm * force.abs();
            self.scatter_friction(shapes, bodies, (&self.foot, forces), out);
        }
        summary
    }

    pub(super) fn add_linearised(
        &mut self,
        shapes: &[Shape],
        time: ContactTime,
        bodies: &[Body],
        out: &mut [f64],
    ) -> [[f64; LOCAL]; LOCAL] {
        self.evaluate(shapes, time.stage);
        let target = self.normal.linearisation_target(&self.law, time, self.trial.change);
        self.normal.tension.linearise(target);
        (self.linearised, self.linearised_foot) = (self.trial, self.foot);
        let forces = self.trial.secant.map(|by| by * (time.weight * target.force));
        self.scatter(shapes, bodies, (&self.foot, forces), out);
        let (stiffness, force) =
            (time.weight * target.stiffness, time.weight * self.normal.tension.force);
        self.local_tangent(stiffness, force)
    }

    /// Adds the friction force to `out`, after elimination of the friction law.
    /// Returns the derivatives of the friction force with respect to the local coordinates; `None` without friction, or for a static increment.
    pub(super) fn add_linearised_friction(
        &mut self,
        shapes: &[Shape],
        time: ContactTime,
        bodies: &[Body],
        out: &mut [f64],
    ) -> Option<[[f64; WITH_ROTATIONS]; WITH_ROTATIONS]> {
        let tension = &self.normal.tension;
        let (mismatch, stiffness) = (-tension.mismatch, -tension.stiffness);
        let slope = self.linearised.slope;
        let (contact, friction) = self.friction_at(time)?;
        friction.force.linearise(contact);
        let forces = friction.force.condensed(mismatch).map(|by| by * time.weight);
        let normal_slope = from_fn(|at| slope.get(at).map_or(0.0, |by| by * stiffness));
        let derivatives = friction.force.tangent(normal_slope);
        self.scatter_friction(shapes, bodies, (&self.foot, forces), out);
        Some(derivatives.map(|row| row.map(|by| by * time.weight)))
    }

    fn local_tangent(&self, stiffness: f64, force: f64) -> [[f64; LOCAL]; LOCAL] {
        let GapTrial { slope, secant, secant_slope, foot_slope, .. } = &self.trial;
        from_fn(|row| {
            let (vector, component) = (row / 2, row % 2);
            match secant_slope.get(row) {
                Some(by) => {
                    let secant = stiffness * secant[vector][component];
                    from_fn(|column| secant * slope[column] + force * by[column])
                }
                // The foot `ξ₁` moves along the curve, which changes the weights of the control points.
                None => foot_slope.map(|by| force * secant[2][component] * by),
            }
        })
    }

    pub(super) fn collect(
        &self,
        shapes: &[Shape],
        bodies: &[Body],
        rows: &mut LocalRows,
        count: usize,
    ) {
        rows.unknowns.clear();
        rows.columns.clear();
        let mut add = |body: usize, at: usize, weights: [(usize, f64); 2]| {
            for axis in 0..2 {
                let unknown = bodies[body].degrees_of_freedom[at][axis];
                if unknown < count {
                    let column = rows.column_of(unknown);
                    weights.iter().for_each(|(vector, by)| column[2 * vector + axis] += by);
                }
            }
        };
        let (own, other) = (shapes[self.index.shape].body, shapes[self.index.target].body);
        for (at, weight) in self.place(shapes).weights() {
            add(own, at, [(0, weight), (0, 0.0)]);
        }
        for (at, weight) in self.start.foot.weights(0) {
            add(other, at, [(1, weight), (1, 0.0)]);
        }
        for ((at, weight), (_, slope)) in self.foot.weights(0).zip(self.foot.weights(1)) {
            add(other, at, [(2, weight), (3, slope)]);
        }
        if self.friction.is_some() {
            let of_point = self.place(shapes).weights().map(|at| (own, 0, at));
            let of_foot = self.start.foot.weights(0).map(|at| (other, 1, at));
            for (body, side, (at, weight)) in of_point.chain(of_foot) {
                let unknown = bodies[body].degrees_of_freedom[at][2];
                if unknown < count {
                    rows.column_of(unknown)[LOCAL + side] += weight;
                }
            }
        }
    }

    pub(super) fn add_mismatch_force(
        &self,
        shapes: &[Shape],
        bodies: &[Body],
        weight: f64,
        out: &mut [f64],
    ) {
        let forces = self.linearised.secant.map(|by| by * (weight * self.normal.tension.mismatch));
        self.scatter(shapes, bodies, (&self.linearised_foot, forces), out);
        if let Some(friction) = &self.friction {
            let missing = friction.force.missing(-self.normal.tension.mismatch);
            let forces = missing.map(|by| by * weight);
            self.scatter_friction(shapes, bodies, (&self.linearised_foot, forces), out);
        }
    }

    pub(super) fn correct(&mut self, shapes: &[Shape], bodies: &[Body], correction: &[f64]) {
        let (own, other) =
            (&bodies[shapes[self.index.shape].body], &bodies[shapes[self.index.target].body]);
        let sum = |weights: &mut dyn Iterator<Item = (usize, f64)>, body: &Body| {
            weights.fold(Vec2::zeros(), |sum, (at, by)| sum + body.vector_at(at, correction) * by)
        };
        let moved = [
            sum(&mut self.place(shapes).weights(), own),
            sum(&mut self.start.foot.weights(0), other),
            sum(&mut self.linearised_foot.weights(0), other),
            sum(&mut self.linearised_foot.weights(1), other),
        ];
        let slope = &self.linearised.slope;
        let change = (0..LOCAL).map(|at| slope[at] * moved[at / 2][at % 2]).sum();
        let before = self.normal.tension.force;
        self.normal.tension.correct(change);
        if self.friction.is_none() {
            return;
        }
        let bodies = [self.index.shape, self.index.target].map(|shape| &bodies[shapes[shape].body]);
        let turned = self.index.rotations(shapes, &self.start.foot, |shape, at| {
            let body = bodies[usize::from(shape != self.index.shape)];
            correction.get(body.degrees_of_freedom[at][2]).copied().unwrap_or(0.0)
        });
        let change = before - self.normal.tension.force;
        if let Some(friction) = &mut self.friction {
            let moved = from_fn(|at| match at.checked_sub(LOCAL) {
                Some(side) => turned[side],
                None => moved[at / 2][at % 2],
            });
            friction.force.correct(moved, change);
        }
    }

    fn scatter(
        &self,
        shapes: &[Shape],
        bodies: &[Body],
        (foot, [on_point, on_start, on_end]): (&Foot, [Vec2; 3]),
        out: &mut [f64],
    ) {
        let mut add = |shape: usize, at: usize, force: Vec2| {
            let [x, y, _] = bodies[shapes[shape].body].degrees_of_freedom[at];
            out[x] += force.x;
            out[y] += force.y;
        };
        let PairIndex { shape, target, .. } = self.index;
        self.place(shapes).weights().for_each(|(at, by)| add(shape, at, on_point * by));
        self.start.foot.weights(0).for_each(|(at, by)| add(target, at, on_start * by));
        foot.weights(0).for_each(|(at, by)| add(target, at, on_end * by));
    }

    fn scatter_friction(
        &self,
        shapes: &[Shape],
        bodies: &[Body],
        (foot, forces): (&Foot, [f64; WITH_ROTATIONS]),
        out: &mut [f64],
    ) {
        let vectors = [0, 2, 4].map(|at| Vec2::new(forces[at], forces[at + 1]));
        self.scatter(shapes, bodies, (foot, vectors), out);
        let mut add = |shape: usize, at: usize, moment: f64| {
            out[bodies[shapes[shape].body].degrees_of_freedom[at][2]] += moment;
        };
        let PairIndex { shape, target, .. } = self.index;
        let of_point = self.place(shapes).weights();
        of_point.for_each(|(at, by)| add(shape, at, by * forces[LOCAL]));
        let of_foot = self.start.foot.weights(0);
        of_foot.for_each(|(at, by)| add(target, at, by * forces[LOCAL + 1]));
    }

    /// Ends a step. Returns the energy dissipated in the contact [energy].
    pub(super) fn advance(&mut self, shapes: &[Shape], time: ContactTime) -> f64 {
        self.evaluate(shapes, time.stage);
        let GapTrial { change, moved, .. } = self.trial;
        let lost = self.normal.advance(&self.law, time, GapChange { value: change, moved });
        match self.friction_at(time) {
            Some((contact, friction)) => lost + friction.force.advance(contact),
            None => lost,
        }
    }

    /// Elastic energy of the contact at the start of the step [energy].
    pub(super) fn energy(&self) -> f64 {
        let energy = self.normal.energy(&self.law);
        self.friction.as_ref().map_or(energy, |friction| energy + friction.force.energy())
    }

    /// Friction force on the body of the contact point in the last step, positive to the right of the normal [force].
    pub(super) fn friction_force(&self) -> f64 {
        self.friction.as_ref().map_or(0.0, |friction| friction.force.last())
    }

    /// Contact force on the body of the contact point in the completed step [force].
    pub(super) fn mean_force(&self) -> Vec2 {
        -(self.applied[0] + self.applied[1])
    }

    fn tension_at_start(&self) -> (ForceTarget, f64) {
        let tension = self.normal.elastic(&self.law, Stage::End, 0.0);
        (tension, self.normal.damping(&self.law, tension, self.normal.mass).0)
    }

    pub(super) fn damped_rate(&self, velocity: Vec2) -> (f64, f64) {
        (self.tension_at_start().1, self.normal_at_start().dot(&velocity))
    }

    pub(super) fn add_force_at_start(
        &self,
        shapes: &[Shape],
        rates: impl Fn(usize, usize) -> Movement,
        bodies: &[Body],
        out: &mut [f64],
    ) {
        let velocity = |shape: usize, at: usize| {
            let [x, y, _] = rates(shape, at);
            Vec2::new(x, y)
        };
        let velocities = self.velocities(shapes, velocity);
        let (tension, damping) = self.tension_at_start();
        let normal = self.normal_at_start();
        let rate = normal.dot(&(velocities[0] - velocities[1]));
        let tension = (tension.force + damping * rate).min(0.0);
        let force = normal * tension;
        self.scatter(shapes, bodies, (&self.start.foot, [force, -force, Vec2::zeros()]), out);
        if let Some(friction) = &self.friction {
            let foot = self.start.foot;
            let turned = self.index.rotations(shapes, &foot, |shape, at| rates(shape, at)[2]);
            let [point, at_foot] = velocities;
            let movement =
                GapMovement { moved: [point, at_foot, at_foot], ..GapMovement::none(foot) };
            let rotations = Rotations { turned, shares: friction.shares };
            let rates = slip_trial(&GapTrial::at_rest(self.start.apart), &movement, rotations);
            let damping = friction.force.sticking_damping();
            let forces = friction.force.at_start(&rates, -tension, damping);
            self.scatter_friction(shapes, bodies, (&foot, forces), out);
        }
    }

    /// Elastic contact force on the point at the start of the step, as an internal force [force].
    pub(super) fn elastic_force(&self) -> Vec2 {
        self.normal_at_start() * self.tension_at_start().0.force
    }

    pub(super) fn static_stiffness(
        &self,
        shapes: &[Shape],
        bodies: &[Body],
        rows: &mut LocalRows,
    ) -> SpanStiffness {
        let mut resting = self.clone();
        resting.evaluate(shapes, Stage::Start);
        resting.collect(shapes, bodies, rows, usize::MAX);
        let tension = resting.tension_at_start().0;
        let mut stiffness = SpanStiffness::default();
        let slope = resting.trial.slope;
        stiffness.strains.extend(rows.columns.iter().map(|column| dot(&slope, column)));
        stiffness.stiffness.push(tension.stiffness);
        let geometric = resting.local_tangent(0.0, tension.force);
        for (local, row) in geometric.iter().enumerate() {
            stiffness.twists.extend(rows.columns.iter().map(|column| 0.5 * dot(row, column)));
            stiffness.twists.extend(rows.columns.iter().map(|column| column[local]));
            stiffness.rounding_fractions.push(0.0);
        }
        stiffness
    }

    /// Creates the pair from a saved state; `None` if the saved data do not fit the shapes.
    pub(super) fn restored(
        shapes: &[Shape],
        candidates: &[CandidatePair],
        next: &mut dyn FnMut() -> Option<f64>,
    ) -> Option<Self> {
        let mut index = || Some(next()? as usize);
        let index = PairIndex { shape: index()?, site: index()?, target: index()? };
        let is_own = |one: &&CandidatePair| (one.shape, one.target) == (index.shape, index.target);
        let candidate = candidates.iter().find(is_own)?;
        shapes[index.shape].sites.get(index.site)?;
        let (span, xi) = (next()? as usize, next()?);
        let foot = shapes[index.target].foot_in(span, xi)?;
        let mut pair = Self::new(candidate, index.site, shapes, foot);
        pair.use_foot(shapes, foot);
        let mut is_complete = true;
        let mut number = || {
            let number = next();
            is_complete &= number.is_some();
            number.unwrap_or_default()
        };
        pair.normal.restore(&mut number);
        if let Some(friction) = &mut pair.friction {
            friction.force.restore(&mut number);
        }
        pair.update_masses(shapes);
        is_complete.then_some(pair)
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        let PairIndex { shape, site, target } = self.index;
        let Foot { xi, span, .. } = self.start.foot;
        state.extend([shape, site, target, span].map(|index| index as f64));
        state.push(xi);
        self.normal.save(state);
        if let Some(friction) = &self.friction {
            friction.force.save(state);
        }
    }
}

impl LocalRows {
    fn column_of(&mut self, unknown: usize) -> &mut [f64; WITH_ROTATIONS] {
        let known = self.unknowns.iter().position(|at| *at == unknown);
        let at = known.unwrap_or_else(|| {
            self.unknowns.push(unknown);
            self.columns.push([0.0; WITH_ROTATIONS]);
            self.columns.len() - 1
        });
        &mut self.columns[at]
    }

    pub(super) fn entries<const N: usize>(
        &self,
        tangent: &[[f64; N]; N],
    ) -> impl Iterator<Item = f64> + '_ {
        let product: [[f64; N]; N] = *tangent;
        self.columns.iter().flat_map(move |row| {
            let by: [f64; N] =
                from_fn(|column| (0..N).map(|at| row[at] * product[at][column]).sum());
            self.columns.iter().map(move |column| dot(&by, column))
        })
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Vector from the nearest point `from` to the nearest point `to` on an axis with the control points `points` [length].
/// The second returned value is the length [length] to which the rounding error of the vector is proportional.
fn slide(from: &Foot, to: &Foot, points: &[Vec2]) -> (Vec2, f64) {
    let by = to.xi - from.xi;
    if by == 0.0 {
        return (Vec2::zeros(), 0.0);
    }
    if from.span == to.span {
        let (mut sum, mut factor) = (Vec2::zeros(), 1.0);
        for order in 1..=MAX_DEGREE {
            factor *= by / order as f64;
            sum += from.combine(order, points) * factor;
        }
        return (sum, sum.norm());
    }
    let ends = [from, to].map(|foot| foot.combine(0, points));
    let size = from.weights(0).map(|(at, _)| (points[at] - ends[0]).norm()).fold(0.0, f64::max);
    (ends[1] - ends[0], size.max((ends[1] - ends[0]).norm()))
}
