//! A slider that rests against the stop at an end of its master.

use super::contact::AXES;
use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};
use crate::geometry::Vec2;

/// The law of a slider at rest: the slave stays where it is on the master, as in a hinge: `x_s1 = Σ B_i(ξ1) x_i1`, with its kink, `Δξ = 0`, `η = 0`.
#[derive(Debug, Clone, Copy)]
pub struct Held;

impl SlidingLaw for Held {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = closed(contact);
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, contact.no_way()]
    }
}

/// The force `p1 = 2 λ - p0` that stands for the kink of a master on which nothing moves, from the mean force of a step [force].
pub fn jump_of_held(mean: Vec2, before: Vec2) -> Vec2 {
    mean * 2.0 - before
}

/// `x_s1 = Σ B_i(ξ1) x_i1 + g1 p1/GA`
fn closed(contact: &Contact<'_>) -> [Equation; 2] {
    let mut equations = contact.closed();
    if let Some(kink) = &contact.kink {
        let jump = jump_of_held(contact.unknowns.force, kink.before) * kink.compliance;
        for (equation, axis) in equations.iter_mut().zip(AXES) {
            equation.value -= kink.along.end * jump.dot(&axis);
            equation.by_unknowns.force -= axis * (2.0 * kink.compliance * kink.along.end);
            equation.by_unknowns.way -= kink.along.slope * jump.dot(&axis);
        }
    }
    equations
}
