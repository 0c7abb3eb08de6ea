//! Contact point: one quadrature point of a beam, a particle or a point of a rigid body, in a step.

use super::definition::ObstacleShape;
use super::friction::{NormalContact, PointFriction};
use super::law::ContactLaw;
use crate::beams::{BodyPoint, ForceSummary, Movement, RateCollocation, RotationIncrement};
use crate::elementary::square;
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::Stage;
use crate::system::bodies::Body;
use crate::system::elements::collocation;
use crate::system::elements::coordinate::{Coordinate, rounding_error};
use crate::system::elements::elongation::ElongationTerm;
use crate::system::elements::mixed_force::{CORNER_TOLERANCE, ForceTarget, MixedForce};

/// Stiffness relative to the impedance of the body, up to which a contact is linearised at the present iterate.
pub(super) const SOFT: f64 = 1e-2;

/// Largest ratio of the path of an open point in a step to its chord inside a disc. Shorter chords are ignored.
const LONGEST_PATH: f64 = 1e3;

/// Surface of an obstacle with its contact law.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub(super) shape: ObstacleShape,
    /// Radius of the bodies around their axes and points [length].
    pub(super) radius: f64,
    pub(super) law: ContactLaw,
    pub(super) damping: f64,
    /// Coefficient of friction [-].
    pub(super) friction: f64,
}

impl Surface {
    /// Gap at a position, and the vector from the obstacle to this position.
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

    /// Returns true if all positions lie beyond the tangent of the obstacle that faces the position `towards`.
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

    /// Gradient of the gap at the given vector from the obstacle [-].
    fn gradient(&self, from_obstacle: Vec2) -> Vec2 {
        let none = Vec2::zeros();
        GapTrial::new(self.shape, from_obstacle, none, RotationIncrement::Angle).slope
    }
}

/// Change of the gap in an iterate, and its derivatives.
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

    /// Zero change of the gap, for a surface with the given normal.
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

/// Time and stage at which the force of a contact is evaluated.
#[derive(Clone, Copy)]
pub(super) struct ContactTime {
    pub(super) stage: Stage,
    /// Factor of the force [-].
    pub(super) weight: f64,
    /// Coefficients of rates; `None` if damping is not evaluated.
    pub(super) rates: Option<RateCollocation>,
    /// Duration of the step; infinite for an increment of zero duration [time].
    pub(super) duration: f64,
}

impl ContactTime {
    /// Share of the damping force in the tension. Methods with forces at both ends of a step evaluate the damping once per step, at the end.
    fn share(&self) -> f64 {
        if self.stage == Stage::End { self.weight } else { 1.0 }
    }
}

#[derive(Debug, Clone)]
pub(super) struct ContactPoint {
    pub(super) place: BodyPoint,
    /// Quadrature weight [length]; 1 for a point.
    weight: f64,
    /// Effective mass of the body at the point [mass]. It scales the search for the force and limits the damping.
    mass: f64,
    gap: Coordinate,
    /// Vector from the obstacle to the point at the start of the step [length].
    start: Vec2,
    /// Speed at which the point approached the obstacle before the contact [length/time].
    approach: f64,
    last_rate: f64,
    tension: MixedForce,
    trial: GapTrial,
    linearised: GapTrial,
    /// Applied forces at the start of the step and in the present iterate [force].
    applied: [Vec2; 2],
    /// Friction; `None` without friction.
    friction: Option<Box<PointFriction>>,
}

impl ContactPoint {
    pub(super) fn new(place: BodyPoint, weight: f64) -> Self {
        Self {
            place,
            weight,
            mass: 0.0,
            gap: Coordinate::default(),
            start: Vec2::zeros(),
            approach: 0.0,
            last_rate: 0.0,
            tension: MixedForce::default(),
            trial: GapTrial::NONE,
            linearised: GapTrial::NONE,
            applied: [Vec2::zeros(); 2],
            friction: None,
        }
    }

    /// Adds friction to the contact point, with the coefficient of friction of the obstacle.
    pub(super) fn with_friction(self, surface: &Surface) -> Self {
        let friction = Box::new(PointFriction::new(surface.friction, surface.radius));
        Self { friction: Some(friction), ..self }
    }

