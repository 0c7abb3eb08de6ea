//! Running a script from beginning to end, on a stack that its limits cannot exhaust.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::thread;

use rhai::{AST, Engine, EvalAltResult, Token};

use super::catalog::Catalog;
use super::checks::Checks;
use super::context::{Context, Settings};
use super::diagnose::{Diagnostic, Explainer, is_interrupt};
use super::engine;
use super::error::ScriptError;
use super::lexing::{open_comment, tokens};
use super::panics;
use super::program::Program;
use super::syntax::mark_assignments;

/// Address space for the stack of a script; memory is used only as deep as the script really goes.
pub const STACK_BYTES: usize = 256 << 20;

/// How a run ended.
#[derive(Debug)]
pub enum Ending {
    /// The script came to its end.
    Finished,
    /// It is wrong.
    Failed(Diagnostic),
    /// It was stopped from outside.
    Interrupted,
    /// The reader of its output went away.
    PipeClosed,
}

/// What is left after a run.
#[derive(Debug)]
pub struct Outcome {
    /// How it ended.
    pub ending: Ending,
    /// What the script checked.
    pub checks: Checks,
    /// What each simulation says about itself.
    pub simulations: Vec<serde_json::Value>,
    /// The files written.
    pub files: Vec<PathBuf>,
}

/// Runs `program` in the language of `catalog`.
pub fn run(program: &Program, catalog: &Catalog, settings: Settings) -> Outcome {
    on_large_stack(|| run_here(program, catalog, settings)).unwrap_or_else(|diagnostic| Outcome {
        ending: Ending::Failed(diagnostic),
        checks: Checks::default(),
        simulations: Vec::new(),
        files: Vec::new(),
    })
}

/// Does `work` on a thread with a stack of [`STACK_BYTES`].
pub fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, Diagnostic> {
    thread::scope(|scope| {
        let thread = thread::Builder::new().name("script".into()).stack_size(STACK_BYTES);
        let running = thread.spawn_scoped(scope, work).map_err(|error| {
            Diagnostic::general(format!("cannot start a thread for the script: {error}"))
        })?;
        running.join().map_err(|panic| Diagnostic::bug(panics::message(&*panic)))
    })
}

/// Parses `program`; imports are looked for beside it.
pub fn compile(engine: &mut Engine, program: &Program) -> Result<AST, Box<EvalAltResult>> {
    engine::import_from(engine, &program.folder);
    let mut ast = engine.compile(mark_assignments(&program.text))?;
    ast.set_source(program.name.as_str());
    match open_comment(&program.text) {
        Some(position) => Err(ScriptError::new("a comment that begins with /* is never closed")
            .hint("write */ where it ends")
            .into_engine(position)),
        None => Ok(ast),
    }
}

/// What a simulation may keep to go back to, in a script that goes back [bytes].
pub const SNAPSHOTS: usize = 256_000_000;

/// Whether a script may go back in time: a scene pays only for what it uses. What an imported file does is not known.
fn may_go_back(program: &Program) -> bool {
    tokens(&program.text).iter().any(|(token, _)| match token {
        Token::Identifier(name) => matches!(name.as_str(), "back" | "rewind"),
        Token::Import => true,
        _ => false,
    })
}

fn run_here(program: &Program, catalog: &Catalog, settings: Settings) -> Outcome {
    let needed = if may_go_back(program) { SNAPSHOTS } else { 0 };
    let snapshots = settings.snapshots.max(needed);
    let settings = Settings { snapshots, folder: program.folder.clone(), ..settings };
    let context = Context::new(settings);
    // A panic in a native body is our mistake: what the script did so far must still be reported.
    let ending = panic::catch_unwind(AssertUnwindSafe(|| evaluate(program, catalog, &context)))
        .unwrap_or_else(|panic| Ending::Failed(Diagnostic::bug(panics::message(&*panic))));
    context.progress().end();
    if !matches!(ending, Ending::Finished) {
        context.save_remains();
    }
    context.flush();
    Outcome {
        ending: if context.is_pipe_closed() { Ending::PipeClosed } else { ending },
        checks: context.with_checks(|checks| checks.clone()),
        simulations: context.report(),
        files: context.output().written(),
    }
}

fn evaluate(program: &Program, catalog: &Catalog, context: &Context) -> Ending {
    let mut engine = match engine::build(catalog, context) {
        Ok(engine) => engine,
        Err(reason) => return Ending::Failed(Diagnostic::bug(reason)),
    };
    let _watchdog = match context.meter().watch() {
        Ok(watchdog) => watchdog,
        Err(error) => {
            let told = format!("cannot start a thread that keeps the limits: {error}");
            return Ending::Failed(Diagnostic::general(told));
        }
    };
    let outcome = compile(&mut engine, program).and_then(|ast| engine.run_ast(&ast));
    match outcome {
        Ok(()) => Ending::Finished,
        Err(error) if is_interrupt(&error) => Ending::Interrupted,
        Err(error) => {
            Ending::Failed(Explainer { program, catalog, engine: &engine }.explain(&error))
        }
    }
}
