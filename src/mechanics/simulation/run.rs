//! The time loop: steps on the grid, halved and tried again where they fail.

mod adapting;
mod back;
mod content;
mod derivatives;
mod event_location;
mod explain;
mod failure_context;
mod failure_names;
mod frames;
mod recording;
mod release;
mod revisit;
mod section_results;
mod stepping;
mod views;
mod warnings;

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::adaptive::Adaptive;
use super::clock::StepClock;
use super::initial_geometry::InitialGeometry;
use super::progress::RunProgress;
use super::record::RunRecord;
use super::snapshots::Snapshots;
use super::step_retry::StepRetry;
use super::stepper::Stepper;
use super::{History, Monitor, SimulationError, StepSize, TimeGrid, Trajectory, WorkCounts, cores};
use crate::geometry::larger;
use crate::integrators::{Constraints, Interval, Mechanism, Method};
use crate::newton::Tolerance;
use crate::statics::Equilibrium;
use crate::system::{Scene, System};

/// Most steps that a pretended run has.
const MOST_PRETENDED: usize = 10_000;

/// A controller is asked at most so often in a step.
const MOST_SAMPLES: f64 = 1e4;

/// How a scene is simulated: integrator, step size, tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SimulationSettings {
    /// The integrator of the simulation.
    pub method: Method,
    /// The step size of the simulation, or what it is found by.
    pub dt: StepSize,
    /// The tolerance of the Newton solver.
    pub tolerance: Tolerance,
}

impl SimulationSettings {
    /// Returns settings with the default tolerance of Newton's method.
    pub fn new(method: Method, dt: impl Into<StepSize>) -> Self {
        Self { method, dt: dt.into(), tolerance: Tolerance::default() }
    }
}

/// A simulation: a scene in motion, with its history.
pub struct Simulation {
    scene: Scene,
    settings: SimulationSettings,
    model: System,
    stepper: Stepper,
    /// What finds the size of steps, where it varies.
    adaptive: Option<Box<Adaptive>>,
    clock: StepClock,
    progress: RunProgress,
    record: RunRecord,
    snapshots: Snapshots,
    drawn: InitialGeometry,
}

impl Simulation {
    /// Builds a scene and puts the simulation at its start, t = 0.
    ///
    /// # Errors
    /// When the step size or the parameter of the method is out of its range, or the scene cannot be built.
    pub fn start(scene: Scene, settings: SimulationSettings) -> Result<Self, SimulationError> {
        let model = System::assemble(&scene)?;
        Self::of(scene, model, settings)
    }

    /// A simulation that starts from the scene of an equilibrium, at rest as it was found: at t = 0; or, if a drive has moved it, at the time of the
    /// equilibrium, from which on the functions of drives lead further.
    ///
    /// # Errors
    /// When the step size or the parameter of the method is out of its range, or a drive rests elsewhere than where its function is.
    pub fn start_at_rest(
        rest: &Equilibrium,
        settings: SimulationSettings,
    ) -> Result<Self, SimulationError> {
        let scene = rest.scene().clone();
        let elsewhere = |time| rest.model().drive_elsewhere(rest.path().load_factor(), time);
        let time = elsewhere(0.0).map_or(0.0, |_| larger(rest.loading().time, 0.0));
        if let Some((drive, [rests, wanted])) = elsewhere(time) {
            let drive = drive.to_owned();
            return Err(SimulationError::BeginsElsewhere { drive, rests, wanted, time });
        }
        let model = System::assemble_at_rest(&scene, &rest.model().state(), time)?;
        Self::of(scene, model, settings)
    }

    fn of(
        scene: Scene,
        mut model: System,
        settings: SimulationSettings,
    ) -> Result<Self, SimulationError> {
        settings.dt.check()?;
        settings.method.check()?;
        model.divide(cores());
        let integrator = settings.method.build(&mut model, settings.tolerance);
        let breaks = scene.schedules().flat_map(|(_, schedule)| schedule.breaks());
        let cuts = breaks.chain(scene.release_times()).collect();
        let (grid, adaptive, first) = match settings.dt {
            StepSize::Fixed(dt) => (TimeGrid::new(0.0, dt, cuts), None, dt),
            StepSize::Adaptive(control) => {
                let adaptive = Adaptive::new(&control, settings.method, &scene, &model);
                let first = adaptive.controller.first;
                (TimeGrid::of_cuts(0.0, first, cuts), Some(Box::new(adaptive)), first)
            }
        };
        let beats = || scene.schedules().filter_map(|(_, schedule)| schedule.beat());
        if let Some(beat) = beats().find(|beat| beat.period() * MOST_SAMPLES < first) {
            let (period, most) = (beat.period(), MOST_SAMPLES);
            return Err(SimulationError::ManySamples { period, dt: first, most });
        }
        let grid = grid.with_beats(beats());
        let pace = adaptive.as_ref().map(|adaptive| adaptive.controller.start());
        if !settings.method.entry().claims.momentum
            && let Some(sensor) = scene.sensors.iter().find(|sensor| sensor.is_of_step())
        {
            let (sensor, method) = (sensor.name.clone(), settings.method.entry().name);
            return Err(SimulationError::NoMean { sensor, method });
        }
        Ok(Self {
            record: RunRecord::new(&scene, &mut model)?,
            clock: StepClock::new(grid, pace),
            scene,
            settings,
            model,
            stepper: Stepper::of(integrator),
            adaptive,
            progress: RunProgress::default(),
            snapshots: Snapshots::default(),
            drawn: InitialGeometry::default(),
        })
    }

    /// Lets up to `most` threads work on a large beam, at first as many as there are cores; results are the same.
    pub fn use_threads(&mut self, most: usize) {
        self.model.divide(most);
    }

