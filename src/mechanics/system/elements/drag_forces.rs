//! Drag in a step (docs/theory.md, section 9.3).
//!
//! Without wind, the dissipated energy is minus the work of the drag force on the body.
//! With wind, the dissipated power is computed from the force alone by means of the drag law, so that rounding cannot change its sign.
//! The work of the wind is the work of the drag force plus the dissipated energy, so that the energy balance is exact.

use super::drag_law::DragLaw;
use super::drag_point::{DragPoint, Medium};
use super::internal_force::InternalForce;
use super::rate_history::RateHistory;
use super::{TrialState, WorkAndImpulse};
use crate::beams::{ForceSummary, Movement, RateCollocation};
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

pub struct DragForces {
    name: String,
    medium: Medium,
    points: Vec<DragPoint>,
    rate_history: RateHistory,
    dissipated: f64,
    wind_work: f64,
}

impl DragForces {
    pub fn new(name: String, law: DragLaw, points: Vec<DragPoint>, wind: Vec2) -> Self {
        Self {
            name,
            medium: Medium { law, wind },
            points,
            rate_history: RateHistory::default(),
            dissipated: 0.0,
            wind_work: 0.0,
        }
    }

    fn rates(&self, at: TrialState<'_>) -> Option<RateCollocation> {
        let is_timed = self.rate_history.duration().is_finite();
        self.rate_history.at(at.stage, at.weight).filter(|_| is_timed)
    }

    fn turnover(&self, point: &DragPoint, body: &Body) -> [f64; 2] {
        let (force, movement) = (point.applied_force(), point.movement(body));
        let taken = force.dot(&movement);
        if !self.has_wind() {
            return [0.0, taken];
        }
        let duration = self.rate_history.duration();
        let remainder = force.dot(&point.displacement_remainder(movement, duration));
        let lost = point.power(&self.medium.law) * duration + remainder;
        [lost - taken, lost]
    }

    fn has_wind(&self) -> bool {
        self.medium.wind != Vec2::zeros()
    }
}

impl InternalForce for DragForces {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.rate_history.begin(interval.duration());
        self.points.iter_mut().for_each(|point| point.begin_step(&bodies[point.body], rates));
        Ok(())
    }

    fn begin_movement(&mut self, _bodies: &[Body]) {
        self.rate_history.begin(f64::INFINITY);
        self.points.iter_mut().for_each(DragPoint::reset_at_rest);
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let Some(rates) = self.rates(at) else { return ForceSummary::default() };
        let mut summary = ForceSummary::default();
        for point in &mut self.points {
            let body = &at.bodies[point.body];
            let missing = point.compare(&self.medium, body, at.increments, rates);
            let force = point.applied_force();
            summary.strain_mismatch = larger(summary.strain_mismatch, missing);
            summary.force = larger(summary.force, larger(force.x.abs(), force.y.abs()));
            point.scatter(body, force, out);
        }
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let Some(rates) = self.rates(at) else { return };
        for point in &mut self.points {
            let body = &at.bodies[point.body];
            let asked = point.linearise(&self.medium, body, at.increments, rates);
            point.scatter(body, asked, out);
            point.each_derivative(|to, from, by| {
                let row = body.degrees_of_freedom[to.0][to.1];
                let column = body.degrees_of_freedom[from.0][from.1];
                if row < unknowns && column < unknowns {
                    tangent.add(row, column, by);
                }
            });
        }
    }

    fn add_mismatch_forces(&self, bodies: &[Body], _weight: f64, out: &mut [f64]) {
        for point in &self.points {
            point.scatter(&bodies[point.body], point.missing(), out);
        }
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        self.points.iter_mut().for_each(|point| point.correct(&bodies[point.body], correction));
    }

    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for point in &self.points {
            let body = &bodies[point.body];
            let impulse = point.applied_force() * -duration;
            let (middle, [work, _]) = (point.middle(body), self.turnover(point, body));
            sum += WorkAndImpulse::of(work, impulse, cross(middle, impulse));
        }
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        let duration = self.rate_history.duration();
        let is_timed = duration.is_finite();
        if is_timed {
            for point in &self.points {
                let [work, lost] = self.turnover(point, &bodies[point.body]);
                self.dissipated += lost;
                self.wind_work += work;
            }
        }
        for point in &mut self.points {
            let movement = point.movement(&bodies[point.body]);
            point.advance(movement / duration);
        }
        self.rate_history.end();
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn external_work(&self) -> Option<f64> {
        self.has_wind().then_some(self.wind_work)
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        for point in &self.points {
            let rate = |at: usize| Vec2::new(rates[point.body][at][0], rates[point.body][at][1]);
            let body = &bodies[point.body];
            point.scatter(body, point.force_at_start(&self.medium, body, rate), out);
        }
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        let damping = self.medium.law.linear();
        for point in &self.points {
            let body = &bodies[point.body];
            let components = point.across_and_along(body, |at| body.vector_at(at, rates));
            for (damping, rate) in damping.iter().zip(components.iter()) {
                if *damping > 0.0 {
                    take(point.weight() * damping, *rate);
                }
            }
        }
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.rate_history.save(state);
        self.points.iter().for_each(|point| point.save(state));
        state.push(self.dissipated);
        state.extend(self.external_work());
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rate_history.restore(next);
        self.points.iter_mut().for_each(|point| point.restore(next));
        self.dissipated = next();
        if self.has_wind() {
            self.wind_work = next();
        }
    }

    fn explain(&self) -> String {
        let points = crate::system::errors::plural(self.points.len(), "point");
        let Medium { law, wind } = &self.medium;
        let blowing = match self.has_wind() {
            true => format!(", wind ({}, {})", wind.x, wind.y),
            false => String::new(),
        };
        format!("{} at {points}{blowing}; its forces are additional unknowns", law.describe())
    }
}
