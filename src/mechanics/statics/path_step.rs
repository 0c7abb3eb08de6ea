//! Steps of a given length along the path of equilibria.

use super::Loading;
use super::balance::{AlongPath, Balance};
use super::continuation::{norm, tangent, update_stop_contacts};
use super::error::StepFailure;
use crate::integrators::{Constraints, Mechanism};
use crate::newton::Newton;
use crate::system::{Scene, System};

pub(super) struct PathStep {
    newton: Newton,
    normal: Vec<f64>,
    unknowns: Vec<f64>,
    residual: Vec<f64>,
    forces: Vec<f64>,
}

impl PathStep {
    pub(super) fn new(model: &System, loading: &Loading) -> Self {
        let unknowns = model.unknowns() + model.constraint_shape().width;
        Self {
            newton: Newton::of(tangent(model, 1), loading.tolerance),
            normal: vec![0.0; unknowns],
            unknowns: vec![0.0; unknowns + 1],
            residual: vec![0.0; unknowns + 1],
            forces: vec![0.0; model.degrees_of_freedom()],
        }
    }

    pub(super) fn set_direction(&mut self, metric: &[f64], last: &[f64]) {
        let inverse = 1.0 / norm(metric, last);
        for ((normal, weight), u) in self.normal.iter_mut().zip(metric).zip(last) {
            *normal = weight * u * inverse;
        }
    }

    /// Solves for an equilibrium at the given distance from the last equilibrium.
    /// The iteration starts from zero displacement, so that the first iteration follows the tangent of the path.
    pub(super) fn find(
        &mut self,
        mut balance: Balance<'_>,
        from: f64,
        distance: f64,
        scene: &Scene,
    ) -> Result<usize, StepFailure> {
        let mut iterations = 0;
        for _ in 0..=scene.most_settlings() {
            let last = self.normal.len();
            balance.model.predict_unchanged(&mut self.unknowns[..last]);
            self.unknowns[last] = from;
            balance.model.begin_movement();
            let (normal, forces) = (&self.normal, &mut self.forces);
            let mut equations = AlongPath { balance: &mut balance, normal, distance, forces };
            let report =
                self.newton.solve(&mut equations, &mut self.unknowns, &mut self.residual)?;
            iterations += report.iterations;
            if !update_stop_contacts(balance.model, scene, self.movements(), self.factor())? {
                return Ok(iterations);
            }
        }
        Err(StepFailure::FarSolution)
    }

    pub(super) fn movements(&self) -> &[f64] {
        &self.unknowns[..self.normal.len()]
    }

    pub(super) fn factor(&self) -> f64 {
        self.unknowns[self.normal.len()]
    }
}
