//! Blows at the end of a master, and the waves that run through beams from there: how long a blow lasts, which bounces must resolve.

use crate::beams::Section;
use crate::elementary::square;

/// What two that strike each other along a master set against the blow: the masses that answer at once, none where it is held, or so
/// heavy that it does not give way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialImpact {
    /// The mass of the slave that answers at once to a blow [mass].
    pub slave: Option<f64>,
    /// The mass of the master that answers at once to a blow [mass].
    pub master: Option<f64>,
}

/// A beam as a bar through which the wave of a blow runs.
#[derive(Debug, Clone, Copy)]
pub struct ImpactBar {
    /// The length of the beam as drawn [length].
    pub length: f64,
    pub section: Section,
}

impl ImpactBar {
    /// The time that a wave takes through the beam from a blow at such an angle to its axis [time], of which the cosine is given, if
    /// what strikes it does not come to rest sooner: with its mass, where it has one, in the time `m/(c ρA)`.
    ///
    /// Along the axis it is an axial wave, across it one of shear: `c² ρA = EA cos²α + GA sin²α`.
    pub fn answer_time(&self, cosine: f64, mass: Option<f64>) -> f64 {
        let Self { length, section } = self;
        let along = square(cosine).min(1.0);
        let stiffness = section.axial_stiffness * along + section.shear_stiffness * (1.0 - along);
        let speed = (stiffness / section.mass_per_length).sqrt();
        mass.map_or(*length, |mass| length.min(mass / section.mass_per_length)) / speed
    }
}
