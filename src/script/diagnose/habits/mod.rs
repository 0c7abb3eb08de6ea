//! Grammar of other languages, and slips that the parser meets far from where they were made: what is written here instead.
//!
//! A habit looks at the words around the place where the parser gave up, and says what is wrong and what to write. The first
//! that knows the words is believed; nothing here is asked unless the source is wrong already.

mod blocks;
mod brackets;
mod declarations;
mod expressions;
mod signs;
mod spot;

use rhai::{ParseErrorType, Position};

use crate::script::rows::catalog::Catalog;
use crate::script::source::program::Program;
use spot::Spot;

/// The cure for a habit of other languages: what is wrong, what to write, and where it stands.
pub struct Cure {
    /// What is wrong with the source.
    pub message: String,
    /// What to write in the source instead.
    pub hint: String,
    /// The place of the word that is to blame.
    pub at: Position,
}

/// Looks at the words around a place, and knows what was meant or does not.
type Habit = fn(&Spot) -> Option<Cure>;

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
