//! Check for misleading names before a script runs.
//!
//! A function must not have the name and the number of arguments of a function of the language.
//! If a file has a variable with the name of a constant of the language, functions in the file must not use this name.
//! Functions cannot see the variable, and the name would mean the constant.

use rhai::{Engine, EvalAltResult, Position, Token};

use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::sources::Sources;
use crate::script::bindings::table::CallSyntax;
use crate::script::messages::error::ScriptError;
use crate::script::source::definitions::{Definition, definitions};
use crate::script::source::text::{Source, moved_down, name_of};

/// Checks the names of functions in `source`, and the constants used in them.
/// `lines_before` is the number of lines of the file before `source`.
/// `variables` returns the top-level variables of the file with the lines of their declarations.
///
/// # Errors
/// Fails at the position of the first misleading name.
pub fn judge(
    engine: &Engine,
    source: &Source,
    lines_before: usize,
    variables: impl FnOnce() -> Vec<(String, usize)>,
) -> Result<(), Box<EvalAltResult>> {
    let Some(catalog) = Sources::of(engine).catalog() else { return Ok(()) };
    let functions: Vec<_> = definitions(source.tokens())
        .map(|definition| NamedFunction { definition, lines_before })
        .collect();
    if functions.is_empty() {
        return Ok(());
    }
    for function in &functions {
        function.refuse_taken(&catalog)?;
    }
    let variables = variables();
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

pub fn not_visible(name: &str, line: usize) -> String {
    format!(
        "'{name}' of line {line} is not visible inside functions: pass it as an argument, or \
        use a closure |x| …, which can use it"
    )
}

struct NamedFunction<'t> {
    definition: Definition<'t>,
    lines_before: usize,
}

impl NamedFunction<'_> {
    fn refuse_taken(&self, catalog: &Catalog) -> Result<(), Box<EvalAltResult>> {
        let Some((name, (_, at))) = self.definition.name() else { return Ok(()) };
        let count = self.definition.parameters().count();
        let is_row = catalog.named(name).any(|row| {
            matches!(row.form, CallSyntax::Function)
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
        let message = format!("the language has a function {name}(…) with {arguments}");
        Err(ScriptError::new(message)
            .hint("choose another name for your function")
            .into_engine(self.place(*at)))
    }

    /// Rejects a constant of the language in a function if the file has a variable with the same name.
    fn refuse_hidden(&self, name: &str, line: usize) -> Result<(), Box<EvalAltResult>> {
        let used = self.names().find(|(used, _)| *used == name);
        let Some((_, at)) = used.filter(|_| !self.declares(name)) else { return Ok(()) };
        let message = format!("there is no variable '{name}' here");
        Err(ScriptError::new(message).hint(not_visible(name, line)).into_engine(self.place(at)))
    }

    fn place(&self, at: Position) -> Position {
        moved_down(at, self.lines_before)
    }

    fn names(&self) -> impl Iterator<Item = (&str, Position)> {
        self.definition.inside().iter().enumerate().filter_map(|(index, (token, at))| {
            let name = name_of(token)?;
            let before = self.token(index.wrapping_sub(1));
            let is_member =
                matches!(before, Some(Token::Period | Token::Elvis | Token::DoubleColon));
            let after = self.token(index + 1);
            let is_key =
                matches!(after, Some(Token::Colon | Token::LeftParen | Token::DoubleColon));
            (!is_member && !is_key).then_some((name, *at))
        })
    }

    fn declares(&self, name: &str) -> bool {
        let body = self
            .definition
            .inside()
            .iter()
            .position(|(token, _)| matches!(token, Token::LeftBrace));
        self.definition.inside().iter().enumerate().any(|(index, (token, _))| {
            let is_name = name_of(token) == Some(name);
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
        self.definition.inside().get(index).map(|(token, _)| token)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_declared_by_a_function_are_found() {
        let declares = |text: &str| {
            let source = Source::from(text);
            let definition = definitions(source.tokens()).next().expect("a function");
            NamedFunction { definition, lines_before: 0 }.declares("E")
        };
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
