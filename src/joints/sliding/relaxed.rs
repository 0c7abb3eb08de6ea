//! The rule of the paper's equations 11 to 14: energy and momenta are kept, the gap drifts.

use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};
use crate::geometry::Vec2;

/// A gap smaller than this part of the master is rounding and gives no direction.
const ROUNDING: f64 = 1e-13;

/// The contact is closed in the mean of each step; energy, linear and angular momentum are kept, the gap is not.
///
/// ```text
/// ½ (x_s0 + x_s1) = Σ B̄_i x̄_i          λ·(2/Δξ) (Σ B̄_i x_i0 - x_s0) = 0          η = 0
/// ```
///
/// Sibileau & Muñoz, equations 11 to 14. A step may have no solution: the direction in the second equation turns away from
/// the tangent as the gap grows, and is not defined where `Δξ` passes zero.
#[derive(Debug, Clone, Copy)]
pub struct Relaxed;

impl SlidingLaw for Relaxed {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let (mean_point, mean_by_way) = contact.mean_point;
        let gap = contact.slave_moved * 0.5 - mean_point;
        let closed = |axis: Vec2| {
            let mut equation = Equation::new(gap.dot(&axis), Unit::Length);
            equation.by_slave = axis * 0.5;
            equation.by_mean = axis * -0.5;
            equation.by_unknowns[4] = -mean_by_way.dot(&axis);
            equation
        };
        let [couple_x, couple_y] = contact.no_couple();
        [closed(Vec2::x()), closed(Vec2::y()), couple_x, couple_y, sliding(contact)]
    }
}

/// `2/Δξ (Σ B̄_i x_i0 - x_s0) = Σ D_i x_i0 + 2/Δξ (Σ B_i(ξ0) x_i0 - x_s0)`: tangent and gap.
fn sliding(contact: &Contact<'_>) -> Equation {
    let force = contact.unknowns.force;
    let (mut direction, mut by_way) = contact.start_tangent;
    if contact.start_gap.norm() > ROUNDING * contact.length {
        let tilt = contact.start_gap * (2.0 / contact.unknowns.way);
        direction += tilt;
        by_way -= tilt / contact.unknowns.way;
    }
    let scale = 1.0 / contact.length;
    let mut equation = Equation::new(force.dot(&direction) * scale, Unit::Force);
    equation.by_unknowns =
        [direction.x, direction.y, 0.0, 0.0, force.dot(&by_way)].map(|slope| scale * slope);
    equation
}
