//! Contact with an obstacle at one point in a step: a quadrature point of a beam, a particle or a point of a rigid body.

use super::definition::ObstacleShape;
use super::slip::slip_trial;
use crate::beams::{BodyPoint, ForceSummary, Movement, RotationIncrement};
use crate::elementary::square;
use crate::geometry::{Vec2, cross, larger, perpendicular};
use crate::integrators::Stage;
use crate::system::bodies::Body;
use crate::system::elements::collocation;
use crate::system::elements::contact::{
    ContactTime, DiscPath, GapChange, NormalContact, NormalForce, NormalLaw, PointFriction,
    sticking_damping,
};
use crate::system::elements::coordinate::Coordinate;
use crate::system::elements::elongation::ElongationTerm;
use crate::system::elements::mixed_force::ForceTarget;

#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub(super) shape: ObstacleShape,
    /// Radius of the bodies around their axes and points [length].
    pub(super) radius: f64,
    pub(super) law: NormalLaw,
    pub(super) friction: f64,
}

impl Surface {
    fn gap(&self, at: Vec2) -> (f64, Vec2) {
        match self.shape {
            ObstacleShape::HalfPlane { point, normal } => {
                (normal.dot(&(at - point)) - self.radius, normal)
            }
            ObstacleShape::Disc { centre, radius } => {
                let from_centre = at - centre;
                (from_centre.norm() - radius - self.radius, from_centre)
            }
        }
    }

    /// Returns true if a body whose axis lies in the convex hull of `positions` cannot touch the obstacle.
    /// All positions must then be farther than the radius of the body from a tangent of the obstacle, which faces the position `towards`.
    pub(super) fn is_beyond(
        &self,
        towards: Vec2,
        mut positions: impl Iterator<Item = Vec2>,
    ) -> bool {
        let (normal, offset) = match self.shape {
            ObstacleShape::HalfPlane { point, normal } => (normal, normal.dot(&point)),
            ObstacleShape::Disc { centre, radius } => {
                let towards = towards - centre;
                let length = towards.norm();
                if length == 0.0 {
                    return false;
                }
                let normal = towards / length;
                (normal, normal.dot(&centre) + radius)
            }
        };
        positions.all(|at| normal.dot(&at) - offset >= self.radius)
    }

