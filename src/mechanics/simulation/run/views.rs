//! Positions, paths and configurations of a simulation for drawing.

use super::Simulation;
use crate::beams::{BodyPoint, Station};
use crate::geometry::Vec2;
use crate::joints::Releasable;
use crate::simulation::{Arrival, ArrivalKind, DrawnConfiguration, Outline, ReleaseEvent};
use crate::system::SystemError;
use crate::vibration::{Modes, VibrationError};

impl Simulation {
    /// Position of a station on its body.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn place(&self, station: &Station) -> Result<BodyPoint, SystemError> {
        self.scene.place(station, self.model.meshes())
    }

    /// Returns true if a column of the history contains means over the last step, such as contact forces.
    pub fn is_step_mean(&self, column: &str) -> bool {
        let mut sensors = self.record.sensors.iter();
        let sensor = sensors.find(|sensor| sensor.name == column);
        sensor.is_some_and(|sensor| sensor.is_step_mean(self.settings.method))
    }

    /// Lowest natural modes about the present configuration.
    /// The present configuration is treated as an equilibrium with its section forces and constraint forces.
    ///
    /// # Errors
    /// Fails if there are too few modes, a load is a follower load, forces are undetermined, or the search is stopped.
    pub fn modes(
        &mut self,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Modes, VibrationError> {
        self.model
            .with_present_link_forces(|model| Modes::of(model, count, goes_on))
            .map_err(|error| VibrationError::NoForces(error.to_string()))?
    }

    /// Path of a point of a body: times and positions in all recorded configurations.
    pub fn path(&self, place: &BodyPoint) -> Vec<(f64, Vec2)> {
        let counts: Vec<usize> = self.model.control_points().map(<[Vec2]>::len).collect();
        let offset = counts[..place.body].iter().sum::<usize>();
        let at = |index: usize| -> Vec2 {
            let numbers = self.record.trajectory.configuration(index);
            place
                .weights()
                .map(|(point, w)| {
                    Vec2::new(numbers[2 * (offset + point)], numbers[2 * (offset + point) + 1]) * w
                })
                .sum()
        };
        self.record
            .trajectory
            .times()
            .iter()
            .enumerate()
            .map(|(index, &time)| (time, at(index)))
            .collect()
    }

    /// Present configuration for drawing.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn configuration(&self) -> Result<DrawnConfiguration, SystemError> {
        let bodies: Vec<&[Vec2]> = self.model.control_points().collect();
        Ok(Outline::draw(self.outlines()?, self.time(), &bodies))
    }

    /// Recorded configuration nearest to a time, for drawing; `None` if nothing is recorded.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn configuration_near(&self, time: f64) -> Result<Option<DrawnConfiguration>, SystemError> {
        let Some(index) = self.record.trajectory.nearest(time) else { return Ok(None) };
        let bodies = self.control_points_at(index);
        let bodies: Vec<&[Vec2]> = bodies.iter().map(Vec::as_slice).collect();
        Ok(Some(Outline::draw(self.outlines()?, self.record.trajectory.times()[index], &bodies)))
    }

    /// Time at which an object was released, or at which a slider was released at an end of its master [time]; `None` if neither occurred.
    pub fn release_of(&self, hold: Releasable) -> Option<f64> {
        let is_release = |arrival: &&Arrival| {
            Releasable::Slider(arrival.slider) == hold && arrival.kind == ArrivalKind::Released
        };
        let left = self.arrivals().iter().find(is_release).map(|arrival| arrival.time);
        let is_it = |gone: &&ReleaseEvent| self.scene.releases[gone.release].object == hold;
        left.or_else(|| self.releases().iter().find(is_it).map(|gone| gone.time))
    }

    /// Present positions of stations [length].
    ///
    /// # Errors
    /// Fails if a station lies outside its beam.
    pub fn stations(&self, stations: &[Station]) -> Result<Vec<Vec2>, SystemError> {
        stations.iter().map(|at| Ok(self.model.position(&self.place(at)?))).collect()
    }

    /// Positions of stations in the recorded configuration nearest to a time [length].
    ///
    /// # Errors
    /// Fails if a station lies outside its beam.
    pub fn stations_near(&self, stations: &[Station], time: f64) -> Result<Vec<Vec2>, SystemError> {
        let Some(index) = self.record.trajectory.nearest(time) else {
            return self.stations(stations);
        };
        let bodies = self.control_points_at(index);
        let at = |station| {
            let place = self.place(station)?;
            Ok(place.interpolate(&bodies[place.body]))
        };
        stations.iter().map(at).collect()
    }
}
