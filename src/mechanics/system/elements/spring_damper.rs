//! Springs and dampers in a step: forces along an elongation, as independent unknowns (docs/theory.md, section 9.1).

mod targets;

use super::contact_watch::{ContactWatch, ShortBounce};
use super::damping_law::DampingLaw;
use super::elongation::Elongation;
use super::internal_force::{InternalForce, SpringTrialState};
use super::law_range::LawRange;
use super::mixed_force::{CORNER_TOLERANCE, MixedForce};
use super::rest_motion::RestMotion;
use super::spring_at_rest::static_law;
use super::spring_law::SpringLaw;
use super::{Along, Branch, OutsideLaw, TrialState, WorkAndImpulse, collocation};
use crate::beams::{ForceSummary, Movement, RotationIncrement, SpanStiffness};
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

#[derive(Debug, Clone)]
pub struct SpringDamper {
    name: String,
    elongation: Elongation,
    linearised: [Vec<f64>; 3],
    tangent: Vec<f64>,
    /// Positions of terminals on the ground [length]; `None` for terminals on bodies.
    grounds: Vec<Option<Vec2>>,
    /// Force law as a function of the change of the elongation from the initial configuration.
    law: Option<SpringLaw>,
    rises: bool,
    /// Changes of the elongation from the initial configuration at which the stiffness of the law jumps [length, rad].
    corners: Vec<f64>,
    /// Argument of the original force law in the initial configuration [length, rad]. It is used to detect elongations outside the range of the law.
    offset: f64,
    ranges: [Option<LawRange>; 2],
    law_text: Option<String>,
    damping: DampingLaw,
    released: Option<(Option<SpringLaw>, DampingLaw)>,
    spring: MixedForce,
    damper: MixedForce,
    /// Duration `Δt` of the step [time]; infinite for a static increment, in which all rates are zero.
    duration: f64,
    last: (f64, f64),
    rotations: RotationIncrement,
    force_coordinates: Vec<f64>,
    current: Vec<f64>,
    /// Shares of the start and of the present iterate in the mean force of the step [force, force·length].
    step_force: [f64; 2],
    dissipated: f64,
    contact: ContactWatch,
}

impl SpringDamper {
    pub fn new(
        name: String,
        elongation: Elongation,
        grounds: Vec<Option<Vec2>>,
        law: Option<(SpringLaw, f64)>,
        damping: DampingLaw,
    ) -> Self {
        let coordinates = elongation.secant.len();
        let words = law.as_ref().map(|(law, origin)| law.shifted(*origin).describe());
        let offset = law.as_ref().map_or(0.0, |(_, origin)| elongation.drawn() - origin);
        let of_law = law.as_ref().and_then(|(law, _)| LawRange::of_elongations(law));
        let ranges = [of_law, damping.watch()];
        let law = law
            .map(|(law, origin)| law.shifted(origin - elongation.drawn()).with_corners_at_zeros());
        let stiffness = law.as_ref().map_or(0.0, SpringLaw::largest_slope);
        let rises = law.as_ref().is_some_and(SpringLaw::rises_with_corners);
        let corners = law.as_ref().map_or_else(Vec::new, SpringLaw::sharp_corners);
        let extent = elongation.extent();
        let mut new = Self {
            name,
            elongation,
            linearised: [(); 3].map(|()| vec![0.0; coordinates]),
            tangent: vec![0.0; coordinates * coordinates],
            grounds,
            law,
            rises,
            corners,
            offset,
            ranges,
            law_text: words,
            damping,
            released: None,
            spring: MixedForce::default(),
            damper: MixedForce::default(),
            duration: f64::INFINITY,
            last: (0.0, 0.0),
            rotations: RotationIncrement::TangentScaled,
            force_coordinates: vec![0.0; coordinates],
            current: vec![0.0; coordinates],
            step_force: [0.0; 2],
            dissipated: 0.0,
            contact: ContactWatch::new(stiffness, extent),
        };
        new.spring.last = new.restoring_at_start();
        new
    }

