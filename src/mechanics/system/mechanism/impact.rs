//! Impulses at sliders: consistent start velocities, and impacts at the ends of masters. Simultaneous impacts are solved together.
//!
//! An impulse at a closed contact conserves linear and angular momentum.
//! The relaxed sliding rule does not keep the gap closed. An impulse across a gap changes the angular momentum.
//! In an impact, relative velocities do not contain vibrations that are too fast for the time step ([`Rigidity`]).

use super::System;
use super::rigidity::{Deformation, Rigidity};
use crate::geometry::cross;
use crate::integrators::{Inertia, Interval, Mechanism};
use crate::joints::Wrench;
use crate::linalg::{BandedLu, LinearError, Pairing, complementary};
use crate::system::SystemError;
use crate::system::elements::WorkAndImpulse;

pub(super) type ImpactDirection = (usize, Wrench);

pub(super) type ImpactSelection<'a> = (&'a [ImpactDirection], Deformation);

/// Largest ratio of velocity responses at which slave and master count as rigid in the direction of an impulse [-].
/// The ratio is the response with only the included deformations, divided by the response with all deformations.
pub(super) const GIVES: f64 = 1e-9;

pub(super) struct ImpulseResponse {
    pub(super) forces: Vec<f64>,
    pub(super) rates: Vec<f64>,
    touched: Vec<usize>,
    transmitted: Vec<f64>,
}

impl ImpulseResponse {
    fn of(
        inertia: &BandedLu<'_>,
        unknowns: usize,
        forces: Vec<f64>,
        transmitted: Vec<f64>,
    ) -> Self {
        let mut rates = forces[..unknowns].to_vec();
        inertia.solve(&mut rates);
        let touched = (0..forces.len()).filter(|&at| forces[at] != 0.0).collect();
        Self { forces, rates, touched, transmitted }
    }

    pub(super) fn velocity(&self, rates: &[f64]) -> f64 {
        let of_rates = self.touched.iter().filter(|at| **at < rates.len());
        of_rates.map(|&at| rates[at] * self.forces[at]).sum()
    }
}

/// Impact law: condition on the impulse of a contact, and on its velocities before and after the impact.
///
/// The work of an impulse is the impulse times the mean of the velocities before and after the impact.
/// The law of a stop uses the mean of the velocities before and after an auxiliary impact in which stops exert no impulse.
/// This mean contains no velocities across masters, whose signs alternate from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ImpactLaw {
    /// Law of a contact with zero relative velocity after the impact. The impulse may have either sign.
    Ends,
    /// Law of a contact whose impulse does no work, because the mean relative velocity is zero. The impulse may have either sign.
    Elastic,
    /// Law of a unilateral contact: either a compressive impulse that does no work, or separation without impulse.
    Unilateral,
    /// Law of a slider held at a stop: a compressive impulse without rebound.
    Held,
    /// Law of a stop with the given coefficient of restitution and a compressive impulse.
    Restitution(f64),
    /// Law of a slider that comes to rest at a stop. The impulse may have either sign.
    Rest,
    /// Law of a stop that returns its stored energy: the slider leaves the stop with the given speed [length/time].
    StoredEnergy(f64),
}

impl ImpactLaw {
    pub(super) fn pairing(self) -> Pairing {
        match self {
            Self::Ends | Self::Elastic | Self::Rest => Pairing::Equality,
            Self::Unilateral | Self::Restitution(_) | Self::Held | Self::StoredEnergy(_) => {
                Pairing::Complementary
            }
        }
    }
}

pub(super) struct ImpactProblem {
    directions: Vec<ImpactDirection>,
    responses: Vec<ImpulseResponse>,
    /// Velocity change in each contact direction (row) due to a unit impulse in each contact direction (column) [1/mass].
    pub(super) response: Vec<Vec<f64>>,
    /// Relative velocities in the contact directions before the impact, plus half of the jumps of prescribed rates [length/time].
    before: Vec<f64>,
    change: Vec<f64>,
    /// Jumps of prescribed rates, indexed by degree of freedom; empty without jumps.
    jumps: Vec<f64>,
}

