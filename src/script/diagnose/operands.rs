//! Errors of operators whose operands have unsupported types.

use crate::script::messages::nouns::with_article;

pub fn explain(symbol: &str, types: &[&str]) -> (String, Option<String>) {
    let words: Vec<_> = types.iter().map(|name| with_article(name)).collect();
    let message = match (symbol, words.as_slice()) {
        ("<" | ">" | "<=" | ">=" | "==" | "!=", [left, right]) => {
            format!("cannot compare {left} with {right} using {symbol}")
        }
        (_, [left, right]) => format!("{symbol} does not work on {left} and {right}"),
        (_, [operand]) => format!("{symbol} does not work on {operand}"),
        _ => format!("{symbol} does not work here"),
    };
    (message, hint(symbol, types).map(str::to_owned))
}

fn hint(symbol: &str, types: &[&str]) -> Option<&'static str> {
    let has = |name: &str| types.contains(&name);
    let has_number = types.iter().any(|name| name.ends_with("number"));
    let orders = matches!(symbol, "<" | ">" | "<=" | ">=");
    match symbol {
        _ if orders && has("truth value") => {
            Some("write a comparison for each side: 1 < x && x < 3")
        }
        "+" | "-" | "*" | "/" | "^"
            if has("array")
                && (has_number || has("vector") || types.iter().all(|name| *name == "array")) =>
        {
            Some(OF_ARRAYS)
        }
        "*" if has("text") && has_number => Some(
            "text.pad(10, \"ab\") extends a text; parse_float(text) converts a text to a number",
        ),
        _ if has("text") && has_number => Some("parse_float(text) converts a text to a number"),
        "!" => Some("! negates true or false; write x == 0 for a number"),
        _ if has("nothing") => Some(
            "one of the values is nothing: a function may end with a semicolon, or a variable \
            may have no value",
        ),
        _ if has("function") => Some("call a function in a variable by f.call(x)"),
        _ => None,
    }
}

const OF_ARRAYS: &str = "points are vectors: vec(1, 2) - [1, 0] and 2 * vec(1, 2) work; numbers.map(|x| 2 * x) works on each \
     element of an array";
