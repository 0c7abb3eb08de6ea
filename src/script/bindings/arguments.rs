//! Reading accepted values by name: the same for the arguments of a call and for the keys of an option map.

use rhai::{Array, Dynamic, FnPtr, INT, ImmutableString};

use super::kind::Kind;
use super::options::Options;
use super::parameter::Parameter;
use crate::geometry::Vec2;
use crate::script::messages::error::ScriptError;

/// The arguments of a call, checked against their parameters; what was left out holds its default, if it has one.
#[derive(Clone)]
pub struct Arguments {
    parameters: &'static [Parameter],
    values: Vec<Option<Dynamic>>,
}

impl Arguments {
    /// Pairs each parameter with its accepted value; `values` shorter than `parameters` are filled up.
    pub(super) fn new(parameters: &'static [Parameter], mut values: Vec<Option<Dynamic>>) -> Self {
        values.resize(parameters.len(), None);
        for (parameter, value) in parameters.iter().zip(&mut values) {
            if value.is_none() {
                *value = parameter.default_value();
            }
        }
        Self { parameters, values }
    }

    /// Whether the argument has a value, given or by default.
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_ok()
    }

    /// The names of the arguments that have a value.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let pairs = self.parameters.iter().zip(&self.values);
        pairs.filter(|(_, value)| value.is_some()).map(|(parameter, _)| parameter.name)
    }

    /// The parameter of this name.
    pub(super) fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// The argument as a number.
    pub fn number(&self, name: &str) -> Result<f64, ScriptError> {
        self.find(name)?.as_float().map_err(|held| wrong_read(name, held))
    }

    /// The argument as a number, if there is one.
    pub fn number_if_given(&self, name: &str) -> Option<f64> {
        self.number(name).ok()
    }

    /// The argument as a whole number.
    pub fn whole(&self, name: &str) -> Result<INT, ScriptError> {
        self.find(name)?.as_int().map_err(|held| wrong_read(name, held))
    }

    /// The argument as a whole number that counts something; its row must keep it from being negative.
    pub fn count(&self, name: &str) -> Result<usize, ScriptError> {
        usize::try_from(self.whole(name)?).map_err(|_| wrong_read(name, "a negative number"))
    }

    /// The argument as a text.
    pub fn text(&self, name: &str) -> Result<ImmutableString, ScriptError> {
        self.find(name)?.clone().into_immutable_string().map_err(|held| wrong_read(name, held))
    }

    /// A text, if there is one.
    ///
    /// # Errors
    /// When there is something else, which its row must exclude.
    pub fn text_if_given(&self, name: &str) -> Result<Option<String>, ScriptError> {
        self.has(name).then(|| self.text(name).map(String::from)).transpose()
    }

    /// The argument as a truth value.
    pub fn boolean(&self, name: &str) -> Result<bool, ScriptError> {
        self.find(name)?.as_bool().map_err(|held| wrong_read(name, held))
    }

    /// The argument as a point or vector.
    pub fn point(&self, name: &str) -> Result<Vec2, ScriptError> {
        self.get(name)
    }

    /// The argument as an array of anything.
    pub fn array(&self, name: &str) -> Result<Array, ScriptError> {
        self.get(name)
    }

    /// The argument as an array of numbers.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, ScriptError> {
        self.get(name)
    }

    /// The argument as an array of points.
    pub fn points(&self, name: &str) -> Result<Vec<Vec2>, ScriptError> {
        self.get(name)
    }

    /// The argument as a script function, to be called back with [`Call::invoke`](super::call::Call::invoke).
    pub fn callback(&self, name: &str) -> Result<FnPtr, ScriptError> {
        self.get(name)
    }

    /// The argument as a map of options.
    pub fn options(&self, name: &str) -> Result<Options, ScriptError> {
        self.get(name)
    }

    /// The argument as a map of options that may be left out: then all of its keys have their defaults.
    pub fn options_or_defaults(&self, name: &str) -> Result<Options, ScriptError> {
        match self.parameters.iter().find(|parameter| parameter.name == name) {
            Some(Parameter { kind: Kind::Options(keys), .. }) if !self.has(name) => {
                Ok(Options::defaults(keys))
            }
            _ => self.options(name),
        }
    }

    /// The argument as a value of a native type; handles are cloned, which is cheap.
    pub fn get<T: Clone + 'static>(&self, name: &str) -> Result<T, ScriptError> {
        self.find(name)?.clone().try_cast().ok_or_else(|| wrong_read(name, "another type"))
    }

    /// The argument as a value of a native type, if it is there and of that type: for parameters of either kind.
    pub fn get_if<T: Clone + 'static>(&self, name: &str) -> Option<T> {
        self.find(name).ok()?.clone().try_cast()
    }

    /// The argument as it was given.
    pub fn value(&self, name: &str) -> Result<Dynamic, ScriptError> {
        self.find(name).cloned()
    }

    fn find(&self, name: &str) -> Result<&Dynamic, ScriptError> {
        let index = self.parameters.iter().position(|parameter| parameter.name == name);
        index.and_then(|index| self.values.get(index)?.as_ref()).ok_or_else(|| {
            ScriptError::bug(format!("a body reads '{name}', which its row does not promise"))
        })
    }
}

/// A body and its row disagree: our mistake, not the script's.
fn wrong_read(name: &str, held: &str) -> ScriptError {
    ScriptError::bug(format!(
        "a body reads '{name}' as something else than its row says; it holds {held}"
    ))
}
