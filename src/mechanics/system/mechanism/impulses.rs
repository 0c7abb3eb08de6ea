//! The impulses of joints and supports in the last step, where somebody asks for their mean.
//!
//! The balance of a step is made up once more as it was solved, but with numbers of their own for the movements of every control point, so that
//! joints tie none of them: what is left at each is what joints and supports gave to it. Blows add theirs.
//!
//! ```text
//! M (v1 - v0)/Δt + Σ share · F(stage) + G = r        p1 - p0 = Δt Σ (r + loads)
//! ```
//!
//! Methods that balance accelerations of their own, and not the change of the velocities, have no such mean.

use super::rigidity::add_passed_on;
use super::{Reactions, System};
use crate::geometry::Vec2;
use crate::integrators::{Inertia, Solution, Stage};
use crate::system::bodies::DegreesOfFreedom;
use crate::system::elements::WorkAndImpulse;
use crate::system::links::InclinedRoller;
use crate::system::sliders::InStep;

/// What a model has exchanged with its surroundings, and what joints and supports gave to each control point.
#[derive(Default)]
pub struct ExchangeLedger {
    /// What a model has exchanged since its start.
    pub total: WorkAndImpulse,
    /// The impulses of joints and supports; none where nobody asks for the mean of a step.
    pub impulses: Option<Box<Impulses>>,
}

/// Impulses on all control points, and room to find them without allocating.
pub struct Impulses {
    /// Numbers for the movements of every control point that no other one has; the old ones while these are in use.
    numbers: Vec<DegreesOfFreedom>,
    /// The numbers of the forces of rigid links, behind those of all movements; the old ones while these are in use.
    links: Vec<[usize; 2]>,
    /// None for each inclined roller, as it acts by itself; their unknowns while the numbers are in use.
    rollers: Vec<Option<usize>>,
    /// Values by these numbers: of rates, and of increments.
    values: Vec<f64>,
    /// What is left of the balance; at the end there is room for the equations of contacts.
    left: Vec<f64>,
    /// The impulses since the end of the last step, by control points, and behind them of the multipliers of inclined rollers [force·time, force·length·time].
    present: Vec<f64>,
    /// The impulses of the last step, likewise.
    last: Vec<f64>,
    /// How long the last step was [time].
    duration: f64,
}

impl Impulses {
    /// Adds what is left of the balance, times a factor, and the impulses of inclined rollers, which are unknowns of the model.
    fn sum_up(&mut self, factor: f64, rollers: &[InclinedRoller], unknowns: &[f64]) {
        let movements = self.present.len() - rollers.len();
        let (present, across) = self.present.split_at_mut(movements);
        present.iter_mut().zip(&self.left).for_each(|(sum, left)| *sum += factor * left);
        for (sum, roller) in across.iter_mut().zip(rollers) {
            *sum += roller.unknown.map_or(0.0, |at| unknowns[at]);
        }
    }

    /// Appends the impulses.
    fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.last.iter().chain(&self.present));
        numbers.push(self.duration);
    }

    /// Takes the impulses back, in the order in which they were appended.
    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.last.iter_mut().chain(&mut self.present).for_each(|impulse| *impulse = next());
        self.duration = next();
    }
}

impl ExchangeLedger {
    /// Appends what was exchanged.
    pub fn save(&self, numbers: &mut Vec<f64>) {
        self.total.save(numbers);
        self.impulses.iter().for_each(|impulses| impulses.save(numbers));
    }

    /// Takes back what was exchanged, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.total.restore(next);
        self.impulses.iter_mut().for_each(|impulses| impulses.restore(next));
    }
}

impl System {
    /// Sums up from here on what joints and supports give to each control point in a step.
    pub fn sum_up_impulses(&mut self) {
        if self.exchanged.impulses.is_some() {
            return;
        }
        let joined = self.bodies.number_apart();
        let numbers = self.bodies.number_as(joined);
        let movements = 3 * numbers.iter().map(|own| own.len()).sum::<usize>();
        let all = movements + 2 * self.links.count();
        let links = (0..self.links.count()).map(|at| [movements + 2 * at, movements + 2 * at + 1]);
        self.exchanged.impulses = Some(Box::new(Impulses {
            links: links.collect(),
            rollers: vec![None; self.links.all_rollers().len()],
            numbers,
            values: vec![0.0; all],
            left: vec![0.0; all + self.sliders.border().width],
            present: vec![0.0; movements + self.links.all_rollers().len()],
            last: vec![0.0; movements + self.links.all_rollers().len()],
            duration: 0.0,
        }));
    }

