//! History columns, controllers and release conditions that script functions evaluate between steps.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use rhai::Dynamic;

use super::commands::Commands;
use super::variants::in_words;
use super::{ProgressMonitor, SimulationHandle, explain};
use crate::loads::{SampleClock, Schedule};
use crate::script::bindings::parameter_variants::set_unavailable;
use crate::script::bindings::stored::StoredFunction;
use crate::script::handles::scene::{Condition, Controller};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::{as_number, describe};
use crate::script::state::context::Context;
use crate::simulation::{Simulation, StepSize};

pub(super) struct ColumnReader {
    functions: Vec<Rc<StoredFunction>>,
    evaluated_at: Cell<Option<usize>>,
    controllers: Vec<Rc<Controller>>,
    commands: RefCell<Vec<BTreeMap<u64, f64>>>,
    outputs: Commands,
    conditions: Vec<Condition>,
    is_looking: Cell<bool>,
}

impl ColumnReader {
    pub(super) fn new(
        functions: Vec<Rc<StoredFunction>>,
        controllers: Vec<Rc<Controller>>,
        conditions: Vec<Condition>,
    ) -> Self {
        let (evaluated_at, is_looking) = (Cell::new(None), Cell::new(false));
        let commands = RefCell::new(vec![BTreeMap::new(); controllers.len()]);
        let outputs = Commands::new(controllers.len());
        Self { functions, evaluated_at, controllers, commands, outputs, conditions, is_looking }
    }

    pub(super) fn copy_from(&self, other: &Self) {
        self.commands.replace(other.commands.borrow().clone());
        self.outputs.copy_from(&other.outputs);
    }

    pub(super) fn all_functions(&self) -> impl Iterator<Item = &StoredFunction> {
        let columns = self.functions.iter().map(|function| &**function);
        let conditions = self.conditions.iter().map(|condition| &*condition.function);
        let controllers = self.controllers.iter().map(|controller| &controller.function);
        columns.chain(conditions).chain(controllers)
    }

    fn command_of(&self, controller: usize, sample: u64) -> Option<f64> {
        self.commands.borrow().get(controller)?.get(&sample).copied()
    }

    fn record_command(&self, controller: usize, sample: u64, command: f64) {
        if let Some(own) = self.commands.borrow_mut().get_mut(controller) {
            own.insert(sample, command);
        }
    }

    /// Sets the outputs of the controllers in the scene to those of this simulation before the time `time`.
    /// Outputs in the scene may belong to another simulation that shares the scene.
    fn recall(&self, time: f64) {
        for (number, controller) in self.controllers.iter().enumerate() {
            controller.value.set(self.outputs.before(number, time));
        }
    }

    /// Rejects advancing or rewinding by a function that may only read the simulation.
    pub fn expect_idle(&self) -> Result<(), ScriptError> {
        match self.is_looking.get() {
            false => Ok(()),
            true => Err(ScriptError::new(
                "a function that is called by a simulation must not advance or change it",
            )
            .hint("step it outside the function, or at a time: sim.at(t, |sim| …)")),
        }
    }
}

impl SimulationHandle {
    pub fn with_simulation_mut<T>(&self, look: impl FnOnce(&mut Simulation) -> T) -> T {
        let run = &mut *self.0.simulation.borrow_mut();
        self.0.sensing.recall(run.time());
        let Some((parameter, side)) = Self::present_side(run) else { return look(run) };
        match run.perturbed_mut(parameter, side) {
            Ok(beside) => return look(beside),
            Err(reason) => set_unavailable(&in_words(&reason)),
        }
        look(run)
    }

    pub fn evaluate_columns(&self) -> Result<(), ScriptError> {
        let ColumnReader { functions, evaluated_at, is_looking, .. } = &self.0.sensing;
        let steps = self.simulation().counts().steps;
        if functions.is_empty() || evaluated_at.replace(Some(steps)) == Some(steps) {
            return Ok(());
        }
        let mut values = Vec::with_capacity(functions.len());
        for function in functions {
            is_looking.set(true);
            let called = function.call([Dynamic::from(self.clone())]);
            is_looking.set(false);
            let value = called.map_err(ScriptError::Engine)?;
            values.push(as_number(&value).ok_or_else(|| {
                let engine = function.context().engine();
                let got = engine.map(|engine| describe(&engine, &value)).unwrap_or_default();
                ScriptError::new(format!("{} must return a number, got {got}", function.role()))
                    .hint("for a vector record two columns: |q| q.position(rod.end).x, |q| q.position(rod.end).y")
            })?);
        }
        self.0.simulation.borrow_mut().fill_in(&values);
        Ok(())
    }

    fn release_due(&self) -> Result<(), ScriptError> {
        let ColumnReader { conditions, is_looking, .. } = &self.0.sensing;
        for Condition { function, release } in conditions {
            if !self.simulation().waits_for_release(*release) {
                continue;
            }
            is_looking.set(true);
            let called = function.call([Dynamic::from(self.clone())]);
            is_looking.set(false);
            let value = called.map_err(ScriptError::Engine)?;
            let is_true = value.as_bool().map_err(|_| {
                let engine = function.context().engine();
                let got = engine.map(|engine| describe(&engine, &value)).unwrap_or_default();
                ScriptError::new(format!(
                    "{} must return true or false, got {got}",
                    function.role()
                ))
                .hint("return a comparison: |q| norm(q.present_joint_force(pin).force) > 10")
            })?;
            if is_true {
                self.0.simulation.borrow_mut().release(*release)?;
            }
        }
        Ok(())
    }

