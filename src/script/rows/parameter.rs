//! A parameter of a row or a key of an option map: its name, kind, unit, range, default and doc.

use rhai::Dynamic;

use super::kind::{Kind, Range, Type};

/// One parameter of a row, or one key of an option map: both are described and checked in the same way.
#[derive(Clone, Copy)]
pub struct Parameter {
    /// Its name: the key in an option map, the word in messages.
    pub name: &'static str,
    /// What may be given.
    pub kind: Kind,
    /// Its dimension, such as `force` or `force·length²`; empty for a pure number or a thing.
    pub unit: &'static str,
    /// A sentence for the help.
    pub doc: &'static str,
    /// Whether it may be left out, and what then holds.
    pub presence: Presence,
    /// The key of the same map without which it has no meaning; empty if it has one by itself.
    pub beside: &'static str,
}

/// Whether a parameter must be given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Presence {
    /// It must be given.
    Required,
    /// It may be left out; the body sees that it is absent.
    Optional,
    /// Left out, it is this number.
    Number(f64),
    /// Left out, it is this whole number.
    Whole(i64),
    /// Left out, it is this text.
    Text(&'static str),
    /// Left out, it is this truth value.
    Boolean(bool),
}

/// A number; finite unless [`Parameter::any_number`] says otherwise.
pub const fn number(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Number(Range::Finite))
}

/// Any number, left whole if it is whole.
pub const fn numeric(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numeric)
}

/// A whole number.
pub const fn whole(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Whole(Range::Finite))
}

/// A text.
pub const fn text(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Text)
}

/// The name of something, which stands in tables.
pub const fn name(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Name)
}

/// One text out of a list.
pub const fn choice(name: &'static str, allowed: &'static [&'static str]) -> Parameter {
    Parameter::new(name, Kind::Choice(allowed))
}

/// `true` or `false`.
pub const fn boolean(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Boolean)
}

/// A point or vector of the plane: a vector or an array `[x, y]`.
pub const fn point(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Point)
}

/// An array of anything.
pub const fn array(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Array)
}

/// An array of numbers.
pub const fn numbers(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numbers)
}

/// An array of points.
pub const fn points(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Points)
}

/// A function or closure of the script.
pub const fn callback(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Function)
}

/// A map of options with the keys given.
pub const fn options(name: &'static str, keys: &'static [Parameter]) -> Parameter {
    Parameter::new(name, Kind::Options(keys))
}

/// A value of one of our types.
pub const fn object(name: &'static str, of: Type) -> Parameter {
    Parameter::new(name, Kind::Object(of))
}

/// One of several kinds, tried in order.
pub const fn either(name: &'static str, kinds: &'static [Kind]) -> Parameter {
    Parameter::new(name, Kind::Either(kinds))
}

/// Anything at all.
pub const fn anything(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Anything)
}

impl Parameter {
    const fn new(name: &'static str, kind: Kind) -> Self {
        Self { name, kind, unit: "", doc: "", presence: Presence::Required, beside: "" }
    }

    /// Greater than zero.
    pub const fn positive(self) -> Self {
        self.within(Range::Positive)
    }

    /// Zero or greater.
    pub const fn non_negative(self) -> Self {
        self.within(Range::NonNegative)
    }

    /// At least `least`.
    pub const fn at_least(self, least: f64) -> Self {
        self.within(Range::AtLeast(least))
    }

    /// From `least` to `most`, both included.
    pub const fn between(self, least: f64, most: f64) -> Self {
        self.within(Range::Between(least, most))
    }

    /// Also infinite, also not a number: for functions that are about such numbers.
    pub const fn any_number(self) -> Self {
        self.within(Range::Unlimited)
    }

    const fn within(mut self, range: Range) -> Self {
        self.kind = match self.kind {
            Kind::Number(_) => Kind::Number(range),
            Kind::Whole(_) => Kind::Whole(range),
            other => other,
        };
        self
    }

    /// Its dimension.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// What it means.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// It may be left out.
    pub const fn optional(mut self) -> Self {
        self.presence = Presence::Optional;
        self
    }

    /// It may be left out and then is `default`.
    pub const fn or(mut self, default: Presence) -> Self {
        self.presence = default;
        self
    }

    /// It has a meaning only beside another key of the same map, and is refused without it.
    pub const fn beside(mut self, other: &'static str) -> Self {
        self.beside = other;
        self
    }

    /// Whether it must be given.
    pub const fn is_required(&self) -> bool {
        matches!(self.presence, Presence::Required)
    }

    /// The value that holds when it is left out.
    pub fn default_value(&self) -> Option<Dynamic> {
        match self.presence {
            Presence::Required | Presence::Optional => None,
            Presence::Number(x) => Some(x.into()),
            Presence::Whole(n) => Some(n.into()),
            Presence::Text(text) => Some(text.into()),
            Presence::Boolean(truth) => Some(truth.into()),
        }
    }

    /// What may be given, with its unit: `a positive number [force]`.
    pub fn expectation(&self) -> String {
        match self.unit {
            "" => self.kind.to_string(),
            unit => format!("{} [{unit}]", self.kind),
        }
    }
}
