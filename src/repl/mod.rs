//! The session at a prompt: what is typed is evaluated, remembered, and can be gone back from.

pub mod batch;
pub mod commands;
pub mod editor;
pub mod record;
pub mod session;
pub mod shell;
mod surroundings;
pub mod transcript;
