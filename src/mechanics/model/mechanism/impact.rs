//! Impulses at sliders: consistent start velocities, and bounces off the ends of a master.
//!
//! An impulse `P` at a contact changes the velocities by `M (v⁺ - v⁻) = Gᵀ P`, `G v` being the velocity of the slave relative
//! to its place on the master. Where the contact is closed, linear and angular momentum stay;
//! a gap of the relaxed rule costs angular momentum.

use super::Model;
use crate::geometry::{Vec2, cross};
use crate::integrators::{Inertia, Mechanism};
use crate::linalg::{BandedLu, BandedMatrix, LinearError};
use crate::model::ModelError;
use crate::model::elements::Exchange;
use crate::model::sliders::Blow;

/// What moves by less than this part of the change of relative velocity is held.
const GIVES: f64 = 1e-9;

/// A slider, and the component of its relative velocity on which an impulse acts.
pub(super) type Direction = (usize, Vec2);

/// What a unit impulse transmits, and how the velocities answer.
pub(super) struct Answer {
    /// `Gᵀ`, on all degrees of freedom.
    pub(super) forces: Vec<f64>,
    /// `M⁻¹ Gᵀ`, of the unknowns.
    pub(super) rates: Vec<f64>,
    /// Where `Gᵀ` has entries.
    touched: Vec<usize>,
}

impl Answer {
    /// The velocity that rates are in the direction of the impulse: `G v`.
    pub(super) fn velocity(&self, rates: &[f64]) -> f64 {
        let of_rates = self.touched.iter().filter(|at| **at < rates.len());
        of_rates.map(|&at| rates[at] * self.forces[at]).sum()
    }
}

impl Model {
    /// Takes away the velocities of sliders across all masters, by the impulses that change least (Gauss's principle of least constraint).
    ///
    /// # Errors
    /// When the impulses are not determined.
    pub(in crate::model) fn project_velocities(&mut self) -> Result<(), ModelError> {
        let impulses = self.strike(&self.across(), -1.0);
        impulses.map(|_| ()).map_err(|_| self.sliders.overdetermined())
    }

    /// Where a drive begins with a rate and points of rigid bodies do not have the velocities of that, they get them, as the nearest that fit;
    /// velocities that miss by less than a number [length/time] do. It would alternate from step to step without end, as all rates do that do not
    /// fit.
    pub(in crate::model) fn fit_links_to_drives(&mut self, negligible: f64) {
        if self.links.count() == 0 || !self.supports.prescribed().begins_with_a_rate() {
            return;
        }
        let mut missed = vec![0.0; self.unknowns()];
        self.links.set_velocity_violation(&self.bodies, &self.motion.rates, 1.0, &mut missed);
        if missed.iter().all(|missed| missed.abs() <= negligible) {
            return;
        }
        // The blow with which a motion begins is before the start: nothing of it is in the sums since then. A matrix that cannot be factorised is found by
        // the first step.
        let before = std::mem::take(&mut self.exchanged);
        let struck = self.strike(&self.across(), -1.0);
        self.exchanged = before;
        if struck.is_ok() {
            self.supports.prescribed_mut().forget_work();
        }
    }

    /// A slider bounces off the end of its master, as off an elastic stop: all velocities relative to masters are reversed in
    /// the directions that transmit forces, which keeps the energy (`P·(G v⁺ + G v⁻) = 0`).
    ///
    /// Tells which masses the two set against the blow: waves run from what gave way.
    ///
    /// # Errors
    /// When the impulse is not determined.
    pub fn bounce(&mut self, slider: usize) -> Result<Blow, ModelError> {
        let directions = self.sliders.directions(&self.bodies, slider);
        // Behind that across the master.
        let of_blow = directions.iter().rposition(|(other, _)| *other == slider);
        let along = self.sliders[slider].along(&self.bodies);
        let before = self.speeds(slider, along);
        let impulses = self.strike(&directions, -2.0);
        let impulses = impulses.map_err(|_| self.sliders.overdetermined())?;
        let after = self.speeds(slider, along);
        let impulse = of_blow.map_or(0.0, |at| impulses[at].abs());
        let changes = [(after.0 - before.0).abs(), (after.1 - before.1).abs()];
        let least = GIVES * (changes[0] + changes[1]);
        let [slave, master] = changes.map(|change| (change > least).then(|| impulse / change));
        Ok(Blow { slave, master })
    }

    /// Notes how many times as long as a slider's blow at an end of its master the steps of `dt` are [time].
    pub fn note_blow(&mut self, slider: usize, blow: Blow, dt: f64) {
        self.sliders[slider].note_blow(&self.bodies, blow, dt);
    }

