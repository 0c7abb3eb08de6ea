//! Brake or clutch: Coulomb friction between two sections, with a friction limit that is a function of time (docs/theory.md, section 9.1).
//! The friction law with its elastic deflection is that of contact points.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::contact::{NormalContact, PointFriction, SlipTrial};
use super::elongation::Elongation;
use super::internal_force::{InternalForce, SpringTrialState};
use super::spring_at_rest::static_law;
use super::spring_law::SpringLaw;
use super::{TrialState, WorkAndImpulse, collocation};
use crate::beams::{BodyPoint, ForceSummary, Movement, RotationIncrement, SpanStiffness};
use crate::elementary::square;
use crate::geometry::Vec2;
use crate::integrators::{Interval, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::{LimitSide, LoadError, Schedule};
use crate::system::SystemError;
use crate::system::bodies::Body;

/// Damping factor of the elastic deflection: critical damping [-].
const DAMPING_FACTOR: f64 = 2.0;

/// Friction of a brake.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BrakeLaw {
    /// Friction limit: largest magnitude of the friction moment [force·length].
    pub limit: Schedule,
    /// Elastic rotation of the brake at the largest friction limit so far [rad].
    pub deflection: f64,
}

impl BrakeLaw {
    /// Checks the friction limit and the deflection.
    ///
    /// # Errors
    /// Fails if the deflection is not positive and finite, or a constant friction limit is negative.
    pub(super) fn check(&self, object: &str) -> Result<(), SystemError> {
        let refused = |name, value, allowed| {
            Err(SystemError::Value { object: object.to_owned(), name, value, allowed })
        };
        match self.limit {
            Schedule::Constant(limit) if limit < 0.0 => {
                return refused("moment", limit, "zero or positive");
            }
            _ => (),
        }
        match self.deflection.is_finite() && self.deflection > 0.0 {
            true => Ok(()),
            false => refused("deflection", self.deflection, "a positive finite number [rad]"),
        }
    }
}

pub struct Brake {
    name: String,
    elongation: Elongation,
    law: BrakeLaw,
    friction: PointFriction<1>,
    /// Slope and secant of the elongation (see [`Elongation`]) in the last linearisation [-].
    slope: Vec<f64>,
    secant: Vec<f64>,
    tangent: Vec<f64>,
    /// Mean friction limit of the step [force·length].
    limit: f64,
    duration: f64,
    /// Weight of the friction moment of the present stage in the mean friction moment of the step [-].
    share: f64,
    rotations: RotationIncrement,
    dissipated: f64,
    is_released: bool,
}

impl Brake {
    pub fn new(name: String, elongation: Elongation, law: BrakeLaw) -> Self {
        let coordinates = elongation.secant.len();
        let mut friction = PointFriction::new(1.0);
        // Natural modes of the initial configuration use the friction limit at the start. A schedule without a value fails in the first step.
        let limit = law.limit.value(0.0, LimitSide::After).unwrap_or_default();
        let stiffness = limit.max(0.0) / law.deflection;
        friction.set_scales(stiffness.max(f64::MIN_POSITIVE), f64::INFINITY, DAMPING_FACTOR);
        Self {
            name,
            elongation,
            law,
            friction,
            slope: vec![0.0; coordinates],
            secant: vec![0.0; coordinates],
            tangent: vec![0.0; coordinates * coordinates],
            limit: 0.0,
            duration: f64::INFINITY,
            share: 1.0,
            rotations: RotationIncrement::TangentScaled,
            dissipated: 0.0,
            is_released: false,
        }
    }

    fn contact(&self) -> NormalContact {
        NormalContact { force: self.limit, duration: self.duration, share: self.share }
    }

    fn set_limit(&mut self, limit: f64) {
        self.limit = limit;
        let stiffness = limit / self.law.deflection;
        if stiffness > self.friction.stiffness() {
            self.dissipated += self.friction.stiffen(stiffness, DAMPING_FACTOR);
        }
    }

    fn evaluate(&mut self, at: TrialState<'_>) {
        self.elongation.evaluate(at);
        self.rotations = collocation(at.stage).rotations;
        self.share = if at.stage == Stage::End { at.weight } else { 1.0 };
        self.evaluate_slip();
    }

    fn evaluate_slip(&mut self) {
        let (slip, moved) = (self.elongation.change, self.elongation.moved());
        self.friction.evaluate(SlipTrial::of_coordinate(slip, moved));
    }

    fn acts(&self, stage: Stage) -> bool {
        !self.is_released && stage != Stage::Start && self.duration.is_finite()
    }
}

impl InternalForce for Brake {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin(&mut self, bodies: &[Body], inertia: &[f64]) {
        let of = |degree: usize| inertia.get(degree).copied().unwrap_or(f64::INFINITY);
        let mobility = |place: &BodyPoint| -> f64 {
            let degrees = &bodies[place.body].degrees_of_freedom;
            place.weights().map(|(at, share)| square(share) / of(degrees[at][2])).sum()
        };
        let mobilities = self.elongation.moving().map(|(place, _)| mobility(place));
        let inertia = 1.0 / mobilities.sum::<f64>();
        self.friction.set_scales(self.friction.stiffness(), inertia, DAMPING_FACTOR);
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        _bodies: &[Body],
        _rates: &[f64],
    ) -> Result<(), LoadError> {
        let limit = self.law.limit.mean(interval.start, interval.end)?.mean;
        if limit < 0.0 {
            let (schedule, name, allowed) = ("friction limit", "the moment", "zero or positive");
            return Err(LoadError::Value { schedule, name, value: limit, allowed });
        }
        self.set_limit(limit);
        self.duration = interval.duration();
        self.friction.begin_step();
        Ok(())
    }

