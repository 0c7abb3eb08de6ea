//! Registration of bindings in the engine. `perform` checks the arguments of every call.

use std::any::TypeId;

use rhai::{Array, Dynamic, Engine, INT, ImmutableString, NativeCallContext};

use super::accept::{accept, at_argument};
use super::arguments::Arguments;
use super::branch_detection;
use super::call::Call;
use super::kind::{Kind, Type};
use super::parameter::Parameter;
use super::parameter_variants::{Lifting, ParameterSet, evaluate_variants, lifting_of, present};
use super::table::{
    BindingTable, CallSyntax, FunctionBinding, NativeFunction, Setter, getter_of, setter_of,
};
use crate::geometry::Vec2;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;

pub fn register(engine: &mut Engine, table: &'static BindingTable, context: &Context) {
    for of in table.types {
        of.register(engine);
        context.register_busy_check(of.busy());
    }
    for row in table.rows {
        register_row(engine, row, lifting_of(table, row), context);
    }
}

fn register_row(
    engine: &mut Engine,
    row: &'static FunctionBinding,
    lifting: Lifting,
    context: &Context,
) {
    let binding = RegisteredFunction::of(row, lifting, context);
    match row.form {
        CallSyntax::Function => {
            for count in row.required()..=row.parameters.len() {
                let types = vec![TypeId::of::<Dynamic>(); count];
                add(engine, row.name.into(), types, binding.clone());
            }
            for types in numbers_only(row.parameters) {
                add(engine, row.name.into(), types, binding.clone());
            }
        }
        CallSyntax::Method(of) => {
            for count in row.required()..=row.parameters.len() {
                let types = with_receiver(of, count);
                add(engine, row.name.into(), types, binding.clone());
            }
        }
        CallSyntax::Property(of) => {
            let getter = getter_of(row.name);
            add(engine, getter, with_receiver(of, 0), binding.clone());
            if let Some(setter) = row.setter {
                let name = setter_of(row.name);
                add(engine, name, with_receiver(of, 1), binding.setting(setter));
            }
        }
        CallSyntax::Operator => {
            for types in operand_types(row.parameters) {
                add(engine, row.name.into(), types, binding.clone());
            }
        }
    }
}

pub(super) fn with_receiver(of: Type, count: usize) -> Vec<TypeId> {
    std::iter::once(of.id()).chain(std::iter::repeat_n(TypeId::of::<Dynamic>(), count)).collect()
}

/// Exact argument types of a function of numbers, by which it takes precedence over a function of Rhai with the same name.
fn numbers_only(parameters: &[Parameter]) -> Vec<Vec<TypeId>> {
    let numeric = |parameter: &Parameter| matches!(parameter.kind, Kind::Number(_) | Kind::Numeric);
    match parameters.iter().all(numeric) {
        true => combinations(parameters),
        false => vec![],
    }
}

fn operand_types(operands: &[Parameter]) -> Vec<Vec<TypeId>> {
    let built_in = [
        TypeId::of::<f64>(),
        TypeId::of::<INT>(),
        TypeId::of::<Array>(),
        TypeId::of::<ImmutableString>(),
    ];
    let mut combinations = combinations(operands);
    combinations.retain(|types| types.iter().any(|id| !built_in.contains(id)));
    combinations
}

fn combinations(parameters: &[Parameter]) -> Vec<Vec<TypeId>> {
    parameters.iter().fold(vec![vec![]], |combinations, parameter| {
        let types = exact_types(&parameter.kind);
        let longer = |left: Vec<TypeId>| {
            types.iter().map(|id| [left.as_slice(), &[*id]].concat()).collect::<Vec<_>>()
        };
        combinations.into_iter().flat_map(longer).collect()
    })
}

fn exact_types(kind: &Kind) -> Vec<TypeId> {
    match kind {
        Kind::Number(_) | Kind::Numeric => vec![TypeId::of::<f64>(), TypeId::of::<INT>()],
        Kind::Integer(_) => vec![TypeId::of::<INT>()],
        Kind::Text | Kind::Name | Kind::Choice(_) => vec![TypeId::of::<ImmutableString>()],
        Kind::Boolean => vec![TypeId::of::<bool>()],
        Kind::Point => vec![TypeId::of::<Vec2>(), TypeId::of::<Array>()],
        Kind::Array | Kind::Numbers | Kind::Points => vec![TypeId::of::<Array>()],
        Kind::Object(of) => vec![of.id()],
        Kind::Either(kinds) => kinds.iter().flat_map(exact_types).collect(),
        Kind::Function | Kind::Options(_) | Kind::Any => vec![],
    }
}

