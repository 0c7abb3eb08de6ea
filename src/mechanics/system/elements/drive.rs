//! Prescribed motions of stations as functions of time.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::joints::Component;
use crate::loads::{PrescribedMotion, Schedule};

/// Type of a prescribed motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum DriveKind {
    /// Prescribed x position, y position or both of a station, as functions of time.
    Move,
    /// Prescribed angle of a section relative to the ground, as a function of time.
    Motor,
}

impl DriveKind {
    /// Name of the drive type for messages, such as `motor`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Move => "move",
            Self::Motor => "motor",
        }
    }
}

/// Prescribed motion of a station, with a function for each prescribed component.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Drive {
    /// Name of the drive in messages and columns.
    pub name: String,
    /// Type of the prescribed motion.
    pub kind: DriveKind,
    /// Station whose motion is prescribed.
    pub station: Station,
    /// Prescribed motions of x, y and the angle; `None` for a free component.
    /// Prescribed displacements are relative to the initial position.
    pub motions: [Option<PrescribedMotion>; 3],
}

impl Drive {
    /// Returns true if a component of the motion of the station is prescribed.
    pub fn drives(&self, component: Component) -> bool {
        self.motions[component as usize].is_some()
    }

    /// Prescribed components with their motions.
    pub fn motions(&self) -> impl Iterator<Item = (Component, &PrescribedMotion)> {
        let all = Component::ALL.into_iter().zip(&self.motions);
        all.filter_map(|(component, motion)| Some((component, motion.as_ref()?)))
    }

    /// Functions of time that the drive follows.
    pub fn schedules(&self) -> impl Iterator<Item = &Schedule> {
        self.motions().map(|(_, motion)| motion.schedule())
    }
}
