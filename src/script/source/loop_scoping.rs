//! New loop variables in every iteration of a `for` loop, so that a closure captures the values of its iteration.
//!
//! In Rhai, all iterations share one variable, so that all closures would see its last value.
//! If a closure in the body uses the loop variable, a statement that declares it again is inserted into the text.
//! The statement replaces up to two blanks around the opening brace; with fewer blanks, the rest of the line is shifted.

use rhai::{Dynamic, Engine, EvalContext, Position, Token};

use super::definitions::{closing, nesting};
use super::text::{Lexeme, name_of};

/// Private-use character at the start of the body of a loop with one variable, as in `for x in xs`, in the rewritten text of a script.
/// It stands for a statement that declares the loop variable again, so that a closure captures its value of this iteration.
pub const ONE: char = '\u{E003}';
/// Private-use character at the start of the body of a loop with a counter, as in `for (x, i) in xs`, in the rewritten text of a script.
/// It stands for a statement that declares both loop variables again, so that a closure captures their values of this iteration.
pub const TWO: char = '\u{E004}';

pub const ONE_NAME: &str = "\u{E003}";
pub const TWO_NAME: &str = "\u{E004}";

pub fn install(engine: &mut Engine) {
    for (name, variables) in [(ONE_NAME, 1), (TWO_NAME, 2)] {
        engine.register_custom_syntax_with_state_raw(
            name,
            |_, _, _| Ok(None),
            true,
            move |context, _, _| {
                declare_again(context, variables);
                Ok(Dynamic::UNIT)
            },
        );
    }
}

fn declare_again(context: &mut EvalContext, variables: usize) {
    let scope = context.scope_mut();
    let names: Vec<String> =
        scope.iter_raw().take(variables).map(|(name, _, _)| name.to_owned()).collect();
    for name in names {
        let value = scope.get_mut(&name).map(std::mem::take).unwrap_or_default();
        scope.push_dynamic(name, value);
    }
}

/// Positions of the opening braces of the loop bodies in which a declaration is inserted.
/// Each position has the private-use character [`ONE`] or [`TWO`], which stands for the declaration in the rewritten text.
pub fn bodies(tokens: &[Lexeme]) -> Vec<(Position, char)> {
    let loops = tokens.iter().enumerate().filter(|(_, (token, _))| matches!(token, Token::For));
    loops.filter_map(|(start, _)| body(tokens, start)).collect()
}

fn body(tokens: &[Lexeme], start: usize) -> Option<(Position, char)> {
    let token = |index: usize| tokens.get(index).map(|(token, _)| token);
    let name = |index: usize| token(index).and_then(name_of);
    let (names, after) = match token(start + 1)? {
        Token::LeftParen => (vec![name(start + 2)?, name(start + 4)?], start + 6),
        _ => (vec![name(start + 1)?], start + 2),
    };
    let open = opening(tokens, after)?;
    let close = closing(tokens, open);
    let is_closure = |(token, _): &Lexeme| matches!(token, Token::Pipe | Token::Or);
    let closure = open + tokens[open..close].iter().position(is_closure)?;
    let is_captured = tokens[closure..close]
        .iter()
        .any(|(token, _)| name_of(token).is_some_and(|name| names.contains(&name)));
    let letter = if names.len() == 1 { ONE } else { TWO };
    is_captured.then_some((tokens[open].1, letter))
}

fn is_interpolation(tokens: &[Lexeme], index: usize) -> bool {
    matches!(tokens.get(index.wrapping_sub(1)), Some((Token::InterpolatedString(_), _)))
}

/// Index of the brace that opens the body of a loop. `after` is the index of the keyword `in`.
/// The result is `None` if there is no such brace, or if the expression after `in` contains `if`, `switch` or a closure outside of brackets.
fn opening(tokens: &[Lexeme], after: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (index, (token, _)) in tokens.iter().enumerate().skip(after) {
        match token {
            Token::LeftBrace if depth == 0 && !is_interpolation(tokens, index) => {
                return Some(index);
            }
            Token::If | Token::Switch | Token::Pipe | Token::Or if depth == 0 => return None,
            other => depth = depth.checked_add_signed(nesting(other))?,
        }
    }
    None
}

/// Inserts a declaration statement at the brace at `column`, counted from 0.
/// The statement is `letter` and a semicolon, in place of up to two blanks around the brace.
pub fn insert_scope(line: &mut Vec<char>, column: usize, letter: char) {
    const LENGTH: usize = 2;
    let is_blank = |letter: &&char| matches!(letter, ' ' | '\t');
    let Some((before, [_, behind @ ..])) = line.split_at_checked(column) else { return };
    let after = behind.iter().take_while(is_blank).take(LENGTH).count();
    let missing = if behind.is_empty() { 0 } else { LENGTH - after };
    let before = before.iter().rev().take_while(is_blank).take(missing).count();
    let (start, end) = (column - before, column + 1 + after);
    line.splice(start..end, ['{', letter, ';']);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::text::Source;

    fn letters(source: &str) -> Vec<char> {
        bodies(Source::from(source).tokens()).into_iter().map(|(_, letter)| letter).collect()
    }

    #[test]
    fn loops_with_closures_over_their_variable_are_found() {
        assert_eq!(letters("for x in xs { f(|t| t * x); }"), [ONE]);
        assert_eq!(letters("for (x, i) in xs { f(|| i); }"), [TWO]);
        assert_eq!(letters("for x in `a${b}`.split() { for y in x { f(|| x + y) } }"), [ONE, ONE]);
        assert_eq!(letters("for x in xs { print(x); } f(|| x);"), []);
        assert_eq!(letters("for x in xs.map(|y| { y }) { f(|| 1); }"), []);
    }

    #[test]
    fn inserted_scope_uses_blanks_to_keep_columns() {
        let put_into = |text: &str| {
            let mut line: Vec<char> = text.chars().collect();
            let column = text.find('{').expect("a brace");
            insert_scope(&mut line, column, ONE);
            line.into_iter().collect::<String>()
        };
        assert_eq!(put_into("in a {  b"), format!("in a {{{ONE};b"));
        assert_eq!(put_into("in a { b"), format!("in a{{{ONE};b"));
        assert_eq!(put_into("in a {"), format!("in a {{{ONE};"));
    }
}