    /// Gradient of the gap with respect to the position of a point [-].
    /// The argument is the vector from the centre of a disc to the point; for a half-plane, it has no effect.
    fn gradient(&self, from_obstacle: Vec2) -> Vec2 {
        let none = Vec2::zeros();
        GapTrial::new(self.shape, from_obstacle, none, RotationIncrement::Angle).slope
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct GapTrial {
    change: f64,
    pub(super) secant: Vec2,
    slope: Vec2,
    pub(super) secant_slope: [Vec2; 2],
    moved: f64,
}

impl GapTrial {
    const NONE: Self = Self {
        change: 0.0,
        secant: Vec2::new(0.0, 0.0),
        slope: Vec2::new(0.0, 0.0),
        secant_slope: [Vec2::new(0.0, 0.0); 2],
        moved: 0.0,
    };

    pub(super) fn along(normal: Vec2) -> Self {
        Self { secant: normal, slope: normal, ..Self::NONE }
    }

    pub(super) fn new(
        shape: ObstacleShape,
        start: Vec2,
        movement: Vec2,
        rotations: RotationIncrement,
    ) -> Self {
        let moved = movement.norm();
        match shape {
            ObstacleShape::HalfPlane { normal, .. } => Self {
                change: normal.dot(&movement),
                secant: normal,
                slope: normal,
                moved,
                ..Self::NONE
            },
            ObstacleShape::Disc { .. } => {
                let term = ElongationTerm::new(start, movement, rotations);
                let secant_slope =
                    [0, 1].map(|row| Vec2::new(term.bend(row, 0), term.bend(row, 1)));
                let ElongationTerm { change, secant, slope, .. } = term;
                Self { change, secant, slope, secant_slope, moved }
            }
        }
    }
}

/// Inertia of a body at a point, without the coupling between the control points of a beam.
#[derive(Debug, Clone, Copy, Default)]
struct PointInertia {
    /// Velocity per unit impulse [1/mass].
    mobility: f64,
    /// Angular velocity due to a unit angular impulse [1/(mass·length²)]; zero for a body that does not rotate.
    angular_mobility: f64,
    is_linked: bool,
}

impl PointInertia {
    fn new(place: &BodyPoint, body: &Body, diagonal: &[f64]) -> Self {
        let of = |degree: usize| diagonal.get(degree).copied().unwrap_or(f64::INFINITY);
        let sum = |component: usize| -> f64 {
            let mobility = |(at, share): (usize, f64)| {
                square(share) / of(body.degrees_of_freedom[at][component])
            };
            place.weights().map(mobility).sum()
        };
        let (mobility, angular) = (sum(0), sum(2));
        let is_linked = mobility.is_infinite();
        let whole: f64 = body.degrees_of_freedom.iter().map(|degrees| of(degrees[0])).sum();
        Self {
            mobility: if is_linked { 1.0 / whole } else { mobility },
            angular_mobility: if angular.is_finite() { angular } else { 0.0 },
            is_linked,
        }
    }

    fn arm(&self, position: Vec2, body: &Body) -> Vec2 {
        if self.is_linked { position - body.dynamics.control_points()[0] } else { Vec2::zeros() }
    }

    fn mass(&self, lever: f64) -> f64 {
        1.0 / (self.mobility + square(lever) * self.angular_mobility)
    }
}

#[derive(Debug, Clone)]
pub(super) struct ContactPoint {
    pub(super) place: BodyPoint,
    inertia: PointInertia,
    normal: NormalForce,
    /// Vector from the centre of a disc to the contact point at the start of the step [length]; the normal of a half-plane [-].
    start: Vec2,
    trial: GapTrial,
    linearised: GapTrial,
    /// Internal forces (minus the forces on the body) at the start of the step and in the present iterate [force].
    applied: [Vec2; 2],
    friction: Option<Box<PointFriction<3>>>,
    /// Friction moment applied in the present iterate, as an internal moment [force·length].
    applied_moment: f64,
}

impl ContactPoint {
    pub(super) fn new(place: BodyPoint, weight: f64) -> Self {
        Self {
            place,
            inertia: PointInertia::default(),
            normal: NormalForce::new(weight),
            start: Vec2::zeros(),
            trial: GapTrial::NONE,
            linearised: GapTrial::NONE,
            applied: [Vec2::zeros(); 2],
            friction: None,
            applied_moment: 0.0,
        }
    }

    pub(super) fn with_friction(self, surface: &Surface) -> Self {
        let friction = Box::new(PointFriction::new(surface.friction));
        Self { friction: Some(friction), ..self }
    }

    pub(super) fn begin(&mut self, surface: &Surface, body: &Body, diagonal: &[f64]) {
        self.inertia = PointInertia::new(&self.place, body, diagonal);
        self.locate(surface, body);
        self.update_masses(surface, body);
    }

    pub(super) fn is_closed(&self) -> bool {
        self.normal.is_closed()
    }

    fn position(&self, body: &Body) -> Vec2 {
        self.place.interpolate(body.dynamics.control_points())
    }

    /// Gap between body and obstacle at the start of the step [length].
    /// The gap of a closed contact is the sum of its increments, because the rounding error of positions would store energy.
    pub(super) fn present_gap(&self, surface: &Surface, body: &Body) -> f64 {
        match self.is_closed() {
            true => self.normal.gap.value,
            false => surface.gap(self.position(body)).0.max(0.0),
        }
    }

    fn locate(&mut self, surface: &Surface, body: &Body) {
        let (gap, start) = surface.gap(self.position(body));
        self.start = start;
        if !self.is_closed() {
            self.normal.gap = Coordinate::from(gap);
        }
        if self.inertia.is_linked {
            self.update_masses(surface, body);
        }
    }

    fn update_masses(&mut self, surface: &Surface, body: &Body) {
        let [mass, along] = self.masses(surface, body);
        self.normal.mass = mass;
        if let Some(friction) = &mut self.friction {
            friction.set_scales(self.normal.stiffness(&surface.law), along, surface.law.damping);
        }
    }

    /// Effective masses for impulses along the normal and along the surface [mass].
    fn masses(&self, surface: &Surface, body: &Body) -> [f64; 2] {
        let position = self.position(body);
        let normal = surface.gradient(surface.gap(position).1);
        let arm = self.inertia.arm(position, body);
        let levers = [cross(arm, normal), cross(arm, perpendicular(normal)) - surface.radius];
        levers.map(|lever| self.inertia.mass(lever))
    }

    pub(super) fn begin_movement(&mut self, surface: &Surface, body: &Body) {
        self.locate(surface, body);
        self.normal.tension.force = self.normal.tension.last;
        self.applied = [Vec2::zeros(); 2];
        self.release_friction();
    }

    fn release_friction(&mut self) {
        self.applied_moment = 0.0;
        if let Some(friction) = &mut self.friction {
            friction.release();
        }
    }

    pub(super) fn begin_step(&mut self) {
        self.normal.tension.begin_step();
        if let Some(friction) = &mut self.friction {
            friction.begin_step();
        }
    }

    pub(super) fn set_approach(&mut self, surface: &Surface, velocity: Vec2) {
        let rate = surface.gradient(self.start).dot(&velocity);
        (self.normal.approach, self.normal.last_rate) = (rate.abs(), rate);
    }

    pub(super) fn crosses(&self, surface: &Surface, body: &Body, movement: Vec2) -> bool {
        let ObstacleShape::Disc { radius, .. } = surface.shape else { return false };
        let (_, start) = surface.gap(self.position(body));
        let radius = radius + surface.radius;
        DiscPath { start, movement, radius, is_closed: self.is_closed() }.passes_through()
    }

    pub(super) fn open(&mut self) {
        self.normal.open();
        self.linearised = GapTrial::NONE;
        self.applied = [Vec2::zeros(); 2];
        self.release_friction();
    }

    fn evaluate(&mut self, surface: &Surface, time: ContactTime, body: &Body, values: &[f64]) {
        let movement = match time.stage {
            Stage::Start => [0.0; 3],
            _ => body.at(&self.place, values),
        };
        self.follow(surface, time, movement);
    }

    fn follow(&mut self, surface: &Surface, time: ContactTime, movement: Movement) {
        let rotations = collocation(time.stage).rotations;
        let displacement = Vec2::new(movement[0], movement[1]);
        self.trial = GapTrial::new(surface.shape, self.start, displacement, rotations);
        if let Some(friction) = &mut self.friction {
            friction.evaluate(slip_trial(&self.trial, surface.radius, movement));
        }
    }

    /// Normal force in the present iterate, with the duration of the step; `None` for a static increment, in which friction does not act.
    fn normal_contact(&self, time: ContactTime) -> Option<NormalContact> {
        let duration = time.duration;
        let contact =
            NormalContact { force: -self.normal.tension.force, duration, share: time.share() };
        duration.is_finite().then_some(contact)
    }

    pub(super) fn vector(&self, body: &Body, values: &[f64]) -> Vec2 {
        let [x, y, _] = body.at(&self.place, values);
        Vec2::new(x, y)
    }

    pub(super) fn add_force(
        &mut self,
        surface: &Surface,
        time: ContactTime,
        (body, values): (&Body, &[f64]),
        out: &mut [f64],
    ) -> ForceSummary {
        self.evaluate(surface, time, body, values);
        let GapTrial { change, secant, moved, .. } = self.trial;
        let target = self.normal.target(&surface.law, time, change);
        if time.stage == Stage::Start {
            self.applied[0] = secant * (time.weight * target.force);
            self.scatter(body, self.applied[0], out);
            return ForceSummary { force: target.force.abs(), ..ForceSummary::default() };
        }
        let mut strain_mismatch = self.normal.compare(&surface.law, target, moved);
        let force = self.normal.tension.force;
        let mut moment = 0.0;
        self.applied[1] = secant * (time.weight * force);
        if let (Some(contact), Some(friction)) = (self.normal_contact(time), &mut self.friction) {
            strain_mismatch = larger(strain_mismatch, friction.compare(contact));
            let [x, y, applied] = friction.present().map(|by| by * time.weight);
            self.applied_moment = applied;
            // The scale of the moment includes the normal force, because its rounding error causes an error of the moment.
            moment = applied.abs() + surface.radius * force.abs();
            self.applied[1] += Vec2::new(x, y);
            self.scatter_moment(body, applied, out);
        }
        self.scatter(body, self.applied[1], out);
        ForceSummary { force: force.abs(), moment, strain_mismatch, ..ForceSummary::default() }
    }

    pub(super) fn add_linearised(
        &mut self,
        surface: &Surface,
        time: ContactTime,
        (body, values): (&Body, &[f64]),
        out: &mut [f64],
        tangent: &mut dyn FnMut(usize, usize, f64),
    ) {
        self.evaluate(surface, time, body, values);
        let target = self.normal.linearisation_target(&surface.law, time, self.trial.change);
        self.normal.tension.linearise(target);
        self.linearised = self.trial;
        let GapTrial { secant, slope, secant_slope, .. } = self.trial;
        self.scatter(body, secant * (time.weight * target.force), out);
        let (stiffness, force) =
            (time.weight * target.stiffness, time.weight * self.normal.tension.force);
        let derivative =
            [0, 1].map(|row| slope * (stiffness * secant[row]) + secant_slope[row] * force);
        for (row, share) in self.place.weights() {
            for (column, other) in self.place.weights() {
                let (rows, columns) =
                    (body.degrees_of_freedom[row], body.degrees_of_freedom[column]);
                for (component, by) in derivative.iter().enumerate() {
                    for axis in 0..2 {
                        let value = share * other * by[axis];
                        tangent(rows[component], columns[axis], value);
                    }
                }
            }
        }
        self.add_linearised_friction(time, body, out, tangent);
    }

    fn add_linearised_friction(
        &mut self,
        time: ContactTime,
        body: &Body,
        out: &mut [f64],
        tangent: &mut dyn FnMut(usize, usize, f64),
    ) {
        let (Some(contact), Some(friction)) = (self.normal_contact(time), &mut self.friction)
        else {
            return;
        };
        friction.linearise(contact);
        let force = friction.condensed(-self.normal.tension.mismatch).map(|by| by * time.weight);
        let normal_slope = self.linearised.slope * -self.normal.tension.stiffness;
        let derivative = friction.tangent([normal_slope.x, normal_slope.y, 0.0]);
        self.scatter_friction(body, force, out);
        for (row, share) in self.place.weights() {
            for (column, other) in self.place.weights() {
                let (rows, columns) =
                    (body.degrees_of_freedom[row], body.degrees_of_freedom[column]);
                for (&row, by) in rows.iter().zip(&derivative) {
                    for (&column, by) in columns.iter().zip(by) {
                        tangent(row, column, time.weight * share * other * by);
                    }
                }
            }
        }
    }

    pub(super) fn add_mismatch_force(&self, body: &Body, weight: f64, out: &mut [f64]) {
        self.scatter(body, self.linearised.secant * (weight * self.normal.tension.mismatch), out);
        if let Some(friction) = &self.friction {
            let missing = friction.missing(-self.normal.tension.mismatch).map(|by| by * weight);
            self.scatter_friction(body, missing, out);
        }
    }

    pub(super) fn correct(&mut self, body: &Body, correction: &[f64]) {
        let moved @ [x, y, _] = body.at(&self.place, correction);
        let tension = &mut self.normal.tension;
        let before = tension.force;
        tension.correct(self.linearised.slope.dot(&Vec2::new(x, y)));
        if let Some(friction) = &mut self.friction {
            friction.correct(moved, before - tension.force);
        }
    }

    pub(super) fn scatter(&self, body: &Body, force: Vec2, out: &mut [f64]) {
        for (at, share) in self.place.weights() {
            let [x, y, _] = body.degrees_of_freedom[at];
            out[x] += share * force.x;
            out[y] += share * force.y;
        }
    }

    /// Adds a force [force] and a moment [force·length] at the contact point to `out`.
    fn scatter_friction(&self, body: &Body, [x, y, moment]: Movement, out: &mut [f64]) {
        self.scatter(body, Vec2::new(x, y), out);
        self.scatter_moment(body, moment, out);
    }

    fn scatter_moment(&self, body: &Body, moment: f64, out: &mut [f64]) {
        for (at, share) in self.place.weights() {
            out[body.degrees_of_freedom[at][2]] += share * moment;
        }
    }

    fn interpolate(&self, at_points: &[Movement]) -> Movement {
        self.place.weights().fold([0.0; 3], |sum, (at, share)| {
            [0, 1, 2].map(|component| sum[component] + at_points[at][component] * share)
        })
    }

    /// Force on the body in the completed step [force].
    pub(super) fn mean_force(&self) -> Vec2 {
        -(self.applied[0] + self.applied[1])
    }

    /// Angular impulse of the contact force on the body about the origin in the completed step [force·length·time].
    pub(super) fn angular_impulse(&self, body: &Body, duration: f64) -> f64 {
        let [x, y, _] = self.interpolate(body.moved());
        let middle = self.position(body) + Vec2::new(x, y) * 0.5;
        let of_force = cross(middle, self.mean_force() * duration);
        of_force - self.applied_moment * duration
    }

    pub(super) fn closed(&self, surface: &Surface, body: &Body) -> Option<ClosedContact> {
        if !self.is_closed() {
            return None;
        }
        let from_obstacle = surface.gap(self.position(body)).1;
        let tension = self.normal.elastic(&surface.law, Stage::End, 0.0);
        let radius_of_curvature = match surface.shape {
            ObstacleShape::HalfPlane { .. } => f64::INFINITY,
            ObstacleShape::Disc { .. } => from_obstacle.norm(),
        };
        let gradient = surface.gradient(from_obstacle);
        let [mass, along] = self.masses(surface, body);
        let damping = self.normal.damping(&surface.law, tension, mass).0;
        let stiffness = self.normal.stiffness(&surface.law);
        let sticking_damping = sticking_damping(stiffness, along, surface.law.damping);
        let radius = surface.radius;
        Some(ClosedContact {
            gradient,
            tension,
            damping,
            sticking_damping,
            radius,
            radius_of_curvature,
        })
    }

    pub(super) fn add_force_at_start(
        &self,
        contact: &ClosedContact,
        body: &Body,
        rates: &[Movement],
        out: &mut [f64],
    ) {
        let rates @ [x, y, _] = self.interpolate(rates);
        let tension = contact.tension(Vec2::new(x, y));
        self.scatter(body, contact.gradient * tension, out);
        if let Some(friction) = &self.friction {
            let gap = GapTrial::along(contact.gradient);
            let rates = slip_trial(&gap, contact.radius, rates);
            let force = friction.at_start(&rates, -tension, contact.sticking_damping);
            self.scatter_friction(body, force, out);
        }
    }

    /// Ends a step. Returns the energy dissipated in the contact [energy].
    pub(super) fn advance(&mut self, surface: &Surface, time: ContactTime, body: &Body) -> f64 {
        self.follow(surface, time, self.interpolate(body.moved()));
        let GapTrial { change, moved, .. } = self.trial;
        let mut lost = self.normal.advance(&surface.law, time, GapChange { value: change, moved });
        if let (Some(contact), Some(friction)) = (self.normal_contact(time), &mut self.friction) {
            lost += friction.advance(contact);
        }
        lost
    }

    /// Mean rate of the gap in the last step [length/time].
    pub(super) fn rate(&self) -> f64 {
        self.normal.last_rate
    }

    pub(super) fn energy(&self, surface: &Surface) -> f64 {
        let energy = self.normal.energy(&surface.law);
        self.friction.as_ref().map_or(energy, |friction| energy + friction.energy())
    }

    /// Friction force on the body in the last step, positive to the right of the normal [force].
    pub(super) fn friction_force(&self) -> f64 {
        self.friction.as_ref().map_or(0.0, |friction| friction.last())
    }

    /// Contact force in the last step, averaged over the step [force].
    pub(super) fn force(&self) -> f64 {
        self.normal.last()
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        self.normal.save(state);
        if let Some(friction) = &self.friction {
            friction.save(state);
        }
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.normal.restore(next);
        if let Some(friction) = &mut self.friction {
            friction.restore(next);
        }
    }
}

pub(super) struct ClosedContact {
    pub(super) gradient: Vec2,
    pub(super) tension: ForceTarget,
    pub(super) damping: f64,
    /// Damping coefficient of the friction force while the contact sticks [force·time/length].
    pub(super) sticking_damping: f64,
    pub(super) radius: f64,
    /// Distance of the contact point from the centre of a disc [length]; infinite for a half-plane.
    pub(super) radius_of_curvature: f64,
}

impl ClosedContact {
    /// Tension if the contact point has the given velocity [force]. It is never positive.
    fn tension(&self, velocity: Vec2) -> f64 {
        (self.tension.force + self.damping * self.gradient.dot(&velocity)).min(0.0)
    }
}
