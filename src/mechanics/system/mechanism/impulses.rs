//! Impulses of joints and supports in the last step, accumulated if mean forces over a step are requested.
//!
//! After a step has been solved, the balance is evaluated again with separate degrees of freedom for every control point.
//! The residual at each control point is the force of joints and supports. Impulses of impacts are added.
//! Integrators that balance accelerations instead of momenta do not provide mean forces.

use super::rigidity::add_transmitted_impulses;
use super::step_power::StepPower;
use super::{Reactions, System};
use crate::integrators::{Inertia, Solution, Stage};
use crate::joints::Wrench;
use crate::system::bodies::DegreesOfFreedom;
use crate::system::elements::WorkAndImpulse;
use crate::system::links::InclinedRoller;
use crate::system::sliders::{InStep, SliderContact};

/// Work and impulse that a model exchanges with its surroundings, and impulses of joints and supports on each control point.
#[derive(Default)]
pub struct ExchangeLedger {
    pub total: WorkAndImpulse,
    /// Impulses of joints and supports; `None` unless requested.
    pub impulses: Option<Box<Impulses>>,
    /// Powers of all drives, followed by the powers of all loads; `None` unless requested.
    pub powers: Option<Vec<StepPower>>,
}

pub struct Impulses {
    numbers: Vec<DegreesOfFreedom>,
    links: Vec<[usize; 2]>,
    rollers: Vec<Option<usize>>,
    values: Vec<f64>,
    residual: Vec<f64>,
    /// Impulses since the end of the last step [force·time, force·length·time].
    /// The impulses on control points are stored first, followed by the impulses of inclined rollers.
    present: Vec<f64>,
    means: Vec<f64>,
}

impl Impulses {
    fn sum_up(&mut self, factor: f64, rollers: &[InclinedRoller], unknowns: &[f64]) {
        let movements = self.present.len() - rollers.len();
        let (present, across) = self.present.split_at_mut(movements);
        present.iter_mut().zip(&self.residual).for_each(|(sum, left)| *sum += factor * left);
        for (sum, roller) in across.iter_mut().zip(rollers) {
            *sum += roller.unknown.map_or(0.0, |at| unknowns[at]);
        }
    }

    fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.means.iter().chain(&self.present));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.means.iter_mut().chain(&mut self.present).for_each(|number| *number = next());
    }
}

impl ExchangeLedger {
    pub fn save(&self, numbers: &mut Vec<f64>) {
        self.total.save(numbers);
        self.impulses.iter().for_each(|impulses| impulses.save(numbers));
        let powers = self.powers.iter().flatten();
        numbers.extend(powers.flat_map(|step| [step.power, step.work]));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.total.restore(next);
        self.impulses.iter_mut().for_each(|impulses| impulses.restore(next));
        for step in self.powers.iter_mut().flatten() {
            (step.power, step.work) = (next(), next());
        }
    }
}

impl System {
    pub(crate) fn accumulate_impulses(&mut self) {
        if self.exchanged.impulses.is_some() {
            return;
        }
        let joined = self.bodies.number_separately();
        let numbers = self.bodies.number_as(joined);
        let movements = 3 * numbers.iter().map(|own| own.len()).sum::<usize>();
        let all = movements + 2 * self.links.count();
        let links = (0..self.links.count()).map(|at| [movements + 2 * at, movements + 2 * at + 1]);
        self.exchanged.impulses = Some(Box::new(Impulses {
            links: links.collect(),
            rollers: vec![None; self.links.all_rollers().len()],
            numbers,
            values: vec![0.0; all],
            residual: vec![0.0; all + self.sliders.border().width],
            present: vec![0.0; movements + self.links.all_rollers().len()],
            means: vec![0.0; movements + self.links.all_rollers().len()],
        }));
    }

    /// Initialises all mean forces with the present forces.
    /// If the forces at the start are unknown, for example because a load has no value, the first step reports the reason.
    pub(crate) fn start_means(&mut self) {
        let has_drives = self.supports.prescribed().count() > 0;
        if self.sliders.is_empty() && !has_drives && self.exchanged.impulses.is_none() {
            return;
        }
        let Ok(mut now) = self.instant() else { return };
        if self.start_overloaded_slips(&now) {
            let Ok(with_slip) = self.instant() else { return };
            now = with_slip;
        }
        for at in 0..self.sliders.len() {
            let along = self.sliders[at].along(&self.bodies);
            self.sliders[at].start_mean_force(now.wrench(at));
            self.sliders[at].start_friction_force(now.contact(at).dot(&along));
        }
        self.supports.prescribed_mut().start_reactions(now.reactions().residual());
        self.initialise_powers();
        if let Some(impulses) = &mut self.exchanged.impulses {
            let multiplier =
                |roller: &InclinedRoller| roller.unknown.map_or(0.0, |at| now.accelerations()[at]);
            let across = self.links.all_rollers().iter().map(multiplier);
            let forces = now.reactions().on_nodes().chain(across);
            impulses.means.iter_mut().zip(forces).for_each(|(mean, force)| *mean = force);
        }
    }

