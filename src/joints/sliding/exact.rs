//! The rule of the paper's equation 17: the gap is closed, angular momentum is lost.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};

/// The gap is closed at the end of every step; energy and linear momentum are kept, angular momentum is not.
///
/// ```text
/// x_s1 = Σ B_i(ξ1) x_i1          λ·τ = 0          η = 0
/// ```
///
/// Sibileau & Muñoz, equations 15 and 17, with the divided difference `D_i` for `B_i'(ξ1)`: with it the energy is exact.
#[derive(Debug, Clone, Copy)]
pub struct Exact;

impl SlidingLaw for Exact {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed();
        let [couple_x, couple_y] = contact.no_couple();
        let ((tangent, by_way), force) = (contact.tangent, contact.unknowns.force);
        let scale = 1.0 / contact.length;
        let mut sliding = Equation::new(force.dot(&tangent) * scale, Unit::Force);
        sliding.by_difference = force * (0.5 * scale);
        sliding.by_unknowns =
            [tangent.x, tangent.y, 0.0, 0.0, force.dot(&by_way)].map(|slope| scale * slope);
        [gap_x, gap_y, couple_x, couple_y, sliding]
    }
}
