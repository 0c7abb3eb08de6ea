//! Conversion of an error to text with source line, caret, message and hint.

use std::ops::Range;

use codespan_reporting::diagnostic::{Diagnostic as Drawing, Label, LabelStyle};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::termcolor::Buffer;
use codespan_reporting::term::{self, Config};

use super::{Blame, CallFrame, Callee, Diagnostic, Location};
pub use crate::output::Colours;
use crate::output::{columns, printable};

impl Diagnostic {
    /// Text of the error with a final newline.
    pub fn render(&self, colours: Colours) -> String {
        self.render_within(colours, usize::MAX)
    }

    /// Text of the error with the hint wrapped at `width` columns, because a terminal would break it within words.
    pub fn render_within(&self, colours: Colours, width: usize) -> String {
        let drawing = match self.blame {
            Blame::User => Drawing::error(),
            Blame::Program => Drawing::bug(),
        };
        let drawing = drawing.with_message(printable(&self.message)).with_notes(self.notes(width));
        let no_file = || SimpleFile::new(String::new(), String::new());
        let (file, drawing) = match &self.location {
            Some(at) if at.line_length() <= LONGEST_DRAWN => {
                let name = printable(&at.program.name).into_owned();
                let text = printable(&at.program.text).into_owned();
                let place = at.bytes_in(&text);
                let label = Label::new(LabelStyle::Primary, (), place);
                (SimpleFile::new(name, text), drawing.with_label(label))
            }
            Some(at) => {
                (no_file(), drawing.with_notes(vec![printable(&at.in_words()).into_owned()]))
            }
            None => (no_file(), drawing),
        };
        let mut buffer = match colours {
            Colours::None => Buffer::no_color(),
            Colours::Ansi => Buffer::ansi(),
        };
        match term::emit_to_write_style(&mut buffer, &Config::default(), &file, &drawing) {
            Ok(()) => format!("{}\n", String::from_utf8_lossy(buffer.as_slice()).trim_end()),
            // A location outside the text is an internal error, but the message is still shown.
            Err(_) => format!("error: {}\n", printable(&self.message)),
        }
    }

    /// Hint, wrapped at `width` columns, and call trace, one text each.
    pub fn notes(&self, width: usize) -> Vec<String> {
        let room = width.saturating_sub(BESIDE_HINT).max(NARROWEST);
        let hint = self.hint.iter().map(|hint| {
            let lines: Vec<String> = hint.lines().flat_map(|line| wrapped(line, room)).collect();
            format!("help: {}", lines.join("\n      "))
        });
        let notes = hint.chain(shown_steps(&self.trace));
        notes.map(|note| printable(&note).into_owned()).collect()
    }
}

/// Largest length of a source line that is shown [characters]. The location in a longer line is described in words.
const LONGEST_DRAWN: usize = 1000;
const LONGEST_EXCERPT: usize = 60;

/// Width of `  = help: ` before the hint [columns].
const BESIDE_HINT: usize = 10;

const NARROWEST: usize = 30;

fn wrapped(line: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut current = String::new();
    for word in line.split(' ') {
        if !current.is_empty() && columns(&current) + 1 + columns(word) > width {
            lines.push(std::mem::take(&mut current));
        }
        if !current.is_empty() {
            current.push(' ');
        }
        current.push_str(word);
    }
    lines.push(current);
    lines
}

fn shown_steps(trace: &[CallFrame]) -> Vec<String> {
    const SHOWN: usize = 8;
    let mut lines: Vec<_> = trace.iter().take(SHOWN).map(CallFrame::to_string).collect();
    if trace.len() > SHOWN {
        lines.push(format!("… and {} more calls", trace.len() - SHOWN));
    }
    lines
}