    /// Prepares the start of a simulation. Computes the effective mass from the diagonal of the inertia matrix.
    /// For a point of a rigid body, the effective mass is the mass of the body.
    pub(super) fn begin(&mut self, surface: &Surface, body: &Body, diagonal: &[f64]) {
        self.locate(surface, body);
        let of = |degrees: &[usize; 3]| diagonal.get(degrees[0]).copied().unwrap_or(f64::INFINITY);
        let mobility = |(at, share): (usize, f64)| square(share) / of(&body.degrees_of_freedom[at]);
        let mass = 1.0 / self.place.weights().map(mobility).sum::<f64>();
        let whole = body.degrees_of_freedom.iter().map(of).sum();
        self.mass = if mass > 0.0 { mass } else { whole };
        let (stiffness, mass) = (self.stiffness(surface), self.mass);
        if let Some(friction) = &mut self.friction {
            friction.begin(stiffness, mass, surface.damping);
        }
    }

    pub(super) fn is_closed(&self) -> bool {
        self.gap.value < 0.0
    }

    fn position(&self, body: &Body) -> Vec2 {
        self.place.interpolate(body.dynamics.control_points())
    }

    /// Gap at the start of the step. A closed gap is the sum of its increments, because the rounding error of positions would store energy.
    pub(super) fn present_gap(&self, surface: &Surface, body: &Body) -> f64 {
        match self.is_closed() {
            true => self.gap.value,
            false => surface.gap(self.position(body)).0.max(0.0),
        }
    }

    /// Updates the gap and the direction at the start of a step.
    fn locate(&mut self, surface: &Surface, body: &Body) {
        let (gap, start) = surface.gap(self.position(body));
        self.start = start;
        if !self.is_closed() {
            self.gap = Coordinate::from(gap);
        }
    }

    pub(super) fn begin_movement(&mut self, surface: &Surface, body: &Body) {
        self.locate(surface, body);
        self.tension.force = self.tension.last;
        self.applied = [Vec2::zeros(); 2];
        self.release_friction();
    }

    fn release_friction(&mut self) {
        if let Some(friction) = &mut self.friction {
            friction.release();
        }
    }

    /// Prepares a step that starts with a velocity of the point. The velocity of an open contact is its approach speed.
    pub(super) fn begin_step(&mut self, surface: &Surface, velocity: Vec2) {
        self.tension.begin_step();
        if let Some(friction) = &mut self.friction {
            friction.begin_step();
        }
        if !self.is_closed() {
            self.approach = surface.gradient(self.start).dot(&velocity).abs();
        }
    }

    /// Returns true if a straight movement leads through a disc: from outside to outside, or around its centre by more than 60°.
    pub(super) fn crosses(&self, surface: &Surface, movement: Vec2) -> bool {
        let ObstacleShape::Disc { radius, .. } = surface.shape else { return false };
        let (radius, length) = (radius + surface.radius, movement.norm());
        let fraction = -self.start.dot(&movement) / square(length);
        let is_within = fraction > 0.0 && fraction < 1.0;
        let deepest = self.start + movement * fraction;
        let nearest_end = self.start.norm().min((self.start + movement).norm());
        let half_chord_squared = square(nearest_end.min(radius)) - deepest.norm_squared();
        let is_open = nearest_end >= radius && !self.is_closed();
        let allowed = if is_open { length / LONGEST_PATH } else { nearest_end };
        is_within && 2.0 * half_chord_squared.max(0.0).sqrt() > allowed
    }

    /// Removes the force, because no contact is possible in the present iterate.
    pub(super) fn open(&mut self) {
        self.tension.force = 0.0;
        self.tension.mismatch = 0.0;
        self.linearised = GapTrial::NONE;
        self.applied[1] = Vec2::zeros();
        self.release_friction();
    }

    /// Tension that the law requires for a change of the gap, without the damping.
    fn elastic(&self, surface: &Surface, stage: Stage, change: f64) -> ForceTarget {
        let gap = self.gap.value;
        let law = match stage {
            Stage::Start => ForceTarget { stiffness: 0.0, ..surface.law.at(gap) },
            Stage::End => surface.law.at(gap + change),
            Stage::Midpoint | Stage::DampedMidpoint(_) => surface.law.mean(gap, change),
        };
        ForceTarget { force: self.weight * law.force, stiffness: self.weight * law.stiffness }
    }

    /// Tension that the law requires for a change of the gap. A contact does not pull, so it is not positive.
    fn target(&self, surface: &Surface, time: ContactTime, change: f64) -> ForceTarget {
        let elastic = self.elastic(surface, time.stage, change);
        let Some(rates) = time.rates.filter(|_| surface.damping > 0.0) else { return elastic };
        let (damping, by_change) = self.damping(surface, elastic);
        let rate = change * rates.by_change - self.last_rate * rates.by_last;
        let share = 1.0 / time.share();
        let force = elastic.force + share * damping * rate;
        let most = self.largest_tension(surface, time);
        if force > most {
            return ForceTarget { force: most, stiffness: 0.0 };
        }
        let stiffness = elastic.stiffness + share * (damping * rates.by_change + by_change * rate);
        ForceTarget { force, stiffness }
    }

