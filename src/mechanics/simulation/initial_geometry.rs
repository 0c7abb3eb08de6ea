//! Properties of the initial configuration of a scene.

use std::cell::OnceCell;

use super::{Outline, Warning};
use crate::system::SystemError;

#[derive(Debug, Default)]
pub(super) struct InitialGeometry {
    outlines: OnceCell<Vec<Outline>>,
    lowest_period: OnceCell<Option<f64>>,
    pub(super) warnings: Vec<Warning>,
}

impl InitialGeometry {
    pub(super) fn outlines(
        &self,
        draw: impl FnOnce() -> Result<Vec<Outline>, SystemError>,
    ) -> Result<&[Outline], SystemError> {
        if let Some(outlines) = self.outlines.get() {
            return Ok(outlines);
        }
        let outlines = draw()?;
        Ok(self.outlines.get_or_init(|| outlines))
    }

    /// Period of the lowest natural mode in the initial configuration [time]; `None` without vibration.
    pub(super) fn lowest_period(&self, find: impl FnOnce() -> Option<f64>) -> Option<f64> {
        *self.lowest_period.get_or_init(find)
    }
}
