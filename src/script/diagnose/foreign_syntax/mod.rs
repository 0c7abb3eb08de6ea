//! Grammar of other languages, and slips that the parser meets far from where they were made: what is written here instead.
//!
//! A habit looks at the words around the place where the parser gave up, and says what is wrong and what to write. The first
//! that knows the words is believed; nothing here is asked unless the source is wrong already.

mod blocks;
mod brackets;
mod declarations;
mod expressions;
mod fix;
mod signs;
mod token_window;

pub use fix::cure;
