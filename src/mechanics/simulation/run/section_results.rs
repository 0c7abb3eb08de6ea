//! Looking inside the beams of a simulation.

use super::Simulation;
use crate::beams::{SectionForces, Station};
use crate::system::{
    BeamPlaces, BeamSample, BodyEnergy, Instant, Probe, SectionSample, SystemError,
};

impl Simulation {
    /// Section forces and strains at a station, in the present configuration: see [`Model::section_forces`](crate::system::Model::section_forces).
    ///
    /// # Errors
    /// When the station lies outside its beam, or on a particle.
    pub fn section_forces(&self, station: &Station) -> Result<SectionForces, SystemError> {
        let at = self.model.cross_section(&self.scene, station)?;
        Ok(self.model.section_forces(&at))
    }

    /// The section forces of the simulation along a beam in the present configuration, from its start to its end.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn section_forces_along(&self, beam: usize) -> Result<Vec<SectionSample>, SystemError> {
        self.model.section_forces_along(&self.scene, beam)
    }

    /// Places along a beam, found once, at which it is sampled: its knots, and so many between each two of them.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn places_along(
        &self,
        beam: usize,
        within_a_span: usize,
    ) -> Result<BeamPlaces, SystemError> {
        self.model.places_along(&self.scene, beam, within_a_span)
    }

    /// What a beam does in the present configuration, from its start to its end.
    pub fn sample_along(&self, along: &BeamPlaces) -> Vec<BeamSample> {
        self.model.sample_along(along)
    }

    /// Accelerations and forces at the present moment: see [`Model::instant`](crate::system::Model::instant).
    ///
    /// # Errors
    /// When a load has no value, or contact forces are not determined.
    pub fn instant(&mut self) -> Result<Instant, SystemError> {
        self.model.instant()
    }

    /// The energy of a body by kind: beams come first, then particles.
    pub fn energy_of(&mut self, body: usize) -> BodyEnergy {
        self.model.energy_of(body)
    }

    /// How many columns somebody outside is to fill in after every row, in the order in which they were described.
    pub fn outside_columns(&self) -> usize {
        let sensors = self.scene.sensors.iter();
        sensors.filter(|sensor| sensor.probe == Probe::Outside).count()
    }

    /// Fills in the values of these columns in the last row of the history.
    pub fn fill_in(&mut self, values: &[f64]) {
        let first = self.record.history.extra_width() - self.scene.sensors.len();
        let sensors = self.scene.sensors.iter().enumerate();
        let outside = sensors.filter(|(_, sensor)| sensor.probe == Probe::Outside);
        for ((column, _), value) in outside.zip(values) {
            self.record.history.fill_in(first + column, *value);
        }
    }
}
