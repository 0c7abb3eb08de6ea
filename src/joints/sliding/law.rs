//! What every law offers.

use super::{CONTACT_UNKNOWNS, Contact, Equation};

/// A law of a sliding joint.
pub trait SlidingLaw {
    /// The five equations of a step for the unknowns of the contact, with their derivatives.
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS];
}
