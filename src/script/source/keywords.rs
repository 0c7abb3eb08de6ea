//! The keywords of the grammar; every other word of the language is in the catalogue of rows.

/// The keywords of the language, in the order in which one learns them: Rhai knows them one by one and gives no list.
pub const KEYWORDS: &[&str] = &[
    "let", "const", "fn", "if", "else", "switch", "while", "until", "loop", "do", "for", "in",
    "break", "continue", "return", "throw", "try", "catch", "import", "export", "as", "private",
    "true", "false", "this", "global",
];

/// Whether a word is a keyword.
pub fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::text::Source;

    #[test]
    fn the_engine_takes_them_for_no_names() {
        let is_name = |word: &str| Source::from(word).names().next().is_some();
        for word in KEYWORDS {
            // What stands before `::` is a name to the lexer, whatever it is.
            assert!(!is_name(word) || *word == "global", "{word}");
        }
        assert!(is_name("beam"));
    }
}
