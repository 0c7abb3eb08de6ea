//! Whether motions can be given as they are.

use super::Scene;
use super::ties::check_ties;
use crate::joints::Component;
use crate::loads::{LimitSide, PrescribedMotion};
use crate::system::SystemError;
use crate::system::elements::{Drive, SceneChecks};

/// By how much of its size a given motion may miss its start: what rounding makes of functions.
const CLOSED_AT_START: f64 = 1e-12;

/// By how much of its size and of where it is a given motion may differ on both sides of a place where it may jump.
const LARGEST_JUMP: f64 = 1e-9;

impl Scene {
    /// Gives a station a motion.
    ///
    /// # Errors
    /// When something of that name exists, the station is none of the scene, a movement is held or given already, or a motion has no value at its start,
    /// does not begin where the station is, or jumps.
    pub fn add_drive(&mut self, drive: Drive) -> Result<(), SystemError> {
        self.check_name(drive.kind.name(), &drive.name)?;
        self.check_station("a drive", &drive.station)?;
        if drive.drives(Component::Rotation) && !drive.station.turns() {
            let (object, by) = (drive.name, crate::system::Turning::Drive);
            return Err(SystemError::ParticleTurned { object, by });
        }
        for (component, motion) in drive.motions() {
            self.check_course(&drive, component, motion)?;
        }
        self.drives.push(drive);
        check_ties(self).inspect_err(|_| {
            self.drives.pop();
        })
    }

    fn check_course(
        &self,
        drive: &Drive,
        component: Component,
        motion: &PrescribedMotion,
    ) -> Result<(), SystemError> {
        let refused = |source| SystemError::DriveValue { drive: drive.name.clone(), source };
        let schedule = motion.schedule();
        let value = schedule.value(0.0, LimitSide::After).map_err(refused)?;
        motion.check_start().map_err(refused)?;
        let PrescribedMotion::Place(_) = motion else { return Ok(()) };
        let size = match component {
            Component::Rotation => 1.0,
            Component::X | Component::Y => self.length_at(&drive.station),
        };
        let (drive, component) = (|| drive.name.clone(), component.name());
        if value.abs() > CLOSED_AT_START * size {
            return Err(SystemError::DriveStart { drive: drive(), component, value });
        }
        for time in schedule.breaks() {
            let [before, after] =
                [LimitSide::Before, LimitSide::After].map(|side| schedule.value(time, side));
            let (before, after) = (before.map_err(refused)?, after.map_err(refused)?);
            let jump = after - before;
            if time >= 0.0 && jump.abs() > LARGEST_JUMP * (size + before.abs()) {
                return Err(SystemError::DriveJump { drive: drive(), component, time, jump });
            }
        }
        Ok(())
    }
}
