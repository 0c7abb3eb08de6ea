//! One model of pages, four writers: help, the reference, definition files and colours for editors.

pub mod definitions;
pub mod grammar;
pub mod lookup;
pub mod reference;
