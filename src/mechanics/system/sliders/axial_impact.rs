//! Durations of impacts at the end of a master, from the speeds of waves in beams. Time steps must resolve these durations.

use crate::beams::Section;
use crate::elementary::square;

/// Effective masses of slave and master for an impulse between them along the master.
/// A mass is `None` if its body is fixed, or is so much heavier than the other body that the impulse hardly changes its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialImpact {
    /// Mass of the slave [mass].
    pub slave: Option<f64>,
    /// Mass of the master [mass].
    pub master: Option<f64>,
}

#[derive(Debug, Clone, Copy)]
pub struct ImpactBar {
    pub length: f64,
    pub section: Section,
}

impl ImpactBar {
    /// Time that the wave of an impact takes from one end of the beam to the other [time].
    /// For a rigid `mass` that strikes the beam and is lighter than the beam, the time in which the mass stops is returned.
    /// `cosine` is the cosine of the angle between the direction of the impact and the axis of the beam.
    /// An impact along the axis causes an axial wave, an impact across the axis a shear wave.
    pub fn wave_travel_time(&self, cosine: f64, mass: Option<f64>) -> f64 {
        let Self { length, section } = self;
        let along = square(cosine).min(1.0);
        let stiffness = section.axial_stiffness * along + section.shear_stiffness * (1.0 - along);
        let speed = (stiffness / section.mass_per_length).sqrt();
        mass.map_or(*length, |mass| length.min(mass / section.mass_per_length)) / speed
    }
}
