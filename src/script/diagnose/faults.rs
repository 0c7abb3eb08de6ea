//! Errors of values, for example a wrong type, an index out of range, or a value that is too large.

use crate::script::messages::nouns::{type_word, with_article};

pub fn mismatch(wanted: &str, got: &str) -> (String, Option<String>) {
    let (wanted, got) = (type_word(wanted), type_word(got));
    let hint = match (wanted, got) {
        ("whole number", "number") => Some(
            "floor(x), round(x) and quotient(n, d) return whole numbers; a / b never does".into(),
        ),
        ("whole number", "range") => Some("array.extract(1..3) returns a part of an array".into()),
        ("truth value", "number" | "whole number") => {
            Some("use a comparison as condition: x != 0".into())
        }
        ("truth value", "array") => Some("use a comparison as condition: array.len > 0".into()),
        ("truth value", "text") => Some("use a comparison as condition: text != \"\"".into()),
        ("truth value", "nothing") => Some(
            "use a comparison as condition: x != (); if the value is from a function, it may \
            end without a value"
                .into(),
        ),
        _ => None,
    };
    (format!("expected {}, got {}", with_article(wanted), with_article(got)), hint)
}

pub fn bounds(what: &str, length: usize, index: i64) -> String {
    match length {
        0 => format!("there is no element at index {index}: the {what} is empty"),
        _ => format!(
            "there is no element at index {index}: the {what} has length {length}, indices 0 to {}",
            length - 1
        ),
    }
}

pub fn too_large(what: &str) -> String {
    match what.to_lowercase() {
        what if what.contains("string") => "the text is too long".into(),
        what if what.contains("map") => "the map is too large".into(),
        _ => "the array is too long".into(),
    }
}

pub fn arithmetic(what: &str) -> (String, Option<String>) {
    let quoted = what.split('\'').nth(1).unwrap_or_default();
    let message = what.to_lowercase();
    if message.starts_with("error parsing integer number") {
        let hint = "parse_float(text) reads numbers with a decimal point, text.trim() removes white \
            space";
        return (format!("the text \"{quoted}\" is not a whole number"), Some(hint.into()));
    }
    if message.starts_with("error parsing floating-point number") {
        let hint = "text.trim() removes white space, text.split(\",\") separates several numbers";
        return (format!("the text \"{quoted}\" is not a number"), Some(hint.into()));
    }
    if message.starts_with("invalid radix") {
        return (format!("the base of a number must be from 2 to 36, got {quoted}"), None);
    }
    match message {
        what if what.contains("by zero") => {
            ("the remainder of a division by zero is undefined".into(), None)
        }
        what if what.contains("overflow") => (
            "the whole number is too large for 64 bits".into(),
            Some("write one of the numbers with a decimal point: 2.0".into()),
        ),
        what => (what, None),
    }
}
