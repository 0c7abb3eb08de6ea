//! Tokenisation by the lexer of the engine, whose interface may change in new versions of Rhai.

use rhai::{Engine, Token};

use super::text::Lexeme;

pub(super) struct Lexed {
    pub tokens: Vec<Lexeme>,
    /// True if the text ends inside a block comment.
    pub ends_in_comment: bool,
}

/// Tokenises `text`. Must be called only by [`Source`](super::text::Source), which caches the result.
pub(super) fn lex(text: &str) -> Lexed {
    #[cfg(test)]
    LEXINGS.set(LEXINGS.get() + 1);
    let engine = Engine::new_raw();
    let inputs = [text];
    let (mut stream, control) = engine.lex(&inputs);
    let mut depth = 0_usize;
    // Bracket depths of open interpolations `${ … }`, after whose closing brace the string literal continues.
    let mut interpolations = Vec::new();
    let mut tokens = Vec::new();
    for (token, position) in stream.by_ref() {
        match token {
            Token::EOF => break,
            Token::InterpolatedString(_) => interpolations.push(depth),
            Token::LeftBrace | Token::MapStart => depth += 1,
            Token::RightBrace => {
                depth = depth.saturating_sub(1);
                if interpolations.last() == Some(&depth) {
                    interpolations.pop();
                    control.borrow_mut().is_within_text = true;
                }
            }
            _ => (),
        }
        tokens.push((token, position));
    }
    Lexed { tokens, ends_in_comment: stream.state.comment_level > 0 }
}

#[cfg(test)]
thread_local! {
    static LEXINGS: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

#[cfg(test)]
pub fn lexings() -> usize {
    LEXINGS.get()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::text::name_of;

    #[test]
    fn names_in_interpolated_strings_are_lexed() {
        let found = lex("let a = `x ${ #{b: c}.b } / ${d} y`; e").tokens;
        let names: Vec<_> = found.iter().filter_map(|(token, _)| name_of(token)).collect();
        assert_eq!(names, ["a", "b", "c", "b", "d", "e"]);
    }
}
