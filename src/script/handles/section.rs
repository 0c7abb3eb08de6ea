//! A cross section that a script holds.

use crate::beams::{Relaxation, Section};
use crate::output::significant;
use crate::script::looks::details;
use crate::script::rows::kind::{Details, Scripted};

/// Digits of a stiffness or an inertia where it is shown.
const DIGITS: usize = 7;

/// A cross section, and the damping of its material, if it has any.
#[derive(Clone)]
pub struct SectionHandle {
    /// Its stiffness and inertia.
    pub section: Section,
    /// The relaxation times of its material; none of an elastic one.
    pub relaxation: Option<Relaxation>,
}

impl Scripted for SectionHandle {
    const NAME: &'static str = "section";
    const DOC: &'static str = "A cross section: stiffness and inertia.";

    fn show(&self) -> String {
        let section = &self.section;
        let [ea, ga, ei, mass, rotary] = [
            section.axial_stiffness,
            section.shear_stiffness,
            section.bending_stiffness,
            section.mass_per_length,
            section.rotary_inertia,
        ]
        .map(|number| significant(number, DIGITS));
        let damped = self.relaxation.map(|of| format!(", {}", in_words(&of))).unwrap_or_default();
        format!("section with EA {ea}, GA {ga}, EI {ei}, rho_A {mass}, rho_I {rotary}{damped}")
    }

    fn details(&self) -> Details {
        let damped = self.relaxation.map(|of| ("material".to_owned(), in_words(&of)));
        details::of_section(&self.section).into_iter().chain(damped).collect()
    }
}

/// The relaxation times of a material in words.
fn in_words(relaxation: &Relaxation) -> String {
    let Relaxation { axial, shear, bending } = *relaxation;
    let [axial, shear, bending] = [axial, shear, bending].map(|time| significant(time, DIGITS));
    format!("relaxation times axial {axial}, shear {shear}, bending {bending}")
}
