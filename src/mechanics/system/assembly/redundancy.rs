//! Check that the contact forces of sliders are unique. Redundant contacts have no unique forces.
//!
//! The check of contacts computes the velocities of slaves across their masters due to contact impulses.
//! If the matrix of the velocity responses is singular, some contact impulses have no effect, and the contact forces are not unique.

use crate::system::errors::SliderError;
use crate::system::{Scene, System, SystemError};

/// Largest ratio of a pivot of the Cholesky factorisation to its diagonal entry that is attributed to rounding [-].
const ROUNDING_PIVOT: f64 = 1e-13;

/// Largest velocity response of a slider to a unit impulse that counts as zero, as a multiple of the inverse total mass.
const NO_RESPONSE: f64 = 1e-26;

impl System {
    pub(super) fn check_determined(&self, scene: &Scene) -> Result<(), SystemError> {
        let across = self.across();
        let Ok(response) = self.responses_to(&across) else {
            return Err(self.sliders().overdetermined());
        };
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(response.len());
        for (row_at, response) in response.iter().enumerate() {
            let own = response[row_at];
            let slider = across[row_at].0;
            if own * self.total_mass() <= NO_RESPONSE {
                let parts = scene.parts(&scene.sliders[slider]);
                return Err(SliderError::OverConstrained(parts).into());
            }
            let mut row: Vec<f64> = Vec::with_capacity(row_at + 1);
            for (other, before) in rows.iter().enumerate() {
                let sum: f64 = row.iter().zip(before).map(|(a, b)| a * b).sum();
                row.push((response[other] - sum) / before[other]);
            }
            let left = own - row.iter().map(|entry| entry * entry).sum::<f64>();
            if left <= ROUNDING_PIVOT * own {
                let takes_part =
                    |(_, entry): &(usize, &f64)| *entry * *entry > ROUNDING_PIVOT * own;
                let others =
                    row.iter().enumerate().filter(takes_part).map(|(other, _)| across[other].0);
                let mut sliders: Vec<usize> = others.chain([slider]).collect();
                sliders.dedup();
                let names = sliders.iter().map(|at| scene.sliders[*at].name.as_str());
                let sliders = names.collect::<Vec<_>>().join("', '");
                return Err(SliderError::Overdetermined { sliders }.into());
            }
            row.push(left.sqrt());
            rows.push(row);
        }
        Ok(())
    }
}
