//! Return values of bindings: type, dimension, and remarks.

use std::fmt;

use super::kind::Type;
use crate::script::messages::nouns::with_article;

#[derive(Clone, Copy)]
pub enum ValueKind {
    Nothing,
    Any,
    Number,
    Integer,
    Boolean,
    Text,
    Character,
    Function,
    Timestamp,
    Range,
    Map,
    Array(&'static ValueKind),
    Object(Type),
    OneOf(&'static [ValueKind]),
}

const PLAIN: &[ValueKind] = &[
    ValueKind::Number,
    ValueKind::Integer,
    ValueKind::Boolean,
    ValueKind::Text,
    ValueKind::Character,
    ValueKind::Function,
    ValueKind::Timestamp,
    ValueKind::Range,
    ValueKind::Map,
    ValueKind::ARRAY,
];

impl ValueKind {
    pub const ARRAY: Self = Self::Array(&Self::Any);

    /// Return type for the name of a built-in type; `None` for other names.
    pub fn plain(name: &str) -> Option<Self> {
        PLAIN.iter().find(|kind| kind.type_name() == Some(name)).copied()
    }

    /// Type name in scripts; `None` if several types are possible or nothing is returned.
    pub const fn type_name(&self) -> Option<&'static str> {
        Some(match self {
            Self::Nothing | Self::Any | Self::OneOf(_) => return None,
            Self::Number => "number",
            Self::Integer => "whole number",
            Self::Boolean => "truth value",
            Self::Text => "text",
            Self::Character => "character",
            Self::Function => "function",
            Self::Timestamp => "timestamp",
            Self::Range => "range",
            Self::Map => "map",
            Self::Array(_) => "array",
            Self::Object(of) => of.name(),
        })
    }

    /// Most likely type of a value that may have several types.
    pub fn likely(self) -> Self {
        match self {
            Self::OneOf([first, ..]) => first.likely(),
            other => other,
        }
    }

    pub fn element(self) -> Option<Self> {
        match self {
            Self::Array(of) => Some(*of),
            _ => None,
        }
    }
}

impl fmt::Display for ValueKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.type_name()) {
            (Self::Boolean, _) => f.write_str("true or false"),
            (Self::Array(of), _) => match of.type_name() {
                Some(of) => write!(f, "an array of {of}s"),
                None => f.write_str("an array"),
            },
            (Self::OneOf(kinds), _) => {
                let words: Vec<_> = kinds.iter().map(Self::to_string).collect();
                f.write_str(&words.join(" or "))
            }
            (Self::Nothing, _) => f.write_str("nothing"),
            (_, Some(name)) => f.write_str(&with_article(name)),
            (_, None) => f.write_str("a value"),
        }
    }
}

#[derive(Clone, Copy)]
pub struct Returns {
    pub kind: ValueKind,
    /// Dimension, such as `force`; `-` for a dimensionless number; empty for a type without dimension.
    unit: &'static str,
    description: &'static str,
    remark: &'static str,
}

impl Returns {
    pub const NOTHING: Self = Self::of(ValueKind::Nothing);
    pub const ANYTHING: Self = Self::of(ValueKind::Any);
    pub const NUMBER: Self = Self::of(ValueKind::Number);
    pub const INTEGER: Self = Self::of(ValueKind::Integer);
    pub const BOOLEAN: Self = Self::of(ValueKind::Boolean);
    pub const TEXT: Self = Self::of(ValueKind::Text);
    pub const CHARACTER: Self = Self::of(ValueKind::Character);
    pub const FUNCTION: Self = Self::of(ValueKind::Function);
    pub const TIMESTAMP: Self = Self::of(ValueKind::Timestamp);
    pub const MAP: Self = Self::of(ValueKind::Map);
    pub const ARRAY: Self = Self::of(ValueKind::ARRAY);
    pub const NUMBERS: Self = Self::array_of(&ValueKind::Number);
    pub const ANYTHING_OR_NOTHING: Self = Self::one_of(&[ValueKind::Any, ValueKind::Nothing]);

    pub const fn of(kind: ValueKind) -> Self {
        Self { kind, unit: "", description: "", remark: "" }
    }

    pub const fn object(of: Type) -> Self {
        Self::of(ValueKind::Object(of))
    }

    pub const fn array_of(element: &'static ValueKind) -> Self {
        Self::of(ValueKind::Array(element))
    }

    pub const fn one_of(kinds: &'static [ValueKind]) -> Self {
        Self::of(ValueKind::OneOf(kinds))
    }

    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    pub const fn with_description(mut self, words: &'static str) -> Self {
        self.description = words;
        self
    }

    /// Adds text after type and dimension, which must begin with a blank or comma.
    pub const fn with_remark(mut self, note: &'static str) -> Self {
        self.remark = note;
        self
    }

    pub const fn is_nothing(&self) -> bool {
        matches!(self.kind, ValueKind::Nothing)
    }
}

/// Description, for example `a vector [force]` or `a number, whole if x is`; empty if nothing is returned.
impl fmt::Display for Returns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.is_nothing(), self.description) {
            (true, _) => return Ok(()),
            (false, "") => write!(f, "{}", self.kind)?,
            (false, words) => f.write_str(words)?,
        }
        if !self.unit.is_empty() {
            write!(f, " [{}]", self.unit)?;
        }
        f.write_str(self.remark)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn return_descriptions_are_readable() {
        for (returns, words) in [
            (Returns::NOTHING, ""),
            (Returns::NUMBER.unit("time"), "a number [time]"),
            (Returns::NUMBER.with_remark(", whole if x is"), "a number, whole if x is"),
            (
                Returns::NUMBER.with_description("an angle from -PI to PI"),
                "an angle from -PI to PI",
            ),
            (Returns::BOOLEAN, "true or false"),
            (Returns::ANYTHING, "a value"),
            (Returns::ANYTHING_OR_NOTHING, "a value or nothing"),
            (Returns::ARRAY.with_remark(" [a, b]"), "an array [a, b]"),
            (Returns::array_of(&ValueKind::Map), "an array of maps"),
            (Returns::NUMBERS.unit("rad/time"), "an array of numbers [rad/time]"),
        ] {
            assert_eq!(returns.to_string(), words);
        }
    }

    #[test]
    fn value_kinds_are_found_by_type_name() {
        for kind in PLAIN {
            let name = kind.type_name().expect("a plain kind has a type");
            assert_eq!(ValueKind::plain(name).and_then(|found| found.type_name()), Some(name));
        }
        assert!(ValueKind::plain("beam").is_none());
    }
}
