//! Step of a model with one slider for a prescribed increment `Δξ`. The residual of the sliding equation shows whether the step has a solution, independently
//! of Newton's method.

use withy::integrators::{
    Accelerated, Checkpoint, Constraints, EnergyMomentum, Forces, Inertia, Integrator, Interval,
    Mechanism, Overshoot, PrescribedKinematics, Solution, Stage, StepError,
};
use withy::joints::CONTACT_UNKNOWNS;
use withy::linalg::{BandedMatrix, Border, BorderShape, BorderedMatrix};
use withy::newton::Tolerance;
use withy::system::System;

/// Model in which the last equation of the slider is replaced by `Δξ = way`. It applies to laws whose last equation does not depend on the displacement
/// increments, such as the relaxed rule.
pub struct FixedWay<'a> {
    model: &'a mut System,
    way: f64,
    /// Initial guess of the next solve, from the last solution.
    mean_rates: Vec<f64>,
    contact: Vec<f64>,
    left: f64,
    scratch: BorderedMatrix,
}

impl<'a> FixedWay<'a> {
    pub fn new(model: &'a mut System) -> Self {
        let mean_rates = model.expected_rates().to_vec();
        let shape = model.constraint_shape();
        assert_eq!(shape.width, CONTACT_UNKNOWNS, "one slider");
        let scratch = BorderedMatrix::zeros(model.unknowns(), 0, shape);
        Self {
            model,
            way: 0.0,
            mean_rates,
            contact: vec![0.0; CONTACT_UNKNOWNS],
            left: f64::NAN,
            scratch,
        }
    }

    /// Residual of the sliding equation [force] in a step with the increment `way`. Returns `None` if the step has no solution.
    pub fn left(&mut self, interval: Interval, way: f64) -> Option<f64> {
        self.way = way;
        let mut integrator = EnergyMomentum::new(self, Tolerance::default());
        integrator.step(self, interval).ok().map(|_| self.left)
    }
}

impl Mechanism for FixedWay<'_> {
    fn prescribed(&self) -> &PrescribedKinematics {
        self.model.prescribed()
    }

    fn unknowns(&self) -> usize {
        self.model.unknowns()
    }

    fn degrees_of_freedom(&self) -> usize {
        self.model.degrees_of_freedom()
    }

    fn half_bandwidth(&self) -> usize {
        self.model.half_bandwidth()
    }

    fn rates(&self) -> &[f64] {
        self.model.rates()
    }

    fn expected_rates(&self) -> &[f64] {
        &self.mean_rates
    }

    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError> {
        self.model.begin_step(interval, stages)
    }

    fn advance(&mut self, solution: &Solution<'_>) {
        let inverse = 0.5;
        let ends = solution.rates.iter().zip(self.model.rates());
        self.mean_rates
            .iter_mut()
            .zip(ends)
            .for_each(|(mean, (end, start))| *mean = inverse * (end + start));
        self.contact.copy_from_slice(solution.constraints);
    }

    fn checkpoint(&mut self) -> &mut dyn Checkpoint {
        self.model.checkpoint()
    }

    fn accelerated(&mut self) -> &mut dyn Accelerated {
        self.model.accelerated()
    }
}

impl Inertia for FixedWay<'_> {
    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        self.model.add_inertia(factor, rates, out);
    }

    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix) {
        self.model.add_inertia_tangent(factor, tangent);
    }
}

impl Forces for FixedWay<'_> {
    fn add_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> f64 {
        self.model.add_forces(stage, increments, weight, out)
    }

    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.model.add_linearised_forces(stage, increments, weight, out, tangent);
    }

    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        self.model.add_mismatch_forces(weight, out);
    }

    fn correct_section_forces(&mut self, correction: &[f64]) {
        self.model.correct_section_forces(correction);
    }

    fn relative_imbalance(&self, residual: &[f64]) -> f64 {
        self.model.relative_imbalance(residual)
    }

    fn largest_rotation(&self) -> f64 {
        self.model.largest_rotation()
    }
}

impl Constraints for FixedWay<'_> {
    fn constraint_shape(&self) -> BorderShape {
        self.model.constraint_shape()
    }

    fn predict_constraints(&mut self, _interval: Interval, unknowns: &mut [f64]) {
        unknowns.copy_from_slice(&self.contact);
        unknowns[4] = self.way;
    }

    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]) {
        self.model.add_constraints(increments, unknowns, out);
        let row = self.model.unknowns() + 4;
        self.left = out[row];
        out[row] = unknowns[4] - self.way;
    }

    fn add_linearised_constraints(
        &mut self,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        let size = self.model.unknowns();
        let row = size + 4;
        self.scratch.clear();
        let own = self.scratch.border_mut();
        self.model.add_linearised_constraints(increments, unknowns, out, own);
        out[row] = unknowns[4] - self.way;
        for k in 0..CONTACT_UNKNOWNS {
            for at in 0..size {
                let column = self.scratch.get(at, size + k);
                if column != 0.0 {
                    border.add_to_column(at, k, column);
                }
                let entry = self.scratch.get(size + k, at);
                if k < 4 && entry != 0.0 {
                    border.add_to_row(k, at, entry);
                }
            }
            for other in 0..CONTACT_UNKNOWNS {
                let entry = if k < 4 {
                    self.scratch.get(size + k, size + other)
                } else {
                    f64::from(u8::from(other == 4))
                };
                border.add_to_corner(k, other, entry);
            }
        }
    }

    fn relative_violation(&self, residual: &[f64]) -> f64 {
        self.model.relative_violation(residual)
    }

    fn check_constraints(&mut self, _unknowns: &[f64]) -> Result<(), Overshoot> {
        Ok(())
    }

    fn shortest_chord(&self) -> f64 {
        self.model.shortest_chord()
    }
}
