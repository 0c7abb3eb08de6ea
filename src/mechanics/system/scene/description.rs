//! Editable definition of a scene, which [`System`](crate::system::System) assembles.

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use super::stored::StoredScene;
use super::ties::check_ties;
use super::{BeamDefinition, ParticleDefinition, RigidBodyDefinition, StationVelocity};
use crate::beams::{BodyIndex, BodyPoint, Mesh, Station};
use crate::geometry::{Vec2, is_on_length};
use crate::joints::{Joint, JointKind, Partner, Release, Slider, Track};
use crate::loads::{Load, Schedule};
use crate::system::elements::{
    ContactTarget, Drive, Element, MaterialDamping, PointMass, SceneChecks, Spring,
};
use crate::system::errors::{check_name, rounded};
use crate::system::{Sensor, SystemError};

/// Scene: beams, particles, rigid bodies, joints, masses and loads to be simulated.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(try_from = "StoredScene")]
pub struct Scene {
    /// Name of the scene in messages and reports.
    pub name: String,
    /// Beams, in the order of addition.
    pub beams: Vec<BeamDefinition>,
    /// Particles, in the order of addition.
    pub particles: Vec<ParticleDefinition>,
    /// Rigid bodies, in the order of addition.
    pub rigid_bodies: Vec<RigidBodyDefinition>,
    /// Stations with tracked section angles, in addition to the ends of beams.
    pub stations: Vec<Station>,
    /// Supports, and joints between bodies.
    pub joints: Vec<Joint>,
    /// Tracks along which sliders pass from beam to beam.
    pub tracks: Vec<Track>,
    /// Sliding joints.
    pub sliders: Vec<Slider>,
    /// Prescribed motions of stations, in the order of addition.
    pub drives: Vec<Drive>,
    /// Releases during a run, in the order of addition.
    pub releases: Vec<Release>,
    /// Start velocities of single nodes.
    pub velocities: Vec<StationVelocity>,
    /// Masses, loads, springs and other elements, in the order of addition.
    pub elements: Vec<Element>,
    /// Gravitational acceleration [length/time²].
    pub gravity: Vec2,
    /// Recorded quantities in addition to the standard columns.
    pub sensors: Vec<Sensor>,
}

impl Scene {
    /// Length of the longest beam [length]; `None` without beams.
    pub fn longest_beam(&self) -> Option<f64> {
        self.beams.iter().map(|beam| beam.axis.length()).reduce(f64::max)
    }

    /// Returns the scene with about `ratio` times as many spans in each beam.
    /// At least one span remains between two neighbouring knots at which the mesh is less smooth than elsewhere.
    ///
    /// # Errors
    /// Fails if a beam would have too many or too short spans.
    pub fn with_span_ratio(&self, ratio: f64) -> Result<Self, SystemError> {
        let mut scaled = self.clone();
        for beam in &mut scaled.beams {
            let mesh = beam.mesh.with_span_ratio(ratio);
            beam.mesh = mesh.map_err(SystemError::geometry(&beam.name))?;
        }
        Ok(scaled)
    }

    /// Total mass of the scene [mass].
    pub fn mass(&self) -> f64 {
        let beams: f64 = self.beams.iter().map(BeamDefinition::mass).sum();
        beams + self.masses().map(|mass| mass.mass).sum::<f64>()
    }

