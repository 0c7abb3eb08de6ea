//! From a scene to a model: meshes with breaks where joints are, numbers, masses, loads and start velocities.

use super::applied::{Action, AppliedLoad, Exchange, Follower, Pattern};
use super::body::Body;
use super::inertia::Lump;
use super::mechanism::{Model, StepScales, Support};
use super::numbering::Numbering;
use super::scene::BeamDefinition;
use super::tracker::Tracker;
use super::{ModelError, Scene};
use crate::beams::{BeamDynamics, Mesh, Place, Station, discretise};
use crate::geometry::{GaussRule, Vec2, perpendicular};
use crate::joints::{Component, Partner};
use crate::loads::{Frame, Load, LoadKind};

/// Largest difference of tied start velocities, relative to the velocities of the beam.
const SAME_VELOCITY: f64 = 1e-9;

/// The parts of a scene that its model is made of.
struct Assembly<'a> {
    scene: &'a Scene,
    meshes: Vec<Mesh>,
    beams: Vec<Box<dyn BeamDynamics>>,
}

impl Model {
    /// Builds the mechanism that a scene describes, at its start.
    ///
    /// # Errors
    /// When the scene is empty, a beam cannot be put on its mesh, or start velocities do not fit the joints.
    pub fn assemble(scene: &Scene) -> Result<Self, ModelError> {
        if scene.beams.is_empty() {
            return Err(ModelError::Empty { scene: scene.name.clone() });
        }
        let assembly = Assembly::new(scene)?;
        let numbering = Numbering::new(scene, &assembly.beams, |station| assembly.place(station))?;
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
            vec![Support { beam: 0, point: 0, component: Component::X }; numbering.supported];
        for (beam, points) in numbering.degrees_of_freedom.iter().enumerate() {
            for (point, degrees) in points.iter().enumerate() {
                for (component, &at) in Component::ALL.into_iter().zip(degrees) {
                    match at.checked_sub(unknowns) {
                        Some(support) => supports[support] = Support { beam, point, component },
                        None => is_rotation[at] = component == Component::Rotation,
                    }
                }
            }
        }
        let bodies = assembly
            .beams
            .into_iter()
            .zip(numbering.degrees_of_freedom)
            .map(|(dynamics, degrees)| Body::new(dynamics, degrees, unknowns))
            .collect();
        Ok(Self {
            bodies,
            meshes: assembly.meshes,
            lumps,
            loads,
            gravity,
            trackers,
            joined,
            scratch: vec![0.0; unknowns + supports.len()],
            supports,
            unknowns,
            half_bandwidth: numbering.half_bandwidth,
            is_rotation,
            rates,
            total_mass,
            time: 0.0,
            exchanged: Exchange::default(),
            step: StepScales::default(),
        })
    }
}

impl<'a> Assembly<'a> {
    fn new(scene: &'a Scene) -> Result<Self, ModelError> {
        let joined = scene.joints.iter().flat_map(|joint| match joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, other],
        });
        let nodes: Vec<Station> =
            joined.chain(scene.velocities.iter().map(|velocity| velocity.station)).collect();
        let mut meshes = Vec::with_capacity(scene.beams.len());
        let mut beams = Vec::with_capacity(scene.beams.len());
        for (index, beam) in scene.beams.iter().enumerate() {
            let mesh = mesh_with_nodes(beam, nodes.iter().filter(|node| node.beam == index))?;
            let wrap = |source| ModelError::Beam { beam: beam.name.clone(), source };
            beams.push(discretise(&beam.axis, &mesh, beam.section).map_err(wrap)?);
            meshes.push(mesh);
        }
        Ok(Self { scene, meshes, beams })
    }

    fn place(&self, station: &Station) -> Result<Place, ModelError> {
        let beam = &self.scene.beams[station.beam];
        station
            .place(&beam.axis, &self.meshes[station.beam])
            .map_err(ModelError::geometry(&beam.name))
    }

    fn lumps(&self) -> Result<Vec<Lump>, ModelError> {
        let lump = |mass: &super::PointMass| {
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
            [0.0, definition.axis.length()].map(|arc_length| Station { beam, arc_length })
        });
        ends.chain(self.scene.stations.iter().copied())
            .map(|station| Ok(Tracker::new(self.place(&station)?)))
            .collect()
    }

    fn weight(&self, lumps: &[Lump]) -> Pattern {
        let gravity = self.scene.gravity;
        let mut pattern = Pattern::default();
        for (index, (beam, definition)) in self.beams.iter().zip(&self.scene.beams).enumerate() {
            for (point, length) in beam.lumped_lengths().into_iter().enumerate() {
                let force = gravity * (length * definition.section.mass_per_length);
                pattern.push(index, point, [force.x, force.y, 0.0]);
            }
        }
        for lump in lumps {
            for (point, share) in lump.place.weights() {
                let force = gravity * (share * lump.mass);
                pattern.push(lump.place.beam, point, [force.x, force.y, 0.0]);
            }
        }
        pattern
    }

    fn total_mass(&self, lumps: &[Lump]) -> f64 {
        let lengths = self.beams.iter().map(|beam| beam.lumped_lengths().iter().sum::<f64>());
        let beams: f64 = lengths
            .zip(&self.scene.beams)
            .map(|(length, beam)| beam.section.mass_per_length * length)
            .sum();
        beams + lumps.iter().map(|lump| lump.mass).sum::<f64>()
    }

    fn applied(&self, load: &Load) -> Result<AppliedLoad, ModelError> {
        let at_station = |station: &Station, force: [f64; 3]| -> Result<Action, ModelError> {
            let mut pattern = Pattern::default();
            for (point, share) in self.place(station)?.weights() {
                pattern.push(station.beam, point, force.map(|value| share * value));
            }
            Ok(Action::Dead(pattern))
        };
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
                for (point, length) in self.beams[*beam].lumped_lengths().into_iter().enumerate() {
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
        let controls = self.beams[beam].control_points();
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
        for (index, (beam, definition)) in self.beams.iter().zip(&self.scene.beams).enumerate() {
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
                            beam: definition.name.clone(),
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
            let beam = velocity.station.beam;
            let point = self.place(&velocity.station)?.nearest_control_point();
            let values = [Some(velocity.velocity.x), Some(velocity.velocity.y), velocity.spin];
            let degrees = numbering.degrees_of_freedom[beam][point];
            for ((at, value), component) in degrees.into_iter().zip(values).zip(components) {
                match (value, rates.get_mut(at)) {
                    (Some(value), Some(rate)) => *rate = value,
                    (Some(value), None) if value != 0.0 => {
                        return Err(ModelError::StartVelocity {
                            beam: self.scene.beams[beam].name.clone(),
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
fn centre(beam: &dyn BeamDynamics) -> Vec2 {
    let lengths = beam.lumped_lengths();
    let moment: Vec2 =
        beam.control_points().iter().zip(&lengths).map(|(point, length)| point * *length).sum();
    moment / lengths.iter().sum::<f64>()
}
