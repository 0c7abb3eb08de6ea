//! Consistency of the repository: boundaries between layers, and documents that match the code.

#[path = "../common/mod.rs"]
mod common;

mod documents;
mod figures;
mod layering;
mod links;
mod messages;
mod submodules;
mod theory;
