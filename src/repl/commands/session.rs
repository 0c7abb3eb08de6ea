//! Commands that save, load, reset and end a session.

use std::path::Path;

use crate::output::{printable, write_atomic};
use crate::repl::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::source::program::Program;
use crate::script::state::inputs::{InputSetting, Inputs};

pub fn save(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let operand = operand.trim_matches('"');
    if operand.is_empty() {
        let message = Diagnostic::general("the name of a file is missing");
        return shell.report_error(&message.with_hint("write :save FILE.rhai"));
    }
    let path = Path::new(operand);
    // A file of another program, or a file edited after this program wrote it, is not overwritten.
    if !shell.may_write(path) {
        let message = format!("'{operand}' exists and was not written by this session");
        return shell.report_error(&Diagnostic::general(message).with_hint("choose another name"));
    }
    let script = match shell.session().script() {
        Ok(script) => script,
        Err(why) => {
            shell
                .print_note("the session cannot be saved, because the script would have an error:");
            return shell.report_error(&why);
        }
    };
    let record = shell.session().record();
    let (redefined, has_returned) = (record.redefined(), record.has_returned());
    if let Err(error) = write_atomic(path, script.as_bytes()) {
        return shell
            .report_error(&Diagnostic::general(format!("cannot save the session: {error}")));
    }
    for name in redefined {
        shell.print_note(&format!(
            "'{name}' was defined more than once; the script uses its last definition everywhere"
        ));
    }
    if has_returned {
        shell.print_note("inputs with a return statement are saved as comments");
    }
    shell.record_saved(path, script);
    shell.print(&format!("saved to {}", printable(operand)));
    CommandOutcome::Success
}

pub fn load(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let mut parts = operand.split("--set ").map(str::trim);
    let file = parts.next().unwrap_or_default().trim_matches('"');
    if file.is_empty() {
        let message = Diagnostic::general("the name of a file is missing");
        return shell.report_error(&message.with_hint("write :load FILE.rhai"));
    }
    let settings: Result<Vec<InputSetting>, String> = parts.map(str::parse).collect();
    let inputs = match settings.and_then(Inputs::new) {
        Ok(inputs) => inputs,
        Err(wrong) => {
            let message = Diagnostic::general(format!(":load --set: {wrong}"));
            return shell.report_error(&message.with_hint("write :load FILE --set NAME=VALUE"));
        }
    };
    match Program::load(Path::new(file)) {
        Ok(program) => shell.run_program(program, inputs),
        Err(refused) => shell.report_error(&refused.into()),
    }
}

pub fn reset(shell: &mut Shell, _: &str) -> CommandOutcome {
    shell.reset();
    CommandOutcome::Success
}

pub fn quit(_: &mut Shell, _: &str) -> CommandOutcome {
    CommandOutcome::Quit
}
