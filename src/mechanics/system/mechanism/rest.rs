//! The model without inertia: what balances at rest, and how it resists small movements.
//!
//! Movements are counted from the present configuration; rotations are increments of the angle itself, for which the stiffness
//! is the Hessian of the potential energy.

use super::System;
use crate::beams::{BodyPoint, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::integrators::Stage;
use crate::linalg::BorderedMatrix;
use crate::system::links::ArmRule;
use crate::system::sliders::{AtRest, MasterEnd};

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

impl System {
    /// Begins a movement between two places at rest: its section forces start from those of the last one.
    pub fn begin_movement(&mut self) {
        self.bodies.begin_step();
        self.elements.begin_movement();
        self.links.begin_movement();
    }

    /// Guesses the unknowns of a movement between two places at rest, contacts behind movements: nothing moves.
    pub fn stay(&self, unknowns: &mut [f64]) {
        unknowns.fill(0.0);
        self.sliders.stay(&mut unknowns[self.unknowns.count()..]);
    }

    /// Adds the internal forces of the model minus `load_factor` times the loads, with the section forces as they are, and behind them the equations of
    /// contacts; the unknowns are movements, and contacts behind them.
    pub fn add_static_forces(
        &mut self,
        unknowns: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> StaticForces {
        let count = self.unknowns.count();
        let (movements, contacts) = unknowns.split_at(count);
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        let summary = self.add_internal_forces(Stage::End, movements, 1.0, out);
        let (force, moment) = self.subtract_static_loads(movements, load_factor, out);
        let contact = self.sliders.add::<AtRest>(&self.bodies, count, movements, contacts, out);
        StaticForces {
            force: larger(larger(summary.force, load_factor.abs() * force), contact),
            moment: larger(summary.moment, load_factor.abs() * moment),
            strain_mismatch: summary.strain_mismatch,
        }
    }

    /// Adds the condensed internal forces of the model minus `load_factor` times the loads, and their derivative by the movements.
    pub fn add_linearised_static_forces(
        &mut self,
        unknowns: &[f64],
        load_factor: f64,
        out: &mut [f64],
        tangent: &mut BorderedMatrix,
    ) {
        let count = self.unknowns.count();
        let (movements, contacts) = unknowns.split_at(count);
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        let share = (1.0, load_factor);
        self.add_linearised(Stage::End, movements, share, out, tangent.band_mut());
        let Self { sliders, bodies, .. } = self;
        let border = tangent.border_mut();
        sliders.add_linearised::<AtRest>(bodies, count, movements, contacts, out, border);
    }

    /// The largest violation of an equation of a rigid link or a contact by a residual, forces being compared with one, lengths with what moves [-].
    pub fn violation_at_rest(&self, residual: &[f64], force: f64) -> f64 {
        let equations = &residual[self.unknowns.count()..];
        let relative = |off: f64| if off == 0.0 { 0.0 } else { off / force };
        larger(self.sliders.violation(equations, relative), self.links.violation(residual))
    }

    /// Lets sliders lean on stops that a movement would pass, and leave stops that would have to pull; whether any did.
    ///
    /// # Errors
    /// When a slider would leave its master: its index, and the end.
    pub fn settle_on_stops(
        &mut self,
        unknowns: &[f64],
        load_factor: f64,
    ) -> Result<bool, (usize, MasterEnd)> {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        self.sliders.settle_on_stops(&self.bodies, movements, contacts)
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

    /// Moves the model by movements [length, rad], behind which stand the unknowns of contacts, to where prescribed motions are under a part of the
    /// load, and leaves it at rest there.
    pub fn move_by(&mut self, unknowns: &[f64], load_factor: f64) {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = self.supports.prescribed().at_rest(movements, load_factor);
        self.bodies.gather(&movements);
        let arms = ArmRule { rotations: RotationIncrement::Angle, share: 1.0 };
        self.links.advance(&self.bodies, arms, &movements);
        self.supports.prescribed_mut().place(load_factor);
        self.elements.advance(&self.bodies, RotationIncrement::Angle);
        self.bodies.advance(RotationIncrement::Angle);
        self.sliders.rest(contacts);
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
    pub fn support_force(&self, place: &BodyPoint, forces: &[f64]) -> Option<(Vec2, f64)> {
        self.held_by(place, forces, |roller| self.links.all_rollers()[roller].force())
    }
}