    /// The present time of the simulation [time].
    pub fn time(&self) -> f64 {
        self.model.time()
    }

    /// The scene that is simulated.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How the scene is simulated.
    pub fn settings(&self) -> &SimulationSettings {
        &self.settings
    }

    /// The mechanism of the simulation at its present state.
    pub fn model(&self) -> &System {
        &self.model
    }

    /// The history of the simulation: all rows so far.
    pub fn history(&self) -> &History {
        &self.record.history
    }

    /// The trajectory of the simulation: configurations so far.
    pub fn trajectory(&self) -> &Trajectory {
        &self.record.trajectory
    }

    /// The work of the simulation so far.
    pub fn counts(&self) -> &WorkCounts {
        &self.progress.counts
    }

    /// The number of unknowns of a step of the simulation, those of contacts included.
    pub fn unknowns(&self) -> usize {
        self.model.unknowns() + self.model.constraint_shape().width
    }

    /// The half-bandwidth of the matrix of a step: how far from the diagonal it has entries.
    pub fn half_bandwidth(&self) -> usize {
        self.model.half_bandwidth()
    }

    /// Whether the simulation has reached a time, but for rounding.
    pub fn has_reached(&self, time: f64) -> bool {
        self.clock.grid.has_reached(self.time(), time)
    }

    /// By how much a time may be missed and still count as reached [time].
    pub fn slack(&self) -> f64 {
        self.clock.grid.slack(self.time())
    }

    /// Makes a step of the simulation end at a time to come.
    pub fn cut_at(&mut self, time: f64) {
        self.clock.grid.cut_at(time);
    }

    /// Takes one step of the simulation: to the next point of the grid, or to the next cut of it.
    ///
    /// # Errors
    /// When no step works, the run has ended at the end of a master, or the monitor stops it.
    pub fn step(&mut self, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        if let Some(ending) = self.ending() {
            return Err(SimulationError::Ended { ending });
        }
        self.clock.goal = f64::INFINITY;
        let stepped = self.step_at_most_to(f64::INFINITY, monitor);
        self.show_present();
        stepped
    }

    /// Takes steps of the simulation until a time, which ends the last step, or until a slider ends the run.
    ///
    /// # Errors
    /// When the time has passed, no step works, or the monitor stops the run.
    pub fn run_to(&mut self, end: f64, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        self.check_end(end)?;
        let now = self.time();
        let steps = ((end - now) / self.dt()).min(1e6) as usize + 8;
        self.record.reserve(steps);
        self.clock.goal = end;
        let mut ran = Ok(());
        while ran.is_ok() && !self.has_reached(end) && !self.has_ended() {
            ran = self.step_at_most_to(end, monitor);
        }
        self.show_present();
        ran
    }

    fn check_end(&self, end: f64) -> Result<(), SimulationError> {
        let now = self.time();
        if !end.is_finite() {
            return Err(SimulationError::End { now, end });
        }
        match end < now - self.slack() {
            true => Err(SimulationError::End { now, end }),
            false => Ok(()),
        }
    }

    /// Lets time pass as steps would, without solving anything: the history gets rows in which nothing happens.
    ///
    /// For checking scripts; of very many steps only the first and the last are pretended.
    ///
    /// # Errors
    /// When the time has passed or is not finite, or the monitor stops the run.
    pub fn pretend_to(
        &mut self,
        end: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        self.check_end(end)?;
        self.clock.goal = end;
        // What runs beside makes rows of its own.
        let mut beside = self.stepper.sensitivities.take();
        let pretended = self.pretend_alone_to(end, monitor);
        if let Some(sensitivities) = &mut beside {
            sensitivities.pretend_to(end);
        }
        self.stepper.sensitivities = beside;
        if pretended? > 0 {
            self.pretend_arrivals();
            self.pretend_releases()?;
        }
        Ok(())
    }

    /// How many rows were pretended.
    fn pretend_alone_to(
        &mut self,
        end: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<usize, SimulationError> {
        let mut rows = 0;
        while !self.has_reached(end) {
            rows += 1;
            let next = if rows < MOST_PRETENDED { self.next_stop(end) } else { end };
            let dt = next - self.time();
            self.model.pass_time_to(next);
            self.let_go_due()?;
            self.clock.grid.reach(next);
            self.progress.count_pretended(dt);
            self.keep_present();
            self.ask(monitor)?;
        }
        Ok(rows)
    }

    fn step_at_most_to(
        &mut self,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let begun = Instant::now();
        if !self.scene.releases.is_empty() {
            self.let_go_due()?;
        }
        let next = self.clock.grid.next(self.time(), limit);
        let way = Interval::between(self.time(), next);
        if self.model.follow_jumps_of_drives(way)
            && let Some(sensitivities) = &mut self.stepper.sensitivities
        {
            sensitivities.follow_jumps_of_drives(way);
        }
        let stepped = match self.adaptive.take() {
            None => self.step_on_grid(limit, monitor),
            Some(mut adaptive) => {
                let stepped = self.adapt(&mut adaptive, limit, monitor);
                self.adaptive = Some(adaptive);
                stepped
            }
        };
        // What was interrupted goes on where it was, with steps of the same size.
        if !matches!(stepped, Err(SimulationError::Interrupted { .. })) {
            self.clock.under_way = None;
        }
        self.clock.grid.reach(self.time());
        self.progress.counts.wall += begun.elapsed();
        stepped
    }

    fn step_on_grid(
        &mut self,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let end = self.clock.grid.next(self.time(), limit);
        let begun_before = self.clock.under_way.filter(|halving| halving.end() == end);
        let way = Interval::between(self.time(), end);
        self.cover_with_arrivals(begun_before.unwrap_or_else(|| StepRetry::new(way)), monitor)
    }
}
