//! Step sizes as scripts write them.

use rhai::Dynamic;

use crate::script::messages::numbers::as_number;
use crate::simulation::{StepControl, StepSize};

/// The step size that a value stands for: a positive number, or adaptive(…); none when it is something else.
pub fn step_size(value: &Dynamic) -> Option<StepSize> {
    let fixed = as_number(value).filter(|dt| dt.is_finite() && *dt > 0.0);
    let control = || value.clone().try_cast::<StepControl>().map(StepSize::from);
    fixed.map(StepSize::from).or_else(control)
}

/// The advice on how a step size is written.
pub const STEP_SIZE: &str = "give positive numbers, or adaptive(#{ tolerance: 1e-4 })";
