//! Program for the page `docs/playground`, which executes it as a WebAssembly module in a browser.

mod commands;
mod completion;
mod start;

pub use start::main;
