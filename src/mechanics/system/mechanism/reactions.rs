//! What joints and supports give, control point by control point: at a moment, or in the mean of a step.

use super::System;
use crate::beams::{BodyPoint, Movement};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;

/// What joints and supports give: what is left of the balance of each control point by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Reactions {
    /// What is left at each degree of freedom: what supports give [force, force·length].
    residual: Vec<f64>,
    /// What joints and supports give to each control point of each body [force, force·length].
    nodes: Vec<Vec<Movement>>,
    /// What inclined rollers give, which is not among these, one after another [force].
    across: Vec<Vec2>,
}

impl Reactions {
    /// What joints and supports give to a control point of a body [force, force·length].
    pub fn to(&self, (body, point): (usize, usize)) -> Movement {
        self.nodes[body][point]
    }

    /// What an inclined roller gives, by its index among all [force].
    pub fn by_roller(&self, roller: usize) -> Vec2 {
        self.across[roller]
    }
}

impl System {
    /// What joints and supports give, from what is left of the balances of all control points, one after another, and the multipliers of all inclined rollers.
    pub(super) fn given(&self, left: &[f64], across: &[f64]) -> Reactions {
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
        Reactions { residual, nodes, across }
    }

    /// The rigid bodies among those of some nodes: what holds one in its rotation turns all its points.
    pub(super) fn rigid_bodies_of(&self, nodes: &[(usize, usize)]) -> Vec<usize> {
        let is_rigid = |body: &usize| self.links.iter().any(|link| link.body == *body);
        nodes.iter().map(|(body, _)| *body).filter(is_rigid).collect()
    }

    /// What supports give at a place: force [force] and moment [force·length]; none where nothing is held.
    pub fn reaction(&self, given: &Reactions, place: &BodyPoint) -> Option<(Vec2, f64)> {
        self.held_by(place, &given.residual, |roller| given.across[roller])
    }

    /// What supports and inclined rollers give at a place, by the residual of all degrees of freedom and the forces of rollers, by their index; none where
    /// nothing is held.
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
