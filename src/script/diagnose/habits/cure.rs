//! All habits, and what is told of the one that is found.

use rhai::{ParseErrorType, Position};

use super::spot::Spot;
use super::{blocks, brackets, declarations, expressions, signs};
use crate::script::rows::catalog::Catalog;
use crate::script::source::program::Program;

/// The cure for a habit of other languages: what is wrong, what to write, and where it stands.
pub struct Cure {
    /// What is wrong.
    pub message: String,
    /// What to write in the source instead.
    pub hint: String,
    /// The place of the word that is to blame.
    pub at: Position,
}

/// Looks at the words around a place, and knows what was meant or does not.
pub(super) type Habit = fn(&Spot) -> Option<Cure>;

/// All habits; those that need more of what stands around come first.
const HABITS: &[&[Habit]] =
    &[signs::HABITS, blocks::HABITS, declarations::HABITS, expressions::HABITS, brackets::HABITS];

/// What was meant by a source that the parser gave up at `at`, for the reason `error`.
pub fn cure(
    program: &Program,
    catalog: &Catalog,
    error: &ParseErrorType,
    at: Position,
) -> Option<Cure> {
    let spot = Spot::of(program, catalog, error, at);
    HABITS.iter().copied().flatten().find_map(|habit| habit(&spot))
}
