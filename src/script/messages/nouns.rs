//! Nouns in messages: their articles, and the names of types.

/// A noun with its article: `a vector`, `an array`; plurals such as `knots` have none.
pub fn with_article(noun: &str) -> String {
    // Of a table of costs there is one, and of a value with derivatives.
    let head =
        [" of ", " with "].iter().fold(noun, |head, of| head.split(of).next().unwrap_or(head));
    match noun.chars().next() {
        _ if head.ends_with('s') => noun.to_owned(),
        Some('a' | 'e' | 'i' | 'o' | 'A' | 'E' | 'I' | 'O') => format!("an {noun}"),
        _ => format!("a {noun}"),
    }
}

/// The word of the language for a type, also where the engine used the Rust name.
pub fn type_word(name: &str) -> &str {
    match name.trim() {
        "i64" => "whole number",
        "f64" => "number",
        "bool" => "truth value",
        "char" => "character",
        "string" | "String" | "ImmutableString" | "&str | ImmutableString | String" => "text",
        "array" => "array",
        "Fn" | "FnPtr" => "function",
        "()" => "nothing",
        range if range.starts_with("core::ops::range::Range") => "range",
        varied if varied.ends_with("::Varied") => "value with derivatives",
        captured if captured.starts_with("alloc::rc::Rc<") => "variable from outside",
        other => other,
    }
}
