//! Typed access by name to the checked arguments of a call or keys of an option map.

use rhai::{Array, Dynamic, FnPtr, INT, ImmutableString};

use super::kind::Kind;
use super::options::Options;
use super::parameter::Parameter;
use crate::geometry::Vec2;
use crate::script::messages::error::ScriptError;

#[derive(Clone)]
pub struct Arguments {
    parameters: &'static [Parameter],
    values: Vec<Option<Dynamic>>,
}

impl Arguments {
    pub(super) fn new(parameters: &'static [Parameter], mut values: Vec<Option<Dynamic>>) -> Self {
        values.resize(parameters.len(), None);
        for (parameter, value) in parameters.iter().zip(&mut values) {
            if value.is_none() {
                *value = parameter.default_value();
            }
        }
        Self { parameters, values }
    }

    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_ok()
    }

    pub fn present_names(&self) -> impl Iterator<Item = &'static str> {
        let pairs = self.parameters.iter().zip(&self.values);
        pairs.filter(|(_, value)| value.is_some()).map(|(parameter, _)| parameter.name)
    }

    pub(super) fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    pub fn number(&self, name: &str) -> Result<f64, ScriptError> {
        self.find(name)?.as_float().map_err(|held| wrong_type_read(name, held))
    }

    pub fn optional_number(&self, name: &str) -> Option<f64> {
        self.number(name).ok()
    }

    pub fn integer(&self, name: &str) -> Result<INT, ScriptError> {
        self.find(name)?.as_int().map_err(|held| wrong_type_read(name, held))
    }

    /// Value of the argument as a count. The type of the parameter must exclude negative numbers.
    pub fn count(&self, name: &str) -> Result<usize, ScriptError> {
        usize::try_from(self.integer(name)?).map_err(|_| wrong_type_read(name, "a negative number"))
    }

    pub fn text(&self, name: &str) -> Result<ImmutableString, ScriptError> {
        self.find(name)?.clone().into_immutable_string().map_err(|held| wrong_type_read(name, held))
    }

    /// Value of the argument as a text; `None` if the argument is omitted.
    ///
    /// # Errors
    /// Fails if the argument is not a text, which the type of the parameter should exclude.
    pub fn optional_text(&self, name: &str) -> Result<Option<String>, ScriptError> {
        self.has(name).then(|| self.text(name).map(String::from)).transpose()
    }

    pub fn boolean(&self, name: &str) -> Result<bool, ScriptError> {
        self.find(name)?.as_bool().map_err(|held| wrong_type_read(name, held))
    }

    pub fn point(&self, name: &str) -> Result<Vec2, ScriptError> {
        self.get(name)
    }

    pub fn array(&self, name: &str) -> Result<Array, ScriptError> {
        self.get(name)
    }

    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, ScriptError> {
        self.get(name)
    }

    pub fn points(&self, name: &str) -> Result<Vec<Vec2>, ScriptError> {
        self.get(name)
    }

    /// Value of the argument as a script function, which [`Call::invoke`](super::call::Call::invoke) can call.
    pub fn callback(&self, name: &str) -> Result<FnPtr, ScriptError> {
        self.get(name)
    }

    pub fn options(&self, name: &str) -> Result<Options, ScriptError> {
        self.get(name)
    }

    pub fn options_or_defaults(&self, name: &str) -> Result<Options, ScriptError> {
        match self.parameters.iter().find(|parameter| parameter.name == name) {
            Some(Parameter { kind: Kind::Options(keys), .. }) if !self.has(name) => {
                Ok(Options::defaults(keys))
            }
            _ => self.options(name),
        }
    }

    pub fn get<T: Clone + 'static>(&self, name: &str) -> Result<T, ScriptError> {
        self.find(name)?.clone().try_cast().ok_or_else(|| wrong_type_read(name, "another type"))
    }

    /// Value of the argument as a native type; `None` if the argument is omitted or has another type.
    pub fn get_if<T: Clone + 'static>(&self, name: &str) -> Option<T> {
        self.find(name).ok()?.clone().try_cast()
    }

    pub fn value(&self, name: &str) -> Result<Dynamic, ScriptError> {
        self.find(name).cloned()
    }

    fn find(&self, name: &str) -> Result<&Dynamic, ScriptError> {
        let index = self.parameters.iter().position(|parameter| parameter.name == name);
        index.and_then(|index| self.values.get(index)?.as_ref()).ok_or_else(|| {
            ScriptError::internal_error(format!(
                "a body reads '{name}', which its row does not promise"
            ))
        })
    }
}

fn wrong_type_read(name: &str, held: &str) -> ScriptError {
    ScriptError::internal_error(format!(
        "a body reads '{name}' as something else than its row says; it holds {held}"
    ))
}
