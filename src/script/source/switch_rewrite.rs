//! What `switch` chooses by, handed to a judge: Rhai takes the default for whatever it cannot compare, without a word.
//!
//! A character of our own behind the word `switch` wraps the expression that follows; it is put into the text before it is parsed, in the place of a blank,
//! so that columns stay right; where there is none, what follows on the line seems to stand a column further right.

use rhai::{Dynamic, Engine, Position, Token};

use super::text::Lexeme;
use crate::script::messages::error::EngineResult;

/// The private-use character that wraps what `switch` chooses by.
pub const CHOICE: char = '\u{E007}';

/// The name of the wrapper for the parser.
pub const CHOICE_NAME: &str = "\u{E007}";

/// The letters of the word `switch`.
const WORD: usize = 6;

/// Teaches `engine` to hand what `switch` chooses by to a judge, which gives what is chosen by.
pub fn install(
    engine: &mut Engine,
    judge: impl Fn(&Engine, Dynamic, Position) -> EngineResult<Dynamic> + 'static,
) {
    engine.register_custom_syntax_with_state_raw(
        CHOICE_NAME,
        |symbols, _, _| Ok((symbols.len() == 1).then(|| "$expr$".into())),
        false,
        move |context, inputs, _| match inputs.first() {
            Some(expression) => {
                let value = context.eval_expression_tree(expression)?.flatten();
                judge(context.engine(), value, expression.position())
            }
            None => Ok(Dynamic::UNIT),
        },
    );
}

/// The places of the word `switch`.
pub fn words(tokens: &[Lexeme]) -> impl Iterator<Item = Position> + '_ {
    tokens.iter().filter(|(token, _)| matches!(token, Token::Switch)).map(|(_, at)| *at)
}

/// Puts the wrapper behind the word at `column`, from 0, of a line: in the place of a blank where there is one.
pub fn put(line: &mut Vec<char>, column: usize) {
    let behind = column + WORD;
    match line.get_mut(behind) {
        Some(blank @ (' ' | '\t')) => *blank = CHOICE,
        _ => line.insert(behind.min(line.len()), CHOICE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stay_where_there_is_a_blank() {
        let put_into = |text: &str| {
            let mut line: Vec<char> = text.chars().collect();
            put(&mut line, 0);
            line.into_iter().collect::<String>()
        };
        assert_eq!(put_into("switch x { }"), format!("switch{CHOICE}x {{ }}"));
        assert_eq!(put_into("switch(x) { }"), format!("switch{CHOICE}(x) {{ }}"));
        assert_eq!(put_into("switch"), format!("switch{CHOICE}"));
    }
}
