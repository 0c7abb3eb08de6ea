//! What joints transmit.
//!
//! A joint holds two sets of nodes at one place together. What it gives to one of them is what joints and supports give to all nodes of that side,
//! as other joints on the same side only pass on among them; with the ground on that side, it is the opposite of what the other gets. A scene refuses
//! joints that hold a place twice, so that no other joint leads from one side to the other.

use crate::geometry::Vec2;
use crate::joints::{Component, Joint, JointKind, Partner, Releasable};
use crate::system::{Reactions, Scene, System, SystemError};

/// A node of a body, or the ground.
type Node = Option<(usize, usize)>;

/// The nodes that get what a joint gives, and whether they get it with the opposite sign.
#[derive(Debug, Clone, PartialEq)]
struct JointSide {
    nodes: Vec<(usize, usize)>,
    sign: f64,
}

/// A joint, found among the nodes of a model once, to be asked often.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// For each component of movement, if the joint ties it.
    sides: [Option<JointSide>; 3],
    /// The index of the inclined roller that the joint is, if it is one.
    roller: Option<usize>,
}

impl Transmission {
    /// Force [force] and moment [force·length] on the first of the two stations of the joint, at the moment or in the step of what is given.
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
    /// What a joint holds together, by its index in the scene; nothing after it has let go.
    ///
    /// # Errors
    /// When a station is off its beam, which it was not when the scene was described.
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
        // A rigid body turns as a whole.
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
            let near = reached(here, &pairs);
            let (side, sign) = match near.contains(&None) {
                false => (near, 1.0),
                true => (reached(there, &pairs), -1.0),
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

/// The nodes that pairs connect with one; what hangs on the ground elsewhere does not.
fn reached(from: Node, pairs: &[(Node, Node)]) -> Vec<Node> {
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
