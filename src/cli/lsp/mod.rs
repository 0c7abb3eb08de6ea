//! `withy lsp`: a language server, which editors start. It checks scripts while they are written, and answers requests for completion, help and definitions.
//!
//! Messages of the Language Server Protocol are read from stdin and written to stdout.

mod answers;
mod checks;
mod connection;
mod documents;
mod positions;
mod server;
mod uris;

pub use server::lsp;
