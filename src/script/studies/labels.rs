//! Short and unique labels for tables and legends of studies.

use crate::analysis::Deviation;
use crate::integrators::Method;
use crate::output::{Cell, format_number, scientific, significant};
use crate::simulation::{SimulationSettings, StepSize};

const STEP_DIGITS: usize = 6;
const LONGEST_REASON: usize = 100;
const ERROR_DIGITS: usize = 2;

/// Label of an integrator with its parameter: `energy_momentum`, `energy_decaying(0.1)`.
pub fn method(method: &Method) -> String {
    let parameter = method.parameter().map(|value| format!("({})", format_number(value)));
    format!("{}{}", method.entry().name, parameter.unwrap_or_default())
}

/// Label of a step size: `0.05`, or `tolerance 1e-4`.
pub fn step_size(settings: &SimulationSettings) -> String {
    match settings.dt {
        StepSize::Fixed(dt) => significant(dt, STEP_DIGITS),
        StepSize::Adaptive(control) => format!("tolerance {}", format_number(control.tolerance)),
    }
}

/// Label of an error: `3.4e-5`, or `≤ 2.1e-6` if it is only an upper bound.
pub fn deviation(deviation: Option<Deviation>) -> String {
    let Some(of) = deviation else { return "-".to_owned() };
    let text = scientific(of.error(), ERROR_DIGITS);
    match text == scientific(of.distance, ERROR_DIGITS) {
        true => text,
        false => format!("≤ {text}"),
    }
}

pub fn drift(drift: f64) -> String {
    if drift.is_nan() { "-".to_owned() } else { scientific(drift, ERROR_DIGITS) }
}

/// Label of a time [s], in milliseconds.
pub fn milliseconds(seconds: f64) -> String {
    significant(1e3 * seconds, 3)
}

pub fn number(text: String) -> Cell {
    Cell::Number(text)
}

pub fn first_sentence(text: &str) -> String {
    let ends = ["; ", ". ", "\n"].iter().filter_map(|end| text.find(end));
    let sentence = &text[..ends.min().unwrap_or(text.len())];
    if sentence.chars().count() <= LONGEST_REASON {
        return sentence.to_owned();
    }
    let kept: String = sentence.chars().take(LONGEST_REASON).collect();
    let whole_words = kept.rsplit_once(' ').map_or(kept.as_str(), |(words, _)| words);
    format!("{whole_words} …")
}

pub fn at_times(times: &[f64]) -> String {
    let times: Vec<String> = times.iter().map(|time| format_number(*time)).collect();
    format!("t = {}", times.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviation_label_is_a_bound_if_the_reference_is_inaccurate() {
        let label = |distance, trusted, is_of_own_run| {
            deviation(Some(Deviation { distance, estimated_error: trusted, is_of_own_run }))
        };
        assert_eq!(label(3.4e-5, 1e-9, true), "3.4e-5");
        assert_eq!(label(3.4e-5, 1e-5, true), "≤ 4.4e-5");
        assert_eq!(label(3.4e-5, 1e-5, false), "3.4e-5");
        assert_eq!(label(3.4e-5, 4e-5, false), "≤ 7.4e-5");
        assert_eq!((label(0.0, 0.0, true), deviation(None)), ("0".into(), "-".into()));
        assert_eq!(label(f64::NAN, 1.0, true), "nan");
    }

    #[test]
    fn failure_reason_is_cut_after_its_first_sentence() {
        assert_eq!(first_sentence("failed at t = 0.5: lost; try again"), "failed at t = 0.5: lost");
        assert_eq!(first_sentence("a step. And another"), "a step");
        let long = first_sentence(&"word ".repeat(60));
        assert!(long.ends_with("word …") && long.chars().count() <= LONGEST_REASON + 2, "{long}");
    }
}
