//! Source files of script functions, and lines of calls of the library. The engine does not know the file when native code calls closures of modules,
//! and it provides the lines of calls only in errors.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use rhai::{AST, Engine};

use super::catalog::Catalog;
use crate::script::messages::stop::Stop;
use crate::script::source::syntax::TokenReader;

/// Prefix of library modules. Files of a script's folder never have such a name.
pub const FOLDER: &str = "std/";

/// Files of all script functions and closures that an engine has compiled, and the line that called the standard library.
///
/// Stored as the default tag of the engine.
#[derive(Clone, Default)]
pub struct Sources {
    functions: Rc<RefCell<HashMap<String, HashSet<String>>>>,
    line: Rc<Cell<Option<usize>>>,
    imported: Rc<RefCell<BTreeMap<String, u32>>>,
    catalog: Option<Rc<Catalog>>,
    reader: TokenReader,
}

/// Guard for the duration of a call into the library.
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

    /// Resets the parser state before another text.
    pub fn begin_reading(&self) {
        self.reader.begin();
    }

    /// Calls `work`, whose parsing cannot be stopped, for texts that were parsed before.
    pub fn undisturbed<T>(&self, work: impl FnOnce() -> T) -> T {
        self.reader.undisturbed(work)
    }

    /// Reason for which the last parsing was stopped, if it was.
    pub fn reading_stopped(&self) -> Option<Stop> {
        self.reader.stopped()
    }

    pub fn record_import(&self, file: &str, content: &[u8]) {
        self.imported.borrow_mut().insert(file.to_owned(), crc32fast::hash(content));
    }

    /// Checksum of the texts of all imported files.
    pub fn checksum(&self) -> u64 {
        let imported = self.imported.borrow();
        imported.values().fold(imported.len() as u64, |sum, one| {
            sum.rotate_left(7).wrapping_mul(0x100_0000_01b3) ^ u64::from(*one)
        })
    }

    /// Records the functions and closures of a file.
    pub fn record_file(&self, ast: &AST, source: &str) {
        let mut known = self.functions.borrow_mut();
        for function in ast.iter_functions() {
            known.entry(function.name.to_owned()).or_default().insert(source.to_owned());
        }
    }

    /// File of the function `name`: `claimed` if it contains the function, `None` for native functions.
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

    /// Marks a call into the library from a line of the file `caller` until the guard is dropped. For nested library calls, the outermost line is
    /// kept.
    pub fn enter_library(&self, caller: Option<&str>, line: Option<usize>) -> LibraryCallGuard {
        let before = self.line.get();
        if !is_library(caller) {
            self.line.set(line);
        }
        LibraryCallGuard { line: self.line.clone(), before }
    }

    /// Line of the call into the library, if the running code belongs to the library.
    pub fn entered_at(&self, running: Option<&str>) -> Option<usize> {
        self.line.get().filter(|_| is_library(running))
    }
}
