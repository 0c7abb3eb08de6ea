//! Interface of sliding laws.

use super::{CONTACT_UNKNOWNS, Contact, Equation, KinkState, Unit};

/// Law of a sliding joint, which provides the equations of its contact in a step.
pub trait SlidingLaw {
    /// Five equations for the five unknowns of the contact, with their derivatives.
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS];

    /// Values of the five contact equations with their units, for iterates that need no derivatives.
    fn values(&self, contact: &Contact<'_>) -> [(f64, Unit); CONTACT_UNKNOWNS] {
        self.equations(contact).map(|equation| (equation.value, equation.unit))
    }

    /// Kink of the master at the end of the step; zero for laws without kinks.
    fn kink_at_end(&self, _contact: &Contact<'_>) -> KinkState {
        KinkState::default()
    }
}