#[derive(Debug, Clone)]
pub(super) struct ImpactImpulses {
    /// Impulse in each contact direction [mass·length/time].
    pub(super) values: Vec<f64>,
    /// Mean of the velocities in each contact direction before and after the impact [length/time].
    pub(super) mean_velocities: Vec<f64>,
}

impl ImpactImpulses {
    /// Work of each impulse on the bodies [energy].
    pub(super) fn works(&self) -> impl Iterator<Item = f64> {
        self.values.iter().zip(&self.mean_velocities).map(|(impulse, velocity)| impulse * velocity)
    }

    pub(super) fn without_first(mut self, count: usize) -> Self {
        Self {
            values: self.values.split_off(count),
            mean_velocities: self.mean_velocities.split_off(count),
        }
    }
}

impl ImpactProblem {
    fn by_links(&self, at: usize) -> f64 {
        self.responses[at].velocity(&self.change)
    }

    pub(super) fn approach_velocities(&self, at: usize, impulses: &[f64]) -> (f64, f64) {
        let by_impulses: f64 = self.response[at].iter().zip(impulses).map(|(a, p)| a * p).sum();
        (self.before[at], self.by_links(at) + by_impulses)
    }

    pub(super) fn mean_velocity(&self) -> Vec<f64> {
        let half_way = |(at, w): (usize, &f64)| w + 0.5 * self.by_links(at);
        self.before.iter().enumerate().map(half_way).collect()
    }

    pub(super) fn lacks(&self, laws: &[ImpactLaw]) -> Result<Vec<f64>, LinearError> {
        let first = self.before.len() - laws.len();
        let means = &self.mean_velocity()[first..];
        let of_stops = self.stop_velocities(laws)?;
        let lack = |(at, law): (usize, &ImpactLaw)| {
            let (twice, of_stop) = (2.0 * means[at], of_stops[at]);
            match law {
                ImpactLaw::Ends => self.before[first + at] + self.by_links(first + at),
                ImpactLaw::Elastic | ImpactLaw::Unilateral => twice,
                ImpactLaw::Held => twice - of_stop.min(0.0),
                ImpactLaw::Restitution(restitution) => {
                    twice - (1.0 - restitution) * of_stop.min(0.0)
                }
                ImpactLaw::Rest => twice - of_stop,
                ImpactLaw::StoredEnergy(speed) => twice - of_stop - speed,
            }
        };
        Ok(laws.iter().enumerate().map(lack).collect())
    }

    pub(super) fn stop_velocities(&self, laws: &[ImpactLaw]) -> Result<Vec<f64>, LinearError> {
        let first = self.before.len() - laws.len();
        let mut means = self.mean_velocity().split_off(first);
        let acting: Vec<usize> =
            (0..laws.len()).filter(|at| laws[*at] == ImpactLaw::Elastic).collect();
        if acting.is_empty() || acting.len() == laws.len() {
            return Ok(means);
        }
        let to_acting = |row: &Vec<f64>| acting.iter().map(|at| row[first + at]).collect();
        let responses: Vec<Vec<f64>> = self.response[first..].iter().map(to_acting).collect();
        let of_acting: Vec<Vec<f64>> = acting.iter().map(|at| responses[*at].clone()).collect();
        let lacks: Vec<f64> = acting.iter().map(|at| 2.0 * means[*at]).collect();
        let impulses = complementary(&of_acting, &lacks, &vec![Pairing::Equality; acting.len()])?;
        for (mean, row) in means.iter_mut().zip(&responses) {
            *mean += 0.5 * row.iter().zip(&impulses).map(|(a, p)| a * p).sum::<f64>();
        }
        Ok(means)
    }

    pub(super) fn with_mean_velocities(&self, values: Vec<f64>) -> ImpactImpulses {
        let mean = |at: usize| {
            let (before, change) = self.approach_velocities(at, &values);
            before + 0.5 * change
        };
        let mean_velocities = (0..values.len()).map(mean).collect();
        ImpactImpulses { values, mean_velocities }
    }

