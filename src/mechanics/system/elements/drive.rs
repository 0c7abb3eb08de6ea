//! Motions that a scene gives to stations, as functions of time.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::joints::Component;
use crate::loads::{PrescribedMotion, Schedule};

/// What gives a motion: what it is called, and what is told of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum DriveKind {
    /// Components of a station follow functions.
    Move,
    /// A section is turned from the ground.
    Motor,
}

impl DriveKind {
    /// What it is, in a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Move => "move",
            Self::Motor => "motor",
        }
    }
}

/// A motion of a station that is prescribed, component by component.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Drive {
    /// The name of the drive in messages and columns.
    pub name: String,
    /// What gives the motion.
    pub kind: DriveKind,
    /// The station whose motion is prescribed.
    pub station: Station,
    /// What is prescribed for x, y and the angle, as far as it is; displacements are counted from the place as drawn.
    pub motions: [Option<PrescribedMotion>; 3],
}

impl Drive {
    /// Whether a component of the station is prescribed.
    pub fn drives(&self, component: Component) -> bool {
        self.motions[component as usize].is_some()
    }

    /// Which of x, y and the angle are prescribed.
    pub fn prescribed(&self) -> [bool; 3] {
        Component::ALL.map(|component| self.drives(component))
    }

    /// The components that are prescribed, with what they do.
    pub fn motions(&self) -> impl Iterator<Item = (Component, &PrescribedMotion)> {
        let all = Component::ALL.into_iter().zip(&self.motions);
        all.filter_map(|(component, motion)| Some((component, motion.as_ref()?)))
    }

    /// The functions of time that it follows.
    pub fn schedules(&self) -> impl Iterator<Item = &Schedule> {
        self.motions().map(|(_, motion)| motion.schedule())
    }
}
