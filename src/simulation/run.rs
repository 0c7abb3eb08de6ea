//! The time loop: steps on the grid, halved and tried again where they fail.

use std::cell::OnceCell;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::adaptive::Adaptive;
use super::columns::{extra_columns, extra_values};
use super::controller::Pace;
use super::landing::Arrival;
use super::recording::StepTaken;
use super::snapshots::Snapshots;
use super::stepping::Halving;
use super::{
    History, Outline, Recording, Sample, Scales, SimulationError, StepSize, TimeGrid, Trajectory,
    cores,
};

use crate::geometry::Vec2;
use crate::integrators::{Constraints, Integrator, Interval, Mechanism, Method};
use crate::model::{Model, Scene};
use crate::newton::Tolerance;
use crate::statics::Equilibrium;

/// Most steps that a pretended run has.
const MOST_PRETENDED: usize = 10_000;

/// How a scene is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The integrator.
    pub method: Method,
    /// The step size, or what it is found by.
    pub dt: StepSize,
    /// Of the Newton solver.
    pub tolerance: Tolerance,
}

/// The work of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WorkCounts {
    /// Steps that succeeded; two halves that are compared with a whole one count as one.
    pub steps: usize,
    /// Newton iterations of these steps, each with new factors; for steps of varying size those of all three solves that a pair
    /// of half steps takes.
    pub newton_iterations: usize,
    /// Corrections of these steps with factors at hand.
    pub corrections: usize,
    /// The most Newton iterations of one step: of one solve where steps are fixed, of its three solves together where they vary.
    pub newton_max: usize,
    /// Factorised matrices, failed tries included.
    pub factorisations: usize,
    /// Failed tries.
    pub retries: usize,
    /// Steps that erred by more than a tolerance allowed.
    pub rejected: usize,
    /// Steps that were tried to find when a slider arrives at the end of its master.
    pub arrival_tries: usize,
    /// Time spent in steps, by this program: it is not in files, which would differ from run to run.
    #[serde(skip)]
    pub wall: Duration,
}

/// Somebody who watches a run after every step.
pub trait Monitor {
    /// Called after every step and every failed try; `false` stops the run there.
    fn goes_on(&mut self, time: f64) -> bool;
}

/// Nobody.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl Monitor for Unwatched {
    fn goes_on(&mut self, _time: f64) -> bool {
        true
    }
}

/// A scene in motion.
pub struct Simulation {
    pub(super) scene: Scene,
    pub(super) settings: Settings,
    pub(super) model: Model,
    pub(super) integrator: Box<dyn Integrator>,
    pub(super) grid: TimeGrid,
    pub(super) history: History,
    pub(super) trajectory: Trajectory,
    pub(super) counts: WorkCounts,
    pub(super) arrivals: Vec<Arrival>,
    /// What finds the size of steps where it varies,
    pub(super) adaptive: Option<Box<Adaptive>>,
    /// and what it has found so far.
    pub(super) pace: Option<Pace>,
    /// A step of the grid that is covered in part.
    pub(super) under_way: Option<Halving>,
    pub(super) snapshots: Snapshots,
    pub(super) recording: Recording,
    /// The first rows of the history, which stay; a further one belongs to the present.
    pub(super) rows_kept: usize,
    pub(super) last_step: StepTaken,
    /// Where the present run ends; infinite for single steps [time].
    pub(super) goal: f64,
    /// Made when the first picture asks for them.
    pub(super) outlines: OnceCell<Vec<Outline>>,
    /// Of the scene as drawn, found when the first note asks for it [time].
    pub(super) lowest_period: OnceCell<Option<f64>>,
}

impl Simulation {
    /// Builds a scene and puts it at its start, t = 0.
    ///
    /// # Errors
    /// When the step size or the parameter of the method is out of its range, or the scene cannot be built.
    pub fn start(scene: Scene, settings: Settings) -> Result<Self, SimulationError> {
        let model = Model::assemble(&scene)?;
        Self::of(scene, model, settings)
    }

    /// Puts the scene of an equilibrium at t = 0, at rest as it was found.
    ///
    /// # Errors
    /// When the step size or the parameter of the method is out of its range.
    pub fn start_at_rest(rest: &Equilibrium, settings: Settings) -> Result<Self, SimulationError> {
        let scene = rest.scene().clone();
        let mut model = Model::assemble(&scene)?;
        model.restore(&rest.model().state());
        Self::of(scene, model, settings)
    }

