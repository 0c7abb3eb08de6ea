//! `withy lsp`: a language server with which editors check scripts, complete names, show help and find definitions.

mod answers;
mod checks;
mod connection;
mod documents;
mod positions;
mod server;
mod uris;

pub use server::lsp;
