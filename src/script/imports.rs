//! Imports of files beside the script. A file that imports itself, in however many steps, is an error, not an abort.

use std::cell::RefCell;
use std::path::Path;

use rhai::module_resolvers::FileModuleResolver;
use rhai::{Engine, EvalAltResult, ModuleResolver, Position, Shared};

use super::error::ScriptError;

/// Finds modules as Rhai's own resolver does, and remembers which are being read.
pub struct AcyclicResolver {
    files: FileModuleResolver,
    being_read: RefCell<Vec<String>>,
}

impl AcyclicResolver {
    /// Files in a folder.
    pub fn new(folder: &Path) -> Self {
        Self { files: FileModuleResolver::new_with_path(folder), being_read: RefCell::default() }
    }
}

impl ModuleResolver for AcyclicResolver {
    fn resolve(
        &self,
        engine: &Engine,
        source: Option<&str>,
        path: &str,
        position: Position,
    ) -> Result<Shared<rhai::Module>, Box<EvalAltResult>> {
        if self.being_read.borrow().iter().any(|other| other == path) {
            let refusal = ScriptError::new(format!("'{path}' imports itself"));
            let refusal = refusal.hint("put what both files need into a third one");
            return Err(refusal.into_engine(position));
        }
        self.being_read.borrow_mut().push(path.to_owned());
        let module = self.files.resolve(engine, source, path, position);
        self.being_read.borrow_mut().pop();
        module
    }
}
