//! A slider that rests against the stop at an end of its master.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// The law of a slider at rest: the slave stays where it is on the master, as in a hinge: `x_s1 = Σ B_i(ξ1) x_i1`, with its kink, `Δξ = 0`, `η = 0`.
#[derive(Debug, Clone, Copy)]
pub struct Held;

impl SlidingLaw for Held {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed_on_kinked_axis();
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, contact.no_way()]
    }
}
