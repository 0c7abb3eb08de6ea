//! Nodal forces that do not depend on the configuration.

use super::{TrialState, WorkAndImpulse};
use crate::beams::{BodyPoint, Movement};
use crate::geometry::{Vec2, cross};
use crate::system::bodies::Body;

#[derive(Debug, Clone, Default)]
pub struct LoadVector {
    entries: Vec<(usize, usize, Movement)>,
    largest: (f64, f64),
}

impl LoadVector {
    pub fn at(place: &BodyPoint, force: Movement) -> Self {
        let mut pattern = Self::default();
        pattern.push_at(place, force);
        pattern
    }

    pub fn push_at(&mut self, place: &BodyPoint, force: Movement) {
        for (point, weight) in place.weights() {
            self.push(place.body, point, force.map(|value| weight * value));
        }
    }

    pub fn push(&mut self, body: usize, point: usize, force: Movement) {
        let [x, y, moment] = force.map(f64::abs);
        self.largest = (self.largest.0.max(x).max(y), self.largest.1.max(moment));
        self.entries.push((body, point, force));
    }

    pub fn subtract_from(&self, at: TrialState<'_>, factor: f64, out: &mut [f64]) {
        for (body, point, force) in &self.entries {
            for (&at, value) in at.bodies[*body].degrees_of_freedom[*point].iter().zip(force) {
                out[at] -= factor * value;
            }
        }
    }

    /// Largest nodal force [force] and largest nodal moment [force·length], times `factor`.
    pub fn largest(&self, factor: f64) -> (f64, f64) {
        (factor.abs() * self.largest.0, factor.abs() * self.largest.1)
    }

    pub fn exchange(&self, bodies: &[Body], factor: f64, duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for (body, point, [fx, fy, moment]) in &self.entries {
            let [x, y, omega] = bodies[*body].moved()[*point];
            let (force, moved) = (Vec2::new(*fx, *fy) * factor, Vec2::new(x, y));
            let middle = bodies[*body].dynamics.control_points()[*point] + moved * 0.5;
            sum += WorkAndImpulse::of(
                force.dot(&moved) + factor * moment * omega,
                force * duration,
                (cross(middle, force) + factor * moment) * duration,
            );
        }
        sum
    }

    /// Sum of the scalar products of forces and positions, which is minus the potential of constant forces [energy].
    pub fn potential_work(&self, bodies: &[Body]) -> f64 {
        self.potential_work_on(bodies, |_| true)
    }

    /// Contribution of the selected bodies to the sum of the scalar products of forces and positions [energy].
    pub fn potential_work_on(&self, bodies: &[Body], counts: impl Fn(usize) -> bool) -> f64 {
        let work = |(body, point, [fx, fy, _]): &(usize, usize, Movement)| {
            bodies[*body].dynamics.control_points()[*point].dot(&Vec2::new(*fx, *fy))
        };
        self.entries.iter().filter(|(body, ..)| counts(*body)).map(work).sum()
    }
}
