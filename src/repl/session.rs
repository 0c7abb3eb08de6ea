//! Sessions, which evaluate inputs one after the other.

mod preview;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use rhai::{AST, Caches, Dynamic, Engine, GlobalRuntimeState, ImmutableString, Scope, Stmt};

use super::record::{SessionRecord, SimulationPositions, functions_of, simulation_positions};
pub use super::transcript::PROMPT;
use super::transcript::Transcript;
use super::{scope, statements};
use crate::script::bindings::catalog::Catalog;
use crate::script::diagnose::Diagnostic;
use crate::script::dialect::reading::read;
use crate::script::engine::inputs::{declare_inputs, expect_declared};
use crate::script::engine::parse::{SourcePiece, parse, parse_piece};
use crate::script::engine::script_engine::{Halt, ScriptEngine};
use crate::script::messages::error::EngineResult;
use crate::script::source::pitfalls;
use crate::script::source::program::Program;
use crate::script::source::text::Source;
use crate::script::state::context::Context;
use crate::script::state::inputs::Inputs;
use crate::script::state::settings::RunSettings;
use crate::script::state::watchdog::Watchdog;

pub use preview::Rounds;

/// Name of the variable that contains the value of the last expression.
pub const ANSWER: &str = "ans";

/// Result of an input.
#[derive(Debug)]
pub enum Reply {
    /// Success without a value.
    Done,
    /// Success with the value of an expression.
    Value(Dynamic),
    /// A statement failed. Earlier statements of the same input keep their effect.
    /// A failed statement keeps its changes of scenes, simulations, and variables shared by closures.
    Failed(Diagnostic),
    /// Ctrl-C interrupted a statement, with the same effect as a failure.
    Interrupted,
    /// The reader of the output has closed the pipe.
    PipeClosed,
}

#[derive(Clone)]
struct StatementCheckpoint {
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    constants: BTreeMap<ImmutableString, Dynamic>,
    positions: Vec<SimulationPositions>,
}

/// Variables, functions, constants, imports and script engine of a session.
pub struct Session {
    engine: ScriptEngine,
    folder: PathBuf,
    scope: Scope<'static>,
    global: GlobalRuntimeState,
    library: AST,
    transcript: Transcript,
    record: SessionRecord,
}

impl Session {
    /// Creates an empty session.
    ///
    /// # Errors
    /// Fails only if the program has an internal error.
    pub fn new(catalog: Catalog, settings: RunSettings) -> Result<Self, Diagnostic> {
        let folder = settings.folder.clone();
        let host = ScriptEngine::open(catalog, settings)?;
        Ok(Self {
            scope: Scope::new(),
            global: host.engine().new_global_runtime_state(),
            engine: host,
            library: AST::empty(),
            transcript: Transcript::new(folder.clone()),
            record: SessionRecord::default(),
            folder,
        })
    }

    /// Removes all variables, functions, constants and imports.
    pub fn reset(&mut self) {
        self.scope.clear();
        self.global = self.engine.engine().new_global_runtime_state();
        self.library = AST::empty();
        self.transcript = Transcript::new(self.folder.clone());
        self.record = SessionRecord::default();
        self.context().clear_simulations();
        self.context().set_inputs(Inputs::default());
    }

    /// Discards a Ctrl-C that was pressed between evaluations, because it would stop the next evaluation.
    pub fn clear_interrupt(&mut self) {
        self.context().interrupt_flag().store(false, Ordering::Relaxed);
    }

    /// Evaluates a typed input.
    pub fn eval(&mut self, text: &str) -> Reply {
        let program = self.transcript.typed(text);
        self.eval_program(program)
    }

    /// Evaluates a file like a typed input. Its script inputs keep the values `inputs` until the next file is loaded.
    pub fn load(&mut self, program: Program, inputs: Inputs) -> Reply {
        self.context().set_inputs(inputs);
        let declared = self.declare_inputs(&program);
        let names = match declared {
            Ok(names) => names,
            Err(reply) => return reply,
        };
        let reply = self.eval_program(program.clone());
        let has_failed = !matches!(reply, Reply::Done | Reply::Value(_));
        let checked = self.with_engine(&program, |context, _| expect_declared(context, &names));
        if has_failed { reply } else { checked.map_or_else(|failed| failed, |()| reply) }
    }

