//! Types of parameter values, with their descriptions and ranges.

use std::any::TypeId;
use std::fmt;
use std::rc::Rc;

use rhai::{Dynamic, Engine};

use super::parameter::Parameter;
use super::parameter_variants::{self, ParameterSet};
use crate::script::messages::nouns::with_article;
use crate::script::messages::numbers::format_number;

/// Native type of the language.
pub trait Scripted: Clone + 'static {
    /// Name of the type in messages and help: one or two words.
    const NAME: &'static str;
    /// One-line description.
    const DOC: &'static str;
    /// Printed form of the value.
    fn show(&self) -> String;

    /// Summary of the value: at most about twelve labelled values.
    fn details(&self) -> Details {
        Details::new()
    }

    /// Value after an implicit conversion from another type; `None` if there is no such conversion.
    fn meant_by(_value: &Dynamic) -> Option<Self> {
        None
    }

    /// Parameters on which the value or its scene depends; `None` if there are none.
    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        None
    }

    /// Reason why the value must not be used, because a native call that uses it is running a script function; `None` if it may be used.
    fn is_busy(&self) -> Option<String> {
        None
    }
}

/// Labels and values that summarise a script value.
pub type Details = Vec<(String, String)>;

/// Descriptor of a [`Scripted`] type for binding tables.
#[derive(Clone, Copy)]
pub struct Type {
    name: &'static str,
    doc: &'static str,
    id: fn() -> TypeId,
    register: fn(&mut Engine),
    show: fn(&Dynamic) -> Option<String>,
    details: fn(&Dynamic) -> Option<Details>,
    busy: fn(&Dynamic) -> Option<String>,
    convert: fn(&Dynamic) -> Option<Dynamic>,
}

impl Type {
    /// Descriptor of the native type `T`.
    pub const fn of<T: Scripted>() -> Self {
        Self {
            name: T::NAME,
            doc: T::DOC,
            id: TypeId::of::<T>,
            register: register::<T>,
            show: |value| value.read_lock::<T>().map(|held| held.show()),
            details: |value| value.read_lock::<T>().map(|held| held.details()),
            busy: |value| value.read_lock::<T>().and_then(|value| value.is_busy()),
            convert: |value| T::meant_by(value).map(Dynamic::from),
        }
    }

    /// Name of the type in scripts.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// One-line description.
    pub const fn doc(&self) -> &'static str {
        self.doc
    }

    /// Identifier of the native type.
    pub fn id(&self) -> TypeId {
        (self.id)()
    }

    /// Returns the value if it is of this type, or its implicit conversion to this type; `None` otherwise.
    pub fn accept(&self, value: &Dynamic) -> Option<Dynamic> {
        if value.type_id() == self.id() { Some(value.clone()) } else { (self.convert)(value) }
    }

    /// Printed form of a value of this type.
    pub fn show(&self, value: &Dynamic) -> Option<String> {
        (self.show)(value)
    }

    /// Summary of a value of this type.
    pub fn details(&self, value: &Dynamic) -> Option<Details> {
        (self.details)(value)
    }

    /// Function that returns the reason why a value of this type must not be used; `None` if it may be used.
    pub fn busy(&self) -> fn(&Dynamic) -> Option<String> {
        self.busy
    }

    /// Registers the name and the printed form of the type in the engine.
    pub fn register(&self, engine: &mut Engine) {
        (self.register)(engine);
    }
}

fn register<T: Scripted>(engine: &mut Engine) {
    engine.register_type_with_name::<T>(T::NAME);
    parameter_variants::register_type(TypeId::of::<T>(), T::NAME, |value| {
        value.read_lock::<T>().and_then(|of| of.parameter_set())
    });
    for name in ["to_string", "to_debug"] {
        engine.register_fn(name, |value: &mut T| value.show());
    }
}

