//! Loading of scenes from files, with the same checks as for scenes built by a script.

use serde::Deserialize;

use super::ties::check_ties;
use super::{BeamDefinition, ParticleDefinition, RigidBodyDefinition, Scene, StationVelocity};
use crate::beams::Station;
use crate::geometry::Vec2;
use crate::joints::{Joint, Partner, Release, Slider, Track};
use crate::loads::Load;
use crate::system::SystemError;
use crate::system::elements::{Drive, Element, ElementDef, SceneChecks};
use crate::system::errors::{check_name, finite};

/// Largest number of sliders in a stored scene. The size of the matrix of a step grows with the square of the number of sliders.
const MOST_SLIDERS: usize = 2000;

const MOST_TRACKS: usize = 1000;

const MOST_SENSORS: usize = 10_000;

#[derive(Deserialize)]
pub struct StoredScene {
    name: String,
    beams: Vec<BeamDefinition>,
    particles: Vec<ParticleDefinition>,
    rigid_bodies: Vec<RigidBodyDefinition>,
    stations: Vec<Station>,
    joints: Vec<Joint>,
    tracks: Vec<Track>,
    sliders: Vec<Slider>,
    drives: Vec<Drive>,
    releases: Vec<Release>,
    velocities: Vec<StationVelocity>,
    elements: Vec<Element>,
    gravity: Vec2,
    sensors: Vec<String>,
}

impl TryFrom<StoredScene> for Scene {
    type Error = SystemError;

    fn try_from(stored: StoredScene) -> Result<Self, SystemError> {
        check_name("scene", &stored.name)?;
        let mut scene = Self::new(stored.name);
        for beam in stored.beams {
            let motion = beam.motion;
            finite("start motion", "velocity", motion.velocity.as_slice())?;
            finite("start motion", "spin", &[motion.spin])?;
            finite("start motion", "centre", motion.centre.as_ref().map_or(&[], Vec2::as_slice))?;
            beam.section
                .clone()
                .validated()
                .map_err(|source| SystemError::Beam { beam: beam.name.clone(), source })?;
            scene.add_beam(beam)?;
        }
        for particle in stored.particles {
            scene.check_name("particle", &particle.name)?;
            finite("particle", "position", particle.position.as_slice())?;
            scene.particles.push(particle);
        }
        for body in stored.rigid_bodies {
            scene.check_rigid_body(&body)?;
            scene.rigid_bodies.push(body);
        }
        for station in &stored.stations {
            scene.check_station("a station", station)?;
        }
        scene.stations = stored.stations;
        for joint in stored.joints {
            let Joint { kind, station, partner, .. } = joint;
            scene.check_station("a joint", &station)?;
            if let Partner::Station(other) = &partner {
                scene.check_station("a joint", other)?;
            }
            let name = scene.name_of_new_joint(kind, &station, &partner);
            scene.joints.push(Joint { name, kind, station, partner });
        }
        check_ties(&scene)?;
        for element in stored.elements {
            scene.add_stored_element(element)?;
        }
        scene.check_count(
            stored.sliders.len(),
            MOST_SLIDERS,
            ("number of sliders", "at most 2000 in a file"),
        )?;
        scene.check_count(
            stored.tracks.len(),
            MOST_TRACKS,
            ("number of tracks", "at most 1000 in a file"),
        )?;
        for track in stored.tracks {
            scene.add_stored_track(track)?;
        }
        for slider in stored.sliders {
            scene.check_station("a slider", &slider.slave)?;
            scene.check_stored_track(&slider)?;
            scene.check_station("a slider", &Station::on_beam(slider.master, slider.arc_length))?;
            scene.add_slider(slider)?;
        }
        for drive in stored.drives {
            scene.add_drive(drive)?;
        }
        for release in stored.releases {
            scene.add_release(release)?;
        }
        for velocity in &stored.velocities {
            scene.check_station("a start velocity", &velocity.station)?;
            finite("start velocity", "velocity", velocity.velocity.as_slice())?;
            finite("start velocity", "spin", velocity.spin.as_slice())?;
        }
        scene.velocities = stored.velocities;
        finite("scene", "gravity", stored.gravity.as_slice())?;
        scene.gravity = stored.gravity;
        scene.check_count(
            stored.sensors.len(),
            MOST_SENSORS,
            ("number of sensors", "at most 10000 in a file"),
        )?;
        stored.sensors.iter().try_for_each(|sensor| scene.record(sensor))?;
        Ok(scene)
    }
}

impl Scene {
    fn add_stored_element(&mut self, element: Element) -> Result<(), SystemError> {
        match element {
            Element::PointMass(mass) => self.add_mass(mass),
            Element::Spring(spring) => self.add_spring(spring),
            Element::Damping(damping) => self.add_damping(damping.beam, damping.relaxation),
            Element::Drag(drag) => self.add_drag(drag),
            Element::Obstacle(obstacle) => self.add_obstacle(obstacle),
            Element::Contact(contact) => self.add_contact(contact),
            Element::Load(load) => {
                if let Some(title) = &load.title {
                    self.check_name("load", title)?;
                }
                load.check(self)?;
                let name = self.name_of_load(&load.kind);
                self.add_element(Element::Load(Load { name, ..load }))
            }
        }
    }

    fn check_count(
        &self,
        count: usize,
        most: usize,
        (name, allowed): (&'static str, &'static str),
    ) -> Result<(), SystemError> {
        if count <= most {
            return Ok(());
        }
        let object = format!("scene '{}'", self.name);
        Err(SystemError::Value { object, name, value: count as f64, allowed })
    }
}