    fn declare_inputs(&self, program: &Program) -> Result<Vec<String>, Reply> {
        if self.context().inputs().are_defaults() {
            return Ok(Vec::new());
        }
        self.with_engine(program, |context, engine| match parse(engine, program) {
            Ok(ast) => declare_inputs(engine, context, (&ast, &program.text), &self.folder),
            Err(_) => Ok(Vec::new()),
        })
    }

    fn with_engine<T>(
        &self,
        program: &Program,
        work: impl FnOnce(&Context, &Engine) -> EngineResult<T>,
    ) -> Result<T, Reply> {
        let guard = self.engine.watch().map_err(|halt| reply_to(halt, &self.transcript))?;
        let done = self.engine.run(&guard, || program.clone(), |of| work(self.context(), of));
        done.map_err(|halt| reply_to(halt, &self.transcript))
    }

    /// Evaluates a program like typed input.
    pub fn eval_program(&mut self, program: Program) -> Reply {
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let library = self.library.clone();
        let (ast, guard) = match self.begin(&text, before) {
            Ok(begun) => begun,
            Err(reply) => {
                self.transcript.mark_last_failed();
                return reply;
            }
        };
        let returns = statements::returns(&ast);
        // Statements are evaluated one by one, so that statements before an error keep their effect.
        // An input that may return early is evaluated as a whole.
        let pieces = if returns { ast.statements().len().max(1) } else { 1 };
        let mut value = Dynamic::UNIT;
        for (number, piece) in ast.statements().chunks(pieces).enumerate() {
            let checkpoint = self.checkpoint();
            match self.run(&guard, piece) {
                Ok(result) => value = result,
                Err(reply) => {
                    self.restore(checkpoint.clone());
                    self.record_partial(&text, number, library);
                    self.record.record_movement(&checkpoint.positions);
                    return reply;
                }
            }
            self.publish_constants(checkpoint.scope.len());
        }
        self.drop_shadowed();
        let reply = self.show_value(value, &text);
        match &reply {
            _ if returns => self.record.returned(&text),
            Reply::Value(_) => self.record.record_value(&text),
            _ => self.record.worked(&text),
        }
        reply
    }

    fn record_partial(&mut self, text: &str, worked: usize, library: AST) {
        let cut = statements::boundary(self.engine(), text, worked).filter(|_| worked > 0);
        let Some((before, after)) = cut.map(|cut| text.split_at(cut)) else {
            self.library = library;
            return self.transcript.mark_last_failed();
        };
        self.drop_shadowed();
        let functions: String =
            functions_of(&after.into()).map(|function| format!("\n{function}")).collect();
        self.record.worked(&format!("{before}{functions}"));
    }

    /// Records the call of a command that succeeded.
    pub fn record_success(&mut self, text: &str) {
        self.record.worked(text);
    }

    /// Records the simulations that a command advanced or rewound since their positions `before`, and returns true if there are any.
    pub fn record_movement(&mut self, before: &[SimulationPositions]) -> bool {
        self.record.record_movement(before)
    }

    /// Named simulations with their positions.
    pub fn simulation_positions(&self) -> Vec<SimulationPositions> {
        let latest = self.context().latest_simulation();
        simulation_positions(&self.scope, latest.and_then(|latest| latest.try_cast()))
    }

    fn checkpoint(&self) -> StatementCheckpoint {
        let constants = self.global.constants.as_ref();
        StatementCheckpoint {
            scope: self.scope.clone(),
            global: self.global.clone(),
            constants: constants.map(|constants| constants.borrow().clone()).unwrap_or_default(),
            positions: self.simulation_positions(),
        }
    }

    fn restore(&mut self, checkpoint: StatementCheckpoint) {
        self.scope = checkpoint.scope;
        self.global = checkpoint.global;
        if let Some(constants) = &self.global.constants {
            *constants.borrow_mut() = checkpoint.constants;
        }
    }

