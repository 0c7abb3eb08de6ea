//! Drag in a step.
//!
//! ```text
//! v = Δx/Δt - wind      f_a = -w N_a G(v, t)      D grows by Σ w G·v Δt ≥ 0, W by -Σ w G·wind Δt
//! ```
//!
//! `t` is the direction of the axis in the mean configuration. The force follows from movements alone, so that it needs no unknown of its own.

use super::drag_law::{DragLaw, Resisted};
use super::pace::Pace;
use super::resistance::Resistance;
use super::{Exchange, Iterate};
use crate::beams::{ForceSummary, Movement, Place, RateCollocation};
use crate::geometry::{Vec2, cross, larger, perpendicular};
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::model::bodies::Body;

/// A point of a body that is dragged.
#[derive(Debug, Clone)]
pub struct DragPoint {
    /// The body, by its index.
    pub body: usize,
    /// The first control point whose function is not zero there.
    pub first: usize,
    /// The functions there [-], and their derivatives by arc length [1/length]; the latter are zero where no direction counts.
    pub shape: Vec<f64>,
    pub slope: Vec<f64>,
    /// The length that it stands for [length]; 1 of a point.
    pub weight: f64,
    /// The velocity of the point in the step before [length/time].
    pub last_velocity: Vec2,
}

impl DragPoint {
    /// The point at a place, which has no length.
    pub fn at(place: &Place) -> Self {
        let shape = place.shape().to_vec();
        Self {
            body: place.body,
            first: place.first,
            slope: vec![0.0; shape.len()],
            shape,
            weight: 1.0,
            last_velocity: Vec2::zeros(),
        }
    }

    /// The sum of values of control points by the functions, or by their derivatives.
    fn combine(&self, by: &[f64], value: impl Fn(usize) -> Vec2) -> Vec2 {
        by.iter()
            .enumerate()
            .fold(Vec2::zeros(), |sum, (at, by)| sum + value(self.first + at) * *by)
    }

    /// `(x0, g0)`, relative to its first control point, and that.
    fn start(&self, body: &Body) -> (Vec2, Vec2, Vec2) {
        let points = body.dynamics.control_points();
        let origin = points[self.first];
        let relative = |at: usize| points[at] - origin;
        (self.combine(&self.shape, relative), self.combine(&self.slope, relative), origin)
    }
}

/// Drag on points of bodies.
pub struct DragForces {
    name: String,
    law: DragLaw,
    points: Vec<DragPoint>,
    wind: Vec2,
    pace: Pace,
    dissipated: f64,
    /// What the wind has given [energy].
    wind_work: f64,
    /// `G` at each point in the iterate.
    forces: Vec<Vec2>,
}

/// A point in an iterate.
struct Met {
    /// What it resists with, times its weight.
    resisted: Resisted,
    /// The derivative of the angle of the line by `g` [1/length].
    turn_by_gradient: Vec2,
}

impl DragForces {
    /// Drag by a law on points of bodies, in a wind [length/time].
    pub fn new(name: String, law: DragLaw, points: Vec<DragPoint>, wind: Vec2) -> Self {
        let forces = vec![Vec2::zeros(); points.len()];
        Self {
            name,
            law,
            points,
            wind,
            pace: Pace::default(),
            dissipated: 0.0,
            wind_work: 0.0,
            forces,
        }
    }

    fn rates(&self, at: Iterate<'_>) -> Option<RateCollocation> {
        let is_timed = self.pace.duration().is_finite();
        self.pace.at(at.stage, at.weight).filter(|_| is_timed)
    }

    fn meet(&self, point: &DragPoint, rates: RateCollocation, at: Iterate<'_>) -> Met {
        let body = &at.bodies[point.body];
        let moved = |control: usize| body.vector_at(control, at.increments);
        let (change, by) = (point.combine(&point.shape, moved), point.combine(&point.slope, moved));
        let (_, gradient, _) = point.start(body);
        let velocity = change * rates.by_change - point.last_velocity * rates.by_last - self.wind;
        let (resisted, turn_by_gradient) =
            directed(&self.law, velocity, gradient + by * rates.share);
        let Resisted { force, by_velocity, by_turn } = resisted;
        let resisted = Resisted {
            force: force * point.weight,
            by_velocity: by_velocity.map(|column| column * point.weight),
            by_turn: by_turn * point.weight,
        };
        Met { resisted, turn_by_gradient }
    }

    fn add(point: &DragPoint, body: &Body, force: Vec2, out: &mut [f64]) {
        for (at, share) in point.shape.iter().enumerate() {
            let [x, y, _] = body.degrees_of_freedom[point.first + at];
            out[x] += share * force.x;
            out[y] += share * force.y;
        }
    }

    /// The movement of a point in the step of the movements that the bodies gathered last.
    fn movement(point: &DragPoint, bodies: &[Body]) -> Vec2 {
        let moved = bodies[point.body].moved();
        point.combine(&point.shape, |at| Vec2::new(moved[at][0], moved[at][1]))
    }
}