    fn evaluate(&mut self, at: TrialState<'_>) {
        self.elongation.evaluate(at);
        if self.damping.is_active() {
            let share = (at.stage == Stage::End).then_some(at.weight);
            self.elongation.balance(share);
        }
    }

    fn weighted(&self, at: TrialState<'_>, spring: f64, damper: f64) -> f64 {
        match at.stage {
            Stage::Start => at.weight * spring,
            _ => at.weight * spring + damper,
        }
    }

    fn record_force(&mut self, stage: Stage, force: f64, damper: f64) {
        let Self {
            elongation: Elongation { secant, lag, .. },
            force_coordinates: carried,
            current,
            ..
        } = self;
        let (noted, share) = if stage == Stage::Start { (carried, 0) } else { (current, 1) };
        self.step_force[share] = force;
        let directions = secant.iter().zip(lag);
        noted
            .iter_mut()
            .zip(directions)
            .for_each(|(noted, (g, l))| *noted = g * force + *l * damper);
    }

    fn mean_force(&self) -> f64 {
        self.step_force[0] + self.step_force[1]
    }

    fn summary(&self, mismatch: f64) -> ForceSummary {
        let force = self.spring.force.abs() + self.damper.force.abs();
        let (force, moment) = if self.elongation.is_angle() { (0.0, force) } else { (force, 0.0) };
        ForceSummary { strain_mismatch: mismatch, force, moment, rotation: 0.0 }
    }
}

impl InternalForce for SpringDamper {
    fn name(&self) -> &str {
        &self.name
    }

    fn set_rest_at(&mut self, time: f64) -> Result<(), LoadError> {
        if self.elongation.rest.is_some() {
            self.elongation.set_rest_at(time)?;
            self.spring.last = self.restoring_at_start();
        }
        Ok(())
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        _bodies: &[Body],
        _rates: &[f64],
    ) -> Result<(), LoadError> {
        match (&mut self.elongation.rest, &self.released) {
            (Some(rest), None) => rest.begin_step(interval)?,
            (Some(rest), Some(_)) => rest.begin_movement(),
            (None, _) => (),
        }
        self.step_force = [0.0; 2];
        self.duration = interval.duration();
        self.spring.begin_step();
        self.damper.begin_step();
        [&mut self.force_coordinates, &mut self.current].into_iter().for_each(|all| all.fill(0.0));
        Ok(())
    }

    fn begin_movement(&mut self, _bodies: &[Body]) {
        self.duration = f64::INFINITY;
        self.elongation.rest.iter_mut().for_each(|rest| rest.begin_movement());
        self.spring.force = self.spring.last;
        self.damper.force = 0.0;
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        self.evaluate(at);
        self.rotations = collocation(at.stage).rotations;
        if at.stage == Stage::Start {
            let force = at.weight * self.restoring(at.stage).force;
            self.record_force(at.stage, force, 0.0);
            self.elongation.scatter(&self.elongation.secant, force, out);
            return self.summary(0.0);
        }
        let extent = self.elongation.extent();
        let (restoring, damping) = (self.restoring(at.stage), self.damping(at));
        let of_spring = if self.rises { CORNER_TOLERANCE * extent } else { extent };
        let mut missed = self.spring.compare(restoring, of_spring);
        let has_mean = matches!(at.stage, Stage::Midpoint | Stage::DampedMidpoint(_));
        let missing = if has_mean { self.spring.missing_change() } else { 0.0 };
        if self.elongation.absorb_rounding(missing) && has_mean && self.rises {
            missed = 0.0;
        }
        let mismatch = larger(missed, self.damper.compare(damping, extent));
        let force = self.weighted(at, self.spring.force, self.damper.force);
        self.record_force(at.stage, force, self.damper.force);
        self.elongation.scatter(&self.elongation.secant, force, out);
        if self.damping.is_active() {
            self.elongation.scatter(&self.elongation.lag, self.damper.force, out);
        }
        self.summary(mismatch)
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        self.evaluate(at);
        self.elongation.find_bend(collocation(at.stage).rotations);
        let (restoring, damping) = (self.spring_target(at.stage), self.damper_target(at));
        self.spring.linearise(restoring);
        self.damper.linearise(damping);
        let Self { elongation, linearised: [secant, slope, lag], .. } = self;
        secant.copy_from_slice(&elongation.secant);
        slope.copy_from_slice(&elongation.slope);
        lag.copy_from_slice(&elongation.lag);
        let force = self.weighted(at, restoring.force, damping.force);
        self.elongation.scatter(&self.elongation.secant, force, out);
        if self.damping.is_active() {
            self.elongation.scatter(&self.elongation.lag, damping.force, out);
        }
        let stiffness = self.weighted(at, restoring.stiffness, damping.stiffness);
        let force = self.weighted(at, self.spring.force, self.damper.force);
        self.elongation.write_tangent(force, stiffness, &mut self.tangent);
        if self.damping.is_active() {
            let Elongation { slope, lag, lag_slope: lag_bend, .. } = &self.elongation;
            let rows = self.tangent.chunks_exact_mut(slope.len());
            let bends = lag_bend.chunks_exact(slope.len());
            for ((row, lag), bend) in rows.zip(lag).zip(bends) {
                for ((entry, slope), bend) in row.iter_mut().zip(slope).zip(bend) {
                    *entry += damping.stiffness * lag * slope + self.damper.force * bend;
                }
            }
        }
        self.elongation.scatter_tangent(&self.tangent, unknowns, &mut tangent.rows_mut());
    }

