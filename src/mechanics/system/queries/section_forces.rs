//! What the cross sections of a beam transmit.

use super::beam_places::{BeamPlaces, BeamSample};
use crate::beams::{BodyIndex, SectionForces, SectionPlace, SectionPoints, Station};
use crate::integrators::Mechanism;
use crate::system::{Scene, System, SystemError};

/// A station of a beam, found among the quadrature points once, to be asked often.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossSection {
    body: usize,
    place: SectionPlace,
}

/// The section forces at a place along a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionSample {
    /// The arc length of the place from the start of the beam as drawn [length].
    pub arc_length: f64,
    /// The section forces and strains at the place.
    pub forces: SectionForces,
}

impl System {
    /// A station of a beam as section forces need it; where a joint cuts the beam, the side that begins there.
    ///
    /// # Errors
    /// When the station lies outside its beam, or on a particle.
    pub fn cross_section(
        &self,
        scene: &Scene,
        station: &Station,
    ) -> Result<CrossSection, SystemError> {
        let BodyIndex::Beam(beam) = station.body else {
            return Err(SystemError::NoSection { body: scene.name_of_body(station) });
        };
        let (definition, mesh) = (&scene.beams[beam], &self.meshes()[beam]);
        let xi = station
            .parameter(&definition.axis, mesh)
            .map_err(SystemError::geometry(&definition.name))?;
        let points = self.section_points(scene, beam)?;
        let place = points.at(xi).map_err(SystemError::beam(&definition.name))?;
        Ok(CrossSection { body: beam, place })
    }

    /// Section forces in the present configuration, by the law of the material from the strains there, as they balance loads and inertia:
    /// see [`SectionPlace`].
    ///
    /// In a step of the energy-momentum method the balance has those of its middle, which are the mean of those at its ends: where a stiff beam rings
    /// from step to step, the mean of two neighbouring steps does not.
    ///
    /// A material that is damped adds what the present rates ask for; strains are those there are, whatever the rates.
    pub fn section_forces(&self, at: &CrossSection) -> SectionForces {
        let of_strains = self.bodies()[at.body].dynamics.section_forces(&at.place);
        self.with_damping(of_strains, at.body, &at.place)
    }

    /// Section forces of strains with those of the damping of the material.
    pub(super) fn with_damping(
        &self,
        of_strains: SectionForces,
        beam: usize,
        place: &SectionPlace,
    ) -> SectionForces {
        let bodies = self.bodies();
        let viscous = self
            .elements()
            .resistances()
            .filter_map(|resistance| resistance.transmitted(bodies, (beam, place), self.rates()));
        viscous.fold(of_strains, SectionForces::with_viscous)
    }

    /// The section forces along a beam, from its start to its end: at the knots and at three places between. Where a joint cuts the beam there are two
    /// rows of the same arc length, that of the part before and that of the part behind.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn section_forces_along(
        &self,
        scene: &Scene,
        beam: usize,
    ) -> Result<Vec<SectionSample>, SystemError> {
        let places = self.places_along(scene, beam, BeamPlaces::WITHIN_A_SPAN)?;
        let samples = self.sample_along(&places);
        let section = |sample: BeamSample| SectionSample {
            arc_length: sample.arc_length,
            forces: sample.forces,
        };
        Ok(samples.into_iter().map(section).collect())
    }

    pub(super) fn section_points(
        &self,
        scene: &Scene,
        beam: usize,
    ) -> Result<SectionPoints, SystemError> {
        SectionPoints::of(&self.meshes()[beam]).map_err(SystemError::beam(&scene.beams[beam].name))
    }
}
