//! Sliding rule of equation 17 of Sibileau & Muñoz, which closes the gap, but does not conserve angular momentum.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// Exact sliding law. The gap is closed at the end of every step. Energy and linear momentum are conserved, but not angular momentum.
/// The exact law is that of Sibileau & Muñoz, equations 15 and 17, with a divided difference that conserves the energy exactly.
#[derive(Debug, Clone, Copy)]
pub struct Exact;

impl SlidingLaw for Exact {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed();
        let [couple_x, couple_y] = contact.no_couple();
        let mut sliding = contact.frictionless(contact.tangent());
        sliding.by_difference = contact.unknowns.force * (0.5 / contact.length);
        [gap_x, gap_y, couple_x, couple_y, sliding]
    }
}
