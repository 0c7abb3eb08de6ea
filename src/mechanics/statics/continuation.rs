//! Continuation: a sequence of equilibria, each of which is found from the previous equilibrium.

use super::balance::{Balance, UnderLoad};
use super::error::StepFailure;
use super::loading::LEAST_PATH;
use super::path::vertex;
use super::path_step::PathStep;
use super::{ArcLength, Control, EquilibriumPath, Loading, PathPoint, StaticsError};
use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::{Constraints, Mechanism};
use crate::linalg::{BorderShape, BorderedMatrix};
use crate::newton::Newton;
use crate::system::{MasterEnd, Scene, System, SystemState, UnknownKind};

/// Largest number of times that a step is halved because no equilibrium is found, or because the equilibrium may lie on another part of the path.
const MOST_HALVINGS: u32 = 8;

/// Largest distance between two consecutive equilibria, as a multiple of the step length.
/// Equilibria whose distance exceeds the limit `FAR` may lie on different parts of the path.
const FAR: f64 = 2.0;

/// Largest ratio of the displacements per load increment in two consecutive steps that does not count as snap-through [-].
const SNAP_THROUGH_RATIO: f64 = 4.0;

/// Smallest displacement that is used as reference in the detection of snap-through, as a fraction of the size of the scene.
const NEARBY: f64 = 1e-3;

/// Number of iterations per step that the step size control tries to reach.
const WANTED_ITERATIONS: f64 = 4.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum InitialSupport {
    Itself,
    Loads(usize),
}

pub(super) struct Continuation<'s> {
    pub(super) scene: &'s Scene,
    length: f64,
    /// Weights of squared displacements and rotations in the distance between two equilibria.
    /// Displacements are divided by a length, and the weighted sum is averaged over the control points.
    metric: Vec<f64>,
    loading: Loading,
    pub(super) model: System,
    pub(super) path: EquilibriumPath,
    newton: Newton,
    pub(super) unknowns: Vec<f64>,
    residual: Vec<f64>,
    heading: PathDirection,
    /// Callback before every step and every iteration, with the last load factor. If it returns false, the search stops.
    goes_on: &'s mut dyn FnMut(f64) -> bool,
}

struct PathDirection {
    movements: Vec<f64>,
    unstable_directions: usize,
}

impl PathDirection {
    /// Returns true if step `next` turns by at most a right angle from step `self`, and both have the same number of unstable directions.
    /// A step that turns by more than a right angle may have reached another branch, for example near the buckling load of a column.
    fn is_aligned_with(&self, next: &Self, metric: &[f64]) -> bool {
        let ways = metric.iter().zip(&self.movements).zip(&next.movements);
        let along: f64 = ways.map(|((weight, before), now)| weight * before * now).sum();
        along >= 0.0 && next.unstable_directions == self.unstable_directions
    }
}

impl<'s> Continuation<'s> {
    pub(super) fn new(
        scene: &'s Scene,
        mut model: System,
        loading: Loading,
        goes_on: &'s mut dyn FnMut(f64) -> bool,
    ) -> Self {
        let all = model.unknowns() + model.constraint_shape().width;
        let mut path = EquilibriumPath::default();
        path.push(point(&mut model, 0.0, 0.0, 0));
        let length = scene.size().unwrap_or(1.0);
        Self {
            scene,
            length,
            metric: metric(&model, length),
            loading,
            newton: Newton::of(tangent(&model, 0), loading.tolerance),
            unknowns: vec![0.0; all],
            residual: vec![0.0; model.degrees_of_freedom()],
            heading: PathDirection { movements: vec![0.0; all], unstable_directions: 0 },
            goes_on,
            model,
            path,
        }
    }

    pub(super) fn load_up(&mut self, hold: InitialSupport) -> Result<(), StaticsError> {
        let Loading { factor, steps, .. } = self.loading;
        self.begin(factor * (1.0 / steps as f64), hold)?;
        for step in 2..=steps {
            self.solve_for_factor(factor * (step as f64 / steps as f64), MOST_HALVINGS)?;
        }
        Ok(())
    }

