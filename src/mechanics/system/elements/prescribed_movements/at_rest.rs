//! Prescribed movements at rest: their places at a time, which equilibria put on with their loads.

use std::borrow::Cow;

use super::PrescribedMovements;
use crate::geometry::larger;
use crate::loads::{LimitSide, LoadError, PrescribedMotion};

/// Places that differ by less than this, or this part of them, are one [length, rad; -].
const SAME_PLACE: f64 = 1e-12;

impl PrescribedMovements {
    /// Takes the places that are prescribed at a time, which equilibria put on with their loads.
    ///
    /// # Errors
    /// When a function has no finite value: the name of its drive, and why.
    pub fn hold_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        for (movement, present) in self.movements.iter().zip(&mut self.present) {
            if let PrescribedMotion::Place(schedule) = &movement.motion {
                present.goal = schedule
                    .value(time, LimitSide::After)
                    .map_err(|error| (self.drives[movement.drive].name.clone(), error))?;
            }
        }
        Ok(())
    }

    /// The first drive that rests under a part of the load at another place than that which its function has just after a time: its name, and both places.
    pub fn rests_elsewhere(&self, load_factor: f64, time: f64) -> Option<(&str, [f64; 2])> {
        self.movements.iter().zip(&self.present).find_map(|(movement, present)| {
            let PrescribedMotion::Place(schedule) = &movement.motion else { return None };
            // What has no value is refused when the scene is built, or when it is put on.
            let (rests, wanted) =
                (load_factor * present.goal, schedule.value(time, LimitSide::After).ok()?);
            let size = larger(wanted.abs(), rests.abs());
            let is_there = (rests - wanted).abs() <= SAME_PLACE * larger(1.0, size);
            let name = self.drives[movement.drive].name.as_str();
            (!is_there).then_some((name, [rests, wanted]))
        })
    }

    /// Whether something is prescribed that an equilibrium has to put on.
    pub fn moves_at_rest(&self) -> bool {
        self.present.iter().any(|present| present.goal != 0.0)
    }

    /// Movements at rest, those that are prescribed behind the unknown ones: from where they are to their places under a part of the load.
    pub fn at_rest<'m>(&self, movements: &'m [f64], load_factor: f64) -> Cow<'m, [f64]> {
        if self.movements.is_empty() {
            return Cow::Borrowed(movements);
        }
        let mut all = movements.to_vec();
        all.resize(self.first, 0.0);
        all.extend(self.present.iter().map(|now| load_factor * now.goal - now.placed));
        Cow::Owned(all)
    }

    /// Leaves what is prescribed where it is under a part of the load.
    pub fn place(&mut self, load_factor: f64) {
        for present in &mut self.present {
            present.placed = load_factor * present.goal;
        }
    }
}