#[derive(Clone)]
pub(super) struct RegisteredFunction {
    row: &'static FunctionBinding,
    parameters: &'static [Parameter],
    body: NativeFunction,
    lifting: Lifting,
    context: Context,
}

impl RegisteredFunction {
    pub(super) fn of(row: &'static FunctionBinding, lifting: Lifting, context: &Context) -> Self {
        let (parameters, body) = (row.parameters, row.body);
        Self { row, parameters, body, lifting, context: context.clone() }
    }

    pub(super) fn setting(&self, setter: Setter) -> Self {
        Self { parameters: setter.value, body: setter.body, ..self.clone() }
    }

    pub(super) fn receiver(&self) -> Option<Type> {
        self.row.receiver()
    }
}

fn add(engine: &mut Engine, name: String, types: Vec<TypeId>, binding: RegisteredFunction) {
    engine.register_raw_fn(name, types, move |native, values| {
        let position = native.call_position();
        perform(&binding, &native, values).map_err(|error| error.into_engine(position))
    });
}

pub(super) fn perform(
    binding: &RegisteredFunction,
    native: &NativeCallContext,
    values: &mut [&mut Dynamic],
) -> Result<Dynamic, ScriptError> {
    called(binding, native, values).map_err(|error| match binding.row.form {
        CallSyntax::Method(_) => error.of_method(),
        _ => error,
    })
}

fn called(
    binding: &RegisteredFunction,
    native: &NativeCallContext,
    values: &mut [&mut Dynamic],
) -> Result<Dynamic, ScriptError> {
    let RegisteredFunction { row, parameters, context, .. } = binding;
    context.enter(native.global_runtime_state().level);
    if context.is_calling_back() {
        refuse_busy(row, context, values)?;
    }
    let (receiver, given) = match (row.receiver(), values) {
        (Some(_), [receiver, given @ ..]) => (Some(&mut **receiver), given),
        (_, given) => (None, given),
    };
    let given = given.iter().map(|value| (**value).clone().flatten());
    if !ParameterSet::is_any() {
        return make(binding, native, receiver, given);
    }
    let again = &mut |receiver: Option<&mut Dynamic>, given: &[Dynamic]| {
        let made = || make(binding, native, receiver, given.iter().cloned());
        match present() {
            Some(beside) if beside.variant > 0 => context.silently(made),
            _ => made(),
        }
    };
    let given: Vec<Dynamic> = given.collect();
    if binding.lifting == Lifting::Each && present().is_none() {
        branch_detection::warn_once(native, context, &given);
    }
    evaluate_variants((row, binding.lifting), receiver, (parameters, given), again)
}

fn make(
    binding: &RegisteredFunction,
    native: &NativeCallContext,
    receiver: Option<&mut Dynamic>,
    given: impl Iterator<Item = Dynamic>,
) -> Result<Dynamic, ScriptError> {
    let RegisteredFunction { row, parameters, body, context, .. } = binding;
    let accept =
        |parameter: &Parameter, value: Dynamic| accept(native.engine(), row.name, parameter, value);
    let mut given = parameters.iter().zip(given).enumerate();
    let mut accepted = Vec::with_capacity(parameters.len());
    while let Some((number, (parameter, value))) = given.next() {
        accepted.push(Some(accept(parameter, value).map_err(|error| {
            let error = at_argument(error, number);
            let is_exchanged = |(_, (later, value)): &(usize, (&Parameter, Dynamic))| {
                accept(later, value.clone()).is_err() && accept(parameter, value.clone()).is_ok()
            };
            match given.find(is_exchanged) {
                Some((_, (later, _))) => error.hint(format!(
                    "exchange the arguments: '{}' stands before '{}'",
                    parameter.name, later.name
                )),
                None => error,
            }
        })?));
    }
    body(&mut Call::new(row, context, native, receiver, Arguments::new(parameters, accepted)))
}

pub const CONTROLLER_HINT: &str = "a load is a function of time; for a load that depends on the motion use a controller, or a \
    variable that is set between steps: let u = 0.0; scene.force(station, [1, 0], |t| u); then \
    u = … before each sim.step()";

fn refuse_busy(
    row: &FunctionBinding,
    context: &Context,
    values: &[&mut Dynamic],
) -> Result<(), ScriptError> {
    let is_ours = |value: &Dynamic| !(value.is_float() || value.is_int() || value.is_string());
    for value in values.iter().map(|value| &**value).filter(|value| is_ours(value)) {
        let elements = value.read_lock::<Array>();
        let elements = elements.iter().flat_map(|array| array.iter());
        if let Some(reason) = elements.chain([value]).find_map(|value| context.busy(value)) {
            let refusal = ScriptError::new(format!("{}: {reason}", row.name));
            return Err(refusal.hint(CONTROLLER_HINT));
        }
    }
    Ok(())
}
