//! A session of the language without a terminal: inputs are evaluated one after another and see what the earlier ones left.

mod preview;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use rhai::{AST, Caches, Dynamic, Engine, GlobalRuntimeState, ImmutableString, Scope, Stmt};

use super::record::{SessionRecord, Whereabouts, functions_of, whereabouts};
use super::transcript::{PROMPT, Transcript};
use super::{scope, statements};
use crate::script::bindings::catalog::Catalog;
use crate::script::diagnose::Diagnostic;
use crate::script::dialect::reading::read;
use crate::script::engine::parse::{SourcePiece, parse_piece};
use crate::script::engine::script_engine::{Halt, ScriptEngine};
use crate::script::source::program::Program;
use crate::script::source::text::Source;
use crate::script::state::context::Context;
use crate::script::state::settings::RunSettings;
use crate::script::state::watchdog::Watchdog;

pub use preview::Rounds;

/// The name of the variable with the value of the last expression.
pub const ANSWER: &str = "ans";

/// The reply to an input of a session.
#[derive(Debug)]
pub enum Reply {
    /// The input worked, and there is nothing to show.
    Done,
    /// The input is an expression with this value.
    Value(Dynamic),
    /// A statement of the input is wrong. Those before it have worked; of itself only what it did to scenes and simulations stays, and
    /// to variables that closures share.
    Failed(Diagnostic),
    /// A statement of the input was stopped by Ctrl-C; else as after a failure.
    Interrupted,
    /// The input was stopped, for nobody reads what is printed any more.
    PipeClosed,
}

/// What a statement that fails is taken back to.
#[derive(Clone)]
struct StatementCheckpoint {
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    constants: BTreeMap<ImmutableString, Dynamic>,
    whereabouts: Vec<Whereabouts>,
}

/// A session: its variables, functions, constants and imports, and the engine that knows the language.
pub struct Session {
    host: ScriptEngine,
    folder: PathBuf,
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    /// The functions and closures of all inputs.
    library: AST,
    transcript: Transcript,
    record: SessionRecord,
}

impl Session {
    /// A session in which nothing has happened.
    ///
    /// # Errors
    /// Only by a mistake of this program.
    pub fn new(catalog: Catalog, settings: RunSettings) -> Result<Self, Diagnostic> {
        let folder = settings.folder.clone();
        let host = ScriptEngine::open(catalog, settings)?;
        Ok(Self {
            scope: Scope::new(),
            global: host.engine().new_global_runtime_state(),
            host,
            library: AST::empty(),
            transcript: Transcript::new(folder.clone()),
            record: SessionRecord::default(),
            folder,
        })
    }

    /// Forgets everything that was typed in the session and what came of it.
    pub fn reset(&mut self) {
        self.scope.clear();
        self.global = self.host.engine().new_global_runtime_state();
        self.library = AST::empty();
        self.transcript = Transcript::new(self.folder.clone());
        self.record = SessionRecord::default();
        self.context().forget_simulations();
    }

    /// Forgets a Ctrl-C that came while nothing was evaluated. What comes after this stops all that is evaluated until it is
    /// called again.
    pub fn forget_interrupt(&mut self) {
        self.context().interrupt_flag().store(false, Ordering::Relaxed);
    }

    /// Evaluates an input that was typed.
    pub fn eval(&mut self, text: &str) -> Reply {
        let program = self.transcript.typed(text);
        self.eval_program(program)
    }

