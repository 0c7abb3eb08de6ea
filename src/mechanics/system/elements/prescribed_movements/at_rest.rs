//! Prescribed positions in statics, which are applied together with the loads of an equilibrium.

use std::borrow::Cow;

use super::PrescribedMovements;
use crate::loads::{LimitSide, LoadError, PrescribedMotion};
use crate::system::elements::StartMismatch;

impl PrescribedMovements {
    /// Evaluates the prescribed positions at a time. Static solutions apply the positions together with the loads.
    ///
    /// # Errors
    /// Returns the name of the drive whose function has no finite value, and the error of the function.
    pub fn evaluate_after(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        for (movement, present) in self.movements.iter().zip(&mut self.present) {
            if let PrescribedMotion::Position(schedule) = &movement.motion {
                present.goal = schedule
                    .value(time, LimitSide::After)
                    .map_err(|error| (self.drives[movement.drive].name.clone(), error))?;
            }
        }
        Ok(())
    }

    /// Finds the first drive whose position in a static solution differs from its prescribed position just after `time`.
    /// The position in the static solution is `load_factor` times the displacement of the drive under the full load.
    /// Returns the name of the drive and the difference; `None` if no positions differ.
    pub fn first_displaced_drive(
        &self,
        load_factor: f64,
        time: f64,
    ) -> Option<(&str, StartMismatch)> {
        self.movements.iter().zip(&self.present).find_map(|(movement, present)| {
            let PrescribedMotion::Position(schedule) = &movement.motion else { return None };
            // A function without a value has been rejected earlier: when the scene was built or when the position was applied.
            let (rests, wanted) =
                (load_factor * present.goal, schedule.value(time, LimitSide::After).ok()?);
            let name = self.drives[movement.drive].name.as_str();
            Some((name, StartMismatch::between(rests, wanted)?))
        })
    }

    pub fn has_positions(&self) -> bool {
        self.present.iter().any(|present| present.goal != 0.0)
    }

    pub fn at_rest<'m>(&self, movements: &'m [f64], load_factor: f64) -> Cow<'m, [f64]> {
        if self.movements.is_empty() {
            return Cow::Borrowed(movements);
        }
        let mut all = movements.to_vec();
        all.resize(self.first, 0.0);
        all.extend(self.present.iter().map(|now| load_factor * now.goal - now.placed));
        Cow::Owned(all)
    }

    pub fn accept_positions(&mut self, load_factor: f64) {
        for present in &mut self.present {
            present.placed = load_factor * present.goal;
        }
    }
}
