//! Kink on the path of a slider: equations shared by the sliding laws for masters with a kink.
//! A kink is a jump of the tangent of the axis under the contact force.

use super::dual::{ALL_SLOPES, ContactDuals, path_dual};
use super::{CONTACT_UNKNOWNS, Contact, Equation, Kink, Unit};
use crate::elementary::square;
use crate::geometry::{Dual, DualVector};

pub(super) struct KinkOnPath<const SLOPES: usize> {
    pub length: Dual<SLOPES>,
    pub difference: Dual<SLOPES>,
    pub stretch: Dual<SLOPES>,
    pub over_square: Dual<SLOPES>,
    pub offset_before: DualVector<SLOPES>,
    pub arm: DualVector<SLOPES>,
}

pub(super) const UNITS: [Unit; CONTACT_UNKNOWNS] =
    [Unit::Length, Unit::Length, Unit::Force, Unit::Force, Unit::Force];

pub(super) fn vanish(
    numbers: [Dual<ALL_SLOPES>; CONTACT_UNKNOWNS],
) -> [Equation; CONTACT_UNKNOWNS] {
    std::array::from_fn(|at| numbers[at].vanishes(UNITS[at]))
}

impl<const SLOPES: usize> KinkOnPath<SLOPES> {
    pub fn of(duals: &ContactDuals<SLOPES>, kink: &Kink) -> Self {
        let (along, arc) = (&kink.along, &kink.motion.arc);
        let offset_before = DualVector::constant(kink.before * (along.start * kink.compliance));
        Self {
            length: path_dual(along.end, along.slope),
            difference: path_dual(along.difference, along.change),
            stretch: path_dual(arc.difference, arc.change),
            over_square: duals.tangent.dot(&duals.tangent).inverse(),
            offset_before,
            arm: duals.tangent_change * duals.increment + (offset_before + duals.offset) * 0.5,
        }
    }

    /// Residuals of the contact equations.
    /// The argument `jump` is the jump of the tangent at the end of the step, given as the force that causes this jump statically [force].
    /// The argument `balance` is the residual of the force balance along the path [force·length].
    pub fn imbalances(
        &self,
        (contact, kink): (&Contact<'_>, &Kink),
        duals: &ContactDuals<SLOPES>,
        jump: DualVector<SLOPES>,
        balance: Dual<SLOPES>,
    ) -> [Dual<SLOPES>; CONTACT_UNKNOWNS] {
        let &ContactDuals { offset, tangent, force, couple, .. } = duals;
        let gap = offset - jump * self.length * kink.compliance;
        let balanced = couple * tangent.dot(&tangent) + tangent.turned() * self.arm.cross(&force);
        let couple = balanced * (1.0 / square(contact.length));
        [gap.x, gap.y, couple.x, couple.y, balance * (1.0 / contact.length)]
    }
}
