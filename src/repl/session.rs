//! A session of the language without a terminal: inputs are evaluated one after another and see what the earlier ones left.

mod peek;

use std::collections::BTreeMap;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::Ordering;

use rhai::{
    AST, Caches, Dynamic, Engine, EvalAltResult, GlobalRuntimeState, ImmutableString, Scope, Stmt,
};

use super::record::{Record, Whereabouts, functions_of, whereabouts};
use super::transcript::{PROMPT, Transcript};
use super::{scope, statements};
use crate::script::diagnose::{Diagnostic, Explainer, is_interrupt};
use crate::script::dialect::naming;
use crate::script::dialect::reading::read;
use crate::script::engine;
use crate::script::rows::catalog::Catalog;
use crate::script::rows::sources::Sources;
use crate::script::source::program::Program;
use crate::script::source::text::{Source, behind};
use crate::script::state::context::Context;
use crate::script::state::settings::Settings;
use crate::script::state::watchdog::Watchdog;
use crate::script::words::error::ScriptError;
use crate::script::words::panics;

pub use peek::Rounds;

/// The name of the value of the last expression.
pub const ANSWER: &str = "ans";

/// What came of an input.
#[derive(Debug)]
pub enum Reply {
    /// It worked, and there is nothing to show.
    Done,
    /// It is an expression with this value.
    Value(Dynamic),
    /// A statement of it is wrong. Those before it have worked; of itself only what it did to scenes and simulations stays, and
    /// to variables that closures share.
    Failed(Diagnostic),
    /// A statement of it was stopped by Ctrl-C; else as after a failure.
    Interrupted,
    /// Nobody reads what is printed any more.
    PipeClosed,
}

/// What a statement that fails is taken back to.
#[derive(Clone)]
struct Checkpoint {
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    constants: BTreeMap<ImmutableString, Dynamic>,
    whereabouts: Vec<Whereabouts>,
}

/// Variables, functions, constants and imports, and the engine that knows the language.
pub struct Session {
    catalog: Catalog,
    context: Context,
    /// Shared with the functions that scenes and simulations store.
    engine: Rc<Engine>,
    folder: PathBuf,
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    /// The functions and closures of all inputs.
    library: AST,
    transcript: Transcript,
    record: Record,
}

impl Session {
    /// A session in which nothing has happened.
    ///
    /// # Errors
    /// Only by a mistake of this program.
    pub fn new(catalog: Catalog, settings: Settings) -> Result<Self, Diagnostic> {
        let folder = settings.folder.clone();
        let context = Context::new(settings);
        let mut engine = engine::build(&catalog, &context).map_err(Diagnostic::bug)?;
        engine::import_from(&mut engine, &folder);
        let global = engine.new_global_runtime_state();
        let engine = Rc::new(engine);
        context.lend(&engine);
        Ok(Self {
            catalog,
            context,
            engine,
            scope: Scope::new(),
            global,
            library: AST::empty(),
            transcript: Transcript::new(folder.clone()),
            record: Record::default(),
            folder,
        })
    }

    /// Forgets everything that was typed and what came of it.
    pub fn reset(&mut self) {
        self.scope.clear();
        self.global = self.engine.new_global_runtime_state();
        self.library = AST::empty();
        self.transcript = Transcript::new(self.folder.clone());
        self.record = Record::default();
        self.context.forget_simulations();
    }

    /// Forgets a Ctrl-C that came while nothing was evaluated. What comes after this stops all that is evaluated until it is
    /// called again.
    pub fn forget_interrupt(&mut self) {
        self.context.interrupt_flag().store(false, Ordering::Relaxed);
    }

    /// Evaluates what was typed.
    pub fn eval(&mut self, text: &str) -> Reply {
        let program = self.transcript.typed(text);
        self.eval_program(program)
    }

