//! Looking at a model: places, angles, and its state as numbers.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Place, Station};
use crate::geometry::Vec2;
use crate::model::{Model, Resolution, Scene};

impl Model {
    /// The time of the state.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The meshes of the beams, with breaks where joints are.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// The control points of all bodies: beams first, then particles [length].
    pub fn control_points(&self) -> impl Iterator<Item = &[Vec2]> {
        self.bodies.iter().map(|body| body.dynamics.control_points())
    }

    /// The mass of everything.
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// How far the steps so far resolve the motion.
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// Where a place is [length].
    pub fn position(&self, place: &Place) -> Vec2 {
        place.interpolate(self.bodies[place.body].dynamics.control_points())
    }

    /// How fast a place moves [length/time].
    pub fn velocity(&self, place: &Place) -> Vec2 {
        let [x, y, _] = self.bodies[place.body].at(place, &self.rates);
        Vec2::new(x, y)
    }

    /// The angle of the section at the start or the end of a beam, unwrapped [rad].
    pub fn end_angles(&self, beam: usize) -> (f64, f64) {
        (self.trackers[2 * beam].angle, self.trackers[2 * beam + 1].angle)
    }

    /// The angle of the section at a station, unwrapped [rad]; none when the scene did not know it at the start.
    pub fn angle(&self, scene: &Scene, station: &Station) -> Option<f64> {
        let beam = station.beam()?;
        let (start, end) = self.end_angles(beam);
        if station.arc_length == 0.0 {
            return Some(start);
        }
        if station.arc_length == scene.beams[beam].axis.length() {
            return Some(end);
        }
        let known = scene.stations.iter().position(|other| other == station)?;
        self.trackers.get(2 * scene.beams.len() + known).map(|tracker| tracker.angle)
    }

    /// Everything that the motion from here on depends on, and the sums so far.
    pub fn state(&self) -> ModelState {
        let mut state = ModelState::default();
        self.write_state(&mut state);
        state.0.shrink_to_fit();
        state
    }

    /// Writes the [`state`](Self::state) into one that may hold another; where that is one of this model, nothing is allocated.
    pub fn write_state(&self, ModelState(state): &mut ModelState) {
        self.write_numbers(state);
    }

    pub(in crate::model) fn write_numbers(&self, state: &mut Vec<f64>) {
        state.clear();
        let sums = &self.exchanged;
        state.extend([self.time, sums.work, sums.impulse.x, sums.impulse.y]);
        state.extend([sums.angular_impulse, sums.gross_impulse, sums.gross_angular_impulse]);
        state.extend(&self.rates);
        self.forecast.save(state);
        self.resolution.save(state);
        self.bodies.iter().for_each(|body| body.dynamics.save(state));
        self.all_trackers().for_each(|tracker| tracker.save(state));
        self.accelerations.save(state);
        self.sliders.iter().for_each(|slider| slider.save(state));
    }

    /// Takes back a [`state`](Self::state) of this model, bit for bit.
    ///
    /// # Panics
    /// When the state is that of another model.
    pub fn restore(&mut self, ModelState(state): &ModelState) {
        self.restore_numbers(state);
    }

    pub(in crate::model) fn restore_numbers(&mut self, state: &[f64]) {
        let mut values = state.iter().copied();
        let next = &mut || values.next().expect("the state is one of this model");
        self.time = next();
        self.exchanged.work = next();
        self.exchanged.impulse = Vec2::new(next(), next());
        self.exchanged.angular_impulse = next();
        self.exchanged.gross_impulse = next();
        self.exchanged.gross_angular_impulse = next();
        self.rates.iter_mut().for_each(|rate| *rate = next());
        self.forecast.restore(next);
        self.resolution.restore(next);
        self.bodies.iter_mut().for_each(|body| body.dynamics.restore(next));
        self.all_trackers_mut().for_each(|tracker| tracker.restore([next(), next(), next()]));
        self.accelerations.restore(next);
        self.sliders.iter_mut().for_each(|slider| slider.restore(next));
        assert!(values.next().is_none(), "the state is one of this model");
    }
}

/// The state of a [`Model`], to be taken back by the same one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ModelState(Vec<f64>);

impl ModelState {
    /// An empty one, with room for as many numbers.
    pub fn blank(&self) -> Self {
        Self(Vec::with_capacity(self.0.len()))
    }

    pub(in crate::model) fn numbers(&self) -> &[f64] {
        &self.0
    }

    /// The memory that its numbers take [bytes].
    pub fn bytes(&self) -> usize {
        self.0.capacity() * size_of::<f64>()
    }
}
