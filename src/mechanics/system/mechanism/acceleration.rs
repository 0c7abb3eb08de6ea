//! Accelerations of a mechanism, for integrators whose state contains accelerations.

use super::System;
use crate::integrators::Accelerated;

impl Accelerated for System {
    fn enable_accelerations(&mut self) {
        self.motion.accelerations.allocate(self.unknowns.count());
    }

    fn accelerations(&self) -> Option<&[f64]> {
        self.motion.accelerations.known().filter(|_| !self.step.jumps)
    }

    fn set_accelerations(&mut self, accelerations: &[f64]) {
        self.motion.accelerations.set(accelerations);
    }
}
