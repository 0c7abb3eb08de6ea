//! Queries of drives and named loads: work, forces and moments.

use crate::system::System;
use crate::system::elements::{DriveState, LoadAccount, MotionCurvature, UnsampledChange};

impl System {
    /// States of the drives, in the order of the scene.
    pub fn drives(&self) -> impl Iterator<Item = DriveState<'_>> {
        self.supports().prescribed().states()
    }

    /// Finds the first drive whose position under a fraction of the load differs from the value of its function just after a time.
    /// Returns the name of the drive and both positions [length, rad].
    pub(crate) fn drive_elsewhere(&self, load_factor: f64, time: f64) -> Option<(&str, [f64; 2])> {
        self.supports().prescribed().first_displaced_drive(load_factor, time)
    }

    /// Drives whose motion has a kink within a step, with the largest kink of each drive.
    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        self.supports().prescribed().bends()
    }

    /// Loads and drives whose schedule changes within a step between the samples, with the largest such change of each.
    pub(crate) fn missed_changes(&self) -> impl Iterator<Item = (&str, UnsampledChange)> {
        let loads = self.elements().forces();
        let loads = loads.filter_map(|load| Some((load.name(), load.missed_change()?)));
        loads.chain(self.supports().prescribed().missed_changes())
    }

    /// Work and values of the named loads, in the order of the scene.
    pub(crate) fn named_loads(&self) -> impl Iterator<Item = LoadAccount> {
        self.elements().forces().filter_map(|force| force.account())
    }
}
