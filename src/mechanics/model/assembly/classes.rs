//! Components of control points that move as one, the classes of the relation "tied", and a first number for each that is free.

use crate::beams::{BodyDynamics, Place, Station};
use crate::joints::{Component, Partner};
use crate::model::ModelError;
use crate::model::scene::{Scene, Ties};

/// The class of what does not move.
pub const GROUND: usize = 0;

/// The number of a class that is no unknown.
const NONE: usize = usize::MAX;

/// Components of control points of bodies, counted from one on in the order of the bodies, that joints, particles and rigid bodies tie into classes.
pub struct Classes {
    pub ties: Ties,
    /// The first component of each body, and behind the last one the count of all.
    offsets: Vec<usize>,
    /// The body of each rigid link, and the point that it holds to the first one.
    pub links: Vec<(usize, usize)>,
    /// The classes whose movement is prescribed, in the order of the drives.
    pub prescribed: Vec<usize>,
}

impl Classes {
    /// Ties what moves as one in a scene; `place` finds stations on the meshes of its bodies.
    pub fn new(
        scene: &Scene,
        bodies: &[Box<dyn BodyDynamics>],
        place: &impl Fn(&Station) -> Result<Place, ModelError>,
    ) -> Result<Self, ModelError> {
        let mut offsets = vec![GROUND + 1];
        for body in bodies {
            offsets.push(offsets[offsets.len() - 1] + 3 * body.control_points().len());
        }
        let ties = Ties::new(offsets[bodies.len()]);
        let mut classes = Self { ties, offsets, links: Vec::new(), prescribed: Vec::new() };
        classes.tie_particles(scene);
        classes.tie_rigid_bodies(scene);
        for joint in &scene.joints {
            // Stations of joints are breaks of the mesh, where a control point lies on the axis.
            let from = place(&joint.station)?;
            let to = match &joint.partner {
                Partner::Ground => None,
                Partner::Station(other) => Some(place(other)?),
            };
            for &component in joint.kind.components() {
                let to = to.as_ref().map_or(GROUND, |to| classes.at(to, component));
                classes.ties.tie(classes.at(&from, component), to);
            }
        }
        for drive in &scene.drives {
            let place = place(&drive.station)?;
            for (component, _) in drive.motions() {
                let at = classes.at(&place, component);
                classes.prescribed.push(classes.ties.root(at));
            }
        }
        Ok(classes)
    }

    /// Particles do not turn.
    fn tie_particles(&mut self, scene: &Scene) {
        for body in scene.beams.len()..scene.beams.len() + scene.particles.len() {
            self.ties.tie(GROUND, self.component((body, 0), Component::Rotation));
        }
    }

    /// The points of a rigid body turn with it; one at the centre is the centre.
    fn tie_rigid_bodies(&mut self, scene: &Scene) {
        let first = scene.beams.len() + scene.particles.len();
        for (body, definition) in (first..).zip(&scene.rigid_bodies) {
            for point in 1..=definition.points.len() {
                let is_off_centre = definition.links().any(|other| other == point);
                let together =
                    if is_off_centre { &[Component::Rotation][..] } else { &Component::ALL };
                for &component in together {
                    let centre = self.component((body, 0), component);
                    self.ties.tie(centre, self.component((body, point), component));
                }
            }
            self.links.extend(definition.links().map(|point| (body, point)));
        }
    }

    /// A component of a control point of a body.
    pub fn component(&self, (body, point): (usize, usize), component: Component) -> usize {
        self.offsets[body] + 3 * point + component as usize
    }

    /// A component of the control point that is at a place.
    fn at(&self, place: &Place, component: Component) -> usize {
        self.component((place.body, place.nearest_control_point()), component)
    }
}

/// Numbers of the unknowns in the order of the bodies, before they are put into that of the band.
pub struct Order {
    pub unknowns: usize,
    /// The number of each class, by its root.
    pub number: Vec<usize>,
    /// The unknowns of the force of each rigid link: they stand before the point that it holds.
    pub forces: Vec<[usize; 2]>,
}

impl Order {
    /// Numbers the classes of a scene that are free.
    ///
    /// # Errors
    /// When nothing is free.
    pub fn of(scene: &Scene, classes: &mut Classes) -> Result<Self, ModelError> {
        let all = classes.offsets[classes.offsets.len() - 1];
        let held = classes.links.iter().map(|link| classes.component(*link, Component::X));
        let held: Vec<usize> = held.collect();
        let mut forces = vec![[0; 2]; held.len()];
        let mut number = vec![NONE; all];
        let mut unknowns = 0;
        for at in GROUND + 1..all {
            for (force, _) in forces.iter_mut().zip(&held).filter(|(_, held)| **held == at) {
                *force = [unknowns, unknowns + 1];
                unknowns += 2;
            }
            let root = classes.ties.root(at);
            if root != GROUND && number[root] == NONE && !classes.prescribed.contains(&root) {
                number[root] = unknowns;
                unknowns += 1;
            }
        }
        match unknowns {
            0 => Err(ModelError::NothingMoves { scene: scene.name.clone() }),
            _ => Ok(Self { unknowns, number, forces }),
        }
    }

    /// The unknowns that are coupled with each other: by spans, by rigid links and by elements.
    pub fn coupled(
        &self,
        scene: &Scene,
        bodies: &[Box<dyn BodyDynamics>],
        classes: &mut Classes,
        place: &impl Fn(&Station) -> Result<Place, ModelError>,
    ) -> Result<Vec<Vec<usize>>, ModelError> {
        let mut groups = Vec::new();
        for (index, body) in bodies.iter().enumerate() {
            for first in body.span_starts() {
                let points = first..first + body.order();
                groups.push(self.numbers(points.map(|point| (index, point)), classes));
            }
        }
        for (force, &(body, point)) in self.forces.iter().zip(&classes.links) {
            for (&force, component) in force.iter().zip([Component::X, Component::Y]) {
                let centre =
                    [component, Component::Rotation].map(|of| classes.component((body, 0), of));
                let held = classes.component((body, point), component);
                for at in centre.into_iter().chain([held]) {
                    let other = self.number[classes.ties.root(at)];
                    if other != NONE {
                        groups.push(vec![force.min(other), force.max(other)]);
                    }
                }
            }
        }
        for element in &scene.elements {
            let mut points = Vec::new();
            for station in element.description().coupled() {
                let place = place(&station)?;
                points.extend(place.weights().map(|(point, _)| (place.body, point)));
            }
            let group = self.numbers(points.into_iter(), classes);
            if group.len() > 1 {
                groups.push(group);
            }
        }
        Ok(groups)
    }

    /// The unknowns of control points of bodies, in rising order.
    fn numbers(
        &self,
        points: impl Iterator<Item = (usize, usize)>,
        classes: &mut Classes,
    ) -> Vec<usize> {
        let mut group = Vec::new();
        for point in points {
            let first = classes.component(point, Component::X);
            let numbers = (first..first + 3).map(|at| self.number[classes.ties.root(at)]);
            group.extend(numbers.filter(|&number| number != NONE));
        }
        group.sort_unstable();
        group.dedup();
        group
    }
}
