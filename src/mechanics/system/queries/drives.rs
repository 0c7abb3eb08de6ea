//! Looking at drives, and at loads with names: what they give, and their part of the ledger.

use crate::system::System;
use crate::system::elements::{DriveState, LoadAccount, MotionCurvature};

impl System {
    /// What the drives have given, in the order of the scene.
    pub fn drives(&self) -> impl Iterator<Item = DriveState<'_>> {
        self.supports().prescribed().states()
    }

    /// The first drive that rests under a part of the load at another place than that which its function has just after a time: its name, and both
    /// places [length, rad].
    pub fn drive_elsewhere(&self, load_factor: f64, time: f64) -> Option<(&str, [f64; 2])> {
        self.supports().prescribed().rests_elsewhere(load_factor, time)
    }

    /// The drives whose motion bends within a step, by name, each with its sharpest bend.
    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        self.supports().prescribed().bends()
    }

    /// What the loads with names have given, in the order of the scene.
    pub fn named_loads(&self) -> impl Iterator<Item = LoadAccount> {
        self.elements().forces().filter_map(|force| force.account())
    }
}