    fn add_mismatch_forces(&self, _bodies: &[Body], weight: f64, out: &mut [f64]) {
        let force = weight * self.spring.mismatch + self.damper.mismatch;
        let [secant, _, lag] = &self.linearised;
        self.elongation.scatter(secant, force, out);
        if self.damping.is_active() {
            self.elongation.scatter(lag, self.damper.mismatch, out);
        }
    }

    fn correct(&mut self, _bodies: &[Body], correction: &[f64]) {
        let change = self.elongation.along(&self.linearised[1], correction);
        self.spring.correct(change);
        self.damper.correct(change);
    }

    fn exchange(&self, _bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let given = |at: usize| (self.force_coordinates[at] + self.current[at]) * duration;
        let mut sum = WorkAndImpulse::default();
        if let Some(rest) = &self.elongation.rest {
            sum += WorkAndImpulse::of(rest.work_in_step(self.mean_force()), Vec2::zeros(), 0.0);
        }
        for (terminal, ground) in self.grounds.iter().enumerate() {
            let Some(ground) = ground else { continue };
            sum += match self.elongation.is_angle() {
                true => WorkAndImpulse::of(0.0, Vec2::zeros(), given(terminal)),
                false => {
                    let impulse = Vec2::new(given(2 * terminal), given(2 * terminal + 1));
                    WorkAndImpulse::of(0.0, impulse, cross(*ground, impulse))
                }
            };
        }
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        self.dissipated += self.damper.force * self.elongation.change;
        let (was_slack, before) = (self.restoring_at_start() == 0.0, self.last.1);
        self.last = match self.duration.is_finite() {
            true => (self.duration, self.elongation.change / self.duration),
            false => (0.0, 0.0),
        };
        self.elongation.advance(bodies, self.rotations);
        let force = self.mean_force();
        self.elongation.rest.iter_mut().for_each(|rest| rest.advance(force));
        if self.released.is_none() {
            let [of_law, of_damping] = &mut self.ranges;
            let elongation = self.offset + self.elongation.grown().value;
            of_law.iter_mut().for_each(|range| range.add(elongation));
            of_damping.iter_mut().for_each(|range| range.add(self.last.1));
        }
        if self.duration.is_finite() && self.may_be_slack() {
            let is_slack = self.restoring_at_start() == 0.0;
            self.contact.add(
                [was_slack, is_slack],
                [before, self.last.1],
                (self.spring.force, self.duration),
            );
        }
        self.spring.last = self.spring.force;
        self.damper.last = self.damper.force;
    }

