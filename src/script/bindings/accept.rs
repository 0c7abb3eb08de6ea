//! Conversion of script values to the type that a parameter requires.

use rhai::{Array, Dynamic, Engine, FnPtr, Map};

use super::kind::Kind;
use super::options::Options;
use super::parameter::Parameter;
use super::type_hints;
use crate::geometry::Vec2;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::nouns::type_word;
use crate::script::messages::numbers::{as_integer, as_number, describe};
use crate::system::refusal_of_name;

/// Converts a value to the form that native functions read: numbers become `f64`, points [`Vec2`], and option maps [`Options`].
///
/// `owner` is the function or option map that error messages name.
pub fn accept(
    engine: &Engine,
    owner: &str,
    parameter: &Parameter,
    value: Dynamic,
) -> Result<Dynamic, ScriptError> {
    match convert(engine, owner, &parameter.kind, value)? {
        Ok(accepted) => Ok(accepted),
        Err(refused) => {
            let Parameter { name, kind, .. } = parameter;
            Err(refusal(engine, owner, name, kind, &parameter.expectation(), &refused))
        }
    }
}

pub fn accept_described(
    engine: &Engine,
    owner: &str,
    name: &str,
    (kind, wanted): (&Kind, &str),
    value: Dynamic,
) -> Result<Dynamic, ScriptError> {
    convert(engine, owner, kind, value)?
        .map_err(|refused| refusal(engine, owner, name, kind, wanted, &refused))
}

/// Result of a conversion. An outer `Err` is reported unchanged.
/// An inner `Err` is the value of a wrong type, for which the general error message is created.
type Conversion = Result<Result<Dynamic, Dynamic>, ScriptError>;

fn convert(engine: &Engine, owner: &str, kind: &Kind, value: Dynamic) -> Conversion {
    let accepted = match kind {
        Kind::Any => Some(value.clone()),
        Kind::Number(range) => as_number(&value).filter(|x| range.contains(*x)).map(Dynamic::from),
        Kind::Integer(range) => {
            as_integer(&value).filter(|n| range.contains(*n as f64)).map(Dynamic::from)
        }
        Kind::Numeric => as_number(&value).is_some().then(|| value.clone()),
        Kind::Text => value.is_string().then(|| value.clone()),
        Kind::Name => match value.as_immutable_string_ref() {
            Ok(name) => Some(readable(owner, &name)?.into()),
            Err(_) => None,
        },
        Kind::Choice(allowed) => {
            let known =
                value.as_immutable_string_ref().is_ok_and(|text| allowed.contains(&text.as_str()));
            known.then(|| value.clone())
        }
        Kind::Boolean => value.is_bool().then(|| value.clone()),
        Kind::Point => as_point(&value).map(Dynamic::from),
        Kind::Array => value.is_array().then(|| value.clone()),
        Kind::Numbers => {
            as_all(&value, |x| as_number(x).filter(|x| x.is_finite())).map(Dynamic::from)
        }
        Kind::Points => as_all(&value, as_point).map(Dynamic::from),
        Kind::Function => value.is::<FnPtr>().then(|| value.clone()),
        Kind::Object(of) => of.accept(&value),
        Kind::Options(keys) => match value.read_lock::<Map>() {
            Some(map) => Some(Dynamic::from(Options::read(engine, owner, keys, &map)?)),
            None => None,
        },
        Kind::Either(kinds) => {
            let mut rest = value;
            for kind in *kinds {
                match convert(engine, owner, kind, rest)? {
                    Ok(accepted) => return Ok(Ok(accepted)),
                    Err(refused) => rest = refused,
                }
            }
            return Ok(Err(rest));
        }
    };
    Ok(accepted.ok_or(value))
}

pub fn readable(owner: &str, name: &str) -> Result<String, ScriptError> {
    match refusal_of_name(name) {
        None => Ok(name.to_owned()),
        Some(why) => Err(ScriptError::new(format!("{owner}: {name:?} is not a valid name: {why}"))
            .hint("use letters, numbers and spaces")),
    }
}

/// Point from a vector or from an array of two finite numbers; `None` for other values.
pub fn as_point(value: &Dynamic) -> Option<Vec2> {
    let point = match value.read_lock::<Vec2>() {
        Some(vector) => *vector,
        None => match value.read_lock::<Array>()?.as_slice() {
            [x, y] => Vec2::new(as_number(x)?, as_number(y)?),
            _ => return None,
        },
    };
    (point.x.is_finite() && point.y.is_finite()).then_some(point)
}

fn as_all<T>(value: &Dynamic, read: impl Fn(&Dynamic) -> Option<T>) -> Option<Vec<T>> {
    value.read_lock::<Array>()?.iter().map(read).collect()
}

fn refusal(
    engine: &Engine,
    owner: &str,
    name: &str,
    kind: &Kind,
    wanted: &str,
    value: &Dynamic,
) -> ScriptError {
    let got = match first_wrong_element(kind, value) {
        Some((index, element)) => format!("{} at index {index}", describe(engine, &element)),
        None if is_infinite_or_nan(value) => {
            format!("{}, which is not finite", describe(engine, value))
        }
        None => describe(engine, value),
    };
    let error = ScriptError::new(format!("{owner}: '{name}' must be {wanted}, got {got}"));
    let given = type_word(engine.map_type_name(value.type_name()));
    match type_hints::hint(kind, value, given) {
        Some(hint) => error.hint(hint),
        None => error,
    }
}

fn first_wrong_element(kind: &Kind, value: &Dynamic) -> Option<(usize, Dynamic)> {
    let array = value.read_lock::<Array>()?;
    let wrong = |element: &Dynamic| match kind {
        Kind::Numbers | Kind::Point => !as_number(element).is_some_and(f64::is_finite),
        Kind::Points => as_point(element).is_none(),
        _ => false,
    };
    array
        .iter()
        .enumerate()
        .find(|(_, element)| wrong(element))
        .map(|(index, element)| (index, element.clone()))
}

fn is_infinite_or_nan(value: &Dynamic) -> bool {
    as_number(value).is_some_and(|x| !x.is_finite())
}

/// Sets the position of an error to the argument `number`, unless the error already refers to an argument or a key.
pub fn at_argument(error: ScriptError, number: usize) -> ScriptError {
    match error {
        ScriptError::Failure(failure) if failure.place == CallPart::Call => {
            ScriptError::Failure(failure).at(CallPart::Argument(number))
        }
        other => other,
    }
}