    /// Evaluates a program, such as a file, as if it had been typed.
    pub fn eval_program(&mut self, program: Program) -> Reply {
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let library = self.library.clone();
        let (ast, _watchdog) = match self.begin(&text, before) {
            Ok(begun) => begun,
            Err(reply) => {
                self.transcript.strike_last();
                return reply;
            }
        };
        let returns = statements::returns(&ast);
        // An input that may return is one piece; of others, what worked before an error stays.
        let pieces = if returns { ast.statements().len().max(1) } else { 1 };
        let mut value = Dynamic::UNIT;
        for (number, piece) in ast.statements().chunks(pieces).enumerate() {
            let checkpoint = self.checkpoint();
            match self.run(piece) {
                Ok(result) => value = result,
                Err(reply) => {
                    self.restore(checkpoint.clone());
                    self.keep_part(&text, number, library);
                    self.record.moved(&checkpoint.whereabouts);
                    return reply;
                }
            }
            self.publish_constants(checkpoint.scope.len());
        }
        self.forget_shadowed();
        let reply = self.answer(value, &text);
        match &reply {
            _ if returns => self.record.returned(&text),
            Reply::Value(_) => self.record.answered(&text),
            _ => self.record.worked(&text),
        }
        reply
    }

    /// Of an input that failed, keeps the statements that worked, and its functions if there are any.
    fn keep_part(&mut self, text: &str, worked: usize, library: AST) {
        let cut = statements::boundary(&self.engine, text, worked).filter(|_| worked > 0);
        let Some((before, after)) = cut.map(|cut| text.split_at(cut)) else {
            self.library = library;
            return self.transcript.strike_last();
        };
        self.forget_shadowed();
        let functions: String =
            functions_of(&after.into()).map(|function| format!("\n{function}")).collect();
        self.record.worked(&format!("{before}{functions}"));
    }

    /// Writes into the record that an input worked which was evaluated in another way.
    pub fn note_worked(&mut self, text: &str) {
        self.record.worked(text);
    }

    /// Writes into the record how far simulations have moved by what is not written there itself; gives whether any has.
    pub fn note_moved(&mut self, before: &[Whereabouts]) -> bool {
        self.record.moved(before)
    }

    /// Where the simulations are that an input can name.
    pub fn whereabouts(&self) -> Vec<Whereabouts> {
        let latest = self.context.latest_simulation();
        whereabouts(&self.scope, latest.and_then(|latest| latest.try_cast()))
    }

    fn checkpoint(&self) -> Checkpoint {
        let constants = self.global.constants.as_ref();
        Checkpoint {
            scope: self.scope.clone(),
            global: self.global.clone(),
            constants: constants.map(|constants| constants.borrow().clone()).unwrap_or_default(),
            whereabouts: self.whereabouts(),
        }
    }

    fn restore(&mut self, checkpoint: Checkpoint) {
        self.scope = checkpoint.scope;
        self.global = checkpoint.global;
        // Shared with functions that scenes and simulations have stored.
        if let Some(constants) = &self.global.constants {
            *constants.borrow_mut() = checkpoint.constants;
        }
    }

    /// Parses an input, makes its functions known, and begins to keep the limits.
    fn begin(&mut self, text: &Source, before: usize) -> Result<(AST, Watchdog), Reply> {
        let watchdog = self.context.meter().watch().map_err(|error| {
            let told = format!("cannot start a thread that keeps the limits: {error}");
            Reply::Failed(Diagnostic::general(told))
        })?;
        let ast = self.compile(text, before).map_err(|error| match is_interrupt(&error) {
            true => Reply::Interrupted,
            false => Reply::Failed(self.explain(&error)),
        })?;
        self.library = self.library.merge(&ast.clone_functions_only());
        // Errors in functions are told from those in functions of the same name in files.
        self.library.set_source(PROMPT);
        self.global.source = Some(PROMPT.into());
        self.global.lib.clear();
        self.global.lib.push(self.library.shared_lib().clone());
        Ok((ast, watchdog))
    }

