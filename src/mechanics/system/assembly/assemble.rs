//! Assembly of a mechanism from the objects of a scene.

use super::numbering::{LinkPlace, Numbering};
use crate::beams::{
    BodyDynamics, BodyPoint, Mesh, RigidPoints, SectionVariation, Station, discretise,
};
use crate::elementary::square;
use crate::geometry::{GeometryError, Vec2, interpolate, larger, perpendicular};
use crate::joints::{CONTACT_UNKNOWNS, Joint, Partner, Releasable, Slider};
use crate::system::bodies::{Bodies, Body, Tracker};
use crate::system::elements::{
    AssemblyContext, Elements, PrescribedMovements, SceneChecks, Supports, Weight,
};
use crate::system::links::{InclinedRoller, Links, RigidLink};
use crate::system::scene::same_place;
use crate::system::sliders::Sliders;
use crate::system::state::MotionState;
use crate::system::{BeamDefinition, Scene, System, SystemError, SystemState};

/// Largest rounding error of strains, as a multiple of the machine precision.
/// Strains are differences of coordinates that may be much larger than a span of the mesh. Their rounding error exceeds the machine precision.
const STRAIN_ROUNDINGS: f64 = 100.0;

pub struct Assembly<'a> {
    pub scene: &'a Scene,
    pub meshes: Vec<Mesh>,
    pub bodies: Vec<Box<dyn BodyDynamics>>,
}

fn check_contact_directions(model: &System, scene: &Scene) -> Result<(), SystemError> {
    let Some((name, body)) = model.undirected_contact() else { return Ok(()) };
    let object = scene.contact_object(name).unwrap_or_else(|| name.to_owned());
    Err(SystemError::NoContactDirection { object, body: scene.name_of_body_at(body) })
}

impl System {
    /// Builds the mechanism of a scene in its initial state.
    ///
    /// # Errors
    /// Fails if the scene has no bodies or nothing that can move, an object does not fit its body or mesh, or constraints are redundant.
    /// Also fails if a motion or a contact direction is undetermined, a drive has no value, or start velocities contradict joints, drives or sliders.
    pub fn assemble(scene: &Scene) -> Result<Self, SystemError> {
        Self::assemble_while(scene, &mut || true)
    }

