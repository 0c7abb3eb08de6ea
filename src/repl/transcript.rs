//! Transcript of all inputs of a session. It finds the input in which an error occurred from the line number of the error.

use std::sync::Arc;

use crate::script::diagnose::{Diagnostic, Location};
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;

/// Name of typed inputs in messages.
pub const PROMPT: &str = "prompt";

/// Largest number of lines in a session, limited by the engine, after which lines are counted from 1 again.
const MOST_LINES: usize = 60_000;

struct TranscriptInput {
    program: Program,
    before: usize,
    is_valid: bool,
}

pub struct Transcript {
    pieces: Vec<TranscriptInput>,
    lines: usize,
    folder: std::path::PathBuf,
}

impl Transcript {
    pub fn new(folder: std::path::PathBuf) -> Self {
        Self { pieces: Vec::new(), lines: 0, folder }
    }

    pub fn next_line(&self) -> usize {
        self.lines + 1
    }

    pub fn add(&mut self, program: Program) -> usize {
        let lines = program.text.lines().count().max(1);
        if self.lines + lines > MOST_LINES {
            self.pieces.clear();
            self.lines = 0;
        }
        let before = self.lines;
        self.lines += lines;
        self.pieces.push(TranscriptInput { program, before, is_valid: true });
        before
    }

    pub fn typed(&self, text: &str) -> Program {
        Program { folder: self.folder.clone(), ..Program::named(PROMPT, text) }
    }

    pub fn mark_last_failed(&mut self) {
        if let Some(last) = self.pieces.last_mut() {
            last.is_valid = false;
        }
    }

    pub fn remove_last(&mut self) {
        if let Some(last) = self.pieces.pop() {
            self.lines = last.before;
        }
    }

    pub fn to_program(&self) -> Program {
        let mut text = String::new();
        for (index, piece) in self.pieces.iter().enumerate() {
            let is_shown = piece.is_valid || index + 1 == self.pieces.len();
            let mut lines = 0;
            for line in piece.program.text.lines() {
                text.push_str(if is_shown { line } else { "" });
                text.push('\n');
                lines += 1;
            }
            if lines == 0 {
                text.push('\n');
            }
        }
        self.typed(&text)
    }

    pub fn variables(&self) -> Vec<(String, usize)> {
        let shown = self.shown();
        let of_piece = |piece: &TranscriptInput| {
            let before = piece.before;
            let own = ScriptOutline::of(&piece.program.text).top_level.into_iter();
            own.map(move |(name, line)| (name, line + before))
        };
        shown.flat_map(of_piece).collect()
    }

    fn shown(&self) -> impl Iterator<Item = &TranscriptInput> {
        let last = self.pieces.len().saturating_sub(1);
        let pieces = self.pieces.iter().enumerate();
        pieces
            .filter(move |(index, piece)| piece.is_valid || *index == last)
            .map(|(_, piece)| piece)
    }

    pub fn relocate(&self, mut diagnostic: Diagnostic) -> Diagnostic {
        for step in &mut diagnostic.trace {
            if step.file.is_none()
                && let Some(line) = &mut step.line
                && let Some(piece) = self.file_of(*line)
            {
                *line -= piece.before;
                step.file = Some(piece.program.name.clone());
            }
        }
        if let Some(at) = &mut diagnostic.location
            && at.program.name == PROMPT
            && let Some(piece) = self.file_of(at.line)
        {
            *at = Location {
                program: Arc::new(piece.program.clone()),
                line: at.line - piece.before,
                ..at.clone()
            };
        }
        diagnostic
    }

    fn file_of(&self, line: usize) -> Option<&TranscriptInput> {
        let piece = self.pieces.iter().rev().find(|piece| piece.before < line)?;
        (piece.program.name != PROMPT).then_some(piece)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transcript_numbers_the_lines_of_inputs() {
        let mut transcript = Transcript::new(".".into());
        assert_eq!(transcript.add(transcript.typed("let a = 1;")), 0);
        assert_eq!(transcript.add(transcript.typed("fn f() {\n  2\n}")), 1);
        assert_eq!(transcript.next_line(), 5);
        transcript.add(transcript.typed("let b = 2;"));
        assert_eq!(transcript.variables(), [("a".to_owned(), 1), ("b".to_owned(), 5)]);
        transcript.remove_last();
        assert_eq!(&*transcript.to_program().text, "let a = 1;\nfn f() {\n  2\n}\n");
    }

    #[test]
    fn failed_input_is_blank_in_later_programs() {
        let mut transcript = Transcript::new(".".into());
        transcript.add(transcript.typed("let a = oops();"));
        transcript.mark_last_failed();
        assert_eq!(
            &*transcript.to_program().text,
            "let a = oops();\n",
            "it is shown while it is explained"
        );
        transcript.add(transcript.typed("a"));
        assert_eq!(&*transcript.to_program().text, "\na\n");
    }

    #[test]
    fn errors_in_files_are_located_in_the_file() {
        let mut transcript = Transcript::new(".".into());
        transcript.add(transcript.typed("1"));
        transcript.add(Program::named("beam.rhai", "let a = 1;\nlet b = ;"));
        let at = |line| Location {
            program: Arc::new(transcript.to_program()),
            line,
            column: 9,
            length: 1,
        };
        let found = |line| {
            let diagnostic = Diagnostic { location: Some(at(line)), ..Diagnostic::general("") };
            transcript.relocate(diagnostic).location_text()
        };
        assert_eq!(found(3).as_deref(), Some("beam.rhai:2:9"));
        assert_eq!(found(1).as_deref(), Some("prompt:1:9"));
    }

    #[test]
    fn line_numbers_restart_after_the_maximum() {
        let mut transcript = Transcript::new(".".into());
        transcript.add(transcript.typed(&"\n".repeat(MOST_LINES - 1)));
        assert_eq!(transcript.add(transcript.typed("1\n2")), 0);
        assert_eq!(transcript.next_line(), 3);
    }
}
