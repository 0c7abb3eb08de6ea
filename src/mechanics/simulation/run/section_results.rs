//! Section results of a simulation.

use super::Simulation;
use crate::beams::{SectionForces, Station};
use crate::system::{BeamPlaces, BeamSample, BodyEnergy, Instant, SectionSample, SystemError};

impl Simulation {
    /// Section forces and strains at a station in the present configuration: see [`System::section_forces`](crate::system::System::section_forces).
    ///
    /// # Errors
    /// Fails if the station lies outside its beam, or if it belongs to a particle or a rigid body.
    pub fn section_forces(&self, station: &Station) -> Result<SectionForces, SystemError> {
        let at = self.model.cross_section(&self.scene, station)?;
        Ok(self.model.section_forces(&at))
    }

    /// Section forces along a beam in the present configuration, from its start to its end.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn section_forces_along(&self, beam: usize) -> Result<Vec<SectionSample>, SystemError> {
        self.model.section_forces_along(&self.scene, beam)
    }

    /// Positions along a beam for repeated sampling: its knots, and `within_a_span` positions between consecutive knots.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn places_along(
        &self,
        beam: usize,
        within_a_span: usize,
    ) -> Result<BeamPlaces, SystemError> {
        self.model.places_along(&self.scene, beam, within_a_span)
    }

    /// Samples a beam in the present configuration, from its start to its end.
    pub fn sample_along(&self, along: &BeamPlaces) -> Vec<BeamSample> {
        self.model.sample_along(along)
    }

    /// Instantaneous accelerations and forces: see [`System::instant`](crate::system::System::instant).
    ///
    /// # Errors
    /// Fails if a load has no value, or if contact forces are undetermined.
    pub fn instant(&mut self) -> Result<Instant, SystemError> {
        self.model.instant()
    }

    /// Energy of a body: kinetic, strain and potential energy. Body indices count beams first, then particles, then rigid bodies.
    pub fn energy_of(&mut self, body: usize) -> BodyEnergy {
        self.model.energy_of(body)
    }

    /// Number of columns whose values the caller provides after every row.
    pub fn outside_columns(&self) -> usize {
        let sensors = self.scene.sensors.iter();
        sensors.filter(|sensor| sensor.is_external()).count()
    }

    /// Sets the columns whose values the caller provides, in the last row of the history.
    pub fn fill_in(&mut self, values: &[f64]) {
        let first = self.record.history.extra_width() - self.scene.sensors.len();
        let sensors = self.scene.sensors.iter().enumerate();
        let outside = sensors.filter(|(_, sensor)| sensor.is_external());
        for ((column, _), value) in outside.zip(values) {
            self.record.history.fill_in(first + column, *value);
        }
    }
}
