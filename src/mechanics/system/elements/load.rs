//! Values, work and impulse of loads in a step.

use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use super::follower::Follower;
use super::load_vector::LoadVector;
use super::{
    ExternalForce, LoadAccount, ScheduleCheck, TrialState, UnsampledChange, WorkAndImpulse,
};
use crate::beams::{BodyIndex, RotationIncrement, Station};
use crate::geometry::{GaussRule, Vec2};
use crate::integrators::{Interval, Method, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::{LimitSide, Load, LoadError, LoadFrame, LoadKind, Schedule, VALUES_OF_A_MEAN};
use crate::system::bodies::Body;
use crate::system::errors::{finite, in_words, plural};
use crate::system::{SystemError, Turning};

impl ElementDef for Load {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        match &self.kind {
            LoadKind::Force { station, force, .. } => {
                setting.check_station("a load", station)?;
                finite(&self.name, "force", force.as_slice())
            }
            LoadKind::Moment { station, moment } => {
                setting.check_station("a load", station)?;
                finite(&self.name, "moment", &[*moment])
            }
            LoadKind::Line { beam, force, .. } => {
                setting.check_station("a load", &Station::on_beam(*beam, 0.0))?;
                finite(&self.name, "force", force.as_slice())
            }
        }
    }

    fn coupled(&self, _scene: &dyn SceneChecks) -> Vec<Vec<Station>> {
        match &self.kind {
            LoadKind::Force { station, frame: LoadFrame::Follower, .. }
                if station.turns() && station.beam().is_none() =>
            {
                vec![vec![*station]]
            }
            _ => Vec::new(),
        }
    }

    fn schedule(&self) -> Option<(&str, &Schedule)> {
        Some((&self.name, &self.schedule))
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        if let LoadKind::Moment { station, .. }
        | LoadKind::Force { station, frame: LoadFrame::Follower, .. } = &self.kind
            && let BodyIndex::Particle(_) = station.body
        {
            let (object, by) = (self.name.clone(), Turning::Load);
            return Err(SystemError::ParticleTurned { object, by });
        }
        let action = match &self.kind {
            LoadKind::Force { station, force, frame: LoadFrame::Dead } => {
                Action::Dead(LoadVector::at(&site.place(station)?, [force.x, force.y, 0.0]))
            }
            LoadKind::Moment { station, moment } => {
                Action::Dead(LoadVector::at(&site.place(station)?, [0.0, 0.0, *moment]))
            }
            LoadKind::Force { station, force, frame: LoadFrame::Follower } => {
                Action::Follower(vec![Follower::new(site.place(station)?, *force)])
            }
            LoadKind::Line { beam, force, frame: LoadFrame::Dead } => {
                let mut pattern = LoadVector::default();
                for (point, length) in site.body(*beam).lumped_lengths().into_iter().enumerate() {
                    pattern.push(*beam, point, [length * force.x, length * force.y, 0.0]);
                }
                Action::Dead(pattern)
            }
            LoadKind::Line { beam, force, frame: LoadFrame::Follower } => {
                Action::Follower(line_of_followers(site, *beam, *force)?)
            }
        };
        Ok(BuiltElement::Force(Box::new(AppliedLoad {
            name: self.name.clone(),
            schedule: self.schedule.clone(),
            check: ScheduleCheck::of(&self.schedule),
            longest_part: f64::INFINITY,
            action,
            factors: StageFactors::default(),
            weighted_factors: 0.0,
            current: 0.0,
            account: self.title.as_ref().map(|_| LoadAccount::default()),
            size: self.kind.magnitude(),
        })))
    }
}

/// Creates a distributed follower load as follower forces at `degree` Gauss points per span.
fn line_of_followers(
    site: &dyn AssemblyContext,
    beam: usize,
    force: Vec2,
) -> Result<Vec<Follower>, SystemError> {
    let basis = site.mesh(beam).basis();
    let rule = GaussRule::new(basis.degree()).map_err(|error| site.wrong(beam, error))?;
    let controls = site.body(beam).control_points();
    let mut followers = Vec::new();
    for span in basis.spans() {
        for (xi, weight) in rule.iter_on(span.start, span.end) {
            let length = weight * basis.evaluate_in(&span, xi).combine(1, controls).norm();
            followers.push(Follower::new(site.place_at(beam, xi)?, force * length));
        }
    }
    Ok(followers)
}

enum Action {
    Dead(LoadVector),
    Follower(Vec<Follower>),
}

struct AppliedLoad {
    name: String,
    schedule: Schedule,
    check: Option<ScheduleCheck>,
    /// Longest interval in which the schedule is sampled with one set of points [time]. In longer steps, several intervals are sampled.
    longest_part: f64,
    action: Action,
    factors: StageFactors,
    weighted_factors: f64,
    current: f64,
    account: Option<LoadAccount>,
    size: f64,
}

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

impl AppliedLoad {
    fn followers(&self) -> &[Follower] {
        match &self.action {
            Action::Dead(_) => &[],
            Action::Follower(followers) => followers,
        }
    }

    fn followers_mut(&mut self) -> &mut [Follower] {
        match &mut self.action {
            Action::Dead(_) => &mut [],
            Action::Follower(followers) => followers,
        }
    }

