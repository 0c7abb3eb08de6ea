//! Native call in progress, with its arguments and the state of the run.

use std::ops::Deref;

use rhai::{
    AST, Dynamic, Engine, Expr, FnCallExpr, FnPtr, Module, NativeCallContext, ScriptFuncDef, Shared,
};

use super::accept::accept_described;
use super::arguments::Arguments;
use super::kind::Kind;
use super::sources::Sources;
use super::stored::StoredFunction;
use super::table::FunctionBinding;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::describe;
use crate::script::state::context::Context;

/// Call of a native function by a script, with its arguments and the state of the run.
pub struct Call<'c, 'r> {
    row: &'static FunctionBinding,
    context: &'c Context,
    native: &'c NativeCallContext<'c>,
    receiver: Option<&'r mut Dynamic>,
    arguments: Arguments,
}

/// Gives direct access to the arguments of a call, for example `call.number("dt")`.
impl Deref for Call<'_, '_> {
    type Target = Arguments;

    fn deref(&self) -> &Arguments {
        &self.arguments
    }
}

impl<'c, 'r> Call<'c, 'r> {
    pub(super) fn new(
        row: &'static FunctionBinding,
        context: &'c Context,
        native: &'c NativeCallContext<'c>,
        receiver: Option<&'r mut Dynamic>,
        arguments: Arguments,
    ) -> Self {
        Self { row, context, native, receiver, arguments }
    }

    /// State shared by all calls of a run, such as the output folder and the checks.
    pub fn context(&self) -> &'c Context {
        self.context
    }

    /// Value before the dot of a method or property call. Handles are cheap to clone.
    pub fn receiver<T: Clone + 'static>(&self) -> Result<T, ScriptError> {
        let receiver = self
            .receiver
            .as_ref()
            .and_then(|value| value.read_lock::<T>().map(|held| held.clone()));
        receiver.ok_or_else(|| {
            ScriptError::internal_error(format!("'{}' has no receiver of its type", self.row.name))
        })
    }

    /// Modifies the value before the dot of a method or property call.
    pub fn change_receiver<T: Clone + 'static>(
        &mut self,
        change: impl FnOnce(&mut T),
    ) -> Result<(), ScriptError> {
        let name = self.row.name;
        let receiver = self.receiver.as_mut().and_then(|value| value.write_lock::<T>());
        let mut receiver = receiver.ok_or_else(|| {
            ScriptError::internal_error(format!("'{name}' has no receiver of its type"))
        })?;
        change(&mut receiver);
        Ok(())
    }

    /// Script line of the call, counted from 1; for a call by the standard library, the line that called the library.
    pub fn line(&self) -> usize {
        let entered = Sources::of(self.native.engine())
            .entered_at(self.native.global_runtime_state().source());
        entered.or(self.native.call_position().line()).unwrap_or(0)
    }

    /// Calls a script function. Errors of the function keep their positions and call trace.
    pub fn invoke(
        &self,
        function: &FnPtr,
        arguments: impl AsMut<[Dynamic]>,
    ) -> Result<Dynamic, ScriptError> {
        self.proceed()?;
        function.call_raw(self.native, None, arguments).map_err(ScriptError::Engine)
    }

    /// Number of arguments that a script function takes; `None` if unknown.
    pub fn arguments_of(&self, function: &FnPtr) -> Option<usize> {
        arguments_of(self.native, function)
    }

    /// Definition of a script function; `None` if it is not a function of the running file.
    pub fn definition(&self, function: &FnPtr) -> Option<Shared<ScriptFuncDef>> {
        definition_of(self.native, function)
    }

    /// Syntax tree that contains only this script function; empty if it is not a function of the running file.
    pub fn body(&self, function: &FnPtr) -> AST {
        body_of(self.native, function)
    }

    /// Script function with this name and number of parameters. Captured variables count as parameters.
    /// The returned pointer does not contain the values of captured variables.
    pub fn function_named(&self, name: &str, parameters: usize) -> Option<FnPtr> {
        let libraries = &self.native.global_runtime_state().lib;
        let found = libraries.iter().find_map(|of| of.get_script_fn(name, parameters).cloned());
        found.map(FnPtr::from)
    }

    /// Engine of the run.
    pub fn engine(&self) -> &Engine {
        self.native.engine()
    }

    /// Rejects a script function with a wrong number of arguments. `shape` shows the required form in the message.
    pub fn expect_arguments(
        &self,
        function: &FnPtr,
        count: usize,
        shape: &str,
    ) -> Result<(), ScriptError> {
        match self.arguments_of(function) {
            Some(given) if given != count => {
                let plural = if given == 1 { "" } else { "s" };
                Err(self
                    .error(format!(
                        "the function takes {given} argument{plural}, but is called with {count}"
                    ))
                    .hint(format!("write {shape}")))
            }
            _ => Ok(()),
        }
    }

    /// Stores a script function for later calls. `role` names the function in messages.
    pub fn store(&self, function: FnPtr, role: &str) -> StoredFunction {
        StoredFunction::new(function, self.native, self.context, role.to_owned())
    }

    /// Returns an error if the run was interrupted or has exceeded a limit. Long native loops must call this function regularly.
    pub fn proceed(&self) -> Result<(), ScriptError> {
        self.context.proceed()
    }

    /// Converts `value` to the type of a parameter of a script function. `wanted` is the type and its description.
    pub fn accept(
        &self,
        owner: &str,
        name: &str,
        wanted: (&Kind, &str),
        value: Dynamic,
    ) -> Result<Dynamic, ScriptError> {
        accept_described(self.native.engine(), owner, name, wanted, value)
    }

    /// Creates an error whose message begins with the name of the function.
    pub fn error(&self, what: impl std::fmt::Display) -> ScriptError {
        ScriptError::new(format!("{}: {what}", self.row.name))
    }

    /// Short text that stands for a value in a message, such as `the text "abc"` or `an array of 3`.
    pub fn describe(&self, value: &Dynamic) -> String {
        describe(self.native.engine(), value)
    }

    /// Type name of a value.
    pub fn type_of(&self, value: &Dynamic) -> String {
        self.native.engine().map_type_name(value.type_name()).to_owned()
    }

    /// Text of a value as the script prints it.
    pub fn show(&self, value: &Dynamic) -> String {
        let mut value = value.clone();
        let shown = self.native.call_native_fn_raw("to_debug", true, &mut [&mut value]);
        shown.map_or_else(|_| value.to_string(), |text| text.to_string())
    }
}

