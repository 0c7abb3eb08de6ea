//! Numbering of the unknowns in the order of the bodies, and the coupling between unknowns.

use super::tied_components::{GROUND, TiedComponents};
use crate::beams::{BodyDynamics, BodyPoint, Station};
use crate::joints::Component;
use crate::system::SystemError;
use crate::system::scene::Scene;

/// Placeholder for a class of tied components without an unknown. The motion of such a class is fixed or prescribed.
const NONE: usize = usize::MAX;

pub struct InitialNumbering {
    pub unknowns: usize,
    /// Unknown of each class of tied components, indexed by the root of the class.
    pub number: Vec<usize>,
    pub forces: Vec<[usize; 2]>,
    pub roller_forces: Vec<Option<usize>>,
}

impl InitialNumbering {
    /// Numbers the free components (x, y, angle) of the control points of a scene, and the forces of rigid links and inclined rollers.
    /// Tied components share one number.
    ///
    /// # Errors
    /// Fails if all degrees of freedom are fixed and the scene has no drive.
    pub fn new(scene: &Scene, tied: &mut TiedComponents) -> Result<Self, SystemError> {
        let all = tied.count();
        let held = tied.links.iter().map(|link| tied.component(*link, Component::X));
        let held: Vec<usize> = held.collect();
        let mut forces = vec![[0; 2]; held.len()];
        let on_rollers = tied.rollers.iter();
        let on_rollers: Vec<Option<usize>> =
            on_rollers.map(|node| node.map(|node| tied.component(node, Component::X))).collect();
        let mut across = vec![None; on_rollers.len()];
        let mut number = vec![NONE; all];
        let mut unknowns = 0;
        for at in GROUND + 1..all {
            for (force, _) in forces.iter_mut().zip(&held).filter(|(_, held)| **held == at) {
                *force = [unknowns, unknowns + 1];
                unknowns += 2;
            }
            for (force, _) in across.iter_mut().zip(&on_rollers).filter(|(_, on)| **on == Some(at))
            {
                *force = Some(unknowns);
                unknowns += 1;
            }
            let root = tied.ties.root(at);
            if root != GROUND && number[root] == NONE && !tied.prescribed.contains(&root) {
                number[root] = unknowns;
                unknowns += 1;
            }
        }
        match unknowns {
            // A scene in which all motions are prescribed is accepted, because its reactions can be computed.
            0 if scene.drives.is_empty() => {
                Err(SystemError::NothingMoves { scene: scene.name.clone() })
            }
            _ => Ok(Self { unknowns, number, forces, roller_forces: across }),
        }
    }

    pub fn coupled(
        &self,
        scene: &Scene,
        bodies: &[&dyn BodyDynamics],
        tied: &mut TiedComponents,
        place: &impl Fn(&Station) -> Result<BodyPoint, SystemError>,
    ) -> Result<Vec<Vec<usize>>, SystemError> {
        let mut groups = Vec::new();
        for (index, body) in bodies.iter().enumerate() {
            for first in body.span_starts() {
                let points = first..first + body.order();
                groups.push(self.numbers(points.map(|point| (index, point)), tied));
            }
        }
        for (force, &(body, point)) in self.forces.iter().zip(&tied.links) {
            for (&force, component) in force.iter().zip([Component::X, Component::Y]) {
                let centre =
                    [component, Component::Rotation].map(|of| tied.component((body, 0), of));
                let held = tied.component((body, point), component);
                for at in centre.into_iter().chain([held]) {
                    let other = self.number[tied.ties.root(at)];
                    if other != NONE {
                        groups.push(vec![force.min(other), force.max(other)]);
                    }
                }
            }
        }
        for (force, node) in self.roller_forces.iter().zip(&tied.rollers) {
            let (Some(force), Some(node)) = (*force, *node) else { continue };
            for component in [Component::X, Component::Y] {
                let at = tied.component(node, component);
                let other = self.number[tied.ties.root(at)];
                if other != NONE {
                    groups.push(vec![force.min(other), force.max(other)]);
                }
            }
        }
        for element in &scene.elements {
            for stations in element.description().coupled(scene) {
                let mut points = Vec::new();
                for station in stations {
                    let place = place(&station)?;
                    points.extend(place.weights().map(|(point, _)| (place.body, point)));
                }
                let group = self.numbers(points.into_iter(), tied);
                if group.len() > 1 {
                    groups.push(group);
                }
            }
        }
        Ok(groups)
    }

    pub fn numbers(
        &self,
        points: impl Iterator<Item = (usize, usize)>,
        tied: &mut TiedComponents,
    ) -> Vec<usize> {
        let mut group = Vec::new();
        for point in points {
            let first = tied.component(point, Component::X);
            let numbers = (first..first + 3).map(|at| self.number[tied.ties.root(at)]);
            group.extend(numbers.filter(|&number| number != NONE));
        }
        group.sort_unstable();
        group.dedup();
        group
    }
}
