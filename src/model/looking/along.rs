//! What there is along a beam: where its sections are, how they move and what they transmit.

use super::SectionSample;
use crate::beams::{SectionForces, Station};
use crate::geometry::Vec2;
use crate::model::{Model, ModelError, Scene};

/// A place along a beam at the present moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlongSample {
    /// From the start of the beam as drawn [length].
    pub arc_length: f64,
    /// Where it is [length].
    pub position: Vec2,
    /// How fast it moves [length/time].
    pub velocity: Vec2,
    /// What is transmitted there.
    pub forces: SectionForces,
}

impl AlongSample {
    /// The energy that the strains there store, per length as drawn: `(N Γ1 + Q Γ2 + M κ)/2` [energy/length].
    pub fn strain_energy(&self) -> f64 {
        let SectionForces { axial, shear, moment, axial_strain, shear_strain, curvature, .. } =
            self.forces;
        0.5 * (axial * axial_strain + shear * shear_strain + moment * curvature)
    }
}

impl Model {
    /// What there is along a beam, from its start to its end, at the places of [`section_forces_along`](Self::section_forces_along).
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn along(&self, scene: &Scene, beam: usize) -> Result<Vec<AlongSample>, ModelError> {
        let length = scene.beams[beam].axis.length();
        let sample = |SectionSample { arc_length, forces }: SectionSample| {
            // Rounding must not lead off the beam.
            let station = Station::on_beam(beam, arc_length.clamp(0.0, length));
            let place = scene.place(&station, self.meshes())?;
            let (position, velocity) = (self.position(&place), self.velocity(&place));
            Ok(AlongSample { arc_length, position, velocity, forces })
        };
        self.section_forces_along(scene, beam)?.into_iter().map(sample).collect()
    }
}
