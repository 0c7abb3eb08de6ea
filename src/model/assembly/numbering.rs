//! Which movements are tied to each other or to the ground, and the numbers of the unknowns that are left.

use crate::beams::{BodyDynamics, Place, Station};
use crate::geometry::Vec2;
use crate::joints::{Component, JointKind, Partner};
use crate::linalg::reverse_cuthill_mckee;
use crate::model::words::names::rounded;
use crate::model::{ModelError, Scene};

/// Largest gap of a joint when the scene starts, relative to the length of its beam and its distance from the origin.
const CLOSED: f64 = 1e-12;

/// The degree of freedom of every component of every control point of every body: the unknowns come first,
/// the supported ones last.
#[derive(Debug, Clone)]
pub(in crate::model) struct Numbering {
    pub(in crate::model) degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    pub(in crate::model) unknowns: usize,
    pub(in crate::model) supported: usize,
    pub(in crate::model) half_bandwidth: usize,
}

/// Sets of things that are one: union–find with path halving.
struct Ties {
    parent: Vec<usize>,
}

impl Ties {
    fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    fn root(&mut self, mut at: usize) -> usize {
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }

    /// Makes two things one; false when they were already.
    fn tie(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        // The smaller index stays the root, so that index 0, the ground, always is one.
        self.parent[a.max(b)] = a.min(b);
        a != b
    }
}

/// Checks that the joints of a scene close and do not tie a place twice, without building anything.
pub(in crate::model) fn check_ties(scene: &Scene) -> Result<(), ModelError> {
    let mut places: Vec<Station> = Vec::new();
    let mut index = |station: &Station| {
        places.iter().position(|other| same_place(other, station, scene)).unwrap_or_else(|| {
            places.push(*station);
            places.len() - 1
        })
    };
    let pairs: Vec<(usize, Option<usize>)> = scene
        .joints
        .iter()
        .map(|joint| match &joint.partner {
            Partner::Ground => (index(&joint.station), None),
            Partner::Station(other) => (index(&joint.station), Some(index(other))),
        })
        .collect();
    let mut ties = Ties::new(1 + 3 * places.len());
    for (joint, (place, partner)) in scene.joints.iter().zip(pairs) {
        let stations = match &joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, *other],
        };
        if joint.kind == JointKind::Rigid && stations.iter().any(|at| at.beam().is_none()) {
            let advice = "use scene.hinge(…), or scene.mass(…) on the beam";
            return Err(ModelError::ParticleTurned { object: joint.name.clone(), advice });
        }
        if let Partner::Station(other) = &joint.partner {
            if partner == Some(place) {
                let body = scene.name_of_body(&joint.station);
                return Err(ModelError::JointWithItself { joint: joint.name.clone(), body });
            }
            check_closed(scene, &joint.name, &joint.station, other)?;
        }
        for &component in joint.kind.components() {
            let node = |place: usize| 1 + 3 * place + component as usize;
            if !ties.tie(node(place), partner.map_or(0, node)) {
                let ground = ties.root(node(place)) == 0;
                let how = match (ground, joint.kind) {
                    (true, _) => "held by the ground",
                    (false, JointKind::Hinge) => "joined to the other station",
                    (false, JointKind::Rigid) => "joined to the other station in this component",
                };
                let place = scene.describe(&joint.station);
                return Err(ModelError::AlreadyTied {
                    joint: joint.name.clone(),
                    place,
                    how: how.to_owned(),
                });
            }
        }
    }
    Ok(())
}

pub(in crate::model) fn same_place(a: &Station, b: &Station, scene: &Scene) -> bool {
    a.body == b.body && (a.arc_length - b.arc_length).abs() <= 1e-10 * scene.length_at(a)
}

fn check_closed(
    scene: &Scene,
    joint: &str,
    station: &Station,
    other: &Station,
) -> Result<(), ModelError> {
    let (from, to) = (scene.drawn_at(station)?, scene.drawn_at(other)?);
    let (gap, size) = ((to - from).norm(), scene.length_at(station));
    if gap <= CLOSED * (size + from.norm()) {
        return Ok(());
    }
    Err(ModelError::OpenJoint {
        joint: joint.to_owned(),
        from: written(from),
        to: written(to),
        gap,
    })
}

/// A point as it stands in messages.
pub(in crate::model) fn written(at: Vec2) -> String {
    format!("({}, {})", rounded(at.x), rounded(at.y))
}

impl Numbering {
    /// Numbers the movements of bodies; `place` finds the stations of joints on their meshes. Constraints with `border`
    /// unknowns stand between the unknown and the supported movements.
    pub(in crate::model) fn new(
        scene: &Scene,
        bodies: &[Box<dyn BodyDynamics>],
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
        for joint in &scene.joints {
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

        // Free classes get numbers in the order of the beams; ground is class 0.
        let mut number = vec![usize::MAX; all];
        let mut unknowns = 0;
        for at in 1..all {
            let root = ties.root(at);
            if root != 0 && number[root] == usize::MAX {
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
        let ordering = reverse_cuthill_mckee(unknowns, &groups);

        let mut supported = 0;
        let degrees_of_freedom = bodies
            .iter()
            .zip(&offsets)
            .map(|(body, offset)| {
                let mut degree = |at: usize| match ties.root(at) {
                    0 => {
                        supported += 1;
                        unknowns + border + supported - 1
                    }
                    root => ordering.position[number[root]],
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
            unknowns,
            supported,
            half_bandwidth: ordering.half_bandwidth,
        })
    }
}
