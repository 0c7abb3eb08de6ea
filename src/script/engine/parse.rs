//! Parsing with all checks before execution.

use rhai::{AST, Engine, Scope};

use crate::script::bindings::sources::Sources;
use crate::script::dialect::naming;
use crate::script::dialect::reading::read;
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;
use crate::script::source::text::{Source, moved_down};

/// Text that is parsed as a continuation of earlier texts.
pub struct SourcePiece<'a> {
    /// Name of the source in messages.
    pub name: &'a str,
    /// Text.
    pub text: &'a Source,
    /// Number of lines of the program before the text.
    pub before: usize,
    /// Variables that are visible in the text.
    pub scope: &'a Scope<'static>,
}

/// Parses and checks a whole program.
///
/// # Errors
/// Fails if the program has an error.
pub fn parse(engine: &Engine, program: &Program) -> EngineResult<AST> {
    let (name, text) = (program.name.as_str(), &program.text);
    let piece = SourcePiece { name, text, before: 0, scope: &Scope::new() };
    let mut ast = parse_piece(engine, &piece, || ScriptOutline::of(text).top_level)?;
    ast.set_source(name);
    Ok(ast)
}

/// Parses and checks a piece of a program. Positions refer to the whole program.
/// `variables` returns the top-level variables of the whole program with the lines of their declarations.
///
/// # Errors
/// Fails if the text has a syntax error, or an error that the checks of scripts find.
pub fn parse_piece(
    engine: &Engine,
    piece: &SourcePiece,
    variables: impl FnOnce() -> Vec<(String, usize)>,
) -> EngineResult<AST> {
    let &SourcePiece { name, text, before, scope } = piece;
    let ast = read(engine, scope, text, before)?;
    Sources::of(engine).record_file(&ast, name);
    naming::judge(engine, text, before, variables)?;
    match text.open_comment() {
        Some(at) => Err(ScriptError::new("a comment that begins with /* has no */")
            .hint("write */ at its end")
            .into_engine(moved_down(at, before))),
        None => Ok(ast),
    }
}
