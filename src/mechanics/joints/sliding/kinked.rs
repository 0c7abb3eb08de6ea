//! The rule that keeps energy, both momenta and the gap to the kinked axis.

use super::contact::AXES;
use super::{CONTACT_UNKNOWNS, Conserving, Contact, Equation, Kink, SlidingLaw};
use crate::elementary::square;
use crate::geometry::{cross, perpendicular};

/// The conserving law of sliding: the gap is closed at the end of every step, and energy, linear and angular momentum are kept, for any
/// step.
///
/// ```text
/// x_s1 = Σ B_i(ξ1) x_i1 + g1 p1/GA         |τ|² η + (d × λ - ¼ (Δg/Δξ) (p0 × p1)/GA) Jτ = 0
/// λ·τ + 4 η·d + ½ (Δg/Δξ) p0·p1/GA = 0        p1 = 2 λ - p0
/// ```
///
/// The slave is on the axis as the contact force `p` kinks it, whose energy `½ g |p|²/GA` the mesh misses. Where there is no [`Kink`] it is
/// the law [`Conserving`]. Derived in docs/theory.md, sections 10 and 10.1.
#[derive(Debug, Clone, Copy)]
pub struct Kinked;

impl SlidingLaw for Kinked {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [_, _, mut couple_x, mut couple_y, mut sliding] = Conserving.equations(contact);
        let [gap_x, gap_y] = contact.closed_on_kinked_axis();
        if let Some(kink) = &contact.kink {
            add_moment(contact, kink, [&mut couple_x, &mut couple_y]);
            add_work(contact, kink, &mut sliding);
        }
        [gap_x, gap_y, couple_x, couple_y, sliding]
    }
}

/// Adds `-¼ (Δg/Δξ) (p0 × p1)/GA · Jτ/ℓ²`: the mean offset `½ (g0 p0 + g1 p1)/GA` of the slave from the axis is no mean of what pushes it.
fn add_moment(contact: &Contact<'_>, kink: &Kink, equations: [&mut Equation; 2]) {
    let (tangent, scale) = (contact.tangent(), kink.compliance / square(contact.length));
    // p0 × p1 = 2 p0 × λ
    let turn = 0.5 * cross(kink.before, contact.unknowns.force);
    let (difference, change) = (kink.along.difference, kink.along.change);
    for (equation, axis) in equations.into_iter().zip(AXES) {
        let normal = perpendicular(tangent.value).dot(&axis);
        let by_tangent = perpendicular(axis) * (scale * difference * turn);
        equation.value -= scale * difference * turn * normal;
        equation.by_difference += by_tangent * 0.5;
        equation.by_unknowns.force -=
            perpendicular(kink.before) * (0.5 * scale * difference * normal);
        equation.by_unknowns.way +=
            by_tangent.dot(&tangent.by_way) - scale * change * turn * normal;
    }
}

/// Adds `½ (Δg/Δξ) p0·p1/(GA ℓ)`: with it what the contact takes is what the kink stores.
fn add_work(contact: &Contact<'_>, kink: &Kink, equation: &mut Equation) {
    let scale = 0.5 * kink.compliance / contact.length;
    let product = kink.before.dot(&contact.force_at_end());
    equation.value += scale * kink.along.difference * product;
    equation.by_unknowns.force += kink.before * (2.0 * scale * kink.along.difference);
    equation.by_unknowns.way += scale * kink.along.change * product;
}
