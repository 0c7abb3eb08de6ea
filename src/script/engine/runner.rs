//! Execution of a script on a large stack.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use rhai::{Engine, INT, Scope};

use super::inputs::{declare_inputs, expect_declared};
use super::parse::parse;
use super::script_engine::{Halt, ScriptEngine};
use super::stack::on_large_stack;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::sources::FOLDER;
use crate::script::diagnose::Diagnostic;
use crate::script::messages::checks::Checks;
use crate::script::messages::error::ScriptError;
use crate::script::messages::stop::Stop;
use crate::script::source::pitfalls;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::settings::{ErrorEstimation, RunMode, RunSettings};

/// Result of a run.
#[derive(Debug)]
pub enum Ending {
    /// The script completed.
    Finished,
    /// The script has an error or exceeded a limit, or an internal error occurred.
    Failed(Diagnostic),
    /// A dry run reached a loop that waits for the result of a simulation, without an error before it.
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
    /// Reason for the end of the run.
    pub ending: Ending,
    /// Checks of the script.
    pub checks: Checks,
    /// Report entries of the simulations.
    pub simulations: Vec<serde_json::Value>,
    /// Estimated errors of the simulations, one line each, or a remark that errors are not estimated.
    pub errors: Vec<String>,
    /// Files written.
    pub files: Vec<PathBuf>,
    /// Interrupt or limit that stopped the run; `None` if it was not stopped.
    pub stopped_by: Option<Stop>,
    /// Number of completed study cases that can be reused if the script is run again.
    pub kept_cases: usize,
}

impl RunOutcome {
    /// Summary of the run, line by line: written files, estimated errors, and counts of the checks.
    pub fn summary(&self) -> Vec<String> {
        let files = self.files.iter().map(|file| format!("wrote {}", file.display()));
        files.chain(self.errors.iter().cloned()).chain(self.checks.summary()).collect()
    }

    fn refused(diagnostic: Diagnostic) -> Self {
        Self {
            ending: Ending::Failed(diagnostic),
            checks: Checks::default(),
            simulations: Vec::new(),
            errors: Vec::new(),
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

/// Default memory for the snapshots of a simulation [bytes], for scripts that may rewind.
pub const SNAPSHOTS: usize = 256_000_000;

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
    let estimation = settings.errors;
    let settings = RunSettings { snapshots, folder, program: whole, ..settings };
    let host = match ScriptEngine::open(catalog.clone(), settings) {
        Ok(host) => host,
        Err(diagnostic) => return RunOutcome::refused(diagnostic),
    };
    let begun = Instant::now();
    let mut errors = Vec::new();
    let run = |engine: &Engine| {
        let (ast, context) = (parse(engine, program)?, host.context());
        pitfalls::messages(&program.text, 0).iter().for_each(|note| context.print_message(note));
        let names = match context.inputs().are_defaults() && context.mode() == RunMode::Run {
            true => Vec::new(),
            false => declare_inputs(engine, context, (&ast, &program.text), &program.folder)?,
        };
        engine.run_ast(&ast)?;
        expect_declared(context, &names)?;
        errors = estimated_errors(engine, host.context(), (estimation, begun.elapsed()));
        Ok(())
    };
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
        errors,
        files: context.output().written(),
        stopped_by: context.stopped_by(),
        kept_cases: context.journals().stored_cases(),
    }
}

/// Largest run time after which errors are estimated although the user has not requested it.
const BRIEF: Duration = Duration::from_secs(1);

const MOST_ESTIMATES: usize = 5;

fn estimated_errors(
    engine: &Engine,
    context: &Context,
    (estimation, elapsed): (ErrorEstimation, Duration),
) -> Vec<String> {
    let steps = |of: &rhai::Dynamic| ask::<INT>(engine, of, "object.steps").unwrap_or(0);
    let ran: Vec<rhai::Dynamic> =
        context.simulations().into_iter().filter(|of| steps(of) > 0).collect();
    let has_limit = context.meter().limits().steps.is_some();
    let options = match estimation {
        ErrorEstimation::Never => return Vec::new(),
        _ if ran.is_empty() => return Vec::new(),
        ErrorEstimation::Always => String::new(),
        ErrorEstimation::Auto if elapsed < BRIEF && !has_limit => {
            format!("#{{ max_time: {:?} }}", elapsed.as_secs_f64().max(0.01))
        }
        _ => return vec!["estimated error: not estimated; use --error to estimate it".to_owned()],
    };
    let mut lines = Vec::new();
    for simulation in ran.iter().take(MOST_ESTIMATES) {
        let name = ask::<String>(engine, simulation, "object.name").unwrap_or_default();
        let request = format!("object.error_estimate({options}).summary");
        let estimate = ask::<String>(engine, simulation, &request);
        let estimate = estimate.unwrap_or_else(|reason| format!("not estimated: {reason}"));
        lines.push(format!("estimated error of '{name}': {estimate}"));
    }
    let number = ran.len() + context.released_simulations();
    if let Some(more) = number.checked_sub(MOST_ESTIMATES).filter(|more| *more > 0) {
        lines.push(format!("estimated error: not estimated for {more} further simulations"));
    }
    lines
}

fn ask<T: Clone + Send + Sync + 'static>(
    engine: &Engine,
    object: &rhai::Dynamic,
    expression: &str,
) -> Result<T, String> {
    let mut scope = Scope::new();
    scope.push_dynamic("object", object.clone());
    engine.eval_with_scope(&mut scope, expression).map_err(|error| error.to_string())
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

    #[test]
    fn valid_and_invalid_scripts_are_lexed_once() {
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
    fn scripts_that_may_rewind_are_detected() {
        let may = |text: &str| may_go_back(&Program::named("a", text));
        assert!(may("sim.back(3);") && may("import \"parts\" as parts;"));
        assert!(!may("import \"std/checks\" as checks; // back"));
    }
}