    fn begin(&mut self, text: &Source, before: usize) -> Result<(AST, Watchdog), Reply> {
        let Self { engine: host, transcript, scope, .. } = self;
        let reply = |halt| reply_to(halt, transcript);
        let guard = host.watch().map_err(reply)?;
        // Earlier declarations are forgotten, because an input of the session may declare a script input again with another default.
        host.context().inputs().forget_declarations();
        let piece = SourcePiece { name: PROMPT, text, before, scope };
        let parse = |engine: &Engine| parse_piece(engine, &piece, || transcript.variables());
        let ast = host.run(&guard, || transcript.to_program(), parse).map_err(reply)?;
        pitfalls::messages(text, before).iter().for_each(|note| host.context().print_message(note));
        self.library = self.library.merge(&ast.clone_functions_only());
        // The source name distinguishes functions typed at the prompt from functions of imported files in error messages.
        self.library.set_source(PROMPT);
        self.global.source = Some(PROMPT.into());
        self.global.lib.clear();
        self.global.lib.push(self.library.shared_lib().clone());
        Ok((ast, guard))
    }

    fn run(&mut self, guard: &Watchdog, statements: &[Stmt]) -> Result<Dynamic, Reply> {
        let Self { engine: host, transcript, scope, global, .. } = self;
        let whole = || transcript.to_program();
        let outcome = host.run(guard, whole, |engine| {
            // This deprecated function of Rhai is used, because no other keeps imports and constants between inputs.
            #[allow(deprecated)]
            engine.eval_statements_raw(global, &mut Caches::new(), scope, statements)
        });
        host.context().clear_reporters();
        outcome.map_err(|halt| reply_to(halt, transcript))
    }

    fn show_value(&mut self, value: Dynamic, text: &Source) -> Reply {
        if value.is_unit() || text.ends_in_semicolon() {
            return Reply::Done;
        }
        match (self.scope.is_constant(ANSWER), self.scope.get_mut(ANSWER)) {
            (Some(false), Some(answer)) => *answer = value.clone(),
            (None, _) => _ = self.scope.push_dynamic(ANSWER, value.clone()),
            _ => (),
        }
        Reply::Value(value)
    }

    fn publish_constants(&mut self, known: usize) {
        let shared = self.global.constants.get_or_insert_with(Default::default);
        shared.borrow_mut().extend(scope::constants_after(&self.scope, known));
    }

    fn drop_shadowed(&mut self) {
        if let Some(visible) = scope::visible(&self.scope) {
            self.scope = visible;
        }
    }
}

impl Session {
    /// Sets a variable.
    pub fn define(&mut self, name: &str, value: Dynamic) {
        self.scope.set_or_push(name, value);
    }

    /// Catalog of the language.
    pub fn catalog(&self) -> &Catalog {
        self.engine.catalog()
    }

    /// State that all native calls of the session share.
    pub fn context(&self) -> &Context {
        self.engine.context()
    }

    /// Script engine of the session.
    pub fn engine(&self) -> &Engine {
        self.engine.engine()
    }

    /// Variables and constants of the session.
    pub fn variables(&self) -> &Scope<'static> {
        &self.scope
    }

    /// Functions defined in the session, without closures.
    pub fn functions(&self) -> impl Iterator<Item = rhai::ScriptFnMetadata<'_>> {
        self.library.iter_functions().filter(|function| !function.name.starts_with("anon$"))
    }

    /// Imported modules with their names, the last import first.
    pub fn modules(&self) -> impl Iterator<Item = (&str, &rhai::Module)> {
        self.global.iter_imports()
    }

    /// Number of the next input line, counted from 1.
    pub fn next_line(&self) -> usize {
        self.transcript.next_line()
    }

    /// Record of the successful inputs.
    pub fn record(&self) -> &SessionRecord {
        &self.record
    }

    /// Converts the successful inputs to a script.
    ///
    /// # Errors
    /// Fails with the reason if the inputs cannot be combined to a script.
    pub fn script(&self) -> Result<String, Diagnostic> {
        let script = self.record.script(self.engine());
        let program = Program::named("the saved session", &script);
        match read(self.engine(), &Scope::new(), &program.text, 0) {
            Ok(_) => Ok(script),
            Err(error) => Err(self.engine.explain(&error, &program)),
        }
    }

    /// Base folder for the paths of imports and input files.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

fn reply_to(halt: Halt, transcript: &Transcript) -> Reply {
    match halt {
        Halt::Failed(diagnostic) | Halt::Undecided(diagnostic) => {
            Reply::Failed(transcript.relocate(diagnostic))
        }
        Halt::Interrupted => Reply::Interrupted,
        Halt::PipeClosed => Reply::PipeClosed,
    }
}
