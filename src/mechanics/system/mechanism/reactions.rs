//! Forces of joints and supports on control points, at one time or averaged over a step.

use super::System;
use crate::beams::{BodyPoint, Movement};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;

/// Forces of joints and supports: the residuals of the balance of each control point, evaluated without joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Reactions {
    residual: Vec<f64>,
    nodes: Vec<Vec<Movement>>,
    /// Forces of inclined rollers, which are not contained in `residual` and `nodes` [force].
    roller_forces: Vec<Vec2>,
}

impl Reactions {
    /// Force of joints and supports on one control point [force, force·length].
    pub fn to(&self, (body, point): (usize, usize)) -> Movement {
        self.nodes[body][point]
    }

    /// Support force at each degree of freedom: residual of its balance without supports [force, force·length].
    pub(super) fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Forces of joints and supports on all control points, body by body [force, force·length].
    pub(super) fn on_nodes(&self) -> impl Iterator<Item = f64> {
        self.nodes.iter().flatten().flatten().copied()
    }

    pub(crate) fn by_roller(&self, roller: usize) -> Vec2 {
        self.roller_forces[roller]
    }
}

impl System {
    pub(super) fn reactions_from_residuals(&self, left: &[f64], across: &[f64]) -> Reactions {
        let mut residual = vec![0.0; self.degrees_of_freedom()];
        let mut forces = left.chunks_exact(3).map(|force| [force[0], force[1], force[2]]);
        let nodes = self.bodies.iter().map(|body| {
            let own = forces.by_ref().take(body.degrees_of_freedom.len());
            let of_body: Vec<Movement> = own.collect();
            for (degrees, force) in body.degrees_of_freedom.iter().zip(&of_body) {
                degrees.iter().zip(force).for_each(|(&at, force)| residual[at] += force);
            }
            of_body
        });
        let nodes = nodes.collect();
        let rollers = self.links.all_rollers().iter().zip(across);
        let across = rollers.map(|(roller, multiplier)| roller.force_of(*multiplier)).collect();
        Reactions { residual, nodes, roller_forces: across }
    }

    pub(super) fn rigid_bodies_of(&self, nodes: &[(usize, usize)]) -> Vec<usize> {
        let is_rigid = |body: &usize| self.links.iter().any(|link| link.body == *body);
        nodes.iter().map(|(body, _)| *body).filter(is_rigid).collect()
    }

    /// Reaction of supports at a point: force [force] and moment [force·length]; `None` without a support at the point.
    pub fn reaction(&self, given: &Reactions, place: &BodyPoint) -> Option<(Vec2, f64)> {
        self.held_by(place, &given.residual, |roller| given.roller_forces[roller])
    }

    pub(super) fn held_by(
        &self,
        place: &BodyPoint,
        residual: &[f64],
        of_roller: impl Fn(usize) -> Vec2,
    ) -> Option<(Vec2, f64)> {
        let nodes = self.bodies.tied_nodes(place)?;
        let held = self.supports.force_on(&nodes, &self.rigid_bodies_of(&nodes), residual);
        match self.links.force_of_rollers(&nodes, of_roller) {
            Some(across) => {
                let (force, moment) = held.unwrap_or_default();
                Some((force + across, moment))
            }
            None => held,
        }
    }
}