    fn begin_movement(&mut self, _bodies: &[Body]) {
        self.duration = f64::INFINITY;
        self.friction.release();
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        if !self.acts(at.stage) {
            return ForceSummary::default();
        }
        self.evaluate(at);
        let strain_mismatch = self.friction.compare(self.contact());
        let [moment] = self.friction.present();
        self.elongation.scatter(&self.elongation.secant, at.weight * moment, out);
        ForceSummary { strain_mismatch, moment: moment.abs(), ..ForceSummary::default() }
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        if !self.acts(at.stage) {
            return;
        }
        self.evaluate(at);
        self.friction.linearise(self.contact());
        self.secant.copy_from_slice(&self.elongation.secant);
        self.slope.copy_from_slice(&self.elongation.slope);
        let [condensed] = self.friction.condensed(0.0);
        self.elongation.scatter(&self.secant, at.weight * condensed, out);
        let ([[stiffness]], [moment]) = (self.friction.tangent([0.0]), self.friction.present());
        let (moment, stiffness) = (at.weight * moment, at.weight * stiffness);
        self.elongation.write_tangent(moment, stiffness, &mut self.tangent);
        self.elongation.scatter_tangent(&self.tangent, unknowns, &mut tangent.rows_mut());
    }

    fn add_mismatch_forces(&self, _bodies: &[Body], weight: f64, out: &mut [f64]) {
        if self.acts(Stage::End) {
            let [missing] = self.friction.missing(0.0);
            self.elongation.scatter(&self.secant, weight * missing, out);
        }
    }

    fn correct(&mut self, _bodies: &[Body], correction: &[f64]) {
        if self.acts(Stage::End) {
            let change = self.elongation.along(&self.slope, correction);
            self.friction.correct([change], 0.0);
        }
    }

    fn exchange(&self, _bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let [moment] = self.friction.present();
        let of_terminal = |(_, coordinates): (_, Range<usize>)| -> f64 {
            self.elongation.secant[coordinates].iter().sum()
        };
        // The moments on the two sections are opposite, so the sum over the moving sections is the moment exerted by the ground.
        let on_bodies: f64 = self.elongation.moving().map(of_terminal).sum();
        let angular = -self.share * moment * on_bodies * duration;
        WorkAndImpulse::of(0.0, Vec2::zeros(), angular)
    }

    fn advance(&mut self, bodies: &[Body]) {
        self.elongation.advance(bodies, self.rotations);
        if self.acts(Stage::End) {
            self.evaluate_slip();
            self.dissipated += self.friction.advance(self.contact());
        }
    }

    fn stored(&self) -> f64 {
        self.friction.energy()
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn stretched(&self) -> Option<SpringTrialState> {
        let (elongation, force) = (self.elongation.value(), self.friction.last());
        Some(SpringTrialState { elongation, force, stiffness: self.friction.stiffness() })
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        if self.is_released {
            return;
        }
        let mut elongation = self.elongation.clone();
        elongation.evaluate_at_start(bodies);
        let (slip, damping) = (elongation.rate(rates), self.friction.sticking_damping());
        let rates = SlipTrial::of_coordinate(slip, 0.0);
        let [moment] = self.friction.at_start(&rates, self.limit, damping);
        elongation.scatter(&elongation.slope, moment, out);
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        let mut elongation = self.elongation.clone();
        elongation.evaluate_at_start(bodies);
        let damping = if self.is_released { 0.0 } else { self.friction.sticking_damping() };
        take(damping, elongation.rate_at_last_end(bodies, rates));
    }

    /// Stiffness of a brake that holds.
    fn static_stiffness(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        if !self.is_released {
            let law = SpringLaw::Linear { stiffness: self.friction.stiffness(), natural: 0.0 };
            let (degrees, rows) = static_law(&law, &self.elongation, bodies);
            take(&degrees, &rows);
        }
    }

    fn release(&mut self) {
        self.dissipated += self.stored();
        self.detach();
    }

    fn detach(&mut self) {
        self.is_released = true;
        self.friction.clear();
    }

    fn attach(&mut self) {
        self.is_released = false;
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.elongation.save(state);
        self.friction.save(state);
        state.extend([self.friction.stiffness(), self.limit, self.dissipated]);
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.elongation.restore(next);
        self.friction.restore(next);
        let stiffness = next();
        self.friction.set_stiffness(stiffness, DAMPING_FACTOR);
        (self.limit, self.dissipated) = (next(), next());
    }

    fn explain(&self) -> String {
        if self.is_released {
            return "released: no moment".to_owned();
        }
        let limit = self.law.limit.describe();
        format!("Coulomb friction with the limit {limit}; its moment is eliminated from the matrix")
    }
}
