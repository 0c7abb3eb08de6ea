//! Nouns in messages: articles and type names.

pub use crate::system::with_article;

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