fn arguments_of(native: &NativeCallContext, function: &FnPtr) -> Option<usize> {
    let libraries = &native.global_runtime_state().lib;
    let known = libraries.iter().find_map(|library| {
        let library = AST::new_from_module(library.clone());
        let mut functions = library.iter_functions();
        functions.find(|known| known.name == function.fn_name()).map(|known| known.params.len())
    });
    known.map(|parameters| parameters.saturating_sub(function.curry().len()))
}

fn definition_of(native: &NativeCallContext, function: &FnPtr) -> Option<Shared<ScriptFuncDef>> {
    let libraries = &native.global_runtime_state().lib;
    let parameters = arguments_of(native, function)? + function.curry().len();
    let defined =
        |library: &Shared<Module>| library.get_script_fn(function.fn_name(), parameters).cloned();
    libraries.iter().find_map(defined)
}

/// Script function with this name and number of parameters, including captured variables. `None` allows any number.
pub(super) fn defined(
    native: &NativeCallContext,
    name: &str,
    parameters: Option<usize>,
) -> Option<Shared<ScriptFuncDef>> {
    let libraries = &native.global_runtime_state().lib;
    let is_it = |of: &Shared<ScriptFuncDef>| {
        of.name == name && parameters.is_none_or(|count| of.params.len() == count)
    };
    let in_library = |library: &Shared<Module>| {
        library.iter_script_fn_info().map(|(.., of)| of).find(|of| is_it(of)).cloned()
    };
    libraries.iter().find_map(in_library)
}

fn body_of(native: &NativeCallContext, function: &FnPtr) -> AST {
    let parameters = arguments_of(native, function).unwrap_or(0) + function.curry().len();
    body_named(native, function.fn_name(), parameters)
}

/// Syntax tree that contains only the function with this name and number of parameters; empty if there is none.
pub(super) fn body_named(native: &NativeCallContext, name: &str, parameters: usize) -> AST {
    let libraries = &native.global_runtime_state().lib;
    let has = |library: &&Shared<Module>| library.get_script_fn(name, parameters).is_some();
    let library = libraries.iter().find(has).map(|found| AST::new_from_module(found.clone()));
    let mut body = library.unwrap_or_default();
    // The other functions are removed, because cloning a syntax tree with a filter keeps all functions.
    body.retain_functions(|_, _, own, count| own == name && count == parameters);
    body
}

/// Closure that captures variables, without the captured values, and the expressions of the captured variables; `None` for other calls.
/// Rhai represents such a closure in the syntax tree as a call of `curry`.
pub fn written_within(call: &FnCallExpr) -> Option<(FnPtr, &[Expr])> {
    match call.args.as_slice() {
        [Expr::DynamicConstant(function, _), captured @ ..] if call.name == CAPTURE => {
            Some(((**function).clone().try_cast()?, captured))
        }
        _ => None,
    }
}

const CAPTURE: &str = "curry";
