//! Drag at a point of a body in a step.
//!
//! The drag force is an independent unknown. For drag along a beam, its components are across and along the axis of the beam at this point.
//! For drag on a single point, its components are along y and x.
//! Under strong drag or wind, the rounding error of a force computed from velocities would exceed the tolerance of the residual forces.

use super::drag_law::{DragLaw, DragResponse, in_space};
use crate::beams::{BodyPoint, RateCollocation};
use crate::geometry::{Vec2, larger, perpendicular};
use crate::system::bodies::Body;

pub struct Medium {
    pub law: DragLaw,
    /// Velocity of the medium [length/time].
    pub wind: Vec2,
}

#[derive(Debug, Clone)]
pub struct DragPoint {
    pub body: usize,
    first: usize,
    shape: Vec<f64>,
    slope: Vec<f64>,
    /// Quadrature weight of a point of a beam with drag along its length [length]; 1 for drag on a single point.
    weight: f64,
    last_velocity: Vec2,
    speed: f64,
    /// Force components across and along the line in the present iterate [force, or force/length].
    force: Vec2,
    last_force: Vec2,
    mismatch: Vec2,
    /// Force vector that was applied last, including the quadrature weight [force].
    applied_force: Vec2,
    linearised: DragTrial,
    rates: Option<RateCollocation>,
}

#[derive(Debug, Clone, Copy)]
struct DragTrial {
    tangent: Vec2,
    response: DragResponse,
    angle_by_gradient: Vec2,
    rates: (f64, f64),
}

impl DragTrial {
    fn zero() -> Self {
        let none = Vec2::zeros();
        let response = DragResponse::default();
        Self { tangent: Vec2::x(), response, angle_by_gradient: none, rates: (0.0, 0.0) }
    }

    fn new(law: &DragLaw, velocity: Vec2, gradient: Vec2, rates: (f64, f64)) -> Self {
        let (tangent, inverse) = unit_tangent(gradient);
        let response = law.force(velocity, tangent);
        Self { tangent, response, angle_by_gradient: perpendicular(tangent) * inverse, rates }
    }
}

fn unit_tangent(gradient: Vec2) -> (Vec2, f64) {
    let length = gradient.norm();
    match length > 0.0 {
        true => (gradient / length, 1.0 / length),
        false => (Vec2::x(), 0.0),
    }
}

impl DragPoint {
    pub fn new(
        (body, first): (usize, usize),
        shape: Vec<f64>,
        slope: Vec<f64>,
        weight: f64,
    ) -> Self {
        let none = Vec2::zeros();
        Self {
            body,
            first,
            shape,
            slope,
            weight,
            last_velocity: none,
            speed: 0.0,
            force: none,
            last_force: none,
            mismatch: none,
            applied_force: none,
            linearised: DragTrial::zero(),
            rates: None,
        }
    }

    pub fn at(place: &BodyPoint) -> Self {
        let shape = place.shape().to_vec();
        let slope = vec![0.0; shape.len()];
        Self::new((place.body, place.first), shape, slope, 1.0)
    }

    fn combine(&self, by: &[f64], value: impl Fn(usize) -> Vec2) -> Vec2 {
        by.iter()
            .enumerate()
            .fold(Vec2::zeros(), |sum, (at, by)| sum + value(self.first + at) * *by)
    }

    fn size(&self, value: impl Fn(usize) -> Vec2) -> f64 {
        let sizes = self.shape.iter().enumerate();
        sizes.fold(0.0, |sum, (at, by)| sum + value(self.first + at).norm() * by.abs())
    }

    pub fn velocity(&self, rate: impl Fn(usize) -> Vec2) -> Vec2 {
        self.combine(&self.shape, rate)
    }

    /// Velocity components across and along the line at the start of a step [length/time].
    pub fn across_and_along(&self, body: &Body, rate: impl Fn(usize) -> Vec2) -> Vec2 {
        let (velocity, tangent) = (self.velocity(rate), unit_tangent(self.gradient(body)).0);
        Vec2::new(perpendicular(tangent).dot(&velocity), tangent.dot(&velocity))
    }

    pub fn weight(&self) -> f64 {
        self.weight
    }

    fn gradient(&self, body: &Body) -> Vec2 {
        let points = body.dynamics.control_points();
        let origin = points[self.first];
        self.combine(&self.slope, |at| points[at] - origin)
    }

    pub fn movement(&self, body: &Body) -> Vec2 {
        let moved = body.moved();
        self.combine(&self.shape, |at| Vec2::new(moved[at][0], moved[at][1]))
    }

    pub fn middle(&self, body: &Body) -> Vec2 {
        let points = body.dynamics.control_points();
        let origin = points[self.first];
        let place = self.combine(&self.shape, |at| points[at] - origin);
        origin + place + self.movement(body) * 0.5
    }

    pub fn begin_step(&mut self, body: &Body, rates: &[f64]) {
        self.force = self.last_force;
        self.speed = self.size(|at| body.vector_at(at, rates));
    }

    pub fn reset_at_rest(&mut self) {
        (self.force, self.mismatch, self.applied_force) =
            (Vec2::zeros(), Vec2::zeros(), Vec2::zeros());
        self.linearised = DragTrial::zero();
    }

