//! Sliding rule that conserves energy, linear and angular momentum, and keeps the gap closed.

use super::contact::{AXES, PathVector};
use super::{CONTACT_UNKNOWNS, Contact, ContactUnknowns, Equation, SlidingLaw, Unit};
use crate::elementary::square;
use crate::geometry::{cross, perpendicular};

/// Conserving sliding law on the smooth axis of a mesh.
/// The gap is closed at the end of every step, and energy, linear and angular momentum are conserved for any step size.
///
/// Derivation: docs/theory.md, section 10.
#[derive(Debug, Clone, Copy)]
pub struct Conserving;

impl SlidingLaw for Conserving {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let [gap_x, gap_y] = contact.closed();
        let (tangent, swing) = (contact.tangent(), contact.tangent_change());
        let [couple_x, couple_y] = balanced_moment(contact, tangent, swing);
        [gap_x, gap_y, couple_x, couple_y, work_free(contact, tangent, swing)]
    }
}

fn balanced_moment(contact: &Contact<'_>, tangent: PathVector, swing: PathVector) -> [Equation; 2] {
    let ContactUnknowns { force, couple, .. } = contact.unknowns;
    let scale = 1.0 / square(contact.length);
    let (square, moment) = (tangent.value.norm_squared(), cross(swing.value, force));
    AXES.map(|axis| {
        let (couple, normal) = (couple.dot(&axis), perpendicular(tangent.value).dot(&axis));
        let by_tangent = (tangent.value * (2.0 * couple) - perpendicular(axis) * moment) * scale;
        let by_swing = perpendicular(force) * (-normal * scale);
        Equation {
            by_difference: by_tangent * 0.5 + by_swing * 0.25,
            by_unknowns: ContactUnknowns {
                force: perpendicular(swing.value) * (normal * scale),
                couple: axis * (square * scale),
                increment: by_tangent.dot(&tangent.by_end) + by_swing.dot(&swing.by_end),
            },
            ..Equation::new((square * couple + moment * normal) * scale, Unit::Force)
        }
    })
}

/// Sliding equation: the contact force and the couple together do no work.
fn work_free(contact: &Contact<'_>, tangent: PathVector, swing: PathVector) -> Equation {
    let ContactUnknowns { force, couple, .. } = contact.unknowns;
    let scale = 1.0 / contact.length;
    let mut equation = contact.frictionless(tangent);
    equation.value += 4.0 * couple.dot(&swing.value) * scale;
    equation.by_difference = (force * 0.5 + couple) * scale;
    equation.by_unknowns.couple = swing.value * (4.0 * scale);
    equation.by_unknowns.increment += 4.0 * couple.dot(&swing.by_end) * scale;
    equation
}
