//! Time loop of a simulation. Steps end on a time grid. A failed step is halved and repeated.

mod adapting;
mod back;
mod content;
mod derivatives;
mod event_location;
mod explain;
mod failure_context;
mod failure_names;
mod frames;
mod phase_error;
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
use crate::system::{Scene, StartMismatch, System};

const MOST_DRY_STEPS: usize = 10_000;

/// Largest number of controller samples within one step.
const MOST_SAMPLES: f64 = 1e4;

/// Integrator, step size and tolerance of a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SimulationSettings {
    /// Time integrator of the simulation.
    pub method: Method,
    /// Fixed step size, or tolerance of variable steps.
    pub dt: StepSize,
    /// Tolerance of the Newton solver.
    pub tolerance: Tolerance,
}

impl SimulationSettings {
    /// Returns settings with the default tolerance of Newton's method.
    pub fn new(method: Method, dt: impl Into<StepSize>) -> Self {
        Self { method, dt: dt.into(), tolerance: Tolerance::default() }
    }
}

/// Simulation of a scene with its history.
pub struct Simulation {
    scene: Scene,
    settings: SimulationSettings,
    model: System,
    stepper: Stepper,
    adaptive: Option<Box<Adaptive>>,
    clock: StepClock,
    progress: RunProgress,
    record: RunRecord,
    snapshots: Snapshots,
    initial_geometry: InitialGeometry,
}

impl Simulation {
    /// Builds a scene and starts the simulation at t = 0.
    ///
    /// # Errors
    /// Fails if the step size or a method parameter is out of range, or if the scene cannot be built.
    /// Also fails if the method does not support an object or a sensor of the scene, or if a controller would be sampled too often in a step.
    pub fn start(scene: Scene, settings: SimulationSettings) -> Result<Self, SimulationError> {
        Self::start_while(scene, settings, &mut || true)
    }