    fn begin(&mut self, factor: f64, hold: InitialSupport) -> Result<(), StaticsError> {
        match hold {
            InitialSupport::Itself => self.solve_for_factor(factor, MOST_HALVINGS),
            InitialSupport::Loads(movements) => {
                self.find_equilibrium(factor, movements)?;
                self.heading.unstable_directions = self.unstable_directions();
                Ok(())
            }
        }
    }

    pub(super) fn trace_path(
        &mut self,
        arc: ArcLength,
        hold: InitialSupport,
    ) -> Result<(), StaticsError> {
        let Loading { factor: goal, steps, .. } = self.loading;
        self.begin(goal / steps as f64, hold)?;
        if hold != InitialSupport::Itself && steps > 1 {
            // If only loads restrain the scene, the first load step does not follow a path. A second load step gives the direction of the path.
            self.solve_for_factor(goal * (2.0 / steps as f64), MOST_HALVINGS)?;
        }
        let mut trial = PathStep::new(&self.model, &self.loading);
        let mut distance = norm(&self.metric, &self.unknowns).min(arc.longest);
        if distance == 0.0 {
            // If the loads act on supports only, the displacement is zero and there is no path.
            return self.solve_for_factor(goal, MOST_HALVINGS);
        }
        while self.path.load_factor() != goal && self.path.points().len() < arc.points {
            trial.set_direction(&self.metric, &self.unknowns);
            distance = self.advance(&mut trial, distance)?.min(arc.longest);
        }
        Ok(())
    }

    fn advance(&mut self, trial: &mut PathStep, mut distance: f64) -> Result<f64, StaticsError> {
        let (from, goal) = (self.path.load_factor(), self.loading.factor);
        let mut miss = StepFailure::FarSolution;
        for _ in 0..=MOST_HALVINGS {
            self.query_monitor()?;
            let goes_on = &mut || (self.goes_on)(from);
            let balance = Balance { model: &mut self.model, length: self.length, goes_on };
            match trial.find(balance, from, distance, self.scene) {
                Ok(_) if norm(&self.metric, trial.movements()) > FAR * distance => {
                    miss = StepFailure::FarSolution
                }
                Ok(_) if (from < goal) != (trial.factor() < goal) => {
                    return self.solve_for_factor(goal, MOST_HALVINGS).map(|()| distance);
                }
                Ok(iterations) => {
                    if let Some(farthest) =
                        self.distance_to_turning_point(goal, trial.factor(), distance)
                        && let Ok(iterations) = self.find(goal)
                        && norm(&self.metric, &self.unknowns) <= farthest
                    {
                        self.accept(goal, iterations);
                        return Ok(distance);
                    }
                    self.unknowns.copy_from_slice(trial.movements());
                    self.accept(trial.factor(), iterations);
                    let growth = (WANTED_ITERATIONS / iterations as f64).sqrt();
                    return Ok(distance * growth.clamp(0.5, 1.5));
                }
                Err(error) => miss = error,
            }
            self.restore_last();
            distance *= 0.5;
        }
        self.query_monitor()?;
        Err(self.path_lost_error(miss))
    }

    /// Distance from the last point of the path to the turning point of the load factor.
    /// The distance is `None` unless the path crosses the requested load factor before the turning point and again after it.
    /// The required equilibrium is the first point at which the path crosses the requested load factor.
    fn distance_to_turning_point(&self, goal: f64, factor: f64, distance: f64) -> Option<f64> {
        let [.., before, last] = self.path.points() else { return None };
        let factors = [before.load_factor, last.load_factor, factor];
        let vertex = vertex(factors, [last.distance, distance])?;
        let is_beyond = (vertex.load_factor < goal) != (last.load_factor < goal);
        is_beyond.then_some(vertex.distance - last.distance)
    }

    fn solve_for_factor(&mut self, factor: f64, halvings: u32) -> Result<(), StaticsError> {
        self.query_monitor()?;
        let from = self.path.load_factor();
        match self.find(factor) {
            Ok(iterations) => {
                self.accept(factor, iterations);
                if self.is_continuation(halvings) {
                    return Ok(());
                }
                self.undo_step();
            }
            Err(error) if halvings == 0 => {
                self.query_monitor()?;
                return Err(self.path_lost_error(error));
            }
            Err(_) => (),
        }
        self.solve_for_factor(0.5 * (from + factor), halvings - 1)?;
        self.solve_for_factor(factor, halvings - 1)
    }

