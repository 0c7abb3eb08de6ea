//! Sliding laws for equilibria.
//!
//! A static contact is treated as a contact with a path of zero length, on the master in its final configuration.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};
use crate::geometry::Vec2;

/// Sliding law for an equilibrium without friction. The potential energy of the contact is stationary (docs/theory.md, section 14.1).
#[derive(Debug, Clone, Copy)]
pub struct Resting;

/// Sliding law for an equilibrium in which a stop holds the slider at an end of its master.
#[derive(Debug, Clone, Copy)]
pub struct AtStop {
    /// Sliding increment of the slider to the end of the master [-].
    pub increment: f64,
}

impl SlidingLaw for Resting {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed_on_kink(contact.unknowns.force, 1.0);
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, not_driven(contact)]
    }
}

impl SlidingLaw for AtStop {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed_on_kink(contact.unknowns.force, 1.0);
        let [couple_x, couple_y] = contact.no_couple();
        let mut arrived = contact.no_increment();
        arrived.value -= contact.length * self.increment;
        [gap_x, gap_y, couple_x, couple_y, arrived]
    }
}

/// Equation without friction: the contact does no work if the slave moves along the master.
fn not_driven(contact: &Contact<'_>) -> Equation {
    let (force, scale) = (contact.unknowns.force, 1.0 / contact.length);
    let tangent = contact.end_point().by_end;
    let mut equation = contact
        .frictionless(super::PathVector { value: tangent, by_end: contact.end_bend() * 2.0 });
    equation.by_difference = force * scale;
    if let Some(kink) = contact.kink {
        let half = 0.5 * kink.compliance * scale;
        equation.value += half * kink.along.slope * force.norm_squared();
        equation.by_unknowns.force += force * (2.0 * half * kink.along.slope);
        // For a path of zero length, `kink.along.change` is half the second derivative of the kink length.
        equation.by_unknowns.increment += 2.0 * half * kink.along.change * force.norm_squared();
    }
    equation
}

impl Contact<'_> {
    /// Static contact forces on the control points of the master [force].
    pub fn master_forces_at_rest(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.path.end().iter().map(|value| self.unknowns.force * *value)
    }

    /// Derivatives of the static contact forces on the control points of the master with respect to the contact unknowns.
    /// A tuple contains derivatives with respect to the force (factor of the identity matrix), the couple (zero) and the sliding increment.
    pub fn master_force_slopes_at_rest(&self) -> impl Iterator<Item = (f64, f64, Vec2)> + '_ {
        let force = self.unknowns.force;
        let weights = self.path.end().iter().zip(self.path.slope());
        weights.map(move |(value, slope)| (*value, 0.0, force * *slope))
    }
}
