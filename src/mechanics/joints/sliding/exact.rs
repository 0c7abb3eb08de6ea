//! Sliding rule of equation 17 of Sibileau & Muñoz. It closes the gap, but does not conserve angular momentum.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// Exact sliding law. The gap is closed at the end of every step. Energy and linear momentum are conserved, but not angular momentum.
///
/// ```text
/// closed gap at the end:    x_s1 = Σ B_i(ξ1) x_i1
/// no force along the path:  λ·τ = 0
/// no couple:                η = 0
/// ```
///
/// The law is that of Sibileau & Muñoz, equations 15 and 17, with the divided difference `D_i` instead of `B_i'(ξ1)`.
/// Energy is therefore conserved exactly.
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
