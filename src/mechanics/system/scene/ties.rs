//! Stations that joints connect to each other or to the ground.

use super::Scene;
use crate::beams::{BodyIndex, Station};
use crate::geometry::{Vec2, cross};
use crate::joints::{Component, JointKind, Partner};
use crate::system::SystemError;
use crate::system::errors::{Turning, written};

/// Largest initial gap of a joint, as a fraction of the length of its beam plus the distance of the joint from the origin.
const CLOSED: f64 = 1e-12;

/// Largest angle between the directions of two inclined rollers that count as parallel [rad].
const PARALLEL: f64 = 1e-9;

/// Disjoint sets, implemented by union–find with path halving (R. E. Tarjan, J. ACM 22 (1975) 215–225).
pub struct Ties {
    parent: Vec<usize>,
}

impl Ties {
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    pub fn root(&mut self, mut at: usize) -> usize {
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }

    /// Unites two sets. Returns false if both arguments already belong to the same set.
    pub fn unite(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        // The smaller index remains the root, so that the ground (index 0) is always a root.
        self.parent[a.max(b)] = a.min(b);
        a != b
    }
}

pub fn check_ties(scene: &Scene) -> Result<(), SystemError> {
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
    let driven: Vec<usize> = scene.drives.iter().map(|drive| index(&drive.station)).collect();
    let mut ties = Ties::new(1 + 3 * places.len());
    for (at, place) in places.iter().enumerate() {
        let is_own = |other: &Station| match (place.body, other.body) {
            (BodyIndex::Rigid(body, _), BodyIndex::Rigid(other, _)) => body == other,
            _ => false,
        };
        if let Some(first) = places[..at].iter().position(is_own) {
            let rotation = |place: usize| 1 + 3 * place + Component::Rotation as usize;
            ties.unite(rotation(first), rotation(at));
        }
    }
    for (joint, &(place, partner)) in scene.joints.iter().zip(&pairs) {
        let stations = match &joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, *other],
        };
        if joint.kind.ties_rotation() && stations.iter().any(|at| !at.turns()) {
            let (object, by) = (joint.name.clone(), Turning::RigidJoint);
            return Err(SystemError::ParticleTurned { object, by });
        }
        if let Partner::Station(other) = &joint.partner {
            if partner == Some(place) {
                let body = scene.name_of_body(&joint.station);
                return Err(SystemError::JointWithItself { joint: joint.name.clone(), body });
            }
            check_closed(scene, &joint.name, &joint.station, other)?;
        }
        for &component in joint.kind.components() {
            let node = |place: usize| 1 + 3 * place + component as usize;
            if !ties.unite(node(place), partner.map_or(0, node)) {
                let ground = ties.root(node(place)) == 0;
                let how = match (ground, joint.kind) {
                    (true, _) => "fixed to the ground",
                    (false, JointKind::Hinge) => "joined to the other station",
                    (false, _) => "joined to the other station in this component",
                };
                let place = scene.describe(&joint.station);
                return Err(SystemError::AlreadyTied {
                    joint: joint.name.clone(),
                    place,
                    existing: how.to_owned(),
                });
            }
        }
    }
    let on_rollers =
        check_rollers(scene, &pairs.iter().map(|pair| pair.0).collect::<Vec<_>>(), &mut ties)?;
    let mut given = Vec::new();
    for (drive, place) in scene.drives.iter().zip(driven) {
        for (component, _) in drive.motions() {
            let root = ties.root(1 + 3 * place + component as usize);
            let how = if given.contains(&root) {
                Some("prescribed")
            } else if root == 0 {
                Some("fixed")
            } else if on_rollers.iter().any(|held| held.contains(&root)) {
                Some("coupled to the other component by an inclined roller")
            } else {
                None
            };
            if let Some(how) = how {
                return Err(SystemError::AlreadyDriven {
                    drive: drive.name.clone(),
                    component: component.name(),
                    place: scene.describe(&drive.station),
                    existing: how,
                });
            }
            given.push(root);
        }
    }
    Ok(())
}

fn check_rollers(
    scene: &Scene,
    places: &[usize],
    ties: &mut Ties,
) -> Result<Vec<[usize; 2]>, SystemError> {
    let mut others: Vec<([usize; 2], Vec2)> = Vec::new();
    for (joint, place) in scene.joints.iter().zip(places) {
        let Some(along) = joint.kind.inclined() else { continue };
        let first = 1 + 3 * place;
        let roots = [first, first + 1].map(|at| ties.root(at));
        let is_parallel = |(at, other): &([usize; 2], Vec2)| {
            *at == roots && cross(*other, along).abs() < PARALLEL
        };
        let how = if roots == [0; 2] {
            Some("fixed to the ground")
        } else if others.iter().any(is_parallel) {
            Some("restrained across that direction")
        } else if others.iter().filter(|(at, _)| *at == roots).count() > 1 {
            Some("restrained by two rollers")
        } else {
            None
        };
        if let Some(how) = how {
            let (joint, place) = (joint.name.clone(), scene.describe(&joint.station));
            return Err(SystemError::AlreadyTied { joint, place, existing: how.to_owned() });
        }
        others.push((roots, along));
    }
    Ok(others.into_iter().map(|(roots, _)| roots).collect())
}

impl Scene {
    /// Returns true if supports fix a component of a station, directly or through joints.
    pub fn is_held(&self, station: &Station, component: Component) -> bool {
        self.held_with(station, component).1
    }

    pub(super) fn moves_with(&self, station: &Station, other: &Station) -> bool {
        [Component::X, Component::Y].into_iter().all(|component| {
            let (places, is_held) = self.held_with(station, component);
            let is_tied = places.iter().any(|place| same_place(place, other, self));
            is_tied || is_held && self.is_held(other, component)
        })
    }

    /// Stations that joints connect to `station` in the given component (x, y or angle), including `station`.
    /// The returned flag is true if the ground fixes the component. The search for joined stations ends at the ground.
    fn held_with(&self, station: &Station, component: Component) -> (Vec<Station>, bool) {
        let mut places = vec![*station];
        let mut next = 0;
        while let Some(&at) = places.get(next) {
            next += 1;
            for joint in &self.joints {
                if !joint.kind.components().contains(&component) {
                    continue;
                }
                let is_here = |place: &Station| same_place(place, &at, self);
                match &joint.partner {
                    Partner::Ground if is_here(&joint.station) => return (places, true),
                    Partner::Ground => {}
                    Partner::Station(other) => {
                        for (here, there) in [(&joint.station, other), (other, &joint.station)] {
                            if is_here(here) && !places.contains(there) {
                                places.push(*there);
                            }
                        }
                    }
                }
            }
        }
        (places, false)
    }
}

/// Returns true if two stations coincide within rounding.
pub fn same_place(a: &Station, b: &Station, scene: &Scene) -> bool {
    a.body == b.body && (a.arc_length - b.arc_length).abs() <= 1e-10 * scene.length_at(a)
}

pub fn is_closed(gap: f64, length: f64, at: Vec2) -> bool {
    gap <= CLOSED * (length + at.norm())
}

fn check_closed(
    scene: &Scene,
    joint: &str,
    station: &Station,
    other: &Station,
) -> Result<(), SystemError> {
    let (from, to) = (scene.drawn_at(station)?, scene.drawn_at(other)?);
    let gap = (to - from).norm();
    if is_closed(gap, scene.length_at(station), from) {
        return Ok(());
    }
    Err(SystemError::OpenJoint {
        joint: joint.to_owned(),
        from: written(from),
        to: written(to),
        gap,
    })
}
