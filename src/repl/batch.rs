//! Sessions whose inputs come from a pipe or the command line. The first error ends the session.

use std::io::{self, BufRead, Read};

use super::editor::completeness::{Completeness, completeness_of_script, is_command};
use super::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::source::program::LARGEST_SCRIPT;

/// Returns true if a line begins with a dot, `else` or `catch`. Such a line continues the previous input, even if that could be complete.
fn continues(line: &str) -> bool {
    let line = line.trim_start();
    let is_word = |word: &str| {
        line.strip_prefix(word)
            .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    (line.starts_with('.') && !line.starts_with(".."))
        || line.starts_with("?.")
        || is_word("else")
        || is_word("catch")
}

fn lines_of(mut reader: impl BufRead) -> impl Iterator<Item = io::Result<String>> {
    std::iter::from_fn(move || {
        let mut line = String::new();
        match reader.by_ref().take(LARGEST_SCRIPT).read_line(&mut line) {
            Ok(0) => None,
            Ok(count) if count as u64 == LARGEST_SCRIPT && !line.ends_with('\n') => {
                Some(Err(io::Error::other("a line is too long")))
            }
            Ok(_) => {
                let text = line.strip_suffix('\n').unwrap_or(&line);
                Some(Ok(text.strip_suffix('\r').unwrap_or(text).to_owned()))
            }
            Err(error) => Some(Err(error)),
        }
    })
}

pub fn run(shell: &mut Shell, lines: impl BufRead) -> CommandOutcome {
    let mut input = String::new();
    let mut lines = lines_of(lines).peekable();
    while let Some(line) = lines.next() {
        match line {
            Ok(line) => {
                input.push_str(line.trim_start_matches('\u{feff}'));
                input.push('\n');
            }
            Err(error) => {
                let message = Diagnostic::general(format!("cannot read the input: {error}"));
                return shell.report_error(&message.with_hint("the input must be UTF-8 text"));
            }
        }
        if input.len() as u64 > LARGEST_SCRIPT {
            let message = Diagnostic::general("an input is longer than 16 megabytes");
            return shell.report_error(
                &message.with_hint("is a bracket or a quotation mark never closed?"),
            );
        }
        // An input is evaluated only when the next line is known, because that line may continue the input.
        // A program that waits for each reply must end its inputs with a semicolon or an empty line.
        let is_complete = is_command(&input)
            || completeness_of_script(&input) == Completeness::Complete
                && (input.trim_end().ends_with(';')
                    || !matches!(lines.peek(), Some(Ok(next)) if continues(next)));
        if is_complete {
            match shell.submit(&std::mem::take(&mut input)) {
                CommandOutcome::Success => (),
                other => return other,
            }
        }
    }
    match input.trim() {
        "" => CommandOutcome::Success,
        // An incomplete input is evaluated too, so that its error is reported.
        _ => shell.submit(&input),
    }
}
