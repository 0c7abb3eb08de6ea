//! The house itself: walls between layers, and documents that are true.

#[path = "../common/mod.rs"]
mod common;

mod documents;
mod figures;
mod layering;
mod links;
mod messages;
mod theory;
mod wings;
