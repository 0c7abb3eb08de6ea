//! A rigid link in a step: a point that keeps its place in the frame of a rigid body, and the force by which it does.
//!
//! ```text
//! Δx_p - Δx_b - χ J ā = 0        a = Λ r,   ā = ½ (a0 + a1),   χ = 2 tan(Δθ/2), the tangent-scaled increment itself
//! on the point -λ,   on the body λ and aτ × λ        aτ = (1-τ) a0 + τ a1,   τ = ½ but for generalized-α and at rest
//! ```
//!
//! `χ J ā = a1 - a0` whatever the increment, so that the point is in its place at every end of a step. With tangent-scaled increments and `τ = ½` the work
//! `λ·Δx_b + (ā × λ) Δω - λ·Δx_p` of the force vanishes; with `τ = ½` so do the sums of forces and of moments in the mean configuration.

use std::ops::{Add, Div};

use crate::beams::{ForceSummary, Rotation, RotationIncrement, SpanStiffness};
use crate::geometry::{Vec2, cross, larger, perpendicular};
use crate::linalg::BandedMatrix;
use crate::system::bodies::Bodies;

/// What the unknowns of the force of a rigid link are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceUnknowns {
    /// In a step of some duration: the impulse of the force [time].
    Step(f64),
    /// In a movement between two places at rest: the change of the force.
    AtRest,
}

impl ForceUnknowns {
    /// The force for such an unknown, where the last one was that [force].
    pub fn force<F>(self, last: F, unknown: F) -> F
    where
        F: Add<Output = F> + Div<f64, Output = F>,
    {
        match self {
            Self::Step(duration) => unknown / duration,
            Self::AtRest => last + unknown,
        }
    }

    /// The derivative of the force by the unknown [1/time, -].
    pub fn share(self) -> f64 {
        match self {
            Self::Step(duration) => 1.0 / duration,
            Self::AtRest => 1.0,
        }
    }
}

/// How a method takes the arms of rigid links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmRule {
    /// What rotation increments of the step stand for.
    pub rotations: RotationIncrement,
    /// The share `τ` of the step at which the arm of the force is taken [-].
    pub share: f64,
}

/// A point of a rigid body that is off its centre of mass.
#[derive(Debug, Clone)]
pub struct RigidLink {
    /// The number of the body.
    pub body: usize,
    /// The control point of the body that is held to its first one, the centre of mass.
    pub point: usize,
    /// The unknowns of the force.
    pub unknowns: [usize; 2],
    /// The place of the point in the frame of the body [length].
    arm: Vec2,
    /// That of the body at the start of the step.
    rotation: Rotation,
    /// `-λ` on the point: that of the last step, or at rest [force].
    force: Vec2,
    /// The movements of the iterate, which the violation is relative to [length].
    size: f64,
}

/// A rigid link in an iterate of a step.
struct Iterated {
    /// `a0`, `a1` and the arm of the force [length].
    start: Vec2,
    end: Vec2,
    force_arm: Vec2,
    /// `λ` [force].
    force: Vec2,
    /// How much of the force one of its unknowns is.
    share: f64,
    /// `dΔθ/dΔω` [-].
    rate: f64,
    increment: f64,
}

impl RigidLink {
    /// A rigid link to a control point of a body whose frame is turned by an angle [rad], with the unknowns of its force.
    pub fn new(body: usize, point: usize, unknowns: [usize; 2], at: [Vec2; 2], angle: f64) -> Self {
        let rotation = Rotation::by(angle);
        let [centre, end] = at;
        let arm = rotation.to_section(end - centre);
        Self { body, point, unknowns, arm, rotation, force: Vec2::zeros(), size: arm.norm() }
    }

    /// The arm from the centre to the point at the start of the step [length].
    pub fn arm(&self) -> Vec2 {
        self.rotation.to_space(self.arm)
    }

    /// The force of the rigid link in the last step, or at rest [force].
    pub fn force(&self) -> Vec2 {
        self.force
    }

    /// Exchanges the force for another [force].
    pub fn exchange_force(&mut self, other: &mut Vec2) {
        std::mem::swap(&mut self.force, other);
    }

    /// The unknowns of the centre and the point: x, y, and the rotation of the body.
    fn degrees(&self, bodies: &Bodies) -> ([usize; 3], [usize; 3]) {
        let of_body = &bodies[self.body].degrees_of_freedom;
        (of_body[0], of_body[self.point])
    }

