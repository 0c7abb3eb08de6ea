//! Text of a script with cached tokens.
//! The parser of Rhai does not accept tokens, so it tokenises the text again, with the replacements of [`syntax`](super::syntax).

use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use rhai::{Position, Token};

use super::lexing::{Lexed, lex};

pub type Lexeme = (Token, Position);

/// Source text. Clones share the text and its tokens.
#[derive(Clone)]
pub struct Source(Arc<SourceData>);

struct SourceData {
    text: Box<str>,
    lexed: OnceLock<Lexed>,
}

impl Source {
    /// Tokens of the text without comments. After a lexical error, tokens are included as far as they can be recognised.
    pub fn tokens(&self) -> &[Lexeme] {
        &self.lexed().tokens
    }

    /// Position of an unclosed block comment, after which Rhai would silently ignore the rest of the script.
    pub fn open_comment(&self) -> Option<Position> {
        if !self.lexed().ends_in_comment {
            return None;
        }
        let before = &self[..self.rfind("/*")?];
        let column = before.chars().rev().take_while(|letter| *letter != '\n').count() + 1;
        Some(position(before.matches('\n').count() + 1, column))
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.tokens().iter().filter_map(|(token, _)| name_of(token))
    }

    /// Paths of the imports; `None` for a path that is not a string literal.
    pub fn imports(&self) -> impl Iterator<Item = Option<&str>> {
        let tokens = self.tokens();
        let starts = (0..tokens.len()).filter(|index| matches!(tokens[*index].0, Token::Import));
        starts.map(|import| match tokens.get(import + 1) {
            Some((Token::StringConstant(path), _)) => Some(path.as_str()),
            _ => None,
        })
    }

    pub fn ends_in_semicolon(&self) -> bool {
        matches!(self.tokens().last(), Some((Token::SemiColon, _)))
    }

    /// Byte offset of a line and column, both counted from 1. Columns are counted in characters.
    pub fn offset(&self, line: usize, column: usize) -> usize {
        let mut start = 0;
        for (index, text) in self.split_inclusive('\n').enumerate() {
            if index + 1 == line {
                let inside =
                    text.char_indices().nth(column.saturating_sub(1)).map(|(offset, _)| offset);
                return start + inside.unwrap_or(text.trim_end_matches(['\n', '\r']).len());
            }
            start += text.len();
        }
        self.len()
    }

    pub fn offset_of(&self, (_, at): &Lexeme) -> usize {
        self.offset(at.line().unwrap_or(1), at.position().unwrap_or(1))
    }

    fn lexed(&self) -> &Lexed {
        self.0.lexed.get_or_init(|| lex(self))
    }
}

pub fn name_of(token: &Token) -> Option<&str> {
    match token {
        Token::Identifier(name) => Some(name.as_str()),
        _ => None,
    }
}

/// Position in the form of the engine, with lines and columns up to 65 535.
pub fn position(line: usize, column: usize) -> Position {
    let counted = |number: usize| number.try_into().unwrap_or(u16::MAX);
    Position::new(counted(line), counted(column))
}

pub fn moved_down(at: Position, lines: usize) -> Position {
    match (at.line(), at.position()) {
        (Some(line), column) if lines > 0 => position(line + lines, column.unwrap_or(1)),
        _ => at,
    }
}

impl Deref for Source {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0.text
    }
}

impl<T: Into<Box<str>>> From<T> for Source {
    fn from(text: T) -> Self {
        Self(Arc::new(SourceData { text: text.into(), lexed: OnceLock::new() }))
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

impl PartialEq for Source {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

#[cfg(test)]
mod tests {
    use super::super::lexing::lexings;
    use super::*;

    fn source(text: &str) -> Source {
        Source::from(text)
    }

    #[test]
    fn copies_of_a_source_are_lexed_once_on_demand() {
        let before = lexings();
        let text = source("let a = b; import \"std/checks\" as c;");
        let copy = text.clone();
        assert_eq!(lexings(), before);
        assert_eq!(copy.names().collect::<Vec<_>>(), ["a", "b", "c"]);
        assert_eq!(text.imports().collect::<Vec<_>>(), [Some("std/checks")]);
        assert!(text.ends_in_semicolon() && copy.open_comment().is_none());
        assert_eq!(lexings(), before + 1);
    }

    #[test]
    fn unclosed_comments_are_found() {
        let open = |text: &str| source(text).open_comment();
        assert_eq!(open("let a = 1;\n  /* lost"), Some(Position::new(2, 3)));
        assert!(open(&"/*".repeat(100_000)).is_some());
        for closed in
            ["", "let a = 1; // end", "/* a /* b */ */ 1", "`text /* ${ 1 }`", "let t = \"/*\";"]
        {
            assert_eq!(open(closed), None, "{closed}");
        }
    }

    #[test]
    fn positions_are_shifted_by_preceding_lines() {
        assert_eq!(moved_down(Position::new(2, 3), 10), Position::new(12, 3));
        assert_eq!(moved_down(Position::NONE, 10), Position::NONE);
        assert_eq!(source("ab\nξc").offset(2, 2), "ab\nξ".len());
    }
}
