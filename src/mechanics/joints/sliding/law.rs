//! What every law offers.

use super::{CONTACT_UNKNOWNS, Contact, Equation, KinkState, Unit};

/// A law of a sliding joint: which equations hold in a step.
pub trait SlidingLaw {
    /// The five equations of a step for the five unknowns of the contact, with their derivatives.
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS];

    /// The values of these equations with their units, bit by bit: where an iterate needs no derivatives.
    fn values(&self, contact: &Contact<'_>) -> [(f64, Unit); CONTACT_UNKNOWNS] {
        self.equations(contact).map(|equation| (equation.value, equation.unit))
    }

    /// The kink of the master at the end of a step that ends with the contact; none under a law that knows of none.
    fn kink_at_end(&self, _contact: &Contact<'_>) -> KinkState {
        KinkState::default()
    }
}