    fn iterated(
        &self,
        bodies: &Bodies,
        unknown: ForceUnknowns,
        ArmRule { rotations, share: at }: ArmRule,
        values: &[f64],
    ) -> Iterated {
        let ([.., rotation], _) = self.degrees(bodies);
        let increment = values.get(rotation).copied().unwrap_or(0.0);
        let start = self.arm();
        let end = self.rotation.turned(rotations, increment).to_space(self.arm);
        let found = Vec2::new(values[self.unknowns[0]], values[self.unknowns[1]]);
        let rate = rotations.rate(increment);
        let (force, share) = (unknown.force(self.force, found), unknown.share());
        Iterated {
            start,
            end,
            force_arm: start + (end - start) * at,
            force,
            share,
            rate,
            increment,
        }
    }

    /// Adds the force of an iterate to a residual, and in the place of its unknowns by how much the point is off its place.
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

    /// Adds the derivatives of what [`add`](Self::add) adds; supported movements have none.
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
        let turned_arm = perpendicular(now.force_arm) * now.share;
        let place_arm = perpendicular(now.end) * now.rate;
        self.couple(bodies, now.share, turned_arm, place_arm, movements, tangent);
        let ([.., rotation], _) = self.degrees(bodies);
        if rotation < movements {
            tangent.add(rotation, rotation, arms.share * now.rate * now.end.dot(&now.force));
        }
    }

    /// Couples force and movements as at the start of a step, in the manner of a matrix of inertia: an impulse of the force and rates.
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

    /// Adds a force `λ` that acts on point and body with an arm to a residual.
    pub fn transmit(&self, bodies: &Bodies, force: Vec2, arm: Vec2, out: &mut [f64]) {
        let ([x, y, rotation], [point_x, point_y, _]) = self.degrees(bodies);
        out[point_x] += force.x;
        out[point_y] += force.y;
        out[x] -= force.x;
        out[y] -= force.y;
        out[rotation] -= cross(arm, force);
    }

    /// How far the point is off its place by a residual, relative to its movements and its arm [-].
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let off = larger(residual[self.unknowns[0]].abs(), residual[self.unknowns[1]].abs());
        if off == 0.0 { 0.0 } else { off / self.size }
    }

    /// How far the point is from its place [length].
    pub fn gap(&self, bodies: &Bodies) -> f64 {
        let points = bodies[self.body].dynamics.control_points();
        ((points[self.point] - points[0]) - self.arm()).norm()
    }

    /// The centripetal acceleration `-ω² a` of the point about the centre of mass, at some rates [length/time²].
    pub fn centripetal(&self, bodies: &Bodies, rates: &[f64]) -> Vec2 {
        let ([.., rotation], _) = self.degrees(bodies);
        let spin = rates.get(rotation).copied().unwrap_or(0.0);
        self.arm() * (-spin * spin)
    }

    /// The velocity of the point relative to its place in the frame of the body: as the velocities at the ends of steps are made, that is of second order and
    /// alternates [length/time]; so for
    /// accelerations, the turn of the arm set aside.
    pub fn velocity_violation(&self, bodies: &Bodies, rates: &[f64]) -> Vec2 {
        let body = &bodies[self.body];
        let ([.., rotation], _) = self.degrees(bodies);
        let spin = rates.get(rotation).copied().unwrap_or(0.0);
        let relative = body.vector_at(self.point, rates) - body.vector_at(0, rates);
        relative - perpendicular(self.arm()) * spin
    }

    /// Accepts the unknowns of a step or a movement, in which the body turned by an increment.
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

    /// Gives how the rigid link resists small movements, were it as stiff as that [force/length]: the point is held to its place, and its force turns with
    /// the body.
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
        span.doubts.clear();
        span.doubts.push(0.0);
        take(&[point_x, point_y, x, y, rotation], span);
        // Nothing asks for the force itself.
        let own = SpanStiffness {
            strains: vec![1.0],
            stiffness: vec![stiffness],
            ..SpanStiffness::default()
        };
        self.unknowns.iter().for_each(|at| take(&[*at], &own));
    }

    /// Appends the state of the rigid link at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.rotation.cos, self.rotation.sin, self.force.x, self.force.y]);
    }

    /// Takes the state of the rigid link back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rotation = Rotation { cos: next(), sin: next() };
        self.force = Vec2::new(next(), next());
    }
}
