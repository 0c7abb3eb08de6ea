//! One model of pages, three writers: help, the reference, definition files for editors.

pub mod definitions;
pub mod help;
pub mod reference;
