//! Handle of a simulation for scripts: steps, scheduled functions, progress and interruption.

mod commands;
mod companions;
mod revisit;
mod sensing;
mod variants;
mod visit;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use rhai::Dynamic;

use super::events::Events;
use super::notes::Notes;
use super::scene::SceneHandle;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::bindings::stored::StoredFunction;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::format_number;
use crate::script::messages::stop::Stop;
use crate::script::presentation::details;
use crate::script::state::context::Context;
use crate::script::state::settings::RunMode;
use crate::simulation::{Monitor, Simulation, SimulationError, StepSize};
use crate::vibration::{Modes, VibrationError};
use sensing::ColumnReader;

pub use companions::{Companion, RunStart};
pub use revisit::Revisit;
pub use visit::Visited;

#[derive(Clone)]
pub struct SimulationHandle(Rc<Live>);

struct Live {
    name: String,
    scene: SceneHandle,
    simulation: RefCell<Simulation>,
    events: RefCell<Events<Rc<StoredFunction>>>,
    is_firing: Cell<bool>,
    is_ending_told: Cell<bool>,
    was_stopped: Cell<bool>,
    notes: Notes,
    start: RunStart,
    sensing: ColumnReader,
}

pub enum RunTarget {
    Steps(usize),
    Time(f64),
}

struct ProgressMonitor<'a> {
    context: &'a Context,
    /// End of the run minus the tolerance for equal times [time]. A run that has reached it is complete, even if the limit of steps is used up.
    /// `f64::NEG_INFINITY` disables the limit of steps.
    end: f64,
    /// True if the run must stop after every step to call script functions.
    pauses: bool,
    /// True if the run was stopped only to call script functions.
    is_paused: bool,
}

impl<'a> ProgressMonitor<'a> {
    fn new(context: &'a Context, end: f64) -> Self {
        Self { context, end, pauses: false, is_paused: false }
    }
}

impl Monitor for ProgressMonitor<'_> {
    fn continues(&mut self, time: f64) -> bool {
        self.context.progress().report_time(time);
        self.context.meter().count_step();
        let may_step = time >= self.end || self.context.meter().allows_a_step();
        let goes_on = may_step && !self.context.is_stopped();
        self.is_paused = goes_on && self.pauses;
        goes_on && !self.pauses
    }
}

/// Observer of a simulation in a dry run, which stops as in a real run but does not count steps.
struct DryRunObserver<'a>(&'a Context);

impl Monitor for DryRunObserver<'_> {
    fn continues(&mut self, _time: f64) -> bool {
        !self.0.is_stopped()
    }
}

impl SimulationHandle {
    /// Tolerance and bounds of adaptive steps in brackets, after a space; empty for fixed steps.
    pub fn step_control(&self) -> String {
        match self.simulation().settings().dt {
            StepSize::Fixed(_) => String::new(),
            StepSize::Adaptive(control) => format!(" ({control})"),
        }
    }

    /// True if there is another handle to the same simulation.
    pub fn is_shared(&self) -> bool {
        Rc::strong_count(&self.0) > 1
    }

    pub fn new(
        simulation: Simulation,
        scene: SceneHandle,
        name: String,
        notes: Notes,
        start: RunStart,
        context: &Context,
    ) -> Self {
        let handle = Self::unreported(simulation, scene, name, notes, start);
        handle.report_as_latest(context);
        handle
    }

    pub fn report_as_latest(&self, context: &Context) {
        context.add_reporter(Box::new(self.clone()));
        self.is_latest(context);
    }

    fn unreported(
        simulation: Simulation,
        scene: SceneHandle,
        name: String,
        notes: Notes,
        start: RunStart,
    ) -> Self {
        let live = Live {
            sensing: ColumnReader::new(
                scene.functions(simulation.outside_columns()),
                scene.controllers(),
                scene.conditions(),
            ),
            name,
            scene,
            notes,
            start,
            is_firing: Cell::new(false),
            is_ending_told: Cell::new(false),
            was_stopped: Cell::new(false),
            simulation: RefCell::new(simulation),
            events: RefCell::default(),
        };
        Self(Rc::new(live))
    }

