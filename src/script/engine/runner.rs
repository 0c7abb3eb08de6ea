//! Running a script from beginning to end, on a stack that its limits cannot exhaust.

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

/// How the run of a script ended.
#[derive(Debug)]
pub enum Ending {
    /// The script came to its end.
    Finished,
    /// The script is wrong.
    Failed(Diagnostic),
    /// A dry build came to a loop that waits for what a simulation finds; nothing before it is wrong.
    Undecided,
    /// The run was stopped from outside.
    Interrupted,
    /// The run was stopped, for the reader of its output went away.
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

/// What is left after the run of a script.
#[derive(Debug)]
pub struct RunOutcome {
    /// How the run ended.
    pub ending: Ending,
    /// The checks that the script made.
    pub checks: Checks,
    /// What each simulation of the run says about itself.
    pub simulations: Vec<serde_json::Value>,
    /// The files that the run has written.
    pub files: Vec<PathBuf>,
    /// What stopped the run before its end, if something from outside or a limit did.
    pub stopped_by: Option<Stop>,
    /// The number of finished cases of studies that another run of the same script will not repeat.
    pub kept_cases: usize,
}

impl RunOutcome {
    /// A run that could not begin.
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

/// Runs `program` in the language of `catalog`; gives what is left after the run.
pub fn run(program: &Program, catalog: &Catalog, settings: RunSettings) -> RunOutcome {
    let limits = settings.limits;
    let run = || run_here(program, catalog, settings);
    on_large_stack(&limits, run).unwrap_or_else(RunOutcome::refused)
}

/// The memory that a simulation may take for states to go back to, in a script that goes back [bytes].
pub const SNAPSHOTS: usize = 256_000_000;

/// Whether a script may go back in time: a scene pays only for what it uses. The library never does; what another imported file does is
/// not known.
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
        kept_cases: context.journals().kept(),
    }
}

/// Lets go of what studies have kept; a file that stays is in nobody's way, but is told of.
fn discard_journals(context: &Context) {
    if let Err(ScriptError::Failure(failure)) = context.journals().finish() {
        context.tell(&failure.message);
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