    pub(super) fn impulses(&self, laws: &[ImpactLaw]) -> Result<ImpactImpulses, LinearError> {
        let pairings: Vec<Pairing> = laws.iter().map(|law| law.pairing()).collect();
        let values = complementary(&self.response, &self.lacks(laws)?, &pairings)?;
        Ok(self.with_mean_velocities(values))
    }
}

fn response(answers: &[ImpulseResponse]) -> Vec<Vec<f64>> {
    let row = |answer: &ImpulseResponse| {
        answers.iter().map(|other| answer.velocity(&other.rates)).collect()
    };
    answers.iter().map(row).collect()
}

impl System {
    /// Sets the velocities of all slaves across their masters to zero by the smallest change in the norm of the inertia matrix
    /// (Gauss's principle of least constraint).
    pub(in crate::system) fn project_velocities(&mut self) -> Result<(), SystemError> {
        self.apply_transverse_impact().map_err(|_| self.sliders.overdetermined())
    }

    fn apply_transverse_impact(&mut self) -> Result<(), LinearError> {
        let across = self.across();
        let problem = self.impact_problem(&[(&across, Deformation::All)], -1.0)?;
        let impulses = problem.impulses(&vec![ImpactLaw::Ends; across.len()])?;
        self.apply(problem, &impulses.values);
        Ok(())
    }

    /// Adjusts the velocities of points of rigid bodies to the initial rates of drives.
    /// Velocity differences below `negligible` are ignored [length/time].
    /// Without the adjustment, the velocity difference between rigid links and drives would change its sign in every step.
    pub(in crate::system) fn fit_links_to_drives(&mut self, negligible: f64) {
        if self.links.count() == 0 || !self.supports.prescribed().has_start_rate() {
            return;
        }
        let mut missed = vec![0.0; self.unknowns()];
        self.links.set_velocity_violation(&self.bodies, &self.motion.rates, 1.0, &mut missed);
        if missed.iter().all(|missed| missed.abs() <= negligible) {
            return;
        }
        // The adjusting impulse acts before the start time, so it is not added to the accumulated impulses.
        // A singular matrix is ignored here, because the first step reports it.
        let before = std::mem::take(&mut self.exchanged);
        let struck = self.apply_transverse_impact();
        self.exchanged = before;
        if struck.is_ok() {
            self.supports.prescribed_mut().clear_work();
        }
    }

    /// Computes the impact of rigid links and sliders due to jumps of prescribed rates at the start of a step.
    /// Without the impact at a jump, the violation of the velocity constraints would alternate in sign from step to step.
    /// The impact reverses the violation of the velocity constraints. It conserves energy except for the work of drives (theory.md 9.5).
    /// The returned flag is true if the impact has been applied. It is false without a jump, without rigid links and sliders, or after an error.
    pub(crate) fn apply_drive_jumps(&mut self, interval: Interval) -> bool {
        if self.links.count() == 0 && self.sliders.iter().next().is_none() {
            return false;
        }
        // A drive function without a value is ignored here, because the following step reports it.
        let prescribed = self.supports.prescribed();
        let Ok(Some(jumps)) = prescribed.jumps(interval, &self.motion.rates) else { return false };
        let directions: Vec<ImpactDirection> = self.sliders.directions(&self.bodies).collect();
        let laws: Vec<ImpactLaw> =
            directions.iter().map(|(slider, _)| self.law_across(*slider)).collect();
        // A singular matrix is ignored here, because the following step reports it.
        let Ok(problem) =
            self.impact_problem_with_jumps(&[(&directions, Deformation::All)], -2.0, jumps)
        else {
            return false;
        };
        let Ok(impulses) = problem.impulses(&laws) else { return false };
        self.apply(problem, &impulses.values);
        self.separate_after_impact(directions.into_iter().zip(laws), &impulses);
        self.choose_friction_modes();
        true
    }

