//! Derivatives of a run with respect to parameters, computed by tangent-linear steps.

mod error;
mod perturbed_runs;

use std::fmt;

pub use error::DerivativeError;
pub(super) use perturbed_runs::PerturbedRuns;

use super::{NoMonitor, Recording, Simulation, SimulationError, SimulationSettings, StepSize};
use crate::integrators::{
    Integrator, Interval, Mechanism, SharedFactorStepper, SharedFactorWork, StepError,
};
use crate::newton::NewtonReport;
use crate::system::{Scene, System, SystemState};

/// Two scenes for a perturbed parameter: one with a positive and one with a negative perturbation.
#[derive(Debug, Clone)]
pub struct Variation {
    /// Name of the parameter.
    pub name: String,
    /// Perturbation in the unit of the parameter.
    pub distance: f64,
    /// Scenes with the positive and with the negative perturbation of the parameter.
    pub scenes: [Scene; 2],
}

/// Sign of a perturbation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PerturbedSide {
    /// Parameter plus the perturbation.
    Plus,
    /// Parameter minus the perturbation.
    Minus,
}

/// Solver statistics of the derivatives of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DerivativeCounts {
    /// Number of linear systems solved with the factors of the main run.
    pub solves: usize,
    /// Number of additional factorisations, needed if the factors of the main run were not accurate enough.
    pub factorisations: usize,
}

/// Derivatives of a run with respect to parameters, solved with the factorised matrix of each step.
/// The right-hand side of the linear system follows from the residuals at a positive and a negative perturbation of the parameter.
pub(super) struct Sensitivities {
    stepper: SharedFactorStepper,
    parameters: Vec<PerturbedRuns>,
    start: SystemState,
    counts: DerivativeCounts,
    end_reason: Option<DerivativeError>,
}

impl Sensitivities {
    /// Creates the derivatives of a run at its start.
    ///
    /// # Errors
    /// Fails if the method has no derivatives, if the steps are variable, or if the scene has a controller or a sensor of accumulated means.
    /// Also fails if a perturbed scene cannot be built, or has a different structure or different times of jumps or releases.
    pub(super) fn new(
        run: &mut Simulation,
        variations: Vec<Variation>,
    ) -> Result<Self, SimulationError> {
        let settings = *run.settings();
        if let StepSize::Adaptive(_) = settings.dt {
            return Err(DerivativeError::Adaptive.into());
        }
        let steered = run.scene().schedules().find(|(_, schedule)| schedule.is_sampled());
        if let Some(name) = steered.map(|(name, _)| name.to_owned()) {
            return Err(DerivativeError::Controlled { name }.into());
        }
        if let Some(sensor) = run.scene().sensors.iter().find(|sensor| sensor.is_summed()) {
            return Err(DerivativeError::Mean { sensor: sensor.name.clone() }.into());
        }
        let name = settings.method.entry().name;
        let company = SharedFactorStepper::of(settings.method, run.model_mut(), settings.tolerance)
            .ok_or(DerivativeError::Method { method: name })?;
        let start = run.model().state();
        let perturbation = |variation| PerturbedRuns::start(run, variation, &start);
        let parameters = variations.into_iter().map(perturbation).collect::<Result<_, _>>()?;
        Ok(Self {
            stepper: company,
            parameters,
            start,
            counts: DerivativeCounts::default(),
            end_reason: None,
        })
    }

    pub(super) fn step(
        &mut self,
        model: &mut System,
        integrator: &mut dyn Integrator,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        if self.end_reason.is_some() {
            return integrator.step(model, interval);
        }
        model.write_state(&mut self.start);
        for perturbation in &mut self.parameters {
            perturbation.set_perturbed_states(&self.start);
        }
        let models = self.parameters.iter_mut().flat_map(PerturbedRuns::models);
        let mut companions: Vec<&mut dyn Mechanism> =
            models.map(|model| model as &mut dyn Mechanism).collect();
        let SharedFactorWork { leader, companions } =
            self.stepper.step(model, &mut companions, interval)?;
        match companions {
            Ok(work) => {
                self.counts.solves += work.corrections + work.iterations;
                self.counts.factorisations += work.iterations;
                self.parameters.iter_mut().for_each(PerturbedRuns::differentiate);
            }
            Err(source) => {
                let time = interval.start;
                self.end_reason = Some(DerivativeError::NoStep { time, source: Box::new(source) });
            }
        }
        Ok(leader)
    }

