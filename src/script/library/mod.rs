//! Standard library: Rhai modules embedded in the program, imported by `import "std/sections" as sections;`.

mod document;
mod entrance;
mod modules;
mod pages;

pub use document::document;
pub use entrance::with_entry_wrappers;
pub use modules::{MODULES, Module, find};
pub use pages::{DocBlock, ModuleFunction, ModulePage, page_of, pages};
