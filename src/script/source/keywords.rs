//! Keywords of the grammar. All other names of the language are in the catalog.

/// Keywords of the language, in the order in which they are taught. Rhai has no such list.
pub const KEYWORDS: &[&str] = &[
    "let", "const", "fn", "if", "else", "switch", "while", "until", "loop", "do", "for", "in",
    "break", "continue", "return", "throw", "try", "catch", "import", "export", "as", "private",
    "true", "false", "this", "global",
];

pub fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::text::Source;

    #[test]
    fn keywords_are_not_names_for_the_engine() {
        let is_name = |word: &str| Source::from(word).names().next().is_some();
        for word in KEYWORDS {
            assert!(!is_name(word) || *word == "global", "{word}");
        }
        assert!(is_name("beam"));
    }
}