    /// Builds the mechanism of a scene in its initial state, with a callback that can stop the assembly.
    /// The callback `goes_on` is called between beams and between phases. If the callback returns false, the assembly fails.
    ///
    /// # Errors
    /// Fails in the same cases as [`assemble`](Self::assemble), or if the assembly is stopped.
    pub fn assemble_while(
        scene: &Scene,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, SystemError> {
        let mut model = Self::with_start_velocities(scene, goes_on)?;
        model.begin();
        check_contact_directions(&model, scene)?;
        Ok(model)
    }

    pub(crate) fn assemble_in_motion(
        scene: &Scene,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, SystemError> {
        let mut model = Self::with_start_velocities(scene, goes_on)?;
        model.start_kinks()?;
        model.begin();
        check_contact_directions(&model, scene)?;
        Ok(model)
    }

    fn with_start_velocities(
        scene: &Scene,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, SystemError> {
        let mut model = Self::as_drawn(scene, goes_on)?;
        query(scene, goes_on)?;
        model.project_start_velocities(scene)?;
        model.choose_friction_modes();
        Ok(model)
    }

    /// Builds the mechanism of a scene in the given static state at the given time.
    /// Velocities of slaves across their masters are checked at the slider positions of the static state, not at the initial positions.
    ///
    /// # Errors
    /// Fails in the same cases as [`assemble`](Self::assemble), except for undetermined contact directions.
    /// Also fails if a drive has no value at the given time.
    pub(crate) fn assemble_at_rest(
        scene: &Scene,
        state: &SystemState,
        time: f64,
    ) -> Result<Self, SystemError> {
        let mut model = Self::as_drawn(scene, &mut || true)?;
        model.begin();
        model.restore(state);
        model.begin_at(time, scene)?;
        Ok(model)
    }

    fn as_drawn(scene: &Scene, goes_on: &mut dyn FnMut() -> bool) -> Result<Self, SystemError> {
        if scene.beams.is_empty() && scene.particles.is_empty() && scene.rigid_bodies.is_empty() {
            return Err(SystemError::Empty { scene: scene.name.clone() });
        }
        let assembly = Assembly::new(scene, goes_on)?;
        let border = CONTACT_UNKNOWNS * scene.sliders.len();
        let own: Vec<&dyn BodyDynamics> = assembly.bodies.iter().map(|body| &**body).collect();
        let numbering =
            Numbering::new(scene, &[], &own, border, |station| assembly.place(station))?;
        query(scene, goes_on)?;
        let sliders = assembly.sliders(&numbering)?;
        let blocks = numbering.contact_blocks(scene, &sliders);
        let sliders = Sliders::new(sliders, blocks);
        let elements = assembly.elements()?;
        let links = assembly.links(&numbering);
        let trackers = assembly.trackers()?;
        let joined = joined(scene, &[], &assembly.meshes)?;
        query(scene, goes_on)?;
        let (movements, held, unknowns) = numbering.supports_and_unknowns(scene, &[], border);
        let (movements, prescribed) =
            PrescribedMovements::new(movements, scene.drives.iter(), unknowns.count(), border)
                .map_err(|(drive, source)| SystemError::DriveValue { drive, source })?;
        let supports = Supports::new(movements, held);
        let mut rates = assembly.start_rates(&numbering, border, &prescribed)?;
        rates.extend(prescribed);
        let mass = assembly.mass();
        query(scene, goes_on)?;
        let Assembly { meshes, bodies, .. } = assembly;
        let bodies = bodies.into_iter().zip(numbering.degrees_of_freedom);
        let bodies = bodies
            .map(|(dynamics, degrees)| Body::new(dynamics, degrees, unknowns.count()))
            .collect();
        let bodies = Bodies::new(bodies, meshes, trackers, joined, mass);
        let motion = MotionState::new(
            rates,
            square(STRAIN_ROUNDINGS) * f64::EPSILON * scene.rounding_energy(),
        );
        let model = Self::new(bodies, elements, links, sliders, supports, unknowns, motion);
        if !scene.rigid_bodies.is_empty() {
            model.check_movements_held(scene)?;
        }
        model.check_links(scene)?;
        if !scene.sliders.is_empty() {
            model.check_determined(scene)?;
        }
        Ok(model)
    }
}

impl<'a> Assembly<'a> {
    fn new(scene: &'a Scene, goes_on: &mut dyn FnMut() -> bool) -> Result<Self, SystemError> {
        let joined = scene.joints.iter().flat_map(|joint| match joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, other],
        });
        let nodes: Vec<Station> = joined
            .chain(scene.velocities.iter().map(|velocity| velocity.station))
            .chain(scene.sliders.iter().map(|slider| slider.slave))
            .chain(scene.drives.iter().map(|drive| drive.station))
            .chain(scene.elements.iter().flat_map(|element| element.description().nodes()))
            .collect();
        let mut meshes = Vec::with_capacity(scene.beams.len());
        for (index, beam) in scene.beams.iter().enumerate() {
            query(scene, goes_on)?;
            let own = nodes.iter().filter(|node| node.beam() == Some(index));
            meshes.push(mesh_with_nodes(beam, own)?);
        }
        let mut assembly = Self { scene, meshes, bodies: Vec::new() };
        let control_points = assembly.drawn(goes_on)?;
        for (index, points) in control_points.into_iter().enumerate() {
            query(scene, goes_on)?;
            assembly.bodies.push(match scene.beams.get(index) {
                Some(beam) => {
                    let wrap = |source| SystemError::Beam { beam: beam.name.clone(), source };
                    let (length, mesh) = (beam.axis.length(), &assembly.meshes[index]);
                    discretise(points, length, mesh, &beam.section).map_err(wrap)?
                }
                None => match index.checked_sub(scene.first_rigid_body()) {
                    None => Box::new(RigidPoints::particle(points[0])),
                    Some(body) => {
                        Box::new(RigidPoints::rigid(points, scene.rigid_bodies[body].angle))
                    }
                },
            });
        }
        Ok(assembly)
    }

    fn drawn(&self, goes_on: &mut dyn FnMut() -> bool) -> Result<Vec<Vec<Vec2>>, SystemError> {
        let beams = self.scene.beams.iter().zip(&self.meshes).map(|(beam, mesh)| {
            query(self.scene, goes_on)?;
            interpolate(&beam.axis, mesh.basis()).map_err(SystemError::geometry(&beam.name))
        });
        let particles = self.scene.particles.iter().map(|particle| Ok(vec![particle.position]));
        let rigid = self.scene.rigid_bodies.iter().map(|body| Ok(body.control_points()));
        let mut points =
            beams.chain(particles).chain(rigid).collect::<Result<Vec<_>, SystemError>>()?;
        // A master may also be a slave of another slider. Therefore, all slaves are placed on their masters repeatedly until no slave moves.
        let place = |slider: &Slider| {
            Ok((
                self.place_at(slider.master, self.slider_parameter(slider)?)?,
                self.nodes_at(&slider.slave)?,
            ))
        };
        let places =
            self.scene.sliders.iter().map(place).collect::<Result<Vec<_>, SystemError>>()?;
        for _ in &self.scene.sliders {
            let mut is_settled = true;
            for (slider, (place, nodes)) in self.scene.sliders.iter().zip(&places) {
                if self.scene.starts_apart(slider)? {
                    continue;
                }
                let target = place.interpolate(&points[slider.master]);
                for node in nodes {
                    let point = &mut points[node.body][node.nearest_control_point()];
                    is_settled &= *point == target;
                    *point = target;
                }
            }
            if is_settled {
                break;
            }
        }
        Ok(points)
    }

    fn nodes_at(&self, station: &Station) -> Result<Vec<BodyPoint>, SystemError> {
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

    fn trackers(&self) -> Result<Vec<Tracker>, SystemError> {
        let ends = self.scene.beams.iter().enumerate().flat_map(|(beam, definition)| {
            [0.0, definition.axis.length()].map(|arc_length| Station::on_beam(beam, arc_length))
        });
        ends.chain(self.scene.stations.iter().copied())
            .chain((0..self.scene.rigid_bodies.len()).map(|body| Station::on_rigid_body(body, 0)))
            .map(|station| Ok(Tracker::new(self.place(&station)?)))
            .collect()
    }

    fn links(&self, numbering: &Numbering) -> Links {
        let first = self.scene.first_rigid_body();
        let link = |&LinkPlace { body, point, force }: &LinkPlace| {
            let points = self.bodies[body].control_points();
            let angle = self.scene.rigid_bodies[body - first].angle;
            RigidLink::new(body, point, force, [points[0], points[point]], angle)
        };
        Links::new(numbering.links.iter().map(link).collect(), self.rollers(numbering))
    }

    fn rollers(&self, numbering: &Numbering) -> Vec<InclinedRoller> {
        let joints = self.scene.joints.iter().enumerate();
        let inclined = joints.filter_map(|(at, joint)| Some((at, joint.kind.inclined()?)));
        let rollers = numbering.rollers.iter().zip(inclined);
        let roller = |(place, (joint, along)): (&Option<(usize, (usize, usize))>, _)| {
            let (unknown, node) = (*place)?;
            let on_line = self.bodies[node.0].control_points()[node.1];
            let points = self.bodies.iter().flat_map(|body| body.control_points());
            let size = points.map(|point| (point - on_line).norm()).fold(0.0, larger);
            let size = if size > 0.0 { size } else { 1.0 };
            let across = perpendicular(along);
            Some(InclinedRoller::new(joint, node, Some(unknown), across, on_line, size))
        };
        rollers.filter_map(roller).collect()
    }

    fn elements(&self) -> Result<Elements, SystemError> {
        let parts = self.scene.elements.iter().map(|element| element.description().build(self));
        let parts = parts.collect::<Result<Vec<_>, SystemError>>()?;
        let gravity = self.scene.gravity;
        let weight = (gravity != Vec2::zeros()).then(|| {
            let beams = self.bodies.iter().take(self.scene.beams.len());
            Weight::new(gravity, beams.map(|body| &**body))
        });
        Ok(Elements::new(parts.into_iter(), weight))
    }

    fn mass(&self) -> f64 {
        let lengths = self.bodies.iter().map(|beam| beam.lumped_lengths().iter().sum::<f64>());
        let beams = lengths.zip(&self.scene.beams);
        beams.map(|(length, beam)| beam.section.mean().mass_per_length * length).sum()
    }
}

impl AssemblyContext for Assembly<'_> {
    fn place(&self, station: &Station) -> Result<BodyPoint, SystemError> {
        self.scene.place(station, &self.meshes)
    }

    fn place_at(&self, beam: usize, parameter: f64) -> Result<BodyPoint, SystemError> {
        BodyPoint::at(beam, &self.scene.beams[beam].axis, &self.meshes[beam], parameter)
            .map_err(|error| self.wrong(beam, error))
    }

    fn scene(&self) -> &dyn SceneChecks {
        self.scene
    }

    fn mesh(&self, beam: usize) -> &Mesh {
        &self.meshes[beam]
    }

    fn variation(&self, beam: usize) -> &SectionVariation {
        &self.scene.beams[beam].section
    }

    fn body(&self, index: usize) -> &dyn BodyDynamics {
        &*self.bodies[index]
    }

    fn wrong(&self, beam: usize, error: GeometryError) -> SystemError {
        SystemError::geometry(&self.scene.beams[beam].name)(error)
    }
}

fn query(scene: &Scene, goes_on: &mut dyn FnMut() -> bool) -> Result<(), SystemError> {
    if goes_on() { Ok(()) } else { Err(SystemError::Interrupted { scene: scene.name.clone() }) }
}

pub fn joined(
    scene: &Scene,
    released: &[Releasable],
    meshes: &[Mesh],
) -> Result<Vec<(BodyPoint, BodyPoint)>, SystemError> {
    let pair = |(at, joint): (usize, &Joint)| match &joint.partner {
        Partner::Station(other) if !released.contains(&Releasable::Joint(at)) => {
            let place = scene.place(&joint.station, meshes);
            Some(place.and_then(|place| Ok((place, scene.place(other, meshes)?))))
        }
        _ => None,
    };
    scene.joints.iter().enumerate().filter_map(pair).collect()
}

fn mesh_with_nodes<'s>(
    beam: &BeamDefinition,
    nodes: impl Iterator<Item = &'s Station>,
) -> Result<Mesh, SystemError> {
    let wrap = SystemError::geometry(&beam.name);
    let places: Vec<f64> = nodes
        .map(|node| node.parameter(&beam.axis, &beam.mesh))
        .collect::<Result<_, _>>()
        .map_err(&wrap)?;
    beam.mesh.with_breaks(&places).map_err(&wrap)
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::*;
    use crate::beams::Section;
    use crate::geometry::Curve;
    use crate::integrators::{Interval, Mechanism, Stage, StepError};
    use crate::loads::{LoadError, LoadFrame, LoadKind, Schedule};
    use crate::system::ParticleDefinition;

    #[test]
    fn assembly_can_be_interrupted_between_beams() {
        let section = Section {
            axial_stiffness: 1.0,
            shear_stiffness: 1.0,
            bending_stiffness: 1.0,
            mass_per_length: 1.0,
            rotary_inertia: 1.0,
        };
        let mut scene = Scene::new("stack");
        for index in 0..5 {
            let (name, height) = (format!("beam {index}"), f64::from(index));
            let axis = Curve::line(Vec2::new(0.0, height), Vec2::new(1.0, height)).unwrap();
            let mesh = Mesh::bspline(4, 3, 2).unwrap();
            scene.add_beam(BeamDefinition::new(name, axis, mesh, section)).unwrap();
        }
        let mut asked = 0;
        let mut ends_after = |most: usize| {
            asked = 0;
            let assembled = System::assemble_while(&scene, &mut || {
                asked += 1;
                asked <= most
            });
            (assembled.err(), asked)
        };
        let (finished, all) = ends_after(usize::MAX);
        assert!(finished.is_none() && all >= 3 * 5, "{finished:?} {all}");
        for most in 0..all {
            let (error, asked) = ends_after(most);
            assert_eq!(error, Some(SystemError::Interrupted { scene: "stack".into() }));
            assert_eq!(asked, most + 1);
        }
    }

    #[test]
    fn nan_load_fails_the_step_with_the_load_error() {
        let mut scene = Scene::new("bead");
        let bead = ParticleDefinition { name: "bead".to_owned(), position: Vec2::zeros() };
        let station = scene.add_particle(bead, 1.0).unwrap();
        let schedule =
            Schedule::Function { function: Rc::new(|_: f64| Ok(f64::NAN)), breaks: vec![] };
        scene.add_load(
            LoadKind::Force { station, force: Vec2::x(), frame: LoadFrame::Dead },
            schedule,
        );
        let mut model = System::assemble(&scene).unwrap();
        let refused = model.begin_step(Interval::between(0.0, 0.1), &[Stage::End]);
        let Err(StepError::Load { load, source, .. }) = refused else { panic!("{refused:?}") };
        assert_eq!(load, "force at particle 'bead'");
        let cause = source.downcast_ref::<LoadError>();
        assert!(
            matches!(cause, Some(LoadError::NotFinite { time, .. }) if (0.0..=0.1).contains(time)),
            "{cause:?}"
        );
    }
}
