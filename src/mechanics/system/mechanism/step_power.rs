//! Powers of drives, loads and springs over a step, computed if a sensor requests them.

use super::System;
use crate::system::elements::{ExternalForce, InternalForce};

pub struct StepPower {
    /// Work in the last step divided by its duration [energy/time].
    /// Before the first step, the value is the instantaneous power for a drive, and zero for a load or a spring.
    pub power: f64,
    /// Work since the start of the run, at the end of the step [energy].
    pub work: f64,
}

impl System {
    pub(crate) fn enable_powers(&mut self) {
        let powers = self.works().map(|work| StepPower { power: 0.0, work });
        self.exchanged.powers = Some(powers.collect());
    }

    /// Power of a drive over the last step [energy/time]; `None` if powers are not enabled.
    pub(in crate::system) fn power_of_drive(&self, drive: usize) -> Option<f64> {
        Some(self.exchanged.powers.as_ref()?[drive].power)
    }

    pub(in crate::system) fn power_of_load(&self, load: usize) -> Option<f64> {
        self.power_of_drive(self.supports.prescribed().works().len() + load)
    }

    /// Power of an internal force over the last step [energy/time]. The order of powers is drives, loads, internal forces.
    pub(in crate::system) fn power_of_internal_force(&self, index: usize) -> Option<f64> {
        let before = self.supports.prescribed().works().len() + self.elements.forces().count();
        self.power_of_drive(before + index)
    }

    pub(super) fn initialise_powers(&mut self) {
        let Some(powers) = &mut self.exchanged.powers else { return };
        for (drive, power) in self.supports.prescribed().powers(&self.motion.rates) {
            powers[drive].power += power;
        }
    }

    pub(super) fn update_powers(&mut self, duration: f64) {
        let Some(mut powers) = self.exchanged.powers.take() else { return };
        for (step, work) in powers.iter_mut().zip(self.works()) {
            *step = StepPower { power: (work - step.work) / duration, work };
        }
        self.exchanged.powers = Some(powers);
    }

    fn works(&self) -> impl Iterator<Item = f64> {
        let of_load = |load: &dyn ExternalForce| load.account().map_or(0.0, |account| account.work);
        let of_spring = |spring: &dyn InternalForce| spring.external_work().unwrap_or(0.0);
        let of_elements = self.elements.forces().map(of_load);
        let of_springs = self.elements.resistances().map(of_spring);
        self.supports.prescribed().works().chain(of_elements).chain(of_springs)
    }
}
