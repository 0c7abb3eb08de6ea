//! Coulomb friction of a contact point. The contact deflects elastically along the surface before it slips.
//!
//! `docs/theory.md`, section 9.7, derives the mean force of a step.
//! The force is the mean over the exact path, so it never exceeds the limit, and a contact that sticks does not creep.
//! If the coefficient of restitution is below 1, a viscous force acts in parallel with the elastic force.

use super::point::{ClosedContact, GapTrial};
use crate::beams::Movement;
use crate::elementary::square;
use crate::geometry::{Vec2, larger, perpendicular};
use crate::system::elements::contact::SOFT;
use crate::system::elements::coordinate::rounding_error;
use crate::system::elements::mixed_force::{CORNER_TOLERANCE, ForceTarget, MixedForce};

/// Damping factor at which a sticking contact is critically damped. Larger factors are reduced to it.
const MOST_DAMPING: f64 = 2.0;

/// Law of friction in a step.
#[derive(Debug, Clone, Copy)]
struct FrictionLaw {
    /// Stiffness along the surface [force/length].
    stiffness: f64,
    /// Largest magnitude of the force [force].
    limit: f64,
    /// Elastic deflection of the contact along the surface at the start of the step [length].
    deflection: f64,
    /// Viscous force per slip [force/length].
    damping: f64,
    /// Share of the step in which the force acts [-].
    share: f64,
}

/// Friction force in an iterate, and its derivatives.
#[derive(Debug, Clone, Copy)]
struct FrictionTarget {
    by_slip: ForceTarget,
    by_limit: f64,
}

impl FrictionLaw {
    fn yield_deflection(&self) -> f64 {
        self.limit / self.stiffness
    }

    fn start_deflection(&self) -> f64 {
        let most = self.yield_deflection();
        self.deflection.clamp(-most, most)
    }

    fn end_deflection(&self, slip: f64) -> f64 {
        let most = self.yield_deflection();
        (self.start_deflection() + slip).clamp(-most, most)
    }

    fn mean_force(&self, slip: f64) -> FrictionTarget {
        let Self { stiffness, limit, deflection, damping, share } = *self;
        let sign = 1.0_f64.copysign(slip);
        let (slip, start) = (slip.abs(), sign * self.start_deflection());
        let start_by_limit = match deflection.abs() > self.yield_deflection() {
            true => (sign * deflection).signum() / stiffness,
            false => 0.0,
        };
        let elastic_slip = self.yield_deflection() - start;
        let (force, slope, by_limit) = if slip <= elastic_slip {
            (stiffness * (start + 0.5 * slip), 0.5 * stiffness, stiffness * start_by_limit)
        } else {
            let missing = 0.5 * stiffness * elastic_slip * (elastic_slip / slip);
            let by_limit = 1.0 - elastic_slip / slip * (1.0 - stiffness * start_by_limit);
            (limit - missing, missing / slip, by_limit)
        };
        let damped = force + damping * slip;
        let (force, stiffness, by_limit) =
            if damped > limit { (limit, 0.0, 1.0) } else { (damped, slope + damping, by_limit) };
        let by_slip = ForceTarget { force: sign * force / share, stiffness: stiffness / share };
        FrictionTarget { by_slip, by_limit: sign * by_limit / share }
    }
}

/// Slip in an iterate, with the directions of the friction force.
#[derive(Debug, Clone, Copy, Default)]
struct SlipTrial {
    slip: f64,
    /// Derivative of the slip with respect to displacement and rotation [-, -, length].
    slope: Movement,
    /// Generalised force of a unit friction force: force [-] and moment [length].
    direction: Movement,
    direction_slope: [Vec2; 3],
    moved: f64,
}

impl SlipTrial {
    /// Slip of the surface of a body with a radius. The secant of the gap is the direction of the normal force.
    fn new(gap: &GapTrial, radius: f64, [x, y, rotation]: Movement) -> Self {
        let movement = Vec2::new(x, y);
        let (normal, by) = (gap.secant, gap.secant_slope);
        let tangent = perpendicular(normal);
        let arm = radius * normal.norm_squared();
        let arm_slope = (by[0] * normal.x + by[1] * normal.y) * (2.0 * radius);
        let slope = tangent + by[0] * movement.y - by[1] * movement.x - arm_slope * rotation;
        Self {
            slip: tangent.dot(&movement) - arm * rotation,
            slope: [slope.x, slope.y, -arm],
            direction: [tangent.x, tangent.y, -arm],
            direction_slope: [-by[1], by[0], -arm_slope],
            moved: larger(movement.norm(), (arm * rotation).abs()),
        }
    }
}

