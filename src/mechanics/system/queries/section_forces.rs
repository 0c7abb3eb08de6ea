//! Section forces of a beam.

use super::beam_places::{BeamPlaces, BeamSample};
use crate::beams::{BodyIndex, SectionForces, SectionPlace, SectionPoints, Station};
use crate::integrators::Mechanism;
use crate::system::{Scene, System, SystemError};

/// Station of a beam, located between quadrature points for repeated queries.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossSection {
    body: usize,
    place: SectionPlace,
}

/// Section forces at a position along a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionSample {
    /// Arc length in the initial configuration [length].
    pub arc_length: f64,
    /// Section forces and strains at this position.
    pub forces: SectionForces,
}

impl System {
    /// Locates a station of a beam for queries of section forces. At a joint inside the beam, the position after the joint is used.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam, or if it belongs to a particle or a rigid body.
    pub(crate) fn cross_section(
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

    /// Section forces of a beam in the present configuration. They follow from the strains by the material law: see [`SectionPlace`].
    ///
    /// In a step of the energy–momentum method, loads and inertia are balanced by the mean of the section forces at the start and the end of the step.
    ///
    /// The section forces include forces of material damping, which are computed from the present rates.
    pub fn section_forces(&self, at: &CrossSection) -> SectionForces {
        let of_strains = self.bodies()[at.body].dynamics.section_forces(&at.place);
        self.with_damping(of_strains, at.body, &at.place)
    }

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

    /// Section forces along a beam from start to end, at the knots and at three positions between consecutive knots.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
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
