//! Underlined locations computed from positions reported by the engine.

use std::sync::Arc;

use rhai::{Position, Token};

use super::Location;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::table::CallSyntax;
use crate::script::messages::error::CallPart;
use crate::script::source::definitions::{closing, nesting};
use crate::script::source::program::Program;
use crate::script::source::text::Lexeme;

/// Token at `position`; `None` if the engine gave no position.
pub fn word_at(program: &Program, position: Position) -> Option<Location> {
    let line = position.line()?;
    let column = position.position().unwrap_or(1);
    Some(location(program, line, column, word_length(program, line, column)))
}

pub fn text_before(program: &Program, position: Position) -> &str {
    let end = program.offset(position.line().unwrap_or(1), position.position().unwrap_or(1));
    &program.text[..end]
}

/// Location of the end of `text`, which is a prefix of the script, for errors about missing tokens.
pub fn end_of(program: &Program, text: &str) -> Location {
    let text = text.trim_end();
    let line = text.lines().count().max(1);
    let column = text.lines().last().map_or(0, |last| last.chars().count()) + 1;
    location(program, line, column, 1)
}

/// Location of the part of a call to which an error refers; if it is not found, of the function name.
pub fn part_of_call(
    program: &Program,
    catalog: &Catalog,
    position: Position,
    place: &CallPart,
) -> Option<Location> {
    let found = match place {
        CallPart::Call => None,
        CallPart::Argument(number) => argument_of(program, catalog, position, *number),
        CallPart::ArgumentOfMethod(number) => {
            inside_call(program, position).and_then(|(call, _)| argument(program, call, *number))
        }
        CallPart::Key(key) => key_of_call(program, position, key),
    };
    found.or_else(|| word_at(program, position))
}

fn location(program: &Program, line: usize, column: usize, length: usize) -> Location {
    Location { program: Arc::new(program.clone()), line, column, length }
}

fn word_length(program: &Program, line: usize, column: usize) -> usize {
    let rest = &program.text[program.offset(line, column)..];
    let rest = rest.lines().next().unwrap_or_default();
    let in_word = |c: char| c.is_alphanumeric() || c == '_';
    let length = match rest.chars().next() {
        Some('"') => rest.chars().skip(1).take_while(|c| *c != '"').count() + 2,
        Some(c) if in_word(c) => rest.chars().take_while(|c| in_word(*c)).count(),
        Some(c) if "<>=!*&|".contains(c) => {
            rest.chars().take_while(|c| "<>=!*&|".contains(*c)).count()
        }
        _ => 1,
    };
    length.min(rest.chars().count()).max(1)
}

fn inside_call(program: &Program, position: Position) -> Option<(&[Lexeme], bool)> {
    let tokens = program.text.tokens();
    let called = tokens.iter().position(|(_, at)| *at == position)?;
    let dotted = called > 0 && matches!(tokens[called - 1].0, Token::Period | Token::Elvis);
    let opening = called + 1;
    if !matches!(tokens.get(opening)?.0, Token::LeftParen) {
        return None;
    }
    let call = &tokens[opening..closing(tokens, opening)];
    let is_closed = call.iter().map(|(token, _)| nesting(token)).sum::<isize>() == 0;
    is_closed.then_some((call, dotted))
}

fn argument_of(
    program: &Program,
    catalog: &Catalog,
    position: Position,
    number: usize,
) -> Option<Location> {
    let (call, dotted) = inside_call(program, position)?;
    let called = word_at(program, position)?;
    let is_function =
        catalog.named(called.text()).any(|row| matches!(row.form, CallSyntax::Function));
    // In `a.norm()`, the first argument of the function, `a`, is before the dot.
    let number = if dotted && is_function { number.checked_sub(1)? } else { number };
    argument(program, call, number)
}

fn argument(program: &Program, call: &[Lexeme], number: usize) -> Option<Location> {
    let mut depth = 0;
    let mut seen = 0;
    let mut start = None;
    for (token, at) in call {
        let at_end = depth == 1 && (matches!(token, Token::Comma) || nesting(token) < 0);
        if at_end && let Some(start) = start {
            return span(program, start, *at);
        }
        if at_end {
            seen += 1;
        } else if start.is_none() && depth >= 1 && seen == number {
            start = Some(*at);
        }
        depth += nesting(token);
    }
    None
}

/// Location of an argument from `start` to the separator at `end`, without trailing blanks, or of its first token if it has several lines.
fn span(program: &Program, start: Position, end: Position) -> Option<Location> {
    let (line, column) = (start.line()?, start.position()?);
    if end.line()? != line {
        return word_at(program, start);
    }
    let text = &program.text[program.offset(line, column)..program.offset(line, end.position()?)];
    Some(location(program, line, column, text.trim_end().chars().count().max(1)))
}

fn key_of_call(program: &Program, position: Position, key: &str) -> Option<Location> {
    let (call, _) = inside_call(program, position)?;
    let mut pairs = call.iter().zip(call.iter().skip(1));
    let (_, at) = pairs.find_map(|(this, next)| match (&this.0, &next.0) {
        (Token::Identifier(name), Token::Colon) if name.as_str() == key => Some(this),
        (Token::StringConstant(name), Token::Colon) if name.as_str() == key => Some(this),
        _ => None,
    })?;
    word_at(program, *at)
}
