//! What a parameter may be: the kinds of values, their words in messages, their ranges.

use std::any::TypeId;
use std::fmt;
use std::rc::Rc;

use rhai::{Dynamic, Engine};

use super::parameter::Parameter;
use super::parameter_variants::{self, ParameterSet};
use crate::script::messages::nouns::with_article;

/// A native type that scripts can hold.
pub trait Scripted: Clone + 'static {
    /// The name of the type in messages and help: one or two words.
    const NAME: &'static str;
    /// One line on what the type is.
    const DOC: &'static str;
    /// The printed form of the value.
    fn show(&self) -> String;

    /// What a person wants to know of the value at a glance besides: labels and values, at most a dozen.
    fn details(&self) -> Details {
        Details::new()
    }

    /// What a value of another type stands for where one of this type is asked for, if for any.
    fn meant_by(_value: &Dynamic) -> Option<Self> {
        None
    }

    /// The parameters that the value depends on, or the scene that it is a thing of, if any.
    fn family(&self) -> Option<Rc<ParameterSet>> {
        None
    }

    /// Why the value cannot be used now, if so: a native call that calls a script function back may be at work on it.
    fn is_busy(&self) -> Option<String> {
        None
    }
}

/// The details of a value of a script: labels and values, set as aligned lines.
pub type Details = Vec<(String, String)>;

/// A [`Scripted`] type as a value, for rows of tables.
#[derive(Clone, Copy)]
pub struct Type {
    name: &'static str,
    doc: &'static str,
    id: fn() -> TypeId,
    register: fn(&mut Engine),
    show: fn(&Dynamic) -> Option<String>,
    details: fn(&Dynamic) -> Option<Details>,
    busy: fn(&Dynamic) -> Option<String>,
    meant: fn(&Dynamic) -> Option<Dynamic>,
}

impl Type {
    /// The native type `T` as a type of the language.
    pub const fn of<T: Scripted>() -> Self {
        Self {
            name: T::NAME,
            doc: T::DOC,
            id: TypeId::of::<T>,
            register: register::<T>,
            show: |value| value.read_lock::<T>().map(|held| held.show()),
            details: |value| value.read_lock::<T>().map(|held| held.details()),
            busy: |value| value.read_lock::<T>().and_then(|value| value.is_busy()),
            meant: |value| T::meant_by(value).map(Dynamic::from),
        }
    }

    /// The name of the type in scripts.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// One line on what the type is.
    pub const fn doc(&self) -> &'static str {
        self.doc
    }

    /// The identity of the native type.
    pub fn id(&self) -> TypeId {
        (self.id)()
    }

    /// A value as one of this type: itself if it is one, or what it stands for.
    pub fn accept(&self, value: &Dynamic) -> Option<Dynamic> {
        if value.type_id() == self.id() { Some(value.clone()) } else { (self.meant)(value) }
    }

    /// The printed form of a value, if it is one of this type.
    pub fn show(&self, value: &Dynamic) -> Option<String> {
        (self.show)(value)
    }

    /// The details of a value, if it is one of this type.
    pub fn details(&self, value: &Dynamic) -> Option<Details> {
        (self.details)(value)
    }

    /// The function that says why a value cannot be used now, if it is of this type and busy.
    pub fn busy(&self) -> fn(&Dynamic) -> Option<String> {
        self.busy
    }

    /// Gives the type a name and a printed form in the engine.
    pub fn register(&self, engine: &mut Engine) {
        (self.register)(engine);
    }
}

fn register<T: Scripted>(engine: &mut Engine) {
    engine.register_type_with_name::<T>(T::NAME);
    parameter_variants::know(TypeId::of::<T>(), T::NAME, |value| {
        value.read_lock::<T>().and_then(|of| of.family())
    });
    for name in ["to_string", "to_debug"] {
        engine.register_fn(name, |value: &mut T| value.show());
    }
}

/// The kind of value that may be given for a parameter.
#[derive(Clone, Copy)]
pub enum Kind {
    /// A number may be given for the parameter; whole numbers are welcome.
    Number(NumberRange),
    /// Any number may be given for the parameter, and is left whole if it is whole; infinite and not-a-number included.
    Numeric,
    /// A whole number may be given for the parameter; a number without a fraction, such as `3.0`, is welcome.
    Whole(NumberRange),
    /// A text may be given for the parameter.
    Text,
    /// A text may be given for the parameter that people can read in tables, and type.
    Name,
    /// One of these texts may be given for the parameter.
    Choice(&'static [&'static str]),
    /// `true` or `false` may be given for the parameter.
    Boolean,
    /// A vector or an array `[x, y]` may be given for the parameter.
    Point,
    /// An array of anything may be given for the parameter.
    Array,
    /// An array of finite numbers may be given for the parameter.
    Numbers,
    /// An array of points may be given for the parameter.
    Points,
    /// A function or closure may be given for the parameter.
    Function,
    /// A map of options with these keys may be given for the parameter.
    Options(&'static [Parameter]),
    /// A value of one of our types may be given for the parameter.
    Object(Type),
    /// A value of one of these kinds may be given for the parameter, tried in order.
    Either(&'static [Kind]),
    /// Anything may be given for the parameter.
    Anything,
}

/// The range of numbers that are allowed for a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NumberRange {
    /// Any finite number is allowed.
    Finite,
    /// Numbers greater than zero are allowed.
    Positive,
    /// Numbers of zero or greater are allowed.
    NonNegative,
    /// Numbers from the first to the second are allowed, both included.
    Between(f64, f64),
    /// All numbers are allowed, infinite and not-a-number included.
    Unlimited,
}

impl NumberRange {
    /// Whether the number `x` is in the range.
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

    /// The phrase for a number of this range, around the `noun` for it.
    fn phrase(self, noun: &str) -> String {
        match self {
            Self::Finite | Self::Unlimited => format!("a {noun}"),
            Self::Positive => format!("a positive {noun}"),
            Self::NonNegative => format!("a {noun} of zero or more"),
            Self::Between(least, most) => format!("a {noun} from {least} to {most}"),
        }
    }
}

impl Kind {
    /// Whether numbers that are given must be whole.
    pub fn is_of_whole_numbers(&self) -> bool {
        match self {
            Self::Whole(_) => true,
            Self::Either(kinds) => {
                let of_any = |kind: &Self| matches!(kind, Self::Number(_) | Self::Numeric);
                kinds.iter().any(Self::is_of_whole_numbers) && !kinds.iter().any(of_any)
            }
            _ => false,
        }
    }

    /// Whether values of the type with this name can be meant, whatever they hold.
    pub fn takes(&self, type_name: &str) -> bool {
        match self {
            Self::Number(_) | Self::Whole(_) | Self::Numeric => {
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
            Self::Anything => true,
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(range) => f.write_str(&range.phrase("number")),
            Self::Whole(range) => f.write_str(&range.phrase("whole number")),
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
            Self::Anything => f.write_str("a value"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_refuse_what_is_not_finite() {
        for range in [NumberRange::Finite, NumberRange::Positive, NumberRange::NonNegative] {
            assert!(!range.contains(f64::NAN) && !range.contains(f64::INFINITY), "{range:?}");
        }
        assert!(NumberRange::Unlimited.contains(f64::NAN));
        assert!(NumberRange::Between(0.0, 1.0).contains(1.0));
        assert!(!NumberRange::Positive.contains(0.0));
    }
}
