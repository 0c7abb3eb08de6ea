//! Damper along the line between two points whose distance may pass through zero.
//!
//! If two points pass each other within a step, the mean rate of their distance can be zero although they move.
//! The damper uses the rate along the mean connecting vector, which is correct also for points that pass each other.
//! The damping force acts along the mean line, so that angular momentum is conserved.

use super::damping_law::DampingLaw;
use super::elongation::ElongationEnd;
use super::internal_force::{InternalForce, SpringTrialState};
use super::law_range::LawRange;
use super::mixed_force::{ForceTarget, MixedForce};
use super::rate_history::RateHistory;
use super::{OutsideLaw, TrialState, WorkAndImpulse};
use crate::beams::{ForceSummary, Movement, RateCollocation};
use crate::geometry::{Vec2, cross};
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

#[derive(Debug, Clone)]
pub struct PointDamper {
    name: String,
    terminals: [ElongationEnd; 2],
    grounds: [Option<Vec2>; 2],
    distance: Vec2,
    law: DampingLaw,
    range: Option<LawRange>,
    released: Option<DampingLaw>,
    rate_history: RateHistory,
    last_velocity: Vec2,
    speed: f64,
    force: MixedForce,
    applied_force: Vec2,
    linearised: DamperTrial,
    dissipated: f64,
}

#[derive(Debug, Clone, Copy)]
struct DamperTrial {
    direction: Vec2,
    rate: f64,
    target: ForceTarget,
    rate_by_movement: Vec2,
    direction_slope: f64,
}

impl Default for DamperTrial {
    fn default() -> Self {
        let none = Vec2::zeros();
        let target = ForceTarget::default();
        Self { direction: none, rate: 0.0, target, rate_by_movement: none, direction_slope: 0.0 }
    }
}

impl PointDamper {
    pub fn new(
        name: String,
        terminals: [ElongationEnd; 2],
        [from, to]: [Vec2; 2],
        grounds: &[Option<Vec2>],
        law: DampingLaw,
    ) -> Self {
        Self {
            name,
            terminals,
            grounds: [0, 1].map(|at: usize| grounds[at]),
            distance: to - from,
            range: law.watch(),
            law,
            released: None,
            rate_history: RateHistory::default(),
            last_velocity: Vec2::zeros(),
            speed: 0.0,
            force: MixedForce::default(),
            applied_force: Vec2::zeros(),
            linearised: DamperTrial::default(),
            dissipated: 0.0,
        }
    }

    fn rates(&self, at: TrialState<'_>) -> Option<RateCollocation> {
        let acts = self.rate_history.duration().is_finite() && self.law.is_active();
        self.rate_history.at(at.stage, at.weight).filter(|_| acts)
    }

    fn difference(&self, of_place: impl Fn(&ElongationEnd) -> Vec2) -> Vec2 {
        of_place(&self.terminals[1]) - of_place(&self.terminals[0])
    }

    fn relative_velocity_of(&self, bodies: &[Body], values: &[f64]) -> Vec2 {
        let value = |body: usize, point: usize| bodies[body].vector_at(point, values);
        self.difference(|terminal| terminal.combine(value))
    }

    fn size(&self, bodies: &[Body], values: &[f64]) -> f64 {
        let value = |body: usize, point: usize| bodies[body].vector_at(point, values);
        self.terminals.iter().map(|terminal| terminal.combine(value).norm()).sum()
    }

    fn movement(&self, bodies: &[Body]) -> Vec2 {
        let moved = |body: usize, point: usize| in_the_plane(bodies[body].moved()[point]);
        self.difference(|terminal| terminal.combine(moved))
    }

    fn evaluate(&self, at: TrialState<'_>, rates: RateCollocation) -> DamperTrial {
        let moved = self.relative_velocity_of(at.bodies, at.increments);
        let (separation, velocity) = (
            self.distance + moved * rates.fraction,
            moved * rates.by_change - self.last_velocity * rates.by_last,
        );
        let length = separation.norm();
        let direction = direction(separation, moved);
        let rate = direction.dot(&velocity);
        let turn = if length > 0.0 { rates.fraction / length } else { 0.0 };
        DamperTrial {
            direction,
            rate,
            target: ForceTarget { force: self.law.force(rate), stiffness: self.law.slope(rate) },
            rate_by_movement: direction * rates.by_change + (velocity - direction * rate) * turn,
            direction_slope: turn,
        }
    }

    fn scatter(&self, bodies: &[Body], force: Vec2, out: &mut [f64]) {
        for (terminal, sign) in self.terminals.iter().zip([-1.0, 1.0]) {
            let ElongationEnd::Moving(place) = terminal else { continue };
            for (point, weight) in place.weights() {
                let [x, y, _] = bodies[place.body].degrees_of_freedom[point];
                out[x] += sign * weight * force.x;
                out[y] += sign * weight * force.y;
            }
        }
    }

    fn force_at_start(&self, velocity: Vec2) -> Vec2 {
        let direction = direction(self.distance, velocity);
        direction * self.law.force(direction.dot(&velocity))
    }
}

fn direction(separation: Vec2, moved: Vec2) -> Vec2 {
    let along = if separation == Vec2::zeros() { moved } else { separation };
    let length = along.norm();
    if length > 0.0 { along / length } else { Vec2::zeros() }
}

fn in_the_plane([x, y, _]: Movement) -> Vec2 {
    Vec2::new(x, y)
}

