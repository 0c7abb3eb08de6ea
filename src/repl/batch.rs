//! A session without a terminal: inputs come from a pipe or from the command line, and the first that fails ends it.

use std::io::BufRead;

use super::editor::completeness::{Completeness, completeness_of_script, is_command};
use super::shell::{Outcome, Shell};
use crate::script::diagnose::Diagnostic;

/// Reads inputs from `lines` until they end, one fails, or the user leaves.
pub fn run(shell: &mut Shell, lines: impl BufRead) -> Outcome {
    let mut input = String::new();
    for line in lines.lines() {
        match line {
            Ok(line) => {
                input.push_str(&line);
                input.push('\n');
            }
            Err(error) => {
                let told = Diagnostic::general(format!("cannot read the input: {error}"));
                return shell.refuse(&told.with_hint("give UTF-8 text"));
            }
        }
        if is_command(&input) || completeness_of_script(&input) == Completeness::Complete {
            match shell.submit(&std::mem::take(&mut input)) {
                Outcome::Good => (),
                other => return other,
            }
        }
    }
    match input.trim() {
        "" => Outcome::Good,
        // It is not complete, and the session says why.
        _ => shell.submit(&input),
    }
}
