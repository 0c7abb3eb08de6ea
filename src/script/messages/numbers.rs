//! Conversion of script values to numbers, and formats of numbers.

use rhai::{Array, Dynamic, Engine, INT, ImmutableString, Map};

use super::nouns::with_article;
pub(crate) use crate::output::format_number;
use crate::output::significant;

const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Converts a script value to a number; `None` unless it is a number or an integer.
pub fn as_number(value: &Dynamic) -> Option<f64> {
    value.as_float().ok().or_else(|| value.as_int().ok().map(|n| n as f64))
}

/// Converts a script value to an integer; `None` if it has a fractional part or another type, or is a float above 2^53.
pub fn as_integer(value: &Dynamic) -> Option<INT> {
    value.as_int().ok().or_else(|| {
        let x = value.as_float().ok()?;
        (x.fract() == 0.0 && x.abs() <= LARGEST_EXACT).then_some(x as INT)
    })
}

/// Formats a number with an exponent and `digits` decimals, as in `1.23e-13`.
pub fn format_scientific(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$e}") } else { format_number(x) }
}

/// Formats a number with `digits` decimals, as in `0.050`.
pub fn format_fixed(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$}") } else { format_number(x) }
}

/// Describes a script value for a message, as in `the text "abc"`, `-3` or `an array of 3`.
pub fn describe(engine: &Engine, value: &Dynamic) -> String {
    if let Ok(text) = value.as_immutable_string_ref() {
        return format!("the text {}", shortened(&text));
    }
    if let Some(x) = as_number(value) {
        return if value.is_int() { value.to_string() } else { six_digits(x) };
    }
    if let Ok(truth) = value.as_bool() {
        return truth.to_string();
    }
    if let Some(array) = value.read_lock::<Array>() {
        return format!("an array of {}", array.len());
    }
    if value.is::<Map>() {
        return "a map of options".into();
    }
    if value.is_unit() {
        return "nothing".into();
    }
    with_article(engine.map_type_name(value.type_name()))
}

fn six_digits(x: f64) -> String {
    let rounded = significant(x, 6);
    let is_misleading = x.fract() != 0.0 && rounded.parse().is_ok_and(|y: f64| y.fract() == 0.0);
    if is_misleading { format_number(x) } else { rounded }
}

fn shortened(text: &ImmutableString) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("\"{}…\"", &text[..end]),
        None => format!("\"{text}\""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_formatted_with_the_given_digits() {
        assert_eq!(format_scientific(1.234e-13, 2), "1.23e-13");
        assert_eq!(format_scientific(f64::NAN, 2), "nan");
        assert_eq!(format_fixed(0.05, 3), "0.050");
    }

    #[test]
    fn integral_numbers_are_accepted_as_integers() {
        assert_eq!(as_integer(&Dynamic::from(3.0)), Some(3));
        assert_eq!(as_integer(&Dynamic::from(3.5)), None);
        assert_eq!(as_integer(&Dynamic::from(1e300)), None);
        assert_eq!(as_number(&Dynamic::from(3_i64)), Some(3.0));
    }
}