    /// Ends a step of the given duration [time]. Later impulses belong to the next step.
    pub(crate) fn end_step(&mut self, duration: f64) {
        self.sliders.iter_mut().for_each(SliderContact::end_step);
        self.supports.prescribed_mut().end_step();
        self.update_powers(duration);
        if let Some(impulses) = &mut self.exchanged.impulses {
            let Impulses { present, means, .. } = &mut **impulses;
            let weight = 1.0 / duration;
            means.iter_mut().zip(&*present).for_each(|(mean, impulse)| *mean = weight * impulse);
            present.fill(0.0);
        }
    }

    /// Mean forces of joints and supports in the last step, including impacts. Before the first step, the present forces are returned.
    /// The mean forces are `None` unless the accumulation of impulses is [enabled](Self::accumulate_impulses).
    pub fn mean_reactions(&self) -> Option<Reactions> {
        let Impulses { means, .. } = &**self.exchanged.impulses.as_ref()?;
        let (left, across) = means.split_at(means.len() - self.links.all_rollers().len());
        Some(self.reactions_from_residuals(left, across))
    }

    pub(super) fn add_impulses_of_step(&mut self, solution: &Solution<'_>) {
        let Some(mut impulses) = self.exchanged.impulses.take() else { return };
        let Solution { increments, constraints, rates, balanced, .. } = *solution;
        let duration = self.step.interval.duration();
        impulses.residual.fill(0.0);
        let before = std::mem::take(&mut self.motion.rates);
        self.separate_values(&mut impulses, |at| (rates[at] - before[at]) / duration, rates.len());
        self.motion.rates = before;
        self.exchange_numbers(&mut impulses);
        self.add_inertia(1.0, &impulses.values, &mut impulses.residual);
        self.exchange_numbers(&mut impulses);
        self.separate_values(&mut impulses, |at| increments[at], increments.len());
        self.exchange_numbers(&mut impulses);
        for (stage, weight) in balanced {
            let moved = if *stage == Stage::Start { &[] } else { &*impulses.values };
            self.add_internal_forces(*stage, moved, *weight, &mut impulses.residual);
            self.subtract_loads(*stage, moved, *weight, &mut impulses.residual);
        }
        let (moved, left) = (&impulses.values, &mut impulses.residual);
        self.sliders.add::<InStep>(&self.bodies, moved.len(), moved, constraints, left);
        let Impulses { residual: left, rollers, .. } = &mut *impulses;
        for (roller, unknown) in self.links.all_rollers().iter().zip(rollers) {
            let impulse = unknown.map_or(0.0, |at| increments[at]);
            roller.transmit(&self.bodies, impulse / duration, left);
        }
        self.exchange_numbers(&mut impulses);
        impulses.sum_up(duration, self.links.all_rollers(), increments);
        self.exchanged.impulses = Some(impulses);
    }

    pub(super) fn add_impact_impulses(
        &mut self,
        change: &[f64],
        passed_on: &[f64],
        on_slaves: impl Iterator<Item = (usize, Wrench)>,
    ) {
        let Some(mut impulses) = self.exchanged.impulses.take() else { return };
        impulses.residual.fill(0.0);
        self.separate_values(&mut impulses, |at| change[at], change.len());
        self.bodies.exchange_numbers(&mut impulses.numbers);
        self.add_inertia(1.0, &impulses.values, &mut impulses.residual);
        self.links.transmit(&self.bodies, change, &mut impulses.residual);
        add_transmitted_impulses(self, passed_on, &mut impulses.residual);
        for (slider, impulse) in on_slaves {
            self.sliders[slider].transmit(&self.bodies, -impulse, &mut impulses.residual);
        }
        self.bodies.exchange_numbers(&mut impulses.numbers);
        impulses.sum_up(1.0, self.links.all_rollers(), change);
        self.exchanged.impulses = Some(impulses);
    }

    fn separate_values(&self, impulses: &mut Impulses, value: impl Fn(usize) -> f64, count: usize) {
        let Impulses { numbers, links, values, .. } = impulses;
        let of = |at: usize| if at < count { value(at) } else { 0.0 };
        for (body, own) in self.bodies.iter().zip(numbers) {
            let pairs = body.degrees_of_freedom.as_flattened().iter().zip(own.as_flattened());
            pairs.for_each(|(&at, &own)| values[own] = of(at));
        }
        for (link, own) in self.links.iter().zip(links) {
            link.unknowns.iter().zip(own).for_each(|(&at, &mut own)| values[own] = of(at));
        }
    }

    fn exchange_numbers(&mut self, impulses: &mut Impulses) {
        self.bodies.exchange_numbers(&mut impulses.numbers);
        self.links.exchange_unknowns(&mut impulses.links, &mut impulses.rollers);
    }
}
