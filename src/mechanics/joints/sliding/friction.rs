//! Coulomb friction of a sliding contact in a step (docs/theory.md, section 10.4).
//!
//! The velocity of the slave across the master has an error that changes its sign in every step.
//! The normal force in the friction limit does not contain the part of the contact force that causes these changes.

use super::{Contact, Equation};
use crate::geometry::{Vec2, cross, perpendicular};

/// Friction state of a sliding contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionMode {
    /// The slave moves along the master in the direction given by the sign.
    Slip(f64),
    /// The slave does not move along the master.
    Stick,
}

/// Data for the friction of a contact in a step: friction state, start velocities and inertia.
#[derive(Debug, Clone, Copy)]
pub struct Friction<'a> {
    /// Coefficient of friction `μ` [-].
    pub coefficient: f64,
    /// Friction state of the contact in this step.
    pub mode: FrictionMode,
    /// Velocity of the slave at the start of the step [length/time].
    pub slave_velocity: Vec2,
    /// Velocities of the control points of the master along the path, at the start of the step [length/time].
    pub master_velocities: &'a [Vec2],
    /// Velocity of the slave relative to the master, component across the master, at the start of the step [length/time].
    pub start_velocity_across: f64,
    /// Inverse of the velocity change that a unit impulse across the master causes [mass].
    pub inertia_across: f64,
    /// Duration of the step [time].
    pub duration: f64,
    /// Prescribed force along the master [force]. It replaces the friction limit, the coefficient of friction times the normal force.
    /// The value is `None` if the friction limit applies.
    pub fixed_force: Option<f64>,
}

/// Forces and velocities of a contact with friction in an iterate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrictionForces {
    /// Contact force along the master [force], multiplied by `tangent` [length].
    pub along: f64,
    /// Normal force from which the friction limit is computed [force], multiplied by `tangent` [length].
    pub across: f64,
    /// Length of the mean tangent [length].
    pub tangent: f64,
    /// Velocity of the slave along the master at the end of the step [length/time].
    pub end_velocity: f64,
}

struct EndMotion {
    /// Velocity of the slave relative to the contact point of the master [length/time].
    velocity: Vec2,
    /// Unit tangent of the master [-].
    along: Vec2,
    change_across: f64,
}

impl Friction<'_> {
    fn impedance_across(&self) -> f64 {
        self.inertia_across / self.duration
    }
}

impl Contact<'_> {
    fn end_motion(&self, friction: &Friction<'_>) -> EndMotion {
        let rate = 2.0 / friction.duration;
        let (_, moved) = self.master;
        let of_master = moved.iter().zip(friction.master_velocities);
        let of_master = of_master.map(|(moved, before)| moved * rate - before);
        let of_master: Vec2 = self
            .path
            .end()
            .iter()
            .zip(of_master)
            .map(|(weight, velocity)| velocity * *weight)
            .sum();
        let of_slave = self.slave_movement * rate - friction.slave_velocity;
        let (velocity, along) = (of_slave - of_master, self.end_point().by_end.normalize());
        let change_across = cross(along, velocity) - friction.start_velocity_across;
        EndMotion { velocity, along, change_across }
    }

    /// Computes the forces and velocities of the contact in an iterate, for the given friction.
    pub fn friction_forces(&self, friction: &Friction<'_>) -> FrictionForces {
        let (tangent, force) = (self.tangent().value, self.unknowns.force);
        let couple = self.unknowns.couple.dot(&self.tangent_change().value);
        let EndMotion { velocity, along, change_across } = self.end_motion(friction);
        let impedance = friction.impedance_across();
        FrictionForces {
            along: force.dot(&tangent) + 4.0 * couple,
            across: cross(tangent, force) + tangent.norm() * change_across * impedance,
            tangent: tangent.norm(),
            end_velocity: along.dot(&velocity),
        }
    }

    /// Sliding equation with friction, in place of the given frictionless equation.
    /// The derivatives of the sliding equation omit the rotation of the tangent at the end of the step, which has little effect.
    pub fn with_friction(&self, friction: &Friction<'_>, frictionless: Equation) -> Equation {
        let FrictionMode::Slip(sign) = friction.mode else { return self.no_increment() };
        let (tangent, force) = (self.tangent(), self.unknowns.force);
        if let Some(fixed) = friction.fixed_force {
            let (length, factor) = (tangent.value.norm(), -fixed / self.length);
            let by_tangent = tangent.value * (factor / length);
            let mut equation = frictionless;
            equation.value += factor * length;
            equation.by_unknowns.increment += by_tangent.dot(&tangent.by_end);
            equation.by_difference += by_tangent * 0.5;
            return equation;
        }
        let EndMotion { along, change_across, .. } = self.end_motion(friction);
        let impedance = friction.impedance_across();
        let FrictionForces { across, tangent: length, .. } = self.friction_forces(friction);
        let factor = -sign * friction.coefficient * across.signum() / self.length;
        let by_tangent =
            -perpendicular(force) + tangent.value * (change_across * impedance / length);
        let by_velocity =
            perpendicular(along) * (length * impedance * factor * 2.0 / friction.duration);
        let mut equation = frictionless;
        equation.value += factor * across;
        equation.by_unknowns.force += perpendicular(tangent.value) * factor;
        equation.by_unknowns.increment += by_tangent.dot(&tangent.by_end) * factor;
        equation.by_difference += by_tangent * (0.5 * factor);
        equation.by_slave += by_velocity;
        equation.by_end -= by_velocity;
        equation
    }
}
