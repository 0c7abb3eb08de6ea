//! Parsing of step sizes.

use rhai::Dynamic;

use crate::script::messages::numbers::as_number;
use crate::simulation::{StepControl, StepSize};

pub fn step_size(value: &Dynamic) -> Option<StepSize> {
    let fixed = as_number(value).filter(|dt| dt.is_finite() && *dt > 0.0);
    let control = || value.clone().try_cast::<StepControl>().map(StepSize::from);
    fixed.map(StepSize::from).or_else(control)
}

pub const STEP_SIZE: &str = "give positive numbers, or adaptive(#{ tolerance: 1e-4 })";