/// Damping coefficient along the surface while a contact sticks [force·time/length]. `factor` is the factor of the normal damping [-].
pub(super) fn sticking_damping(stiffness: f64, mass: f64, factor: f64) -> f64 {
    let factor = factor.min(MOST_DAMPING);
    let is_damped = factor > 0.0 && mass.is_finite();
    if is_damped { factor * (stiffness * mass).sqrt() } else { 0.0 }
}

/// Friction of a contact point in a step.
#[derive(Debug, Clone)]
pub(super) struct PointFriction {
    /// Coefficient of friction [-].
    coefficient: f64,
    /// Radius of the body around the point [length].
    radius: f64,
    /// Stiffness along the surface [force/length].
    stiffness: f64,
    /// Damping coefficient while the contact sticks [force·time/length].
    damping: f64,
    /// Effective mass of the body along the surface [mass].
    mass: f64,
    /// Elastic deflection along the surface at the start of the step [length].
    deflection: f64,
    /// Friction force, as an internal force along the turned normal [force].
    force: MixedForce,
    by_normal: f64,
    trial: SlipTrial,
    linearised: SlipTrial,
    /// Applied moment in the present iterate, as an internal moment [force·length].
    applied_moment: f64,
}

/// Normal force that limits a friction force in an iterate, and the time in which both act.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalContact {
    /// Normal force [force]. It is negative if the contact pulls in the present iterate.
    pub(super) force: f64,
    /// Duration of the step [time].
    pub(super) duration: f64,
    /// Share of the step in which the friction force acts [-].
    pub(super) share: f64,
}

impl PointFriction {
    pub(super) fn new(coefficient: f64, radius: f64) -> Self {
        Self {
            coefficient,
            radius,
            stiffness: 0.0,
            damping: 0.0,
            mass: 0.0,
            deflection: 0.0,
            force: MixedForce::default(),
            by_normal: 0.0,
            trial: SlipTrial::default(),
            linearised: SlipTrial::default(),
            applied_moment: 0.0,
        }
    }

    /// Sets the stiffness, the damping and the effective mass along the surface. `damping_factor` is the factor of the normal damping [-].
    pub(super) fn set_scales(&mut self, stiffness: f64, mass: f64, damping_factor: f64) {
        (self.stiffness, self.mass) = (stiffness, mass);
        self.damping = sticking_damping(stiffness, mass, damping_factor);
    }

    pub(super) fn begin_step(&mut self) {
        self.force.begin_step();
    }

    /// Sets the force to zero for an open contact. The deflection is kept until the end of the step.
    pub(super) fn release(&mut self) {
        (self.force.force, self.force.mismatch, self.by_normal) = (0.0, 0.0, 0.0);
        (self.trial, self.linearised) = (SlipTrial::default(), SlipTrial::default());
        self.applied_moment = 0.0;
    }

    pub(super) fn evaluate(&mut self, gap: &GapTrial, movement: Movement) {
        self.trial = SlipTrial::new(gap, self.radius, movement);
    }

    fn law(&self, contact: NormalContact) -> FrictionLaw {
        FrictionLaw {
            stiffness: self.stiffness,
            limit: self.coefficient * contact.force.max(0.0),
            deflection: self.deflection,
            damping: self.damping / contact.duration,
            share: contact.share,
        }
    }

    /// Compares the force with the law. Returns the relative difference; zero if the rounding error of the increments explains it.
    pub(super) fn compare(&mut self, contact: NormalContact) -> f64 {
        let target = self.law(contact).mean_force(self.trial.slip).by_slip;
        let stiffness = larger(target.stiffness, self.stiffness);
        let extent = CORNER_TOLERANCE * larger(self.trial.moved, self.deflection.abs());
        let missed = self.force.compare(ForceTarget { stiffness, ..target }, extent);
        let is_rounding = self.force.missing_change().abs() <= rounding_error(self.trial.moved);
        if is_rounding { 0.0 } else { missed }
    }