    /// Ends a step of such a duration [time]: what is given from here on belongs to the next one.
    pub fn end_step(&mut self, duration: f64) {
        let Some(impulses) = &mut self.exchanged.impulses else { return };
        let Impulses { present, last, .. } = &mut **impulses;
        std::mem::swap(present, last);
        present.fill(0.0);
        impulses.duration = duration;
    }

    /// What joints and supports gave in the mean of the last step, its blows included; nothing before the first step. None where it is not
    /// [summed up](Self::sum_up_impulses).
    pub fn given_in_step(&self) -> Option<Reactions> {
        let Impulses { last, duration, .. } = &**self.exchanged.impulses.as_ref()?;
        let share = if *duration == 0.0 { 0.0 } else { 1.0 / duration };
        let mean: Vec<f64> = last.iter().map(|impulse| share * impulse).collect();
        let (left, across) = mean.split_at(mean.len() - self.links.all_rollers().len());
        Some(self.given(left, across))
    }

    /// Adds the impulses of a part of a step that is about to be accepted.
    pub(super) fn add_impulses_of_step(&mut self, solution: &Solution<'_>) {
        let Some(mut impulses) = self.exchanged.impulses.take() else { return };
        let Solution { increments, constraints, rates, balanced, .. } = *solution;
        let duration = self.step.interval.duration();
        impulses.left.fill(0.0);
        let before = std::mem::take(&mut self.motion.rates);
        self.apart(&mut impulses, |at| (rates[at] - before[at]) / duration, rates.len());
        self.motion.rates = before;
        self.exchange_numbers(&mut impulses);
        self.add_inertia(1.0, &impulses.values, &mut impulses.left);
        self.exchange_numbers(&mut impulses);
        self.apart(&mut impulses, |at| increments[at], increments.len());
        self.exchange_numbers(&mut impulses);
        for (stage, share) in balanced {
            let moved = if *stage == Stage::Start { &[] } else { &*impulses.values };
            self.add_internal_forces(*stage, moved, *share, &mut impulses.left);
            self.subtract_loads(*stage, moved, *share, &mut impulses.left);
        }
        let (moved, left) = (&impulses.values, &mut impulses.left);
        self.sliders.add::<InStep>(&self.bodies, moved.len(), moved, constraints, left);
        let Impulses { left, rollers, .. } = &mut *impulses;
        for (roller, unknown) in self.links.all_rollers().iter().zip(rollers) {
            let impulse = unknown.map_or(0.0, |at| increments[at]);
            roller.transmit(&self.bodies, impulse / duration, left);
        }
        self.exchange_numbers(&mut impulses);
        impulses.sum_up(duration, self.links.all_rollers(), increments);
        self.exchanged.impulses = Some(impulses);
    }

    /// Adds the impulses of a blow: it changes the rates and acts by impulses of rigid links, which stand among the changes, by those of section
    /// forces, and on the slaves of sliders.
    pub(super) fn add_impulses_of_blow(
        &mut self,
        change: &[f64],
        passed_on: &[f64],
        on_slaves: impl Iterator<Item = (usize, Vec2)>,
    ) {
        let Some(mut impulses) = self.exchanged.impulses.take() else { return };
        impulses.left.fill(0.0);
        self.apart(&mut impulses, |at| change[at], change.len());
        self.bodies.exchange_numbers(&mut impulses.numbers);
        self.add_inertia(1.0, &impulses.values, &mut impulses.left);
        self.links.transmit(&self.bodies, change, &mut impulses.left);
        add_passed_on(self, passed_on, &mut impulses.left);
        for (slider, impulse) in on_slaves {
            self.sliders[slider].transmit(&self.bodies, -impulse, &mut impulses.left);
        }
        self.bodies.exchange_numbers(&mut impulses.numbers);
        impulses.sum_up(1.0, self.links.all_rollers(), change);
        self.exchanged.impulses = Some(impulses);
    }

    /// Puts values of the unknowns, of which there are so many, where the numbers of their own of control points and rigid links stand.
    fn apart(&self, impulses: &mut Impulses, value: impl Fn(usize) -> f64, count: usize) {
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

    /// Exchanges the numbers of the model for those of control points by themselves, or back.
    fn exchange_numbers(&mut self, impulses: &mut Impulses) {
        self.bodies.exchange_numbers(&mut impulses.numbers);
        self.links.exchange_unknowns(&mut impulses.links, &mut impulses.rollers);
    }
}
