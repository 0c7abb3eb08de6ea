//! What a row gives back: the kind of the value, its dimension, and what else is to be known of it.

use std::fmt;

use super::kind::Type;
use crate::script::words::nouns::with_article;

/// The kind of a value that a row gives back.
#[derive(Clone, Copy)]
pub enum ValueKind {
    /// Nothing: the row is there for what it does.
    Nothing,
    /// A value of any kind.
    Anything,
    /// A number, whole or not.
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Truth,
    /// A text may be given for the parameter.
    Text,
    /// A single character.
    Character,
    /// A function or a closure.
    Function,
    /// A time on the clock.
    Timestamp,
    /// A range of whole numbers.
    Range,
    /// A map.
    Map,
    /// An array of values of one kind.
    Array(&'static ValueKind),
    /// A value of one of our types may be given for the parameter.
    Object(Type),
    /// A value of one of these kinds, the likely one first.
    OneOf(&'static [ValueKind]),
}

/// The kinds that the language itself has, by the names of their types.
const PLAIN: &[ValueKind] = &[
    ValueKind::Number,
    ValueKind::Whole,
    ValueKind::Truth,
    ValueKind::Text,
    ValueKind::Character,
    ValueKind::Function,
    ValueKind::Timestamp,
    ValueKind::Range,
    ValueKind::Map,
    ValueKind::ARRAY,
];

impl ValueKind {
    /// An array of values of any kind.
    pub const ARRAY: Self = Self::Array(&Self::Anything);

    /// The kind of the values whose type has this name, if it is one of the language itself.
    pub fn plain(name: &str) -> Option<Self> {
        PLAIN.iter().find(|kind| kind.type_name() == Some(name)).copied()
    }

    /// The name that the type of such a value has in scripts; none where it can be of several types.
    pub const fn type_name(&self) -> Option<&'static str> {
        Some(match self {
            Self::Nothing | Self::Anything | Self::OneOf(_) => return None,
            Self::Number => "number",
            Self::Whole => "whole number",
            Self::Truth => "truth value",
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

    /// The kind that is likely, where a value may be of several.
    pub fn likely(self) -> Self {
        match self {
            Self::OneOf([first, ..]) => first.likely(),
            other => other,
        }
    }

    /// The kind of the elements of an array.
    pub fn element(self) -> Option<Self> {
        match self {
            Self::Array(of) => Some(*of),
            _ => None,
        }
    }
}

/// The words for a value of the kind, with their article.
impl fmt::Display for ValueKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.type_name()) {
            (Self::Truth, _) => f.write_str("true or false"),
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

/// What a row gives back.
#[derive(Clone, Copy)]
pub struct Returns {
    /// The kind of the value.
    pub kind: ValueKind,
    /// Its dimension, such as `force`; `-` for a pure number where others have one; empty where there is nothing to say.
    unit: &'static str,
    /// Words in the place of those for the kind; empty where those will do.
    words: &'static str,
    /// What is written behind them, with the blank or the comma before it.
    note: &'static str,
}

impl Returns {
    /// Nothing.
    pub const NOTHING: Self = Self::of(ValueKind::Nothing);
    /// A value of any kind.
    pub const ANYTHING: Self = Self::of(ValueKind::Anything);
    /// A number.
    pub const NUMBER: Self = Self::of(ValueKind::Number);
    /// A whole number.
    pub const WHOLE: Self = Self::of(ValueKind::Whole);
    /// `true` or `false`.
    pub const TRUTH: Self = Self::of(ValueKind::Truth);
    /// A text.
    pub const TEXT: Self = Self::of(ValueKind::Text);
    /// A single character.
    pub const CHARACTER: Self = Self::of(ValueKind::Character);
    /// A function.
    pub const FUNCTION: Self = Self::of(ValueKind::Function);
    /// A time on the clock.
    pub const TIMESTAMP: Self = Self::of(ValueKind::Timestamp);
    /// A map.
    pub const MAP: Self = Self::of(ValueKind::Map);
    /// An array of anything.
    pub const ARRAY: Self = Self::of(ValueKind::ARRAY);
    /// An array of numbers.
    pub const NUMBERS: Self = Self::array_of(&ValueKind::Number);
    /// A value of any kind, or nothing where there is none.
    pub const ANYTHING_OR_NOTHING: Self = Self::one_of(&[ValueKind::Anything, ValueKind::Nothing]);

    /// A value of a kind.
    pub const fn of(kind: ValueKind) -> Self {
        Self { kind, unit: "", words: "", note: "" }
    }

    /// A value of one of our types.
    pub const fn object(of: Type) -> Self {
        Self::of(ValueKind::Object(of))
    }

    /// An array of values of one kind.
    pub const fn array_of(element: &'static ValueKind) -> Self {
        Self::of(ValueKind::Array(element))
    }

    /// A value of one of several kinds, the likely one first.
    pub const fn one_of(kinds: &'static [ValueKind]) -> Self {
        Self::of(ValueKind::OneOf(kinds))
    }

    /// Says the dimension of the parameter.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Words of its own in the place of those for its kind: `an angle from -PI to PI`.
    pub const fn words(mut self, words: &'static str) -> Self {
        self.words = words;
        self
    }

    /// What is written behind its kind and its dimension, with the blank or the comma before it.
    pub const fn note(mut self, note: &'static str) -> Self {
        self.note = note;
        self
    }

    /// Whether there is nothing to be had.
    pub const fn is_nothing(&self) -> bool {
        matches!(self.kind, ValueKind::Nothing)
    }
}

/// In words: `a vector [force]`, `a number, whole if x is`; empty for nothing.
impl fmt::Display for Returns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.is_nothing(), self.words) {
            (true, _) => return Ok(()),
            (false, "") => write!(f, "{}", self.kind)?,
            (false, words) => f.write_str(words)?,
        }
        if !self.unit.is_empty() {
            write!(f, " [{}]", self.unit)?;
        }
        f.write_str(self.note)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_given_back_is_said_in_words() {
        for (returns, words) in [
            (Returns::NOTHING, ""),
            (Returns::NUMBER.unit("time"), "a number [time]"),
            (Returns::NUMBER.note(", whole if x is"), "a number, whole if x is"),
            (Returns::NUMBER.words("an angle from -PI to PI"), "an angle from -PI to PI"),
            (Returns::TRUTH, "true or false"),
            (Returns::ANYTHING, "a value"),
            (Returns::ANYTHING_OR_NOTHING, "a value or nothing"),
            (Returns::ARRAY.note(" [a, b]"), "an array [a, b]"),
            (Returns::array_of(&ValueKind::Map), "an array of maps"),
            (Returns::NUMBERS.unit("rad/time"), "an array of numbers [rad/time]"),
        ] {
            assert_eq!(returns.to_string(), words);
        }
    }

    #[test]
    fn kinds_are_found_by_the_names_of_their_types() {
        for kind in PLAIN {
            let name = kind.type_name().expect("a plain kind has a type");
            assert_eq!(ValueKind::plain(name).and_then(|found| found.type_name()), Some(name));
        }
        assert!(ValueKind::plain("beam").is_none());
    }
}
