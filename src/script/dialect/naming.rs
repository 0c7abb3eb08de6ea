//! Names that a file gives and uses in a way that would quietly mean something else, refused before anything runs: functions
//! with the names of the language's own, which would take their place everywhere, and constants of the language in functions
//! of a file that has a variable of that name, which functions do not see.

use rhai::{Engine, EvalAltResult, Position, Token};

use crate::script::rows::catalog::Catalog;
use crate::script::rows::sources::Sources;
use crate::script::rows::table::Form;
use crate::script::source::outline::Outline;
use crate::script::source::rounds::nesting;
use crate::script::words::error::ScriptError;

/// Judges the functions of `source`, a part of `file` or all of it; lines are those of `source`.
///
/// # Errors
/// With the place of the first name that is refused.
pub fn judge(engine: &Engine, source: &str, file: &str) -> Result<(), Box<EvalAltResult>> {
    let Some(catalog) = Sources::of(engine).catalog() else { return Ok(()) };
    let tokens = crate::script::source::lexing::tokens(source);
    let functions: Vec<_> = functions(&tokens).collect();
    if functions.is_empty() {
        return Ok(());
    }
    for function in &functions {
        function.refuse_taken(&catalog)?;
    }
    let variables = Outline::of(file).top_level;
    let hidden: Vec<_> = catalog
        .constants()
        .filter_map(|constant| variables.iter().rev().find(|(name, _)| name == constant))
        .collect();
    for function in &functions {
        for (name, line) in &hidden {
            function.refuse_hidden(name, *line)?;
        }
    }
    Ok(())
}

/// What to do about a variable that a function does not see.
pub fn not_visible(name: &str, line: usize) -> String {
    format!(
        "'{name}' of line {line} is not visible inside functions: pass it as an argument, or use a closure |x| …, which sees \
         it"
    )
}

/// The tokens of a function.
struct Function<'t> {
    /// None for a method of a type, which is no function of its name.
    name: Option<(&'t str, Position)>,
    parameters: usize,
    /// From the bracket before its parameters to the end of its body.
    tokens: &'t [(Token, Position)],
}

fn functions(tokens: &[(Token, Position)]) -> impl Iterator<Item = Function<'_>> {
    let starts = tokens.iter().enumerate().filter(|(_, (token, _))| matches!(token, Token::Fn));
    starts.filter_map(|(start, _)| {
        let rest = &tokens[start + 1..];
        let open = rest.iter().position(|(token, _)| {
            matches!(token, Token::LeftParen | Token::Unit | Token::LeftBrace)
        })?;
        let name = match &rest[..open] {
            [(Token::Identifier(name), at)] => Some((name.as_str(), *at)),
            _ => None,
        };
        let body = rest.iter().position(|(token, _)| matches!(token, Token::LeftBrace))?;
        let is_parameter = |(token, _): &&(Token, Position)| matches!(token, Token::Identifier(_));
        let parameters = rest.get(open..body)?.iter().filter(is_parameter).count();
        let mut depth = 0;
        let end = rest[body..].iter().position(|(token, _)| {
            depth += nesting(token);
            depth == 0
        });
        let end = end.map_or(rest.len(), |length| body + length);
        Some(Function { name, parameters, tokens: &rest[open..end] })
    })
}

impl Function<'_> {
    fn refuse_taken(&self, catalog: &Catalog) -> Result<(), Box<EvalAltResult>> {
        let Some((name, at)) = self.name else { return Ok(()) };
        let count = self.parameters;
        let is_row = catalog.named(name).any(|row| {
            matches!(row.form, Form::Function)
                && (row.required()..=row.parameters.len()).contains(&count)
        });
        let is_rhais = catalog
            .built_ins_named(name)
            .flat_map(|known| known.written())
            .any(|form| form.receiver.is_none() && form.takes(count));
        if !is_row && !is_rhais {
            return Ok(());
        }
        let arguments = match count {
            0 => "no arguments".to_owned(),
            1 => "1 argument".to_owned(),
            _ => format!("{count} arguments"),
        };
        let told = format!("the language has a function {name}(…) with {arguments}");
        Err(ScriptError::new(told).hint("give yours another name").into_engine(at))
    }

    /// Refuses a constant of the language, as the name of a variable that the function does not see would be read.
    fn refuse_hidden(&self, name: &str, line: usize) -> Result<(), Box<EvalAltResult>> {
        let used = self.names().find(|(used, _)| *used == name);
        let Some((_, at)) = used.filter(|_| !self.declares(name)) else { return Ok(()) };
        let told = format!("there is no variable '{name}' here");
        Err(ScriptError::new(told).hint(not_visible(name, line)).into_engine(at))
    }

    /// The names of variables, constants and parameters.
    fn names(&self) -> impl Iterator<Item = (&str, Position)> {
        self.tokens.iter().enumerate().filter_map(|(index, (token, at))| {
            let Token::Identifier(name) = token else { return None };
            let before = self.token(index.wrapping_sub(1));
            let is_member =
                matches!(before, Some(Token::Period | Token::Elvis | Token::DoubleColon));
            let after = self.token(index + 1);
            let is_key =
                matches!(after, Some(Token::Colon | Token::LeftParen | Token::DoubleColon));
            (!is_member && !is_key).then_some((name.as_str(), *at))
        })
    }

    /// Whether a parameter, a variable, or a parameter of a closure in the function has the name.
    fn declares(&self, name: &str) -> bool {
        let body = self.tokens.iter().position(|(token, _)| matches!(token, Token::LeftBrace));
        self.tokens.iter().enumerate().any(|(index, (token, _))| {
            let is_name = matches!(token, Token::Identifier(own) if own.as_str() == name);
            let before = self.token(index.wrapping_sub(1));
            let is_parameter = body.is_some_and(|body| index < body);
            let is_variable =
                matches!(before, Some(Token::Let | Token::Const | Token::For | Token::Pipe));
            let is_last = matches!(self.token(index + 1), Some(Token::Pipe))
                && matches!(before, Some(Token::Comma));
            let is_element = matches!(self.token(index.wrapping_sub(2)), Some(Token::For));
            let is_caught = matches!(self.token(index.wrapping_sub(2)), Some(Token::Catch));
            let is_counter = matches!(
                (self.token(index + 1), self.token(index + 2)),
                (Some(Token::RightParen), Some(Token::In))
            );
            is_name
                && (is_parameter || is_variable || is_last || is_element || is_caught || is_counter)
        })
    }

    fn token(&self, index: usize) -> Option<&Token> {
        self.tokens.get(index).map(|(token, _)| token)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::lexing::tokens;

    #[test]
    fn functions_are_found_with_their_parameters() {
        let tokens = tokens("fn a() { 1 } fn b(x, y) { |z| #{ k: x } } fn number.c(x) { x }");
        let found: Vec<_> =
            functions(&tokens).map(|f| (f.name.map(|(name, _)| name), f.parameters)).collect();
        assert_eq!(found, [(Some("a"), 0), (Some("b"), 2), (None, 1)]);
    }

    #[test]
    fn a_function_declares_its_variables() {
        let declares =
            |text: &str| functions(&tokens(text)).next().expect("a function").declares("E");
        for own in [
            "fn f(E) { }",
            "fn f() { let E = 1; }",
            "fn f() { |x, E| x }",
            "fn f() { for (x, E) in y { } }",
        ] {
            assert!(declares(own), "{own}");
        }
        assert!(!declares("fn f(x) { x / E }") && !declares("fn f() { #{ E: 1 } }"));
    }
}