impl InternalForce for PointDamper {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.rate_history.begin(interval.duration());
        self.force.begin_step();
        self.speed = self.size(bodies, rates);
        self.applied_force = Vec2::zeros();
        Ok(())
    }

    fn begin_movement(&mut self, _bodies: &[Body]) {
        self.rate_history.begin(f64::INFINITY);
        (self.force.force, self.force.mismatch) = (0.0, 0.0);
        (self.applied_force, self.linearised) = (Vec2::zeros(), DamperTrial::default());
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let Some(rates) = self.rates(at) else { return ForceSummary::default() };
        let DamperTrial { direction, target, .. } = self.evaluate(at, rates);
        let moved = self.size(at.bodies, at.increments) * rates.by_change.abs();
        let speed = self.speed + moved + self.last_velocity.norm() * rates.by_last.abs();
        let mismatch = self.force.compare(target, speed);
        self.applied_force = direction * self.force.force;
        self.scatter(at.bodies, self.applied_force, out);
        let force = self.force.force.abs();
        ForceSummary { strain_mismatch: mismatch, force, ..ForceSummary::default() }
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let Some(rates) = self.rates(at) else { return };
        let met = self.evaluate(at, rates);
        let impedance = self.force.impedance(met.rate);
        let (force, stiffness) = self.law.linearised_target(met.rate, self.force.force, impedance);
        let target = ForceTarget { force, stiffness };
        self.linearised = met;
        self.force.linearise(target);
        let DamperTrial { direction, rate_by_movement, direction_slope: turn, .. } = met;
        self.scatter(at.bodies, direction * target.force, out);
        let turning = self.force.force * turn;
        let terminals = || self.terminals.iter().zip([-1.0, 1.0]);
        for (to, sign) in terminals() {
            let ElongationEnd::Moving(to) = to else { continue };
            for (from, other) in terminals() {
                let ElongationEnd::Moving(from) = from else { continue };
                for component in 0..2 {
                    for by in 0..2 {
                        let one = if component == by { 1.0 } else { 0.0 };
                        let across = one - direction[component] * direction[by];
                        let value = direction[component] * target.stiffness * rate_by_movement[by]
                            + turning * across;
                        for (a, share_a) in to.weights() {
                            let row = at.bodies[to.body].degrees_of_freedom[a][component];
                            for (b, share_b) in from.weights() {
                                let column = at.bodies[from.body].degrees_of_freedom[b][by];
                                if row < unknowns && column < unknowns {
                                    let weight = share_a * share_b * sign * other;
                                    tangent.add(row, column, weight * value);
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    fn add_mismatch_forces(&self, bodies: &[Body], _weight: f64, out: &mut [f64]) {
        self.scatter(bodies, self.linearised.direction * self.force.mismatch, out);
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        let change =
            self.linearised.rate_by_movement.dot(&self.relative_velocity_of(bodies, correction));
        self.force.correct(change);
    }

    fn exchange(&self, _bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for (ground, sign) in self.grounds.iter().zip([-1.0, 1.0]) {
            if let Some(ground) = ground {
                let impulse = self.applied_force * (sign * duration);
                sum += WorkAndImpulse::of(0.0, impulse, cross(*ground, impulse));
            }
        }
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        let (movement, duration) = (self.movement(bodies), self.rate_history.duration());
        self.dissipated += self.applied_force.dot(&movement);
        let mean = self.distance + movement * 0.5;
        self.distance += movement;
        self.last_velocity = movement / duration;
        if let Some(range) = &mut self.range
            && duration.is_finite()
            && self.released.is_none()
        {
            range.add(direction(mean, movement).dot(&self.last_velocity));
        }
        self.force.last = self.force.force;
        self.rate_history.end();
    }

    fn each_outside_law(&self, take: &mut dyn FnMut(OutsideLaw)) {
        self.range.iter().filter_map(LawRange::outside).for_each(take);
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn stretched(&self) -> Option<SpringTrialState> {
        let elongation = self.distance.norm();
        Some(SpringTrialState { elongation, force: self.force.last, stiffness: 0.0 })
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        let rate = |body: usize, point: usize| in_the_plane(rates[body][point]);
        let velocity = self.difference(|terminal| terminal.combine(rate));
        self.scatter(bodies, self.force_at_start(velocity), out);
    }

    /// If both points coincide, the damper acts on small vibrations in both directions.
    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        if !self.law.is_active() {
            return;
        }
        let (velocity, damping) =
            (self.relative_velocity_of(bodies, rates), self.law.slope_at_rest());
        match self.distance == Vec2::zeros() {
            true => velocity.iter().for_each(|rate| take(damping, *rate)),
            false => take(damping, direction(self.distance, velocity).dot(&velocity)),
        }
    }

    fn release(&mut self) {
        self.detach();
    }

    fn detach(&mut self) {
        if self.released.is_none() {
            self.released = Some(std::mem::take(&mut self.law));
            (self.force, self.applied_force) = (MixedForce::default(), Vec2::zeros());
        }
    }

    fn attach(&mut self) {
        if let Some(own) = self.released.take() {
            self.law = own;
        }
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.rate_history.save(state);
        let Self { distance: separation, last_velocity: v, .. } = self;
        state.extend([separation.x, separation.y, v.x, v.y, self.force.last, self.dissipated]);
        self.range.iter().for_each(|range| range.save(state));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rate_history.restore(next);
        self.distance = Vec2::new(next(), next());
        self.last_velocity = Vec2::new(next(), next());
        self.force.last = next();
        self.dissipated = next();
        self.range.iter_mut().for_each(|range| range.restore(next));
    }

    fn explain(&self) -> String {
        if self.released.is_some() {
            return "released: no force".to_owned();
        }
        let law = self.law.describe().unwrap_or_default();
        format!("{law}; its force is eliminated from the matrix")
    }
}
