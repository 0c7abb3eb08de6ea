//! Documentation generated from the catalog: help, reference, definition files, and editor grammar.

pub mod definitions;
pub mod grammar;
pub mod lookup;
pub mod reference;
