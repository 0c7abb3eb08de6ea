//! All habits, and what is told of the one that is found.

use rhai::{ParseErrorType, Position};

use super::token_window::TokenWindow;
use super::{blocks, brackets, declarations, expressions, signs};
use crate::script::bindings::catalog::Catalog;
use crate::script::source::program::Program;

/// The cure for a habit of other languages: what is wrong, what to write, and where it stands.
pub struct SyntaxFix {
    /// What is wrong with the source.
    pub message: String,
    /// What to write in the source instead.
    pub hint: String,
    /// The place of the word that is to blame.
    pub at: Position,
}

/// A habit of other languages: looks at the words around a place, and knows the cure or none.
pub(super) type ForeignSyntax = fn(&TokenWindow) -> Option<SyntaxFix>;

/// All habits; those that need more of what stands around come first.
const HABITS: &[&[ForeignSyntax]] =
    &[signs::HABITS, blocks::HABITS, declarations::HABITS, expressions::HABITS, brackets::HABITS];

/// The cure for a source that the parser gave up at `at`, for the reason `error`: what was meant there.
pub fn cure(
    program: &Program,
    catalog: &Catalog,
    error: &ParseErrorType,
    at: Position,
) -> Option<SyntaxFix> {
    let spot = TokenWindow::of(program, catalog, error, at);
    HABITS.iter().copied().flatten().find_map(|habit| habit(&spot))
}
