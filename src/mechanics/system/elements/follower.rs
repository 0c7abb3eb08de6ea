//! Follower forces.

use super::{TrialState, WorkAndImpulse, collocation};
use crate::beams::{BodyPoint, Rotation, RotationIncrement};
use crate::geometry::{Vec2, cross, perpendicular};
use crate::integrators::Stage;
use crate::linalg::BandedMatrix;
use crate::system::bodies::{Body, Tracker};

/// Force that rotates with a section. In each iterate, the rotation of the section at the current stage of the integrator is used.
#[derive(Debug, Clone)]
pub struct Follower {
    tracker: Tracker,
    force: Vec2,
    force_parts: Vec2,
    current: Vec2,
}

impl Follower {
    pub fn new(place: BodyPoint, force: Vec2) -> Self {
        let tracker = Tracker::new(place);
        Self { tracker, force, force_parts: Vec2::zeros(), current: Vec2::zeros() }
    }

    fn body<'b>(&self, bodies: &'b [Body]) -> &'b Body {
        &bodies[self.tracker.place.body]
    }

    fn rotations(&self, at: TrialState<'_>) -> (Rotation, Rotation, f64) {
        let [.., increment] = self.body(at.bodies).at(&self.tracker.place, at.increments);
        let collocation = collocation(at.stage);
        let end = self.tracker.rotation.turned(collocation.rotations, increment);
        (self.tracker.rotation.mixed(end, collocation.configuration), end, increment)
    }

    pub fn begin_step(&mut self) {
        (self.force_parts, self.current) = (Vec2::zeros(), Vec2::zeros());
    }

    pub fn subtract_from(&mut self, at: TrialState<'_>, factor: f64, out: &mut [f64]) {
        let (rotation, ..) = self.rotations(at);
        let force = rotation.to_space(self.force) * factor;
        *(if at.stage == Stage::Start { &mut self.force_parts } else { &mut self.current }) = force;
        let body = self.body(at.bodies);
        for (point, weight) in self.tracker.place.weights() {
            let [x, y, _] = body.degrees_of_freedom[point];
            out[x] -= weight * force.x;
            out[y] -= weight * force.y;
        }
    }

    pub fn largest(&self) -> f64 {
        self.force.amax()
    }

    pub fn add_tangent(
        &self,
        at: TrialState<'_>,
        factor: f64,
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let body = self.body(at.bodies);
        let (_, end, increment) = self.rotations(at);
        let collocation = collocation(at.stage);
        let scale =
            -at.weight * factor * collocation.configuration * collocation.rotations.rate(increment);
        let by_rotation = end.to_space(perpendicular(self.force)) * scale;
        for (a, share_a) in self.tracker.place.weights() {
            for (b, share_b) in self.tracker.place.weights() {
                let column = body.degrees_of_freedom[b][2];
                for (&row, value) in
                    body.degrees_of_freedom[a].iter().zip([by_rotation.x, by_rotation.y])
                {
                    if row < unknowns && column < unknowns {
                        tangent.add(row, column, share_a * share_b * value);
                    }
                }
            }
        }
    }

    pub fn add_exchange(&self, bodies: &[Body], duration: f64, sum: &mut WorkAndImpulse) {
        let body = self.body(bodies);
        let force = self.force_parts + self.current;
        for (point, weight) in self.tracker.place.weights() {
            let [x, y, _] = body.moved()[point];
            let moved = Vec2::new(x, y) * weight;
            let middle = body.dynamics.control_points()[point] * weight + moved * 0.5;
            *sum += WorkAndImpulse::of(
                force.dot(&moved),
                force * (weight * duration),
                cross(middle, force) * duration,
            );
        }
    }

    pub fn advance(&mut self, bodies: &[Body], rotations: RotationIncrement) {
        self.tracker.advance(self.body(bodies).moved(), rotations);
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        self.tracker.save(state);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.tracker.restore(next);
    }
}
