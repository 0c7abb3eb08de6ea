//! Check of the values of `switch`, because Rhai silently executes the default case for values that it cannot compare.
//! After the keyword `switch`, a private-use character is inserted, which the parser reads as a keyword that checks the value.

use rhai::{Dynamic, Engine, Position, Token};

use super::text::Lexeme;
use crate::script::messages::error::EngineResult;

/// Private-use character that is inserted after `switch` as a keyword that checks the value of the following expression.
pub const CHOICE: char = '\u{E007}';

pub const CHOICE_NAME: &str = "\u{E007}";

const WORD: usize = 6;

/// Registers the keyword. `judge` checks the value of the `switch` expression, and returns the value to be compared.
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

pub fn words(tokens: &[Lexeme]) -> impl Iterator<Item = Position> + '_ {
    tokens.iter().filter(|(token, _)| matches!(token, Token::Switch)).map(|(_, at)| *at)
}

/// Inserts [`CHOICE`] after the keyword at `column` of a line, counted from 0, in place of a blank if there is one.
pub fn insert_wrapper(line: &mut Vec<char>, column: usize) {
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
    fn inserted_wrapper_uses_a_blank_to_keep_columns() {
        let put_into = |text: &str| {
            let mut line: Vec<char> = text.chars().collect();
            insert_wrapper(&mut line, 0);
            line.into_iter().collect::<String>()
        };
        assert_eq!(put_into("switch x { }"), format!("switch{CHOICE}x {{ }}"));
        assert_eq!(put_into("switch(x) { }"), format!("switch{CHOICE}(x) {{ }}"));
        assert_eq!(put_into("switch"), format!("switch{CHOICE}"));
    }
}
