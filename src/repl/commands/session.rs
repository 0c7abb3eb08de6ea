//! Commands that keep, fetch, forget and leave a session.

use std::fs;
use std::path::Path;

use crate::output::write_whole;
use crate::repl::record::HEADER;
use crate::repl::shell::{Outcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::program::Program;

/// `:save file`
pub fn save(shell: &mut Shell, operand: &str) -> Outcome {
    if operand.is_empty() {
        let told = Diagnostic::general("the name of a file is missing");
        return shell.refuse(&told.with_hint("write :save FILE.rhai"));
    }
    let path = Path::new(operand);
    // Somebody's own script must not be lost by a slip.
    if fs::read_to_string(path).is_ok_and(|text| !text.starts_with(HEADER)) || path.is_dir() {
        let told = format!("'{operand}' is there already, and was not written by :save");
        return shell.refuse(&Diagnostic::general(told).with_hint("choose another name"));
    }
    let record = shell.session().record();
    let (script, redefined) = (record.script(), record.redefined());
    if let Err(error) = write_whole(path, script.as_bytes()) {
        return shell.refuse(&Diagnostic::general(format!("cannot save the session: {error}")));
    }
    for name in redefined {
        shell.note(&format!("'{name}' was defined more than once: in the script its last definition holds everywhere"));
    }
    shell.print(&format!("saved to {operand}"));
    Outcome::Good
}

/// `:load file`
pub fn load(shell: &mut Shell, operand: &str) -> Outcome {
    if operand.is_empty() {
        let told = Diagnostic::general("the name of a file is missing");
        return shell.refuse(&told.with_hint("write :load FILE.rhai"));
    }
    match Program::load(Path::new(operand)) {
        Ok(program) => shell.run_program(program),
        Err(refusal) => shell.refuse(&refusal),
    }
}

/// `:reset`
pub fn reset(shell: &mut Shell, _: &str) -> Outcome {
    shell.reset();
    Outcome::Good
}

/// `:quit`
pub fn quit(_: &mut Shell, _: &str) -> Outcome {
    Outcome::Quit
}