/// What a law resists with where a line has a tangent of any length, and the derivative of its angle by that.
fn directed(law: &DragLaw, velocity: Vec2, gradient: Vec2) -> (Resisted, Vec2) {
    let length = gradient.norm();
    let (t, inverse) = match length > 0.0 {
        true => (gradient / length, 1.0 / length),
        false => (Vec2::x(), 0.0),
    };
    (law.resist(velocity, t), perpendicular(t) * inverse)
}

impl Resistance for DragForces {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin_step(&mut self, interval: Interval) {
        self.pace.begin(interval.duration());
        self.forces.fill(Vec2::zeros());
    }

    fn begin_movement(&mut self) {
        self.pace.begin(f64::INFINITY);
        self.forces.fill(Vec2::zeros());
    }

    fn add_forces(&mut self, at: Iterate<'_>, out: &mut [f64]) -> ForceSummary {
        let Some(rates) = self.rates(at) else { return ForceSummary::default() };
        let mut forces = std::mem::take(&mut self.forces);
        let mut largest = 0.0;
        for (point, force) in self.points.iter().zip(&mut forces) {
            *force = self.meet(point, rates, at).resisted.force;
            largest = larger(largest, larger(force.x.abs(), force.y.abs()));
            Self::add(point, &at.bodies[point.body], *force, out);
        }
        self.forces = forces;
        ForceSummary { force: largest, ..ForceSummary::default() }
    }

    fn add_linearised_forces(
        &mut self,
        at: Iterate<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let Some(rates) = self.rates(at) else { return };
        for point in &self.points {
            let Met { resisted, turn_by_gradient } = self.meet(point, rates, at);
            let body = &at.bodies[point.body];
            Self::add(point, body, resisted.force, out);
            let degrees = &body.degrees_of_freedom[point.first..];
            for (column, (shape, slope)) in point.shape.iter().zip(&point.slope).enumerate() {
                for axis in 0..2 {
                    let turned = turn_by_gradient[axis] * rates.share * slope;
                    let by = resisted.by_velocity[axis] * (rates.by_change * shape)
                        + resisted.by_turn * turned;
                    let column = degrees[column][axis];
                    for (share, rows) in point.shape.iter().zip(degrees) {
                        for component in 0..2 {
                            let row = rows[component];
                            if row < unknowns && column < unknowns {
                                tangent.add(row, column, share * by[component]);
                            }
                        }
                    }
                }
            }
        }
    }

    fn add_mismatch_forces(&self, _bodies: &[Body], _weight: f64, _out: &mut [f64]) {}

    fn correct(&mut self, _bodies: &[Body], _correction: &[f64]) {}

    /// What the medium gives: an impulse where the point is in the middle of the step, and work where it flows.
    fn exchange(&self, bodies: &[Body], duration: f64) -> Exchange {
        let mut sum = Exchange::default();
        for (point, force) in self.points.iter().zip(&self.forces) {
            let (place, _, origin) = point.start(&bodies[point.body]);
            let middle = origin + place + Self::movement(point, bodies) * 0.5;
            let impulse = force * -duration;
            sum += Exchange::of(impulse.dot(&self.wind), impulse, cross(middle, impulse));
        }
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        let duration = self.pace.duration();
        let is_timed = duration.is_finite();
        for (point, force) in self.points.iter_mut().zip(&self.forces) {
            let movement = Self::movement(point, bodies);
            if is_timed {
                self.dissipated += force.dot(&(movement - self.wind * duration));
                self.wind_work -= force.dot(&self.wind) * duration;
            }
            point.last_velocity = movement / duration;
        }
        self.pace.end();
    }

    fn stored(&self) -> f64 {
        0.0
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn wind_work(&self) -> Option<f64> {
        (self.wind != Vec2::zeros()).then_some(self.wind_work)
    }

    fn add_forces_now(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        for point in &self.points {
            let rate = |at: usize| Vec2::new(rates[point.body][at][0], rates[point.body][at][1]);
            let velocity = point.combine(&point.shape, rate) - self.wind;
            let body = &bodies[point.body];
            let force = directed(&self.law, velocity, point.start(body).1).0.force;
            Self::add(point, body, force * point.weight, out);
        }
    }

    fn dissipation(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        let law = self.law.linear();
        let power = |point: &DragPoint| {
            let body = &bodies[point.body];
            let velocity = point.combine(&point.shape, |at| body.vector_at(at, rates));
            let resisted = directed(&law, velocity, point.start(body).1).0;
            point.weight * resisted.force.dot(&velocity)
        };
        self.points.iter().map(power).sum()
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.pace.save(state);
        let velocities = self.points.iter().map(|point| point.last_velocity);
        state.extend(velocities.flat_map(|velocity| [velocity.x, velocity.y]));
        state.push(self.dissipated);
        state.extend(self.wind_work());
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.pace.restore(next);
        for point in &mut self.points {
            point.last_velocity = Vec2::new(next(), next());
        }
        self.dissipated = next();
        if self.wind != Vec2::zeros() {
            self.wind_work = next();
        }
    }

    fn explain(&self) -> String {
        let points = crate::model::words::plural(self.points.len(), "point");
        let wind = match self.wind == Vec2::zeros() {
            true => String::new(),
            false => format!(", in a wind of ({}, {})", self.wind.x, self.wind.y),
        };
        format!("{} at {points}{wind}; part of the tangent", self.law.describe())
    }
}
