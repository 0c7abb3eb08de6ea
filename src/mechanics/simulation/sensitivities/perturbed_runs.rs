//! Runs with a positive and a negative perturbation of one parameter.

use super::{DerivativeError, PerturbedSide, Variation};
use crate::simulation::{Simulation, SimulationError};
use crate::system::{Scene, System, SystemState};

pub struct PerturbedRuns {
    pub(super) name: String,
    pub(super) distance: f64,
    runs: [Simulation; 2],
    derivative: Vec<f64>,
    states: [SystemState; 2],
}

impl PerturbedRuns {
    pub(super) fn start(
        run: &Simulation,
        variation: Variation,
        state: &SystemState,
    ) -> Result<Self, SimulationError> {
        let Variation { name, distance, scenes } = variation;
        let [plus, minus] = scenes.map(|scene| Simulation::start(scene, *run.settings()));
        let runs = [plus?, minus?];
        let has_form = |twin: &Simulation| {
            twin.unknowns() == run.unknowns() && twin.model().state().is_shaped_like(state)
        };
        if !runs.iter().all(has_form) {
            return Err(DerivativeError::Form { parameter: name, distance }.into());
        }
        if !runs.iter().all(|twin| times(twin.scene()) == times(run.scene())) {
            return Err(DerivativeError::Times { parameter: name }.into());
        }
        let states = [state.blank(), state.blank()];
        let mut perturbation = Self { name, distance, runs, derivative: Vec::new(), states };
        perturbation.differentiate();
        Ok(perturbation)
    }

    pub(super) fn release(
        &mut self,
        release: usize,
        state: &SystemState,
    ) -> Result<(), SimulationError> {
        for run in &mut self.runs {
            run.release(release)?;
        }
        self.states = [state.blank(), state.blank()];
        self.differentiate();
        Ok(())
    }

    pub(super) fn differentiate(&mut self) {
        let Self { runs, states, derivative, distance, .. } = self;
        for (run, state) in runs.iter().zip(states.iter_mut()) {
            run.model().write_state(state);
        }
        let [plus, minus] = states;
        plus.change_from(minus, 2.0 * *distance, derivative);
    }

    pub(super) fn set_perturbed_states(&mut self, state: &SystemState) {
        let Self { runs, states, derivative, distance, .. } = self;
        for ((run, beside), amount) in
            runs.iter_mut().zip(states.iter_mut()).zip([*distance, -*distance])
        {
            beside.displace(state, derivative, amount);
            run.model_mut().restore(beside);
        }
    }

    pub(super) fn models(&mut self) -> impl Iterator<Item = &mut System> {
        self.runs.iter_mut().map(Simulation::model_mut)
    }

    pub(super) fn runs(&mut self) -> impl Iterator<Item = &mut Simulation> {
        self.runs.iter_mut()
    }

    pub(super) fn run_mut(&mut self, side: PerturbedSide) -> &mut Simulation {
        let [plus, minus] = &mut self.runs;
        match side {
            PerturbedSide::Plus => plus,
            PerturbedSide::Minus => minus,
        }
    }

    pub(super) fn run(&self, side: PerturbedSide) -> &Simulation {
        let [plus, minus] = &self.runs;
        match side {
            PerturbedSide::Plus => plus,
            PerturbedSide::Minus => minus,
        }
    }
}

fn times(scene: &Scene) -> Vec<f64> {
    let breaks = scene.schedules().flat_map(|(_, schedule)| schedule.breaks());
    breaks.chain(scene.release_times()).collect()
}
