//! Scenes and states from a file: whatever it holds, they are checked as if a person had written them.

use serde::Deserialize;

use crate::beams::{BodyIndex, Station};
use crate::geometry::Vec2;
use crate::joints::{Joint, Partner, Slider};
use crate::loads::{Load, LoadKind};
use crate::model::assembly::check_ties;
use crate::model::looking::ModelState;
use crate::model::sliders::{LANDED, Sliding};
use crate::model::{
    BeamDefinition, Model, ModelError, ParticleDefinition, PointMass, Scene, StationVelocity,
};

/// Most sliders of a stored scene: the matrix of a step grows with their square, and a small file must not make it huge.
const MOST_SLIDERS: usize = 2000;

/// A [`Scene`] as it is stored, not yet checked.
#[derive(Deserialize)]
pub(in crate::model) struct StoredScene {
    name: String,
    beams: Vec<BeamDefinition>,
    particles: Vec<ParticleDefinition>,
    stations: Vec<Station>,
    joints: Vec<Joint>,
    sliders: Vec<Slider>,
    masses: Vec<PointMass>,
    velocities: Vec<StationVelocity>,
    loads: Vec<Load>,
    gravity: Vec2,
}

impl TryFrom<StoredScene> for Scene {
    type Error = ModelError;

    fn try_from(stored: StoredScene) -> Result<Self, ModelError> {
        let mut scene = Self::new(stored.name);
        for beam in stored.beams {
            let motion = beam.motion;
            finite("start motion", "velocity", motion.velocity.as_slice())?;
            finite("start motion", "spin", &[motion.spin])?;
            finite("start motion", "centre", motion.about.as_ref().map_or(&[], Vec2::as_slice))?;
            beam.section
                .validated()
                .map_err(|source| ModelError::Beam { beam: beam.name.clone(), source })?;
            scene.add_beam(beam)?;
        }
        for particle in stored.particles {
            scene.check_name("particle", &particle.name)?;
            finite("particle", "position", particle.position.as_slice())?;
            scene.particles.push(particle);
        }
        for station in &stored.stations {
            scene.check_station("a station", station)?;
        }
        scene.stations = stored.stations;
        for joint in &stored.joints {
            scene.check_station("a joint", &joint.station)?;
            if let Partner::Station(other) = &joint.partner {
                scene.check_station("a joint", other)?;
            }
        }
        scene.joints = stored.joints;
        check_ties(&scene)?;
        for mass in stored.masses {
            scene.check_station("a mass", &mass.station)?;
            scene.add_mass(mass)?;
        }
        if stored.sliders.len() > MOST_SLIDERS {
            return Err(ModelError::Value {
                object: format!("scene '{}'", scene.name),
                name: "number of sliders",
                value: stored.sliders.len() as f64,
                allowed: "at most 2000 in a file",
            });
        }
        for slider in stored.sliders {
            scene.check_station("a slider", &slider.slave)?;
            scene.check_station("a slider", &Station::on_beam(slider.master, slider.arc_length))?;
            scene.add_slider(slider)?;
        }
        for velocity in &stored.velocities {
            scene.check_station("a start velocity", &velocity.station)?;
            finite("start velocity", "velocity", velocity.velocity.as_slice())?;
            finite("start velocity", "spin", velocity.spin.as_slice())?;
        }
        scene.velocities = stored.velocities;
        for load in &stored.loads {
            scene.check_load(load)?;
        }
        scene.loads = stored.loads;
        finite("scene", "gravity", stored.gravity.as_slice())?;
        scene.gravity = stored.gravity;
        Ok(scene)
    }
}

fn finite(object: &str, name: &'static str, values: &[f64]) -> Result<(), ModelError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let allowed = "a finite number";
            Err(ModelError::Value { object: object.to_owned(), name, value, allowed })
        }
        None => Ok(()),
    }
}

impl Scene {
    fn check_station(&self, object: &'static str, station: &Station) -> Result<(), ModelError> {
        let (kind, index, count) = match station.body {
            BodyIndex::Beam(index) => ("beam", index, self.beams.len()),
            BodyIndex::Particle(index) => ("particle", index, self.particles.len()),
        };
        if index >= count {
            return Err(ModelError::Missing { object, kind, index, count });
        }
        let length = self.length_at(station);
        if (0.0..=length).contains(&station.arc_length) {
            return Ok(());
        }
        let beam = self.name_of_body(station);
        Err(ModelError::StationOutside { beam, station: station.arc_length, length })
    }

    fn check_load(&self, load: &Load) -> Result<(), ModelError> {
        match &load.kind {
            LoadKind::Force { station, force, .. } => {
                self.check_station("a load", station)?;
                finite(&load.name, "force", force.as_slice())
            }
            LoadKind::Moment { station, moment } => {
                self.check_station("a load", station)?;
                finite(&load.name, "moment", &[*moment])
            }
            LoadKind::Line { beam, force, .. } => {
                self.check_station("a load", &Station::on_beam(*beam, 0.0))?;
                finite(&load.name, "force", force.as_slice())
            }
        }
    }
}

impl Model {
    /// Takes a state from a file, as [`restore`](Self::restore) does for one that is known to be of this model.
    ///
    /// # Errors
    /// When it cannot be one of this model.
    pub fn restore_checked(&mut self, state: &ModelState) -> Result<(), ModelError> {
        let refused = |reason: &'static str| ModelError::State { reason };
        let numbers = state.numbers();
        if numbers.len() != self.state().numbers().len() {
            return Err(refused("it has more or fewer numbers"));
        }
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(refused("a number of it is not finite"));
        }
        // The numbers of the sliders stand last, a mark and the parameter first of each.
        let width = Sliding::SAVED;
        let of_sliders = &numbers[numbers.len() - width * self.sliders.len()..];
        for (slider, own) in self.sliders.iter().zip(of_sliders.chunks_exact(width)) {
            let (first, last) = slider.domain();
            // Where it has landed it may be beside the end by rounding.
            let slack = LANDED * (last - first);
            if ![0.0, 1.0, 2.0, 3.0].contains(&own[0])
                || !(first - slack..=last + slack).contains(&own[1])
            {
                return Err(refused("a slider is beside its beam"));
            }
        }
        self.restore(state);
        Ok(())
    }
}
