//! Option maps with known keys, whose values are checked. A misspelt key is an error.

use std::ops::Deref;

use rhai::{Dynamic, Engine, Map};

use super::accept::accept;
use super::arguments::Arguments;
use super::parameter::Parameter;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;

/// Option map with checked keys and values. It is read like arguments, for example `options.number("EA")`.
#[derive(Clone)]
pub struct Options {
    arguments: Arguments,
}

impl Deref for Options {
    type Target = Arguments;

    fn deref(&self) -> &Arguments {
        &self.arguments
    }
}

impl Options {
    pub fn defaults(keys: &'static [Parameter]) -> Self {
        Self { arguments: Arguments::new(keys, Vec::new()) }
    }

    /// Checks `map` against `keys`. `owner` is the function or option map that error messages name.
    pub fn read(
        engine: &Engine,
        owner: &str,
        keys: &'static [Parameter],
        map: &Map,
    ) -> Result<Self, ScriptError> {
        if let Some(unknown) =
            map.keys().find(|name| keys.iter().all(|key| key.name != name.as_str()))
        {
            return Err(unknown_key(owner, keys, unknown));
        }
        let is_alone = |key: &&Parameter| {
            map.contains_key(key.name)
                && !key.required_key.is_empty()
                && !map.contains_key(key.required_key)
        };
        if let Some(key) = keys.iter().find(is_alone) {
            return Err(alone(owner, keys, key));
        }
        let values =
            keys.iter().map(|key| value_of(engine, owner, key, map)).collect::<Result<_, _>>()?;
        Ok(Self { arguments: Arguments::new(keys, values) })
    }

    pub(super) fn missing(&self, owner: &str, name: &str, message: &str) -> ScriptError {
        match self.arguments.parameter(name) {
            Some(key) => missing(owner, name, &format!("{}; {message}", expected_key_text(key))),
            None => ScriptError::internal_error(format!("{owner} has no option '{name}'")),
        }
    }
}

fn value_of(
    engine: &Engine,
    owner: &str,
    key: &Parameter,
    map: &Map,
) -> Result<Option<Dynamic>, ScriptError> {
    match map.get(key.name) {
        Some(value) => accept(engine, owner, key, value.clone().flatten())
            .map(Some)
            .map_err(|error| at_key(error, key.name)),
        None if key.is_required() => Err(missing_key(owner, key)),
        None => Ok(None),
    }
}

fn unknown_key(owner: &str, keys: &[Parameter], unknown: &str) -> ScriptError {
    let meant = nearest(unknown, keys.iter().map(|key| key.name));
    let suggestion = meant.map(|name| format!("did you mean '{name}'? ")).unwrap_or_default();
    ScriptError::new(format!("{owner}: unknown option '{unknown}'"))
        .hint(format!("{suggestion}known options: {}", list(keys)))
        .at(CallPart::Key(unknown.to_owned()))
}

fn missing_key(owner: &str, key: &Parameter) -> ScriptError {
    missing(owner, key.name, &expected_key_text(key))
}

fn missing(owner: &str, name: &str, what_to_add: &str) -> ScriptError {
    ScriptError::new(format!("{owner}: the option '{name}' is missing"))
        .hint(format!("add {what_to_add}"))
}

fn alone(owner: &str, keys: &[Parameter], key: &Parameter) -> ScriptError {
    let Parameter { name, required_key: beside, .. } = key;
    let other = keys.iter().find(|other| other.name == *beside);
    let other = other.map_or_else(|| (*beside).to_owned(), expected_key_text);
    ScriptError::new(format!("{owner}: the option '{name}' requires the option '{beside}'"))
        .hint(format!("add {other}, or omit {name}"))
        .at(CallPart::Key((*name).to_owned()))
}

fn expected_key_text(key: &Parameter) -> String {
    let meaning = if key.doc.is_empty() { String::new() } else { format!(" ({})", key.doc) };
    format!("{}: {}{meaning}", key.name, key.expectation())
}

fn list(keys: &[Parameter]) -> String {
    let names = keys.iter().map(|key| match key.is_required() {
        true => format!("{} (required)", key.name),
        false => key.name.to_owned(),
    });
    names.collect::<Vec<_>>().join(", ")
}

/// Sets the position of an error to that of the key, unless the error already refers to a key of a nested map.
fn at_key(error: ScriptError, key: &str) -> ScriptError {
    match error {
        ScriptError::Failure(failure) if failure.place == CallPart::Call => {
            ScriptError::Failure(failure).at(CallPart::Key(key.to_owned()))
        }
        other => other,
    }
}
