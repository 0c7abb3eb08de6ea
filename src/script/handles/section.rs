//! Handle of a cross section in a script.

use crate::beams::{Relaxation, Section, SectionVariation, Solid};
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::presentation::details;

const DIGITS: usize = 7;

#[derive(Clone)]
pub struct SectionHandle {
    pub variation: SectionVariation,
    pub solid: Option<Solid>,
    /// Relaxation times of the material; `None` for an elastic material.
    pub relaxation: Option<Relaxation>,
}

impl Scripted for SectionHandle {
    const NAME: &'static str = "section";
    const DOC: &'static str = "A cross section, or a taper: stiffness and inertia.";

    fn show(&self) -> String {
        let damped = self.relaxation.map(|of| format!(", {}", in_words(&of))).unwrap_or_default();
        let what = match &self.variation {
            SectionVariation::Uniform(section) => format!("section with {}", numbers(section)),
            tapered => {
                let places = tapered.places().len();
                let [start, end] = [0.0, 1.0].map(|part| numbers(&tapered.at(part)));
                format!("taper over {places} places, from {start} to {end}")
            }
        };
        format!("{what}{damped}")
    }

    fn details(&self) -> Details {
        let damped = self.relaxation.map(|of| ("material".to_owned(), in_words(&of)));
        details::of_section(&self.variation.mean()).into_iter().chain(damped).collect()
    }
}

fn numbers(section: &Section) -> String {
    let [ea, ga, ei, mass, rotary] = [
        section.axial_stiffness,
        section.shear_stiffness,
        section.bending_stiffness,
        section.mass_per_length,
        section.rotary_inertia,
    ]
    .map(|number| significant(number, DIGITS));
    format!("EA {ea}, GA {ga}, EI {ei}, rho_A {mass}, rho_I {rotary}")
}

fn in_words(relaxation: &Relaxation) -> String {
    let Relaxation { axial, shear, bending } = *relaxation;
    let [axial, shear, bending] = [axial, shear, bending].map(|time| significant(time, DIGITS));
    format!("relaxation times axial {axial}, shear {shear}, bending {bending}")
}
