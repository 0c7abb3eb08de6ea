//! Sliding rule of equations 11 to 14 of Sibileau & Muñoz. It conserves energy and momenta, but the gap drifts.

use super::contact::AXES;
use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};

/// Largest gap that counts as rounding and defines no direction, as a fraction of the length of the master.
const ROUNDING: f64 = 1e-13;

/// Relaxed sliding law. The gap is closed on average over each step. Energy, linear and angular momentum are conserved. A closed gap may open.
///
/// ```text
/// closed mean gap:   ½ (x_s0 + x_s1) = Σ B̄_i x̄_i
/// sliding equation:  λ·(2/Δξ) (Σ B̄_i x_i0 - x_s0) = 0
/// no couple:         η = 0
/// ```
///
/// The law is that of Sibileau & Muñoz, equations 11 to 14.
/// A step may have no solution, because the direction in the second equation deviates from the tangent as the gap grows.
/// The direction is undefined for `Δξ = 0`.
#[derive(Debug, Clone, Copy)]
pub struct Relaxed;

impl SlidingLaw for Relaxed {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = closed_mean(contact);
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, sliding(contact)]
    }
}

/// Equations of a closed gap in the middle of the step: `½ (x_s0 + x_s1) = Σ B̄_i x̄_i`.
fn closed_mean(contact: &Contact<'_>) -> [Equation; 2] {
    let point = contact.mean_point();
    let gap = contact.slave_movement * 0.5 - point.value;
    AXES.map(|axis| {
        let mut equation = Equation::new(gap.dot(&axis), Unit::Length);
        equation.by_slave = axis * 0.5;
        equation.by_mean = axis * -0.5;
        equation.by_unknowns.increment = -point.by_end.dot(&axis);
        equation
    })
}

/// Sliding equation. Its direction `2/Δξ (Σ B̄_i x_i0 - x_s0)` is computed as the tangent plus the gap: `Σ D_i x_i0 + 2/Δξ (Σ B_i(ξ0) x_i0 - x_s0)`.
fn sliding(contact: &Contact<'_>) -> Equation {
    let (mut direction, gap) = (contact.start_tangent(), contact.start_gap());
    if gap.norm() > ROUNDING * contact.length {
        let tilt = gap * (2.0 / contact.unknowns.increment);
        direction.value += tilt;
        direction.by_end -= tilt / contact.unknowns.increment;
    }
    contact.frictionless(direction)
}
