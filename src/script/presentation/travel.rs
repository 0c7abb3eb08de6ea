//! Bodies that joints hold in place, and bodies that can travel.

use crate::beams::{BodyIndex, Station};
use crate::joints::{Joint, JointKind, Partner};
use crate::system::Scene;

/// Bodies of a scene, numbered as beams, particles, rigid bodies, that can move without deformation.
pub struct Travel {
    is_held: Vec<bool>,
    /// Smallest body of the group of joined travelling bodies, for each body.
    group: Vec<usize>,
}

impl Travel {
    /// Counts the degrees of freedom that joints leave to rigid bodies. Sliders, drives and springs do not hold a body.
    pub fn of(scene: &Scene) -> Self {
        let count = scene.first_rigid_body() + scene.rigid_bodies.len();
        let mut travel = Self { is_held: vec![false; count], group: (0..count).collect() };
        while travel.hold_bodies(scene) {}
        travel.join(scene);
        travel.hold_groups(scene);
        travel
    }

    /// Returns true for a body whose position is fixed but for deformations.
    pub fn is_held(&self, body: usize) -> bool {
        self.is_held[body]
    }

    /// Number of the group of joined bodies that travel together.
    pub fn group(&self, body: usize) -> usize {
        self.group[body]
    }

    /// Returns true for the ground and for bodies that are held.
    fn is_fixed(&self, scene: &Scene, partner: &Partner) -> bool {
        match partner {
            Partner::Ground => true,
            Partner::Station(station) => self.is_held[number(scene, station)],
        }
    }

    /// Marks bodies that the ground and held bodies hold. Returns true if there is a new one.
    fn hold_bodies(&mut self, scene: &Scene) -> bool {
        let mut free: Vec<usize> = self.freedoms(scene);
        for (station, partner, joint) in sides(scene) {
            if self.is_fixed(scene, &partner) {
                let body = number(scene, &station);
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
            let pair = [number(scene, &joint.station), number(scene, &partner)];
            if pair.iter().any(|body| self.is_held[*body]) {
                continue;
            }
            let [one, other] = pair.map(|body| self.group[body]);
            let (least, most) = (one.min(other), one.max(other));
            self.group.iter_mut().filter(|of| **of == most).for_each(|of| *of = least);
        }
    }

    /// Marks the bodies of groups whose joints leave no degree of freedom, such as a three-hinged arch.
    fn hold_groups(&mut self, scene: &Scene) {
        let mut free = vec![0_usize; self.group.len()];
        self.freedoms(scene).iter().zip(&self.group).for_each(|(own, of)| free[*of] += own);
        for joint in &scene.joints {
            let of = self.group[number(scene, &joint.station)];
            free[of] = free[of].saturating_sub(constraints(joint));
        }
        let held = self.is_held.iter().zip(&self.group).map(|(held, of)| *held || free[*of] == 0);
        self.is_held = held.collect();
    }

    fn freedoms(&self, scene: &Scene) -> Vec<usize> {
        let particles = scene.beams.len()..scene.first_rigid_body();
        let of = |body| if particles.contains(&body) { 2 } else { 3 };
        (0..self.group.len()).map(of).collect()
    }
}

/// Number of the body of a station.
pub fn number(scene: &Scene, station: &Station) -> usize {
    match station.body {
        BodyIndex::Beam(beam) => beam,
        BodyIndex::Particle(particle) => scene.beams.len() + particle,
        BodyIndex::Rigid(body, _) => scene.first_rigid_body() + body,
    }
}

/// Stations of joints with their partners. A joint between two bodies occurs from both sides.
pub fn sides(scene: &Scene) -> impl Iterator<Item = (Station, Partner, &Joint)> {
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