    pub(crate) fn fastest_wave(&self) -> f64 {
        let sections = self.beams.iter().flat_map(|beam| beam.section.sections());
        let squares = sections.map(|section| section.axial_stiffness / section.mass_per_length);
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Joints with a station on a beam.
    pub fn joints_of(&self, beam: usize) -> impl Iterator<Item = &Joint> {
        self.joints.iter().filter(move |joint| {
            let other = match joint.partner {
                Partner::Ground => None,
                Partner::Station(other) => other.beam(),
            };
            joint.station.beam() == Some(beam) || other == Some(beam)
        })
    }

    /// Point masses, including those of particles, in the order of addition.
    pub fn masses(&self) -> impl Iterator<Item = &PointMass> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::PointMass(mass) => Some(mass),
            _ => None,
        })
    }

    /// Loads, in the order of addition.
    pub fn loads(&self) -> impl Iterator<Item = &Load> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Load(load) => Some(load),
            _ => None,
        })
    }

    /// Springs, dampers, tendons and brakes, in the order of addition.
    pub fn springs(&self) -> impl Iterator<Item = &Spring> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Spring(spring) => Some(spring),
            _ => None,
        })
    }

    /// Elements that resist motion, in the order of addition.
    pub(in crate::system) fn internal_forces(&self) -> impl Iterator<Item = &Element> {
        let is_other =
            |element: &&Element| matches!(element, Element::PointMass(_) | Element::Load(_));
        self.elements.iter().filter(move |element| !is_other(element))
    }

    /// Brakes and clutches, in the order of addition.
    pub fn brakes(&self) -> impl Iterator<Item = &Spring> {
        self.springs().filter(|spring| spring.kind.is_brake())
    }

    /// Schedules of elements and drives, with the name of the element or drive.
    pub fn schedules(&self) -> impl Iterator<Item = (&str, &Schedule)> {
        let of_elements = self.elements.iter();
        let of_elements = of_elements.filter_map(|element| element.description().schedule());
        let of_drives = self.drives.iter();
        let of_drives = of_drives
            .flat_map(|drive| drive.schedules().map(|schedule| (drive.name.as_str(), schedule)));
        of_elements.chain(of_drives)
    }

    /// Returns an empty scene.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            beams: Vec::new(),
            particles: Vec::new(),
            rigid_bodies: Vec::new(),
            stations: Vec::new(),
            joints: Vec::new(),
            tracks: Vec::new(),
            sliders: Vec::new(),
            drives: Vec::new(),
            releases: Vec::new(),
            velocities: Vec::new(),
            elements: Vec::new(),
            gravity: Vec2::zeros(),
            sensors: Vec::new(),
        }
    }

    /// Adds a beam and returns its index.
    ///
    /// # Errors
    /// Fails if the name of the beam is taken or invalid.
    pub fn add_beam(&mut self, beam: BeamDefinition) -> Result<usize, SystemError> {
        self.check_name("beam", &beam.name)?;
        self.beams.push(beam);
        Ok(self.beams.len() - 1)
    }

    /// Adds a particle and returns its station.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, or if the mass is not positive and finite.
    pub fn add_particle(
        &mut self,
        particle: ParticleDefinition,
        mass: f64,
    ) -> Result<Station, SystemError> {
        self.check_name("particle", &particle.name)?;
        self.particles.push(particle);
        let station = Station::on_particle(self.particles.len() - 1);
        self.add_mass(PointMass { station, mass, rotary_inertia: 0.0 }).inspect_err(|_| {
            self.particles.pop();
        })?;
        Ok(station)
    }

    /// Adds a sliding joint and returns its index.
    ///
    /// # Errors
    /// Fails if the name is taken, or if the slave is a station of the master, does not lie on it, or already slides on it.
    /// Fails if the sliding rule does not allow the track or the friction.
    /// Fails if a sleeve or a unilateral contact is not available with the other options of the slider.
    /// Fails if a coefficient of restitution or friction is outside its range.
    pub fn add_slider(&mut self, slider: Slider) -> Result<usize, SystemError> {
        self.check_name("slider", &slider.name)?;
        self.check_slider(&slider)?;
        let masters = self.masters(&slider);
        self.sliders.push(slider);
        for master in masters {
            self.choose_mesh(master);
        }
        Ok(self.sliders.len() - 1)
    }

    fn names(&self) -> impl Iterator<Item = (&'static str, &String)> {
        let beams = self.beams.iter().map(|beam| ("beam", &beam.name));
        let particles = self.particles.iter().map(|particle| ("particle", &particle.name));
        let sliders = self.sliders.iter().map(|slider| ("slider", &slider.name));
        let springs = self.springs().map(|spring| ("spring", &spring.name));
        let drives = self.drives.iter().map(|drive| (drive.kind.name(), &drive.name));
        let loads = self.loads().filter_map(|load| Some(("load", load.title.as_ref()?)));
        let drags = self.drags().map(|drag| ("drag", &drag.name));
        let obstacles = self.obstacles().map(|obstacle| ("obstacle", &obstacle.name));
        let contacts = self.contacts().map(|contact| ("contact", &contact.name));
        let bodies = self.rigid_bodies.iter().map(|body| ("body", &body.name));
        let tracks = self.tracks.iter().map(|track| ("track", &track.name));
        let all = beams.chain(particles).chain(bodies).chain(tracks).chain(sliders).chain(springs);
        all.chain(drags).chain(obstacles).chain(contacts).chain(drives).chain(loads)
    }

    pub(in crate::system) fn check_name(
        &self,
        new: &'static str,
        name: &str,
    ) -> Result<(), SystemError> {
        check_name(new, name)?;
        match self.names().find(|(_, other)| *other == name) {
            Some((kind, _)) => Err(SystemError::DuplicateName { kind, new, name: name.to_owned() }),
            None => Ok(()),
        }
    }

    /// First unused name among `kind1`, `kind2`, ….
    pub fn free_name(&self, kind: &str) -> String {
        let numbered = self.names().filter_map(|(_, name)| name.strip_prefix(kind)?.parse().ok());
        let taken: HashSet<u64> = numbered.collect();
        let free = (1..).find(|number| !taken.contains(number)).unwrap_or_default();
        format!("{kind}{free}")
    }

    /// Returns the station of a beam at an arc length [length] and starts tracking the section angle at the station.
    ///
    /// # Errors
    /// Fails if the arc length lies outside the beam.
    pub fn station(&mut self, beam: usize, arc_length: f64) -> Result<Station, SystemError> {
        self.check_station("a station", &Station::on_beam(beam, arc_length))?;
        let length = self.beams[beam].axis.length();
        let station = Station::on_beam(beam, arc_length.clamp(0.0, length));
        if !self.stations.iter().any(|known| known.is_at(&station, length)) {
            self.stations.push(station);
        }
        Ok(station)
    }

    /// Joins a station to the ground or to another station.
    ///
    /// # Errors
    /// Fails if the stations are equal or not at the same position, if a particle would be joined rigidly,
    /// or if a tied component is already joined, fixed or prescribed.
    pub fn join(
        &mut self,
        kind: JointKind,
        station: Station,
        partner: Partner,
    ) -> Result<(), SystemError> {
        let name = self.name_of_new_joint(kind, &station, &partner);
        self.joints.push(Joint { name, kind, station, partner });
        check_ties(self).map_err(|error| {
            self.joints.pop();
            match error {
                SystemError::AlreadyDriven { drive, component, place, .. } => {
                    SystemError::HeldAndDriven { component, place, drive }
                }
                error => error,
            }
        })
    }

    pub(super) fn name_of_new_joint(
        &self,
        kind: JointKind,
        station: &Station,
        partner: &Partner,
    ) -> String {
        format!("{} at {}", kind.describe(partner), self.describe(station))
    }

    /// Adds a point mass at a station.
    ///
    /// # Errors
    /// Fails if the station does not exist, mass and rotary inertia are both zero, or one of them is negative or not finite.
    /// Also fails if a particle has a rotary inertia.
    pub fn add_mass(&mut self, mass: PointMass) -> Result<(), SystemError> {
        self.add_element(Element::PointMass(mass))
    }

    pub(crate) fn add_element(&mut self, element: Element) -> Result<(), SystemError> {
        element.description().check(self)?;
        if let Element::Damping(MaterialDamping { name, .. }) = &element
            && self.dissipating().any(|other| other == name)
        {
            let (kind, new) = ("damping of beam", "damping");
            return Err(SystemError::DuplicateName { kind, new, name: name.clone() });
        }
        self.elements.push(element);
        self.choose_meshes_under(self.elements.len() - 1);
        Ok(())
    }

    /// Adds a spring, a damper, a tendon or a brake.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, a number is out of range, a station does not exist, a particle would rotate, or no end can move.
    pub fn add_spring(&mut self, spring: Spring) -> Result<(), SystemError> {
        self.check_name("spring", &spring.name)?;
        self.add_element(Element::Spring(spring))
    }

    /// Length of the beam, or size of the rigid body, to which a station belongs [length]; zero for particles.
    pub fn length_at(&self, station: &Station) -> f64 {
        match station.body {
            BodyIndex::Beam(beam) => self.beams[beam].axis.length(),
            BodyIndex::Particle(_) => 0.0,
            BodyIndex::Rigid(body, _) => self.rigid_bodies[body].size(),
        }
    }

    /// Initial position of a station [length].
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn drawn_at(&self, station: &Station) -> Result<Vec2, SystemError> {
        match station.body {
            BodyIndex::Beam(beam) => {
                let BeamDefinition { axis, name, .. } = &self.beams[beam];
                let at = axis.parameter_at(station.arc_length).and_then(|xi| axis.point(xi));
                at.map_err(SystemError::geometry(name))
            }
            BodyIndex::Particle(particle) => Ok(self.particles[particle].position),
            BodyIndex::Rigid(body, point) => Ok(self.rigid_bodies[body].control_points()[point]),
        }
    }

    /// Position of a station on its body, for given meshes of the beams.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn place(&self, station: &Station, meshes: &[Mesh]) -> Result<BodyPoint, SystemError> {
        match station.body {
            BodyIndex::Beam(index) => {
                let BeamDefinition { axis, name, .. } = &self.beams[index];
                let mesh = &meshes[index];
                let place = station
                    .parameter(axis, mesh)
                    .and_then(|xi| BodyPoint::at(index, axis, mesh, xi));
                place.map_err(SystemError::geometry(name))
            }
            BodyIndex::Particle(particle) => {
                Ok(BodyPoint::of_particle(self.beams.len() + particle))
            }
            BodyIndex::Rigid(body, point) => {
                let first = self.first_rigid_body();
                Ok(BodyPoint::of_point(first + body, point, self.rigid_bodies[body].angle))
            }
        }
    }

    pub(crate) fn name_of_body(&self, station: &Station) -> String {
        match station.body {
            BodyIndex::Beam(beam) => format!("beam '{}'", self.beams[beam].name),
            BodyIndex::Particle(particle) => {
                format!("particle '{}'", self.particles[particle].name)
            }
            BodyIndex::Rigid(body, _) => format!("body '{}'", self.rigid_bodies[body].name),
        }
    }

    /// Index of the body of a station in the model, which contains beams, then particles, then rigid bodies.
    pub fn index_of_body(&self, station: &Station) -> usize {
        match station.body {
            BodyIndex::Beam(beam) => beam,
            BodyIndex::Particle(particle) => self.beams.len() + particle,
            BodyIndex::Rigid(body, _) => self.first_rigid_body() + body,
        }
    }

    pub(crate) fn name_of_body_at(&self, index: usize) -> String {
        let particle = index.checked_sub(self.beams.len());
        self.name_of_body(&match particle {
            None => Station::on_beam(index, 0.0),
            Some(particle) if particle < self.particles.len() => Station::on_particle(particle),
            Some(_) => Station::on_rigid_body(index - self.first_rigid_body(), 0),
        })
    }

    /// Description of a station for messages, such as `the start of beam 'rod'`.
    pub fn describe(&self, station: &Station) -> String {
        if let BodyIndex::Rigid(body, point) = station.body {
            return self.describe_point(body, point);
        }
        let (body, length) = (self.name_of_body(station), self.length_at(station));
        match station.arc_length {
            _ if station.beam().is_none() => body,
            0.0 => format!("the start of {body}"),
            s if s == length => format!("the end of {body}"),
            s => format!("station {} of {body}", rounded(s)),
        }
    }
}

