//! Releases of a scene.

use super::Scene;
use crate::joints::{Releasable, Release, Trigger};
use crate::system::SystemError;

impl Scene {
    /// Adds a release, which occurs during a run.
    ///
    /// # Errors
    /// Fails if the object does not exist or is already released, or if the time is not positive and finite.
    pub fn add_release(&mut self, release: Release) -> Result<(), SystemError> {
        let (kind, index, count) = match release.object {
            Releasable::Joint(index) => ("joint", index, self.joints.len()),
            Releasable::Slider(index) => ("slider", index, self.sliders.len()),
            Releasable::Spring(index) => ("spring", index, self.springs().count()),
            Releasable::Drive(index) => ("drive", index, self.drives.len()),
        };
        if index >= count {
            return Err(SystemError::Missing { object: "a release", kind, index, count });
        }
        let name = self.releasable_name(release.object);
        if self.releases.iter().any(|other| other.object == release.object) {
            return Err(SystemError::ReleasedTwice { name });
        }
        if let Trigger::Time(time) = release.trigger
            && !(time.is_finite() && time > 0.0)
        {
            return Err(SystemError::Value {
                object: format!("release of '{name}'"),
                name: "at",
                value: time,
                allowed: "a positive finite time",
            });
        }
        self.releases.push(release);
        Ok(())
    }

    /// Release times that are known before the run [time].
    pub fn release_times(&self) -> impl Iterator<Item = f64> {
        self.releases.iter().filter_map(|release| match release.trigger {
            Trigger::Time(time) => Some(time),
            Trigger::Outside => None,
        })
    }

    /// Name of a releasable object. Joints are named as in [`joint_names`](Self::joint_names).
    pub fn releasable_name(&self, hold: Releasable) -> String {
        let name = match hold {
            Releasable::Joint(index) => self.joint_names().into_iter().nth(index),
            Releasable::Slider(index) => self.sliders.get(index).map(|slider| slider.name.clone()),
            Releasable::Spring(index) => {
                self.springs().nth(index).map(|spring| spring.name.clone())
            }
            Releasable::Drive(index) => self.drives.get(index).map(|drive| drive.name.clone()),
        };
        name.unwrap_or_default()
    }

    /// Releasable objects (joints, sliders, springs, drives) with their names.
    pub fn releasables(&self) -> Vec<(String, Releasable)> {
        let joints = self.joint_names().into_iter().enumerate();
        let joints = joints.map(|(at, name)| (name, Releasable::Joint(at)));
        let sliders = self.sliders.iter().enumerate();
        let sliders = sliders.map(|(at, slider)| (slider.name.clone(), Releasable::Slider(at)));
        let springs = self.springs().enumerate();
        let springs = springs.map(|(at, spring)| (spring.name.clone(), Releasable::Spring(at)));
        let drives = self.drives.iter().enumerate();
        let drives = drives.map(|(at, drive)| (drive.name.clone(), Releasable::Drive(at)));
        joints.chain(sliders).chain(springs).chain(drives).collect()
    }
}
