//! Loads on the control points of the model: their values in a step, their work and their impulse.

use crate::beams::{Collocation, Movement, Rotation, RotationIncrement};
use crate::geometry::{Vec2, cross, perpendicular};
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::{LoadError, Schedule, Side};
use crate::model::bodies::Body;
use crate::model::bodies::Tracker;

/// Work [energy], impulse [force·time] and angular impulse about the origin, summed up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::model) struct Exchange {
    pub(in crate::model) work: f64,
    pub(in crate::model) impulse: Vec2,
    pub(in crate::model) angular_impulse: f64,
    /// Sums of magnitudes, which do not cancel.
    pub(in crate::model) gross_impulse: f64,
    pub(in crate::model) gross_angular_impulse: f64,
}

impl Exchange {
    /// That of a single force or moment.
    pub(in crate::model) fn of(work: f64, impulse: Vec2, angular_impulse: f64) -> Self {
        let (gross_impulse, gross_angular_impulse) = (impulse.norm(), angular_impulse.abs());
        Self { work, impulse, angular_impulse, gross_impulse, gross_angular_impulse }
    }
}

impl std::ops::AddAssign for Exchange {
    fn add_assign(&mut self, other: Self) {
        self.work += other.work;
        self.impulse += other.impulse;
        self.angular_impulse += other.angular_impulse;
        self.gross_impulse += other.gross_impulse;
        self.gross_angular_impulse += other.gross_angular_impulse;
    }
}

/// Forces on control points that do not change with the configuration.
#[derive(Debug, Clone, Default)]
pub(in crate::model) struct Pattern {
    /// (beam, control point, force and moment)
    entries: Vec<(usize, usize, Movement)>,
    /// The largest force and the largest moment on a control point.
    largest: (f64, f64),
}

impl Pattern {
    pub(in crate::model) fn push(&mut self, body: usize, point: usize, force: Movement) {
        let [x, y, moment] = force.map(f64::abs);
        self.largest = (self.largest.0.max(x).max(y), self.largest.1.max(moment));
        self.entries.push((body, point, force));
    }

    pub(in crate::model) fn subtract_from(&self, bodies: &[Body], factor: f64, out: &mut [f64]) {
        for (body, point, force) in &self.entries {
            for (&at, value) in bodies[*body].degrees_of_freedom[*point].iter().zip(force) {
                out[at] -= factor * value;
            }
        }
    }

    /// The largest force and the largest moment on a control point.
    pub(in crate::model) fn largest(&self, factor: f64) -> (f64, f64) {
        (factor.abs() * self.largest.0, factor.abs() * self.largest.1)
    }

    /// What it gives in a step of the movements that the bodies gathered last, acting at their midpoint.
    pub(in crate::model) fn exchange(
        &self,
        bodies: &[Body],
        factor: f64,
        duration: f64,
    ) -> Exchange {
        let mut sum = Exchange::default();
        for (body, point, [fx, fy, moment]) in &self.entries {
            let [x, y, omega] = bodies[*body].moved()[*point];
            let (force, moved) = (Vec2::new(*fx, *fy) * factor, Vec2::new(x, y));
            let middle = bodies[*body].dynamics.control_points()[*point] + moved * 0.5;
            sum += Exchange::of(
                force.dot(&moved) + factor * moment * omega,
                force * duration,
                (cross(middle, force) + factor * moment) * duration,
            );
        }
        sum
    }

    /// `Σ f·x`: minus the potential of these forces, were they constant.
    pub(in crate::model) fn potential_work(&self, bodies: &[Body]) -> f64 {
        let work = |(body, point, [fx, fy, _]): &(usize, usize, Movement)| {
            bodies[*body].dynamics.control_points()[*point].dot(&Vec2::new(*fx, *fy))
        };
        self.entries.iter().map(work).sum()
    }
}

/// A force that turns with a section: `f = Λτ F`.
#[derive(Debug, Clone)]
pub(in crate::model) struct Follower {
    pub(in crate::model) tracker: Tracker,
    /// In the frame of the section.
    pub(in crate::model) force: Vec2,
    carried: Vec2,
    current: Vec2,
}

