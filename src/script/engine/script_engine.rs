//! Environment for the execution of scripts: catalog, engine and shared state.

use std::rc::Rc;

use rhai::{Engine, EvalAltResult};

use super::build;
use super::imports::FolderResolver;
use crate::panics::caught;
use crate::script::bindings::catalog::Catalog;
use crate::script::diagnose::{Diagnostic, Explainer, is_interrupt, is_waiting};
use crate::script::messages::error::EngineResult;
use crate::script::messages::stop::Stop;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::settings::RunSettings;
use crate::script::state::watchdog::Watchdog;

const DRY_RUN_NOTE: &str =
    "withy check runs no simulation: use withy run to test what depends on results";

/// Environment for the execution of scripts.
pub struct ScriptEngine {
    catalog: Catalog,
    context: Context,
    engine: Rc<Engine>,
}

/// Reason why a script did not complete.
#[derive(Debug)]
pub enum Halt {
    /// Error in the script, exceeded limit, or internal error.
    Failed(Diagnostic),
    /// A dry run reached the point, described by the diagnostic, at which the script waits for the result of a simulation.
    Undecided(Diagnostic),
    /// Interrupted from outside.
    Interrupted,
    /// The reader of the output has closed the pipe.
    PipeClosed,
}

impl ScriptEngine {
    /// Creates the environment for the language of `catalog`, with the limits of `settings`.
    ///
    /// # Errors
    /// Fails only because of internal errors.
    pub fn open(catalog: Catalog, settings: RunSettings) -> Result<Self, Diagnostic> {
        let folder = settings.folder.clone();
        let context = Context::new(settings);
        let resolver = FolderResolver::new(&folder, &context);
        let built = caught(|| build(&catalog, &context)).and_then(|built| built);
        let mut engine = built.map_err(Diagnostic::internal_error)?;
        engine.set_module_resolver(resolver);
        let engine = Rc::new(engine);
        context.set_engine(&engine);
        Ok(Self { catalog, context, engine })
    }

    /// Resets the counters of steps and output, and enforces the limits until the guard is dropped.
    ///
    /// # Errors
    /// Fails if no thread can be started.
    pub fn watch(&self) -> Result<Watchdog, Halt> {
        self.context.meter().watch().map_err(|error| {
            let message = format!("cannot start a thread that keeps the limits: {error}");
            Halt::Failed(Diagnostic::general(message))
        })
    }

    /// Calls `work` with the engine, ends the progress display and flushes the output. `program` returns the source text for messages.
    ///
    /// # Errors
    /// Fails if `work` does not complete. A panic in native code is reported as an internal error.
    pub fn run<T>(
        &self,
        _limits_kept: &Watchdog,
        program: impl FnOnce() -> Program,
        work: impl FnOnce(&Engine) -> EngineResult<T>,
    ) -> Result<T, Halt> {
        let outcome = caught(|| work(&self.engine));
        self.context.progress().end();
        self.context.flush();
        if self.context.is_pipe_closed() {
            return Err(Halt::PipeClosed);
        }
        match (outcome, self.context.meter().passed()) {
            (Ok(Ok(_)), Some(lost @ Stop::OutputLost(_))) => {
                let (message, hint) = lost.message_and_hint();
                Err(Halt::Failed(Diagnostic { hint, ..Diagnostic::general(message) }))
            }
            (Ok(Ok(value)), _) => Ok(value),
            (Ok(Err(error)), _) if is_interrupt(&error) => Err(Halt::Interrupted),
            (Ok(Err(error)), _) => Err(self.halted_by(&error, &program())),
            (Err(panic), _) => Err(Halt::Failed(Diagnostic::internal_error(panic))),
        }
    }

    fn halted_by(&self, error: &EvalAltResult, program: &Program) -> Halt {
        let diagnostic = self.explain(error, program);
        match self.context.meter().depends_on_dry_run() {
            _ if is_waiting(error) => Halt::Undecided(diagnostic),
            true => Halt::Failed(diagnostic.with_another_hint(DRY_RUN_NOTE)),
            false => Halt::Failed(diagnostic),
        }
    }

    /// Translates an engine error in `program` to the form shown to the user.
    pub fn explain(&self, error: &EvalAltResult, program: &Program) -> Diagnostic {
        Explainer { program, catalog: &self.catalog, engine: &self.engine }.explain(error)
    }

    /// Catalog of the language.
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// State that all native calls share.
    pub fn context(&self) -> &Context {
        &self.context
    }

    /// Underlying Rhai engine, for example for parsing texts and for the names of types.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }
}

/// Breaks a reference cycle: simulations own stored functions, which own the context, which owns the last simulation.
impl Drop for ScriptEngine {
    fn drop(&mut self) {
        self.context.clear_simulations();
    }
}
