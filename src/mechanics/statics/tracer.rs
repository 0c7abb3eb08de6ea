//! Finding one equilibrium after another.

use super::balance::{AlongPath, Balance, UnderLoad};
use super::error::Miss;
use super::path::vertex;
use super::{ArcLength, Control, Loading, Path, PathPoint, StaticsError};
use crate::elementary::square;
use crate::integrators::Mechanism;
use crate::linalg::BorderShape;
use crate::model::{Model, Scene, UnknownKind};
use crate::newton::{Newton, NewtonError};

/// A step that finds no equilibrium is halved so often.
const MOST_HALVINGS: u32 = 8;

/// An equilibrium so many times farther than a step along the path was meant to go is on another part of it.
const FAR: f64 = 2.0;

/// One so many times farther than the last step, load for load, is another one: the structure has snapped through.
const FAR_UNDER_LOAD: f64 = 4.0;

/// No movement is far that is smaller than this part of the scene.
const NEARBY: f64 = 1e-3;

/// Steps along the path grow and shrink so that each takes about so many iterations.
const WANTED_ITERATIONS: f64 = 4.0;

/// Follows equilibria from the unloaded scene on.
pub(super) struct Tracer<'s> {
    scene: &'s Scene,
    length: f64,
    /// What movements are squared with: relative to a length, as angles, and as means over the control points.
    metric: Vec<f64>,
    loading: Loading,
    pub(super) model: Model,
    pub(super) path: Path,
    newton: Newton,
    movements: Vec<f64>,
    residual: Vec<f64>,
    heading: Heading,
}

/// How a path goes on.
struct Heading {
    /// The last movement.
    movements: Vec<f64>,
    /// In how many ways a movement from here would release energy.
    falls: usize,
}

impl Heading {
    /// Whether another one goes on like this. If not, it may have gone over to another branch, as beside the load at which a straight
    /// column buckles, and smaller steps tell.
    fn is_kept_by(&self, next: &Self, metric: &[f64]) -> bool {
        let ways = metric.iter().zip(&self.movements).zip(&next.movements);
        let along: f64 = ways.map(|((weight, before), now)| weight * before * now).sum();
        along >= 0.0 && next.falls == self.falls
    }
}

impl<'s> Tracer<'s> {
    pub(super) fn new(scene: &'s Scene, mut model: Model, loading: Loading) -> Self {
        let unknowns = model.unknowns();
        let none = BorderShape::default();
        let mut path = Path::default();
        path.push(point(&mut model, 0.0, 0.0, 0));
        // A scene of particles alone has no moments.
        let length = scene.longest_beam().unwrap_or(1.0);
        Self {
            scene,
            length,
            metric: metric(&model, length),
            loading,
            newton: Newton::new(unknowns, model.half_bandwidth(), none, loading.tolerance),
            movements: vec![0.0; unknowns],
            residual: vec![0.0; model.degrees_of_freedom()],
            heading: Heading { movements: vec![0.0; unknowns], falls: 0 },
            model,
            path,
        }
    }

    /// Puts the loads on the scene in equal steps.
    pub(super) fn load_up(
        &mut self,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let Loading { factor, steps, .. } = self.loading;
        for step in 1..=steps {
            // The last one is the whole to the last digit.
            self.reach(factor * (step as f64 / steps as f64), MOST_HALVINGS, goes_on)?;
        }
        Ok(())
    }

    /// Follows the path until the load factor is reached, or the path has as many points as it may have.
    pub(super) fn follow(
        &mut self,
        arc: ArcLength,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let Loading { factor: goal, steps, .. } = self.loading;
        self.reach(goal / steps as f64, MOST_HALVINGS, goes_on)?;
        let mut trial = Trial::new(&self.model, &self.loading);
        let mut distance = norm(&self.metric, &self.movements).min(arc.longest);
        if distance == 0.0 {
            // Loads on supports alone move nothing: there is no path to follow.
            return self.reach(goal, MOST_HALVINGS, goes_on);
        }
        while self.path.load_factor() != goal && self.path.points().len() < arc.points {
            trial.look_along(&self.metric, &self.movements);
            distance = self.advance(&mut trial, distance, goes_on)?.min(arc.longest);
        }
        Ok(())
    }