    /// Linearises the law at the present iterate, or at its intersection with the impedance of the body if the contact is stiff.
    pub(super) fn linearise(&mut self, contact: NormalContact) {
        let impedance = 2.0 * self.mass / square(contact.duration);
        let (law, slip) = (self.law(contact), self.trial.slip);
        let point = match self.stiffness > SOFT * impedance {
            true => ForceTarget::intersection_point(slip, self.force.force, impedance, |slip| {
                law.mean_force(slip).by_slip
            }),
            false => slip,
        };
        let FrictionTarget { by_slip: ForceTarget { force, stiffness }, by_limit } =
            law.mean_force(point);
        let is_pushed = contact.force >= 0.0;
        self.by_normal = if is_pushed { self.coefficient * by_limit } else { 0.0 };
        let force = force + stiffness * (slip - point);
        self.force.linearise(ForceTarget { force, stiffness });
        self.linearised = self.trial;
    }

    /// Applies `weight` times the force of the present iterate. Returns the generalised internal force: force [force] and moment [force·length].
    pub(super) fn apply(&mut self, weight: f64) -> Movement {
        let applied = self.trial.direction.map(|by| by * self.force.force).map(|by| by * weight);
        self.applied_moment = applied[2];
        applied
    }

    /// Moment on the body in the completed step [force·length].
    pub(super) fn mean_moment(&self) -> f64 {
        -self.applied_moment
    }

    pub(super) fn condensed(&self, normal_mismatch: f64) -> Movement {
        let force = self.force.force + self.mismatch(normal_mismatch);
        self.linearised.direction.map(|by| by * force)
    }

    /// Force and moment that would remove the present difference between the friction force and its law.
    pub(super) fn missing(&self, normal_mismatch: f64) -> Movement {
        self.linearised.direction.map(|by| by * self.mismatch(normal_mismatch))
    }

    fn mismatch(&self, normal_mismatch: f64) -> f64 {
        self.force.mismatch + self.by_normal * normal_mismatch
    }

    pub(super) fn tangent(&self, normal_slope: Vec2) -> [Movement; 3] {
        let SlipTrial { slope, direction, direction_slope, .. } = self.linearised;
        let by_normal = [normal_slope.x, normal_slope.y, 0.0].map(|by| by * self.by_normal);
        [0, 1, 2].map(|row| {
            [0, 1, 2].map(|column| {
                let of_direction = if column < 2 { direction_slope[row][column] } else { 0.0 };
                let of_force = self.force.stiffness * slope[column] + by_normal[column];
                direction[row] * of_force + of_direction * self.force.force
            })
        })
    }

    pub(super) fn correct(&mut self, moved: Movement, normal_change: f64) {
        let slope = self.linearised.slope;
        self.force.correct((0..3).map(|at| slope[at] * moved[at]).sum());
        self.force.force += self.by_normal * normal_change;
    }

    /// Ends a step. Returns the dissipated energy [energy].
    pub(super) fn advance(&mut self, contact: NormalContact) -> f64 {
        let is_met = self.compare(contact) == 0.0;
        // The slip is corrected to the value that belongs to the force. Otherwise, the rounding error of increments would store energy.
        let slip = self.trial.slip + if is_met { self.force.missing_change() } else { 0.0 };
        let before = self.energy();
        self.deflection = self.law(contact).end_deflection(slip);
        self.force.last = self.force.force;
        contact.share * self.force.force * slip - (self.energy() - before)
    }

    /// Elastic energy of the deflection [energy].
    pub(super) fn energy(&self) -> f64 {
        0.5 * self.stiffness * self.deflection * self.deflection
    }

    /// Mean force in the last step along the surface, positive to the right of its normal [force].
    pub(super) fn last(&self) -> f64 {
        self.force.last
    }

