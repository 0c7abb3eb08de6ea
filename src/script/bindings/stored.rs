//! Script functions stored for later calls.

use rhai::{Dynamic, EvalAltResult, FnPtr, GlobalRuntimeState, NativeCallContext, Position};

use crate::script::messages::error::BUG;
use crate::script::messages::numbers::{as_number, describe};
use crate::script::state::context::Context;

/// Script function with the functions, imports and constants of its file, which a function pointer of Rhai 1.27 does not contain.
/// The reference to the engine is weak, because the engine indirectly owns this function through the scenes of the script.
pub struct StoredFunction {
    function: FnPtr,
    surroundings: GlobalRuntimeState,
    context: Context,
    role: String,
}

impl StoredFunction {
    pub(super) fn new(
        function: FnPtr,
        native: &NativeCallContext,
        context: &Context,
        role: String,
    ) -> Self {
        let surroundings = native.global_runtime_state().clone();
        Self { function, surroundings, context: context.clone(), role }
    }

    /// Calls the function at the call depth of the running native call, so that the limit of the depth applies.
    ///
    /// # Errors
    /// Fails if the function fails, or if the run was stopped or has ended.
    pub fn call(&self, arguments: impl AsMut<[Dynamic]>) -> Result<Dynamic, Box<EvalAltResult>> {
        self.context.proceed().map_err(|error| error.into_engine(Position::NONE))?;
        let Some(engine) = self.context.engine() else {
            let message = format!("{} is called after the end of its run", self.role);
            return Err(EvalAltResult::ErrorSystem(message, BUG.into()).into());
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

    /// Calls the function with a number, and expects a number as its result.
    ///
    /// # Errors
    /// Fails if the function fails or returns a value of another type.
    pub fn number_of(&self, argument: f64) -> Result<f64, NoNumber> {
        let value = self.call([Dynamic::from(argument)]).map_err(NoNumber::Failed)?;
        as_number(&value).ok_or_else(|| {
            let got = self.context.engine().map(|engine| describe(&engine, &value));
            let got = got.unwrap_or_default();
            NoNumber::Other(format!("{} must return a number, got {got}", self.role))
        })
    }

    pub fn captured(&self) -> impl Iterator<Item = &Dynamic> {
        self.function.curry().iter().filter(|value| value.is_shared())
    }

    pub fn role(&self) -> &str {
        &self.role
    }

    pub fn context(&self) -> &Context {
        &self.context
    }
}

pub enum NoNumber {
    Failed(Box<EvalAltResult>),
    Other(String),
}