    fn calls(&self, methods: &[Method]) -> String {
        let functions = self.schedule.functions();
        // A controller is sampled once per step by the caller. Therefore, the load does not call the controller.
        if functions == 0 || self.schedule.is_sampled() {
            return String::new();
        }
        let of_method = |method: &Method| {
            let calls = calls_in_step(method.stages());
            format!("{} calls per step with {}", functions * calls, method.entry().name)
        };
        format!(": {}", methods.iter().map(of_method).collect::<Vec<_>>().join(", "))
    }
}

impl ExternalForce for AppliedLoad {
    fn name(&self) -> &str {
        &self.name
    }

    /// Evaluates only the stages that the step uses, because the schedule may be a script function.
    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), LoadError> {
        let Interval { start, end, .. } = interval;
        let found = self.schedule.mean_of_parts(start, end, self.longest_part)?;
        let mean = found.mean;
        self.check.iter_mut().for_each(|check| check.begin_step(interval, found));
        self.factors = StageFactors { mean, ..StageFactors::default() };
        if stages.contains(&Stage::End) {
            let before = self.schedule.value(start, LimitSide::After)?;
            let half = 0.5 * (self.schedule.value(end, LimitSide::Before)? - before);
            self.factors = StageFactors { start: mean - half, mean, end: mean + half };
        }
        (self.weighted_factors, self.current) = (0.0, 0.0);
        self.followers_mut().iter_mut().for_each(Follower::begin_step);
        Ok(())
    }

    fn sample_in_parts(&mut self, longest: f64) {
        self.longest_part = longest;
    }

    fn evaluate_after(&mut self, time: f64) -> Result<(), LoadError> {
        let end = self.schedule.value(time, LimitSide::After)?;
        self.factors = StageFactors { end, ..StageFactors::default() };
        Ok(())
    }

    fn may_jump_at(&self, time: f64) -> bool {
        self.schedule.may_jump_at(time)
    }

    fn subtract_from(&mut self, at: TrialState<'_>, out: &mut [f64]) -> (f64, f64) {
        let value = self.factors.at(at.stage);
        let factor = at.weight * value;
        match &mut self.action {
            Action::Dead(pattern) => {
                let used = if at.stage == Stage::Start {
                    &mut self.weighted_factors
                } else {
                    &mut self.current
                };
                *used = factor;
                pattern.subtract_from(at, factor, out);
                pattern.largest(value)
            }
            Action::Follower(followers) => {
                let largest = followers.iter_mut().fold(0.0, |largest: f64, each| {
                    each.subtract_from(at, factor, out);
                    largest.max(each.largest() * value.abs())
                });
                (largest, 0.0)
            }
        }
    }

    fn add_tangent(&self, at: TrialState<'_>, unknowns: usize, tangent: &mut BandedMatrix) {
        let factor = self.factors.at(at.stage);
        self.followers().iter().for_each(|each| each.add_tangent(at, factor, unknowns, tangent));
    }

    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        match &self.action {
            Action::Dead(pattern) => {
                pattern.exchange(bodies, self.weighted_factors + self.current, duration)
            }
            Action::Follower(followers) => {
                let mut sum = WorkAndImpulse::default();
                followers.iter().for_each(|each| each.add_exchange(bodies, duration, &mut sum));
                sum
            }
        }
    }

    fn account(&self) -> Option<LoadAccount> {
        self.account
    }

    fn turns(&self) -> bool {
        matches!(self.action, Action::Follower(_))
    }

    fn tracked_sections(&self) -> usize {
        self.followers().len()
    }

    fn advance(&mut self, bodies: &[Body], rotations: RotationIncrement) {
        if let Some(mut account) = self.account {
            account.work += self.exchange(bodies, 1.0).work;
            account.value = self.size * self.factors.mean;
            self.account = Some(account);
        }
        self.check.iter_mut().for_each(ScheduleCheck::advance);
        self.followers_mut().iter_mut().for_each(|each| each.advance(bodies, rotations));
    }

    fn missed_change(&self) -> Option<UnsampledChange> {
        self.check.as_ref()?.missed()
    }

    fn save(&self, state: &mut Vec<f64>) {
        state.extend(self.account.iter().flat_map(|account| [account.work, account.value]));
        self.check.iter().for_each(|check| check.save(state));
        self.followers().iter().for_each(|each| each.save(state));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        if let Some(account) = &mut self.account {
            *account = LoadAccount { work: next(), value: next() };
        }
        self.check.iter_mut().for_each(|check| check.restore(next));
        self.followers_mut().iter_mut().for_each(|each| each.restore(next));
    }

    fn explain(&self, methods: &[Method]) -> String {
        let action = match &self.action {
            Action::Dead(_) => "dead".to_owned(),
            Action::Follower(at) => {
                format!("follower load at {}, included in the tangent", plural(at.len(), "section"))
            }
        };
        let (schedule, calls) = (self.schedule.describe(), self.calls(methods));
        let cuts = in_words(&cuts(&self.schedule)).map(|at| format!("; steps end at t = {at}"));
        format!("{action}, {schedule}{calls}{}", cuts.unwrap_or_default())
    }

    fn functions(&self) -> usize {
        self.schedule.functions()
    }
}

fn cuts(schedule: &Schedule) -> Vec<f64> {
    let mut times = schedule.breaks();
    times.retain(|time| *time > 0.0);
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

fn calls_in_step(stages: &[Stage]) -> usize {
    match stages.contains(&Stage::End) {
        true => VALUES_OF_A_MEAN + stages.len(),
        false => VALUES_OF_A_MEAN * stages.len(),
    }
}