impl Follower {
    pub(in crate::model) fn new(tracker: Tracker, force: Vec2) -> Self {
        Self { tracker, force, carried: Vec2::zeros(), current: Vec2::zeros() }
    }

    /// The rotation at `τ` and at the end, and `Δω`.
    fn rotations(
        &self,
        body: &Body,
        at: Collocation,
        increments: &[f64],
    ) -> (Rotation, Rotation, f64) {
        let [.., increment] = body.at(&self.tracker.place, increments);
        let end = self.tracker.rotation.turned(at.rotations, increment);
        (self.tracker.rotation.mixed(end, at.configuration), end, increment)
    }
}

/// What a load acts through.
#[derive(Debug, Clone)]
pub(in crate::model) enum Action {
    Dead(Pattern),
    Follower(Vec<Follower>),
}

/// A load of the model with its values in the current step.
#[derive(Debug, Clone)]
pub(in crate::model) struct AppliedLoad {
    pub(in crate::model) name: String,
    pub(in crate::model) schedule: Schedule,
    pub(in crate::model) action: Action,
    factors: StageFactors,
    /// The sum of weighted factors that the method uses in this step.
    carried: f64,
    current: f64,
}

/// Factors of the schedule; not a number at stages that the step did not announce.
#[derive(Debug, Clone, Copy)]
struct StageFactors {
    start: f64,
    mean: f64,
    end: f64,
}

impl Default for StageFactors {
    fn default() -> Self {
        Self { start: f64::NAN, mean: f64::NAN, end: f64::NAN }
    }
}

impl StageFactors {
    fn at(&self, stage: Stage) -> f64 {
        match stage {
            Stage::Start => self.start,
            Stage::Midpoint | Stage::DampedMidpoint(_) => self.mean,
            Stage::End => self.end,
        }
    }
}

/// Where forces of a stage are taken. At the ends of a step increments of the angle itself are interpolated.
pub(in crate::model) fn collocation(stage: Stage) -> Collocation {
    let (tau, sigma, rotations) = match stage {
        Stage::Start => (0.0, 0.0, RotationIncrement::Angle),
        Stage::Midpoint => (0.5, 0.5, RotationIncrement::TangentScaled),
        Stage::DampedMidpoint(chi) => (0.5, 0.5 + 0.5 * chi, RotationIncrement::TangentScaled),
        Stage::End => (1.0, 1.0, RotationIncrement::Angle),
    };
    Collocation { configuration: tau, stress: sigma, rotations }
}

impl AppliedLoad {
    pub(in crate::model) fn new(name: String, schedule: Schedule, action: Action) -> Self {
        Self {
            name,
            schedule,
            action,
            factors: StageFactors::default(),
            carried: 0.0,
            current: 0.0,
        }
    }

    /// Evaluates the schedule for the stages of a step, and for no other: it may be a function of a script.
    pub(in crate::model) fn begin_step(
        &mut self,
        interval: Interval,
        stages: &[Stage],
    ) -> Result<(), LoadError> {
        self.factors = StageFactors::default();
        for stage in stages {
            match stage {
                Stage::Start => {
                    self.factors.start = self.schedule.value(interval.start, Side::After)?
                }
                Stage::Midpoint | Stage::DampedMidpoint(_) => {
                    self.factors.mean = self.schedule.mean(interval.start, interval.end)?
                }
                Stage::End => self.factors.end = self.schedule.value(interval.end, Side::Before)?,
            }
        }
        (self.carried, self.current) = (0.0, 0.0);
        if let Action::Follower(followers) = &mut self.action {
            followers
                .iter_mut()
                .for_each(|each| (each.carried, each.current) = (Vec2::zeros(), Vec2::zeros()));
        }
        Ok(())
    }

    /// Gives the load the value that it has just after a time, at the end of any movement.
    pub(in crate::model) fn hold_at(&mut self, time: f64) -> Result<(), LoadError> {
        self.factors = StageFactors {
            end: self.schedule.value(time, Side::After)?,
            ..StageFactors::default()
        };
        Ok(())
    }

