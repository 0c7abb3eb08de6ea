//! What joints and supports give, control point by control point: at a moment, or in the mean of a step.

use super::Model;
use crate::beams::{Movement, Place};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;

/// What joints and supports give: what is left of the balance of each control point by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// What is left at each degree of freedom: what supports give [force, force·length].
    residual: Vec<f64>,
    /// What joints and supports give to each control point of each body [force, force·length].
    nodes: Vec<Vec<Movement>>,
}

impl Given {
    /// What joints and supports give to a control point of a body [force, force·length].
    pub fn to(&self, (body, point): (usize, usize)) -> Movement {
        self.nodes[body][point]
    }
}

impl Model {
    /// What joints and supports give, from what is left of the balances of all control points, one after another.
    pub(super) fn given(&self, left: &[f64]) -> Given {
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
        Given { residual, nodes }
    }

    /// The rigid bodies among those of some nodes: what holds one in its rotation turns all its points.
    pub(super) fn rigid_bodies_of(&self, nodes: &[(usize, usize)]) -> Vec<usize> {
        let is_rigid = |body: &usize| self.links.iter().any(|link| link.body == *body);
        nodes.iter().map(|(body, _)| *body).filter(is_rigid).collect()
    }

    /// What supports give at a place: force [force] and moment [force·length]; none where nothing is held.
    pub fn reaction(&self, given: &Given, place: &Place) -> Option<(Vec2, f64)> {
        let nodes = self.bodies.tied_nodes(place)?;
        self.supports.force_on(&nodes, &self.rigid_bodies_of(&nodes), &given.residual)
    }
}
