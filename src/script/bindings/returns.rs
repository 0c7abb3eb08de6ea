//! What a row gives back: the kind of the value, its dimension, and what else is to be known of it.

use std::fmt;

use super::kind::Type;
use crate::script::messages::nouns::with_article;

/// The kind of a value that a row gives back.
#[derive(Clone, Copy)]
pub enum ValueKind {
    /// The row gives back nothing: it is there for what it does.
    Nothing,
    /// The row gives back a value of any kind.
    Anything,
    /// The row gives back a number, whole or not.
    Number,
    /// The row gives back a whole number.
    Whole,
    /// The row gives back `true` or `false`.
    Truth,
    /// The row gives back a text.
    Text,
    /// The row gives back a single character.
    Character,
    /// The row gives back a function or a closure.
    Function,
    /// The row gives back a time on the clock.
    Timestamp,
    /// A range of whole numbers.
    Range,
    /// The row gives back a map.
    Map,
    /// The row gives back an array of values of one kind.
    Array(&'static ValueKind),
    /// The row gives back a value of one of our types.
    Object(Type),
    /// The row gives back a value of one of these kinds, the likely one first.
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
    /// The kind of an array of values of any kind.
    pub const ARRAY: Self = Self::Array(&Self::Anything);

    /// The kind of the values whose type has this name, if it is one of the language itself.
    pub fn plain(name: &str) -> Option<Self> {
        PLAIN.iter().find(|kind| kind.type_name() == Some(name)).copied()
    }

    /// The name that the type of a value of this kind has in scripts; none where it can be of several types.
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

    /// The kind of the elements of an array of this kind; none for what is no array.
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

/// What a row of the language gives back: kind, dimension, remarks.
#[derive(Clone, Copy)]
pub struct Returns {
    /// The kind of the value that is given back.
    pub kind: ValueKind,
    /// Its dimension, such as `force`; `-` for a pure number where others have one; empty where there is nothing to say.
    unit: &'static str,
    /// Words in the place of those for the kind; empty where those will do.
    words: &'static str,
    /// What is written behind them, with the blank or the comma before it.
    note: &'static str,
}

impl Returns {
    /// The row gives back nothing.
    pub const NOTHING: Self = Self::of(ValueKind::Nothing);
    /// The row gives back a value of any kind.
    pub const ANYTHING: Self = Self::of(ValueKind::Anything);
    /// The row gives back a number.
    pub const NUMBER: Self = Self::of(ValueKind::Number);
    /// The row gives back a whole number.
    pub const WHOLE: Self = Self::of(ValueKind::Whole);
    /// The row gives back `true` or `false`.
    pub const TRUTH: Self = Self::of(ValueKind::Truth);
    /// The row gives back a text.
    pub const TEXT: Self = Self::of(ValueKind::Text);
    /// The row gives back a single character.
    pub const CHARACTER: Self = Self::of(ValueKind::Character);
    /// The row gives back a function.
    pub const FUNCTION: Self = Self::of(ValueKind::Function);
    /// The row gives back a time on the clock.
    pub const TIMESTAMP: Self = Self::of(ValueKind::Timestamp);
    /// The row gives back a map.
    pub const MAP: Self = Self::of(ValueKind::Map);
    /// The row gives back an array of anything.
    pub const ARRAY: Self = Self::of(ValueKind::ARRAY);
    /// The row gives back an array of numbers.
    pub const NUMBERS: Self = Self::array_of(&ValueKind::Number);
    /// The row gives back a value of any kind, or nothing where there is none.
    pub const ANYTHING_OR_NOTHING: Self = Self::one_of(&[ValueKind::Anything, ValueKind::Nothing]);

    /// What gives back a value of a kind.
    pub const fn of(kind: ValueKind) -> Self {
        Self { kind, unit: "", words: "", note: "" }
    }

    /// What gives back a value of one of our types.
    pub const fn object(of: Type) -> Self {
        Self::of(ValueKind::Object(of))
    }

    /// What gives back an array of values of one kind.
    pub const fn array_of(element: &'static ValueKind) -> Self {
        Self::of(ValueKind::Array(element))
    }

    /// What gives back a value of one of several kinds, the likely one first.
    pub const fn one_of(kinds: &'static [ValueKind]) -> Self {
        Self::of(ValueKind::OneOf(kinds))
    }

    /// Says the dimension of what is given back.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Tells what is given back in words of its own, in the place of those for its kind: `an angle from -PI to PI`.
    pub const fn words(mut self, words: &'static str) -> Self {
        self.words = words;
        self
    }

    /// Adds what is written behind kind and dimension of what is given back, with the blank or the comma before it.
    pub const fn note(mut self, note: &'static str) -> Self {
        self.note = note;
        self
    }

    /// Whether the row gives back nothing.
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
