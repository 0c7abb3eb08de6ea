//! Evaluation of a call for all variants of its arguments.

use std::rc::Rc;

use rhai::{Dynamic, FnPtr, Map};

use super::gather::combine_variants;
use super::nonsmooth::corner_of;
use super::parameter_set::{ParameterSet, VariantGuard, of_thing, present, take_unavailable};
use super::policy::Lifting;
use super::variant_value::{VariantValue, parameter_set_of, project, unavailable_reason_in};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{CallSyntax, FunctionBinding};
use crate::script::messages::error::{CallPart, ScriptError};

/// Hint for an error that occurs only at a perturbed value of a parameter.
const BESIDE: &str = "derivatives are computed from values on both sides of a parameter: choose it inside the \
    allowed range, or use value_of(x) here, which has no derivatives";

type Make<'m> = &'m mut dyn FnMut(Option<&mut Dynamic>, &[Dynamic]) -> Result<Dynamic, ScriptError>;

/// Evaluates a binding for all variants of its receiver and arguments, or only once, depending on `lifting`, the rule for its domain.
///
/// # Errors
/// Fails if the call fails, if derivatives would be lost, or if parameters of two scenes are combined.
pub fn evaluate_variants(
    (row, lifting): (&FunctionBinding, Lifting),
    mut receiver: Option<&mut Dynamic>,
    (parameters, given): (&[Parameter], Vec<Dynamic>),
    make: Make<'_>,
) -> Result<Dynamic, ScriptError> {
    if let Some(present) = present() {
        return evaluate_at(present.variant, receiver, &given, make);
    }
    let Some(family) = families(receiver.as_deref(), &given)? else {
        return make(receiver, &given);
    };
    let depends = given.iter().position(|of| parameter_set_of(of).is_some());
    match (lifting, depends) {
        (Lifting::Each, _) => expect_plain_whole_numbers(row, parameters, &given)?,
        (Lifting::Once, Some(_)) if row.receiver().is_none() && is_about_derivatives(row) => {
            return make(receiver, &given);
        }
        (Lifting::Once, Some(number)) => {
            return Err(refusal(row, parameters.get(number), &given[number], number));
        }
        (Lifting::AtValues, _) | (Lifting::Once, None) => {
            return evaluate_at(0, receiver, &given, make);
        }
        (Lifting::Refused, _) => {
            let message = format!("{} does not support parameters of a scene", row.name);
            let hint = "build the scene twice with plain numbers in place of scene.parameter(…), and \
                take the difference";
            return Err(ScriptError::new(message).hint(hint));
        }
    }
    family.use_variants();
    let is_set = matches!(row.form, CallSyntax::Property(_)) && !given.is_empty();
    let is_thing = |value: &Dynamic| !value.is::<VariantValue>() && of_thing(value).is_some();
    let mut lost = given.iter().chain(receiver.as_deref()).find_map(unavailable_reason_in);
    let _: Option<Rc<str>> = take_unavailable();
    let mut at = |variant: usize| {
        let _within = VariantGuard::of(&family, variant);
        let given: Vec<Dynamic> = given.iter().map(|of| project(of, variant)).collect();
        match &mut receiver {
            Some(held) if is_thing(held) => make(Some(held), &given),
            Some(held) => {
                let mut own = project(held, variant);
                let made = make(Some(&mut own), &given)?;
                Ok(if is_set { own } else { made })
            }
            None => make(None, &given),
        }
    };
    let mut results = Vec::with_capacity(family.variants());
    for variant in (0..family.variants()).rev() {
        match at(variant) {
            Ok(made) => results.push(made),
            Err(error) if variant == 0 => return Err(error),
            Err(beside) => {
                return Err(at(0).err().unwrap_or(beside.with_variant_context(&family, variant)));
            }
        }
    }
    results.reverse();
    let corner = || corner_of((row.name, row.corner?), &family, &given);
    lost = lost.or_else(take_unavailable).or_else(corner);
    let found = combine_variants(&family, &results, lost.as_ref(), &is_thing)?;
    match receiver {
        Some(held) if is_set && !is_thing(held) => {
            *held = found;
            Ok(Dynamic::UNIT)
        }
        _ => Ok(found),
    }
}

fn evaluate_at(
    variant: usize,
    receiver: Option<&mut Dynamic>,
    given: &[Dynamic],
    make: Make<'_>,
) -> Result<Dynamic, ScriptError> {
    let given: Vec<Dynamic> = given.iter().map(|of| project(of, variant)).collect();
    match receiver {
        Some(held) if held.is::<VariantValue>() => make(Some(&mut project(held, variant)), &given),
        receiver => make(receiver, &given),
    }
}

