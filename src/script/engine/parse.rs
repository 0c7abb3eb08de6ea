//! From a text to a syntax tree, with all that is refused before anything runs.

use rhai::{AST, Engine, Position, Scope};

use crate::script::dialect::naming;
use crate::script::dialect::reading::read;
use crate::script::rows::sources::Sources;
use crate::script::source::lexing::open_comment;
use crate::script::source::program::Program;
use crate::script::words::error::{EngineResult, ScriptError};

/// A text to be parsed that stands behind others which the engine has read before.
pub struct Piece<'a> {
    /// The name of what it belongs to, in messages.
    pub name: &'a str,
    /// The text itself.
    pub text: &'a str,
    /// How many lines stand before it.
    pub before: usize,
    /// The whole that it is the last piece of: names that are declared there may be meant here.
    pub whole: &'a str,
    /// The variables that it sees.
    pub scope: &'a Scope<'static>,
}

/// Parses a whole program with an engine that knows where imports are.
///
/// # Errors
/// When the program is not one of the language.
pub fn parse(engine: &Engine, program: &Program) -> EngineResult<AST> {
    let (name, text) = (program.name.as_str(), &*program.text);
    let scope = &Scope::new();
    let mut ast = parse_piece(engine, &Piece { name, text, before: 0, whole: text, scope })?;
    ast.set_source(name);
    Ok(ast)
}

/// Parses a piece of a program; places are counted from the start of the whole.
///
/// # Errors
/// When the piece is not a part of a program of the language.
pub fn parse_piece(engine: &Engine, piece: &Piece) -> EngineResult<AST> {
    let &Piece { name, text, before, whole, scope } = piece;
    let ast = read(engine, scope, text, before)?;
    Sources::of(engine).note(&ast, name);
    let placed = format!("{}{text}", "\n".repeat(before));
    naming::judge(engine, &placed, whole)?;
    match open_comment(text) {
        Some(at) => Err(ScriptError::new("a comment that begins with /* is never closed")
            .hint("write */ where it ends")
            .into_engine(below(at, before))),
        None => Ok(ast),
    }
}

/// A position so many lines further down, as far as the engine can count.
fn below(at: Position, lines: usize) -> Position {
    let line = at.line().unwrap_or(1) + lines;
    let column = at.position().unwrap_or(1);
    let count = |number: usize| number.try_into().unwrap_or(u16::MAX);
    Position::new(count(line), count(column))
}
