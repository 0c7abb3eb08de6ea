//! Script functions that are kept and called later: by native loops, or by another call than the one they were given to.

use rhai::{Dynamic, EvalAltResult, FnPtr, GlobalRuntimeState, NativeCallContext, Position};

use crate::script::messages::error::BUG;
use crate::script::messages::numbers::{as_number, describe};
use crate::script::state::context::Context;

/// A script function with what surrounded it: the functions, imports and constants of its file.
///
/// In Rhai 1.27 a function pointer is a name and captured values only. The engine is that of the run: it is not owned,
/// for it owns, by way of the scenes of its script, this.
pub struct StoredFunction {
    function: FnPtr,
    surroundings: GlobalRuntimeState,
    context: Context,
    role: String,
}

impl StoredFunction {
    /// Keeps a function that was handed to a native call; `role` names it in messages.
    pub(super) fn new(
        function: FnPtr,
        native: &NativeCallContext,
        context: &Context,
        role: String,
    ) -> Self {
        let surroundings = native.global_runtime_state().clone();
        Self { function, surroundings, context: context.clone(), role }
    }

    /// Calls the function. Levels of calls are counted from the native call that is running, whose position its errors get.
    ///
    /// # Errors
    /// The errors of the script; also when the run was stopped.
    pub fn call(&self, arguments: impl AsMut<[Dynamic]>) -> Result<Dynamic, Box<EvalAltResult>> {
        self.context.proceed().map_err(|error| error.into_engine(Position::NONE))?;
        let Some(engine) = self.context.engine() else {
            let told = format!("{} is called after the end of its run", self.role);
            return Err(EvalAltResult::ErrorSystem(told, BUG.into()).into());
        };
        let level = self.context.level();
        let mut raised = None;
        let surroundings = if level > self.surroundings.level {
            let raised = raised.insert(self.surroundings.clone());
            raised.level = level;
            &*raised
        } else {
            &self.surroundings
        };
        let native = (&*engine, self.function.fn_name(), None, surroundings, Position::NONE).into();
        let called = self.context.call_back(|| self.function.call_raw(&native, None, arguments));
        self.context.enter(level);
        called
    }

    /// Calls the function with a number for a number.
    ///
    /// # Errors
    /// The function's own error, or that it gives something else; of the own one the context keeps place and trace.
    pub fn number_of(&self, argument: f64) -> Result<f64, NoNumber> {
        let value = self.call([Dynamic::from(argument)]).map_err(NoNumber::Failed)?;
        as_number(&value).ok_or_else(|| {
            let got = self.context.engine().map(|engine| describe(&engine, &value));
            let got = got.unwrap_or_default();
            NoNumber::Other(format!("{} must give a number, got {got}", self.role))
        })
    }

    /// What it is called in messages.
    pub fn role(&self) -> &str {
        &self.role
    }

    /// The state that all calls of the function's run share.
    pub fn context(&self) -> &Context {
        &self.context
    }
}

/// Why a script function gave no number.
pub enum NoNumber {
    /// The script function failed.
    Failed(Box<EvalAltResult>),
    /// The script function gave something else than a number, in words.
    Other(String),
}