    /// Generalised internal force at the start of the step, for rates of the point.
    /// The slip is linear in the movement, so the slip rate follows from the rates.
    pub(super) fn at_start(
        &self,
        contact: &ClosedContact,
        normal_force: f64,
        rates: Movement,
    ) -> Movement {
        let gap = GapTrial::along(contact.gradient);
        let SlipTrial { slip: rate, direction, .. } = SlipTrial::new(&gap, self.radius, rates);
        let limit = self.coefficient * normal_force.max(0.0);
        let force = self.stiffness * self.deflection + contact.sticking_damping * rate;
        direction.map(|by| by * force.clamp(-limit, limit))
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.deflection, self.force.last]);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.deflection, self.force.last) = (next(), next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIPS: [f64; 7] = [-0.9, -0.03, -0.004, 0.0, 0.005, 0.04, 1.2];

    fn laws() -> impl Iterator<Item = FrictionLaw> {
        let of = |(deflection, damping)| FrictionLaw {
            stiffness: 200.0,
            limit: 3.0,
            deflection,
            damping,
            share: 1.0,
        };
        [(0.0, 0.0), (0.01, 0.0), (-0.014, 40.0), (0.02, 0.0), (-0.3, 7.0)].into_iter().map(of)
    }

    #[test]
    fn the_mean_force_does_the_work_of_the_exact_path() {
        for law in laws().map(|law| FrictionLaw { damping: 0.0, ..law }) {
            for slip in SLIPS {
                let pieces = 200_000;
                let part = slip / f64::from(pieces);
                let (mut at, mut work) = (law.start_deflection(), 0.0);
                for _ in 0..pieces {
                    let next = FrictionLaw { deflection: at, ..law }.end_deflection(part);
                    work += 0.5 * law.stiffness * (at + next) * part;
                    at = next;
                }
                let met = law.mean_force(slip).by_slip.force * slip;
                assert!((met - work).abs() < 1e-5, "{law:?} {slip}: {met} {work}");
                assert!((at - law.end_deflection(slip)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_force_stays_below_its_limit_and_dissipates() {
        for law in laws() {
            for slip in SLIPS {
                let force = law.mean_force(slip).by_slip.force;
                assert!(force.abs() <= law.limit * (1.0 + 1e-15), "{law:?} {slip}");
                let energy = |at: f64| 0.5 * law.stiffness * at * at;
                let lost = force * slip - energy(law.end_deflection(slip)) + energy(law.deflection);
                assert!(lost > -1e-14, "{law:?} {slip}: {lost}");
            }
        }
    }

    #[test]
    fn stiffness_and_dependence_on_the_limit_are_derivatives() {
        let step = 1e-7;
        for law in laws() {
            for slip in SLIPS.map(|slip| slip + 1e-4) {
                let force = |slip: f64, limit: f64| FrictionLaw { limit, ..law }.mean_force(slip);
                let difference = |slip_step: f64, limit_step: f64| {
                    let of = |sign: f64| {
                        force(slip + sign * slip_step, law.limit + sign * limit_step).by_slip.force
                    };
                    (of(1.0) - of(-1.0)) / (2.0 * step)
                };
                let met = law.mean_force(slip);
                let by_slip = difference(step, 0.0);
                let by_limit = difference(0.0, step);
                let tolerance = 1e-5 * law.stiffness;
                assert!((met.by_slip.stiffness - by_slip).abs() < tolerance, "{law:?} {slip}");
                assert!((met.by_limit - by_limit).abs() < 1e-5, "{law:?} {slip}");
            }
        }
    }

    #[test]
    fn slopes_of_the_slip_are_derivatives_and_do_its_work() {
        let (centre, radius, step) = (Vec2::zeros(), 0.3, 1e-6);
        let shape = super::super::definition::ObstacleShape::Disc { centre, radius };
        let start = Vec2::new(0.5, -0.2);
        let trial = |moved: Movement| {
            let rotations = crate::beams::RotationIncrement::TangentScaled;
            let gap = GapTrial::new(shape, start, Vec2::new(moved[0], moved[1]), rotations);
            SlipTrial::new(&gap, 0.25, moved)
        };
        let moved = [0.1, 0.17, -0.4];
        let met = trial(moved);
        let work: f64 = (0..3).map(|at| met.direction[at] * moved[at]).sum();
        assert!((work - met.slip).abs() < 1e-15);
        for column in 0..3 {
            let at = |by: f64| {
                let mut moved = moved;
                moved[column] += by;
                trial(moved)
            };
            let (after, before) = (at(step), at(-step));
            let slope = (after.slip - before.slip) / (2.0 * step);
            assert!((slope - met.slope[column]).abs() < 1e-9, "{column}");
            for row in 0..3 {
                let slope = (after.direction[row] - before.direction[row]) / (2.0 * step);
                let expected = if column < 2 { met.direction_slope[row][column] } else { 0.0 };
                assert!((slope - expected).abs() < 1e-9, "{row} {column}");
            }
        }
    }
}