    /// Velocity components of the slave and of the contact point of the master in an impact direction [length/time].
    pub(super) fn speeds(&self, (slider, unit): ImpactDirection, rates: &[f64]) -> (f64, f64) {
        let (slider, unit) = (&self.sliders[slider], unit.force);
        let (slave, relative) = (
            slider.slave_velocity(&self.bodies, rates),
            slider.relative_velocity(&self.bodies, rates),
        );
        (slave.dot(&unit), (slave - relative).dot(&unit))
    }

    pub(in crate::system) fn fastest_speed(&self) -> f64 {
        self.bodies.fastest_speed(&self.motion.rates)
    }

    /// Velocity of a slave relative to its master, component across the master [length/time].
    pub(in crate::system) fn speed_across(&self, slider: usize) -> f64 {
        let slider = &self.sliders[slider];
        slider.across(&self.bodies).dot(&slider.relative_velocity(&self.bodies, &self.motion.rates))
    }

    /// Indices of sliders, and the wrenches of impulses that their constraints transmit if all of them slide.
    pub(in crate::system) fn across(&self) -> Vec<ImpactDirection> {
        let sliders = self.sliders.iter().enumerate();
        let closed = sliders.filter(|(_, slider)| slider.state.has_contact());
        let wrenches = closed.flat_map(|(at, slider)| {
            let across = std::iter::once(slider.across(&self.bodies).into());
            across.chain(slider.couple_direction(&self.bodies)).map(move |wrench| (at, wrench))
        });
        wrenches.collect()
    }

    fn transmitted(&self, (slider, unit): ImpactDirection) -> Vec<f64> {
        let mut forces = vec![0.0; self.degrees_of_freedom()];
        self.sliders[slider].transmit(&self.bodies, unit, &mut forces);
        forces
    }

    pub(super) fn impulse_responses(
        &self,
        inertia: &BandedLu<'_>,
        directions: &[ImpactDirection],
    ) -> Vec<ImpulseResponse> {
        let unknowns = self.unknowns();
        let answer = |at: &ImpactDirection| {
            ImpulseResponse::of(inertia, unknowns, self.transmitted(*at), Vec::new())
        };
        directions.iter().map(answer).collect()
    }

    /// Computes the velocity responses to unit impulses, with the deformations selected by `deformation`.
    /// If slave and master respond rigidly to an impulse, all deformations are included for this impulse.
    pub(super) fn impulse_responses_with(
        &mut self,
        inertia: &BandedLu<'_>,
        directions: &[ImpactDirection],
        deformation: Deformation,
    ) -> Result<Vec<ImpulseResponse>, LinearError> {
        if deformation == Deformation::All {
            return Ok(self.impulse_responses(inertia, directions));
        }
        let rigidity = Rigidity::of(self, deformation);
        let mut matrix = rigidity.matrix(self);
        let factors = matrix.factorise()?;
        let unknowns = self.unknowns();
        let mut answer = |direction: &ImpactDirection| {
            let mut forces = self.transmitted(*direction);
            let all = ImpulseResponse::of(inertia, unknowns, forces.clone(), Vec::new());
            let passed_on = rigidity.transmit_unit_impulse(self, &factors, &mut forces);
            let some = ImpulseResponse::of(inertia, unknowns, forces, passed_on);
            let gives = some.velocity(&some.rates) > GIVES * all.velocity(&all.rates);
            if gives { some } else { all }
        };
        Ok(directions.iter().map(&mut answer).collect())
    }

