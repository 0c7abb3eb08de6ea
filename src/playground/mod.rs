//! WebAssembly program of the page `docs/playground`.

mod commands;
mod completion;
mod start;

pub use start::main;