    /// Largest tension with which the contact does not pull. At the end of a step, it balances the tension at the start.
    fn largest_tension(&self, surface: &Surface, time: ContactTime) -> f64 {
        let share = time.share();
        (1.0 - 1.0 / share) * self.elastic(surface, Stage::Start, 0.0).force
    }

    /// Damping coefficient at an elastic tension, and its derivative with respect to the change of the gap.
    ///
    /// The damping coefficient is limited to its largest value in an impact of a free mass, so that a resting contact is not damped without bound.
    fn damping(&self, surface: &Surface, elastic: ForceTarget) -> (f64, f64) {
        if elastic.force == 0.0 {
            return (0.0, 0.0);
        }
        let most = (self.stiffness(surface) * self.mass).sqrt();
        let by_force = -elastic.force / self.approach;
        match by_force < most {
            true => {
                let by_change = -elastic.stiffness / self.approach;
                (surface.damping * by_force, surface.damping * by_change)
            }
            false => (surface.damping * most, 0.0),
        }
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
            friction.evaluate(&self.trial, movement);
        }
    }

    /// Normal contact in the present iterate; `None` for an increment of zero duration, in which friction does not act.
    fn normal_contact(&self, time: ContactTime) -> Option<NormalContact> {
        let duration = time.duration;
        let contact = NormalContact { force: -self.tension.force, duration, share: time.share() };
        duration.is_finite().then_some(contact)
    }

    /// Vector at the point, interpolated from values of the unknowns.
    pub(super) fn vector(&self, body: &Body, values: &[f64]) -> Vec2 {
        let [x, y, _] = body.at(&self.place, values);
        Vec2::new(x, y)
    }

    /// Adds the present force to `out`. Returns its magnitude and its relative difference from the law.
    pub(super) fn add_force(
        &mut self,
        surface: &Surface,
        time: ContactTime,
        (body, values): (&Body, &[f64]),
        out: &mut [f64],
    ) -> ForceSummary {
        self.evaluate(surface, time, body, values);
        let GapTrial { change, secant, .. } = self.trial;
        let target = self.target(surface, time, change);
        if time.stage == Stage::Start {
            self.applied[0] = secant * (time.weight * target.force);
            self.scatter(body, self.applied[0], out);
            return ForceSummary { force: target.force.abs(), ..ForceSummary::default() };
        }
        let mut strain_mismatch = self.compare(surface, target);
        let force = self.tension.force;
        let mut moment = 0.0;
        self.applied[1] = secant * (time.weight * force);
        if let (Some(contact), Some(friction)) = (self.normal_contact(time), &mut self.friction) {
            strain_mismatch = larger(strain_mismatch, friction.compare(contact));
            let [x, y, applied] = friction.apply(time.weight);
            // The rounding error of the normal force limits the accuracy of the moment.
            moment = applied.abs() + surface.radius * force.abs();
            self.applied[1] += Vec2::new(x, y);
            self.scatter_moment(body, applied, out);
        }
        self.scatter(body, self.applied[1], out);
        ForceSummary { force: force.abs(), moment, strain_mismatch, ..ForceSummary::default() }
    }

    /// Adds the contact force to `out` and its derivatives to `tangent`, after elimination of the law of contact.
    pub(super) fn add_linearised(
        &mut self,
        surface: &Surface,
        time: ContactTime,
        (body, values): (&Body, &[f64]),
        out: &mut [f64],
        tangent: &mut dyn FnMut(usize, usize, f64),
    ) {
        self.evaluate(surface, time, body, values);
        let target = self.linearisation_target(surface, time);
        self.tension.linearise(target);
        self.linearised = self.trial;
        let GapTrial { secant, slope, secant_slope, .. } = self.trial;
        self.scatter(body, secant * (time.weight * target.force), out);
        let (stiffness, force) = (time.weight * target.stiffness, time.weight * self.tension.force);
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
        friction.linearise(contact, 2.0 * self.mass / square(time.duration));
        let force = friction.condensed(-self.tension.mismatch).map(|by| by * time.weight);
        let normal_slope = self.linearised.slope * -self.tension.stiffness;
        let derivative = friction.tangent(normal_slope);
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

    /// Target of a linearisation. A stiff contact intersects its law with the impedance of the body, in equilibria with a secant estimate of it.
    fn linearisation_target(&mut self, surface: &Surface, time: ContactTime) -> ForceTarget {
        let change = self.trial.change;
        let estimate = self.tension.impedance(change);
        let impedance = match time.duration.is_finite() {
            true => Some(2.0 * self.mass / square(time.duration)),
            false => estimate,
        };
        let is_stiff = |impedance: &f64| self.stiffness(surface) > SOFT * impedance;
        match impedance.filter(is_stiff) {
            Some(impedance) if impedance > 0.0 => {
                ForceTarget::intersection(change, self.tension.force, impedance, |change| {
                    self.target(surface, time, change)
                })
            }
            _ => self.target(surface, time, change),
        }
    }

    /// Stiffness at first touch [force/length].
    fn stiffness(&self, surface: &Surface) -> f64 {
        self.weight * surface.law.stiffness()
    }

    /// Compares the tension with its target. Returns the relative difference; zero if the rounding error of the increments explains it.
    fn compare(&mut self, surface: &Surface, target: ForceTarget) -> f64 {
        let GapTrial { moved, .. } = self.trial;
        let stiffness = larger(target.stiffness, self.stiffness(surface));
        let extent = CORNER_TOLERANCE * larger(moved, self.gap.value.abs());
        let missed = self.tension.compare(ForceTarget { stiffness, ..target }, extent);
        let is_rounding = self.tension.missing_change().abs() <= rounding_error(moved);
        if is_rounding { 0.0 } else { missed }
    }

    pub(super) fn add_mismatch_force(&self, body: &Body, weight: f64, out: &mut [f64]) {
        self.scatter(body, self.linearised.secant * (weight * self.tension.mismatch), out);
        if let Some(friction) = &self.friction {
            let missing = friction.missing(-self.tension.mismatch).map(|by| by * weight);
            self.scatter_friction(body, missing, out);
        }
    }

    pub(super) fn correct(&mut self, body: &Body, correction: &[f64]) {
        let moved @ [x, y, _] = body.at(&self.place, correction);
        let before = self.tension.force;
        self.tension.correct(self.linearised.slope.dot(&Vec2::new(x, y)));
        if let Some(friction) = &mut self.friction {
            friction.correct(moved, before - self.tension.force);
        }
    }

    pub(super) fn scatter(&self, body: &Body, force: Vec2, out: &mut [f64]) {
        for (at, share) in self.place.weights() {
            let [x, y, _] = body.degrees_of_freedom[at];
            out[x] += share * force.x;
            out[y] += share * force.y;
        }
    }

    /// Adds a force [force] and a moment [force·length] at the point to `out`.
    fn scatter_friction(&self, body: &Body, [x, y, moment]: Movement, out: &mut [f64]) {
        self.scatter(body, Vec2::new(x, y), out);
        self.scatter_moment(body, moment, out);
    }

    fn scatter_moment(&self, body: &Body, moment: f64, out: &mut [f64]) {
        for (at, share) in self.place.weights() {
            out[body.degrees_of_freedom[at][2]] += share * moment;
        }
    }

    /// Interpolates displacements and rotations that are given at the control points of the body.
    fn interpolate(&self, at_points: &[Movement]) -> Movement {
        self.place.weights().fold([0.0; 3], |sum, (at, share)| {
            [0, 1, 2].map(|component| sum[component] + at_points[at][component] * share)
        })
    }

    /// Force on the body in the completed step [force].
    pub(super) fn mean_force(&self) -> Vec2 {
        -(self.applied[0] + self.applied[1])
    }

    /// Angular impulse on the body about the origin in the completed step [force·length·time].
    pub(super) fn angular_impulse(&self, body: &Body, duration: f64) -> f64 {
        let [x, y, _] = self.interpolate(body.moved());
        let middle = self.position(body) + Vec2::new(x, y) * 0.5;
        let of_force = cross(middle, self.mean_force() * duration);
        self.friction.as_ref().map_or(of_force, |by| of_force + by.mean_moment() * duration)
    }

    /// State of a closed contact at the start of the step; `None` for an open contact.
    pub(super) fn closed(&self, surface: &Surface, body: &Body) -> Option<ClosedContact> {
        if !self.is_closed() {
            return None;
        }
        let from_obstacle = surface.gap(self.position(body)).1;
        let tension = self.elastic(surface, Stage::End, 0.0);
        let radius_of_curvature = match surface.shape {
            ObstacleShape::HalfPlane { .. } => f64::INFINITY,
            ObstacleShape::Disc { .. } => from_obstacle.norm(),
        };
        let gradient = surface.gradient(from_obstacle);
        let damping = self.damping(surface, tension).0;
        Some(ClosedContact { gradient, tension, damping, radius_of_curvature })
    }

    /// Adds the force of a closed contact at the start of the step, for rates at the control points of the body.
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
            self.scatter_friction(body, friction.at_start(contact.gradient, -tension, rates), out);
        }
    }

    /// Ends a step. Returns the dissipated energy [energy].
    pub(super) fn advance(&mut self, surface: &Surface, time: ContactTime, body: &Body) -> f64 {
        self.follow(surface, time, self.interpolate(body.moved()));
        let GapTrial { change, .. } = self.trial;
        let elastic = self.elastic(surface, time.stage, change);
        let mut lost = match surface.damping > 0.0 && time.duration.is_finite() {
            true => time.share() * (self.tension.force - elastic.force) * change,
            false => 0.0,
        };
        let target = self.target(surface, time, change);
        self.gap = self.gap.after(change);
        if self.compare(surface, target) == 0.0 {
            // The gap fits the tension, so that the rounding error of increments stores no energy.
            self.gap = self.gap.after(self.tension.missing_change());
        }
        if let (Some(contact), Some(friction)) = (self.normal_contact(time), &mut self.friction) {
            lost += friction.advance(contact);
        }
        self.tension.last = self.tension.force;
        self.last_rate = if time.duration.is_finite() { change / time.duration } else { 0.0 };
        lost
    }

    /// Mean rate of the gap in the last step [length/time].
    pub(super) fn rate(&self) -> f64 {
        self.last_rate
    }

    pub(super) fn energy(&self, surface: &Surface) -> f64 {
        let energy = self.weight * surface.law.energy(self.gap.value);
        self.friction.as_ref().map_or(energy, |friction| energy + friction.energy())
    }

    /// Friction force on the body in the last step, positive to the right of the normal [force].
    pub(super) fn friction_force(&self) -> f64 {
        self.friction.as_ref().map_or(0.0, |friction| friction.last())
    }

    /// Contact force in the last step, averaged over the step [force].
    pub(super) fn force(&self) -> f64 {
        -self.tension.last
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        let Self { gap, approach, last_rate, tension, .. } = self;
        state.extend([gap.value, gap.rest, *approach, *last_rate, tension.last]);
        if let Some(friction) = &self.friction {
            friction.save(state);
        }
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.gap = Coordinate { value: next(), rest: next() };
        (self.approach, self.last_rate, self.tension.last) = (next(), next(), next());
        if let Some(friction) = &mut self.friction {
            friction.restore(next);
        }
    }
}

