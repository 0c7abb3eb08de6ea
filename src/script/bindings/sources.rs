//! Source files of script functions, and script lines that call the library.
//! Files and lines are recorded, because the engine does not know the file of a closure, and reports lines of calls only in errors.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::rc::Rc;

use rhai::{AST, Engine};

use super::catalog::Catalog;
use super::input_calls::{names_in_functions, names_in_statements};
use crate::script::messages::stop::Stop;
use crate::script::source::syntax::TokenReader;

/// Prefix of the names of library modules, which files in the folder of a script never have.
pub const FOLDER: &str = "std/";

/// Source files of all compiled script functions and closures, and the script line that called the library.
/// The engine stores this object as its default tag (`Engine::set_default_tag`), so that native functions can access it.
#[derive(Clone, Default)]
pub struct Sources {
    functions: Rc<RefCell<HashMap<String, HashSet<String>>>>,
    line: Rc<Cell<Option<usize>>>,
    imported: Rc<RefCell<BTreeMap<String, u32>>>,
    inputs: Rc<RefCell<InputNames>>,
    catalog: Option<Rc<Catalog>>,
    reader: TokenReader,
}

#[derive(Default)]
struct InputNames {
    in_functions: BTreeSet<String>,
    in_imports: BTreeSet<String>,
}

pub struct LibraryCallGuard {
    line: Rc<Cell<Option<usize>>>,
    before: Option<usize>,
}

impl Drop for LibraryCallGuard {
    fn drop(&mut self) {
        self.line.set(self.before);
    }
}

fn is_library(source: Option<&str>) -> bool {
    source.is_some_and(|source| source.starts_with(FOLDER))
}

impl Sources {
    pub fn install(engine: &mut Engine, catalog: &Catalog, reader: TokenReader) {
        let catalog = Some(Rc::new(catalog.clone()));
        engine.set_default_tag(rhai::Dynamic::from(Self { catalog, reader, ..Self::default() }));
    }

    pub fn catalog(&self) -> Option<Rc<Catalog>> {
        self.catalog.clone()
    }

    pub fn of(engine: &Engine) -> Self {
        engine.default_tag().clone().try_cast().unwrap_or_default()
    }

    pub fn begin_reading(&self) {
        self.reader.begin();
    }

    /// Calls `work` with the interruption of parsing disabled. `work` must parse only texts that have been parsed before.
    pub fn undisturbed<T>(&self, work: impl FnOnce() -> T) -> T {
        self.reader.undisturbed(work)
    }

    /// Reason why the last parsing was stopped; `None` if it was not stopped.
    pub fn reading_stopped(&self) -> Option<Stop> {
        self.reader.stopped()
    }

    pub fn record_import(&self, file: &str, content: &[u8]) {
        self.imported.borrow_mut().insert(file.to_owned(), crc32fast::hash(content));
    }

    pub fn checksum(&self) -> u64 {
        let imported = self.imported.borrow();
        imported.values().fold(imported.len() as u64, |sum, one| {
            sum.rotate_left(7).wrapping_mul(0x100_0000_01b3) ^ u64::from(*one)
        })
    }

    pub fn record_file(&self, ast: &AST, source: &str) {
        let mut known = self.functions.borrow_mut();
        for function in ast.iter_functions() {
            known.entry(function.name.to_owned()).or_default().insert(source.to_owned());
        }
        let mut inputs = self.inputs.borrow_mut();
        inputs.in_functions.extend(names_in_functions(ast));
        if self.imported.borrow().contains_key(source) {
            inputs.in_imports.extend(names_in_statements(ast));
        }
    }

    pub fn imports_have_inputs(&self) -> bool {
        !self.inputs.borrow().in_imports.is_empty()
    }

    pub fn functions_have_input(&self, name: &str) -> bool {
        self.inputs.borrow().in_functions.contains(name)
    }

    pub fn imports_have_input(&self, name: &str) -> bool {
        self.inputs.borrow().in_imports.contains(name)
    }

    /// File that contains the function `name`; `None` for a native function.
    /// The result is `claimed` if this file contains the function, or if no functions are known yet.
    pub fn find(&self, name: &str, claimed: &str) -> Option<String> {
        let known = self.functions.borrow();
        if known.is_empty() {
            return Some(claimed.to_owned());
        }
        let files = known.get(name)?;
        match files.contains(claimed) {
            true => Some(claimed.to_owned()),
            false => files.iter().min().cloned(),
        }
    }

    /// Marks a call into the library from a line of the file `caller`, until the guard is dropped.
    pub fn enter_library(&self, caller: Option<&str>, line: Option<usize>) -> LibraryCallGuard {
        let before = self.line.get();
        if !is_library(caller) {
            self.line.set(line);
        }
        LibraryCallGuard { line: self.line.clone(), before }
    }

    /// Script line that called the library; `None` if the running code does not belong to the library.
    pub fn entered_at(&self, running: Option<&str>) -> Option<usize> {
        self.line.get().filter(|_| is_library(running))
    }
}
