//! A kink on the way of its slider: what the laws of kinked axes have in common.

use super::dual::{ALL_SLOPES, ContactDuals, Dual, DualVector};
use super::{CONTACT_UNKNOWNS, Contact, Equation, Kink, Unit};
use crate::elementary::square;

/// A kink in an iterate of a step, as it follows from the way alone.
pub(super) struct KinkOnPath<const SLOPES: usize> {
    /// The kink length `g1` at the end of the way [length].
    pub length: Dual<SLOPES>,
    /// `Δg/Δξ` [length].
    pub difference: Dual<SLOPES>,
    /// `Δs/Δξ` [length].
    pub stretch: Dual<SLOPES>,
    /// `1/|τ|²` [1/length²].
    pub over_square: Dual<SLOPES>,
    /// How far the slave was from the smooth axis at the start of the step, `g0 a0` [length].
    pub offset_before: DualVector<SLOPES>,
    /// The mean vector `r` from where the contact pushes the master to the slave [length].
    pub arm: DualVector<SLOPES>,
}

/// The units of the equations of a contact whose axis is kinked.
pub(super) const UNITS: [Unit; CONTACT_UNKNOWNS] =
    [Unit::Length, Unit::Length, Unit::Force, Unit::Force, Unit::Force];

/// The equations that numbers vanish in their [`UNITS`].
pub(super) fn vanish(
    numbers: [Dual<ALL_SLOPES>; CONTACT_UNKNOWNS],
) -> [Equation; CONTACT_UNKNOWNS] {
    std::array::from_fn(|at| numbers[at].vanishes(UNITS[at]))
}

impl<const SLOPES: usize> KinkOnPath<SLOPES> {
    pub fn of(jets: &ContactDuals<SLOPES>, kink: &Kink) -> Self {
        let (along, arc) = (&kink.along, &kink.motion.arc);
        let offset_before = DualVector::constant(kink.before * (along.start * kink.compliance));
        Self {
            length: Dual::along_way(along.end, along.slope),
            difference: Dual::along_way(along.difference, along.change),
            stretch: Dual::along_way(arc.difference, arc.change),
            over_square: jets.tangent.dot(&jets.tangent).inverse(),
            offset_before,
            arm: jets.swing * jets.way + (offset_before + jets.offset) * 0.5,
        }
    }

    /// What vanishes for a contact whose axis is kinked by `jump` [force] at the end of the step: the gap to it is closed, the contact turns nothing, and the
    /// balance of forces along the way [force·length] vanishes.
    pub fn imbalances(
        &self,
        (contact, kink): (&Contact<'_>, &Kink),
        jets: &ContactDuals<SLOPES>,
        jump: DualVector<SLOPES>,
        balance: Dual<SLOPES>,
    ) -> [Dual<SLOPES>; CONTACT_UNKNOWNS] {
        let &ContactDuals { offset, tangent, force, couple, .. } = jets;
        let gap = offset - jump * self.length * kink.compliance;
        let balanced = couple * tangent.dot(&tangent) + tangent.turned() * self.arm.cross(&force);
        let couple = balanced * (1.0 / square(contact.length));
        [gap.x, gap.y, couple.x, couple.y, balance * (1.0 / contact.length)]
    }
}
