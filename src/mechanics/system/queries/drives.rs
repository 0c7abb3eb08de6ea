//! Queries of drives, and of changes of prescribed motions and loads that the steps do not resolve.

use crate::system::System;
use crate::system::elements::{DriveState, MotionCurvature, StartMismatch, UnsampledChange};

impl System {
    /// State of a drive of the scene.
    pub fn drive(&self, drive: usize) -> DriveState {
        self.supports().prescribed().state(drive)
    }

    /// First drive or spring whose position or rest length in a static solution differs from its function of time just after `time`, with its name.
    pub(crate) fn first_start_mismatch(
        &self,
        load_factor: f64,
        time: f64,
    ) -> Option<(&str, StartMismatch)> {
        let mut springs = self.elements().resistances();
        let spring =
            || springs.find_map(|one| Some((one.name(), one.rest_motion()?.mismatch_at(time)?)));
        self.supports().prescribed().first_displaced_drive(load_factor, time).or_else(spring)
    }

    /// Names of the drives whose prescribed motion has a jump of its rate within a step, with the largest jump of each drive.
    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        self.supports().prescribed().bends()
    }

    pub(crate) fn missed_changes(&self) -> impl Iterator<Item = (&str, UnsampledChange)> {
        let loads = self.elements().forces();
        let loads = loads.filter_map(|load| Some((load.name(), load.missed_change()?)));
        let springs = self.elements().resistances();
        let springs = springs
            .filter_map(|spring| Some((spring.name(), spring.rest_motion()?.missed_change()?)));
        loads.chain(springs).chain(self.supports().prescribed().missed_changes())
    }
}
