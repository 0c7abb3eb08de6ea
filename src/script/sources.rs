//! Which file a script function stands in: the engine loses it where closures of modules are called by natives.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use rhai::{AST, Engine};

/// The names of all script functions and closures that an engine has read, with their files.
///
/// It travels as the default tag of the engine.
#[derive(Clone, Debug, Default)]
pub struct Sources(Rc<RefCell<HashMap<String, HashSet<String>>>>);

impl Sources {
    /// Gives an engine a register of its own.
    pub fn install(engine: &mut Engine) {
        engine.set_default_tag(rhai::Dynamic::from(Self::default()));
    }

    /// The register of an engine.
    pub fn of(engine: &Engine) -> Self {
        engine.default_tag().clone().try_cast().unwrap_or_default()
    }

    /// Notes the functions of a file.
    pub fn note(&self, ast: &AST, source: &str) {
        let mut known = self.0.borrow_mut();
        for function in ast.iter_functions() {
            known.entry(function.name.to_owned()).or_default().insert(source.to_owned());
        }
    }

    /// The file of the function `name`: `claimed` where that is possible, nothing where the function is native.
    pub fn find(&self, name: &str, claimed: &str) -> Option<String> {
        let known = self.0.borrow();
        if known.is_empty() {
            return Some(claimed.to_owned());
        }
        let files = known.get(name)?;
        match files.contains(claimed) {
            true => Some(claimed.to_owned()),
            false => files.iter().min().cloned(),
        }
    }
}