/// Type of the value of a parameter.
#[derive(Clone, Copy)]
pub enum Kind {
    /// Number; integers are accepted.
    Number(NumberRange),
    /// Any number, including infinity and NaN; integers stay integers.
    Numeric,
    /// Integer; a number without a fractional part, such as `3.0`, is accepted.
    Integer(NumberRange),
    /// Text.
    Text,
    /// Text that is a name, which can be shown in tables and typed by users.
    Name,
    /// One of the given texts.
    Choice(&'static [&'static str]),
    /// The value `true` or `false`.
    Boolean,
    /// Vector or array `[x, y]`.
    Point,
    /// Array of values of any type.
    Array,
    /// Array of finite numbers.
    Numbers,
    /// Array of points.
    Points,
    /// Function or closure.
    Function,
    /// Map of options with the given keys.
    Options(&'static [Parameter]),
    /// Value of the given native type.
    Object(Type),
    /// Value of one of the given types, which are tried in order.
    Either(&'static [Kind]),
    /// Any value.
    Any,
}

/// Allowed range of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NumberRange {
    /// Any finite number.
    Finite,
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NonNegative,
    /// Range from the first to the second number, including both.
    Between(f64, f64),
    /// All numbers, including infinity and NaN.
    Unlimited,
}

impl NumberRange {
    /// Returns true if `x` is in the range.
    pub fn contains(self, x: f64) -> bool {
        let bounded = match self {
            Self::Unlimited => return true,
            Self::Finite => true,
            Self::Positive => x > 0.0,
            Self::NonNegative => x >= 0.0,
            Self::Between(least, most) => (least..=most).contains(&x),
        };
        x.is_finite() && bounded
    }

    fn phrase(self, noun: &str) -> String {
        match self {
            Self::Finite | Self::Unlimited => format!("a {noun}"),
            Self::Positive => format!("a positive {noun}"),
            Self::NonNegative => format!("a {noun} of zero or more"),
            Self::Between(least, most) => {
                format!("a {noun} from {} to {}", format_number(least), format_number(most))
            }
        }
    }
}

impl Kind {
    /// Returns true if the type requires integers.
    pub fn is_of_whole_numbers(&self) -> bool {
        match self {
            Self::Integer(_) => true,
            Self::Either(kinds) => {
                let of_any = |kind: &Self| matches!(kind, Self::Number(_) | Self::Numeric);
                kinds.iter().any(Self::is_of_whole_numbers) && !kinds.iter().any(of_any)
            }
            _ => false,
        }
    }

    /// Returns true if values of the type with this display name may be accepted.
    pub fn takes(&self, type_name: &str) -> bool {
        match self {
            Self::Number(_) | Self::Integer(_) | Self::Numeric => {
                matches!(type_name, "number" | "whole number")
            }
            Self::Text | Self::Name | Self::Choice(_) => type_name == "text",
            Self::Boolean => type_name == "truth value",
            Self::Point => matches!(type_name, "vector" | "array"),
            Self::Array | Self::Numbers | Self::Points => type_name == "array",
            Self::Function => type_name == "function",
            Self::Options(_) => type_name == "map",
            Self::Object(of) => of.name() == type_name,
            Self::Either(kinds) => kinds.iter().any(|kind| kind.takes(type_name)),
            Self::Any => true,
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(range) => f.write_str(&range.phrase("number")),
            Self::Integer(range) => f.write_str(&range.phrase("whole number")),
            Self::Numeric => f.write_str("a number"),
            Self::Text | Self::Name => f.write_str("a text"),
            Self::Choice(allowed) => {
                let quoted: Vec<_> = allowed.iter().map(|text| format!("\"{text}\"")).collect();
                write!(f, "one of {}", quoted.join(", "))
            }
            Self::Boolean => f.write_str("true or false"),
            Self::Point => f.write_str("a point [x, y]"),
            Self::Array => f.write_str("an array"),
            Self::Numbers => f.write_str("an array of numbers"),
            Self::Points => f.write_str("an array of points [x, y]"),
            Self::Function => f.write_str("a function such as |t| 2 * t"),
            Self::Options(_) => f.write_str("a map of options #{ … }"),
            Self::Object(of) => f.write_str(&with_article(of.name())),
            Self::Either(kinds) => {
                let words: Vec<_> = kinds.iter().map(Kind::to_string).collect();
                f.write_str(&words.join(" or "))
            }
            Self::Any => f.write_str("a value"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn number_ranges_reject_nonfinite_values() {
        for range in [NumberRange::Finite, NumberRange::Positive, NumberRange::NonNegative] {
            assert!(!range.contains(f64::NAN) && !range.contains(f64::INFINITY), "{range:?}");
        }
        assert!(NumberRange::Unlimited.contains(f64::NAN));
        assert!(NumberRange::Between(0.0, 1.0).contains(1.0));
        assert!(!NumberRange::Positive.contains(0.0));
    }
}