    /// Takes a step of some distance along the path, or of a part of it; returns the distance for the next.
    fn advance(
        &mut self,
        trial: &mut Trial,
        mut distance: f64,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<f64, StaticsError> {
        let (from, goal) = (self.path.load_factor(), self.loading.factor);
        let mut miss = Miss::Far;
        for _ in 0..=MOST_HALVINGS {
            self.ask(goes_on)?;
            match trial.find(&mut self.model, self.length, from, distance) {
                Ok(_) if norm(&self.metric, trial.movements()) > FAR * distance => miss = Miss::Far,
                Ok(_) if (from < goal) != (trial.factor() < goal) => {
                    return self.reach(goal, MOST_HALVINGS, goes_on).map(|()| distance);
                }
                Ok(iterations) => {
                    if let Some(way) = self.way_beyond(goal, trial.factor(), distance)
                        && let Ok(iterations) = self.find(goal)
                        && norm(&self.metric, &self.movements) <= way
                    {
                        self.accept(goal, iterations);
                        return Ok(distance);
                    }
                    self.movements.copy_from_slice(trial.movements());
                    self.accept(trial.factor(), iterations);
                    let growth = (WANTED_ITERATIONS / iterations as f64).sqrt();
                    return Ok(distance * growth.clamp(0.5, 1.5));
                }
                Err(error) => miss = Miss::Newton(error),
            }
            distance *= 0.5;
        }
        Err(self.lost(miss))
    }

    /// How far it is to where the load factor turns, if it passes the goal before that and again after it: the first time counts.
    fn way_beyond(&self, goal: f64, factor: f64, distance: f64) -> Option<f64> {
        let [.., before, last] = self.path.points() else { return None };
        let factors = [before.load_factor, last.load_factor, factor];
        let vertex = vertex(factors, [last.distance, distance])?;
        let is_beyond = (vertex.load_factor < goal) != (last.load_factor < goal);
        is_beyond.then_some(vertex.way - last.distance)
    }

    /// Goes to a load factor, in halves where the whole step finds nothing, or something that does not continue the path.
    fn reach(
        &mut self,
        factor: f64,
        halvings: u32,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        self.ask(goes_on)?;
        let from = self.path.load_factor();
        match self.find(factor) {
            Ok(iterations) => {
                self.accept(factor, iterations);
                if self.goes_on_as_before(halvings) {
                    return Ok(());
                }
                self.take_back();
            }
            Err(error) if halvings == 0 => return Err(self.lost(error)),
            Err(_) => (),
        }
        self.reach(0.5 * (from + factor), halvings - 1, goes_on)?;
        self.reach(factor, halvings - 1, goes_on)
    }

    /// Whether the last point continues the path, or no halving is left to tell. Along the path it may turn and become unstable as it
    /// likes.
    fn goes_on_as_before(&mut self, halvings: u32) -> bool {
        if self.loading.control != Control::Load {
            return true;
        }
        // The stiffness alone does not tell what loads do that turn with a beam.
        let falls = if self.model.follower().is_some() { 0 } else { self.model.falls() };
        let heading = Heading { movements: self.movements.clone(), falls };
        let goes_on = halvings == 0 || self.heading.is_kept_by(&heading, &self.metric);
        if goes_on {
            self.heading = heading;
        }
        goes_on
    }

    /// The iterations that led to an equilibrium near the last one.
    fn find(&mut self, factor: f64) -> Result<usize, Miss> {
        self.movements.fill(0.0);
        self.model.begin_movement();
        let balance = Balance { model: &mut self.model, length: self.length };
        let mut equations = UnderLoad { balance, factor };
        let report = self.newton.solve(&mut equations, &mut self.movements, &mut self.residual)?;
        let moved = norm(&self.metric, &self.movements);
        if moved <= self.farthest(factor) { Ok(report.iterations) } else { Err(Miss::Far) }
    }

    /// How far an equilibrium may be: by what the last step has moved for its load, or by a long step along the path.
    fn farthest(&self, factor: f64) -> f64 {
        let [.., before, last] = self.path.points() else { return f64::INFINITY };
        match self.loading.control {
            Control::ArcLength(arc) => FAR * arc.longest,
            Control::Load => {
                let share = (factor - last.load_factor) / (last.load_factor - before.load_factor);
                FAR_UNDER_LOAD * (last.distance * share.abs()).max(NEARBY)
            }
        }
    }

    fn accept(&mut self, factor: f64, iterations: usize) {
        self.model.move_by(&self.movements, factor);
        let distance = norm(&self.metric, &self.movements);
        self.path.push(point(&mut self.model, factor, distance, iterations));
    }

    /// Goes back to the point of the path before the last one.
    fn take_back(&mut self) {
        self.path.pop();
        if let Some(last) = self.path.points().last() {
            self.model.restore(&last.state);
        }
    }

    fn ask(&self, goes_on: &mut dyn FnMut(f64) -> bool) -> Result<(), StaticsError> {
        let reached = self.path.load_factor();
        if goes_on(reached) { Ok(()) } else { Err(StaticsError::Interrupted { reached }) }
    }

    fn lost(&self, reason: Miss) -> StaticsError {
        let (scene, reached) = (self.scene.name.clone(), self.path.load_factor());
        StaticsError::Lost { scene, reached, reason: Box::new(reason) }
    }
}

fn metric(model: &Model, length: f64) -> Vec<f64> {
    let is_movement = |kind: &&UnknownKind| **kind != UnknownKind::Force;
    let share = 3.0 / model.unknown_kinds().iter().filter(is_movement).count() as f64;
    let weight = |kind: &UnknownKind| match kind {
        UnknownKind::Position => share / square(length),
        UnknownKind::Rotation => share,
        UnknownKind::Force => 0.0,
    };
    model.unknown_kinds().iter().map(weight).collect()
}

/// A step along the path, with its work space.
struct Trial {
    newton: Newton,
    normal: Vec<f64>,
    /// The movements, then the load factor.
    unknowns: Vec<f64>,
    residual: Vec<f64>,
    forces: Vec<f64>,
}

impl Trial {
    fn new(model: &Model, loading: &Loading) -> Self {
        let unknowns = model.unknowns();
        let border = BorderShape { width: 1, row_entries: unknowns };
        Self {
            newton: Newton::new(unknowns, model.half_bandwidth(), border, loading.tolerance),
            normal: vec![0.0; unknowns],
            unknowns: vec![0.0; unknowns + 1],
            residual: vec![0.0; unknowns + 1],
            forces: vec![0.0; model.degrees_of_freedom()],
        }
    }