    /// Evaluates a program, such as a file, as if it had been typed in the session.
    pub fn eval_program(&mut self, program: Program) -> Reply {
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let library = self.library.clone();
        let (ast, guard) = match self.begin(&text, before) {
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
            match self.run(&guard, piece) {
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
        let cut = statements::boundary(self.engine(), text, worked).filter(|_| worked > 0);
        let Some((before, after)) = cut.map(|cut| text.split_at(cut)) else {
            self.library = library;
            return self.transcript.strike_last();
        };
        self.forget_shadowed();
        let functions: String =
            functions_of(&after.into()).map(|function| format!("\n{function}")).collect();
        self.record.worked(&format!("{before}{functions}"));
    }

    /// Writes into the session's record that an input worked which was evaluated in another way.
    pub fn note_worked(&mut self, text: &str) {
        self.record.worked(text);
    }

    /// Writes into the session's record how far simulations have moved by what is not written there itself; gives whether any has.
    pub fn note_moved(&mut self, before: &[Whereabouts]) -> bool {
        self.record.moved(before)
    }

    /// Where the simulations are that an input can name.
    pub fn whereabouts(&self) -> Vec<Whereabouts> {
        let latest = self.context().latest_simulation();
        whereabouts(&self.scope, latest.and_then(|latest| latest.try_cast()))
    }

    fn checkpoint(&self) -> StatementCheckpoint {
        let constants = self.global.constants.as_ref();
        StatementCheckpoint {
            scope: self.scope.clone(),
            global: self.global.clone(),
            constants: constants.map(|constants| constants.borrow().clone()).unwrap_or_default(),
            whereabouts: self.whereabouts(),
        }
    }

    fn restore(&mut self, checkpoint: StatementCheckpoint) {
        self.scope = checkpoint.scope;
        self.global = checkpoint.global;
        // Shared with functions that scenes and simulations have stored.
        if let Some(constants) = &self.global.constants {
            *constants.borrow_mut() = checkpoint.constants;
        }
    }

    /// Parses an input at its lines of the session, makes its functions known, and begins to keep the limits.
    fn begin(&mut self, text: &Source, before: usize) -> Result<(AST, Watchdog), Reply> {
        let Self { host, transcript, scope, .. } = self;
        let reply = |halt| reply_to(halt, transcript);
        let guard = host.watch().map_err(reply)?;
        let piece = SourcePiece { name: PROMPT, text, before, scope };
        let parse = |engine: &Engine| parse_piece(engine, &piece, || transcript.variables());
        let ast = host.run(&guard, || transcript.whole(), parse).map_err(reply)?;
        self.library = self.library.merge(&ast.clone_functions_only());
        // Errors in functions are told from those in functions of the same name in files.
        self.library.set_source(PROMPT);
        self.global.source = Some(PROMPT.into());
        self.global.lib.clear();
        self.global.lib.push(self.library.shared_lib().clone());
        Ok((ast, guard))
    }

    /// Runs statements.
    fn run(&mut self, guard: &Watchdog, statements: &[Stmt]) -> Result<Dynamic, Reply> {
        let Self { host, transcript, scope, global, .. } = self;
        let whole = || transcript.whole();
        let outcome = host.run(guard, whole, |engine| {
            // The only way to keep imports and constants from one input to the next; deprecated in favour of nothing.
            #[allow(deprecated)]
            engine.eval_statements_raw(global, &mut Caches::new(), scope, statements)
        });
        host.context().forget_reporters();
        outcome.map_err(|halt| reply_to(halt, transcript))
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
}

/// Looking at a session from outside.
impl Session {
    /// The language that the session speaks.
    pub fn catalog(&self) -> &Catalog {
        self.host.catalog()
    }

    /// The state that all calls of the session share.
    pub fn context(&self) -> &Context {
        self.host.context()
    }

    /// The engine of the session, for showing values.
    pub fn engine(&self) -> &Engine {
        self.host.engine()
    }

    /// The variables and constants of the session.
    pub fn variables(&self) -> &Scope<'static> {
        &self.scope
    }

    /// The functions that were typed in the session, without closures.
    pub fn functions(&self) -> impl Iterator<Item = rhai::ScriptFnMetadata<'_>> {
        self.library.iter_functions().filter(|function| !function.name.starts_with("anon$"))
    }

    /// The imported modules of the session by the names they were given, the last import first.
    pub fn modules(&self) -> impl Iterator<Item = (&str, &rhai::Module)> {
        self.global.iter_imports()
    }

    /// The number of the line that will be typed next, from 1.
    pub fn next_line(&self) -> usize {
        self.transcript.next_line()
    }

    /// What worked in the session so far.
    pub fn record(&self) -> &SessionRecord {
        &self.record
    }

    /// What worked in the session so far as a script.
    ///
    /// # Errors
    /// When it cannot be one, with the reason.
    pub fn script(&self) -> Result<String, Diagnostic> {
        let script = self.record.script(self.engine());
        let program = Program::named("the saved session", &script);
        match read(self.engine(), &Scope::new(), &program.text, 0) {
            Ok(_) => Ok(script),
            Err(error) => Err(self.host.explain(&error, &program)),
        }
    }

    /// The folder in which the session looks for imports and inputs.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

/// What is said of an input that did not come to its end, with places in the inputs that they are from.
fn reply_to(halt: Halt, transcript: &Transcript) -> Reply {
    match halt {
        Halt::Failed(diagnostic) | Halt::Undecided(diagnostic) => {
            Reply::Failed(transcript.relocate(diagnostic))
        }
        Halt::Interrupted => Reply::Interrupted,
        Halt::PipeClosed => Reply::PipeClosed,
    }
}
