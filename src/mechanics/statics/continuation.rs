//! Finding one equilibrium after another.

use super::balance::{Balance, UnderLoad};
use super::error::StepFailure;
use super::loading::LEAST_PATH;
use super::path::vertex;
use super::path_step::PathStep;
use super::{ArcLength, Control, EquilibriumPath, Loading, PathPoint, StaticsError};
use crate::elementary::square;
use crate::integrators::{Constraints, Mechanism};
use crate::linalg::{BorderShape, BorderedMatrix};
use crate::newton::Newton;
use crate::system::{MasterEnd, Scene, System, UnknownKind};

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

/// What holds a scene as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum InitialSupport {
    /// Its supports and its stiffness, as far as that is known.
    Itself,
    /// Nothing but its loads holds so many movements.
    Loads(usize),
}

/// Follows equilibria from the unloaded scene on.
pub(super) struct Continuation<'s> {
    pub(super) scene: &'s Scene,
    length: f64,
    /// What movements are squared with: relative to a length, as angles, and as means over the control points.
    metric: Vec<f64>,
    loading: Loading,
    pub(super) model: System,
    pub(super) path: EquilibriumPath,
    newton: Newton,
    /// Movements, and behind them the unknowns of contacts.
    pub(super) unknowns: Vec<f64>,
    residual: Vec<f64>,
    heading: PathDirection,
}

/// How a path goes on.
struct PathDirection {
    /// The last movement.
    movements: Vec<f64>,
    /// In how many ways a movement from here would release energy.
    falls: usize,
}

impl PathDirection {
    /// Whether another one goes on like this. If not, it may have gone over to another branch, as beside the load at which a straight
    /// column buckles, and smaller steps tell.
    fn is_kept_by(&self, next: &Self, metric: &[f64]) -> bool {
        let ways = metric.iter().zip(&self.movements).zip(&next.movements);
        let along: f64 = ways.map(|((weight, before), now)| weight * before * now).sum();
        along >= 0.0 && next.falls == self.falls
    }
}

impl<'s> Continuation<'s> {
    pub(super) fn new(scene: &'s Scene, mut model: System, loading: Loading) -> Self {
        let all = model.unknowns() + model.constraint_shape().width;
        let mut path = EquilibriumPath::default();
        path.push(point(&mut model, 0.0, 0.0, 0));
        // A scene of particles alone has no moments.
        let length = scene.longest_beam().unwrap_or(1.0);
        Self {
            scene,
            length,
            metric: metric(&model, length),
            loading,
            newton: Newton::of(tangent(&model, 0), loading.tolerance),
            unknowns: vec![0.0; all],
            residual: vec![0.0; model.degrees_of_freedom()],
            heading: PathDirection { movements: vec![0.0; all], falls: 0 },
            model,
            path,
        }
    }

    /// Puts the loads on the scene in equal steps.
    pub(super) fn load_up(
        &mut self,
        hold: InitialSupport,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let Loading { factor, steps, .. } = self.loading;
        self.begin(factor * (1.0 / steps as f64), hold, goes_on)?;
        for step in 2..=steps {
            // The last one is the whole to the last digit.
            self.reach(factor * (step as f64 / steps as f64), MOST_HALVINGS, goes_on)?;
        }
        Ok(())
    }

    /// Goes to the first load factor.
    fn begin(
        &mut self,
        factor: f64,
        hold: InitialSupport,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        match hold {
            InitialSupport::Itself => self.reach(factor, MOST_HALVINGS, goes_on),
            InitialSupport::Loads(movements) => {
                self.settle(factor, movements, goes_on)?;
                self.heading.falls = self.falls();
                Ok(())
            }
        }
    }

    /// Follows the path until the load factor is reached, or the path has as many points as it may have.
    pub(super) fn follow(
        &mut self,
        arc: ArcLength,
        hold: InitialSupport,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let Loading { factor: goal, steps, .. } = self.loading;
        self.begin(goal / steps as f64, hold, goes_on)?;
        if hold != InitialSupport::Itself && steps > 1 {
            // Where loads alone hold the scene, the path goes from there.
            self.reach(goal * (2.0 / steps as f64), MOST_HALVINGS, goes_on)?;
        }
        let mut trial = PathStep::new(&self.model, &self.loading);
        let mut distance = norm(&self.metric, &self.unknowns).min(arc.longest);
        if distance == 0.0 {
            // Loads on supports alone move nothing: there is no path to follow.
            return self.reach(goal, MOST_HALVINGS, goes_on);
        }
        while self.path.load_factor() != goal && self.path.points().len() < arc.points {
            trial.look_along(&self.metric, &self.unknowns);
            distance = self.advance(&mut trial, distance, goes_on)?.min(arc.longest);
        }
        Ok(())
    }

