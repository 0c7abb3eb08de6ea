//! Looking at springs and dampers: what they measure, their forces, and their part of the ledger.

use crate::integrators::Mechanism;
use crate::system::System;
use crate::system::elements::{Branch, InternalForce, ShortBounce, SpringTrialState};

/// What a spring measures is right to this part of it.
const ROUNDING: f64 = 1e-14;

/// What a spring or a damper is in, in the present state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringState {
    /// What it measures: the length of its way [length], or of a torsion spring the angle [rad].
    pub elongation: f64,
    /// The force of the spring, positive where it pulls, or its moment; the mean of the last step, or of methods that take forces at the ends of steps that at
    /// its end [force, force·length].
    pub force: f64,
    /// The energy that it stores [energy].
    pub stored: f64,
    /// What it has dissipated since the start [energy].
    pub dissipated: f64,
}

impl System {
    /// The states of all springs and dampers, in the order of the scene.
    pub fn springs(&self) -> impl Iterator<Item = SpringState> {
        self.elements().resistances().filter_map(|spring: &dyn InternalForce| {
            let SpringTrialState { elongation, force, .. } = spring.stretched()?;
            let (stored, dissipated) = (spring.stored(), spring.dissipated());
            Some(SpringState { elongation, force, stored, dissipated })
        })
    }

    /// Whether a spring has a force, and not only the rounding of what it measures.
    pub fn is_strung(&self) -> bool {
        let all = self.elements().resistances();
        all.filter_map(|one: &dyn InternalForce| one.stretched()).any(|spring| {
            spring.force.abs() > ROUNDING * (spring.stiffness * spring.elongation).abs()
        })
    }

    /// What winds have given since the start, in the order of the scene [energy].
    pub fn works_of_wind(&self) -> impl Iterator<Item = f64> {
        self.elements().resistances().filter_map(InternalForce::wind_work)
    }

    /// Writes the branches on which the springs are whose laws have sharp corners, in the order of the scene, over what a list holds.
    pub fn write_branches(&self, branches: &mut Vec<Branch>) {
        let all = self.elements().resistances();
        branches.clear();
        branches.extend(all.filter_map(|one| one.branch(self.bodies(), self.rates())));
    }

    /// The springs on which a bounce lasted so few steps that they do not resolve it, by name.
    pub fn short_bounces(&self) -> impl Iterator<Item = (&str, ShortBounce)> {
        self.elements().resistances().filter_map(|one| Some((one.name(), one.short_bounce()?)))
    }

    /// The spring of the largest stiffness at present, by name [force/length, force·length/rad].
    pub fn stiffest_spring(&self) -> Option<(&str, f64)> {
        let all = self.elements().resistances();
        let all = all.filter_map(|one| Some((one.name(), one.stretched()?.stiffness)));
        all.filter(|(_, stiffness)| *stiffness > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What has dissipated most, or was given most by the wind, by name, and how much that is [energy].
    pub fn most_damping(&self) -> Option<(&str, f64)> {
        let turned_over =
            |one: &dyn InternalForce| one.dissipated() + one.wind_work().map_or(0.0, f64::abs);
        let all = self.elements().resistances().map(|one| (one.name(), turned_over(one)));
        all.filter(|(_, energy)| *energy > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What else has dissipated since the start, in the order of the scene: damping of materials, drag, blows of sliders that lose by them [energy].
    pub fn dissipations(&self) -> impl Iterator<Item = f64> {
        let others = self.elements().resistances().filter(|other| other.stretched().is_none());
        let losing = self.sliders().iter().filter(|slider| slider.restitution < 1.0);
        others.map(InternalForce::dissipated).chain(losing.map(|slider| slider.lost))
    }
}
