//! Sliding rule of equations 11 to 14 of Sibileau & Muñoz, which conserves energy and momenta, but does not keep the gap closed.

use super::contact::AXES;
use super::{CONTACT_UNKNOWNS, Contact, Equation, SlidingLaw, Unit};

/// Largest gap that is attributed to rounding, as a fraction of the change of the position on the master per unit of its parameter.
/// The direction of such a gap is undefined. The equations therefore do not use it.
const ROUNDING: f64 = 1e-13;

/// Relaxed sliding law: the mean of the gap over each step is zero. The gap at the end of a step need not be zero.
/// The relaxed law conserves energy, linear and angular momentum.
/// The relaxed law is that of Sibileau & Muñoz, equations 11 to 14.
///
/// With the relaxed law, a step may have no solution if the gap is large. The direction of sliding is undefined in a step without sliding.
#[derive(Debug, Clone, Copy)]
pub struct Relaxed;

impl SlidingLaw for Relaxed {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = closed_mean(contact);
        let [couple_x, couple_y] = contact.no_couple();
        [gap_x, gap_y, couple_x, couple_y, sliding(contact)]
    }
}

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

fn sliding(contact: &Contact<'_>) -> Equation {
    let (mut direction, gap) = (contact.start_tangent(), contact.start_gap());
    if gap.norm() > ROUNDING * contact.length {
        let tilt = gap * (2.0 / contact.unknowns.increment);
        direction.value += tilt;
        direction.by_end -= tilt / contact.unknowns.increment;
    }
    contact.frictionless(direction)
}
