//! Words of the language that no table declares: keywords, and what arrays, texts and maps can do by themselves.

/// The keywords of the language.
pub const KEYWORDS: &[&str] = &[
    "let", "const", "fn", "if", "else", "switch", "while", "until", "loop", "do", "for", "in",
    "break", "continue", "return", "throw", "try", "catch", "import", "export", "as", "private",
    "true", "false", "this", "global",
];

/// Functions of the engine itself that a session needs, each with a line on what it does.
pub const FUNCTIONS: &[(&str, &str)] = &[
    ("print", "Writes a value and a line end."),
    ("debug", "Writes a value with the line that asked for it."),
    ("type_of", "The name of the type of a value."),
];

/// A member of an array, a text or a map: its name, how its arguments are written, what it does.
pub type BuiltIn = (&'static str, &'static str, &'static str);

const ARRAY: &[BuiltIn] = &[
    ("all", "(test)", "Whether all elements pass a test."),
    ("append", "(array)", "Adds the elements of another array."),
    ("clear", "()", "Takes all elements away."),
    ("contains", "(value)", "Whether a value is among the elements."),
    ("extract", "(start, [count])", "A part of it."),
    ("filter", "(test)", "The elements that pass a test."),
    ("index_of", "(value)", "Where a value is, -1 if nowhere."),
    ("insert", "(index, value)", "Adds an element in between."),
    ("is_empty", "()", "Whether it has no elements."),
    ("len", "()", "The number of elements."),
    ("map", "(function)", "A function of each element."),
    ("pop", "()", "Takes the last element away and gives it."),
    ("push", "(value)", "Adds an element at the end."),
    ("reduce", "(function, [start])", "All elements put together by a function."),
    ("remove", "(index)", "Takes an element away and gives it."),
    ("reverse", "()", "Turns the order round."),
    ("some", "(test)", "Whether an element passes a test."),
    ("sort", "([compare])", "Sorts the elements."),
];

const TEXT: &[BuiltIn] = &[
    ("contains", "(part)", "Whether a text is part of it."),
    ("ends_with", "(end)", "Whether it ends so."),
    ("index_of", "(part)", "Where a part begins, -1 if nowhere."),
    ("is_empty", "()", "Whether it has no letters."),
    ("len", "()", "The number of letters."),
    ("replace", "(part, other)", "Puts another text for a part."),
    ("split", "(separator)", "An array of its parts."),
    ("starts_with", "(start)", "Whether it begins so."),
    ("sub_string", "(start, [count])", "A part of it."),
    ("to_lower", "()", "The same in small letters."),
    ("to_upper", "()", "The same in capital letters."),
    ("trim", "()", "Takes spaces at both ends away."),
];

const MAP: &[BuiltIn] = &[
    ("clear", "()", "Takes all keys away."),
    ("contains", "(key)", "Whether it has a key."),
    ("is_empty", "()", "Whether it has no keys."),
    ("keys", "()", "An array of its keys."),
    ("len", "()", "The number of keys."),
    ("remove", "(key)", "Takes a key away and gives its value."),
    ("values", "()", "An array of its values."),
];

/// The members of values of an engine's own type, by the word for that type.
pub fn built_in(of: &str) -> &'static [BuiltIn] {
    match of {
        "array" => ARRAY,
        "text" => TEXT,
        "map" => MAP,
        _ => &[],
    }
}

/// Whether a word is a keyword.
pub fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_engine_has_what_is_offered() {
        let signatures = rhai::Engine::new().gen_fn_signatures(true);
        let known = |name: &str| {
            let opening = format!("{name}(");
            signatures.iter().any(|signature| signature.starts_with(&opening))
        };
        for of in ["array", "text", "map"] {
            for (name, ..) in built_in(of) {
                assert!(known(name), "{of}.{name}");
            }
        }
    }
}