impl SceneChecks for Scene {
    fn contact_targets(&self) -> Vec<ContactTarget> {
        let beams = (0..self.beams.len()).map(ContactTarget::Beam);
        let particles = (0..self.particles.len()).map(Station::on_particle);
        beams.chain(particles.map(ContactTarget::Point)).collect()
    }

    fn describe(&self, station: &Station) -> String {
        Self::describe(self, station)
    }

    fn are_connected(&self, a: BodyIndex, b: BodyIndex) -> bool {
        // All points of a rigid body belong to the same body.
        let whole = |body: BodyIndex| match body {
            BodyIndex::Rigid(body, _) => BodyIndex::Rigid(body, 0),
            other => other,
        };
        let wanted = [whole(a), whole(b)];
        let is_wanted = |one: BodyIndex, other: BodyIndex| {
            let pair = [whole(one), whole(other)];
            pair == wanted || [pair[1], pair[0]] == wanted
        };
        let is_joined = |joint: &Joint| match joint.partner {
            Partner::Station(other) => is_wanted(joint.station.body, other.body),
            Partner::Ground => false,
        };
        let slides = |slider: &Slider| {
            let mut masters = self.masters(slider).into_iter();
            masters.any(|beam| is_wanted(slider.slave.body, BodyIndex::Beam(beam)))
        };
        wanted[0] == wanted[1]
            || self.joints.iter().any(is_joined)
            || self.sliders.iter().any(slides)
    }

    fn check_station(&self, object: &'static str, station: &Station) -> Result<(), SystemError> {
        let (kind, index, count) = match station.body {
            BodyIndex::Beam(index) => ("beam", index, self.beams.len()),
            BodyIndex::Particle(index) => ("particle", index, self.particles.len()),
            BodyIndex::Rigid(index, _) => ("body", index, self.rigid_bodies.len()),
        };
        if index >= count {
            return Err(SystemError::Missing { object, kind, index, count });
        }
        if let BodyIndex::Rigid(body, index) = station.body
            && index > self.rigid_bodies[body].points.len()
        {
            let count = self.rigid_bodies[body].points.len() + 1;
            return Err(SystemError::Missing { object, kind: "point", index, count });
        }
        let length = self.length_at(station);
        if is_on_length(station.arc_length, length) {
            return Ok(());
        }
        let beam = station.beam().map_or_else(String::new, |beam| self.beams[beam].name.clone());
        Err(SystemError::StationOutside { beam, station: station.arc_length, length })
    }
}