    fn evaluate(
        &self,
        around: &Medium,
        body: &Body,
        increments: &[f64],
        rates: RateCollocation,
    ) -> DragTrial {
        let moved = |control: usize| body.vector_at(control, increments);
        let (change, by) = (self.combine(&self.shape, moved), self.combine(&self.slope, moved));
        let velocity = change * rates.by_change - self.last_velocity * rates.by_last - around.wind;
        let gradient = self.gradient(body) + by * rates.fraction;
        DragTrial::new(&around.law, velocity, gradient, (rates.by_change, rates.fraction))
    }

    pub fn compare(
        &mut self,
        around: &Medium,
        body: &Body,
        increments: &[f64],
        rates: RateCollocation,
    ) -> f64 {
        let DragTrial { tangent, response: resisted, .. } =
            self.evaluate(around, body, increments, rates);
        self.mismatch = resisted.force - self.force;
        self.rates = Some(rates);
        self.applied_force = in_space(tangent, self.force) * self.weight;
        let moved = self.size(|at| body.vector_at(at, increments)) * rates.by_change.abs();
        let before = self.last_velocity.norm() * rates.by_last.abs();
        let scale = around.law.scale(self.speed + moved + before + around.wind.norm());
        let relative = |missing: f64, scale: f64| match missing {
            0.0 => 0.0,
            missing => missing.abs() / scale,
        };
        larger(relative(self.mismatch.x, scale.x), relative(self.mismatch.y, scale.y))
    }

    pub fn linearise(
        &mut self,
        around: &Medium,
        body: &Body,
        increments: &[f64],
        rates: RateCollocation,
    ) -> Vec2 {
        self.linearised = self.evaluate(around, body, increments, rates);
        let DragTrial { tangent, response: resisted, .. } = self.linearised;
        self.mismatch = resisted.force - self.force;
        in_space(tangent, resisted.force) * self.weight
    }

    /// Calls `give` with the derivatives of the nodal forces with respect to the nodal increments.
    pub fn each_derivative(&self, mut give: impl FnMut((usize, usize), (usize, usize), f64)) {
        let DragTrial {
            tangent,
            response: resisted,
            angle_by_gradient: turn_by_gradient,
            rates: (by_change, share),
        } = self.linearised;
        let turned = in_space(tangent, resisted.by_angle + Vec2::new(self.force.y, -self.force.x));
        let [across, along] = resisted.by_velocity;
        for (column, (shape, slope)) in self.shape.iter().zip(&self.slope).enumerate() {
            for axis in 0..2 {
                let by_velocity = in_space(tangent, Vec2::new(across[axis], along[axis]));
                let by = by_velocity * (by_change * shape)
                    + turned * (turn_by_gradient[axis] * share * slope);
                for (row, of_row) in self.shape.iter().enumerate() {
                    for component in 0..2 {
                        let value = self.weight * of_row * by[component];
                        give((self.first + row, component), (self.first + column, axis), value);
                    }
                }
            }
        }
    }

    pub fn correct(&mut self, body: &Body, correction: &[f64]) {
        let DragTrial {
            response: resisted,
            angle_by_gradient: turn_by_gradient,
            rates: (by_change, share),
            ..
        } = self.linearised;
        let moved = |control: usize| body.vector_at(control, correction);
        let velocity = self.combine(&self.shape, moved) * by_change;
        let turn = turn_by_gradient.dot(&self.combine(&self.slope, moved)) * share;
        let [across, along] = resisted.by_velocity.map(|by| by.dot(&velocity));
        self.force += self.mismatch + Vec2::new(across, along) + resisted.by_angle * turn;
    }

    /// Drag force applied in the last iterate, in components along x and y [force].
    pub fn applied_force(&self) -> Vec2 {
        self.applied_force
    }

    /// Dissipated power, computed from the drag force of the last iterate without rounding errors of velocities [power].
    pub fn power(&self, law: &DragLaw) -> f64 {
        law.power(self.force) * self.weight
    }

    /// Displacement of the point in the step, minus `duration` times the velocity of the point for which the drag law is evaluated [length].
    pub fn displacement_remainder(&self, movement: Vec2, duration: f64) -> Vec2 {
        let Some(rates) = self.rates else { return Vec2::zeros() };
        movement * (1.0 - rates.by_change * duration)
            + self.last_velocity * (rates.by_last * duration)
    }

    pub fn missing(&self) -> Vec2 {
        in_space(self.linearised.tangent, self.mismatch) * self.weight
    }

    /// Force of the point on the medium for the rates at the start of a step [force].
    pub fn force_at_start(
        &self,
        around: &Medium,
        body: &Body,
        rate: impl Fn(usize) -> Vec2,
    ) -> Vec2 {
        let velocity = self.velocity(rate) - around.wind;
        let DragTrial { tangent, response: resisted, .. } =
            DragTrial::new(&around.law, velocity, self.gradient(body), (0.0, 0.0));
        in_space(tangent, resisted.force) * self.weight
    }

    pub fn scatter(&self, body: &Body, force: Vec2, out: &mut [f64]) {
        for (at, share) in self.shape.iter().enumerate() {
            let [x, y, _] = body.degrees_of_freedom[self.first + at];
            out[x] += share * force.x;
            out[y] += share * force.y;
        }
    }

    pub fn advance(&mut self, velocity: Vec2) {
        self.last_velocity = velocity;
        self.last_force = self.force;
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        let Self { last_velocity: v, last_force: f, .. } = self;
        state.extend([v.x, v.y, f.x, f.y]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.last_velocity = Vec2::new(next(), next());
        self.last_force = Vec2::new(next(), next());
    }
}
