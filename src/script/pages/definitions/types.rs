//! The types of definition files: our words where they can be written as one name.

use std::fmt::Write;

use crate::script::rows::catalog::Catalog;
use crate::script::rows::kind::Kind;

/// Types of every script, by the words that messages use, with what the language server calls them.
const COMMON: &[(&str, &str, &str)] = &[
    ("whole number", "int", "A number without a fraction, of 64 bits."),
    ("number", "int | float", "A number; whole numbers are welcome."),
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

/// The definition file that declares all types of a language.
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

/// The name of a type of ours as one word.
pub fn identifier(words: &str) -> String {
    words.replace(' ', "_")
}

/// The type, in definition files, for what a parameter may be.
pub fn for_kind(kind: &Kind) -> String {
    match kind {
        Kind::Number(_) | Kind::Numeric => "number".into(),
        Kind::Whole(_) => "whole_number".into(),
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
        Kind::Anything => "?".into(),
    }
}

/// The type, in definition files, for the word before the dot of a function of Rhai.
pub fn for_receiver(word: &str) -> String {
    if word == "value" { "?".into() } else { identifier(word) }
}

/// The type, in definition files, for what a row says that it gives back: `a vector [force]` is a vector.
pub fn for_words(catalog: &Catalog, returns: &str) -> String {
    if returns.is_empty() {
        return "()".into();
    }
    if returns.starts_with("true or false") {
        return "truth_value".into();
    }
    if returns.starts_with("an angle") {
        return "number".into();
    }
    let noun = returns.trim_start_matches("an ").trim_start_matches("a ");
    let ours = catalog.tables().flat_map(|table| table.types).map(|of| of.name());
    let common = COMMON.iter().map(|(words, ..)| *words);
    // The longest: "sliding rule" before "sliding", "whole number" before "number".
    let known = ours.chain(common).filter(|name| begins_with_word(noun, name));
    known.max_by_key(|name| name.len()).map_or_else(|| "?".into(), identifier)
}

fn begins_with_word(text: &str, word: &str) -> bool {
    text.strip_prefix(word).is_some_and(|rest| {
        !rest.starts_with(|letter: char| letter.is_alphanumeric()) && !rest.starts_with(" or ")
    })
}
