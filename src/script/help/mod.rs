//! Documentation generated from the catalog: help, reference, definition files, and editor grammar. The texts are part of the bindings in `packages`.

pub mod definitions;
pub mod grammar;
pub mod lookup;
pub mod reference;
