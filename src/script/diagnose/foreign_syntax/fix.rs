//! Search for a pattern of syntax from other languages.

use rhai::{ParseErrorType, Position};

use super::token_window::TokenWindow;
use super::{blocks, brackets, declarations, expressions, signs};
use crate::script::bindings::catalog::Catalog;
use crate::script::source::program::Program;

pub struct SyntaxFix {
    pub message: String,
    pub hint: String,
    pub at: Position,
}

/// Pattern of syntax from another language: a function that explains the tokens around an error, or returns `None`.
pub(super) type ForeignSyntax = fn(&TokenWindow) -> Option<SyntaxFix>;

const PATTERNS: &[&[ForeignSyntax]] = &[
    signs::PATTERNS,
    blocks::PATTERNS,
    declarations::PATTERNS,
    expressions::PATTERNS,
    brackets::PATTERNS,
];

/// Explanation of the syntax error `error` at `at`; `None` if no pattern matches.
pub fn explain(
    program: &Program,
    catalog: &Catalog,
    error: &ParseErrorType,
    at: Position,
) -> Option<SyntaxFix> {
    let spot = TokenWindow::of(program, catalog, error, at);
    PATTERNS.iter().copied().flatten().find_map(|habit| habit(&spot))
}
