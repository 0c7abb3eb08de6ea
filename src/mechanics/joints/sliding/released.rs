//! Law of a slider after its release from its master.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// Law of a slider that has left its master, and has neither force nor constraint.
#[derive(Debug, Clone, Copy)]
pub struct Released;

impl SlidingLaw for Released {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [force_x, force_y] = contact.no_force();
        let [couple_x, couple_y] = contact.no_couple();
        [force_x, force_y, couple_x, couple_y, contact.no_increment()]
    }
}
