//! Script functions that are kept and called later, when no call of the script is at hand.

use rhai::{AST, Dynamic, Engine, EvalAltResult, FnPtr, NativeCallContext};

use super::catalog::Catalog;
use super::context::Context;
use super::engine;
use super::error::ScriptError;
use super::numbers::{as_number, describe};

/// A script function with the functions of its script and an engine to run it.
///
/// In Rhai 1.27 a function pointer is a name and captured values only: the library it was made in must be kept too.
pub struct StoredFunction {
    function: FnPtr,
    library: AST,
    engine: Engine,
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
    ) -> Result<Self, ScriptError> {
        let library = native.global_runtime_state().lib.last();
        let library =
            library.map_or_else(AST::empty, |module| AST::new_from_module(module.clone()));
        let engine = engine::build(&Catalog::standard(), context).map_err(ScriptError::bug)?;
        Ok(Self { function, library, engine, context: context.clone(), role })
    }

    /// Calls it with a number for a finite number.
    ///
    /// # Errors
    /// In words; an error of the script itself is also handed to the context, which keeps its place and trace.
    pub fn number_of(&self, argument: f64) -> Result<f64, String> {
        let value = self.function.call::<Dynamic>(&self.engine, &self.library, (argument,));
        let value = value.map_err(|error: Box<EvalAltResult>| {
            let words = error.to_string();
            self.context.keep_callback_error(error);
            words
        })?;
        as_number(&value).ok_or_else(|| {
            format!("{} must give a number, got {}", self.role, describe(&self.engine, &value))
        })
    }
}
