//! Validation of prescribed motions.

use super::Scene;
use super::ties::check_ties;
use crate::joints::Component;
use crate::loads::{DeclaredJump, LimitSide, PrescribedMotion};
use crate::system::SystemError;
use crate::system::elements::{Drive, SceneChecks};

/// Largest initial value of a prescribed displacement that counts as zero [rad], or as a fraction of the length of the body.
const CLOSED_AT_START: f64 = 1e-12;

impl Scene {
    /// Prescribes the motion of a station.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, the station does not exist, a particle would rotate, or a component is already supported or prescribed.
    /// Also fails if a motion is undefined or has an infinite rate at its start, does not start at the initial position of the station, or jumps.
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
        let PrescribedMotion::Position(_) = motion else { return Ok(()) };
        let size = match component {
            Component::Rotation => 1.0,
            Component::X | Component::Y => self.length_at(&drive.station),
        };
        let (drive, component) = (|| drive.name.clone(), component.name());
        if value.abs() > CLOSED_AT_START * size {
            return Err(SystemError::DriveStart { drive: drive(), component, value });
        }
        match motion.declared_jump(size).map_err(refused)? {
            Some(DeclaredJump { time, before, after }) => {
                let jump = after - before;
                Err(SystemError::DriveJump { drive: drive(), component, time, jump })
            }
            None => Ok(()),
        }
    }
}
