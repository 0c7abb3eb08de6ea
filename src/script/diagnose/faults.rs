//! Errors of values: wrong type, out of bounds, too large.

use crate::script::messages::nouns::{type_word, with_article};

pub fn mismatch(wanted: &str, got: &str) -> (String, Option<String>) {
    let (wanted, got) = (type_word(wanted), type_word(got));
    let hint = match (wanted, got) {
        ("whole number", "number") => Some(
            "floor(x), round(x) and quotient(n, d) give whole numbers; a / b never does".into(),
        ),
        ("whole number", "range") => Some("array.extract(1..3) gives a piece of an array".into()),
        ("truth value", "number" | "whole number") => Some("a condition compares: x != 0".into()),
        ("truth value", "array") => Some("a condition compares: array.len > 0".into()),
        ("truth value", "text") => Some("a condition compares: text != \"\"".into()),
        ("truth value", "nothing") => Some(
            "a condition compares: x != (); does a function end without giving a value?".into(),
        ),
        _ => None,
    };
    (format!("expected {}, got {}", with_article(wanted), with_article(got)), hint)
}

pub fn bounds(what: &str, length: usize, index: i64) -> String {
    match length {
        0 => format!("there is nothing at index {index}: the {what} is empty"),
        _ => format!(
            "there is nothing at index {index}: the {what} has {length}, from 0 to {}",
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
    let told = what.to_lowercase();
    if told.starts_with("error parsing integer number") {
        let hint = "parse_float(text) reads numbers with a point, text.trim() takes blanks off";
        return (format!("the text \"{quoted}\" is not a whole number"), Some(hint.into()));
    }
    if told.starts_with("error parsing floating-point number") {
        let hint = "text.trim() takes blanks off, text.split(\",\") parts several numbers";
        return (format!("the text \"{quoted}\" is not a number"), Some(hint.into()));
    }
    if told.starts_with("invalid radix") {
        return (format!("numbers are read to a base from 2 to 36, got {quoted}"), None);
    }
    match told {
        what if what.contains("by zero") => ("a remainder by zero has no value".into(), None),
        what if what.contains("overflow") => (
            "the whole number is too large for 64 bits".into(),
            Some("write one of the numbers with a point: 2.0".into()),
        ),
        what => (what, None),
    }
}
