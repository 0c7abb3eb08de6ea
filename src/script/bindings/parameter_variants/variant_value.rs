//! Values that depend on parameters of a scene.

use std::rc::Rc;

use rhai::{Array, Dynamic, FnPtr, Map};

use super::parameter_set::{ParameterSet, name_of, present_variant};
use crate::geometry::Vec2;
use crate::output::significant;
use crate::script::bindings::kind::Scripted;
use crate::script::messages::error::ScriptError;
use crate::script::messages::nouns::with_article;
use crate::script::messages::numbers::{as_number, format_number};

const DIGITS: usize = 5;

#[derive(Clone)]
pub struct VariantValue {
    family: Rc<ParameterSet>,
    values: Rc<[Dynamic]>,
    lost: Option<Rc<str>>,
}

impl VariantValue {
    pub fn new(family: &Rc<ParameterSet>, values: Vec<Dynamic>, lost: Option<Rc<str>>) -> Self {
        Self { family: Rc::clone(family), values: values.into(), lost }
    }

    /// Value in the given variant. Elements of arrays and maps, and values captured by closures, are also replaced by their values in this variant.
    pub fn project(value: &Dynamic, variant: usize) -> Dynamic {
        project(value, variant)
    }

    pub fn number(value: &Dynamic) -> Option<f64> {
        as_number(value).or_else(|| as_number(&value.read_lock::<Self>()?.at(present_variant())))
    }

    pub fn parameter_set_of(value: &Dynamic) -> Option<Rc<ParameterSet>> {
        parameter_set_of(value)
    }

    pub fn parameter_set(&self) -> &Rc<ParameterSet> {
        &self.family
    }

    pub(super) fn unavailable_reason(&self) -> Option<&Rc<str>> {
        self.lost.as_ref()
    }

    pub fn at(&self, variant: usize) -> Dynamic {
        self.values.get(variant).unwrap_or(&self.values[0]).clone()
    }

    /// Derivative of the value with respect to the parameter with this index; NaN if the parameter does not exist.
    ///
    /// # Errors
    /// Fails if the value is neither a number nor a vector, or is not differentiable.
    pub fn derivative(&self, parameter: usize) -> Result<Dynamic, ScriptError> {
        if let Some(reason) = &self.lost {
            return Err(ScriptError::new(reason.to_string()));
        }
        let distance = self.family.distance(parameter).unwrap_or(f64::NAN);
        let [plus, minus] = [self.at(1 + 2 * parameter), self.at(2 + 2 * parameter)];
        let per_unit = 0.5 / distance;
        if let (Some(plus), Some(minus)) = (as_number(&plus), as_number(&minus)) {
            return Ok(Dynamic::from((plus - minus) * per_unit));
        }
        let vector = |value: &Dynamic| value.read_lock::<Vec2>().map(|held| *held);
        match (vector(&plus), vector(&minus)) {
            (Some(plus), Some(minus)) => Ok(Dynamic::from((plus - minus) * per_unit)),
            _ => Err(ScriptError::new("derivatives exist only of numbers and vectors")),
        }
    }
}

/// Parameters on which a value depends, also through elements of arrays and maps, and through captured values.
pub fn parameter_set_of(value: &Dynamic) -> Option<Rc<ParameterSet>> {
    find(value, &|varied| Some(Rc::clone(&varied.family)))
}

/// Reason why a value, one of its elements or a captured value has no derivatives; `None` if all derivatives exist.
pub fn unavailable_reason_in(value: &Dynamic) -> Option<Rc<str>> {
    find(value, &|varied| varied.unavailable_reason().cloned())
}

fn find<T>(value: &Dynamic, what: &dyn Fn(&VariantValue) -> Option<T>) -> Option<T> {
    if value.is_float() || value.is_int() || value.is_string() || value.is_bool() {
        return None;
    }
    if let Some(varied) = value.read_lock::<VariantValue>() {
        return what(&varied);
    }
    if let Some(array) = value.read_lock::<Array>() {
        return array.iter().find_map(|element| find(element, what));
    }
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().find_map(|element| find(element, what));
    }
    let function = value.read_lock::<FnPtr>()?;
    function.curry().iter().find_map(|captured| find(captured, what))
}

pub fn project(value: &Dynamic, variant: usize) -> Dynamic {
    if let Some(varied) = value.read_lock::<VariantValue>() {
        return varied.at(variant);
    }
    if parameter_set_of(value).is_none() {
        return value.clone();
    }
    if let Some(array) = value.read_lock::<Array>() {
        return array.iter().map(|element| project(element, variant)).collect::<Array>().into();
    }
    if let Some(map) = value.read_lock::<Map>() {
        let pairs = map.iter().map(|(key, element)| (key.clone(), project(element, variant)));
        return pairs.collect::<Map>().into();
    }
    match value.read_lock::<FnPtr>() {
        Some(function) => {
            let mut own = function.clone();
            for captured in own.iter_curry_mut() {
                if parameter_set_of(captured).is_some() {
                    *captured = project(captured, variant);
                }
            }
            own.into()
        }
        None => value.clone(),
    }
}

impl Scripted for VariantValue {
    const NAME: &'static str = "value with derivatives";
    const DOC: &'static str =
        "A number, a vector or a section that depends on parameters of a scene.";

    fn show(&self) -> String {
        let number = |value: &Dynamic| as_number(value).map(format_number);
        let vector = |value: &Dynamic| value.read_lock::<Vec2>().map(|held| held.show());
        let value = &self.values[0];
        let shown = number(value).or_else(|| vector(value));
        let shown = shown.unwrap_or_else(|| with_article(name_of(value).unwrap_or("value")));
        if self.lost.is_some() {
            return shown;
        }
        let by = |(at, (name, _)): (usize, (String, f64))| {
            let derivative = self.derivative(at).ok()?;
            let shown = match as_number(&derivative) {
                Some(number) => significant(number, DIGITS),
                None => vector(&derivative)?,
            };
            Some(format!("d/d{name} {shown}"))
        };
        let all: Vec<String> =
            self.family.parameters().into_iter().enumerate().filter_map(by).collect();
        match all.is_empty() {
            true => format!("{shown}, which depends on parameters"),
            false => format!("{shown} ({})", all.join(", ")),
        }
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        Some(Rc::clone(&self.family))
    }
}
