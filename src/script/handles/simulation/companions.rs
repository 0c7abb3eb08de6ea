//! Companion runs, which repeat a simulation from its start on another mesh or with other steps.

use std::rc::Rc;

use super::SimulationHandle;
use crate::script::bindings::stored::StoredFunction;
use crate::script::handles::captured_variables::{expect_no_side_effects, functions_of_time};
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::notes::{Notes, Printing};
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::{Simulation, SimulationSettings, StepControl, StepSize};
use crate::statics::Equilibrium;
use crate::system::Scene;

#[derive(Clone)]
pub enum RunStart {
    Scene,
    Equilibrium(EquilibriumHandle),
    Loaded,
}

/// Discretisation of a companion run, relative to that of the simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Companion {
    pub span_ratio: f64,
    pub step_ratio: f64,
}

const NO_FILES: &str = "companion runs repeat the functions of a simulation and must not write \
    files; write them after the run";

impl SimulationHandle {
    /// Starts a simulation of a scene on a mesh with another number of spans, without adding it to the report.
    pub fn start_refined(
        scene: &SceneHandle,
        span_ratio: f64,
        settings: SimulationSettings,
        name: String,
    ) -> Result<Self, ScriptError> {
        let description = scene.scene().borrow().with_span_ratio(span_ratio)?;
        let simulation = Simulation::start(description, settings)?;
        let notes = Notes::new(Printing::Never);
        let handle = Self::unreported(simulation, scene.clone(), name, notes, RunStart::Scene);
        handle.evaluate_columns()?;
        Ok(handle)
    }

    pub fn run_silently(&self, end: f64, context: &Context) -> Result<(), ScriptError> {
        let checks = context.with_checks(|checks| checks.clone());
        let ran = context.without_output_or_files(NO_FILES, || self.run_to(context, end));
        context.with_checks(|counted| *counted = checks);
        ran
    }

    pub fn start(&self) -> &RunStart {
        &self.0.start
    }

    pub fn has_callbacks(&self) -> bool {
        self.callbacks().next().is_some() || !self.0.events.borrow().all().is_empty()
    }

    fn callbacks(&self) -> impl Iterator<Item = &StoredFunction> {
        self.0.sensing.all_functions()
    }

    pub fn companion_scene(&self, companion: Companion) -> Result<Scene, ScriptError> {
        let simulation = self.simulation();
        let scene = simulation.scene();
        if companion.span_ratio == 1.0 {
            return Ok(scene.clone());
        }
        Ok(scene.with_span_ratio(companion.span_ratio)?)
    }

    pub fn companion_settings(&self, companion: Companion) -> SimulationSettings {
        let settings = *self.simulation().settings();
        let dt = match settings.dt {
            StepSize::Fixed(dt) => StepSize::Fixed(dt * companion.step_ratio),
            StepSize::Adaptive(control) => {
                let order = settings.method.entry().claims.order;
                let looser = (0..order).fold(1.0, |factor, _| factor * companion.step_ratio);
                let tolerance = (control.tolerance * looser).min(StepControl::MOST_TOLERANCE);
                StepSize::Adaptive(StepControl { tolerance, ..control })
            }
        };
        SimulationSettings { dt, ..settings }
    }

    /// Runs a companion to the present time of this simulation, without the output of its functions.
    pub fn run_companion(
        &self,
        companion: Companion,
        context: &Context,
    ) -> Result<Self, ScriptError> {
        let (scene, settings) =
            (self.companion_scene(companion)?, self.companion_settings(companion));
        let description = scene.clone();
        let mut simulation = match self.start() {
            RunStart::Equilibrium(rest) if companion.span_ratio == 1.0 => {
                Simulation::start_at_rest(&rest.equilibrium(), settings)?
            }
            RunStart::Equilibrium(rest) => {
                let loading = *rest.equilibrium().loading();
                let found = Equilibrium::find(scene, loading, &mut |_| !context.is_stopped())?;
                Simulation::start_at_rest(&found, settings)?
            }
            RunStart::Scene | RunStart::Loaded => Simulation::start(scene, settings)?,
        };
        let events = self.0.events.borrow().clone();
        for (time, _) in events.all() {
            simulation.cut_at(*time);
        }
        let (scene, notes) = (self.0.scene.clone(), self.0.notes.clone());
        let name = self.name().to_owned();
        let handle = Self::unreported(simulation, scene, name, notes, self.start().clone());
        handle.0.events.replace(events);
        handle.0.events.borrow_mut().reschedule_after(f64::NEG_INFINITY);
        let events: Vec<Rc<StoredFunction>> =
            self.0.events.borrow().all().iter().map(|(_, function)| function.clone()).collect();
        let mut functions = functions_of_time(&description);
        functions.extend(self.callbacks().chain(events.iter().map(|function| &**function)));
        let ran = expect_no_side_effects(&functions, || {
            handle.evaluate_columns()?;
            handle.run_silently(self.time(), context)
        });
        // Access to this simulation restores its controller outputs, which the companion run has changed.
        self.with_simulation_mut(|_| ());
        ran.map(|()| handle)
    }
}