    /// How fast a slave and its place on the master move in a direction [length/time].
    fn speeds(&self, slider: usize, unit: Vec2) -> (f64, f64) {
        let (slider, rates) = (&self.sliders[slider], &self.motion.rates);
        let (slave, relative) = (
            slider.slave_velocity(&self.bodies, rates),
            slider.relative_velocity(&self.bodies, rates),
        );
        (slave.dot(&unit), (slave - relative).dot(&unit))
    }

    /// The speed of the fastest control point of the model [length/time].
    pub(in crate::model) fn fastest_speed(&self) -> f64 {
        self.bodies.fastest_speed(&self.motion.rates)
    }

    /// The speed of a slave across its master [length/time].
    pub(in crate::model) fn speed_across(&self, slider: usize) -> f64 {
        let slider = &self.sliders[slider];
        slider.across(&self.bodies).dot(&slider.relative_velocity(&self.bodies, &self.motion.rates))
    }

    /// The directions across all masters.
    fn across(&self) -> Vec<Direction> {
        self.sliders.iter().map(|slider| slider.across(&self.bodies)).enumerate().collect()
    }

    pub(super) fn answers(&self, inertia: &BandedLu<'_>, directions: &[Direction]) -> Vec<Answer> {
        let answer = |(slider, unit): &Direction| {
            let mut forces = vec![0.0; self.degrees_of_freedom()];
            self.sliders[*slider].transmit(&self.bodies, *unit, &mut forces);
            let mut rates = forces[..self.unknowns()].to_vec();
            inertia.solve(&mut rates);
            let touched = (0..forces.len()).filter(|&at| forces[at] != 0.0).collect();
            Answer { forces, rates, touched }
        };
        directions.iter().map(answer).collect()
    }

    /// Changes the components of the relative velocities by `factor` times themselves, by impulses at the sliders, which it tells.
    fn strike(&mut self, directions: &[Direction], factor: f64) -> Result<Vec<f64>, LinearError> {
        let count = directions.len();
        let mut inertia = self.banded_inertia();
        let inertia = inertia.factorise()?;
        let answers = self.answers(&inertia, directions);
        // What points of rigid bodies move beside these is changed by the same factor: then rigid links do no work either.
        let mut change = vec![0.0; self.unknowns()];
        if self.links.forces() > 0 {
            self.links.set_velocity_violation(
                &self.bodies,
                &self.motion.rates,
                factor,
                &mut change,
            );
            inertia.solve(&mut change);
        }
        let mut response = BandedMatrix::zeros(count, count.saturating_sub(1));
        for (row, answer) in answers.iter().enumerate() {
            for (column, Answer { rates, .. }) in answers.iter().enumerate() {
                response.add(row, column, answer.velocity(rates));
            }
        }
        let wanted = |answer: &Answer| {
            factor * answer.velocity(&self.motion.rates) - answer.velocity(&change)
        };
        let mut impulses: Vec<f64> = answers.iter().map(wanted).collect();
        response.factorise()?.solve(&mut impulses);

        let mut residual = vec![0.0; self.degrees_of_freedom()];
        for (impulse, Answer { forces, rates, .. }) in impulses.iter().zip(&answers) {
            change.iter_mut().zip(rates).for_each(|(change, rate)| *change += impulse * rate);
            residual.iter_mut().zip(forces).for_each(|(out, force)| *out -= impulse * force);
        }
        // What is left of `M (v⁺ - v⁻) - Gᵀ P` at supports is their impulse.
        self.add_inertia(1.0, &change, &mut residual);
        self.links.transmit(&self.bodies, &change, &mut residual);
        for (unknown, roller) in self.links.rollers() {
            let (impulse, place) = (roller.force_of(change[unknown]), roller.place(&self.bodies));
            self.exchanged.total += Exchange::of(0.0, impulse, cross(place, impulse));
        }
        let on_slaves = impulses.iter().zip(directions);
        let on_slaves = on_slaves.map(|(impulse, (slider, unit))| (*slider, unit * *impulse));
        self.add_impulses_of_blow(&change, on_slaves);
        // Impulses of rigid links are no forces that go on.
        self.links.clear(&mut change);
        self.motion.jump(&change);
        self.exchanged.total += self.supports.exchange_in_blow(&self.bodies, &residual);
        if self.supports.prescribed().count() > 0 {
            let movements = self.supports.prescribed_mut();
            self.exchanged.total +=
                movements.exchange_in_blow(&self.bodies, &residual, &self.motion.rates);
        }
        Ok(impulses)
    }

    /// The velocities across the masters that unit impulses across them cause: `G M⁻¹ Gᵀ`, a row for each direction [1/mass].
    pub(in crate::model) fn response_across(&self) -> Result<Vec<Vec<f64>>, LinearError> {
        let mut inertia = self.banded_inertia();
        let answers = self.answers(&inertia.factorise()?, &self.across());
        let row = |rates: &[f64]| answers.iter().map(|other| other.velocity(rates)).collect();
        Ok(answers.iter().map(|answer| row(&answer.rates)).collect())
    }
}
