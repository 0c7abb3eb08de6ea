//! Nouns in messages: articles and type names.

/// Adds the indefinite article to a noun, as in `a vector` or `an array`. A plural such as `knots` has no article.
pub fn with_article(noun: &str) -> String {
    // The noun before "of" or "with" determines the article, as in "a table of costs".
    let head =
        [" of ", " with "].iter().fold(noun, |head, of| head.split(of).next().unwrap_or(head));
    match noun.chars().next() {
        _ if head.ends_with('s') || head == "nothing" => noun.to_owned(),
        Some('a' | 'e' | 'i' | 'o' | 'A' | 'E' | 'I' | 'O') => format!("an {noun}"),
        _ => format!("a {noun}"),
    }
}

/// Name of a type in the language. The argument may be a Rust name as reported by the engine.
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
        value if value.ends_with("::VariantValue") => "value with derivatives",
        captured if captured.starts_with("alloc::rc::Rc<") => "variable from outside",
        other => other,
    }
}
