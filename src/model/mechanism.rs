//! The model as integrators see it.

mod at_rest;
mod forces;
mod impact;
mod stiffness;

pub use at_rest::StaticForces;
pub use impact::Blow;
pub use stiffness::add_resistance;

use crate::beams::{Mesh, Place};
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::{Ending, Interval, Mechanism, Overshoot, Solution, Stage, StepError};
use crate::joints::{CONTACT_UNKNOWNS, Component};
use crate::linalg::{BandedMatrix, Border, BorderShape};
use crate::model::Resolution;
use crate::model::bodies::Body;
use crate::model::bodies::Tracker;
use crate::model::elements::Lump;
use crate::model::elements::{AppliedLoad, Exchange, Pattern, collocation};
use crate::model::looking::{Energy, Measures};
use crate::model::motion::Accelerations;
use crate::model::motion::Forecast;
use crate::model::motion::{StepScales, largest, relative};
use crate::model::sliders::TrackLimit;
use crate::model::sliders::{LANDED, Sliding};

/// A supported degree of freedom: the body, its control point and the component that does not move.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) struct Support {
    pub(in crate::model) body: usize,
    pub(in crate::model) point: usize,
    pub(in crate::model) component: Component,
}

/// Beams, masses and loads, assembled and in motion.
pub struct Model {
    pub(in crate::model) bodies: Vec<Body>,
    pub(in crate::model) meshes: Vec<Mesh>,
    pub(in crate::model) lumps: Vec<Lump>,
    pub(in crate::model) loads: Vec<AppliedLoad>,
    /// The weight of everything, if there is gravity.
    pub(in crate::model) gravity: Option<Pattern>,
    pub(in crate::model) trackers: Vec<Tracker>,
    /// Pairs of places that joints hold together.
    pub(in crate::model) joined: Vec<(Place, Place)>,
    pub(in crate::model) sliders: Vec<Sliding>,
    /// The limit at which the next step is to end.
    pub(in crate::model) aim: Option<TrackLimit>,
    /// In the order of their degrees of freedom, which follow the unknowns.
    pub(in crate::model) supports: Vec<Support>,
    pub(in crate::model) unknowns: usize,
    pub(in crate::model) half_bandwidth: usize,
    /// Which unknowns are rotations.
    pub(in crate::model) is_rotation: Vec<bool>,
    pub(in crate::model) rates: Vec<f64>,
    pub(in crate::model) accelerations: Accelerations,
    pub(in crate::model) forecast: Forecast,
    pub(in crate::model) resolution: Resolution,
    pub(in crate::model) total_mass: f64,
    pub(in crate::model) time: f64,
    pub(in crate::model) exchanged: Exchange,
    pub(in crate::model) step: StepScales,
    pub(in crate::model) scratch: Vec<f64>,
}

impl Model {
    pub(in crate::model) fn add_inertia_of_all(
        &mut self,
        factor: f64,
        rates: &[f64],
        out: &mut [f64],
    ) {
        self.bodies.iter_mut().for_each(|body| body.add_inertia(factor, rates, out));
        self.lumps
            .iter()
            .for_each(|lump| lump.add_inertia(&self.bodies[lump.place.body], factor, rates, out));
    }

    /// Energy, momenta and what was exchanged so far.
    pub fn measure(&mut self) -> Measures {
        let (mut twice_kinetic, mut momentum, mut angular_momentum) = (0.0, Vec2::zeros(), 0.0);
        let mut add = |(kinetic, linear, angular): (f64, Vec2, f64)| {
            twice_kinetic += kinetic;
            momentum += linear;
            angular_momentum += angular;
        };
        self.bodies.iter_mut().for_each(|body| add(body.momenta(&self.rates)));
        self.lumps
            .iter()
            .for_each(|lump| add(lump.momenta(&self.bodies[lump.place.body], &self.rates)));
        let energy = Energy {
            kinetic: 0.5 * twice_kinetic,
            strain: self.bodies.iter().map(|body| body.dynamics.strain_energy()).sum(),
            potential: self
                .gravity
                .as_ref()
                .map_or(0.0, |gravity| -gravity.potential_work(&self.bodies)),
        };
        Measures {
            time: self.time,
            energy,
            work: self.exchanged.work,
            momentum,
            impulse: self.exchanged.impulse,
            angular_momentum,
            angular_impulse: self.exchanged.angular_impulse,
            gross_impulse: self.exchanged.gross_impulse,
            gross_angular_impulse: self.exchanged.gross_angular_impulse,
            gap: self.gap(),
        }
    }