    /// Returns true if the last point continues the path, if the step cannot be halved again, or with arc-length control.
    fn is_continuation(&mut self, halvings: u32) -> bool {
        if self.loading.control != Control::Load {
            return true;
        }
        let falls = self.unstable_directions();
        let heading =
            PathDirection { movements: self.unknowns.clone(), unstable_directions: falls };
        let goes_on = halvings == 0 || self.heading.is_aligned_with(&heading, &self.metric);
        if goes_on {
            self.heading = heading;
        }
        goes_on
    }

    /// Number of negative eigenvalues of the stiffness; zero for scenes with follower loads.
    pub(super) fn unstable_directions(&self) -> usize {
        self.unstable_directions_with_inertia(0.0)
    }

    /// Number of negative eigenvalues of the stiffness plus `rate` [1/time²] times the inertia; zero for scenes with follower loads.
    pub(super) fn unstable_directions_with_inertia(&self, rate: f64) -> usize {
        if self.model.follower().is_some() {
            0
        } else {
            self.model.negative_stiffness_count_with_inertia(rate)
        }
    }

    fn find(&mut self, factor: f64) -> Result<usize, StepFailure> {
        let found = match self.balance_from(factor, 0.0) {
            Ok(_) if self.distance_moved() > self.farthest(factor) => Err(StepFailure::FarSolution),
            found => found,
        };
        if found.is_err() {
            self.restore_last();
        }
        found
    }

    pub(super) fn distance_moved(&self) -> f64 {
        norm(&self.metric, &self.unknowns)
    }

    /// Solves for a fraction of the loads, starting from the present configuration, and returns the number of iterations.
    /// With a positive `rate` [1/time²], a viscous damping force acts: `rate` times the inertia matrix times the displacements.
    ///
    /// The solution is repeated whenever a slider comes into contact with a stop or leaves a stop.
    pub(super) fn balance_from(&mut self, factor: f64, rate: f64) -> Result<usize, StepFailure> {
        let (reached, mut iterations) = (self.path.load_factor(), 0);
        for _ in 0..=self.scene.most_settlings() {
            self.model.predict_unchanged(&mut self.unknowns);
            self.model.begin_movement();
            let goes_on = &mut || (self.goes_on)(reached);
            let balance = Balance { model: &mut self.model, length: self.length, goes_on };
            let mut equations = UnderLoad { balance, factor, rate };
            let report =
                self.newton.solve(&mut equations, &mut self.unknowns, &mut self.residual)?;
            iterations += report.iterations;
            if !update_stop_contacts(&mut self.model, self.scene, &self.unknowns, factor)? {
                return Ok(iterations);
            }
        }
        Err(StepFailure::FarSolution)
    }

    /// Largest acceleration due to the unbalanced forces in the last configuration [1/time²].
    /// Accelerations of displacements are divided by the size of the scene, and angular accelerations are not scaled.
    /// The result is 1 if no force is unbalanced, because dynamic relaxation may then start with any rate.
    pub(super) fn acceleration_by_size(&mut self, factor: f64) -> f64 {
        self.model.predict_unchanged(&mut self.unknowns);
        self.model.begin_movement();
        self.residual.fill(0.0);
        self.model.add_static_forces(&self.unknowns, factor, &mut self.residual);
        let accelerations = self.model.uncoupled_accelerations(&self.residual);
        let kinds = self.model.unknown_kinds().iter().zip(accelerations);
        let fastest = kinds.map(|(kind, rate)| match kind {
            UnknownKind::Position => rate.abs() / self.length,
            UnknownKind::Rotation => rate.abs(),
            UnknownKind::Force => 0.0,
        });
        let fastest = fastest.fold(0.0, larger);
        self.restore_last();
        if fastest > 0.0 && fastest.is_finite() { fastest } else { 1.0 }
    }

    pub(super) fn restore_last(&mut self) {
        if let Some(last) = self.path.points().last() {
            self.model.restore(&last.state);
        }
    }

