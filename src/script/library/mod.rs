//! The standard library: modules in Rhai that are part of the program, `import "std/sections" as sections;`.

mod entrance;
mod modules;

pub use entrance::behind_entrances;
pub use modules::{FOLDER, MODULES, Module, find};
