//! Statics of the model: balance at rest, and stiffness against small movements.
//!
//! Movements are relative to the present configuration. Rotations are increments of the angle itself, for which the stiffness is the Hessian of the
//! potential energy.

use super::System;
use crate::beams::{BodyPoint, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::integrators::Stage;
use crate::linalg::BorderedMatrix;
use crate::system::links::ArmRule;
use crate::system::sliders::{AtRest, MasterEnd};

/// Largest forces of a model at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StaticForces {
    /// Largest force, of a section or a load [force].
    pub force: f64,
    /// Largest moment, of a section or a load [force·length].
    pub moment: f64,
    /// Largest mismatch between the strains of section force and configuration [-].
    pub strain_mismatch: f64,
}

impl System {
    /// Starts a movement between two equilibria with the section forces of the last one.
    pub fn begin_movement(&mut self) {
        self.bodies.begin_step();
        self.elements.begin_movement();
        self.links.begin_movement();
    }

    /// Predicts zero movement between two equilibria; contact unknowns follow movements.
    pub fn predict_unchanged(&self, unknowns: &mut [f64]) {
        unknowns.fill(0.0);
        self.sliders.predict_unchanged(&mut unknowns[self.unknowns.count()..]);
    }

    /// Adds the internal forces at the current section forces minus `load_factor` times the loads, followed by the contact equations. The unknowns
    /// are movements followed by contact unknowns.
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

    /// Adds the condensed internal forces minus `load_factor` times the loads, and their derivatives with respect to the movements.
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

    /// Largest violation of a rigid link or contact equation, relative to a force scale or to the moving lengths [-].
    pub fn violation_at_rest(&self, residual: &[f64], force: f64) -> f64 {
        let equations = &residual[self.unknowns.count()..];
        let relative = |off: f64| if off == 0.0 { 0.0 } else { off / force };
        larger(self.sliders.violation(equations, relative), self.links.violation(residual))
    }

    /// Holds sliders that a movement takes beyond stops, and frees those with tensile stop forces. Returns true if any changed.
    ///
    /// # Errors
    /// Slider and end of its master, if a slider would leave its master.
    pub fn update_stop_contacts(
        &mut self,
        unknowns: &[f64],
        load_factor: f64,
    ) -> Result<bool, (usize, MasterEnd)> {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        self.sliders.update_stop_contacts(&self.bodies, movements, contacts)
    }

    /// Subtracts `load_factor` times loads and weight. Returns the largest force and moment on a control point.
    pub fn subtract_static_loads(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        self.subtract_loads(Stage::End, movements, load_factor, out)
    }

    /// Moves the model by movements [length, rad], followed by contact unknowns, to the prescribed positions under a fraction of the load, and leaves
    /// it at rest.
    pub fn move_by(&mut self, unknowns: &[f64], load_factor: f64) {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = self.supports.prescribed().at_rest(movements, load_factor);
        self.bodies.gather(&movements);
        let arms = ArmRule { rotations: RotationIncrement::Angle, share: 1.0 };
        self.links.advance(&self.bodies, arms, &movements);
        self.supports.prescribed_mut().accept_positions(load_factor);
        self.elements.advance(&self.bodies, RotationIncrement::Angle);
        self.bodies.advance(RotationIncrement::Angle);
        self.sliders.accept_static_positions(contacts);
        self.motion.rates.fill(0.0);
    }

    /// Returns true if prescribed positions have to be applied with the loads.
    pub fn has_prescribed_positions(&self) -> bool {
        self.supports.prescribed().has_positions()
    }

    /// Support force at a place at rest: force [force] and moment [force·length]; `None` without a support there.
    ///
    /// If several bodies are joined there, the supports hold all of them.
    pub fn support_force(&self, place: &BodyPoint, forces: &[f64]) -> Option<(Vec2, f64)> {
        self.held_by(place, forces, |roller| self.links.all_rollers()[roller].force())
    }
}
