//! Documents that are open in the editor.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use gen_lsp_types as lsp;
use lsp::Uri;

use super::{positions, uris};
use crate::output::write_atomic;
use crate::repl::document::names_at;
use crate::repl::editor::surroundings::CompletionContext;
use crate::sandbox_fs::read_text;
use crate::script::library;
use crate::script::source::program::{LARGEST_SCRIPT, Program};
use crate::script::state::limits::Limits;

const LONGEST_ANSWER: Duration = Duration::from_secs(1);

pub fn limits() -> Limits {
    Limits { time: Some(LONGEST_ANSWER), ..Limits::default() }
}

pub struct Document {
    pub version: i32,
    pub text: String,
    pub check: Arc<AtomicBool>,
    names: RefCell<Option<(String, CompletionContext)>>,
}

impl Document {
    pub fn new(version: i32, text: String) -> Self {
        // The byte order mark is removed, because editors do not count it in positions.
        let text = text.strip_prefix('\u{feff}').map_or(text.clone(), str::to_owned);
        Self { version, text, check: Arc::default(), names: RefCell::default() }
    }

    pub fn change(&mut self, change: lsp::TextDocumentContentChangeEvent) {
        use lsp::TextDocumentContentChangeEvent as Change;
        match change {
            Change::TextDocumentContentChangeWholeDocument(whole) => self.text = whole.text,
            Change::TextDocumentContentChangePartial(part) => {
                let start = positions::offset(&self.text, part.range.start);
                let end = positions::offset(&self.text, part.range.end).max(start);
                self.text.replace_range(start..end, &part.text);
            }
        }
    }

    pub fn program(&self, uri: &Uri) -> Program {
        Program::from_text(&uris::path(uri), &self.text)
    }

    pub fn forget_names(&mut self) {
        self.names.take();
    }

    pub fn names(&self, uri: &Uri, offset: usize) -> Option<CompletionContext> {
        let start = self.text[..offset].rfind('\n').map_or(0, |end| end + 1);
        let before = &self.text[..start];
        let mut last = self.names.borrow_mut();
        if let Some((_, names)) = last.as_ref().filter(|(text, _)| text == before) {
            return Some(names.clone());
        }
        let names = names_at(&self.program(uri), start, limits()).ok()?;
        *last = Some((before.to_owned(), names.clone()));
        Some(names)
    }
}

#[derive(Default)]
pub struct Documents(pub HashMap<Uri, Document>);

impl Documents {
    /// URI and text of the script that a script in `folder` imports by `path`.
    /// A library module is first written to a file, so that the editor can open it.
    pub fn imported(&self, folder: &Path, path: &str) -> Option<(Uri, String)> {
        if let Some(module) = library::find(path) {
            let module = module.ok()?;
            return Some((uris::uri(&in_cache(module)?)?, module.text.to_owned()));
        }
        let name = if path.ends_with(".rhai") { path.to_owned() } else { format!("{path}.rhai") };
        let file = folder.join(name);
        let open = self.0.iter().find(|(uri, _)| uris::path(uri) == file);
        match open {
            Some((uri, document)) => Some((uri.clone(), document.text.clone())),
            None => Some((uris::uri(&file)?, read_text(&file, LARGEST_SCRIPT).ok()?)),
        }
    }
}

fn in_cache(module: &library::Module) -> Option<std::path::PathBuf> {
    let folder = dirs::cache_dir()?.join("withy").join(env!("CARGO_PKG_VERSION"));
    let file = folder.join(module.file);
    if read_text(&file, LARGEST_SCRIPT).is_ok_and(|text| text == module.text) {
        return Some(file);
    }
    std::fs::create_dir_all(file.parent()?).ok()?;
    write_atomic(&file, module.text.as_bytes()).ok()?;
    Some(file)
}
