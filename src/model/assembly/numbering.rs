//! The numbers of the unknowns that are left where movements are tied to each other or to the ground.

use crate::beams::{BodyDynamics, Place, Station};
use crate::joints::{Component, Hold, Partner};
use crate::linalg::reverse_cuthill_mckee;
use crate::model::ModelError;
use crate::model::elements::{Guided, Support};
use crate::model::motion::{UnknownKind, Unknowns};
use crate::model::scene::{Scene, Ties};

/// Where a lever is: its body, the control point that it holds to the first one, and the unknowns of its force.
#[derive(Debug, Clone, Copy)]
pub struct LeverPlace {
    pub body: usize,
    pub point: usize,
    pub force: [usize; 2],
}

/// The degree of freedom of every component of every control point of every body: the unknowns come first,
/// the supported ones last.
#[derive(Debug, Clone)]
pub struct Numbering {
    pub degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    /// The two unknowns of the force of each lever, among those of the movements that it couples.
    pub levers: Vec<LeverPlace>,
    pub unknowns: usize,
    /// Of the supported ones, those that are given stand first.
    given: usize,
    supported: usize,
    half_bandwidth: usize,
}

impl Numbering {
    /// Numbers the movements of bodies; `place` finds the stations of joints on their meshes. Constraints with `border`
    /// unknowns stand between the unknown and the supported movements. Joints and drives that were `released` tie nothing.
    pub fn new(
        scene: &Scene,
        released: &[Hold],
        bodies: &[&dyn BodyDynamics],
        border: usize,
        place: impl Fn(&Station) -> Result<Place, ModelError>,
    ) -> Result<Self, ModelError> {
        let counts = bodies.iter().map(|body| body.control_points().len());
        let offsets: Vec<usize> = std::iter::once(1)
            .chain(counts.scan(1, |offset, count| {
                *offset += 3 * count;
                Some(*offset)
            }))
            .collect();
        let all = offsets[bodies.len()];
        let mut ties = Ties::new(all);
        // Particles do not turn.
        for offset in offsets[scene.beams.len()..].iter().take(scene.particles.len()) {
            ties.tie(0, offset + Component::Rotation as usize);
        }
        // The points of a rigid body turn with it; one at the centre is the centre.
        let first_rigid = scene.beams.len() + scene.particles.len();
        let mut levers = Vec::new();
        for (body, definition) in (first_rigid..).zip(&scene.rigid_bodies) {
            let offset = offsets[body];
            for point in 1..=definition.points.len() {
                ties.tie(offset + 2, offset + 3 * point + 2);
            }
            let at_centre = |point: &usize| !definition.levers().any(|other| other == *point);
            for point in (1..=definition.points.len()).filter(at_centre) {
                (0..2).for_each(|component| {
                    ties.tie(offset + component, offset + 3 * point + component);
                });
            }
            levers.extend(definition.levers().map(|point| (body, point)));
        }
        let holds = |hold: Hold| !released.contains(&hold);
        let joints = scene.joints.iter().enumerate();
        for (_, joint) in joints.filter(|(at, _)| holds(Hold::Joint(*at))) {
            let node = |station: &Station| -> Result<usize, ModelError> {
                // Stations of joints are breaks of the mesh, where a control point lies on the axis.
                let place = place(station)?;
                Ok(offsets[place.body] + 3 * place.nearest_control_point())
            };
            let from = node(&joint.station)?;
            let to = match &joint.partner {
                Partner::Ground => None,
                Partner::Station(other) => Some(node(other)?),
            };
            for &component in joint.kind.components() {
                ties.tie(from + component as usize, to.map_or(0, |to| to + component as usize));
            }
        }

        // Classes that are given get theirs in the order of the drives.
        let mut given = Vec::new();
        let drives = scene.drives.iter().enumerate();
        for (_, drive) in drives.filter(|(at, _)| holds(Hold::Drive(*at))) {
            let place = place(&drive.station)?;
            let node = offsets[place.body] + 3 * place.nearest_control_point();
            given.extend(drive.courses().map(|(at, _)| ties.root(node + at as usize)));
        }

        // Free classes get numbers in the order of the beams; ground is class 0.
        let mut number = vec![usize::MAX; all];
        let mut unknowns = 0;
        // The force of a lever stands before the point that it holds.
        let mut forces = vec![[0; 2]; levers.len()];
        for at in 1..all {
            for (force, (body, point)) in forces.iter_mut().zip(&levers) {
                if at == offsets[*body] + 3 * point {
                    *force = [unknowns, unknowns + 1];
                    unknowns += 2;
                }
            }
            let root = ties.root(at);
            if root != 0 && number[root] == usize::MAX && !given.contains(&root) {
                number[root] = unknowns;
                unknowns += 1;
            }
        }
        if unknowns == 0 {
            return Err(ModelError::NothingMoves { scene: scene.name.clone() });
        }
        let mut groups = Vec::new();
        for (body, offset) in bodies.iter().zip(&offsets) {
            for first in body.span_starts() {
                let nodes = offset + 3 * first..offset + 3 * (first + body.order());
                let mut group: Vec<usize> =
                    nodes.map(|at| number[ties.root(at)]).filter(|&n| n != usize::MAX).collect();
                group.sort_unstable();
                group.dedup();
                groups.push(group);
            }
        }
        for (force, &(body, point)) in forces.iter().zip(&levers) {
            let (centre, point) = (offsets[body], offsets[body] + 3 * point);
            for (component, &force) in force.iter().enumerate() {
                for at in [centre + component, centre + 2, point + component] {
                    let other = number[ties.root(at)];
                    if other != usize::MAX {
                        groups.push(vec![force.min(other), force.max(other)]);
                    }
                }
            }
        }
        for element in &scene.elements {
            let mut group = Vec::new();
            for station in element.description().coupled() {
                let place = place(&station)?;
                let points = place.weights().map(|(point, _)| offsets[place.body] + 3 * point);
                let components = points.flat_map(|first| first..first + 3);
                group.extend(
                    components.map(|at| number[ties.root(at)]).filter(|&n| n != usize::MAX),
                );
            }
            group.sort_unstable();
            group.dedup();
            if group.len() > 1 {
                groups.push(group);
            }
        }
        let ordering = reverse_cuthill_mckee(unknowns, &groups);
        let levers = forces.iter().zip(levers).map(|(force, (body, point))| LeverPlace {
            body,
            point,
            force: force.map(|at| ordering.position[at]),
        });
        let levers = levers.collect();

        let mut supported = given.len();
        let degrees_of_freedom = bodies
            .iter()
            .zip(&offsets)
            .map(|(body, offset)| {
                let mut degree = |at: usize| match ties.root(at) {
                    0 => {
                        supported += 1;
                        unknowns + border + supported - 1
                    }
                    root => match given.iter().position(|other| *other == root) {
                        Some(guide) => unknowns + border + guide,
                        None => ordering.position[number[root]],
                    },
                };
                (0..body.control_points().len())
                    .map(|point| {
                        Component::ALL
                            .map(|component| degree(offset + 3 * point + component as usize))
                    })
                    .collect()
            })
            .collect();
        Ok(Self {
            degrees_of_freedom,
            levers,
            unknowns,
            given: given.len(),
            supported,
            half_bandwidth: ordering.half_bandwidth,
        })
    }

