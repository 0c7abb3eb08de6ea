//! What every law offers.

use super::{CONTACT_UNKNOWNS, Contact, Equation};

/// A law of a sliding joint: which equations hold in a step.
pub trait SlidingLaw {
    /// The five equations of a step for the five unknowns of the contact, with their derivatives.
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS];
}
