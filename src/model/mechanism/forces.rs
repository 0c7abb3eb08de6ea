//! The forces of bodies and loads, as steps and equilibria put them together.

use crate::beams::ForceSummary;
use crate::integrators::Stage;
use crate::linalg::BandedMatrix;
use crate::model::Model;
use crate::model::elements::collocation;

impl Model {
    /// Adds what the bodies resist with, and tells the largest that was met.
    pub(in crate::model) fn add_internal_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> ForceSummary {
        let mut summary = ForceSummary::default();
        for body in &mut self.bodies {
            summary.join(&body.add_forces(collocation(stage), increments, weight, out));
        }
        summary
    }

    /// The same, condensed and with its derivative.
    pub(in crate::model) fn add_linearised_internal_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        for body in &mut self.bodies {
            body.add_linearised_forces(collocation(stage), increments, weight, out, tangent);
        }
    }

    /// Subtracts loads and weight, and their derivative.
    pub(in crate::model) fn subtract_linearised_loads(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.subtract_loads(stage, increments, weight, out);
        for load in &self.loads {
            load.add_tangent(&self.bodies, stage, increments, weight, self.unknowns, tangent);
        }
    }

    /// Subtracts loads and weight; returns the largest force and moment of a load on a control point.
    pub(in crate::model) fn subtract_loads(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        if let Some(gravity) = &self.gravity {
            gravity.subtract_from(&self.bodies, weight, out);
        }
        let weight_scale = self.gravity.as_ref().map_or((0.0, 0.0), |gravity| gravity.largest(1.0));
        self.loads.iter_mut().fold(weight_scale, |largest: (f64, f64), load| {
            let (force, moment) = load.subtract_from(&self.bodies, stage, increments, weight, out);
            (largest.0.max(force), largest.1.max(moment))
        })
    }
}