    /// Creates the impact problem for the given contact directions.
    /// The impact changes the velocity violation of each rigid link by `links` times the violation.
    /// With `links` equal to -2, the impact reverses the violations, and the links do no work.
    pub(super) fn impact_problem(
        &mut self,
        met: &[ImpactSelection<'_>],
        links: f64,
    ) -> Result<ImpactProblem, LinearError> {
        self.impact_problem_with_jumps(met, links, Vec::new())
    }

    fn impact_problem_with_jumps(
        &mut self,
        met: &[ImpactSelection<'_>],
        links: f64,
        jumps: Vec<f64>,
    ) -> Result<ImpactProblem, LinearError> {
        let mut inertia = self.banded_inertia();
        let inertia = inertia.factorise()?;
        let (mut directions, mut answers) = (Vec::new(), Vec::new());
        for (own, deformation) in met.iter().filter(|(own, _)| !own.is_empty()) {
            directions.extend_from_slice(own);
            answers.extend(self.impulse_responses_with(&inertia, own, *deformation)?);
        }
        let mut change = vec![0.0; self.unknowns()];
        if !jumps.is_empty() {
            let mut pulled = vec![0.0; self.degrees_of_freedom()];
            self.add_inertia(-1.0, &jumps, &mut pulled);
            change.copy_from_slice(&pulled[..self.unknowns()]);
        }
        let mut rates = self.motion.rates.clone();
        rates.iter_mut().zip(&jumps).for_each(|(rate, jump)| *rate += 0.5 * jump);
        if self.links.forces() > 0 {
            self.links.set_velocity_violation(&self.bodies, &rates, links, &mut change);
        }
        if self.links.forces() > 0 || !jumps.is_empty() {
            inertia.solve(&mut change);
        }
        let response = response(&answers);
        let before = answers.iter().map(|answer| answer.velocity(&rates)).collect();
        Ok(ImpactProblem { directions, responses: answers, response, before, change, jumps })
    }

    pub(super) fn apply(&mut self, problem: ImpactProblem, impulses: &[f64]) {
        let ImpactProblem { directions, responses: answers, mut change, jumps, .. } = problem;
        let most_passed_on = answers.iter().map(|answer| answer.transmitted.len()).max();
        let mut passed_on = vec![0.0; most_passed_on.unwrap_or(0)];
        let mut residual = vec![0.0; self.degrees_of_freedom()];
        for (impulse, ImpulseResponse { forces, rates, .. }) in impulses.iter().zip(&answers) {
            change.iter_mut().zip(rates).for_each(|(change, rate)| *change += impulse * rate);
            residual.iter_mut().zip(forces).for_each(|(out, force)| *out -= impulse * force);
        }
        for (impulse, answer) in impulses.iter().zip(&answers) {
            let own = passed_on.iter_mut().zip(&answer.transmitted);
            own.for_each(|(sum, passed)| *sum += impulse * passed);
        }
        change.extend(jumps.iter().skip(change.len()));
        // At supports, the momentum change minus the impulses of the contacts is the impulse of the supports.
        self.add_inertia(1.0, &change, &mut residual);
        self.links.transmit(&self.bodies, &change, &mut residual);
        for (unknown, roller) in self.links.rollers() {
            let (impulse, place) = (roller.force_of(change[unknown]), roller.place(&self.bodies));
            self.exchanged.total += WorkAndImpulse::of(0.0, impulse, cross(place, impulse));
        }
        let on_slaves = impulses.iter().zip(directions);
        let on_slaves = on_slaves.map(|(impulse, (slider, unit))| (slider, unit * *impulse));
        for (slider, impulse) in on_slaves.clone() {
            self.sliders[slider].impulse -= impulse.force;
        }
        self.add_impact_impulses(&change, &passed_on, on_slaves);
        // The entries for rigid links are impulses of the impact. They must not become forces of the next step.
        self.links.clear(&mut change);
        self.motion.jump(&change);
        self.elements.clear_rate_history();
        self.exchanged.total += self.supports.impact_exchange(&self.bodies, &residual);
        if self.supports.prescribed().count() > 0 {
            let mut mean_rates = self.motion.rates.clone();
            mean_rates.iter_mut().zip(&jumps).for_each(|(rate, jump)| *rate -= 0.5 * jump);
            let movements = self.supports.prescribed_mut();
            self.exchanged.total += movements.impact_exchange(&self.bodies, &residual, &mean_rates);
        }
    }

    /// Velocity responses to unit impulses in the given directions, one row per direction [1/mass].
    pub(in crate::system) fn responses_to(
        &self,
        directions: &[ImpactDirection],
    ) -> Result<Vec<Vec<f64>>, LinearError> {
        let mut inertia = self.banded_inertia();
        let answers = self.impulse_responses(&inertia.factorise()?, directions);
        Ok(response(&answers))
    }
}
