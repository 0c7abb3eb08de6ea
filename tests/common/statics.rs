//! Equilibrium without inertia, from the forces of a mechanism and the Newton solver of the library.

use withy::integrators::{Interval, Mechanism, Solution, Stage};
use withy::linalg::{BorderShape, BorderedMatrix};
use withy::model::Model;
use withy::newton::{Equations, Imbalance, Newton, Tolerance};

struct Balance<'a> {
    model: &'a mut Model,
    /// A force of the problem: under pure moments there is no other to compare with.
    scale: f64,
}

impl Equations for Balance<'_> {
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        let tangent = tangent.band_mut();
        self.model.add_linearised_forces(Stage::End, u, 1.0, residual, tangent);
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.model.add_mismatch_forces(1.0, residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        self.model.correct_section_forces(correction);
    }

    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> Imbalance {
        let strain = self.model.add_forces(Stage::End, u, 1.0, residual);
        let free = &residual[..u.len()];
        let force = free.iter().fold(0.0, |most: f64, force| most.max(force.abs())) / self.scale;
        Imbalance { force, strain, constraint: 0.0 }
    }
}

/// Follows the equilibrium under the loads of the model from t = 0 to 1, forces balanced relative to `scale`; returns
/// the most iterations of a step.
pub fn load_up(model: &mut Model, steps: usize, scale: f64) -> usize {
    let (border, tolerance) = (BorderShape::default(), Tolerance::default());
    let mut newton = Newton::new(model.unknowns(), model.half_bandwidth(), border, tolerance);
    let mut residual = vec![0.0; model.degrees_of_freedom()];
    let time = |step: usize| step as f64 / steps as f64;
    let mut most = 0;
    for step in 0..steps {
        model.begin_step(Interval::between(time(step), time(step + 1)), &Stage::ALL).unwrap();
        let mut u = vec![0.0; model.unknowns()];
        let report = newton.solve(&mut Balance { model, scale }, &mut u, &mut residual).unwrap();
        most = most.max(report.iterations);
        let rates = model.rates().to_vec();
        model.advance(&Solution {
            increments: &u,
            constraints: &[],
            rates: &rates,
            residual: &residual,
        });
    }
    most
}
