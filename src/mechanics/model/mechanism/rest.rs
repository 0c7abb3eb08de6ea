//! The model without inertia: what balances at rest, and how it resists small movements.
//!
//! Movements are counted from the present configuration; rotations are increments of the angle itself, for which the stiffness
//! is the Hessian of the potential energy.

use super::Model;
use crate::beams::{Place, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::integrators::Stage;
use crate::linalg::BandedMatrix;
use crate::model::rigid_links::ArmRule;

/// The largest of the forces that meet in a model at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StaticForces {
    /// The largest force: in a section, or of a load [force].
    pub force: f64,
    /// The largest moment: in a section, or of a load [force·length].
    pub moment: f64,
    /// The largest mismatch between the strain of a section force and that of the configuration [-].
    pub strain_mismatch: f64,
}

impl Model {
    /// Begins a movement between two places at rest: its section forces start from those of the last one.
    pub fn begin_movement(&mut self) {
        self.bodies.iter_mut().for_each(|body| body.dynamics.begin_step());
        self.elements.begin_movement();
        self.links.begin_movement();
    }

    /// Adds the internal forces of the model minus `load_factor` times the loads, with the section forces as they are.
    pub fn add_static_forces(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> StaticForces {
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        let summary = self.add_internal_forces(Stage::End, movements, 1.0, out);
        let (force, moment) = self.subtract_static_loads(movements, load_factor, out);
        StaticForces {
            force: larger(summary.force, load_factor.abs() * force),
            moment: larger(summary.moment, load_factor.abs() * moment),
            strain_mismatch: summary.strain_mismatch,
        }
    }

    /// Adds the condensed internal forces of the model minus `load_factor` times the loads, and their derivative by the movements.
    pub fn add_linearised_static_forces(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        self.add_linearised(Stage::End, movements, (1.0, load_factor), out, tangent);
    }

    /// The largest distance of a point of a rigid body from its place by the forces of the model, relative to its movements and its arm [-].
    pub fn lever_violation(&self, residual: &[f64]) -> f64 {
        self.links.violation(residual)
    }

    /// Subtracts `load_factor` times the loads and the weight of the model; gives the largest force and moment of a whole load on a
    /// control point.
    pub fn subtract_static_loads(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        self.subtract_loads(Stage::End, movements, load_factor, out)
    }

    /// Moves the model by some movements of its unknowns [length, rad] to where prescribed motions are under a part of the load, and leaves it at rest there.
    pub fn move_by(&mut self, movements: &[f64], load_factor: f64) {
        let movements = self.supports.prescribed().at_rest(movements, load_factor);
        self.bodies.gather(&movements);
        let arms = ArmRule { rotations: RotationIncrement::Angle, share: 1.0 };
        self.links.advance(&self.bodies, arms, &movements);
        self.supports.prescribed_mut().place(load_factor);
        self.elements.advance(&self.bodies, RotationIncrement::Angle);
        self.bodies.advance(RotationIncrement::Angle);
        self.motion.rates.fill(0.0);
    }

    /// Whether prescribed motions have to be put on with the loads.
    pub fn is_moved_at_rest(&self) -> bool {
        self.supports.prescribed().moves_at_rest()
    }

    /// The forces of the supports on the scene at a place, from forces at rest: force [force] and moment [force·length]; none where
    /// nothing is held.
    ///
    /// Where several bodies are tied to the place, the supports hold all of them.
    pub fn support_force(&self, place: &Place, forces: &[f64]) -> Option<(Vec2, f64)> {
        let nodes = self.bodies.tied_nodes(place)?;
        self.supports.force_on(&nodes, &self.rigid_bodies_of(&nodes), forces)
    }
}
