//! Type names of definition files.

use std::fmt::Write;

use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::returns::ValueKind;

const COMMON: &[(&str, &str, &str)] = &[
    ("whole number", "int", "A whole number of 64 bits."),
    ("number", "int | float", "A number; whole numbers are accepted."),
    ("truth value", "bool", "true or false."),
    ("text", "String", "Text between quotes."),
    ("character", "char", "One character."),
    ("array", "Array", "[a, b, …]"),
    ("map", "Map", "#{ key: value, … }"),
    ("function", "FnPtr", "A function or closure, such as |t| 2 * t."),
    ("range", "Range<int>", "0..3"),
    ("timestamp", "Instant", "A time on the clock."),
    ("point", "vector | Array", "A vector or an array [x, y]."),
];

pub fn file(catalog: &Catalog) -> String {
    let mut text = String::from("module static;\n");
    for (words, meaning, doc) in COMMON {
        let _ = writeln!(text, "\n/// {doc}\ntype {} = {meaning};", identifier(words));
    }
    for of in catalog.tables().flat_map(|table| table.types) {
        let _ = writeln!(text, "\n/// {}\ntype {} = ?;", of.doc(), identifier(of.name()));
    }
    text
}

pub fn identifier(words: &str) -> String {
    words.replace(' ', "_")
}

pub fn for_kind(kind: &Kind) -> String {
    match kind {
        Kind::Number(_) | Kind::Numeric => "number".into(),
        Kind::Integer(_) => "whole_number".into(),
        Kind::Text | Kind::Name | Kind::Choice(_) => "text".into(),
        Kind::Boolean => "truth_value".into(),
        Kind::Point => "point".into(),
        Kind::Array | Kind::Numbers | Kind::Points => "array".into(),
        Kind::Function => "function".into(),
        Kind::Options(_) => "map".into(),
        Kind::Object(of) => identifier(of.name()),
        Kind::Either(kinds) => {
            let mut types: Vec<String> = kinds.iter().map(for_kind).collect();
            types.dedup();
            types.join(" | ")
        }
        Kind::Any => "?".into(),
    }
}

pub fn for_receiver(word: &str) -> String {
    if word == "value" { "?".into() } else { identifier(word) }
}

pub fn for_value(kind: &ValueKind) -> String {
    match (kind, kind.type_name()) {
        (ValueKind::Nothing, _) => "()".into(),
        (_, Some(name)) => identifier(name),
        (_, None) => "?".into(),
    }
}
