//! A slider that has left its master.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};

/// Nothing acts and nothing is tied: `λ = 0`, `η = 0`, `Δξ = 0`.
#[derive(Debug, Clone, Copy)]
pub struct Released;

impl SlidingLaw for Released {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [couple_x, couple_y] = contact.no_couple();
        let force = contact.unknowns.force;
        [
            Equation::vanishing(0, force.x, 1.0, Unit::Force),
            Equation::vanishing(1, force.y, 1.0, Unit::Force),
            couple_x,
            couple_y,
            Equation::vanishing(4, contact.unknowns.way, contact.length, Unit::Length),
        ]
    }
}
