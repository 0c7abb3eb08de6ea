//! What a native body sees: its arguments by name, the receiver, the context, and a way to call back.

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

/// One call of a row of the language, in progress.
pub struct Call<'c, 'r> {
    row: &'static FunctionBinding,
    context: &'c Context,
    native: &'c NativeCallContext<'c>,
    receiver: Option<&'r mut Dynamic>,
    arguments: Arguments,
}

/// Arguments are read straight from the call: `call.number("dt")`.
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

    /// The state that all calls of a run share: output folder, mode, checks, progress.
    pub fn context(&self) -> &'c Context {
        self.context
    }

    /// The value whose method or property is called. Handles are cloned, which is cheap.
    pub fn receiver<T: Clone + 'static>(&self) -> Result<T, ScriptError> {
        let receiver = self
            .receiver
            .as_ref()
            .and_then(|value| value.read_lock::<T>().map(|held| held.clone()));
        receiver.ok_or_else(|| {
            ScriptError::bug(format!("'{}' has no receiver of its type", self.row.name))
        })
    }

    /// Changes the value whose method or property is called.
    pub fn change_receiver<T: Clone + 'static>(
        &mut self,
        change: impl FnOnce(&mut T),
    ) -> Result<(), ScriptError> {
        let name = self.row.name;
        let receiver = self.receiver.as_mut().and_then(|value| value.write_lock::<T>());
        let mut receiver = receiver
            .ok_or_else(|| ScriptError::bug(format!("'{name}' has no receiver of its type")))?;
        change(&mut receiver);
        Ok(())
    }

    /// The line of the script that calls, from 1; for a call by the standard library, the line that called the library.
    pub fn line(&self) -> usize {
        let entered = Sources::of(self.native.engine())
            .entered_at(self.native.global_runtime_state().source());
        entered.or(self.native.call_position().line()).unwrap_or(0)
    }

    /// Calls a script function back from this call. Its own errors, positions and trace stay as they are.
    pub fn invoke(
        &self,
        function: &FnPtr,
        arguments: impl AsMut<[Dynamic]>,
    ) -> Result<Dynamic, ScriptError> {
        self.proceed()?;
        function.call_raw(self.native, None, arguments).map_err(ScriptError::Engine)
    }

    /// How many arguments a script function takes, if that is known.
    pub fn arguments_of(&self, function: &FnPtr) -> Option<usize> {
        arguments_of(self.native, function)
    }

    /// The definition of a script function, if it is one of the running file.
    pub fn definition(&self, function: &FnPtr) -> Option<Shared<ScriptFuncDef>> {
        definition_of(self.native, function)
    }

    /// What a script function does, as a syntax tree without anything else in it; an empty one where it is not one of the running file.
    pub fn body(&self, function: &FnPtr) -> AST {
        body_of(self.native, function)
    }

    /// The script function of this name with so many parameters, captured ones included, without captured values.
    pub fn function_named(&self, name: &str, parameters: usize) -> Option<FnPtr> {
        let libraries = &self.native.global_runtime_state().lib;
        let found = libraries.iter().find_map(|of| of.get_script_fn(name, parameters).cloned());
        found.map(FnPtr::from)
    }

    /// The engine of the run.
    pub fn engine(&self) -> &Engine {
        self.native.engine()
    }

    /// Refuses a script function that takes another number of arguments; `shape` shows the right one.
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

    /// Keeps a script function for later calls; `role` names it in messages.
    pub fn store(&self, function: FnPtr, role: &str) -> StoredFunction {
        StoredFunction::new(function, self.native, self.context, role.to_owned())
    }

    /// Refuses to go on with the call when the run was interrupted; long native loops ask once in every step.
    pub fn proceed(&self) -> Result<(), ScriptError> {
        self.context.proceed()
    }

    /// Gives `value` in the form that bodies read, for a parameter of a script's own function: a kind, and the words of the script for it.
    pub fn accept(
        &self,
        owner: &str,
        name: &str,
        wanted: (&Kind, &str),
        value: Dynamic,
    ) -> Result<Dynamic, ScriptError> {
        accept_described(self.native.engine(), owner, name, wanted, value)
    }

    /// An error of the call that begins with the name of the row, as all errors about a call do.
    pub fn error(&self, what: impl std::fmt::Display) -> ScriptError {
        ScriptError::new(format!("{}: {what}", self.row.name))
    }

    /// A value in the words of a message.
    pub fn describe(&self, value: &Dynamic) -> String {
        describe(self.native.engine(), value)
    }

    /// The name of the type of a value.
    pub fn type_of(&self, value: &Dynamic) -> String {
        self.native.engine().map_type_name(value.type_name()).to_owned()
    }

    /// A value as the script would print it.
    pub fn show(&self, value: &Dynamic) -> String {
        let mut value = value.clone();
        let shown = self.native.call_native_fn_raw("to_debug", true, &mut [&mut value]);
        // What has no words of its own is shown as the engine shows it.
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

/// The function of a script by its name and the count of its parameters, captured ones included; whatever that is, where none is given.
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

/// What the function of a script of this name and so many parameters does, captured ones included; an empty tree where there is none.
pub(super) fn body_named(native: &NativeCallContext, name: &str, parameters: usize) -> AST {
    let libraries = &native.global_runtime_state().lib;
    let has = |library: &&Shared<Module>| library.get_script_fn(name, parameters).is_some();
    let library = libraries.iter().find(has).map(|found| AST::new_from_module(found.clone()));
    let mut body = library.unwrap_or_default();
    // Rhai's filtered clone of a syntax tree takes all functions along.
    body.retain_functions(|_, _, own, count| own == name && count == parameters);
    body
}

/// The function that is written within another one where this is what Rhai makes of it, without what it captures, and the variables that it does.
pub fn written_within(call: &FnCallExpr) -> Option<(FnPtr, &[Expr])> {
    match call.args.as_slice() {
        [Expr::DynamicConstant(function, _), captured @ ..] if call.name == CAPTURE => {
            Some(((**function).clone().try_cast()?, captured))
        }
        _ => None,
    }
}

/// What Rhai calls where a function captures variables.
const CAPTURE: &str = "curry";