/// Closed contact at the start of a step.
pub(super) struct ClosedContact {
    /// Gradient of the gap [-].
    pub(super) gradient: Vec2,
    /// Tension [force] and stiffness [force/length].
    pub(super) tension: ForceTarget,
    /// Damping coefficient [force·time/length].
    pub(super) damping: f64,
    /// Distance from the centre of a disc [length]; infinite for a half-plane.
    pub(super) radius_of_curvature: f64,
}

impl ClosedContact {
    /// Tension for a velocity of the point [force].
    fn tension(&self, velocity: Vec2) -> f64 {
        (self.tension.force + self.damping * self.gradient.dot(&velocity)).min(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point that stays open has no force, whatever its approach speed before the step was.
    #[test]
    fn an_open_contact_is_not_damped() {
        let (point, normal) = (Vec2::zeros(), Vec2::y());
        let shape = ObstacleShape::HalfPlane { point, normal };
        let law = ContactLaw::HalfPlane { stiffness: 1e4 };
        let surface = Surface { shape, radius: 0.0, law, damping: 1.0, friction: 0.0 };
        let rotations = RotationIncrement::TangentScaled;
        let rates = RateCollocation { fraction: 0.5, by_change: 100.0, by_last: 0.0, rotations };
        let time = |stage| ContactTime { stage, weight: 1.0, rates: Some(rates), duration: 0.01 };
        for approach in [0.0, 2.0] {
            let mut own = ContactPoint::new(BodyPoint::of_particle(0), 1.0);
            (own.gap, own.approach, own.mass) = (Coordinate::from(0.5), approach, 1.0);
            for stage in [Stage::Midpoint, Stage::End] {
                let target = own.target(&surface, time(stage), -0.4);
                assert_eq!((target.force, target.stiffness), (0.0, 0.0), "{approach}, {stage:?}");
                assert!(own.target(&surface, time(stage), -0.6).force < 0.0);
            }
        }
    }
}