    fn each_outside_law(&self, take: &mut dyn FnMut(OutsideLaw)) {
        self.ranges.iter().flatten().filter_map(LawRange::outside).for_each(take);
    }

    fn stored(&self) -> f64 {
        self.law.as_ref().map_or(0.0, |law| law.energy(self.elongation.grown()))
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn external_work(&self) -> Option<f64> {
        Some(self.rest_motion()?.work())
    }

    fn rest_motion(&self) -> Option<&RestMotion> {
        self.elongation.rest.as_deref()
    }

    fn may_jump_at(&self, time: f64) -> bool {
        let rest = self.elongation.rest.as_ref().filter(|_| self.damping.is_active());
        rest.is_some_and(|rest| rest.may_jump_at(time))
    }

    fn stretched(&self) -> Option<SpringTrialState> {
        let force = self.spring.last + self.damper.last;
        let stiffness = self.law.as_ref().map_or(0.0, |law| law.slope(self.elongation.grown()));
        Some(SpringTrialState { elongation: self.elongation.value(), force, stiffness })
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        let mut elongation = self.elongation.clone();
        elongation.evaluate_at_start(bodies);
        let rate = elongation.rate(rates);
        let force = self.restoring_at_start() + self.damping.force(rate);
        elongation.scatter(&elongation.slope, force, out);
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        if self.damping.is_active() {
            let mut elongation = self.elongation.clone();
            elongation.evaluate_at_start(bodies);
            take(self.damping.slope_at_rest(), elongation.rate_at_last_end(bodies, rates));
        }
    }

    fn static_stiffness(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        if let Some(law) = &self.law {
            let (degrees, rows) = static_law(law, &self.elongation, bodies);
            take(&degrees, &rows);
        }
    }

    fn release(&mut self) {
        self.dissipated += self.stored();
        self.detach();
    }

    fn detach(&mut self) {
        if self.released.is_none() {
            self.released = Some((self.law.take(), std::mem::take(&mut self.damping)));
            (self.spring, self.damper) = (MixedForce::default(), MixedForce::default());
        }
    }

    fn attach(&mut self) {
        if let Some(own) = self.released.take() {
            (self.law, self.damping) = own;
        }
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.elongation.save(state);
        state.extend([self.spring.last, self.damper.last, self.last.0, self.last.1]);
        state.push(self.dissipated);
        if self.may_be_slack() {
            self.contact.save(state);
        }
        self.ranges.iter().flatten().for_each(|range| range.save(state));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.elongation.restore(next);
        (self.spring.last, self.damper.last) = (next(), next());
        self.last = (next(), next());
        self.dissipated = next();
        if self.may_be_slack() {
            self.contact.restore(next);
        }
        self.ranges.iter_mut().flatten().for_each(|range| range.restore(next));
    }

    fn branch(&self, bodies: &[Body], rates: &[f64]) -> Option<Branch> {
        if self.corners.is_empty() || self.law.is_none() {
            return None;
        }
        let Self { elongation, corners, .. } = self;
        let along = if elongation.is_angle() { Along::Angle } else { Along::Length };
        let index = corners.partition_point(|at| elongation.grown().difference(*at) >= 0.0);
        Some(Branch { index, rate: elongation.rate_at_last_end(bodies, rates), along })
    }

    fn short_bounce(&self) -> Option<ShortBounce> {
        self.contact.short_bounce()
    }

    fn explain(&self) -> String {
        if self.released.is_some() {
            return "released: no force".to_owned();
        }
        let law = self.law_text.clone();
        let rest = self.elongation.rest.as_ref();
        let name = if self.elongation.is_angle() { "rest angle" } else { "rest length" };
        let rest = rest.map(|rest| format!("{name} {}", rest.describe()));
        let parts: Vec<String> =
            law.into_iter().chain(rest).chain(self.damping.describe()).collect();
        format!("{}; its force is eliminated from the matrix", parts.join(", "))
    }
}
