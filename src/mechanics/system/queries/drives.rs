//! Queries of drives, and of changes of prescribed motions and loads that the steps do not resolve.

use crate::system::System;
use crate::system::elements::{DriveState, MotionCurvature, UnsampledChange};

impl System {
    /// State of a drive of the scene.
    pub fn drive(&self, drive: usize) -> DriveState {
        self.supports().prescribed().state(drive)
    }

    pub(crate) fn drive_elsewhere(&self, load_factor: f64, time: f64) -> Option<(&str, [f64; 2])> {
        self.supports().prescribed().first_displaced_drive(load_factor, time)
    }

    /// Names of the drives whose prescribed motion has a jump of its rate within a step, with the largest jump of each drive.
    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        self.supports().prescribed().bends()
    }

    pub(crate) fn missed_changes(&self) -> impl Iterator<Item = (&str, UnsampledChange)> {
        let loads = self.elements().forces();
        let loads = loads.filter_map(|load| Some((load.name(), load.missed_change()?)));
        loads.chain(self.supports().prescribed().missed_changes())
    }
}