impl std::fmt::Display for CallFrame {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let reached = match &self.callee {
            Callee::Closure => {
                f.write_str("in a closure")?;
                "called"
            }
            Callee::Function(name) => {
                write!(f, "in '{name}'")?;
                "called"
            }
            Callee::File(name) => {
                write!(f, "in the file {name}")?;
                "imported"
            }
            Callee::Library => {
                f.write_str("in the library")?;
                "raised"
            }
        };
        match (self.line, &self.file) {
            (Some(line), Some(file)) => write!(f, ", {reached} at {file}:{line}"),
            (Some(line), None) => write!(f, ", {reached} at line {line}"),
            (None, _) => Ok(()),
        }
    }
}

impl Location {
    /// Part of the script text to which the location refers.
    pub fn text(&self) -> &str {
        &self.program.text[self.bytes()]
    }

    fn line_length(&self) -> usize {
        self.program.text.lines().nth(self.line - 1).map_or(0, |line| line.chars().count())
    }

    fn in_words(&self) -> String {
        let line = self.program.text.lines().nth(self.line - 1).unwrap_or_default();
        let there: String = line.chars().skip(self.column - 1).take(LONGEST_EXCERPT).collect();
        format!("at {}:{}:{}, in a long line: {there} …", self.program.name, self.line, self.column)
    }

    fn bytes_in(&self, text: &str) -> Range<usize> {
        let bytes = self.bytes();
        let characters = |end: usize| self.program.text[..end].chars().count();
        let offset = |at: usize| text.char_indices().nth(at).map_or(text.len(), |(byte, _)| byte);
        offset(characters(bytes.start))..offset(characters(bytes.end))
    }

    /// Position in the text of the script [bytes].
    pub fn bytes(&self) -> Range<usize> {
        let start = self.program.offset(self.line, self.column);
        start..self.program.offset(self.line, self.column + self.length).max(start)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::script::source::program::Program;

    #[test]
    fn long_source_line_is_not_quoted_completely() {
        let program =
            Program::named("long.rhai", &format!("\nlet a = [{}wrong];", "1, ".repeat(20_000)));
        let at = Location { program: Arc::new(program), line: 2, column: 60_010, length: 5 };
        let diagnostic = Diagnostic { location: Some(at), ..Diagnostic::general("no such name") };
        let shown = diagnostic.render(Colours::None);
        assert!(shown.contains("at long.rhai:2:60010, in a long line: wrong];"), "{shown}");
        assert!(shown.len() < 500, "{shown}");
    }

    #[test]
    fn control_characters_are_replaced_and_the_caret_stays_aligned() {
        let line = "let a = \"\u{1b}]0;title\u{7}\u{202e}\" + wrong; // \u{9b}2J";
        let program = Program::named("a\u{1b}[2J.rhai", line);
        let column = line.chars().take_while(|letter| *letter != 'w').count() + 1;
        let at = Location { program: Arc::new(program), line: 1, column, length: 5 };
        let message = "no \r\u{1b}[31mname";
        let diagnostic = Diagnostic { location: Some(at), ..Diagnostic::general(message) };
        let shown = diagnostic.with_hint("\u{200b}hint\u{7f}").render(Colours::None);
        let is_harmful = |letter: char| letter.is_control() && letter != '\n';
        assert!(
            !shown.contains(is_harmful) && !shown.contains(['\u{202e}', '\u{200b}']),
            "{shown:?}"
        );
        let lines: Vec<&str> = shown.lines().collect();
        let at = |line: &str, sign: char| line.chars().position(|letter| letter == sign);
        let quoted = lines.iter().position(|line| line.contains("wrong")).unwrap();
        assert_eq!(at(lines[quoted + 1], '^'), at(lines[quoted], 'w'), "{shown}");
    }

    #[test]
    fn hints_are_wrapped_between_words() {
        let diagnostic =
            Diagnostic::general("wrong").with_hint(format!("{}\nend", "word ".repeat(12)));
        let shown = diagnostic.render_within(Colours::None, 40);
        assert!(shown.lines().all(|line| line.chars().count() <= 40), "{shown}");
        assert_eq!(shown.matches("word").count(), 12, "{shown}");
        assert!(diagnostic.render(Colours::None).contains(&"word ".repeat(11)));
    }
}
