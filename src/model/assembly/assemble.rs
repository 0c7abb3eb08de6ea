//! From a scene to a model: meshes with breaks where joints are, numbers, masses, loads and start velocities.

use crate::beams::{BodyDynamics, BodyIndex, Mesh, Particle, Place, Station, discretise};
use crate::geometry::{GaussRule, Vec2, interpolate, perpendicular};
use crate::joints::{Component, Partner};
use crate::loads::{Frame, Load, LoadKind};
use crate::model::assembly::{Numbering, same_place};
use crate::model::bodies::Body;
use crate::model::bodies::Tracker;
use crate::model::elements::Lump;
use crate::model::elements::{Action, AppliedLoad, Exchange, Follower, Pattern};
use crate::model::mechanism::{Model, Support};
use crate::model::motion::Accelerations;
use crate::model::motion::Forecast;
use crate::model::motion::StepScales;
use crate::model::scene::BeamDefinition;
use crate::model::sliders::contact_unknowns;
use crate::model::{ModelError, Resolution, Scene};

/// Largest difference of tied start velocities, relative to the velocities of the beam.
const SAME_VELOCITY: f64 = 1e-9;

/// The parts of a scene that its model is made of.
pub(in crate::model) struct Assembly<'a> {
    pub(in crate::model) scene: &'a Scene,
    /// Of the beams.
    pub(in crate::model) meshes: Vec<Mesh>,
    /// Beams, then particles.
    bodies: Vec<Box<dyn BodyDynamics>>,
}

impl Model {
    /// Builds the mechanism that a scene describes, at its start.
    ///
    /// # Errors
    /// When the scene is empty, a beam cannot be put on its mesh, or start velocities do not fit the joints.
    pub fn assemble(scene: &Scene) -> Result<Self, ModelError> {
        if scene.beams.is_empty() && scene.particles.is_empty() {
            return Err(ModelError::Empty { scene: scene.name.clone() });
        }
        let assembly = Assembly::new(scene)?;
        let border = contact_unknowns(scene);
        let numbering =
            Numbering::new(scene, &assembly.bodies, border, |station| assembly.place(station))?;
        let sliders = assembly.sliders(&numbering)?;
        let lumps = assembly.lumps()?;
        let loads =
            scene.loads.iter().map(|load| assembly.applied(load)).collect::<Result<_, _>>()?;
        let gravity = (scene.gravity != Vec2::zeros()).then(|| assembly.weight(&lumps));
        let trackers = assembly.trackers()?;
        let joined = assembly.joined()?;
        let rates = assembly.start_rates(&numbering)?;
        let total_mass = assembly.total_mass(&lumps);

        let unknowns = numbering.unknowns;
        let mut is_rotation = vec![false; unknowns];
        let mut supports =
            vec![Support { body: 0, point: 0, component: Component::X }; numbering.supported];
        for (body, points) in numbering.degrees_of_freedom.iter().enumerate() {
            for (point, degrees) in points.iter().enumerate() {
                for (component, &at) in Component::ALL.into_iter().zip(degrees) {
                    match at.checked_sub(unknowns + border) {
                        Some(support) => supports[support] = Support { body, point, component },
                        None => is_rotation[at] = component == Component::Rotation,
                    }
                }
            }
        }
        let bodies = assembly
            .bodies
            .into_iter()
            .zip(numbering.degrees_of_freedom)
            .map(|(dynamics, degrees)| Body::new(dynamics, degrees, unknowns))
            .collect();
        let mut model = Self {
            bodies,
            meshes: assembly.meshes,
            lumps,
            loads,
            gravity,
            trackers,
            joined,
            sliders,
            aim: None,
            accelerations: Accelerations::default(),
            scratch: vec![0.0; unknowns + border + supports.len()],
            supports,
            unknowns,
            half_bandwidth: numbering.half_bandwidth,
            is_rotation,
            forecast: Forecast::new(&[], Vec::new()),
            resolution: Resolution::of(scene),
            rates,
            total_mass,
            time: 0.0,
            exchanged: Exchange::default(),
            step: StepScales::default(),
        };
        if !scene.sliders.is_empty() {
            model.check_determined(scene)?;
        }
        model.settle_start_velocities(scene)?;
        // What supports gave to make the velocities fit was before the start.
        model.exchanged = Exchange::default();
        model.forecast = Forecast::new(&model.rates, model.diagonal_of_inertia());
        Ok(model)
    }
}

