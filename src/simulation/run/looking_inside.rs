//! Looking inside the beams of a simulation.

use super::Simulation;
use crate::beams::{SectionForces, Station};
use crate::model::{BeamPlaces, BeamSample, ModelError, SectionSample};

impl Simulation {
    /// Section forces and strains at a station, in the present configuration: see [`Model::section_forces`](crate::model::Model::section_forces).
    ///
    /// # Errors
    /// When the station lies outside its beam, or on a particle.
    pub fn section_forces(&self, station: &Station) -> Result<SectionForces, ModelError> {
        let at = self.model.cross_section(&self.scene, station)?;
        Ok(self.model.section_forces(&at))
    }

    /// The section forces along a beam, from its start to its end.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn section_forces_along(&self, beam: usize) -> Result<Vec<SectionSample>, ModelError> {
        self.model.section_forces_along(&self.scene, beam)
    }

    /// Places along a beam, found once, at which it is sampled.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn places_along(&self, beam: usize) -> Result<BeamPlaces, ModelError> {
        self.model.places_along(&self.scene, beam)
    }

    /// What a beam does in the present configuration, from its start to its end.
    pub fn sample_along(&self, along: &BeamPlaces) -> Vec<BeamSample> {
        self.model.sample_along(along)
    }
}
