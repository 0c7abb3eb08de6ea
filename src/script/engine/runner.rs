//! Execution of a script on a stack that its limits cannot exhaust.

use std::path::PathBuf;

use rhai::Engine;

use super::parse::parse;
use super::script_engine::{Halt, ScriptEngine};
use super::stack::on_large_stack;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::sources::FOLDER;
use crate::script::diagnose::Diagnostic;
use crate::script::messages::checks::Checks;
use crate::script::messages::error::ScriptError;
use crate::script::messages::stop::Stop;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::settings::RunSettings;

/// Result of a run.
#[derive(Debug)]
pub enum Ending {
    /// The script completed.
    Finished,
    /// The script has an error.
    Failed(Diagnostic),
    /// A dry run reached a loop that waits for a simulation result; no error was found before.
    Undecided,
    /// Interrupted from outside.
    Interrupted,
    /// The reader of the output has closed the pipe.
    PipeClosed,
}

impl From<Halt> for Ending {
    fn from(halt: Halt) -> Self {
        match halt {
            Halt::Failed(diagnostic) => Self::Failed(diagnostic),
            Halt::Undecided(_) => Self::Undecided,
            Halt::Interrupted => Self::Interrupted,
            Halt::PipeClosed => Self::PipeClosed,
        }
    }
}

/// Results of a run.
#[derive(Debug)]
pub struct RunOutcome {
    /// Reason for the end.
    pub ending: Ending,
    /// Checks of the script.
    pub checks: Checks,
    /// Report entries of the simulations.
    pub simulations: Vec<serde_json::Value>,
    /// Files written.
    pub files: Vec<PathBuf>,
    /// Interrupt or limit that stopped the run, if any.
    pub stopped_by: Option<Stop>,
    /// Number of finished study cases that a repeated run will reuse.
    pub kept_cases: usize,
}

impl RunOutcome {
    fn refused(diagnostic: Diagnostic) -> Self {
        Self {
            ending: Ending::Failed(diagnostic),
            checks: Checks::default(),
            simulations: Vec::new(),
            files: Vec::new(),
            stopped_by: None,
            kept_cases: 0,
        }
    }
}

/// Runs `program` in the language of `catalog`.
pub fn run(program: &Program, catalog: &Catalog, settings: RunSettings) -> RunOutcome {
    let limits = settings.limits;
    let run = || run_here(program, catalog, settings);
    on_large_stack(&limits, run).unwrap_or_else(RunOutcome::refused)
}

/// Default memory for the snapshots of a simulation in a script that goes back in time [bytes].
pub const SNAPSHOTS: usize = 256_000_000;

/// Returns true if a script may go back in time; only then snapshots are stored. The library never goes back; other imported files might.
fn may_go_back(program: &Program) -> bool {
    let is_library = |path: Option<&str>| path.is_some_and(|path| path.starts_with(FOLDER));
    let source = &program.text;
    source.names().any(|name| matches!(name, "back" | "rewind"))
        || source.imports().any(|path| !is_library(path))
}

fn run_here(program: &Program, catalog: &Catalog, settings: RunSettings) -> RunOutcome {
    let needed = if may_go_back(program) { SNAPSHOTS } else { 0 };
    let snapshots = settings.snapshots.max(needed);
    let (folder, whole) = (program.folder.clone(), Some(program.clone()));
    let settings = RunSettings { snapshots, folder, program: whole, ..settings };
    let host = match ScriptEngine::open(catalog.clone(), settings) {
        Ok(host) => host,
        Err(diagnostic) => return RunOutcome::refused(diagnostic),
    };
    let run = |engine: &Engine| engine.run_ast(&parse(engine, program)?);
    let done = host.watch().and_then(|guard| host.run(&guard, || program.clone(), run));
    let context = host.context();
    match done {
        Ok(()) => discard_journals(context),
        Err(_) => context.save_remains(),
    }
    RunOutcome {
        ending: done.map_or_else(Ending::from, |()| Ending::Finished),
        checks: context.with_checks(|checks| checks.clone()),
        simulations: context.report(),
        files: context.output().written(),
        stopped_by: context.stopped_by(),
        kept_cases: context.journals().stored_cases(),
    }
}

fn discard_journals(context: &Context) {
    if let Err(ScriptError::Failure(failure)) = context.journals().finish() {
        context.print_message(&failure.message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::packages::language;
    use crate::script::source::lexing::lexings;
    use crate::script::state::settings::RunMode;

    #[test]
    fn a_script_is_lexed_once_whether_it_is_right_or_wrong() {
        for text in [
            "fn f(x) { for i in 0..x { |y| y + i }; x }\nlet E = 2; f(E); // good",
            "fn f(x) { x + unknown }\nf(2);",
            "let a = section(#{ EA: 1, width: 2 });",
            "let a = [1, 2;",
        ] {
            let program = Program::named("a", text);
            let before = lexings();
            let _ = run_here(&program, &language(), RunSettings::silent(RunMode::Run));
            assert_eq!(lexings(), before + 1, "{text}");
        }
    }

    #[test]
    fn only_scripts_that_may_go_back_pay_for_it() {
        let may = |text: &str| may_go_back(&Program::named("a", text));
        assert!(may("sim.back(3);") && may("import \"parts\" as parts;"));
        assert!(!may("import \"std/checks\" as checks; // back"));
    }
}