    pub(in crate::model) fn trackers(&self) -> impl Iterator<Item = &Tracker> {
        let followers =
            if let Action::Follower(followers) = &self.action { followers.as_slice() } else { &[] };
        followers.iter().map(|each| &each.tracker)
    }

    pub(in crate::model) fn trackers_mut(&mut self) -> impl Iterator<Item = &mut Tracker> {
        let followers = if let Action::Follower(followers) = &mut self.action {
            followers.as_mut_slice()
        } else {
            &mut []
        };
        followers.iter_mut().map(|each| &mut each.tracker)
    }

    /// Subtracts the load from the forces of a stage; returns the largest force and moment on a control point.
    pub(in crate::model) fn subtract_from(
        &mut self,
        bodies: &[Body],
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        let factor = weight * self.factors.at(stage);
        match &mut self.action {
            Action::Dead(pattern) => {
                let used =
                    if stage == Stage::Start { &mut self.carried } else { &mut self.current };
                *used = factor;
                pattern.subtract_from(bodies, factor, out);
                pattern.largest(self.factors.at(stage))
            }
            Action::Follower(followers) => {
                followers.iter_mut().fold((0.0, 0.0), |(largest, moment): (f64, f64), each| {
                    let body = &bodies[each.tracker.place.body];
                    let (rotation, ..) = each.rotations(body, collocation(stage), increments);
                    let force = rotation.to_space(each.force) * factor;
                    let used =
                        if stage == Stage::Start { &mut each.carried } else { &mut each.current };
                    *used = force;
                    for (point, share) in each.tracker.place.weights() {
                        let [x, y, _] = body.degrees_of_freedom[point];
                        out[x] -= share * force.x;
                        out[y] -= share * force.y;
                    }
                    (largest.max(each.force.amax() * self.factors.at(stage).abs()), moment)
                })
            }
        }
    }

    /// Adds the derivative of minus the load by the increments.
    pub(in crate::model) fn add_tangent(
        &self,
        bodies: &[Body],
        stage: Stage,
        increments: &[f64],
        weight: f64,
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let Action::Follower(followers) = &self.action else { return };
        let at = collocation(stage);
        for each in followers {
            let body = &bodies[each.tracker.place.body];
            let (_, end, increment) = each.rotations(body, at, increments);
            let scale =
                -weight * self.factors.at(stage) * at.configuration * at.rotations.rate(increment);
            let by_rotation = end.to_space(perpendicular(each.force)) * scale;
            for (a, share_a) in each.tracker.place.weights() {
                for (b, share_b) in each.tracker.place.weights() {
                    let column = body.degrees_of_freedom[b][2];
                    for (&row, value) in
                        body.degrees_of_freedom[a].iter().zip([by_rotation.x, by_rotation.y])
                    {
                        if row < unknowns && column < unknowns {
                            tangent.add(row, column, share_a * share_b * value);
                        }
                    }
                }
            }
        }
    }

    /// What the load gave in the step of the movements that the bodies gathered last.
    pub(in crate::model) fn exchange(&self, bodies: &[Body], duration: f64) -> Exchange {
        match &self.action {
            Action::Dead(pattern) => {
                pattern.exchange(bodies, self.carried + self.current, duration)
            }
            Action::Follower(followers) => {
                followers.iter().fold(Exchange::default(), |mut sum, each| {
                    let body = &bodies[each.tracker.place.body];
                    let force = each.carried + each.current;
                    for (point, share) in each.tracker.place.weights() {
                        let [x, y, _] = body.moved()[point];
                        let moved = Vec2::new(x, y) * share;
                        let middle = body.dynamics.control_points()[point] * share + moved * 0.5;
                        sum += Exchange::of(
                            force.dot(&moved),
                            force * (share * duration),
                            cross(middle, force) * duration,
                        );
                    }
                    sum
                })
            }
        }
    }
}