impl<'a> Assembly<'a> {
    fn new(scene: &'a Scene) -> Result<Self, ModelError> {
        let joined = scene.joints.iter().flat_map(|joint| match joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, other],
        });
        let nodes: Vec<Station> = joined
            .chain(scene.velocities.iter().map(|velocity| velocity.station))
            .chain(scene.sliders.iter().map(|slider| slider.slave))
            .collect();
        let mut meshes = Vec::with_capacity(scene.beams.len());
        for (index, beam) in scene.beams.iter().enumerate() {
            let own = nodes.iter().filter(|node| node.beam() == Some(index));
            meshes.push(mesh_with_nodes(beam, own)?);
        }
        let mut assembly = Self { scene, meshes, bodies: Vec::new() };
        let control_points = assembly.drawn()?;
        for (index, points) in control_points.into_iter().enumerate() {
            assembly.bodies.push(match scene.beams.get(index) {
                Some(beam) => {
                    let wrap = |source| ModelError::Beam { beam: beam.name.clone(), source };
                    let (length, mesh) = (beam.axis.length(), &assembly.meshes[index]);
                    discretise(points, length, mesh, beam.section).map_err(wrap)?
                }
                None => Box::new(Particle::new(points[0])),
            });
        }
        Ok(assembly)
    }

    /// The control points of all bodies; the slaves of sliders are moved onto their masters as the meshes draw them.
    fn drawn(&self) -> Result<Vec<Vec<Vec2>>, ModelError> {
        let beams = self.scene.beams.iter().zip(&self.meshes).map(|(beam, mesh)| {
            interpolate(&beam.axis, mesh.basis()).map_err(ModelError::geometry(&beam.name))
        });
        let particles = self.scene.particles.iter().map(|particle| Ok(vec![particle.position]));
        let mut points = beams.chain(particles).collect::<Result<Vec<_>, ModelError>>()?;
        // A slave may be on a master that slides itself: its own place is right once that of its master is.
        for _ in &self.scene.sliders {
            for slider in &self.scene.sliders {
                let beam = &self.scene.beams[slider.master];
                let (mesh, parameter) =
                    (&self.meshes[slider.master], self.slider_parameter(slider)?);
                let place = Place::at(slider.master, &beam.axis, mesh, parameter)
                    .map_err(ModelError::geometry(&beam.name))?;
                let target = place.interpolate(&points[slider.master]);
                for node in self.nodes_at(&slider.slave)? {
                    points[node.body][node.nearest_control_point()] = target;
                }
            }
        }
        Ok(points)
    }

    /// The nodes at a station: its own, and those of the stations that joints hold there.
    fn nodes_at(&self, station: &Station) -> Result<Vec<Place>, ModelError> {
        let mut stations = vec![*station];
        let mut next = 0;
        while let Some(&at) = stations.get(next) {
            next += 1;
            for joint in &self.scene.joints {
                let Partner::Station(other) = joint.partner else { continue };
                for (here, there) in [(joint.station, other), (other, joint.station)] {
                    if same_place(&here, &at, self.scene) && !stations.contains(&there) {
                        stations.push(there);
                    }
                }
            }
        }
        stations.iter().map(|station| self.place(station)).collect()
    }

    /// The place of a station on the mesh of its body.
    pub(in crate::model) fn place(&self, station: &Station) -> Result<Place, ModelError> {
        self.scene.place(station, &self.meshes)
    }

    fn lumps(&self) -> Result<Vec<Lump>, ModelError> {
        let lump = |mass: &crate::model::PointMass| {
            Ok(Lump {
                place: self.place(&mass.station)?,
                mass: mass.mass,
                rotary_inertia: mass.rotary_inertia,
            })
        };
        self.scene.masses.iter().map(lump).collect()
    }

    fn joined(&self) -> Result<Vec<(Place, Place)>, ModelError> {
        let pair = |joint: &crate::joints::Joint| match &joint.partner {
            Partner::Ground => None,
            Partner::Station(other) => {
                Some(self.place(&joint.station).and_then(|place| Ok((place, self.place(other)?))))
            }
        };
        self.scene.joints.iter().filter_map(pair).collect()
    }

    /// Starts and ends of all beams, then the stations of the scene.
    fn trackers(&self) -> Result<Vec<Tracker>, ModelError> {
        let ends = self.scene.beams.iter().enumerate().flat_map(|(beam, definition)| {
            [0.0, definition.axis.length()].map(|arc_length| Station::on_beam(beam, arc_length))
        });
        ends.chain(self.scene.stations.iter().copied())
            .map(|station| Ok(Tracker::new(self.place(&station)?)))
            .collect()
    }

    fn weight(&self, lumps: &[Lump]) -> Pattern {
        let gravity = self.scene.gravity;
        let mut pattern = Pattern::default();
        for (index, (beam, definition)) in self.bodies.iter().zip(&self.scene.beams).enumerate() {
            for (point, length) in beam.lumped_lengths().into_iter().enumerate() {
                let force = gravity * (length * definition.section.mass_per_length);
                pattern.push(index, point, [force.x, force.y, 0.0]);
            }
        }
        for lump in lumps {
            for (point, share) in lump.place.weights() {
                let force = gravity * (share * lump.mass);
                pattern.push(lump.place.body, point, [force.x, force.y, 0.0]);
            }
        }
        pattern
    }

    fn total_mass(&self, lumps: &[Lump]) -> f64 {
        let lengths = self.bodies.iter().map(|beam| beam.lumped_lengths().iter().sum::<f64>());
        let beams: f64 = lengths
            .zip(&self.scene.beams)
            .map(|(length, beam)| beam.section.mass_per_length * length)
            .sum();
        beams + lumps.iter().map(|lump| lump.mass).sum::<f64>()
    }

    fn applied(&self, load: &Load) -> Result<AppliedLoad, ModelError> {
        let at_station = |station: &Station, force: [f64; 3]| -> Result<Action, ModelError> {
            let mut pattern = Pattern::default();
            let place = self.place(station)?;
            for (point, share) in place.weights() {
                pattern.push(place.body, point, force.map(|value| share * value));
            }
            Ok(Action::Dead(pattern))
        };
        if let LoadKind::Moment { station, .. }
        | LoadKind::Force { station, frame: Frame::Follower, .. } = &load.kind
            && let BodyIndex::Particle(_) = station.body
        {
            let advice = "only a force of fixed direction can act on it";
            return Err(ModelError::ParticleTurned { object: load.name.clone(), advice });
        }
        let action = match &load.kind {
            LoadKind::Force { station, force, frame: Frame::Dead } => {
                at_station(station, [force.x, force.y, 0.0])?
            }
            LoadKind::Moment { station, moment } => at_station(station, [0.0, 0.0, *moment])?,
            LoadKind::Force { station, force, frame: Frame::Follower } => {
                Action::Follower(vec![Follower::new(Tracker::new(self.place(station)?), *force)])
            }
            LoadKind::Line { beam, force, frame: Frame::Dead } => {
                let mut pattern = Pattern::default();
                for (point, length) in self.bodies[*beam].lumped_lengths().into_iter().enumerate() {
                    pattern.push(*beam, point, [length * force.x, length * force.y, 0.0]);
                }
                Action::Dead(pattern)
            }
            LoadKind::Line { beam, force, frame: Frame::Follower } => {
                Action::Follower(self.line_of_followers(*beam, *force)?)
            }
        };
        Ok(AppliedLoad::new(load.name.clone(), load.schedule.clone(), action))
    }

    /// A load that turns with the sections, by `degree` Gauss points a span.
    fn line_of_followers(&self, beam: usize, force: Vec2) -> Result<Vec<Follower>, ModelError> {
        let definition = &self.scene.beams[beam];
        let wrap = ModelError::geometry(&definition.name);
        let basis = self.meshes[beam].basis();
        let rule = GaussRule::new(basis.degree()).map_err(&wrap)?;
        let controls = self.bodies[beam].control_points();
        let mut followers = Vec::new();
        for span in basis.spans() {
            for (xi, weight) in rule.iter_on(span.start, span.end) {
                let length = weight * basis.evaluate_in(&span, xi).combine(1, controls).norm();
                let place =
                    Place::at(beam, &definition.axis, &self.meshes[beam], xi).map_err(&wrap)?;
                followers.push(Follower::new(Tracker::new(place), force * length));
            }
        }
        Ok(followers)
    }

    /// The rates of the unknowns at the start, from rigid motions of beams and velocities of single nodes.
    fn start_rates(&self, numbering: &Numbering) -> Result<Vec<f64>, ModelError> {
        let mut rates: Vec<Option<(usize, f64)>> = vec![None; numbering.unknowns];
        let components = ["velocity along x", "velocity along y", "spin"];
        for (index, (beam, definition)) in self.bodies.iter().zip(&self.scene.beams).enumerate() {
            let motion = definition.motion;
            let about = motion.about.unwrap_or_else(|| centre(beam.as_ref()));
            let length = definition.axis.length();
            let speed = motion.velocity.norm() + motion.spin.abs() * length;
            let sizes = [speed, speed, speed / length];
            for (point, degrees) in
                beam.control_points().iter().zip(&numbering.degrees_of_freedom[index])
            {
                let velocity = motion.velocity + perpendicular(point - about) * motion.spin;
                let values = [velocity.x, velocity.y, motion.spin];
                for (((&at, value), component), size) in
                    degrees.iter().zip(values).zip(components).zip(sizes)
                {
                    let (other, expected) = match rates.get(at) {
                        None => ("the ground there does not move".to_owned(), 0.0),
                        Some(None) => {
                            rates[at] = Some((index, value));
                            continue;
                        }
                        Some(Some((other, rate))) => (
                            format!(
                                "beam '{}', joined there, has {rate}",
                                self.scene.beams[*other].name
                            ),
                            *rate,
                        ),
                    };
                    if (value - expected).abs() > SAME_VELOCITY * size.max(expected.abs()) {
                        return Err(ModelError::StartVelocity {
                            body: format!("beam '{}'", definition.name),
                            place: format!("joint ({component})"),
                            velocity: value,
                            other,
                        });
                    }
                }
            }
        }
        let mut rates: Vec<f64> =
            rates.into_iter().map(|rate| rate.map_or(0.0, |(_, value)| value)).collect();
        for velocity in &self.scene.velocities {
            if velocity.station.beam().is_none() && velocity.spin.is_some() {
                let object =
                    format!("start velocity of {}", self.scene.describe(&velocity.station));
                return Err(ModelError::ParticleTurned { object, advice: "leave out the spin" });
            }
            let place = self.place(&velocity.station)?;
            let (body, point) = (place.body, place.nearest_control_point());
            let values = [Some(velocity.velocity.x), Some(velocity.velocity.y), velocity.spin];
            let degrees = numbering.degrees_of_freedom[body][point];
            for ((at, value), component) in degrees.into_iter().zip(values).zip(components) {
                match (value, rates.get_mut(at)) {
                    (Some(value), Some(rate)) => *rate = value,
                    (Some(value), None) if value != 0.0 => {
                        return Err(ModelError::StartVelocity {
                            body: self.scene.name_of_body(&velocity.station),
                            place: format!("support ({component})"),
                            velocity: value,
                            other: "the ground there does not move".to_owned(),
                        });
                    }
                    _ => {}
                }
            }
        }
        Ok(rates)
    }
}

fn mesh_with_nodes<'s>(
    beam: &BeamDefinition,
    nodes: impl Iterator<Item = &'s Station>,
) -> Result<Mesh, ModelError> {
    let wrap = ModelError::geometry(&beam.name);
    let places: Vec<f64> = nodes
        .map(|node| node.parameter(&beam.axis, &beam.mesh))
        .collect::<Result<_, _>>()
        .map_err(&wrap)?;
    beam.mesh.with_breaks(&places).map_err(&wrap)
}

/// The centre of mass of a beam as drawn.
fn centre(beam: &dyn BodyDynamics) -> Vec2 {
    let lengths = beam.lumped_lengths();
    let moment: Vec2 =
        beam.control_points().iter().zip(&lengths).map(|(point, length)| point * *length).sum();
    moment / lengths.iter().sum::<f64>()
}
