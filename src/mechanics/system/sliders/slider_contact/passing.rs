//! What an iterate of a contact is part of: a step in time, or a movement between two places at rest.

use super::SliderContact;
use crate::geometry::Vec2;
use crate::joints::{CONTACT_UNKNOWNS, Contact, Equation, Unit};
use crate::system::bodies::Body;

/// What an iterate of a contact is part of: [`InStep`] or [`AtRest`].
pub trait Passing {
    /// The contact of a slider in an iterate, from the increments of all movements and the unknowns of all contacts, with its equations.
    fn iterate<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [Equation; CONTACT_UNKNOWNS]);

    /// The contact with the values of its equations alone, and their units.
    fn iterate_values<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [(f64, Unit); CONTACT_UNKNOWNS]) {
        let (contact, equations) = Self::iterate(slider, bodies, increments, unknowns);
        (contact, equations.map(|equation| (equation.value, equation.unit)))
    }

    /// The contact forces on the control points of the master in the window of the way [force], in order.
    fn forces<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = Vec2> + 'c;

    /// The derivatives of these forces, in order: by `λ` and by `η` a factor each, by `Δξ` a force.
    fn slopes<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = (f64, f64, Vec2)> + 'c;

    /// How long the chord of the way is, over the way itself along the axis as drawn [-].
    fn chord(contact: &Contact<'_>) -> f64;
}

/// A step in time.
pub struct InStep;

/// A movement between two places at rest.
pub struct AtRest;

impl Passing for InStep {
    fn iterate<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [Equation; CONTACT_UNKNOWNS]) {
        let law = slider.law();
        let contact = slider.take(bodies, increments, unknowns);
        let equations = law.equations(&contact);
        (contact, equations)
    }

    fn iterate_values<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [(f64, Unit); CONTACT_UNKNOWNS]) {
        let law = slider.law();
        let contact = slider.take(bodies, increments, unknowns);
        let values = law.values(&contact);
        (contact, values)
    }

    fn forces<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = Vec2> + 'c {
        contact.master_forces()
    }

    fn slopes<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = (f64, f64, Vec2)> + 'c {
        contact.master_force_slopes()
    }

    fn chord(contact: &Contact<'_>) -> f64 {
        contact.tangent().value.norm() / contact.length
    }
}