    /// Builds a scene and starts the simulation, with a callback that can stop the assembly.
    /// The callback `goes_on` is called repeatedly during the assembly. If the callback returns false, the start fails.
    ///
    /// # Errors
    /// Fails in the same cases as [`start`](Self::start), or if the assembly is stopped.
    pub fn start_while(
        scene: Scene,
        settings: SimulationSettings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, SimulationError> {
        let mut model = System::assemble_in_motion(&scene, goes_on)?;
        let penetrations = model.start_penetrations();
        let mut started = Self::of(scene, model, settings)?;
        started.warn_of_penetrations(penetrations);
        Ok(started)
    }

    /// Starts a simulation from an equilibrium with zero velocities, at t = 0.
    /// If a drive or a prescribed rest length does not have its value for t = 0, the simulation starts at the time for which the equilibrium was computed.
    ///
    /// # Errors
    /// Fails in the same cases as [`start`](Self::start), or if a prescribed value in the equilibrium differs from its function.
    /// Also fails if a scene with sleeves has no equilibrium without the compliance that its meshes do not represent.
    pub fn start_at_rest(
        rest: &Equilibrium,
        settings: SimulationSettings,
    ) -> Result<Self, SimulationError> {
        let scene = rest.scene().clone();
        let factor = rest.path().load_factor();
        let mismatch = |time| rest.model().first_start_mismatch(factor, time);
        let time = mismatch(0.0).map_or(0.0, |_| larger(rest.loading().time, 0.0));
        if let Some((name, StartMismatch { at_rest, prescribed })) = mismatch(time) {
            let name = name.to_owned();
            return Err(SimulationError::StartMismatch { name, at_rest, prescribed, time });
        }
        let state = rest.state_in_motion().map_err(|source| {
            let scene = scene.name.clone();
            SimulationError::SleevesAtRest { scene, source: Box::new(source) }
        })?;
        let model = System::assemble_at_rest(&scene, &state, time)?;
        Self::of(scene, model, settings)
    }

    fn of(
        scene: Scene,
        mut model: System,
        settings: SimulationSettings,
    ) -> Result<Self, SimulationError> {
        settings.dt.check()?;
        check_method(&scene, settings.method)?;
        model.divide(cores());
        let integrator = settings.method.build(&mut model, settings.tolerance);
        let breaks = scene.schedules().flat_map(|(_, schedule)| schedule.breaks());
        let cuts = breaks.chain(scene.release_times()).collect();
        let (grid, adaptive, first) = match settings.dt {
            StepSize::Fixed(dt) => (TimeGrid::new(0.0, dt, cuts), None, dt),
            StepSize::Adaptive(control) => {
                let adaptive = Adaptive::new(&control, settings.method, &scene, &mut model);
                let first = adaptive.controller.first;
                (TimeGrid::of_cuts(0.0, first, cuts), Some(Box::new(adaptive)), first)
            }
        };
        let beats = || scene.schedules().filter_map(|(_, schedule)| schedule.sample_clock());
        if let Some(beat) = beats().find(|beat| beat.period() * MOST_SAMPLES < first) {
            let (period, most) = (beat.period(), MOST_SAMPLES);
            return Err(SimulationError::TooManySamples { period, dt: first, most });
        }
        let grid = grid.with_beats(beats());
        let step_size = adaptive.as_ref().map(|adaptive| adaptive.controller.start());
        if !settings.method.entry().claims.momentum
            && let Some(sensor) = scene.sensors.iter().find(|sensor| sensor.is_mean_of_joint())
        {
            let (sensor, method) = (sensor.name.clone(), settings.method.entry().name);
            return Err(SimulationError::NoMeanForces { sensor, method });
        }
        let mut started = Self {
            record: RunRecord::new(&scene, &mut model)?,
            clock: StepClock::new(grid, step_size),
            scene,
            settings,
            model,
            stepper: Stepper::of(integrator),
            adaptive,
            progress: RunProgress::default(),
            snapshots: Snapshots::default(),
            initial_geometry: InitialGeometry::default(),
        };
        started.warn_of_start_impacts();
        Ok(started)
    }

    /// Sets the largest number of threads for large scenes (default: the number of cores). Results do not depend on this number.
    pub fn use_threads(&mut self, most: usize) {
        self.model.divide(most);
    }

    /// Present time [time].
    pub fn time(&self) -> f64 {
        self.model.time()
    }

    /// Simulated scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Settings of the simulation.
    pub fn settings(&self) -> &SimulationSettings {
        &self.settings
    }

    /// Mechanism in its present state.
    pub fn model(&self) -> &System {
        &self.model
    }

    /// History of the run up to the present time.
    pub fn history(&self) -> &History {
        &self.record.history
    }

    /// Trajectory of the run up to the present time.
    pub fn trajectory(&self) -> &Trajectory {
        &self.record.trajectory
    }

    /// Solver statistics.
    pub fn counts(&self) -> &WorkCounts {
        &self.progress.counts
    }

    /// Number of unknowns of a step, including contact multipliers.
    pub fn unknowns(&self) -> usize {
        self.model.unknowns() + self.model.constraint_shape().width
    }

    /// Half-bandwidth of the matrix of a step.
    pub fn half_bandwidth(&self) -> usize {
        self.model.half_bandwidth()
    }

    /// Returns true if the simulation has reached a time, within rounding.
    pub fn has_reached(&self, time: f64) -> bool {
        self.clock.grid.has_reached(self.time(), time)
    }

    /// Largest difference of two times that count as equal [time].
    pub fn slack(&self) -> f64 {
        self.clock.grid.slack(self.time())
    }

    /// Requires that a step ends at the given future time.
    pub fn cut_at(&mut self, time: f64) {
        self.clock.grid.cut_at(time);
    }

    /// Takes one step to the next end time of the grid.
    ///
    /// # Errors
    /// Fails if the equations of the step have no solution, a load or a drive has no value, an arrival has ended the run, or the monitor stops the run.
    pub fn step(&mut self, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        if let Some(ending) = self.ending() {
            return Err(SimulationError::Ended { ending });
        }
        self.clock.goal = f64::INFINITY;
        let stepped = self.step_at_most_to(f64::INFINITY, monitor);
        self.show_present();
        stepped
    }

    /// Runs until `end`, where the last step ends, or until a slider ends the run.
    ///
    /// # Errors
    /// Fails if `end` is in the past or not finite, the equations of a step have no solution, a load or a drive has no value, or the monitor stops the run.
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

    /// Advances the time without solving equations (dry run). The history receives the rows of a motionless scene.
    ///
    /// Dry runs check scripts. In a dry run with very many steps, a single long step to `end` replaces all steps after the first 9999.
    ///
    /// # Errors
    /// Fails if `end` is in the past or not finite, or if the monitor stops the run.
    pub fn dry_run_to(
        &mut self,
        end: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        self.check_end(end)?;
        self.clock.goal = end;
        let mut beside = self.stepper.sensitivities.take();
        let pretended = self.dry_run_alone_to(end, monitor);
        if let Some(sensitivities) = &mut beside {
            sensitivities.dry_run_to(end);
        }
        self.stepper.sensitivities = beside;
        if pretended? > 0 {
            self.dry_run_arrivals();
            self.dry_run_releases()?;
        }
        Ok(())
    }

    fn dry_run_alone_to(
        &mut self,
        end: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<usize, SimulationError> {
        let mut rows = 0;
        while !self.has_reached(end) {
            rows += 1;
            let next = if rows < MOST_DRY_STEPS { self.next_stop(end) } else { end };
            let dt = next - self.time();
            self.model.set_time(next);
            self.execute_due_releases()?;
            self.clock.grid.mark_reached(next);
            self.progress.count_dry_run(dt);
            self.store_present();
            self.query_monitor(monitor)?;
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
            self.execute_due_releases()?;
        }
        let next = self.clock.grid.next(self.time(), limit);
        let interval = Interval::between(self.time(), next);
        if self.model.apply_drive_jumps(interval) {
            self.record_contact_changes();
            if let Some(sensitivities) = &mut self.stepper.sensitivities {
                sensitivities.apply_drive_jumps(interval);
            }
        }
        let stepped = match self.adaptive.take() {
            None => self.step_on_grid(limit, monitor),
            Some(mut adaptive) => {
                let stepped = self.adapt(&mut adaptive, limit, monitor);
                self.adaptive = Some(adaptive);
                stepped
            }
        };
        if !matches!(stepped, Err(SimulationError::Interrupted { .. })) {
            self.clock.retry = None;
        }
        self.clock.grid.mark_reached(self.time());
        self.progress.counts.wall += begun.elapsed();
        stepped
    }

    fn step_on_grid(
        &mut self,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let end = self.clock.grid.next(self.time(), limit);
        let begun_before = self.clock.retry.filter(|halving| halving.end() == end);
        let interval = Interval::between(self.time(), end);
        self.cover_with_arrivals(begun_before.unwrap_or_else(|| StepRetry::new(interval)), monitor)
    }
}

fn check_method(scene: &Scene, method: Method) -> Result<(), SimulationError> {
    method.check()?;
    let name = method.entry().name;
    let sliders = scene.sliders_with_friction().filter(|_| method != Method::EnergyMomentum);
    let contacts = scene.elements_with_friction().filter(|_| method == Method::FourthOrder);
    if let Some(object) = sliders.chain(contacts).next() {
        return Err(SimulationError::FrictionMethod { object, method: name });
    }
    if let Some(slider) = scene.slider_with_side().filter(|_| method != Method::EnergyMomentum) {
        let slider = slider.name.clone();
        return Err(SimulationError::SideMethod { slider, method: name });
    }
    Ok(())
}
