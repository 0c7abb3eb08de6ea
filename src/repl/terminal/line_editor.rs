//! Line editor of the prompt, based on the library rustyline.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

use rustyline::config::BellStyle;
use rustyline::error::ReadlineError;
use rustyline::history::FileHistory;
use rustyline::{ColorMode, CompletionType, Config, EditMode};

use super::assistant::Assistant;
use super::history;
use super::keys::{self, Entries};
use crate::output::Colours;
use crate::repl::editor::completion::INDENTATION;
use crate::repl::editor::highlight::SessionNames;
use crate::repl::editor::surroundings::CompletionContext;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keys {
    #[default]
    Emacs,
    Vi,
}

impl Keys {
    /// Environment variable that selects the editing mode, `emacs` or `vi`.
    pub const VARIABLE: &str = "WITHY_KEYS";

    pub fn named(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "emacs" => Some(Self::Emacs),
            "vi" | "vim" => Some(Self::Vi),
            _ => None,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EditorOptions {
    pub keys: Keys,
    pub colours: Colours,
    /// File with the history of earlier sessions; `None` if no history is stored.
    pub history: Option<PathBuf>,
}

impl EditorOptions {
    pub fn from_environment(colours: Colours) -> Self {
        let keys = env::var(Keys::VARIABLE).ok().and_then(|name| Keys::named(&name));
        let history = history::file(env::var_os(history::VARIABLE));
        Self { keys: keys.unwrap_or_default(), colours, history }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EditorInput {
    Line(String),
    Interrupted,
    End,
}

const USUAL_COLUMNS: usize = 80;

pub struct Editor {
    lines: rustyline::Editor<Assistant, FileHistory>,
    history: Option<PathBuf>,
    colours: Colours,
    entries: Entries,
    history_problem: Option<String>,
}

impl Editor {
    /// Creates a line editor on this terminal.
    /// If the history file cannot be read, it is ignored, and [`Self::take_history_problem`] returns the reason.
    pub fn new(options: EditorOptions) -> io::Result<Self> {
        let lines = rustyline::Editor::with_config(configuration(&options)?).map_err(into_io)?;
        let entries = Entries::default();
        let mut editor = Self {
            lines,
            history: options.history,
            colours: options.colours,
            entries,
            history_problem: None,
        };
        keys::bind(&mut editor.lines, &editor.entries);
        editor.recall();
        Ok(editor)
    }

    pub fn read(
        &mut self,
        prompt: &str,
        surroundings: CompletionContext,
    ) -> io::Result<EditorInput> {
        let columns =
            self.lines.dimensions().map_or(USUAL_COLUMNS, |(columns, _)| usize::from(columns));
        let assistant = Assistant::new(
            SessionNames::of(surroundings),
            columns,
            crate::output::columns(prompt),
            self.colours,
        );
        self.lines.set_helper(Some(assistant));
        match self.lines.readline(prompt) {
            Ok(line) => {
                self.add_to_history(&line);
                Ok(EditorInput::Line(line))
            }
            Err(ReadlineError::Interrupted) => Ok(EditorInput::Interrupted),
            Err(ReadlineError::Eof) => Ok(EditorInput::End),
            Err(error) => Err(into_io(error)),
        }
    }

    /// Columns and lines of the terminal; `None` if the terminal does not report them.
    pub fn size(&mut self) -> Option<(usize, usize)> {
        let (columns, lines) = self.lines.dimensions()?;
        Some((usize::from(columns), usize::from(lines)))
    }

    /// Problem with the history file, returned only once; `None` without a problem.
    pub fn take_history_problem(&mut self) -> Option<String> {
        self.history_problem.take()
    }

    fn recall(&mut self) {
        let Some(file) = self.history.clone().filter(|file| file.exists()) else { return };
        // Only a regular file is accepted, because reading from a pipe or a device would block the session.
        if !file.is_file() {
            let error = ReadlineError::from(io::Error::other("it is not a regular file"));
            return self.disable_history("read", &file, &error);
        }
        match self.lines.load_history(&file) {
            Ok(()) => {
                if let Ok(mut entries) = self.entries.lock() {
                    entries.extend(self.lines.history().iter().cloned());
                }
            }
            Err(error) => self.disable_history("read", &file, &error),
        }
    }

    /// Adds an entry to the history and at once to its file, so that nothing is lost if the session is killed.
    fn add_to_history(&mut self, line: &str) {
        if !history::should_store(line) || !self.lines.add_history_entry(line).unwrap_or(false) {
            return;
        }
        if let Ok(mut entries) = self.entries.lock() {
            entries.insert(line.to_owned());
        }
        let Some(file) = self.history.clone() else { return };
        let folder = file.parent().map_or(Ok(()), fs::create_dir_all).map_err(ReadlineError::from);
        if let Err(error) = folder.and_then(|()| self.lines.append_history(&file)) {
            self.disable_history("write", &file, &error);
        }
    }

    fn disable_history(&mut self, what: &str, file: &Path, error: &ReadlineError) {
        self.history = None;
        self.history_problem = Some(format!(
            "note: cannot {what} the history file '{}': {error}; the inputs of this session are not stored (WITHY_HISTORY=FILE selects another file)",
            file.display()
        ));
    }
}

fn configuration(options: &EditorOptions) -> io::Result<Config> {
    let builder = Config::builder()
        .max_history_size(history::MOST_ENTRIES)
        .and_then(|builder| builder.history_ignore_dups(true))
        .map_err(into_io)?;
    let configuration = builder
        .edit_mode(match options.keys {
            Keys::Emacs => EditMode::Emacs,
            Keys::Vi => EditMode::Vi,
        })
        .color_mode(match options.colours {
            Colours::Ansi => ColorMode::Enabled,
            Colours::None => ColorMode::Disabled,
        })
        .completion_type(CompletionType::List)
        .completion_show_all_if_ambiguous(true)
        .bell_style(BellStyle::None)
        .history_ignore_space(true)
        .auto_add_history(false)
        .bracketed_paste(true)
        .indent_size(INDENTATION.len() as u8)
        .tab_stop(INDENTATION.len() as u8);
    Ok(configuration.build())
}

fn into_io(error: ReadlineError) -> io::Error {
    match error {
        ReadlineError::Io(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn editor(history: PathBuf) -> Editor {
        let options =
            EditorOptions { keys: Keys::Emacs, colours: Colours::None, history: Some(history) };
        Editor::new(options).expect("an editor")
    }

    #[test]
    fn history_entries_are_stored_unchanged_between_sessions() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("state").join("history");
        let mut first = editor(file.clone());
        for line in [
            "let a = 1;",
            "fn f() {\n    \"\\\\n\"\n}",
            "   ",
            " secret",
            "fn f() {\n    \"\\\\n\"\n}",
        ] {
            first.add_to_history(line);
        }
        let mut second = editor(file.clone());
        second.add_to_history("f()");
        let third = editor(file);
        let entries: Vec<_> = third.lines.history().iter().map(String::as_str).collect();
        assert_eq!(entries, ["let a = 1;", "fn f() {\n    \"\\\\n\"\n}", "f()"]);
        assert!(third.entries.lock().is_ok_and(|entries| entries.contains("f()")));
    }

    #[test]
    fn unusable_history_file_is_reported_once_and_not_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("picture");
        fs::write(&file, b"\xff\xfe\n").expect("a file");
        let mut unreadable = editor(file.clone());
        assert!(unreadable.take_history_problem().is_some_and(|note| note.contains("cannot read")));
        unreadable.add_to_history("let a = 1;");
        assert_eq!(unreadable.take_history_problem(), None);
        assert_eq!(fs::read(&file).expect("the file"), b"\xff\xfe\n");

        let mut unwritable = editor(file.join("history"));
        unwritable.add_to_history("let a = 1;");
        assert!(
            unwritable.take_history_problem().is_some_and(|note| note.contains("cannot write"))
        );
        unwritable.add_to_history("let b = 1;");
        assert_eq!(unwritable.take_history_problem(), None);
    }

    #[test]
    fn key_bindings_are_found_by_name() {
        assert_eq!(Keys::named("VI"), Some(Keys::Vi));
        assert_eq!(Keys::named("emacs"), Some(Keys::Emacs));
        assert_eq!(Keys::named("joe"), None);
    }
}
