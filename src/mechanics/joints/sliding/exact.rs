//! Sliding rule of equation 17 of Sibileau & Muñoz. The gap is closed; angular momentum is not conserved.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw};

/// Exact law of sliding. The gap is closed at the end of every step. Energy and linear momentum are conserved, angular momentum is not.
///
/// ```text
/// x_s1 = Σ B_i(ξ1) x_i1          λ·τ = 0          η = 0
/// ```
///
/// The law is that of Sibileau & Muñoz, equations 15 and 17. The divided difference `D_i` replaces `B_i'(ξ1)`, so that energy is conserved exactly.
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
