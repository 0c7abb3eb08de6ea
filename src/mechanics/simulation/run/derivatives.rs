//! Derivatives of a run with respect to parameters of the scene, computed together with the steps.

use super::{Simulation, SimulationSettings};
use crate::simulation::sensitivities::Sensitivities;
use crate::simulation::{
    DerivativeCounts, DerivativeError, History, PerturbedSide, SimulationError, Variation,
};
use crate::system::{Scene, System};

impl Simulation {
    /// Starts a simulation with derivatives. `variations` contains the scenes at perturbed parameters.
    ///
    /// # Errors
    /// Fails in the same cases as [`start`](Self::start), if the method provides no derivatives, or if the steps are variable.
    /// Also fails if the scene has a controller or a sensor of accumulated means, or if the scenes differ in more than numbers or have different times.
    pub fn start_with_derivatives(
        scene: Scene,
        settings: SimulationSettings,
        variations: Vec<Variation>,
    ) -> Result<Self, SimulationError> {
        let mut run = Self::start(scene, settings)?;
        let sensitivities = Sensitivities::new(&mut run, variations)?;
        run.stepper.sensitivities = Some(Box::new(sensitivities));
        Ok(run)
    }

    /// Names of the parameters with their perturbations.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        self.stepper.sensitivities.iter().flat_map(|of| of.parameters())
    }

    /// Perturbed run for a parameter. Its state is the present state plus or minus the derivative times the perturbation.
    /// The derivative of any result is the difference between the results of the two perturbed runs, divided by twice the perturbation.
    ///
    /// # Errors
    /// Fails if the run has no derivatives.
    pub fn perturbed(
        &self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&Self, DerivativeError> {
        let known = self.stepper.sensitivities.as_ref().ok_or(DerivativeError::None)?;
        known.perturbed(parameter, side)
    }

    /// Perturbed run for a parameter, for queries that need mutable access.
    ///
    /// # Errors
    /// Fails if the run has no derivatives.
    pub fn perturbed_mut(
        &mut self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&mut Self, DerivativeError> {
        let known = self.stepper.sensitivities.as_mut().ok_or(DerivativeError::None)?;
        known.perturbed_mut(parameter, side)
    }

    /// History of a perturbed run between two times. It remains available after the derivatives have ended.
    ///
    /// # Errors
    /// Fails if some of the requested rows have no derivatives.
    pub fn perturbed_history(
        &self,
        parameter: usize,
        side: PerturbedSide,
        (from, to): (f64, f64),
    ) -> Result<History, DerivativeError> {
        let known = self.stepper.sensitivities.as_ref().ok_or(DerivativeError::None)?;
        let beside = known.perturbed_with_history(parameter, side)?.history().between(from, to);
        let times = |of: &History| -> Vec<f64> {
            of.samples().iter().map(|row| row.measures.time).collect()
        };
        match times(&beside) == times(&self.history().between(from, to)) {
            true => Ok(beside),
            false => Err(known.perturbed(parameter, side).err().unwrap_or(DerivativeError::None)),
        }
    }

    /// Derivative of a quantity of the simulation with respect to a parameter.
    ///
    /// # Errors
    /// Fails if the run has no derivatives.
    pub fn derivative(
        &self,
        parameter: usize,
        number: impl Fn(&Self) -> f64,
    ) -> Result<f64, DerivativeError> {
        let [plus, minus] =
            [PerturbedSide::Plus, PerturbedSide::Minus].map(|side| self.perturbed(parameter, side));
        let distance = self.parameters().nth(parameter).map_or(f64::NAN, |(_, distance)| distance);
        Ok((number(plus?) - number(minus?)) / (2.0 * distance))
    }

    /// Solver statistics of the derivatives.
    pub fn derivative_counts(&self) -> DerivativeCounts {
        self.stepper.sensitivities.as_ref().map(|of| of.counts()).unwrap_or_default()
    }

    pub(in crate::simulation) fn model_mut(&mut self) -> &mut System {
        &mut self.model
    }

    pub(super) fn disable_derivatives(&mut self, event: &'static str) {
        let time = self.time();
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.disable(DerivativeError::Event { time, event });
        }
    }

    pub(super) fn end_derivatives(&mut self, change: &'static str) {
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.disable(DerivativeError::NotSupported { change });
        }
    }
}
