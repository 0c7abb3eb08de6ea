//! Rigid link in a step: a point fixed in the frame of a rigid body, and its constraint force (docs/theory.md, section 9.4).
//!
//! With tangent-scaled rotation increments, the constraint force does no work in a step, and its moments balance.

use std::ops::{Add, Div};

use crate::beams::{ForceSummary, Rotation, RotationIncrement, SpanStiffness};
use crate::geometry::{Vec2, cross, larger, perpendicular};
use crate::linalg::BandedMatrix;
use crate::system::bodies::Bodies;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceUnknowns {
    /// Unknowns in a step: the impulses of the constraint forces. The value of this variant is the duration of the step [time].
    Step(f64),
    /// Unknowns in a displacement between two equilibria: the changes of the constraint forces.
    AtRest,
}

impl ForceUnknowns {
    pub fn force<F>(self, last: F, unknown: F) -> F
    where
        F: Add<Output = F> + Div<f64, Output = F>,
    {
        match self {
            Self::Step(duration) => unknown / duration,
            Self::AtRest => last + unknown,
        }
    }

    /// Derivative of the constraint force with respect to its unknown [1/time, -].
    pub fn force_derivative(self) -> f64 {
        match self {
            Self::Step(duration) => 1.0 / duration,
            Self::AtRest => 1.0,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmRule {
    pub rotations: RotationIncrement,
    /// Fraction of the step at which the arm is evaluated [-].
    pub fraction: f64,
}

#[derive(Debug, Clone)]
pub struct RigidLink {
    pub body: usize,
    /// Control point that is linked to the centre of mass. The centre of mass is control point 0 of the body.
    pub point: usize,
    pub unknowns: [usize; 2],
    arm: Vec2,
    rotation: Rotation,
    force: Vec2,
    size: f64,
}

struct Iterated {
    start: Vec2,
    end: Vec2,
    force_arm: Vec2,
    force: Vec2,
    fraction: f64,
    rate: f64,
    increment: f64,
}

impl RigidLink {
    pub fn new(body: usize, point: usize, unknowns: [usize; 2], at: [Vec2; 2], angle: f64) -> Self {
        let rotation = Rotation::by(angle);
        let [centre, end] = at;
        let arm = rotation.to_section(end - centre);
        Self { body, point, unknowns, arm, rotation, force: Vec2::zeros(), size: arm.norm() }
    }

    /// Arm from the centre of mass to the linked point at the start of the step [length].
    pub fn arm(&self) -> Vec2 {
        self.rotation.to_space(self.arm)
    }

    /// Constraint force of the link in the last step or static solution [force].
    pub fn force(&self) -> Vec2 {
        self.force
    }

    pub fn exchange_force(&mut self, other: &mut Vec2) {
        std::mem::swap(&mut self.force, other);
    }

    fn degrees(&self, bodies: &Bodies) -> ([usize; 3], [usize; 3]) {
        let of_body = &bodies[self.body].degrees_of_freedom;
        (of_body[0], of_body[self.point])
    }

    fn iterated(
        &self,
        bodies: &Bodies,
        unknown: ForceUnknowns,
        ArmRule { rotations, fraction: at }: ArmRule,
        values: &[f64],
    ) -> Iterated {
        let ([.., rotation], _) = self.degrees(bodies);
        let increment = values.get(rotation).copied().unwrap_or(0.0);
        let start = self.arm();
        let end = self.rotation.turned(rotations, increment).to_space(self.arm);
        let found = Vec2::new(values[self.unknowns[0]], values[self.unknowns[1]]);
        let rate = rotations.rate(increment);
        let (force, share) = (unknown.force(self.force, found), unknown.force_derivative());
        Iterated {
            start,
            end,
            force_arm: start + (end - start) * at,
            force,
            fraction: share,
            rate,
            increment,
        }
    }

    pub fn add(
        &mut self,
        bodies: &Bodies,
        unknown: ForceUnknowns,
        arms: ArmRule,
        values: &[f64],
        out: &mut [f64],
    ) -> ForceSummary {
        let now = self.iterated(bodies, unknown, arms, values);
        self.transmit(bodies, now.force, now.force_arm, out);
        let ([x, y, _], [point_x, point_y, _]) = self.degrees(bodies);
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        let (centre, point) =
            (Vec2::new(value(x), value(y)), Vec2::new(value(point_x), value(point_y)));
        let turned = perpendicular((now.start + now.end) * 0.5)
            * arms.rotations.tangent_scaled(now.increment);
        let off = (point - centre) - turned;
        self.unknowns.iter().zip([off.x, off.y]).for_each(|(at, off)| out[*at] += off);
        self.size = self.arm.norm() + larger(centre.amax(), point.amax());
        let force = now.force.amax();
        ForceSummary {
            force,
            moment: force * self.arm.norm(),
            rotation: now.increment.abs(),
            ..ForceSummary::default()
        }
    }

    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        unknown: ForceUnknowns,
        arms: ArmRule,
        values: &[f64],
        movements: usize,
        tangent: &mut BandedMatrix,
    ) {
        let now = self.iterated(bodies, unknown, arms, values);
        let turned_arm = perpendicular(now.force_arm) * now.fraction;
        let place_arm = perpendicular(now.end) * now.rate;
        self.couple(bodies, now.fraction, turned_arm, place_arm, movements, tangent);
        let ([.., rotation], _) = self.degrees(bodies);
        if rotation < movements {
            tangent.add(rotation, rotation, arms.fraction * now.rate * now.end.dot(&now.force));
        }
    }

    pub fn add_coupling(&self, bodies: &Bodies, movements: usize, matrix: &mut BandedMatrix) {
        let arm = perpendicular(self.arm());
        self.couple(bodies, 1.0, arm, arm, movements, matrix);
    }

    fn couple(
        &self,
        bodies: &Bodies,
        share: f64,
        force_arm: Vec2,
        place_arm: Vec2,
        movements: usize,
        matrix: &mut BandedMatrix,
    ) {
        let (centre, point) = self.degrees(bodies);
        for component in 0..2 {
            let force = self.unknowns[component];
            let mut add = |at: usize, force_share: f64, place_share: f64| {
                if at < movements {
                    matrix.add(at, force, force_share);
                    matrix.add(force, at, place_share);
                }
            };
            add(point[component], share, 1.0);
            add(centre[component], -share, -1.0);
            add(centre[2], -force_arm[component], -place_arm[component]);
        }
    }

    pub fn transmit(&self, bodies: &Bodies, force: Vec2, arm: Vec2, out: &mut [f64]) {
        let ([x, y, rotation], [point_x, point_y, _]) = self.degrees(bodies);
        out[point_x] += force.x;
        out[point_y] += force.y;
        out[x] -= force.x;
        out[y] -= force.y;
        out[rotation] -= cross(arm, force);
    }

    /// Constraint violation of the link in a residual, divided by the sum of the length of its arm and its largest increment [-].
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let off = larger(residual[self.unknowns[0]].abs(), residual[self.unknowns[1]].abs());
        if off == 0.0 { 0.0 } else { off / self.size }
    }

    /// Distance of the linked point from its position in the body [length].
    pub fn gap(&self, bodies: &Bodies) -> f64 {
        let points = bodies[self.body].dynamics.control_points();
        ((points[self.point] - points[0]) - self.arm()).norm()
    }

    /// Centripetal acceleration of the linked point about the centre of mass [length/time²].
    pub fn centripetal(&self, bodies: &Bodies, rates: &[f64]) -> Vec2 {
        let ([.., rotation], _) = self.degrees(bodies);
        let spin = rates.get(rotation).copied().unwrap_or(0.0);
        self.arm() * (-spin * spin)
    }

    /// Velocity of the linked point, minus the velocity that follows from the rigid motion of the body [length/time].
    /// At the end of a step, the velocity violation is an error of second order, whose sign alternates from step to step.
    /// If accelerations are given instead of velocities, the result does not contain the centripetal acceleration of the arm.
    pub fn velocity_violation(&self, bodies: &Bodies, rates: &[f64]) -> Vec2 {
        let body = &bodies[self.body];
        let ([.., rotation], _) = self.degrees(bodies);
        let spin = rates.get(rotation).copied().unwrap_or(0.0);
        let relative = body.vector_at(self.point, rates) - body.vector_at(0, rates);
        relative - perpendicular(self.arm()) * spin
    }

    pub fn advance(
        &mut self,
        bodies: &Bodies,
        unknown: ForceUnknowns,
        arms: ArmRule,
        values: &[f64],
    ) {
        let now = self.iterated(bodies, unknown, arms, values);
        self.force = now.force;
        self.rotation = self.rotation.turned(arms.rotations, now.increment).normalised();
    }

    /// Calls `take` with the static stiffness of the link.
    /// The stiffness of the link is the geometric stiffness of its force plus a penalty stiffness [force/length].
    pub fn at_rest(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        span: &mut SpanStiffness,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let ([x, y, rotation], [point_x, point_y, _]) = self.degrees(bodies);
        let arm = perpendicular(self.arm());
        let rows = [[1.0, 0.0, -1.0, 0.0, -arm.x], [0.0, 1.0, 0.0, -1.0, -arm.y]];
        span.strains.clear();
        span.strains.extend(rows.as_flattened());
        span.stiffness.clear();
        span.stiffness.extend([stiffness; 2]);
        let pull = 0.5 * self.force.dot(&self.arm());
        span.twists.clear();
        span.twists.extend([0.0, 0.0, 0.0, 0.0, pull, 0.0, 0.0, 0.0, 0.0, 1.0]);
        span.rounding_fractions.clear();
        span.rounding_fractions.push(0.0);
        span.second_derivatives.clear();
        span.second_derivative_strains.clear();
        for (strain, along) in [self.arm().x, self.arm().y].into_iter().enumerate() {
            let p = [0.0, 0.0, 0.0, 0.0, 0.5 * along];
            span.add_second_derivative(strain, &p, &[0.0, 0.0, 0.0, 0.0, 1.0]);
        }
        take(&[point_x, point_y, x, y, rotation], span);
        let own = SpanStiffness {
            strains: vec![1.0],
            stiffness: vec![stiffness],
            ..SpanStiffness::default()
        };
        self.unknowns.iter().for_each(|at| take(&[*at], &own));
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.rotation.cos, self.rotation.sin, self.force.x, self.force.y]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rotation = Rotation { cos: next(), sin: next() };
        self.force = Vec2::new(next(), next());
    }
}
