//! Methods and properties of what depends on parameters: those of the section, curve, vector or number that it is.

use std::collections::BTreeMap;

use rhai::{Dynamic, Engine, EvalAltResult, NativeCallContext};

use super::catalog::Catalog;
use super::lifting::{Varied, lifting_of, present};
use super::register::{Binding, perform, with_receiver};
use super::table::Form;
use crate::script::state::context::Context;
use crate::script::words::error::EngineResult;

/// The rows of one name and count of arguments: those that belong to a type, and the function of that name, which takes any.
type Rows = Vec<Binding>;

/// Registers the methods and properties of all types of the language for values that depend on parameters.
pub fn install(engine: &mut Engine, catalog: &Catalog, context: &Context) {
    let mut members: BTreeMap<(String, usize), Rows> = BTreeMap::new();
    let of_varied = with_receiver(super::kind::Type::of::<Varied>(), 0);
    for table in catalog.tables() {
        for row in table.rows {
            let binding = Binding::of(row, lifting_of(table, row), context);
            let counts = row.required()..=row.parameters.len();
            match row.form {
                Form::Method(_) => {
                    for count in counts {
                        members.entry((row.name.into(), count)).or_default().push(binding.clone());
                    }
                }
                Form::Property(_) => {
                    let getter = (format!("{GET}{}", row.name), 0);
                    members.entry(getter).or_default().push(binding.clone());
                    if let Some(setter) = row.setter {
                        let own = (format!("{SET}{}", row.name), 1);
                        members.entry(own).or_default().push(binding.setting(setter));
                    }
                }
                Form::Function | Form::Operator => {}
            }
        }
    }
    // A method of a type wins over a function of its name, which is there for all others.
    for table in catalog.tables() {
        for row in table.rows.iter().filter(|row| matches!(row.form, Form::Function)) {
            for count in row.required().max(1)..=row.parameters.len() {
                if let Some(rows) = members.get_mut(&(row.name.to_owned(), count - 1)) {
                    rows.push(Binding::of(row, lifting_of(table, row), context));
                }
            }
        }
    }
    for ((name, count), rows) in members {
        let mut types = of_varied.clone();
        types.resize(1 + count, std::any::TypeId::of::<Dynamic>());
        let own = name.clone();
        engine.register_raw_fn(name, types, move |native: NativeCallContext, values| {
            member(&own, &rows, &native, values)
        });
    }
}

const GET: &str = "get$";
const SET: &str = "set$";

fn member(
    name: &str,
    rows: &[Binding],
    native: &NativeCallContext,
    values: &mut [&mut Dynamic],
) -> EngineResult<Dynamic> {
    let position = native.call_position();
    let variant = present().map_or(0, |present| present.variant);
    let Some(receiver) = values.first().map(|held| Varied::project(held, variant)) else {
        return Ok(Dynamic::UNIT);
    };
    let is_of = |row: &&Binding| row.receiver().is_none_or(|of| of.id() == receiver.type_id());
    if let Some(row) = rows.iter().find(is_of) {
        return perform(row, native, values).map_err(|error| error.into_engine(position));
    }
    let word = |value: &Dynamic| {
        native.engine().map_type_name(Varied::project(value, variant).type_name()).to_owned()
    };
    let own = word(&receiver);
    Err(match name.strip_prefix(GET).or(name.strip_prefix(SET)) {
        Some(property) => {
            let told = format!(
                "Unknown property '{property}' - a getter is not registered for type '{own}'"
            );
            EvalAltResult::ErrorDotExpr(told, position)
        }
        None => {
            let types: Vec<String> = values.iter().map(|value| word(value)).collect();
            EvalAltResult::ErrorFunctionNotFound(format!("{name} ({})", types.join(", ")), position)
        }
    }
    .into())
}
