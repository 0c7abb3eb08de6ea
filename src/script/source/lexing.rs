//! Tokens of a script with their positions, as the engine's own lexer sees them (a volatile interface of Rhai).

use rhai::{Engine, Position, Token};

/// All tokens of `source`, comments left out. Text after a lexical error is lexed as well as it can be.
pub fn tokens(source: &str) -> Vec<(Token, Position)> {
    let engine = Engine::new_raw();
    let inputs = [source];
    let (stream, control) = engine.lex(&inputs);
    let mut depth = 0_usize;
    // Depths at which an interpolation `${ … }` was opened: its closing brace leads back into the text.
    let mut interpolations = Vec::new();
    let mut found = Vec::new();
    for (token, position) in stream {
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
        found.push((token, position));
    }
    found
}

/// The position where a comment begins that is never closed: Rhai would take the rest of the script for a part of it.
///
/// Only for a source that compiles: an open text would look the same.
pub fn open_comment(source: &str) -> Option<Position> {
    const PROBE: &str = "end_of_script";
    let probed = tokens(&format!("{source}\n{PROBE}"));
    let is_seen =
        matches!(probed.last(), Some((Token::Identifier(name), _)) if name.as_str() == PROBE);
    if is_seen {
        return None;
    }
    let before = &source[..source.rfind("/*")?];
    let column = before.chars().rev().take_while(|letter| *letter != '\n').count() + 1;
    let line = before.matches('\n').count() + 1;
    // The engine counts lines and columns no further.
    let counted = |number: usize| number.try_into().unwrap_or(u16::MAX);
    Some(Position::new(counted(line), counted(column)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_that_is_never_closed_is_found() {
        assert_eq!(open_comment("let a = 1;\n  /* lost"), Some(Position::new(2, 3)));
        assert!(open_comment(&"/*".repeat(100_000)).is_some());
        for closed in
            ["", "let a = 1; // end", "/* a /* b */ */ 1", "`text /* ${ 1 }`", "let t = \"/*\";"]
        {
            assert_eq!(open_comment(closed), None, "{closed}");
        }
    }

    #[test]
    fn interpolated_texts_do_not_confuse_the_lexer() {
        let names: Vec<_> = tokens("let a = `x ${ #{b: c}.b } / ${d} y`; e")
            .into_iter()
            .filter_map(|(token, _)| match token {
                Token::Identifier(name) => Some(name.to_string()),
                _ => None,
            })
            .collect();
        assert_eq!(names, ["a", "b", "c", "b", "d", "e"]);
    }
}
