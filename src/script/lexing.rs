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

#[cfg(test)]
mod tests {
    use super::*;

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
