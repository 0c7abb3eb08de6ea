//! Forces transmitted by joints.
//!
//! A joint connects two sets of nodes at one point. The forces of other joints within one set cancel in the sum over its nodes.
//! The force of a joint on one set is the sum of the forces of joints and supports on all nodes of this set.
//! If one set of nodes is the ground, the force on the ground is opposite to the force on the other set.
//! Scenes reject redundant joints, so no other joint connects the two sets.

use crate::geometry::Vec2;
use crate::joints::{Component, Joint, JointKind, Partner, Releasable};
use crate::system::{Reactions, Scene, System, SystemError};

type Node = Option<(usize, usize)>;

#[derive(Debug, Clone, PartialEq)]
struct JointSide {
    nodes: Vec<(usize, usize)>,
    sign: f64,
}

/// Joint with the nodes on its two sides, located for repeated queries.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    sides: [Option<JointSide>; 3],
    /// Index of the inclined roller; `None` for other joints.
    roller: Option<usize>,
}

impl Transmission {
    /// Force [force] and moment [force·length] of the joint on its first station, for the given reactions.
    pub fn read(&self, given: &Reactions) -> (Vec2, f64) {
        let sum = |component: Component| {
            let at = component as usize;
            self.sides[at].as_ref().map_or(0.0, |side| {
                side.sign * side.nodes.iter().map(|node| given.to(*node)[at]).sum::<f64>()
            })
        };
        let force = Vec2::new(sum(Component::X), sum(Component::Y));
        let across = self.roller.map(|roller| given.by_roller(roller));
        (across.unwrap_or(force), sum(Component::Rotation))
    }
}

impl System {
    /// Locates the nodes on both sides of a joint. A released joint has no nodes.
    ///
    /// # Errors
    /// Fails if a station lies outside its beam, which cannot occur in a checked scene.
    pub fn transmission(&self, scene: &Scene, joint: usize) -> Result<Transmission, SystemError> {
        let ends = |joint: &Joint| -> Result<(Node, Node), SystemError> {
            let node = |station| -> Result<Node, SystemError> {
                let place = scene.place(station, self.meshes())?;
                Ok(Some((place.body, place.nearest_control_point())))
            };
            let other = match &joint.partner {
                Partner::Ground => None,
                Partner::Station(other) => node(other)?,
            };
            Ok((node(&joint.station)?, other))
        };
        let unknowns = self.unknown_movements();
        let has_let_go = |hold: Releasable| unknowns.are_free_of(hold);
        let all = scene.joints.iter().map(|joint| Ok((joint.kind, ends(joint)?)));
        let all = all.collect::<Result<Vec<_>, SystemError>>()?;
        let links = self.links().iter();
        let turning = links.map(|link| (Some((link.body, 0)), Some((link.body, link.point))));
        let turning: Vec<(Node, Node)> = turning.collect();
        let drives = scene.drives.iter().enumerate();
        let drives = drives.filter(|(at, _)| !has_let_go(Releasable::Drive(*at)));
        let drives = drives.map(|(_, drive)| {
            let place = scene.place(&drive.station, self.meshes())?;
            Ok((drive, Some((place.body, place.nearest_control_point()))))
        });
        let drives = drives.collect::<Result<Vec<_>, SystemError>>()?;
        let side = |component: Component| {
            let tied = |(at, (kind, _)): &(usize, &(JointKind, (Node, Node)))| {
                kind.components().contains(&component) && !has_let_go(Releasable::Joint(*at))
            };
            let joints = all.iter().enumerate().filter(|(at, _)| *at != joint).filter(tied);
            let driven = drives.iter().filter(|(drive, _)| drive.drives(component));
            let bodies = turning.iter().filter(|_| component == Component::Rotation);
            let pairs: Vec<(Node, Node)> = joints
                .map(|(_, (_, ends))| *ends)
                .chain(driven.map(|(_, node)| (*node, None)))
                .chain(bodies.copied())
                .collect();
            let (here, there) = all[joint].1;
            let near = connected_nodes(here, &pairs);
            let (side, sign) = match near.contains(&None) {
                false => (near, 1.0),
                true => (connected_nodes(there, &pairs), -1.0),
            };
            JointSide { nodes: side.into_iter().flatten().collect(), sign }
        };
        let is_held = !has_let_go(Releasable::Joint(joint));
        let ties = |component| is_held && all[joint].0.components().contains(&component);
        let sides = Component::ALL.map(|component| ties(component).then(|| side(component)));
        let roller = self.links().all_rollers().iter().position(|roller| roller.joint == joint);
        Ok(Transmission { sides, roller })
    }
}

/// Nodes that the pairs connect to the node `from`, directly or through other nodes, but not through the ground.
fn connected_nodes(from: Node, pairs: &[(Node, Node)]) -> Vec<Node> {
    let mut found = vec![from];
    let mut next = 0;
    while let Some(&at) = found.get(next) {
        next += 1;
        if at.is_none() {
            continue;
        }
        for (one, other) in pairs {
            for (here, there) in [(one, other), (other, one)] {
                if *here == at && !found.contains(there) {
                    found.push(*there);
                }
            }
        }
    }
    found
}