    /// Runs statements.
    fn run(&mut self, statements: &[Stmt]) -> Result<Dynamic, Reply> {
        // A panic in a native body is our mistake: the session must survive it.
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| {
            // The only way to keep imports and constants from one input to the next; deprecated in favour of nothing.
            #[allow(deprecated)]
            self.engine.eval_statements_raw(
                &mut self.global,
                &mut Caches::new(),
                &mut self.scope,
                statements,
            )
        }));
        self.context.progress().end();
        self.context.forget_reporters();
        self.context.flush();
        match outcome {
            _ if self.context.is_pipe_closed() => Err(Reply::PipeClosed),
            Ok(Ok(value)) => Ok(value),
            Ok(Err(error)) if is_interrupt(&error) => Err(Reply::Interrupted),
            Ok(Err(error)) => Err(Reply::Failed(self.explain(&error))),
            Err(panic) => Err(Reply::Failed(Diagnostic::bug(panics::message(&*panic)))),
        }
    }

    /// Parses an input at its lines of the session.
    fn compile(&self, text: &Source, before: usize) -> Result<AST, Box<EvalAltResult>> {
        let ast = read(&self.engine, &self.scope, text, before)?;
        Sources::of(&self.engine).note(&ast, PROMPT);
        naming::judge(&self.engine, text, before, || self.transcript.variables())?;
        match text.open_comment() {
            Some(at) => Err(ScriptError::new("a comment that begins with /* is never closed")
                .hint("write */ where it ends")
                .into_engine(behind(at, before))),
            None => Ok(ast),
        }
    }

    /// Keeps the value of an input that worked, if it is to be shown.
    fn answer(&mut self, value: Dynamic, text: &Source) -> Reply {
        // An input that ends in a semicolon is not to show its value.
        if value.is_unit() || text.ends_in_semicolon() {
            return Reply::Done;
        }
        // A constant of this name belongs to the user.
        match (self.scope.is_constant(ANSWER), self.scope.get_mut(ANSWER)) {
            (Some(false), Some(answer)) => *answer = value.clone(),
            (None, _) => _ = self.scope.push_dynamic(ANSWER, value.clone()),
            _ => (),
        }
        Reply::Value(value)
    }

    /// Lets functions see the constants that came to the first `known` variables as `global::NAME`, whichever of the two was
    /// typed first.
    fn publish_constants(&mut self, known: usize) {
        let shared = self.global.constants.get_or_insert_with(Default::default);
        shared.borrow_mut().extend(scope::constants_after(&self.scope, known));
    }

    /// Variables that were declared again are out of reach: a long session must not keep them.
    fn forget_shadowed(&mut self) {
        if let Some(visible) = scope::visible(&self.scope) {
            self.scope = visible;
        }
    }

    fn explain(&self, error: &EvalAltResult) -> Diagnostic {
        let program = self.transcript.whole();
        let explainer =
            Explainer { program: &program, catalog: &self.catalog, engine: &self.engine };
        self.transcript.relocate(explainer.explain(error))
    }
}

/// Looking at a session from outside.
impl Session {
    /// The language that is spoken.
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// What the calls of the session share.
    pub fn context(&self) -> &Context {
        &self.context
    }

    /// The engine, for showing values.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// Variables and constants.
    pub fn variables(&self) -> &Scope<'static> {
        &self.scope
    }

    /// The functions that were typed, without closures.
    pub fn functions(&self) -> impl Iterator<Item = rhai::ScriptFnMetadata<'_>> {
        self.library.iter_functions().filter(|function| !function.name.starts_with("anon$"))
    }

    /// Imported modules by the names they were given, the last import first.
    pub fn modules(&self) -> impl Iterator<Item = (&str, &rhai::Module)> {
        self.global.iter_imports()
    }

    /// The line that will be typed next, from 1.
    pub fn next_line(&self) -> usize {
        self.transcript.next_line()
    }

    /// What worked so far.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// What worked so far as a script.
    ///
    /// # Errors
    /// When it cannot be one, with the reason.
    pub fn script(&self) -> Result<String, Diagnostic> {
        let script = self.record.script(&self.engine);
        let program = Program::named("the saved session", &script);
        match read(&self.engine, &Scope::new(), &program.text, 0) {
            Ok(_) => Ok(script),
            Err(error) => {
                let (catalog, engine) = (&self.catalog, &*self.engine);
                Err(Explainer { program: &program, catalog, engine }.explain(&error))
            }
        }
    }

    /// Where imports and inputs are looked for.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

/// Simulations hold functions that hold the context, which holds the last simulation.
impl Drop for Session {
    fn drop(&mut self) {
        self.context.forget_simulations();
    }
}
