//! Running a script from beginning to end, on a stack that its limits cannot exhaust.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Mutex;
use std::thread;

use rhai::{AST, Engine, EvalAltResult, Scope};

use super::{build, import_from};
use crate::script::diagnose::{Diagnostic, Explainer, is_interrupt, is_waiting};
use crate::script::dialect::naming;
use crate::script::dialect::reading::read;
use crate::script::rows::catalog::Catalog;
use crate::script::rows::sources::{FOLDER, Sources};
use crate::script::source::outline::Outline;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::limits::{DEFAULT_MEGABYTES, Limits};
use crate::script::state::settings::Settings;
use crate::script::words::checks::Checks;
use crate::script::words::error::ScriptError;
use crate::script::words::panics;
use crate::script::words::stop::{MEGABYTE, Stop};

/// Address space for the stack of a script; memory is used only as deep as the script really goes.
pub const STACK_BYTES: usize = 256 << 20;

/// Address space for closures that hold closures that hold closures …: they are let go one within the other. A link of
/// such a chain takes less stack than twice its memory, so the memory allowed bounds the stack that it may need.
pub fn stack_for(limits: &Limits) -> usize {
    let memory = limits.memory.unwrap_or(DEFAULT_MEGABYTES * MEGABYTE);
    let memory = usize::try_from(memory).unwrap_or(LARGEST_STACK).min(LARGEST_STACK);
    STACK_BYTES + 2 * memory
}

/// Most address space for such values.
const LARGEST_STACK: usize = 16 << 30;

/// How a run ended.
#[derive(Debug)]
pub enum Ending {
    /// The script came to its end.
    Finished,
    /// It is wrong.
    Failed(Diagnostic),
    /// A dry build came to a loop that waits for what a simulation finds; nothing before it is wrong.
    Undecided,
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
    /// What stopped it before its end, if something from outside or a limit did.
    pub stopped_by: Option<Stop>,
    /// Finished cases of studies that another run of the same script will not repeat.
    pub kept_cases: usize,
}

/// Runs `program` in the language of `catalog`.
pub fn run(program: &Program, catalog: &Catalog, settings: Settings) -> Outcome {
    let limits = settings.limits;
    let run = || run_here(program, catalog, settings);
    on_large_stack(&limits, run).unwrap_or_else(|diagnostic| Outcome {
        ending: Ending::Failed(diagnostic),
        checks: Checks::default(),
        simulations: Vec::new(),
        files: Vec::new(),
        stopped_by: None,
        kept_cases: 0,
    })
}

/// Does `work` on a thread with a stack that a script within these limits cannot exhaust.
pub fn on_large_stack<T: Send>(
    limits: &Limits,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Diagnostic> {
    on_stack(stack_for(limits), work)
}

/// Does `work` on a thread with a stack of so many bytes, or fewer where the system has no address space for them.
fn on_stack<T: Send>(mut bytes: usize, work: impl FnOnce() -> T + Send) -> Result<T, Diagnostic> {
    let work = Mutex::new(Some(work));
    let take = || work.lock().ok().and_then(|mut work| work.take());
    thread::scope(|scope| {
        let running = loop {
            let thread = thread::Builder::new().name("script".into()).stack_size(bytes);
            match thread.spawn_scoped(scope, || take().map(|work| work())) {
                Ok(running) => break running,
                Err(_) if bytes > STACK_BYTES => bytes = (bytes / 2).max(STACK_BYTES),
                Err(error) => {
                    let told = format!("cannot start a thread for the script: {error}");
                    return Err(Diagnostic::general(told));
                }
            }
        };
        let done = running.join().map_err(|panic| Diagnostic::bug(panics::message(&*panic)))?;
        done.ok_or_else(|| Diagnostic::bug("the work of a thread was done twice"))
    })
}

/// Parses `program`; imports are looked for beside it.
pub fn compile(engine: &mut Engine, program: &Program) -> Result<AST, Box<EvalAltResult>> {
    import_from(engine, &program.folder);
    parse(engine, program)
}

/// Parses `program` with an engine that knows where imports are.
pub fn parse(engine: &Engine, program: &Program) -> Result<AST, Box<EvalAltResult>> {
    let mut ast = read(engine, &Scope::new(), &program.text, 0)?;
    ast.set_source(program.name.as_str());
    Sources::of(engine).note(&ast, &program.name);
    let variables = || Outline::of(&program.text).top_level;
    naming::judge(engine, &program.text, 0, variables)?;
    match program.text.open_comment() {
        Some(position) => Err(ScriptError::new("a comment that begins with /* is never closed")
            .hint("write */ where it ends")
            .into_engine(position)),
        None => Ok(ast),
    }
}

/// What to bear in mind about an error that a dry build meets after it has pretended to run a simulation.
const ONLY_DRY: &str =
    "withy check runs no simulation: what depends on results can only be seen by withy run";

/// What a simulation may keep to go back to, in a script that goes back [bytes].
pub const SNAPSHOTS: usize = 256_000_000;

/// Whether a script may go back in time: a scene pays only for what it uses. The library never does; what another imported file does is
/// not known.
fn may_go_back(program: &Program) -> bool {
    let is_library = |path: Option<&str>| path.is_some_and(|path| path.starts_with(FOLDER));
    let source = &program.text;
    source.names().any(|name| matches!(name, "back" | "rewind"))
        || source.imports().any(|path| !is_library(path))
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
    match ending {
        Ending::Finished => discard_journals(&context),
        _ => context.save_remains(),
    }
    context.flush();
    Outcome {
        ending: match (ending, context.meter().passed()) {
            _ if context.is_pipe_closed() => Ending::PipeClosed,
            (Ending::Finished, Some(lost @ Stop::OutputLost(_))) => {
                let (told, hint) = lost.words();
                Ending::Failed(Diagnostic { hint, ..Diagnostic::general(told) })
            }
            (ending, _) => ending,
        },
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

fn evaluate(program: &Program, catalog: &Catalog, context: &Context) -> Ending {
    let mut engine = match build(catalog, context) {
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
    let compiled = compile(&mut engine, program);
    let engine = Rc::new(engine);
    context.lend(&engine);
    let outcome = compiled.and_then(|ast| engine.run_ast(&ast));
    match outcome {
        Ok(()) => Ending::Finished,
        Err(error) if is_interrupt(&error) => Ending::Interrupted,
        Err(error) if is_waiting(&error) => Ending::Undecided,
        Err(error) => {
            let diagnostic = Explainer { program, catalog, engine: &engine }.explain(&error);
            Ending::Failed(match context.meter().has_pretended() {
                true => diagnostic.with_another_hint(ONLY_DRY),
                false => diagnostic,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::packages::language;
    use crate::script::source::lexing::lexings;
    use crate::script::state::settings::Mode;

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
            let _ = run_here(&program, &language(), Settings::silent(Mode::Run));
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
