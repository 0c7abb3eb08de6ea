//! Queries of springs, dampers and brakes: elongations, forces and energies.

use crate::integrators::Mechanism;
use crate::system::System;
use crate::system::elements::{Branch, InternalForce, OutsideLaw, ShortBounce, SpringTrialState};

/// Relative rounding error of an elongation [-].
const ROUNDING: f64 = 1e-14;

/// State of a spring, a damper or a brake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringState {
    /// Length of the spring, not its change [length]; for a torsion spring, its angle [rad].
    pub elongation: f64,
    /// Mean force (positive in tension) or mean moment in the last step [force, force·length].
    /// For integrators with forces at the ends of steps, the field contains the force at the end of the step.
    pub force: f64,
    /// Stored energy of the spring [energy].
    pub stored: f64,
    /// Energy that the damper or the brake has dissipated since the start, including the stored energy of a released spring [energy].
    pub dissipated: f64,
}

impl System {
    /// States of all springs, dampers and brakes, in the order of the scene.
    pub fn springs(&self) -> impl Iterator<Item = SpringState> {
        self.elements().resistances().filter_map(|spring: &dyn InternalForce| {
            let SpringTrialState { elongation, force, .. } = spring.stretched()?;
            let (stored, dissipated) = (spring.stored(), spring.dissipated());
            Some(SpringState { elongation, force, stored, dissipated })
        })
    }

    /// Returns true if the force of at least one spring exceeds its rounding error.
    pub(crate) fn is_strung(&self) -> bool {
        let all = self.elements().resistances();
        all.filter_map(|one: &dyn InternalForce| one.stretched()).any(|spring| {
            spring.force.abs() > ROUNDING * (spring.stiffness * spring.elongation).abs()
        })
    }

    pub(crate) fn write_branches(&self, branches: &mut Vec<Branch>) {
        let all = self.elements().resistances();
        branches.clear();
        branches.extend(all.filter_map(|one| one.branch(self.bodies(), self.rates())));
    }

    pub(crate) fn short_bounces(&self) -> impl Iterator<Item = (&str, ShortBounce)> {
        self.elements().resistances().filter_map(|one| Some((one.name(), one.short_bounce()?)))
    }

    pub(crate) fn outside_laws(&self) -> Vec<(usize, OutsideLaw)> {
        let mut found = Vec::new();
        let all = self.elements().resistances().filter(|one| one.stretched().is_some());
        for (index, spring) in all.enumerate() {
            spring.each_outside_law(&mut |outside| found.push((index, outside)));
        }
        found
    }

    /// Name and present stiffness of the stiffest spring [force/length, force·length/rad].
    pub(crate) fn stiffest_spring(&self) -> Option<(&str, f64)> {
        let all = self.elements().resistances();
        let all = all.filter_map(|one| Some((one.name(), one.stretched()?.stiffness)));
        all.filter(|(_, stiffness)| *stiffness > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    pub(crate) fn most_damping(&self) -> Option<(&str, f64)> {
        let turned_over =
            |one: &dyn InternalForce| one.dissipated() + one.external_work().map_or(0.0, f64::abs);
        let all = self.elements().resistances().map(|one| (one.name(), turned_over(one)));
        all.filter(|(_, energy)| *energy > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Energies dissipated since the start by elements other than springs and dampers, in the order of the scene [energy].
    /// The dissipating elements are material damping, drag, contacts, impacts of sliders with restitution below 1, and friction.
    pub(crate) fn dissipations(&self) -> impl Iterator<Item = f64> {
        let others = self.elements().resistances().filter(|other| other.stretched().is_none());
        let losing = self.sliders().iter().filter(|slider| slider.dissipates());
        others.map(InternalForce::dissipated).chain(losing.map(|slider| slider.lost_energy))
    }
}