    fn of(scene: Scene, mut model: Model, settings: Settings) -> Result<Self, SimulationError> {
        settings.dt.check()?;
        settings.method.check()?;
        model.divide(cores());
        let integrator = settings.method.build(&mut model, settings.tolerance);
        let cuts = scene.loads().flat_map(|load| load.schedule.breaks()).collect();
        let longest = scene.longest_beam().unwrap_or(0.0);
        let mut history = History::new(scales(&scene, &model, longest), extra_columns(&scene));
        let measures = model.measure();
        history.push(Sample { measures, ..Sample::default() }, extra_values(&model));
        let mut trajectory =
            Trajectory::new(2 * model.control_points().map(<[Vec2]>::len).sum::<usize>());
        trajectory.push(0.0, coordinates(&model));
        let (grid, adaptive) = match settings.dt {
            StepSize::Fixed(dt) => (TimeGrid::new(0.0, dt, cuts), None),
            StepSize::Adaptive(control) => {
                let adaptive = Adaptive::new(&control, settings.method, &scene, &model);
                let first = adaptive.controller.first;
                (TimeGrid::of_cuts(0.0, first, cuts), Some(Box::new(adaptive)))
            }
        };
        Ok(Self {
            scene,
            settings,
            model,
            integrator,
            grid,
            history,
            trajectory,
            counts: WorkCounts::default(),
            arrivals: Vec::new(),
            pace: adaptive.as_ref().map(|adaptive| adaptive.controller.start()),
            adaptive,
            under_way: None,
            snapshots: Snapshots::default(),
            recording: Recording::default(),
            rows_kept: 1,
            last_step: StepTaken::default(),
            goal: f64::INFINITY,
            outlines: OnceCell::new(),
            lowest_period: OnceCell::new(),
        })
    }

    /// From here on up to so many threads work on a large beam, at first as many as there are cores; results are the same.
    pub fn use_threads(&mut self, most: usize) {
        self.model.divide(most);
    }

    /// Where the simulation is [time].
    pub fn time(&self) -> f64 {
        self.model.time()
    }

    /// What is simulated.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How it is simulated.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The mechanism at its present state.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// All steps so far.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Configurations so far.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// The work so far.
    pub fn counts(&self) -> &WorkCounts {
        &self.counts
    }

    /// The number of unknowns of a step, those of contacts included.
    pub fn unknowns(&self) -> usize {
        self.model.unknowns() + self.model.constraint_shape().width
    }

    /// How far from the diagonal the matrix of a step reaches.
    pub fn half_bandwidth(&self) -> usize {
        self.model.half_bandwidth()
    }

    /// Whether a time has come, but for rounding.
    pub fn has_reached(&self, time: f64) -> bool {
        self.grid.has_reached(self.time(), time)
    }

    /// By how much a time may be missed and still be reached [time].
    pub fn slack(&self) -> f64 {
        self.grid.slack(self.time())
    }

    /// Makes a step end at a time to come.
    pub fn cut_at(&mut self, time: f64) {
        self.grid.cut_at(time);
    }

    /// Takes one step: to the next point of the grid, or to the next cut of it.
    ///
    /// # Errors
    /// When no step works, the run has ended at the end of a master, or the monitor stops it.
    pub fn step(&mut self, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        if let Some(ending) = self.ending() {
            return Err(SimulationError::Ended { ending });
        }
        self.goal = f64::INFINITY;
        let stepped = self.step_at_most_to(f64::INFINITY, monitor);
        self.show_present();
        stepped
    }

    /// Steps until a time, which ends the last step, or until a slider ends the run.
    ///
    /// # Errors
    /// When the time has passed, no step works, or the monitor stops the run.
    pub fn run_to(&mut self, end: f64, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        self.check_end(end)?;
        let now = self.time();
        let steps = ((end - now) / self.dt()).min(1e6) as usize + 8;
        let rows = self.recording.rows_of(steps);
        self.history.reserve(rows);
        self.trajectory.reserve(rows);
        self.goal = end;
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
            return Err(SimulationError::End { now, end, advice: "give a finite time" });
        }
        if end < now - self.slack() {
            return Err(SimulationError::End {
                now,
                end,
                advice: "give a later time, or go back with sim.rewind(t)",
            });
        }
        Ok(())
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
        self.goal = end;
        let mut rows = 0;
        while !self.has_reached(end) {
            rows += 1;
            let next = if rows < MOST_PRETENDED { self.next_stop(end) } else { end };
            let dt = next - self.time();
            self.model.pass_time_to(next);
            self.grid.reach(next);
            self.counts.steps += 1;
            self.last_step = StepTaken { dt, ..StepTaken::default() };
            if self.is_worth_a_row() {
                self.keep_row();
            }
            self.remember();
            self.ask(monitor)?;
        }
        if rows > 0 {
            self.pretend_arrivals();
        }
        Ok(())
    }

    fn step_at_most_to(
        &mut self,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let begun = Instant::now();
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
            self.under_way = None;
        }
        self.grid.reach(self.time());
        self.counts.wall += begun.elapsed();
        stepped
    }

    fn step_on_grid(
        &mut self,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let end = self.grid.next(self.time(), limit);
        let begun_before = self.under_way.filter(|halving| halving.end() == end);
        let way = Interval::between(self.time(), end);
        self.cover_with_arrivals(begun_before.unwrap_or_else(|| Halving::new(way)), monitor)
    }
}

pub(super) fn coordinates(model: &Model) -> impl Iterator<Item = f64> + '_ {
    model.control_points().flatten().flat_map(|point| [point.x, point.y])
}

/// What a change of an invariant is measured by when the motion itself is small.
fn scales(scene: &Scene, model: &Model, longest: f64) -> Scales {
    let distances = model.control_points().flatten().map(|point| point.norm());
    Scales {
        mass: model.total_mass(),
        // The radius of gyration of the longest beam, or how far the scene is from the origin.
        length: distances.fold(longest / 12_f64.sqrt(), |length, distance| {
            if distance > 10.0 * longest { length.max(distance) } else { length }
        }),
        rounding_energy: scene.rounding_energy(),
    }
}