    /// Takes a step of some distance along the path, or of a part of it; returns the distance for the next.
    fn advance(
        &mut self,
        trial: &mut PathStep,
        mut distance: f64,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<f64, StaticsError> {
        let (from, goal) = (self.path.load_factor(), self.loading.factor);
        let mut miss = StepFailure::Far;
        for _ in 0..=MOST_HALVINGS {
            self.ask(goes_on)?;
            match trial.find(&mut self.model, self.length, from, distance, self.scene) {
                Ok(_) if norm(&self.metric, trial.movements()) > FAR * distance => {
                    miss = StepFailure::Far
                }
                Ok(_) if (from < goal) != (trial.factor() < goal) => {
                    return self.reach(goal, MOST_HALVINGS, goes_on).map(|()| distance);
                }
                Ok(iterations) => {
                    if let Some(way) = self.way_beyond(goal, trial.factor(), distance)
                        && let Ok(iterations) = self.find(goal)
                        && norm(&self.metric, &self.unknowns) <= way
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
            self.go_back();
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
        let falls = self.falls();
        let heading = PathDirection { movements: self.unknowns.clone(), falls };
        let goes_on = halvings == 0 || self.heading.is_kept_by(&heading, &self.metric);
        if goes_on {
            self.heading = heading;
        }
        goes_on
    }

    /// In how many ways a movement from here would release energy, as far as stiffness tells: not what loads do that turn with a beam.
    pub(super) fn falls(&self) -> usize {
        self.falls_against(0.0)
    }

    /// That against what resists every movement by such a multiple of its inertia [1/time²].
    pub(super) fn falls_against(&self, rate: f64) -> usize {
        if self.model.follower().is_some() { 0 } else { self.model.falls_against(rate) }
    }

    /// The iterations that led to an equilibrium near the last one.
    fn find(&mut self, factor: f64) -> Result<usize, StepFailure> {
        let found = match self.balance_from(factor, 0.0) {
            Ok(_) if self.moved() > self.farthest(factor) => Err(StepFailure::Far),
            found => found,
        };
        if found.is_err() {
            self.go_back();
        }
        found
    }

    /// How far the unknowns lead: root mean square, relative to the longest beam.
    pub(super) fn moved(&self) -> f64 {
        norm(&self.metric, &self.unknowns)
    }

    /// The iterations that led from here to where a part of the loads is balanced, by masses in something viscous too if `rate` is positive [1/time²].
    ///
    /// Sliders may come to lean on stops, or leave them; each time all begins anew.
    pub(super) fn balance_from(&mut self, factor: f64, rate: f64) -> Result<usize, StepFailure> {
        let mut iterations = 0;
        for _ in 0..=self.scene.most_settlings() {
            self.model.stay(&mut self.unknowns);
            self.model.begin_movement();
            let balance = Balance { model: &mut self.model, length: self.length };
            let mut equations = UnderLoad { balance, factor, rate };
            let report =
                self.newton.solve(&mut equations, &mut self.unknowns, &mut self.residual)?;
            iterations += report.iterations;
            if !settle_on_stops(&mut self.model, self.scene, &self.unknowns, factor)? {
                return Ok(iterations);
            }
        }
        Err(StepFailure::Far)
    }

    /// Takes back what a search has made of the model that found nothing.
    pub(super) fn go_back(&mut self) {
        if let Some(last) = self.path.points().last() {
            self.model.restore(&last.state);
        }
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
        self.model.move_by(&self.unknowns, factor);
        self.arrive(factor, self.moved(), iterations);
    }

    /// Adds the place of the model to the path, so far from the last one.
    pub(super) fn arrive(&mut self, factor: f64, distance: f64, iterations: usize) {
        self.path.push(point(&mut self.model, factor, distance, iterations));
    }

    /// Goes back to the point of the path before the last one.
    fn take_back(&mut self) {
        self.path.pop();
        self.go_back();
    }

    pub(super) fn ask(&self, goes_on: &mut dyn FnMut(f64) -> bool) -> Result<(), StaticsError> {
        let reached = self.path.load_factor();
        if goes_on(reached) { Ok(()) } else { Err(StaticsError::Interrupted { reached }) }
    }

    pub(super) fn lost(&self, reason: StepFailure) -> StaticsError {
        let (scene, reached) = (self.scene.name.clone(), self.path.load_factor());
        let (points, reason) = (self.path.points().len(), Box::new(reason));
        match self.loading.control {
            Control::ArcLength(_) if points >= LEAST_PATH => {
                StaticsError::PathLost { scene, points, reached, reason }
            }
            Control::ArcLength(_) | Control::Load => StaticsError::Lost { scene, reached, reason },
        }
    }
}

/// Lets sliders lean on stops that they would pass, and leave those that would pull; whether any did.
pub(super) fn settle_on_stops(
    model: &mut System,
    scene: &Scene,
    unknowns: &[f64],
    factor: f64,
) -> Result<bool, StepFailure> {
    let leaves = |(slider, end): (usize, MasterEnd)| StepFailure::Leaves {
        slider: scene.sliders[slider].name.clone(),
        end: end.name(),
    };
    model.settle_on_stops(unknowns, factor).map_err(leaves)
}

/// The room for the tangent of a model with so many full rows and columns behind; where something slides, contacts may be all that holds.
pub(super) fn tangent(model: &System, full: usize) -> BorderedMatrix {
    let (unknowns, contacts) = (model.unknowns(), model.constraint_shape());
    let border = BorderShape {
        width: contacts.width + full,
        row_entries: contacts.row_entries + full * unknowns,
    };
    let tangent = BorderedMatrix::zeros(unknowns, model.half_bandwidth(), border);
    if contacts.width == 0 { tangent } else { tangent.together(full) }
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
