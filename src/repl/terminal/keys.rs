//! Key bindings with special behaviour: Enter, Backspace, and the arrows up and down.

use std::collections::HashSet;
use std::sync::{Arc, Mutex};

use rustyline::history::History;
use rustyline::{
    Cmd, ConditionalEventHandler, EditMode, Editor, Event, EventContext, EventHandler, Helper,
    InputMode, KeyCode, KeyEvent, Modifiers, Movement, RepeatCount,
};

use crate::repl::editor::completeness::{Completeness, completeness};
use crate::repl::editor::completion::INDENTATION;

pub type Entries = Arc<Mutex<HashSet<String>>>;

pub fn bind<H: Helper, I: History>(editor: &mut Editor<H, I>, entries: &Entries) {
    let conditional = |rule: KeyRule| EventHandler::Conditional(Box::new(rule));
    editor.bind_sequence(KeyEvent(KeyCode::Enter, Modifiers::NONE), conditional(KeyRule::Enter));
    editor.bind_sequence(
        KeyEvent(KeyCode::Enter, Modifiers::ALT),
        EventHandler::Simple(Cmd::Newline),
    );
    editor.bind_sequence(KeyEvent(KeyCode::Backspace, Modifiers::NONE), conditional(KeyRule::Back));
    for (key, direction) in
        [(KeyCode::Up, HistoryDirection::Backward), (KeyCode::Down, HistoryDirection::Forward)]
    {
        let rule = KeyRule::Search(direction, Arc::clone(entries));
        editor.bind_sequence(KeyEvent(key, Modifiers::NONE), conditional(rule));
    }
}

#[derive(Clone, Copy)]
enum HistoryDirection {
    Backward,
    Forward,
}

enum KeyRule {
    Enter,
    Back,
    Search(HistoryDirection, Entries),
}

impl ConditionalEventHandler for KeyRule {
    fn handle(&self, _: &Event, _: RepeatCount, _: bool, context: &EventContext) -> Option<Cmd> {
        if context.mode() == EditMode::Vi && context.input_mode() == InputMode::Command {
            return None;
        }
        let (line, at) = (context.line(), context.pos());
        match self {
            Self::Enter => next_line(line, at).map(|text| Cmd::Insert(1, text)),
            Self::Back => is_indentation(line, at).then_some(Cmd::Dedent(Movement::WholeLine)),
            Self::Search(direction, entries) => {
                let is_entry = entries.lock().is_ok_and(|entries| entries.contains(line));
                searches(line, at, is_entry).then_some(match direction {
                    HistoryDirection::Backward => Cmd::HistorySearchBackward,
                    HistoryDirection::Forward => Cmd::HistorySearchForward,
                })
            }
        }
    }
}

fn next_line(line: &str, at: usize) -> Option<String> {
    match completeness(line) {
        Completeness::Open(levels) if at == line.len() => {
            Some(format!("\n{}", INDENTATION.repeat(levels)))
        }
        _ => None,
    }
}

fn is_indentation(line: &str, at: usize) -> bool {
    let here = line.rfind('\n').map(|end| &line[end + 1..]);
    let is_blank = |here: &str| !here.is_empty() && here.bytes().all(|byte| byte == b' ');
    at == line.len()
        && here.is_some_and(|here| is_blank(here) && here.len() % INDENTATION.len() == 0)
}

/// Returns true if an arrow key selects an entry of the history that begins with the text before the cursor.
///
/// The arrow key has its usual function if there is no text before the cursor, or if the input has several lines.
/// If the line is an unchanged history entry and the cursor is at its end, the arrow key selects the next entry, whatever its text.
fn searches(line: &str, at: usize, is_entry: bool) -> bool {
    let is_fetched = is_entry && at == line.len();
    at > 0 && !line.contains('\n') && !is_fetched
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn incomplete_input_continues_on_an_indented_line() {
        assert_eq!(next_line("fn f() {", 8).as_deref(), Some("\n    "));
        assert_eq!(next_line("`a", 2).as_deref(), Some("\n"));
        assert_eq!(next_line("fn f() {", 3), None);
        assert_eq!(next_line("f()", 3), None);
        assert_eq!(next_line("fn f() {\n    \n    ", 18), None, "two empty lines submit");
    }

    #[test]
    fn backspace_removes_whole_indentation_levels() {
        assert!(is_indentation("fn f() {\n    ", 13));
        assert!(is_indentation("fn f() {\n        ", 17));
        for line in ["fn f() {\n", "fn f() {\n  ", "fn f() {\n    a", "    "] {
            assert!(!is_indentation(line, line.len()), "{line}");
        }
    }

    #[test]
    fn arrow_keys_search_history_for_the_typed_prefix() {
        assert!(searches("let", 3, false));
        assert!(searches("let a = 1", 3, true), "the search goes on");
        assert!(!searches("let a = 1", 9, true));
        assert!(!searches("", 0, false));
        assert!(!searches("f(\n1", 4, false));
    }
}