    /// Goes on in the direction of the last movement.
    fn look_along(&mut self, metric: &[f64], last: &[f64]) {
        let inverse = 1.0 / norm(metric, last);
        for ((normal, weight), u) in self.normal.iter_mut().zip(metric).zip(last) {
            *normal = weight * u * inverse;
        }
    }

    /// From a standstill: the first iteration then goes along the tangent of the path.
    fn find(
        &mut self,
        model: &mut Model,
        length: f64,
        from: f64,
        distance: f64,
    ) -> Result<usize, NewtonError> {
        self.unknowns.fill(0.0);
        if let Some(factor) = self.unknowns.last_mut() {
            *factor = from;
        }
        model.begin_movement();
        let balance = Balance { model, length };
        let mut equations =
            AlongPath { balance, normal: &self.normal, distance, forces: &mut self.forces };
        let report = self.newton.solve(&mut equations, &mut self.unknowns, &mut self.residual)?;
        Ok(report.iterations)
    }

    fn movements(&self) -> &[f64] {
        &self.unknowns[..self.normal.len()]
    }

    fn factor(&self) -> f64 {
        self.unknowns[self.normal.len()]
    }
}

fn point(model: &mut Model, load_factor: f64, distance: f64, iterations: usize) -> PathPoint {
    let strain_energy = model.measure().energy.strain;
    PathPoint { load_factor, strain_energy, distance, iterations, state: model.state() }
}

fn norm(metric: &[f64], movements: &[f64]) -> f64 {
    metric.iter().zip(movements).map(|(weight, u)| weight * u * u).sum::<f64>().sqrt()
}
