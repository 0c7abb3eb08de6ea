//! Completion, hints and highlighting for the library rustyline.

use std::borrow::Cow;
use std::cell::Cell;

use rustyline::completion::{self, Completer};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::{self, Hinter, HistoryHinter};
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Context, Helper, Result};

use crate::output::{Colours, columns, cut, padded};
use crate::repl::editor::candidates::Candidate;
use crate::repl::editor::completeness::{Completeness, completeness};
use crate::repl::editor::completion::complete;
use crate::repl::editor::highlight::{SessionNames, highlight};
use crate::repl::editor::hints::{self, Hint};

const SHORT_LIST: usize = 12;

pub struct Assistant {
    vocabulary: SessionNames,
    columns: usize,
    prompt_width: usize,
    colours: Colours,
    from_history: HistoryHinter,
    /// True while the completed line is drawn for the last time, which is done without hints.
    is_final: Cell<bool>,
}

impl Assistant {
    pub fn new(
        vocabulary: SessionNames,
        columns: usize,
        prompt_width: usize,
        colours: Colours,
    ) -> Self {
        let from_history = HistoryHinter::new();
        Self {
            vocabulary,
            columns,
            prompt_width,
            colours,
            from_history,
            is_final: Cell::new(false),
        }
    }

    fn fit(&self, line: &str, hint: Hint) -> Option<Hint> {
        if hint.insertable.is_some() {
            return Some(hint);
        }
        let last = columns(line.rsplit('\n').next().unwrap_or_default());
        let prompt = if line.contains('\n') { 0 } else { self.prompt_width };
        let room = self.columns.checked_sub(last + prompt + 1).filter(|room| *room >= 10)?;
        Some(Hint { shown: cut(&hint.shown, room, '…'), insertable: None })
    }
}

impl Helper for Assistant {}

pub struct Listed {
    display: String,
    replacement: String,
}

impl completion::Candidate for Listed {
    fn display(&self) -> &str {
        &self.display
    }

    fn replacement(&self) -> &str {
        &self.replacement
    }
}

impl Completer for Assistant {
    type Candidate = Listed;

    fn complete(
        &self,
        line: &str,
        position: usize,
        _: &Context<'_>,
    ) -> Result<(usize, Vec<Listed>)> {
        let (start, candidates) = complete(line, position, self.vocabulary.surroundings());
        Ok((start, list(candidates, self.columns)))
    }
}

fn list(candidates: Vec<Candidate>, room: usize) -> Vec<Listed> {
    let widest = candidates.iter().map(|candidate| columns(&candidate.display)).max().unwrap_or(0);
    let is_described = candidates.len() <= SHORT_LIST
        && candidates.iter().any(|candidate| !candidate.summary.is_empty());
    let listed = candidates.into_iter().map(|candidate| {
        let display = match is_described {
            true => format!("{}  {}", padded(&candidate.display, widest), candidate.summary),
            false => candidate.display,
        };
        Listed {
            display: cut(display.trim_end(), room.saturating_sub(2), '…'),
            replacement: candidate.replacement,
        }
    });
    listed.collect()
}

impl hint::Hint for Hint {
    fn display(&self) -> &str {
        &self.shown
    }

    fn completion(&self) -> Option<&str> {
        self.insertable.as_deref()
    }
}

impl Hinter for Assistant {
    type Hint = Hint;

    fn hint(&self, line: &str, position: usize, context: &Context<'_>) -> Option<Hint> {
        let known = hints::hint(line, position, self.vocabulary.surroundings());
        let hint = known.and_then(|hint| self.fit(line, hint));
        let remembered = || self.from_history.hint(line, position, context).map(remembered);
        // Hints that can be inserted are not shown without colours, because they would look like typed text.
        hint.or_else(remembered)
            .filter(|hint| self.colours == Colours::Ansi || hint.insertable.is_none())
    }
}

/// Hint with the first line of the rest of a history entry; one line only, so that the height of the input does not change.
fn remembered(rest: String) -> Hint {
    let shown = match rest.split_once('\n') {
        Some((first, _)) => format!("{first} …"),
        None => rest.clone(),
    };
    Hint { shown, insertable: Some(rest) }
}

impl Highlighter for Assistant {
    fn highlight<'l>(&self, line: &'l str, position: usize) -> Cow<'l, str> {
        let cursor = (!self.is_final.get()).then_some(position);
        Cow::Owned(highlight(line, cursor, &self.vocabulary))
    }

    fn highlight_prompt<'b, 's: 'b, 'p: 'b>(&'s self, prompt: &'p str, _: bool) -> Cow<'b, str> {
        Cow::Owned(format!("\x1b[1m{prompt}\x1b[0m"))
    }

    fn highlight_hint<'h>(&self, hint: &'h str) -> Cow<'h, str> {
        Cow::Owned(format!("\x1b[2m{hint}\x1b[0m"))
    }

    fn highlight_char(&self, _: &str, _: usize, kind: CmdKind) -> bool {
        self.is_final.set(kind == CmdKind::ForcedRefresh);
        true
    }
}

impl Validator for Assistant {
    fn validate(&self, context: &mut ValidationContext) -> Result<ValidationResult> {
        Ok(match completeness(context.input()) {
            Completeness::Complete => ValidationResult::Valid(None),
            Completeness::Open(_) => ValidationResult::Incomplete,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::repl::editor::samples::surroundings;

    fn assistant(columns: usize) -> Assistant {
        Assistant::new(SessionNames::of(surroundings()), columns, 2, Colours::Ansi)
    }

    #[test]
    fn short_candidate_lists_show_summaries() {
        let (_, candidates) = complete(":s", 2, &surroundings());
        let listed = list(candidates, 30);
        let shown: Vec<_> = listed.iter().map(|candidate| candidate.display.as_str()).collect();
        assert_eq!(
            shown,
            [":save  Writes the session a…", ":show  Draws the beam.", ":step  Takes steps."]
        );
        let (_, many) = complete("", 0, &surroundings());
        assert!(list(many, 80).iter().all(|candidate| !candidate.display.contains("  ")));
    }

    #[test]
    fn completions_are_not_hinted_without_colours() {
        let history = rustyline::history::DefaultHistory::new();
        let context = Context::new(&history);
        let plain = Assistant::new(SessionNames::of(surroundings()), 80, 2, Colours::None);
        assert!(plain.hint("rod.e", 5, &context).is_none());
        assert!(plain.hint("line(", 5, &context).is_some());
        assert!(assistant(80).hint("rod.e", 5, &context).is_some());
    }

    #[test]
    fn history_hint_shows_the_first_line_of_an_entry() {
        let hint = remembered("(x) {\n    x\n}".into());
        assert_eq!(hint.shown, "(x) { …");
        assert_eq!(hint.insertable.as_deref(), Some("(x) {\n    x\n}"));
    }

    #[test]
    fn hints_are_cut_to_the_remaining_width() {
        let note = || hints::hint("line(", 5, &surroundings()).expect("a hint");
        let shown = assistant(40).fit("line(", note()).expect("room").shown;
        assert!(shown.chars().count() == 32 && shown.ends_with('…'), "{shown}");
        assert_eq!(assistant(12).fit("line(", note()), None);
    }
}