    /// Evaluates release conditions and controllers for the next step or half step.
    pub(super) fn command(&self) -> Result<(), ScriptError> {
        if !self.simulation().is_paused_in_step() {
            self.release_due()?;
        }
        let (time, sensing) = (self.time(), &self.0.sensing);
        for (number, controller) in sensing.controllers.iter().enumerate() {
            let value = match controller.beat {
                Some(beat) => self.sampled_command(number, controller, beat)?,
                None => self.call_controller(controller)?,
            };
            sensing.outputs.record(number, time, value);
        }
        // All outputs change at the same time, so that every controller reads the previous outputs of the others.
        sensing.recall(time.next_up());
        Ok(())
    }

    /// Output of a sampled controller: zero before its first sample, and constant between samples.
    fn sampled_command(
        &self,
        number: usize,
        controller: &Controller,
        beat: SampleClock,
    ) -> Result<f64, ScriptError> {
        let (now, slack) = (self.time(), self.simulation().slack());
        let sensing = &self.0.sensing;
        if let Some(sample) = beat.sample_at(now, slack) {
            sensing.record_command(number, sample, self.call_controller(controller)?);
        }
        let Some(acting) = beat.sample_active_after(now, slack) else { return Ok(0.0) };
        match sensing.command_of(number, acting) {
            Some(command) => Ok(command),
            None => Err(ScriptError::internal_error(format!(
                "nobody asked a controller at sample {acting}"
            ))),
        }
    }

    fn call_controller(&self, controller: &Controller) -> Result<f64, ScriptError> {
        let (function, is_looking) = (&controller.function, &self.0.sensing.is_looking);
        is_looking.set(true);
        let called = function.call([Dynamic::from(self.time()), Dynamic::from(self.clone())]);
        is_looking.set(false);
        let value = called.map_err(ScriptError::Engine)?;
        let number = as_number(&value).filter(|number| number.is_finite());
        number.ok_or_else(|| {
            let engine = function.context().engine();
            let got = engine.map(|engine| describe(&engine, &value)).unwrap_or_default();
            ScriptError::new(format!(
                "{} must return a finite number, got {got} at t = {}",
                self.role_of(controller),
                self.time()
            ))
        })
    }

    fn role_of(&self, controller: &Controller) -> String {
        let simulation = self.simulation();
        let is_own = |schedule: &Schedule| matches!(schedule, Schedule::Sampled(value) | Schedule::DigitalController { value, .. } if Rc::ptr_eq(value, &controller.value));
        let scene = simulation.scene();
        let own = scene.schedules().find(|(_, schedule)| is_own(schedule));
        match own {
            Some((name, _)) => format!("the controller of {}", scene.source_of_schedule(name)),
            None => controller.function.role().to_string(),
        }
    }

    fn varies_steps(&self) -> bool {
        matches!(self.simulation().settings().dt, StepSize::Adaptive(_))
    }

    pub(super) fn is_controlled(&self) -> bool {
        let ColumnReader { controllers, conditions, .. } = &self.0.sensing;
        let waits = |condition: &Condition| self.simulation().waits_for_release(condition.release);
        !controllers.is_empty() || conditions.iter().any(waits)
    }

    /// Runs the simulation to a time. User-defined columns are evaluated at recorded steps.
    /// Controllers and release conditions are evaluated before every step.
    pub(super) fn run_with_callbacks(
        &self,
        context: &Context,
        stop: f64,
        slack: f64,
    ) -> Result<(), ScriptError> {
        let ran = self.run_with_pauses(context, stop, slack);
        self.restore_after_error(ran)
    }

    pub(super) fn step_with_callbacks(&self, context: &Context) -> Result<(), ScriptError> {
        let stepped = self.step_with_pauses(context);
        self.restore_after_error(stepped)
    }

    fn restore_after_error(&self, ran: Result<(), ScriptError>) -> Result<(), ScriptError> {
        ran.inspect_err(|_| self.0.simulation.borrow_mut().restore_step_start())
    }

    fn step_with_pauses(&self, context: &Context) -> Result<(), ScriptError> {
        let steps = self.simulation().counts().steps;
        loop {
            self.command()?;
            // The limit of steps cannot stop the run within a step, because the number of substeps is not known in advance.
            let mut watch = ProgressMonitor::new(context, f64::NEG_INFINITY);
            watch.pauses = self.varies_steps() && self.is_controlled();
            let stepped = self.0.simulation.borrow_mut().step(&mut watch);
            let is_taken = stepped.is_ok() || self.simulation().counts().steps > steps;
            if !watch.is_paused || is_taken {
                if !watch.is_paused {
                    stepped.map_err(|error| explain(error, context))?;
                }
                return self.evaluate_columns();
            }
        }
    }

    fn run_with_pauses(&self, context: &Context, stop: f64, slack: f64) -> Result<(), ScriptError> {
        loop {
            self.command()?;
            let mut watch = ProgressMonitor::new(context, stop - slack);
            watch.pauses = !self.0.sensing.functions.is_empty() || self.is_controlled();
            let ran = self.0.simulation.borrow_mut().run_to(stop, &mut watch);
            if !watch.is_paused || ran.is_ok() {
                ran.map_err(|error| explain(error, context))?;
                return self.evaluate_columns();
            }
            let simulation = self.simulation();
            let is_due = !simulation.is_paused_in_step()
                && simulation.recording().is_due(simulation.counts().steps);
            drop(simulation);
            if is_due {
                self.evaluate_columns()?;
            }
        }
    }
}
