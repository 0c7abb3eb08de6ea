//! What things of a study are called in tables and legends: short, and no two the same.

use crate::analysis::Deviation;
use crate::integrators::Method;
use crate::output::{Cell, format_number, scientific, significant};
use crate::simulation::{Settings, StepSize};

/// The most digits of a step size.
const STEP_DIGITS: usize = 6;
/// Digits of an error.
const ERROR_DIGITS: usize = 2;

/// An integrator with its parameter: `energy_momentum`, `energy_decaying(0.1)`.
pub fn method(method: &Method) -> String {
    let parameter = method.parameter().map(|value| format!("({})", format_number(value)));
    format!("{}{}", method.entry().name, parameter.unwrap_or_default())
}

/// A step size: `0.05`, or `tolerance 1e-4`.
pub fn step_size(settings: &Settings) -> String {
    match settings.dt {
        StepSize::Fixed(dt) => significant(dt, STEP_DIGITS),
        StepSize::Adaptive(control) => format!("tolerance {}", format_number(control.tolerance)),
    }
}

/// An error: `3.4e-5`, or `≤ 2.1e-6` where the reference is not good enough to tell.
pub fn deviation(deviation: Option<Deviation>) -> String {
    match deviation {
        None => "-".to_owned(),
        Some(of) if of.is_resolved() || of.distance.is_nan() || of.trusted == 0.0 => {
            scientific(of.error(), ERROR_DIGITS)
        }
        Some(of) => format!("≤ {}", scientific(of.error(), ERROR_DIGITS)),
    }
}

/// A drift; a bar where there is none.
pub fn drift(drift: f64) -> String {
    if drift.is_nan() { "-".to_owned() } else { scientific(drift, ERROR_DIGITS) }
}

/// A time by the clock in milliseconds.
pub fn milliseconds(seconds: f64) -> String {
    significant(1e3 * seconds, 3)
}

/// A text that is set as a number.
pub fn number(text: String) -> Cell {
    Cell::Number(text)
}

/// The times in words: `t = 2.5, 7.5`.
pub fn at_times(times: &[f64]) -> String {
    let times: Vec<String> = times.iter().map(|time| format_number(*time)).collect();
    format!("t = {}", times.join(", "))
}
