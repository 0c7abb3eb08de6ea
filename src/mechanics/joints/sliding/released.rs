//! Law for a slider that has left its master.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// Law for a released slider, which has no force and no constraint.
#[derive(Debug, Clone, Copy)]
pub struct Released;

impl SlidingLaw for Released {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [force_x, force_y] = contact.no_force();
        let [couple_x, couple_y] = contact.no_couple();
        [force_x, force_y, couple_x, couple_y, contact.no_increment()]
    }
}