/// Rejects a value that depends on parameters if an integer is required, because integers have no derivative.
fn expect_plain_whole_numbers(
    row: &FunctionBinding,
    parameters: &[Parameter],
    given: &[Dynamic],
) -> Result<(), ScriptError> {
    let is_wrong = |(parameter, value): &(&Parameter, &Dynamic)| {
        value.is::<VariantValue>() && parameter.kind.is_of_whole_numbers()
    };
    let pairs = parameters.iter().zip(given);
    match pairs.enumerate().find(|(_, pair)| is_wrong(pair)) {
        None => Ok(()),
        Some((number, (parameter, _))) => {
            let message = format!(
                "{}: '{}' is a whole number, and cannot depend on a parameter of a scene",
                row.name, parameter.name
            );
            let hint = "int(x) and round(x) return a whole number without derivatives";
            Err(ScriptError::new(message).hint(hint).at(CallPart::Argument(number)))
        }
    }
}

/// Error for an argument, or an option in it, that must not depend on parameters.
fn refusal(
    row: &FunctionBinding,
    parameter: Option<&Parameter>,
    given: &Dynamic,
    number: usize,
) -> ScriptError {
    let (name, value, place) = match option_in(given) {
        Some((key, value)) => (key.clone(), value, CallPart::Key(key)),
        None => {
            let name = parameter.map_or("", |of| of.name).to_owned();
            (name, given.clone(), CallPart::Argument(number))
        }
    };
    let message = format!("{}: '{name}' may not depend on parameters of a scene", row.name);
    let hint = match value.is::<FnPtr>() {
        true => {
            "the function uses a variable from outside that depends on a parameter: let plain = \
            value_of(x); before it is the number without derivatives"
        }
        false => "value_of(x) is the number without its derivatives",
    };
    ScriptError::new(message).hint(hint).at(place)
}

fn option_in(options: &Dynamic) -> Option<(String, Dynamic)> {
    let map = options.read_lock::<Map>()?;
    let (key, value) = map.iter().find(|(_, of)| parameter_set_of(of).is_some())?;
    option_in(value).or_else(|| Some((key.to_string(), value.clone())))
}

impl ScriptError {
    fn with_variant_context(self, family: &ParameterSet, variant: usize) -> Self {
        match self {
            Self::Failure(mut failure) => {
                let at = family.describe(variant);
                failure.message = format!("{} (with {at}, for the derivatives)", failure.message);
                failure.hint = Some(BESIDE.to_owned());
                Self::Failure(failure)
            }
            other => other,
        }
    }
}

fn is_about_derivatives(row: &FunctionBinding) -> bool {
    row.parameters.first().is_some_and(|of| matches!(of.kind, Kind::Any))
}

fn families(
    receiver: Option<&Dynamic>,
    given: &[Dynamic],
) -> Result<Option<Rc<ParameterSet>>, ScriptError> {
    let values: Vec<&Dynamic> = receiver.into_iter().chain(given).collect();
    ParameterSet::common(&values)
}

impl ParameterSet {
    /// Common parameter set of several values; `None` if no value depends on a parameter.
    ///
    /// # Errors
    /// Fails if the values depend on parameters of two scenes.
    pub fn common(values: &[&Dynamic]) -> Result<Option<Rc<Self>>, ScriptError> {
        let own = |value: &&Dynamic| parameter_set_of(value).or_else(|| of_thing(value));
        let mut found: Option<Rc<Self>> = None;
        for family in values.iter().filter_map(own) {
            match &found {
                Some(known) if !Rc::ptr_eq(known, &family) => {
                    let names = [known, &family].map(|of| {
                        let names =
                            of.parameters().into_iter().map(|(name, _)| format!("'{name}'"));
                        names.collect::<Vec<_>>().join(", ")
                    });
                    let message = format!(
                        "parameters of two scenes are combined: {} and {}",
                        names[0], names[1]
                    );
                    let hint = "use value_of(x) for the one whose derivatives are not required";
                    return Err(ScriptError::new(message).hint(hint));
                }
                _ => found = Some(family),
            }
        }
        Ok(found)
    }
}

/// Combines the results of all variants, which were computed from the values `from`.
///
/// # Errors
/// Fails if arrays have different lengths in the variants, or maps different keys.
pub fn combined(
    family: &Rc<ParameterSet>,
    results: &[Dynamic],
    from: &[&Dynamic],
) -> Result<Dynamic, ScriptError> {
    family.use_variants();
    let lost = from.iter().find_map(|value| unavailable_reason_in(value));
    combine_variants(family, results, lost.as_ref(), &|_| false)
}

/// Combines the results of all variants to one value without derivatives, which stores the reason why they are missing.
///
/// # Errors
/// Fails if arrays have different lengths in the variants, or maps different keys.
pub fn combined_without_derivatives(
    family: &Rc<ParameterSet>,
    results: &[Dynamic],
    reason: Rc<str>,
) -> Result<Dynamic, ScriptError> {
    family.use_variants();
    combine_variants(family, results, Some(&reason), &|_| false)
}
