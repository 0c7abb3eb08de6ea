//! The rule that keeps energy, both momenta and the gap.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};
use crate::geometry::{Vec2, cross, perpendicular};

/// The gap is closed at the end of every step, and energy, linear and angular momentum are kept, for any step.
///
/// ```text
/// x_s1 = Σ B_i(ξ1) x_i1          |τ|² η + (d × λ) Jτ = 0          λ·τ + 4 η·d = 0
/// ```
///
/// The mean place of the slave is `Σ B̄_i x̄_i + Δξ d`, off the place where `λ` acts on the master: the smallest `η` that
/// balances this moment is taken, and the sliding equation follows from the energy. Derived in docs/theory.md, section 10.
#[derive(Debug, Clone, Copy)]
pub struct Conserving;

impl SlidingLaw for Conserving {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed();
        let [couple_x, couple_y] = balanced_moment(contact);
        [gap_x, gap_y, couple_x, couple_y, kept_energy(contact)]
    }
}

/// `(|τ|² η + (d × λ) Jτ)/ℓ² = 0`: `d × λ + τ × η = 0` with the smallest `η`.
fn balanced_moment(contact: &Contact<'_>) -> [Equation; 2] {
    let (tangent, tangent_by_way) = contact.tangent;
    let (swing, swing_by_way) = contact.swing;
    let (force, couple) = (contact.unknowns.force, contact.unknowns.couple);
    let scale = 1.0 / contact.length.powi(2);
    let (square, moment, normal) =
        (tangent.norm_squared(), cross(swing, force), perpendicular(tangent));
    let by_force = perpendicular(swing);
    let components = [(couple.x, normal.x, -Vec2::y()), (couple.y, normal.y, Vec2::x())];
    let mut index = 2;
    components.map(|(couple, normal, normal_by_tangent)| {
        let mut equation = Equation::new((square * couple + moment * normal) * scale, Unit::Force);
        let by_tangent = (tangent * (2.0 * couple) + normal_by_tangent * moment) * scale;
        let by_swing = perpendicular(force) * (-normal * scale);
        equation.by_difference = by_tangent * 0.5 + by_swing * 0.25;
        let by_way = by_tangent.dot(&tangent_by_way) + by_swing.dot(&swing_by_way);
        let of_force = by_force * (normal * scale);
        equation.by_unknowns = [of_force.x, of_force.y, 0.0, 0.0, by_way];
        equation.by_unknowns[index] = square * scale;
        index += 1;
        equation
    })
}

/// `(λ·τ + 4 η·d)/ℓ = 0`: the contact does no work.
fn kept_energy(contact: &Contact<'_>) -> Equation {
    let (tangent, tangent_by_way) = contact.tangent;
    let (swing, swing_by_way) = contact.swing;
    let (force, couple) = (contact.unknowns.force, contact.unknowns.couple);
    let scale = 1.0 / contact.length;
    let power = force.dot(&tangent) + 4.0 * couple.dot(&swing);
    let mut equation = Equation::new(power * scale, Unit::Force);
    equation.by_difference = (force * 0.5 + couple) * scale;
    let by_way = force.dot(&tangent_by_way) + 4.0 * couple.dot(&swing_by_way);
    equation.by_unknowns =
        [tangent.x, tangent.y, 4.0 * swing.x, 4.0 * swing.y, by_way].map(|slope| scale * slope);
    equation
}