    /// The supports in the order of their degrees of freedom, those that move as is given and those that do not, and the unknowns; constraints with `border`
    /// unknowns stand between.
    pub fn supports_and_unknowns(
        &self,
        scene: &Scene,
        released: &[Hold],
        border: usize,
    ) -> (Vec<Guided>, Vec<Support>, Unknowns) {
        let mut kinds = vec![UnknownKind::Position; self.unknowns];
        let mut supports =
            vec![Support { body: 0, point: 0, component: Component::X }; self.supported];
        for (body, points) in self.degrees_of_freedom.iter().enumerate() {
            for (point, degrees) in points.iter().enumerate() {
                for (component, &at) in Component::ALL.into_iter().zip(degrees) {
                    match at.checked_sub(self.unknowns + border) {
                        Some(support) => supports[support] = Support { body, point, component },
                        None if component == Component::Rotation => {
                            kinds[at] = UnknownKind::Rotation;
                        }
                        None => (),
                    }
                }
            }
        }
        for at in self.levers.iter().flat_map(|lever| lever.force) {
            kinds[at] = UnknownKind::Force;
        }
        let held = supports.split_off(self.given);
        let drives = scene.drives.iter().enumerate();
        let courses = drives.filter(|(drive, _)| !released.contains(&Hold::Drive(*drive)));
        let courses = courses.flat_map(|(drive, of)| of.courses().map(move |(_, at)| (drive, at)));
        let guided = supports.into_iter().zip(courses).map(|(support, (drive, course))| Guided {
            support,
            drive,
            course: course.clone(),
        });
        (guided.collect(), held, Unknowns::new(kinds, self.half_bandwidth, released))
    }
}
