//! Friction of sliders: effective masses across their masters, and transitions from slip to stick.

use super::impact::{ImpactDirection, ImpactLaw};
use super::rigidity::Deformation;
use super::{Instant, System};
use crate::geometry::cross;
use crate::integrators::Mechanism;
use crate::linalg::LinearError;
use crate::system::SystemError;
use crate::system::state::InertiaSolver;

/// Largest velocity along the master at which a slider sticks at the start or after an impact, as a fraction of the largest velocity in the model.
const AT_REST: f64 = 1e-9;

impl System {
    pub(crate) fn has_friction(&self) -> bool {
        self.sliders.iter().any(|slider| slider.active_friction().is_some())
    }

    pub(in crate::system) fn choose_friction_modes(&mut self) {
        if !self.has_friction() {
            return;
        }
        let negligible = AT_REST * self.fastest_speed();
        let Self { sliders, bodies, motion, .. } = self;
        for slider in sliders.iter_mut() {
            slider.choose_friction_mode(bodies, &motion.rates, negligible);
        }
    }

    /// For every slider with friction, computes the effective mass across its master: the inverse of the relative velocity of slave and master
    /// that a unit impulse across the master causes. The effective mass is set to zero if this velocity is zero.
    pub(super) fn measure_inertia_across(&mut self) {
        let Ok(mut solver) = self.take_inertia_solver() else { return };
        let Self { sliders, bodies, .. } = self;
        for slider in sliders.iter_mut() {
            if slider.active_friction().is_none() {
                continue;
            }
            let across = slider.across(bodies);
            let velocity = solver.response(|forces| slider.transmit(bodies, across.into(), forces));
            let inertia = if velocity > 0.0 { 1.0 / velocity } else { 0.0 };
            slider.friction.iter_mut().for_each(|of| of.inertia_across = inertia);
        }
        self.step.inertia_solver = Some(solver);
    }

    /// Removes the inertia solver from the model and returns it, factorised for the present inertia matrix.
    /// The caller must put the solver back after use.
    pub(super) fn take_inertia_solver(&mut self) -> Result<Box<InertiaSolver>, LinearError> {
        let mut solver = self.step.inertia_solver.take().unwrap_or_else(|| {
            let (unknowns, half_bandwidth) = (self.unknowns(), self.half_bandwidth());
            Box::new(InertiaSolver::new(unknowns, half_bandwidth, self.degrees_of_freedom()))
        });
        // Without rigid links, the inertia matrix is constant.
        if !solver.is_factorised() || self.links.count() > 0 {
            solver.factorise(|inertia| self.fill_banded_inertia(inertia))?;
        }
        Ok(solver)
    }

    pub(super) fn start_overloaded_slips(&mut self, now: &Instant) -> bool {
        let mut starts = false;
        for at in 0..self.sliders.len() {
            let (along, force) = (self.sliders[at].along(&self.bodies), now.contact(at));
            starts |= self.sliders[at].slip_if_overloaded(along.dot(&force), cross(along, force));
        }
        starts
    }

    /// Starts the sticking of a slider. An impulse removes the remaining velocity along the master, and its work counts as lost energy.
    pub(crate) fn end_slip(&mut self, slider: usize) -> Result<(), SystemError> {
        self.sliders[slider].stick();
        self.stop_along(&[slider]).map_err(|_| self.sliders.overdetermined())
    }

    pub(crate) fn start_slip(&mut self, slider: usize) {
        self.sliders[slider].slip();
        self.motion.accelerations.mark_unknown();
    }

    pub(crate) fn end_reversed_slips(&mut self) -> Result<(), SystemError> {
        let is_reversed =
            |at: &usize| self.sliders[*at].is_slip_reversed(&self.bodies, &self.motion.rates);
        let reversed: Vec<usize> = (0..self.sliders.len()).filter(is_reversed).collect();
        if reversed.is_empty() {
            return Ok(());
        }
        reversed.iter().for_each(|at| self.sliders[*at].stick());
        self.stop_along(&reversed).map_err(|_| self.sliders.overdetermined())
    }

    fn stop_along(&mut self, stopping: &[usize]) -> Result<(), LinearError> {
        let along = stopping.iter().map(|&at| (at, self.sliders[at].along(&self.bodies).into()));
        let along: Vec<ImpactDirection> = along.collect();
        let problem = self.impact_problem(&[(&along, Deformation::All)], -2.0)?;
        let impulses = problem.impulses(&vec![ImpactLaw::Ends; along.len()])?;
        self.apply(problem, &impulses.values);
        for ((slider, _), work) in along.iter().zip(impulses.works()) {
            self.sliders[*slider].lost_energy -= work;
        }
        self.motion.accelerations.mark_unknown();
        Ok(())
    }
}
