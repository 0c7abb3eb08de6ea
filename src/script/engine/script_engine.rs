//! What scripts run in: a language, an engine that speaks it, and the state that their calls share. A run, a prompt and a judge each have one.

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

/// What to bear in mind about an error that a dry build meets after it has pretended to run a simulation.
const ONLY_DRY: &str =
    "withy check runs no simulation: what depends on results can only be seen by withy run";

/// A language, its engine, and what the calls of a run share.
pub struct ScriptEngine {
    catalog: Catalog,
    context: Context,
    /// Shared with the functions that scenes and simulations store.
    engine: Rc<Engine>,
}

/// Why a script did not come to its end.
#[derive(Debug)]
pub enum Halt {
    /// The script is wrong, a limit stopped it, or withy has made a mistake.
    Failed(Diagnostic),
    /// A dry build came to where the script waits for what only a simulation finds, as the diagnostic says.
    Undecided(Diagnostic),
    /// The script was stopped from outside.
    Interrupted,
    /// The run was stopped, for the reader of its output went away.
    PipeClosed,
}

impl ScriptEngine {
    /// An engine that speaks the language of `catalog`, within the limits of the settings; imports are found in their folder.
    ///
    /// # Errors
    /// Only by a mistake of this program.
    pub fn open(catalog: Catalog, settings: RunSettings) -> Result<Self, Diagnostic> {
        let resolver = FolderResolver::new(&settings.folder);
        let context = Context::new(settings);
        let built = caught(|| build(&catalog, &context)).and_then(|built| built);
        let mut engine = built.map_err(Diagnostic::bug)?;
        engine.set_module_resolver(resolver);
        let engine = Rc::new(engine);
        context.lend(&engine);
        Ok(Self { catalog, context, engine })
    }

    /// Begins to count anew what is used, and keeps the limits as long as the guard lives.
    ///
    /// # Errors
    /// When no thread can be started that keeps them.
    pub fn watch(&self) -> Result<Watchdog, Halt> {
        self.context.meter().watch().map_err(|error| {
            let told = format!("cannot start a thread that keeps the limits: {error}");
            Halt::Failed(Diagnostic::general(told))
        })
    }

    /// Lets the engine work while the limits are kept, and ends its progress and its output; `program` is the text that errors are
    /// explained with, and is asked for where there is one.
    ///
    /// # Errors
    /// Why the work did not come to its end. A panic in a native body is our mistake: what the script did so far can still be used.
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
                let (told, hint) = lost.words();
                Err(Halt::Failed(Diagnostic { hint, ..Diagnostic::general(told) }))
            }
            (Ok(Ok(value)), _) => Ok(value),
            (Ok(Err(error)), _) if is_interrupt(&error) => Err(Halt::Interrupted),
            (Ok(Err(error)), _) => Err(self.halted_by(&error, &program())),
            (Err(panic), _) => Err(Halt::Failed(Diagnostic::bug(panic))),
        }
    }

    fn halted_by(&self, error: &EvalAltResult, program: &Program) -> Halt {
        let diagnostic = self.explain(error, program);
        match self.context.meter().has_pretended() {
            _ if is_waiting(error) => Halt::Undecided(diagnostic),
            true => Halt::Failed(diagnostic.with_another_hint(ONLY_DRY)),
            false => Halt::Failed(diagnostic),
        }
    }

    /// An error of the engine in `program`, in the words of the language.
    pub fn explain(&self, error: &EvalAltResult, program: &Program) -> Diagnostic {
        Explainer { program, catalog: &self.catalog, engine: &self.engine }.explain(error)
    }

    /// The language that the engine of the host speaks.
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// What the calls share.
    pub fn context(&self) -> &Context {
        &self.context
    }

    /// The engine, for what runs no script: showing values, and reading texts.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }
}

/// Simulations hold functions that hold the context, which holds the last simulation.
impl Drop for ScriptEngine {
    fn drop(&mut self) {
        self.context.forget_simulations();
    }
}
