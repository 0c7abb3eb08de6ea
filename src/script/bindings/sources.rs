//! Where script functions stand and where the library was called from: the engine loses the file where closures of modules are
//! called by natives, and tells only errors the line of a call.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use rhai::{AST, Engine};

use super::catalog::Catalog;
use crate::script::messages::stop::Stop;
use crate::script::source::syntax::TokenReader;

/// The folder that names of modules of the library begin with. Files of a script's own folder never have such a name.
pub const FOLDER: &str = "std/";

/// The names of all script functions and closures that an engine has read, with their files, and the line that the standard
/// library was entered from.
///
/// It travels as the default tag of the engine.
#[derive(Clone, Default)]
pub struct Sources {
    functions: Rc<RefCell<HashMap<String, HashSet<String>>>>,
    entered_at: Rc<Cell<Option<usize>>>,
    /// The checksums of files that were imported.
    imported: Rc<RefCell<BTreeMap<String, u32>>>,
    catalog: Option<Rc<Catalog>>,
    reader: TokenReader,
}

/// A guard that lasts as long as a call into the library.
pub struct LibraryCallGuard {
    entered_at: Rc<Cell<Option<usize>>>,
    before: Option<usize>,
}

impl Drop for LibraryCallGuard {
    fn drop(&mut self) {
        self.entered_at.set(self.before);
    }
}

/// Whether a file belongs to the library.
fn is_library(source: Option<&str>) -> bool {
    source.is_some_and(|source| source.starts_with(FOLDER))
}

impl Sources {
    /// Gives an engine a register of its own.
    pub fn install(engine: &mut Engine, catalog: &Catalog, reader: TokenReader) {
        let catalog = Some(Rc::new(catalog.clone()));
        engine.set_default_tag(rhai::Dynamic::from(Self { catalog, reader, ..Self::default() }));
    }

    /// The catalogue of the language that the engine speaks; none for an engine that does not speak it.
    pub fn catalog(&self) -> Option<Rc<Catalog>> {
        self.catalog.clone()
    }

    /// The register of an engine.
    pub fn of(engine: &Engine) -> Self {
        engine.default_tag().clone().try_cast().unwrap_or_default()
    }

    /// Tells the engine that it begins to read another text.
    pub fn begin_reading(&self) {
        self.reader.begin();
    }

    /// Lets texts that were read before be read again to their ends, although the run is to stop.
    pub fn undisturbed<T>(&self, work: impl FnOnce() -> T) -> T {
        self.reader.undisturbed(work)
    }

    /// What stopped the reading of the last text before its end, if something did.
    pub fn reading_stopped(&self) -> Option<Stop> {
        self.reader.stopped()
    }

    /// Notes the text of a file that was imported.
    pub fn note_text(&self, file: &str, content: &[u8]) {
        self.imported.borrow_mut().insert(file.to_owned(), crc32fast::hash(content));
    }

    /// A number made of the texts of all files that were imported so far.
    pub fn imprint(&self) -> u64 {
        let imported = self.imported.borrow();
        imported.values().fold(imported.len() as u64, |sum, one| {
            sum.rotate_left(7).wrapping_mul(0x100_0000_01b3) ^ u64::from(*one)
        })
    }

    /// Notes the functions and closures of a file.
    pub fn note(&self, ast: &AST, source: &str) {
        let mut known = self.functions.borrow_mut();
        for function in ast.iter_functions() {
            known.entry(function.name.to_owned()).or_default().insert(source.to_owned());
        }
    }

    /// The file of the function `name`: `claimed` where that is possible, nothing where the function is native.
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

    /// Notes a call into the library from a line of the file `caller`, until what is given back is dropped. The library may call
    /// itself: the line outside of it counts.
    pub fn enter_library(&self, caller: Option<&str>, line: Option<usize>) -> LibraryCallGuard {
        let before = self.entered_at.get();
        if !is_library(caller) {
            self.entered_at.set(line);
        }
        LibraryCallGuard { entered_at: self.entered_at.clone(), before }
    }

    /// The line that the library was entered from, while the running call stands in the library.
    pub fn entered_at(&self, running: Option<&str>) -> Option<usize> {
        self.entered_at.get().filter(|_| is_library(running))
    }
}
