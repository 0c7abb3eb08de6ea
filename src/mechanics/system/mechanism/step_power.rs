//! Powers of drives and loads over a step. They are accumulated if a sensor requests them.

use super::System;
use crate::system::elements::ExternalForce;

impl System {
    /// Enables the accumulation of powers over a step.
    pub(crate) fn sum_up_powers(&mut self) {
        self.exchanged.powers = Some(self.works().map(|work| [0.0, work]).collect());
    }

    /// Power of a drive over the last step: the mean of force times velocity and of moment times spin [energy/time]. `None` if not
    /// [enabled](Self::sum_up_powers).
    pub(in crate::system) fn power_of_drive(&self, drive: usize) -> Option<f64> {
        Some(self.exchanged.powers.as_ref()?[drive][0])
    }

    /// Power of a load over the last step [energy/time].
    pub(in crate::system) fn power_of_load(&self, load: usize) -> Option<f64> {
        self.power_of_drive(self.supports.prescribed().works().len() + load)
    }

    /// Sets the powers of drives to those of a step of zero length.
    pub(super) fn start_powers(&mut self) {
        let Some(powers) = &mut self.exchanged.powers else { return };
        for (drive, power) in self.supports.prescribed().powers(&self.motion.rates) {
            powers[drive][0] += power;
        }
    }

    pub(super) fn end_step_of_powers(&mut self, duration: f64) {
        let Some(mut powers) = self.exchanged.powers.take() else { return };
        for ([power, before], work) in powers.iter_mut().zip(self.works()) {
            (*power, *before) = ((work - *before) / duration, work);
        }
        self.exchanged.powers = Some(powers);
    }

    /// Works since the start of all drives and of all loads, of which only named ones have an account [energy].
    fn works(&self) -> impl Iterator<Item = f64> {
        let of_load = |load: &dyn ExternalForce| load.account().map_or(0.0, |account| account.work);
        self.supports.prescribed().works().chain(self.elements.forces().map(of_load))
    }
}
