//! Looking inside the beams of a simulation.

use super::Simulation;
use crate::beams::{SectionForces, Station};
use crate::model::{ModelError, SectionSample};

impl Simulation {
    /// Section forces and strains at a station, in the present configuration: see [`Model::section_forces`](crate::model::Model::section_forces).
    ///
    /// # Errors
    /// When the station lies outside its beam, or on a particle.
    pub fn section_forces(&self, station: &Station) -> Result<SectionForces, ModelError> {
        let at = self.model.cross_section(&self.scene, station)?;
        Ok(self.model.section_forces(&at))
    }

    /// The section forces of the simulation along a beam in the present configuration, from its start to its end.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn section_forces_along(&self, beam: usize) -> Result<Vec<SectionSample>, ModelError> {
        self.model.section_forces_along(&self.scene, beam)
    }
}
