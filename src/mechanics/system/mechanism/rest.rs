//! Statics of a mechanism: residual of the static equations, and derivatives of the residual.
//!
//! Rotation increments are increments of the angle, so that the stiffness is the Hessian of the potential energy.

use super::System;
use crate::beams::{BodyPoint, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::integrators::Stage;
use crate::linalg::BorderedMatrix;
use crate::system::links::ArmRule;
use crate::system::sliders::{AtRest, MasterEnd, SliderContact};

/// Scales of the forces in a static iterate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StaticForces {
    /// Largest section force, element force, contact force or load [force].
    pub force: f64,
    /// Largest section moment, element moment or moment of a load [force·length].
    pub moment: f64,
    /// Largest strain residual: strain of the configuration minus the strain that belongs to the section force [-].
    pub strain_mismatch: f64,
}

impl System {
    /// Starts the search for the next equilibrium with the section forces of the last equilibrium.
    pub fn begin_movement(&mut self) {
        self.bodies.begin_step();
        self.elements.begin_movement(&self.bodies);
        self.links.begin_movement();
    }

    pub(crate) fn predict_unchanged(&self, unknowns: &mut [f64]) {
        unknowns.fill(0.0);
        self.sliders.predict_unchanged(&mut unknowns[self.unknowns.count()..]);
    }

    /// Adds to `out` the internal forces of the present section forces and the residuals of the contact equations.
    /// Subtracts `load_factor` times the loads.
    /// The argument `unknowns` contains displacements, followed by contact unknowns.
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

    /// Adds the internal forces with the section force unknowns eliminated, minus `load_factor` times the loads.
    /// Adds the derivatives of all added forces with respect to the displacements to the tangent.
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

    pub(crate) fn violation_at_rest(&self, residual: &[f64], force: f64) -> f64 {
        let equations = &residual[self.unknowns.count()..];
        let relative = |off: f64| if off == 0.0 { 0.0 } else { off / force };
        larger(self.sliders.violation(equations, relative), self.links.violation(residual))
    }

    /// Holds sliders that a displacement moves beyond stops, and releases sliders whose stop force is tensile.
    /// The returned flag is true if the state of a slider has changed.
    ///
    /// # Errors
    /// Returns the slider and the end of its master, if a slider would leave its master.
    pub(crate) fn update_stop_contacts(
        &mut self,
        unknowns: &[f64],
        load_factor: f64,
    ) -> Result<bool, (usize, MasterEnd)> {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = &*self.supports.prescribed().at_rest(movements, load_factor);
        self.sliders.update_stop_contacts(&self.bodies, movements, contacts)
    }

    pub(crate) fn subtract_static_loads(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        self.subtract_loads(Stage::End, movements, load_factor, out)
    }

    /// Accepts a static solution: moves the model by the displacements and rotations in `unknowns` [length, rad].
    /// The contact unknowns are stored, and prescribed positions are set to their values at `load_factor`.
    pub(crate) fn move_by(&mut self, unknowns: &[f64], load_factor: f64) {
        let (movements, contacts) = unknowns.split_at(self.unknowns.count());
        let movements = self.supports.prescribed().at_rest(movements, load_factor);
        self.bodies.gather(&movements);
        let arms = ArmRule { rotations: RotationIncrement::Angle, fraction: 1.0 };
        self.links.advance(&self.bodies, arms, &movements);
        self.supports.prescribed_mut().accept_positions(load_factor);
        self.elements.advance(&self.bodies, RotationIncrement::Angle);
        self.bodies.advance(RotationIncrement::Angle);
        self.sliders.accept_static_positions(&self.bodies, &movements, contacts);
        self.motion.rates.fill(0.0);
    }

    /// Removes the compliance that the meshes of the masters of sleeves do not represent.
    pub(crate) fn neglect_sleeve_compliance(&mut self) {
        self.sliders.iter_mut().for_each(SliderContact::neglect_compliance);
    }

    /// Returns true if prescribed positions must be applied together with the loads.
    pub(crate) fn has_prescribed_positions(&self) -> bool {
        self.supports.prescribed().has_positions()
    }

    /// Support reaction at a point in equilibrium: force [force] and moment [force·length]; `None` without a support at the point.
    ///
    /// If several bodies are joined at the point, the reaction acts on all joined bodies together.
    pub(crate) fn support_force(&self, place: &BodyPoint, forces: &[f64]) -> Option<(Vec2, f64)> {
        self.held_by(place, forces, |roller| self.links.all_rollers()[roller].force())
    }
}
