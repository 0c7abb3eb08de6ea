//! Law for a slider that a stop holds at an end of its master.

use super::{CONTACT_UNKNOWNS, Contact, Equation, KinkState, SlidingLaw};
use crate::geometry::Vec2;

/// Law for a slider held by a stop. The slave is hinged to the end of the master, including the kink of the master.
#[derive(Debug, Clone, Copy)]
pub struct HeldSlider;

impl SlidingLaw for HeldSlider {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed_on_kink(jump_at_end(contact), 2.0);
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, contact.no_increment()]
    }

    fn kink_at_end(&self, contact: &Contact<'_>) -> KinkState {
        KinkState { jump: jump_at_end(contact), speed: 0.0 }
    }
}

fn jump_at_end(contact: &Contact<'_>) -> Vec2 {
    let before = contact.kink.as_ref().map_or(Vec2::zeros(), |kink| kink.before);
    contact.unknowns.force * 2.0 - before
}
