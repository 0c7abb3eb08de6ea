//! Values that can be sent to other threads: plain values, script functions, and serialised values of the types in [`DataKind`].

use std::rc::Rc;

use rhai::{Array, Dynamic, Engine, FnPtr, INT, ImmutableString, Map};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::beams::{Mesh, Relaxation, SectionVariation, Solid};
use crate::geometry::{Curve, KnotVector, Vec2};
use crate::integrators::Method;
use crate::loads::Schedule;
use crate::script::handles::section::SectionHandle;
use crate::simulation::StepControl;

#[derive(Clone, Debug)]
pub enum Portable {
    Nothing,
    Boolean(bool),
    Integer(INT),
    Number(f64),
    Character(char),
    Text(String),
    Vector(Vec2),
    Array(Vec<Self>),
    Map(Vec<(String, Self)>),
    Function(String, usize, Vec<Self>),
    Data(DataKind, Vec<u8>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataKind {
    Section,
    Mesh,
    Curve,
    Knots,
    Method,
    Control,
    Schedule,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotPortable {
    pub kind: String,
}

type Stored = (SectionVariation, Option<Solid>, Option<Relaxation>);

impl Portable {
    /// Converts a value. `parameters_of` returns the number of parameters of a script function, including captured variables.
    pub fn of(
        engine: &Engine,
        value: &Dynamic,
        parameters_of: &dyn Fn(&FnPtr) -> Option<usize>,
    ) -> Result<Self, NotPortable> {
        let value = value.flatten_clone();
        let inner = |value: &Dynamic| Self::of(engine, value, parameters_of);
        if value.is_unit() {
            return Ok(Self::Nothing);
        }
        if let Ok(truth) = value.as_bool() {
            return Ok(Self::Boolean(truth));
        }
        if let Ok(whole) = value.as_int() {
            return Ok(Self::Integer(whole));
        }
        if let Ok(number) = value.as_float() {
            return Ok(Self::Number(number));
        }
        if let Ok(letter) = value.as_char() {
            return Ok(Self::Character(letter));
        }
        if let Ok(text) = value.as_immutable_string_ref() {
            return Ok(Self::Text(text.to_string()));
        }
        if let Some(array) = value.read_lock::<Array>() {
            return array.iter().map(inner).collect::<Result<_, _>>().map(Self::Array);
        }
        if let Some(map) = value.read_lock::<Map>() {
            let pair = |(name, value): (&rhai::Identifier, &Dynamic)| {
                Ok((name.to_string(), inner(value)?))
            };
            return map.iter().map(pair).collect::<Result<_, _>>().map(Self::Map);
        }
        if let Some(vector) = value.read_lock::<Vec2>() {
            return Ok(Self::Vector(*vector));
        }
        if let Some(function) = value.read_lock::<FnPtr>()
            && let Some(parameters) = parameters_of(&function)
        {
            let captured = function.curry().iter().map(inner).collect::<Result<_, _>>()?;
            return Ok(Self::Function(function.fn_name().to_owned(), parameters, captured));
        }
        data(&value)
            .map(|(kind, bytes)| Self::Data(kind, bytes))
            .ok_or_else(|| NotPortable { kind: engine.map_type_name(value.type_name()).to_owned() })
    }

    /// Restores the value on this thread; `None` if `function_of` does not find a function by name and number of parameters.
    pub fn value(&self, function_of: &dyn Fn(&str, usize) -> Option<FnPtr>) -> Option<Dynamic> {
        let all = |values: &[Self]| -> Option<Vec<Dynamic>> {
            values.iter().map(|value| value.value(function_of)).collect()
        };
        Some(match self {
            Self::Nothing => Dynamic::UNIT,
            Self::Boolean(truth) => (*truth).into(),
            Self::Integer(whole) => (*whole).into(),
            Self::Number(number) => (*number).into(),
            Self::Character(letter) => (*letter).into(),
            Self::Text(text) => ImmutableString::from(text).into(),
            Self::Vector(vector) => Dynamic::from(*vector),
            Self::Array(values) => all(values)?.into(),
            Self::Map(pairs) => {
                let pair = |(name, value): &(String, Self)| {
                    Some((name.as_str().into(), value.value(function_of)?))
                };
                pairs.iter().map(pair).collect::<Option<Map>>()?.into()
            }
            Self::Function(name, parameters, captured) => {
                let mut function = function_of(name, *parameters)?;
                function.extend(all(captured)?);
                function.into()
            }
            Self::Data(kind, bytes) => kind.value(bytes)?,
        })
    }

    pub fn is(&self, value: &Dynamic) -> bool {
        let value = value.flatten_clone();
        match self {
            Self::Nothing => value.is_unit(),
            Self::Boolean(truth) => value.as_bool() == Ok(*truth),
            Self::Integer(whole) => value.as_int() == Ok(*whole),
            Self::Number(number) => value.as_float().is_ok_and(|x| x.to_bits() == number.to_bits()),
            Self::Character(letter) => value.as_char() == Ok(*letter),
            Self::Text(text) => value.as_immutable_string_ref().is_ok_and(|held| *held == **text),
            Self::Vector(vector) => value.read_lock::<Vec2>().is_some_and(|held| *held == *vector),
            Self::Array(values) => value.read_lock::<Array>().is_some_and(|held| {
                held.len() == values.len() && values.iter().zip(held.iter()).all(|(a, b)| a.is(b))
            }),
            Self::Map(pairs) => value.read_lock::<Map>().is_some_and(|held| {
                let same = |(name, value): &(String, Self)| {
                    held.get(name.as_str()).is_some_and(|held| value.is(held))
                };
                held.len() == pairs.len() && pairs.iter().all(same)
            }),
            Self::Function(name, ..) => {
                value.read_lock::<FnPtr>().is_some_and(|held| held.fn_name() == name)
            }
            Self::Data(kind, bytes) => {
                data(&value).is_some_and(|held| held == (*kind, bytes.clone()))
            }
        }
    }

    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Boolean(truth) => Some(f64::from(u8::from(*truth))),
            Self::Integer(whole) => Some(*whole as f64),
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}

fn stored<T: Serialize>(value: &T) -> Option<Vec<u8>> {
    postcard::to_stdvec(value).ok()
}

fn data(value: &Dynamic) -> Option<(DataKind, Vec<u8>)> {
    if let Some(SectionHandle { variation, solid, relaxation }) = value.read_lock().as_deref() {
        return Some((DataKind::Section, stored(&(variation, solid, relaxation))?));
    }
    if let Some(mesh) = value.read_lock::<Mesh>() {
        return Some((DataKind::Mesh, stored(&*mesh)?));
    }
    if let Some(curve) = value.read_lock::<Rc<Curve>>() {
        return Some((DataKind::Curve, stored(&**curve)?));
    }
    if let Some(knots) = value.read_lock::<Rc<KnotVector>>() {
        return Some((DataKind::Knots, stored(&**knots)?));
    }
    if let Some(method) = value.read_lock::<Method>() {
        return Some((DataKind::Method, stored(&*method)?));
    }
    if let Some(control) = value.read_lock::<StepControl>() {
        return Some((DataKind::Control, stored(&*control)?));
    }
    let schedule = value.read_lock::<Schedule>()?;
    schedule
        .can_be_stored()
        .then(|| stored(&*schedule))
        .flatten()
        .map(|bytes| (DataKind::Schedule, bytes))
}

impl DataKind {
    fn value(self, bytes: &[u8]) -> Option<Dynamic> {
        fn read<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
            postcard::from_bytes(bytes).ok()
        }
        Some(match self {
            Self::Section => {
                let (variation, solid, relaxation) = read::<Stored>(bytes)?;
                Dynamic::from(SectionHandle { variation, solid, relaxation })
            }
            Self::Mesh => Dynamic::from(read::<Mesh>(bytes)?),
            Self::Curve => Dynamic::from(Rc::new(read::<Curve>(bytes)?)),
            Self::Knots => Dynamic::from(Rc::new(read::<KnotVector>(bytes)?)),
            Self::Method => Dynamic::from(read::<Method>(bytes)?),
            Self::Control => Dynamic::from(read::<StepControl>(bytes)?),
            Self::Schedule => Dynamic::from(read::<Schedule>(bytes)?),
        })
    }
}