    pub(in crate::model) fn all_trackers(&self) -> impl Iterator<Item = &Tracker> {
        self.trackers.iter().chain(self.loads.iter().flat_map(AppliedLoad::trackers))
    }

    pub(in crate::model) fn all_trackers_mut(&mut self) -> impl Iterator<Item = &mut Tracker> {
        self.trackers.iter_mut().chain(self.loads.iter_mut().flat_map(AppliedLoad::trackers_mut))
    }

    /// From here on up to so many threads work on a large body, with the same results; how many at most.
    pub fn divide(&mut self, threads: usize) -> usize {
        self.bodies.iter_mut().map(|body| body.divide(threads)).max().unwrap_or(1)
    }

    /// Moves the clock without moving anything else.
    pub fn pass_time_to(&mut self, time: f64) {
        self.time = time;
    }

    fn gap(&self) -> f64 {
        let at =
            |place: &Place| place.interpolate(self.bodies[place.body].dynamics.control_points());
        let joined = self.joined.iter().map(|(a, b)| (at(a) - at(b)).norm());
        joined
            .chain(self.sliders.iter().map(|slider| slider.gap(&self.bodies).norm()))
            .fold(0.0, larger)
    }

    fn exchange_in_step(&self, residual: &[f64]) -> Exchange {
        let duration = self.step.interval.duration();
        let mut sum = Exchange::default();
        for load in &self.loads {
            sum += load.exchange(&self.bodies, duration);
        }
        if let Some(gravity) = &self.gravity {
            // Its work is the change of the potential, which is an energy of its own.
            sum += Exchange { work: 0.0, ..gravity.exchange(&self.bodies, 1.0, duration) };
        }
        sum += self.reactions(residual, duration);
        if duration < 0.0 {
            // A part of a step that goes back takes away what the others give twice.
            (sum.gross_impulse, sum.gross_angular_impulse) =
                (-sum.gross_impulse, -sum.gross_angular_impulse);
        }
        sum
    }

    /// What the supports give with these reactions in such a time.
    pub(in crate::model) fn reactions(&self, residual: &[f64], duration: f64) -> Exchange {
        let mut sum = Exchange::default();
        let reactions = &residual[self.degrees_of_freedom() - self.supports.len()..];
        for (support, reaction) in self.supports.iter().zip(reactions) {
            let at = self.bodies[support.body].dynamics.control_points()[support.point];
            let (force, moment) = match support.component {
                Component::X => (Vec2::new(*reaction, 0.0), 0.0),
                Component::Y => (Vec2::new(0.0, *reaction), 0.0),
                Component::Rotation => (Vec2::zeros(), *reaction),
            };
            let angular = (cross(at, force) + moment) * duration;
            sum += Exchange::of(0.0, force * duration, angular);
        }
        sum
    }
}

impl Mechanism for Model {
    fn unknowns(&self) -> usize {
        self.unknowns
    }

    fn constraint_shape(&self) -> BorderShape {
        BorderShape {
            width: CONTACT_UNKNOWNS * self.sliders.len(),
            row_entries: self.sliders.iter().map(Sliding::row_entries).sum(),
        }
    }

    fn degrees_of_freedom(&self) -> usize {
        self.unknowns + self.constraint_shape().width + self.supports.len()
    }

    fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    fn rates(&self) -> &[f64] {
        &self.rates
    }

