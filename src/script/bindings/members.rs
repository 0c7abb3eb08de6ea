//! Methods and properties of values that depend on parameters, evaluated once for each variant of the parameters.

use std::collections::BTreeMap;

use rhai::{Dynamic, Engine, EvalAltResult, NativeCallContext};

use super::catalog::Catalog;
use super::kind::Type;
use super::parameter_variants::{VariantValue, lifting_of, present_variant};
use super::register::{RegisteredFunction, perform, with_receiver};
use super::table::{CallSyntax, getter_of, setter_of};
use crate::script::messages::error::EngineResult;
use crate::script::state::context::Context;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Use {
    Called(usize),
    Read,
    Assigned,
}

impl Use {
    fn arguments(self) -> usize {
        match self {
            Self::Called(count) => count,
            Self::Read => 0,
            Self::Assigned => 1,
        }
    }

    fn registered(self, name: &str) -> String {
        match self {
            Self::Called(_) => name.into(),
            Self::Read => getter_of(name),
            Self::Assigned => setter_of(name),
        }
    }
}

pub fn install(engine: &mut Engine, catalog: &Catalog, context: &Context) {
    let mut members: BTreeMap<(&'static str, Use), Vec<RegisteredFunction>> = BTreeMap::new();
    for table in catalog.tables() {
        for row in table.rows {
            let mut add = |with: Use, binding: RegisteredFunction| {
                members.entry((row.name, with)).or_default().push(binding);
            };
            let binding = || RegisteredFunction::of(row, lifting_of(table, row), context);
            match row.form {
                CallSyntax::Method(_) => {
                    for count in row.required()..=row.parameters.len() {
                        add(Use::Called(count), binding());
                    }
                }
                CallSyntax::Property(_) => {
                    add(Use::Read, binding());
                    if let Some(setter) = row.setter {
                        add(Use::Assigned, binding().setting(setter));
                    }
                }
                CallSyntax::Function | CallSyntax::Operator => {}
            }
        }
    }
    // Methods of a type take precedence over functions with the same name.
    for table in catalog.tables() {
        for row in table.rows.iter().filter(|row| matches!(row.form, CallSyntax::Function)) {
            for count in row.required().max(1)..=row.parameters.len() {
                if let Some(rows) = members.get_mut(&(row.name, Use::Called(count - 1))) {
                    rows.push(RegisteredFunction::of(row, lifting_of(table, row), context));
                }
            }
        }
    }
    let varied = Type::of::<VariantValue>();
    for ((name, with), rows) in members {
        let types = with_receiver(varied, with.arguments());
        engine.register_raw_fn(
            with.registered(name),
            types,
            move |native: NativeCallContext, values| member((name, with), &rows, &native, values),
        );
    }
}

fn member(
    (name, with): (&str, Use),
    rows: &[RegisteredFunction],
    native: &NativeCallContext,
    values: &mut [&mut Dynamic],
) -> EngineResult<Dynamic> {
    let position = native.call_position();
    let variant = present_variant();
    let Some(receiver) = values.first().map(|held| VariantValue::project(held, variant)) else {
        return Ok(Dynamic::UNIT);
    };
    let is_of =
        |row: &&RegisteredFunction| row.receiver().is_none_or(|of| of.id() == receiver.type_id());
    if let Some(row) = rows.iter().find(is_of) {
        return perform(row, native, values).map_err(|error| error.into_engine(position));
    }
    let word = |value: &Dynamic| {
        native.engine().map_type_name(VariantValue::project(value, variant).type_name()).to_owned()
    };
    let own = word(&receiver);
    let unknown = |what: &str| {
        let message =
            format!("Unknown property '{name}' - a {what} is not registered for type '{own}'");
        EvalAltResult::ErrorDotExpr(message, position)
    };
    Err(match with {
        Use::Read => unknown("getter"),
        Use::Assigned => unknown("setter"),
        Use::Called(_) => {
            let types: Vec<String> = values.iter().map(|value| word(value)).collect();
            EvalAltResult::ErrorFunctionNotFound(format!("{name} ({})", types.join(", ")), position)
        }
    }
    .into())
}
