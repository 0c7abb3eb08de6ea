//! Help, reference, definition files and editor grammar, generated from the catalog.

pub mod definitions;
pub mod grammar;
pub mod lookup;
pub mod reference;
