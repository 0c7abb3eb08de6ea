//! Derivatives by parameters of the scene, found with the steps.

use super::{Simulation, SimulationSettings};
use crate::simulation::sensitivities::Sensitivities;
use crate::simulation::{
    DerivativeCounts, DerivativeError, History, PerturbedSide, SimulationError, Variation,
};
use crate::system::{Scene, System};

impl Simulation {
    /// Builds a scene with those that parameters make of it, and puts the simulation at its start; the derivatives by these parameters are found with its
    /// steps, which they do not change.
    ///
    /// # Errors
    /// As those of [`start`](Self::start), and when steps cannot be taken in company or the scenes differ in more than numbers.
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

    /// The names of the parameters by which the simulation has derivatives, with the distances of the runs beside it.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        self.stepper.sensitivities.iter().flat_map(|of| of.parameters())
    }

    /// The run beside this one at a parameter, by its index, plus or minus its distance, in the state that lies so far from the present one in the
    /// direction of the derivative: half the difference of what both tell, over the distance, is the derivative of that.
    ///
    /// # Errors
    /// When there are no derivatives (any more).
    pub fn beside(&self, parameter: usize, side: PerturbedSide) -> Result<&Self, DerivativeError> {
        let known = self.stepper.sensitivities.as_ref().ok_or(DerivativeError::None)?;
        known.beside(parameter, side)
    }

    /// The same, to look at it by way of what may change it for the moment.
    ///
    /// # Errors
    /// When there are no derivatives (any more).
    pub fn beside_mut(
        &mut self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&mut Self, DerivativeError> {
        let known = self.stepper.sensitivities.as_mut().ok_or(DerivativeError::None)?;
        known.beside_mut(parameter, side)
    }

    /// The part of the history of the run beside this one at a parameter, by its index, plus or minus its distance, that belongs to the rows between two
    /// times. It is there as well where derivatives have ended behind these.
    ///
    /// # Errors
    /// When there are no derivatives of all of these rows.
    pub fn history_beside(
        &self,
        parameter: usize,
        side: PerturbedSide,
        (from, to): (f64, f64),
    ) -> Result<History, DerivativeError> {
        let known = self.stepper.sensitivities.as_ref().ok_or(DerivativeError::None)?;
        let beside = known.beside_so_far(parameter, side)?.history().between(from, to);
        let times = |of: &History| -> Vec<f64> {
            of.samples().iter().map(|row| row.measures.time).collect()
        };
        match times(&beside) == times(&self.history().between(from, to)) {
            true => Ok(beside),
            false => Err(known.beside(parameter, side).err().unwrap_or(DerivativeError::None)),
        }
    }

    /// The derivative of a number that a simulation tells by a parameter, by its index.
    ///
    /// # Errors
    /// When there are no derivatives (any more).
    pub fn derivative(
        &self,
        parameter: usize,
        number: impl Fn(&Self) -> f64,
    ) -> Result<f64, DerivativeError> {
        let [plus, minus] =
            [PerturbedSide::Plus, PerturbedSide::Minus].map(|side| self.beside(parameter, side));
        let distance = self.parameters().nth(parameter).map_or(f64::NAN, |(_, distance)| distance);
        Ok((number(plus?) - number(minus?)) / (2.0 * distance))
    }

    /// The work for the derivatives of the simulation so far.
    pub fn derivative_counts(&self) -> DerivativeCounts {
        self.stepper.sensitivities.as_ref().map(|of| of.counts()).unwrap_or_default()
    }

    /// The mechanism of the simulation, to be stepped by somebody else.
    pub(in crate::simulation) fn model_mut(&mut self) -> &mut System {
        &mut self.model
    }

    /// There are no derivatives from the present on: something happens that they do not pass.
    pub(super) fn lose_derivatives(&mut self, event: &'static str) {
        let time = self.time();
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.lose(DerivativeError::Event { time, event });
        }
    }

    /// There are no derivatives from here on: the run did not get here by its steps.
    pub(super) fn leave_derivatives(&mut self, way: &'static str) {
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.lose(DerivativeError::Way { way });
        }
    }
}
