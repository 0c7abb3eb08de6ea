//! A kink on the way of its slider: what the laws of kinked axes have in common.

use super::jet::{ContactJets, Jet, JetVector};
use super::{CONTACT_UNKNOWNS, Contact, Equation, Kink, Unit};
use crate::elementary::square;

/// A kink in an iterate of a step, as it follows from the way alone.
pub(super) struct KinkOnWay {
    /// The kink length `g1` at the end of the way [length].
    pub length: Jet,
    /// `Δg/Δξ` [length].
    pub difference: Jet,
    /// `Δs/Δξ` [length].
    pub stretch: Jet,
    /// `1/|τ|²` [1/length²].
    pub over_square: Jet,
    /// How far the slave was from the smooth axis at the start of the step, `g0 a0` [length].
    pub offset_before: JetVector,
    /// The mean vector `r` from where the contact pushes the master to the slave [length].
    pub arm: JetVector,
}

impl KinkOnWay {
    pub fn of(jets: &ContactJets, kink: &Kink) -> Self {
        let (along, arc) = (&kink.along, &kink.motion.arc);
        let offset_before = JetVector::constant(kink.before * (along.start * kink.compliance));
        Self {
            length: Jet::along_way(along.end, along.slope),
            difference: Jet::along_way(along.difference, along.change),
            stretch: Jet::along_way(arc.difference, arc.change),
            over_square: jets.tangent.dot(&jets.tangent).inverse(),
            offset_before,
            arm: jets.swing * jets.way + (offset_before + jets.offset) * 0.5,
        }
    }

    /// The equations of a contact whose axis is kinked by `jump` [force] at the end of the step: the gap to it is closed, the contact turns nothing, and the
    /// balance of forces along the way [force·length] vanishes.
    pub fn equations(
        &self,
        (contact, kink): (&Contact<'_>, &Kink),
        jets: &ContactJets,
        jump: JetVector,
        balance: Jet,
    ) -> [Equation; CONTACT_UNKNOWNS] {
        let &ContactJets { offset, tangent, force, couple, .. } = jets;
        let gap = offset - jump * self.length * kink.compliance;
        let balanced = couple * tangent.dot(&tangent) + tangent.turned() * self.arm.cross(&force);
        let [gap_x, gap_y] = gap.vanish(Unit::Length);
        let [couple_x, couple_y] = (balanced * (1.0 / square(contact.length))).vanish(Unit::Force);
        [gap_x, gap_y, couple_x, couple_y, (balance * (1.0 / contact.length)).vanishes(Unit::Force)]
    }
}