    fn expected_rates(&self) -> &[f64] {
        self.forecast.rates(&self.rates)
    }

    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError> {
        for load in &mut self.loads {
            load.begin_step(interval, stages).map_err(|reason| StepError::Load {
                interval,
                load: load.name.clone(),
                reason: reason.to_string(),
            })?;
        }
        self.bodies.iter_mut().for_each(|body| body.dynamics.begin_step());
        let jumps = self.accelerations.known().is_some()
            && self.loads.iter().any(|load| load.schedule.may_jump_at(interval.start));
        self.step = StepScales { interval, jumps, ..StepScales::default() };
        let (mut scratch, rates) =
            (std::mem::take(&mut self.scratch), std::mem::take(&mut self.rates));
        scratch.fill(0.0);
        self.add_inertia_of_all(2.0 / interval.duration(), &rates, &mut scratch);
        self.step.inertia = largest(&scratch, &self.is_rotation);
        (self.scratch, self.rates) = (scratch, rates);
        Ok(())
    }

    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        self.add_inertia_of_all(factor, rates, out);
    }

    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix) {
        self.bodies.iter().for_each(|body| body.add_inertia_tangent(factor, tangent));
        self.inertia_entries_of_lumps(factor, &mut |row, column, value| {
            tangent.add(row, column, value);
        });
    }

    fn add_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> f64 {
        let summary = self.add_internal_forces(stage, increments, weight, out);
        self.step.loads = self.subtract_loads(stage, increments, weight, out);
        self.step.summary = summary;
        self.step.rotations = collocation(stage).rotations;
        summary.strain_mismatch
    }

    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.add_linearised_internal_forces(stage, increments, weight, out, tangent);
        self.subtract_linearised_loads(stage, increments, weight, out, tangent);
    }

    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        self.bodies.iter_mut().for_each(|body| body.add_mismatch_forces(weight, out));
    }

    fn correct_section_forces(&mut self, correction: &[f64]) {
        self.bodies.iter_mut().for_each(|body| body.correct_section_forces(correction));
    }

    fn predict_constraints(&mut self, interval: Interval, unknowns: &mut [f64]) {
        for slider in &self.sliders {
            slider.predict(&self.bodies, &self.rates, interval, unknowns);
        }
    }

    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]) {
        self.step.contact = 0.0;
        for slider in &mut self.sliders {
            let force = slider.add(&self.bodies, increments, unknowns, out);
            self.step.contact = larger(self.step.contact, force);
        }
    }

    fn add_linearised_constraints(
        &mut self,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        for slider in &mut self.sliders {
            slider.add_linearised(&self.bodies, increments, unknowns, out, border);
        }
    }

    fn relative_imbalance(&self, residual: &[f64]) -> f64 {
        let (force, moment) = largest(residual, &self.is_rotation);
        larger(relative(force, self.step.force()), relative(moment, self.step.moment()))
    }

    fn relative_violation(&self, residual: &[f64]) -> f64 {
        let equations = &residual[self.unknowns..];
        self.sliders.iter().fold(0.0, |largest, slider| {
            let (length, force) = slider.violation(equations);
            larger(largest, larger(length, relative(force, self.step.force())))
        })
    }

    fn check_constraints(&self, unknowns: &[f64]) -> Result<(), Overshoot> {
        let mut furthest: Option<Overshoot> = None;
        let ending = self.step.interval.ending();
        let aim = self.aim.filter(|_| ending == Ending::OfStep);
        let limits = (0..self.sliders.len()).flat_map(TrackLimit::both);
        for limit in limits.filter(|limit| self.sliders[limit.slider].is_sliding()) {
            let distance = self.sliders[limit.slider].beyond(unknowns, limit.end);
            let overshoot = Overshoot { limit: limit.number(), distance };
            if aim == Some(limit) && distance.abs() > LANDED {
                return Err(overshoot);
            }
            if distance > LANDED && furthest.is_none_or(|other| distance > other.distance) {
                furthest = Some(overshoot);
            }
        }
        furthest.map_or(Ok(()), Err)
    }

    fn largest_rotation(&self) -> f64 {
        self.step.summary.rotation
    }

    fn shortest_chord(&self) -> f64 {
        self.sliders.iter().map(Sliding::chord).fold(f64::INFINITY, f64::min)
    }

    fn advance(&mut self, solution: &Solution<'_>) {
        let Solution { increments, constraints, rates, residual } = *solution;
        for body in &mut self.bodies {
            body.gather(increments);
        }
        let rotations = self.step.rotations;
        let exchange = self.exchange_in_step(residual);
        self.exchanged += exchange;
        self.move_gathered(rotations);
        let ending = self.step.interval.ending();
        self.sliders.iter_mut().for_each(|slider| {
            slider.advance(&self.bodies, constraints, ending);
        });
        let duration = self.step.interval.duration();
        let missed = self.forecast.learn(&self.rates, increments, duration);
        self.resolution.add(&missed, duration, self.step.summary.rotation, rotations);
        self.rates.copy_from_slice(rates);
        self.time = self.step.interval.end;
    }
    fn write_checkpoint(&self, buffer: &mut Vec<f64>) {
        self.write_numbers(buffer);
    }

    fn return_to_checkpoint(&mut self, buffer: &[f64]) {
        self.restore_numbers(buffer);
    }

    fn keep_accelerations(&mut self) {
        self.accelerations.keep(self.unknowns);
    }

    fn accelerations(&self) -> Option<&[f64]> {
        // Those from before a jump are not those after it.
        self.accelerations.known().filter(|_| !self.step.jumps)
    }

    fn set_accelerations(&mut self, accelerations: &[f64]) {
        self.accelerations.set(accelerations);
    }
}