    /// Largest allowed distance of the next equilibrium from the last equilibrium.
    fn farthest(&self, factor: f64) -> f64 {
        let [.., before, last] = self.path.points() else { return f64::INFINITY };
        match self.loading.control {
            Control::ArcLength(arc) => FAR * arc.longest,
            Control::Load => {
                let share = (factor - last.load_factor) / (last.load_factor - before.load_factor);
                SNAP_THROUGH_RATIO * (last.distance * share.abs()).max(NEARBY)
            }
        }
    }

    fn accept(&mut self, factor: f64, iterations: usize) {
        self.model.move_by(&self.unknowns, factor);
        self.append_point(factor, self.distance_moved(), iterations);
    }

    pub(super) fn append_point(&mut self, factor: f64, distance: f64, iterations: usize) {
        self.path.push(point(&mut self.model, factor, distance, iterations));
    }

    /// Solves for a load factor from the present configuration, and returns the state of the model in the solution.
    pub(super) fn solve_at(mut self, factor: f64) -> Result<SystemState, StaticsError> {
        match self.balance_from(factor, 0.0) {
            Ok(_) => {
                self.model.move_by(&self.unknowns, factor);
                Ok(self.model.state())
            }
            Err(error) => Err(self.path_lost_error(error)),
        }
    }

    fn undo_step(&mut self) {
        self.path.pop();
        self.restore_last();
    }

    pub(super) fn query_monitor(&mut self) -> Result<(), StaticsError> {
        let reached = self.path.load_factor();
        if (self.goes_on)(reached) { Ok(()) } else { Err(StaticsError::Interrupted { reached }) }
    }

    pub(super) fn path_lost_error(&self, reason: StepFailure) -> StaticsError {
        let (scene, reached) = (self.scene.name.clone(), self.path.load_factor());
        let (points, reason) = (self.path.points().len(), Box::new(reason));
        match self.loading.control {
            Control::ArcLength(_) if points >= LEAST_PATH => {
                StaticsError::PathLost { scene, points, reached, reason }
            }
            Control::ArcLength(_) | Control::Load => {
                StaticsError::NoEquilibrium { scene, reached, reason }
            }
        }
    }
}

pub(super) fn update_stop_contacts(
    model: &mut System,
    scene: &Scene,
    unknowns: &[f64],
    factor: f64,
) -> Result<bool, StepFailure> {
    let leaves = |(slider, end): (usize, MasterEnd)| StepFailure::LeavesMaster {
        slider: scene.sliders[slider].name.clone(),
        end: end.name(),
    };
    model.update_stop_contacts(unknowns, factor).map_err(leaves)
}

/// Tangent matrix of a model with `full` additional dense rows.
/// Joint elimination is used in models with sliders, whose band alone may be singular, and in models with contact between bodies.
pub(super) fn tangent(model: &System, full: usize) -> BorderedMatrix {
    let (unknowns, contacts) = (model.unknowns(), model.constraint_shape());
    let border = BorderShape {
        width: contacts.width + full,
        row_entries: contacts.row_entries + full * unknowns,
    };
    let tangent = BorderedMatrix::zeros(unknowns, model.half_bandwidth(), border);
    match contacts.width > 0 || model.constraint_blocks().is_some() {
        true => tangent.with_joint_elimination(full),
        false => tangent,
    }
}

fn metric(model: &System, length: f64) -> Vec<f64> {
    let is_movement = |kind: &&UnknownKind| **kind != UnknownKind::Force;
    let share = 3.0 / model.unknown_kinds().iter().filter(is_movement).count() as f64;
    let weight = |kind: &UnknownKind| match kind {
        UnknownKind::Position => share / square(length),
        UnknownKind::Rotation => share,
        UnknownKind::Force => 0.0,
    };
    model.unknown_kinds().iter().map(weight).collect()
}

fn point(model: &mut System, load_factor: f64, distance: f64, iterations: usize) -> PathPoint {
    let strain_energy = model.measure().energy.strain;
    PathPoint { load_factor, strain_energy, distance, iterations, state: model.state() }
}

pub(super) fn norm(metric: &[f64], movements: &[f64]) -> f64 {
    metric.iter().zip(movements).map(|(weight, u)| weight * u * u).sum::<f64>().sqrt()
}
