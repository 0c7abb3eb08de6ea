//! From a text to a syntax tree, with all that is refused before anything runs.

use rhai::{AST, Engine, Scope};

use crate::script::bindings::sources::Sources;
use crate::script::dialect::naming;
use crate::script::dialect::reading::read;
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;
use crate::script::source::text::{Source, behind};

/// A text to be parsed that stands behind others which the engine has read before.
pub struct SourcePiece<'a> {
    /// The name of what it belongs to, in messages.
    pub name: &'a str,
    /// The text itself.
    pub text: &'a Source,
    /// How many lines stand before it.
    pub before: usize,
    /// The variables that it sees.
    pub scope: &'a Scope<'static>,
}

/// Parses a whole program with an engine that knows where imports are.
///
/// # Errors
/// When the program is not one of the language.
pub fn parse(engine: &Engine, program: &Program) -> EngineResult<AST> {
    let (name, text) = (program.name.as_str(), &program.text);
    let piece = SourcePiece { name, text, before: 0, scope: &Scope::new() };
    let mut ast = parse_piece(engine, &piece, || ScriptOutline::of(text).top_level)?;
    ast.set_source(name);
    Ok(ast)
}

/// Parses a piece of a program; places are counted from the start of the whole, whose `variables` are those that it declares at its top
/// level, with their lines.
///
/// # Errors
/// When the piece is not a part of a program of the language.
pub fn parse_piece(
    engine: &Engine,
    piece: &SourcePiece,
    variables: impl FnOnce() -> Vec<(String, usize)>,
) -> EngineResult<AST> {
    let &SourcePiece { name, text, before, scope } = piece;
    let ast = read(engine, scope, text, before)?;
    Sources::of(engine).note(&ast, name);
    naming::judge(engine, text, before, variables)?;
    match text.open_comment() {
        Some(at) => Err(ScriptError::new("a comment that begins with /* is never closed")
            .hint("write */ where it ends")
            .into_engine(behind(at, before))),
        None => Ok(ast),
    }
}
