//! Bodies that joints hold in place, and bodies that can travel.

use crate::beams::Station;
use crate::joints::{Joint, JointKind, Partner};
use crate::system::Scene;

/// Classification of bodies: those that joints hold in place, and groups of joined bodies that can move rigidly.
pub struct Travel {
    is_held: Vec<bool>,
    group: Vec<usize>,
}

impl Travel {
    /// Finds the bodies that joints hold in place, and the groups of joined bodies that can move.
    /// A body is held if its joints with the ground and with held bodies have at least as many constraints as it has degrees of freedom.
    /// The same criterion applies to a group, with all joints of its bodies.
    /// Beams count as rigid. Sliders, drives and springs are ignored.
    pub fn of(scene: &Scene) -> Self {
        let count = scene.first_rigid_body() + scene.rigid_bodies.len();
        let mut travel = Self { is_held: vec![false; count], group: (0..count).collect() };
        while travel.hold_bodies(scene) {}
        travel.join(scene);
        travel.hold_groups(scene);
        travel
    }

    pub fn is_held(&self, body: usize) -> bool {
        self.is_held[body]
    }

    pub fn group(&self, body: usize) -> usize {
        self.group[body]
    }

    fn is_fixed(&self, scene: &Scene, partner: &Partner) -> bool {
        match partner {
            Partner::Ground => true,
            Partner::Station(station) => self.is_held[scene.index_of_body(station)],
        }
    }

    fn hold_bodies(&mut self, scene: &Scene) -> bool {
        let mut free: Vec<usize> = self.rigid_freedoms(scene);
        for (station, partner, joint) in joint_ends(scene) {
            if self.is_fixed(scene, &partner) {
                let body = scene.index_of_body(&station);
                free[body] = free[body].saturating_sub(constraints(joint));
            }
        }
        let held = free.iter().map(|free| *free == 0).collect();
        let is_new = held != self.is_held;
        self.is_held = held;
        is_new
    }

    fn join(&mut self, scene: &Scene) {
        for joint in &scene.joints {
            let Partner::Station(partner) = joint.partner else { continue };
            let pair = [scene.index_of_body(&joint.station), scene.index_of_body(&partner)];
            if pair.iter().any(|body| self.is_held[*body]) {
                continue;
            }
            let [one, other] = pair.map(|body| self.group[body]);
            let (least, most) = (one.min(other), one.max(other));
            self.group.iter_mut().filter(|group| **group == most).for_each(|group| *group = least);
        }
    }

    fn hold_groups(&mut self, scene: &Scene) {
        let mut free = vec![0_usize; self.group.len()];
        self.rigid_freedoms(scene)
            .iter()
            .zip(&self.group)
            .for_each(|(own, group)| free[*group] += own);
        for joint in &scene.joints {
            let group = self.group[scene.index_of_body(&joint.station)];
            free[group] = free[group].saturating_sub(constraints(joint));
        }
        let held = self.is_held.iter().zip(&self.group);
        let held = held.map(|(held, group)| *held || free[*group] == 0);
        self.is_held = held.collect();
    }

    fn rigid_freedoms(&self, scene: &Scene) -> Vec<usize> {
        let particles = scene.beams.len()..scene.first_rigid_body();
        let of = |body| if particles.contains(&body) { 2 } else { 3 };
        (0..self.group.len()).map(of).collect()
    }
}

/// Stations of joints with their partners. A joint between two bodies occurs once for each body.
pub fn joint_ends(scene: &Scene) -> impl Iterator<Item = (Station, Partner, &Joint)> {
    scene.joints.iter().flat_map(|joint| {
        let other = match joint.partner {
            Partner::Ground => None,
            Partner::Station(partner) => Some((partner, Partner::Station(joint.station), joint)),
        };
        [Some((joint.station, joint.partner, joint)), other].into_iter().flatten()
    })
}

fn constraints(joint: &Joint) -> usize {
    match joint.kind {
        JointKind::Hinge | JointKind::InclinedGuide(_) => 2,
        JointKind::Rigid => 3,
        JointKind::Support(components) => components.list().len(),
        JointKind::InclinedRoller(_) => 1,
    }
}