    pub(super) fn apply_drive_jumps(&mut self, interval: Interval) {
        for perturbation in &mut self.parameters {
            for model in perturbation.models() {
                model.apply_drive_jumps(interval);
            }
            perturbation.differentiate();
        }
    }

    /// Applies a release of the main run to the perturbed runs.
    /// Positions and rates are continuous at the release, and the time of the release does not depend on parameters.
    pub(super) fn release(
        &mut self,
        release: usize,
        model: &mut System,
        settings: &SimulationSettings,
    ) -> Result<(), SimulationError> {
        if self.end_reason.is_some() {
            return Ok(());
        }
        self.start = model.state();
        for perturbation in &mut self.parameters {
            perturbation.release(release, &self.start)?;
        }
        if let Some(stepper) = SharedFactorStepper::of(settings.method, model, settings.tolerance) {
            self.stepper = stepper;
        }
        Ok(())
    }

    pub(super) fn count_step(&mut self, interval: Interval, report: NewtonReport) {
        self.each(|twin| twin.count_step(interval, report, 0));
    }

    pub(super) fn store_row(&mut self) {
        self.each(Simulation::keep_row);
    }

    pub(super) fn append_present(&mut self) {
        self.each(Simulation::show_present);
    }

    pub(super) fn dry_run_to(&mut self, end: f64) {
        self.each(|twin| {
            // Errors are ignored, because the main run has and reports the same errors.
            let _: Result<(), SimulationError> = twin.dry_run_to(end, &mut NoMonitor);
        });
    }

    pub(super) fn record(&mut self, recording: Recording) {
        self.each(|twin| twin.record(recording));
    }

    fn each(&mut self, what: impl FnMut(&mut Simulation)) {
        if self.end_reason.is_none() {
            self.parameters.iter_mut().flat_map(PerturbedRuns::runs).for_each(what);
        }
    }

    pub(super) fn disable(&mut self, reason: DerivativeError) {
        let _: &mut DerivativeError = self.end_reason.get_or_insert(reason);
    }
}

impl fmt::Debug for Sensitivities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sensitivities").field("counts", &self.counts).finish_non_exhaustive()
    }
}

impl Sensitivities {
    pub(super) fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        self.parameters
            .iter()
            .map(|perturbation| (perturbation.name.as_str(), perturbation.distance))
    }

    pub(super) fn perturbed(
        &self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&Simulation, DerivativeError> {
        match &self.end_reason {
            Some(reason) => Err(reason.clone()),
            None => {
                let perturbation = self.parameters.get(parameter).ok_or(DerivativeError::None)?;
                Ok(perturbation.run(side))
            }
        }
    }

    /// Perturbed run for a parameter, with its history up to the time at which the derivatives ended.
    ///
    /// # Errors
    /// Fails if the main run has been changed after the derivatives were computed.
    pub(super) fn perturbed_with_history(
        &self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&Simulation, DerivativeError> {
        match &self.end_reason {
            None | Some(DerivativeError::Event { .. } | DerivativeError::NoStep { .. }) => {
                let perturbation = self.parameters.get(parameter).ok_or(DerivativeError::None)?;
                Ok(perturbation.run(side))
            }
            Some(reason) => Err(reason.clone()),
        }
    }

    pub(super) fn perturbed_mut(
        &mut self,
        parameter: usize,
        side: PerturbedSide,
    ) -> Result<&mut Simulation, DerivativeError> {
        match &self.end_reason {
            Some(reason) => Err(reason.clone()),
            None => {
                let perturbation =
                    self.parameters.get_mut(parameter).ok_or(DerivativeError::None)?;
                Ok(perturbation.run_mut(side))
            }
        }
    }

    pub(super) fn counts(&self) -> DerivativeCounts {
        self.counts
    }
}