    /// Independent copy of the simulation in its present state, with its scheduled functions.
    pub fn fork(&self, name: String, context: &Context) -> Result<Self, ScriptError> {
        if self.simulation().parameters().next().is_some() {
            let message = "a copy of the simulation would have no derivatives by the parameters of its \
                scene";
            let hint = "build the scene with plain numbers in place of scene.parameter(…)";
            return Err(ScriptError::new(message).hint(hint));
        }
        let simulation = self.simulation().fork()?;
        let (scene, notes) = (self.0.scene.clone(), self.0.notes.clone());
        let fork = Self::new(simulation, scene, name, notes, self.0.start.clone(), context);
        fork.0.sensing.copy_from(&self.0.sensing);
        fork.0.events.replace(self.0.events.borrow().clone());
        fork.0.is_ending_told.set(self.0.is_ending_told.get());
        Ok(fork)
    }

    fn is_latest(&self, context: &Context) {
        context.set_latest_simulation(Dynamic::from(self.clone()));
    }

    pub fn modes(
        &self,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Modes, VibrationError> {
        self.0.simulation.borrow_mut().modes(count, goes_on)
    }

    /// Sets the memory for snapshots [bytes].
    pub fn set_snapshot_memory(&self, limit: usize) {
        self.0.simulation.borrow_mut().enable_snapshots(limit);
    }

    pub fn events_waiting(&self) -> usize {
        self.0.events.borrow().waiting()
    }

    pub fn scene(&self) -> &SceneHandle {
        &self.0.scene
    }

    pub fn is_same(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }

    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Present time [time].
    pub fn time(&self) -> f64 {
        self.simulation().time()
    }

    pub fn at(&self, time: f64, function: StoredFunction) -> Result<(), ScriptError> {
        let now = self.time();
        let is_late = if self.0.is_firing.get() { time <= now } else { time < now };
        if is_late {
            return Err(ScriptError::new(format!(
                "at: t = {} is in the past, the simulation is at t = {}",
                format_number(time),
                format_number(now)
            ))
            .hint("give a later time"));
        }
        self.0.simulation.borrow_mut().cut_at(time);
        self.0.events.borrow_mut().insert(time, Rc::new(function));
        Ok(())
    }

    /// Rewinds the simulation to an earlier state; only approximately in a dry run.
    pub fn rewind_to(&self, call: &Call, goal: &RunTarget) -> Result<(), ScriptError> {
        self.0.sensing.expect_idle()?;
        let mut simulation = self.0.simulation.borrow_mut();
        match (call.context().mode(), goal) {
            (RunMode::Run, RunTarget::Steps(steps)) => simulation.back(*steps)?,
            (RunMode::Run, RunTarget::Time(time)) => simulation.rewind(*time)?,
            (RunMode::DryRun, RunTarget::Steps(steps)) => simulation.dry_run_back(*steps),
            (RunMode::DryRun, RunTarget::Time(time)) => simulation.dry_run_rewind(*time),
        }
        drop(simulation);
        self.evaluate_columns()?;
        self.0.events.borrow_mut().reschedule_after(self.time() + self.slack());
        self.0.is_ending_told.set(false);
        self.is_latest(call.context());
        Ok(())
    }

    fn slack(&self) -> f64 {
        self.simulation().slack()
    }

    pub fn advance(&self, call: &Call, goal: &RunTarget) -> Result<(), ScriptError> {
        self.0.sensing.expect_idle()?;
        let context = call.context();
        let dt = self.simulation().dt();
        let now = self.time();
        let end = match goal {
            RunTarget::Steps(steps) => now + *steps as f64 * dt,
            RunTarget::Time(time) => *time,
        };
        self.is_latest(context);
        if self.0.scene.take_change() {
            self.0.notes.report_changed_scene(
                self.name(),
                &self.simulation().scene().name,
                context,
            );
        }
        context.progress().begin(&self.0.name, now, end);
        let outcome = match (context.mode(), goal) {
            (RunMode::DryRun, _) => self.dry_run(context, end),
            (RunMode::Run, RunTarget::Steps(steps)) => self.take_steps(context, *steps),
            (RunMode::Run, RunTarget::Time(_)) => {
                let ran = self.run_to(context, end);
                self.0.notes.report_warnings(self.name(), &self.simulation(), context);
                ran
            }
        };
        context.progress().end();
        self.0.was_stopped.set(outcome.is_err());
        outcome
    }

    fn take_steps(&self, context: &Context, steps: usize) -> Result<(), ScriptError> {
        for taken in 0..steps {
            if taken > 0 && self.has_ended() {
                self.report_end(context, &format!("before it had taken {steps} steps"));
                break;
            }
            if !context.meter().allows_a_step() {
                context.proceed()?;
            }
            self.step_with_callbacks(context)?;
            self.call_due_functions()?;
        }
        Ok(())
    }

    /// Returns true if the last advance did not reach its goal, because of an error or an interrupt.
    pub fn was_stopped(&self) -> bool {
        self.0.was_stopped.get()
    }

    fn has_ended(&self) -> bool {
        self.simulation().has_ended()
    }

    fn report_end(&self, context: &Context, when: &str) {
        let ending = self.simulation().ending().filter(|_| !self.0.is_ending_told.replace(true));
        if let Some(ending) = ending {
            context.print_message(&format!(
                "note: simulation '{}' ended {when}: {ending}",
                self.0.name
            ));
        }
    }

    fn run_to(&self, context: &Context, end: f64) -> Result<(), ScriptError> {
        loop {
            let next = self.0.events.borrow().next_time().unwrap_or(f64::INFINITY);
            let stop = if next < end { next } else { end };
            let slack = self.slack();
            if self.time() < stop - slack && !context.meter().allows_a_step() {
                context.proceed()?;
            }
            self.run_with_callbacks(context, stop, slack)?;
            self.call_due_functions()?;
            if self.has_ended() && self.time() < end {
                let when = format!("before t = {}", format_number(end));
                self.report_end(context, &when);
                return Ok(());
            }
            if self.time() >= end || stop >= end || stop.is_nan() {
                return Ok(());
            }
        }
    }

    pub fn dry_run(&self, context: &Context, end: f64) -> Result<(), ScriptError> {
        context.meter().count_dry_run();
        context.proceed()?;
        let mut watch = DryRunObserver(context);
        let pretended = self.0.simulation.borrow_mut().dry_run_to(end, &mut watch);
        pretended.map_err(|error| explain(error, context))?;
        self.evaluate_columns()?;
        self.call_due_functions()
    }

    fn call_due_functions(&self) -> Result<(), ScriptError> {
        let slack = self.slack();
        loop {
            let due = self.0.events.borrow_mut().take_due(self.time() + slack);
            let Some(function) = due else { return Ok(()) };
            // The return value of a scheduled function is ignored.
            self.0.is_firing.set(true);
            let called = function.call([Dynamic::from(self.clone())]);
            self.0.is_firing.set(false);
            let _ = called.map_err(ScriptError::Engine)?;
        }
    }
}

fn explain(error: SimulationError, context: &Context) -> ScriptError {
    match error {
        SimulationError::Interrupted { .. } => {
            ScriptError::Stopped(context.stopped_by().unwrap_or(Stop::Interrupt))
        }
        error => error.into(),
    }
}

fn step_size(size: &StepSize) -> String {
    match size {
        StepSize::Fixed(dt) => format!("dt = {}", format_number(*dt)),
        StepSize::Adaptive(control) => control.to_string(),
    }
}

impl Scripted for SimulationHandle {
    const NAME: &'static str = "simulation";
    const DOC: &'static str = "A simulation of a scene.";

    fn is_busy(&self) -> Option<String> {
        let is_stepping = self.0.simulation.try_borrow().is_err();
        is_stepping.then(|| format!("simulation '{}' is in the middle of a step", self.0.name))
    }

    fn show(&self) -> String {
        let Ok(simulation) = self.0.simulation.try_borrow() else {
            return format!("simulation '{}' in the middle of a step", self.0.name);
        };
        let (counts, settings) = (simulation.counts(), simulation.settings());
        let ended = simulation.ending().map(|ending| format!("; ended: {ending}"));
        format!(
            "simulation '{}' at t = {} after {} steps, {}, {}, {} unknowns{}",
            self.0.name,
            format_number(simulation.time()),
            counts.steps,
            settings.method.entry().name,
            step_size(&settings.dt),
            simulation.unknowns(),
            ended.unwrap_or_default(),
        )
    }

    fn details(&self) -> Details {
        details::of_simulation(&self.simulation())
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        let has = self.0.simulation.try_borrow().is_ok_and(|of| of.parameters().next().is_some());
        self.0.scene.parameter_set().filter(|_| has)
    }
}
