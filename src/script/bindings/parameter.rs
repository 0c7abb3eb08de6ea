//! A parameter of a row or a key of an option map: its name, kind, unit, range, default and doc.

use rhai::Dynamic;

use super::kind::{Kind, NumberRange, Type};

/// One parameter of a row, or one key of an option map: both are described and checked in the same way.
#[derive(Clone, Copy)]
pub struct Parameter {
    /// The name of the parameter: the key in an option map, the word in messages.
    pub name: &'static str,
    /// The kind of value that may be given for the parameter.
    pub kind: Kind,
    /// The dimension of the parameter, such as `force` or `force·length²`; empty for a pure number or a thing.
    pub unit: &'static str,
    /// A sentence on the parameter for the help.
    pub doc: &'static str,
    /// Whether the parameter may be left out, and what then holds.
    pub presence: Presence,
    /// The key of the same map without which the parameter has no meaning; empty if it has one by itself.
    pub beside: &'static str,
}

/// Whether a parameter must be given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Presence {
    /// The parameter must be given.
    Required,
    /// The parameter may be left out; the body sees that it is absent.
    Optional,
    /// Left out, the parameter is this number.
    Number(f64),
    /// Left out, the parameter is this whole number.
    Whole(i64),
    /// Left out, the parameter is this text.
    Text(&'static str),
    /// Left out, the parameter is this truth value.
    Boolean(bool),
}

/// A parameter for a number; finite unless [`Parameter::any_number`] says otherwise.
pub const fn number(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Number(NumberRange::Finite))
}

/// A parameter for any number, left whole if it is whole.
pub const fn numeric(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numeric)
}

/// A parameter for a whole number.
pub const fn whole(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Whole(NumberRange::Finite))
}

/// A parameter for a text.
pub const fn text(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Text)
}

/// A parameter for the name of something, which stands in tables.
pub const fn name(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Name)
}

/// A parameter for one text out of a list.
pub const fn choice(name: &'static str, allowed: &'static [&'static str]) -> Parameter {
    Parameter::new(name, Kind::Choice(allowed))
}

/// A parameter for `true` or `false`.
pub const fn boolean(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Boolean)
}

/// A parameter for a point or vector of the plane: a vector or an array `[x, y]`.
pub const fn point(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Point)
}

/// A parameter for an array of anything.
pub const fn array(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Array)
}

/// A parameter for an array of numbers.
pub const fn numbers(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numbers)
}

/// A parameter for an array of points.
pub const fn points(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Points)
}

/// A parameter for a function or closure of the script.
pub const fn callback(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Function)
}

/// A parameter for a map of options with the keys given.
pub const fn options(name: &'static str, keys: &'static [Parameter]) -> Parameter {
    Parameter::new(name, Kind::Options(keys))
}

/// A parameter for a value of one of our types.
pub const fn object(name: &'static str, of: Type) -> Parameter {
    Parameter::new(name, Kind::Object(of))
}

/// A parameter for a value of one of several kinds, tried in order.
pub const fn either(name: &'static str, kinds: &'static [Kind]) -> Parameter {
    Parameter::new(name, Kind::Either(kinds))
}

/// A parameter for anything at all.
pub const fn anything(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Anything)
}

impl Parameter {
    const fn new(name: &'static str, kind: Kind) -> Self {
        Self { name, kind, unit: "", doc: "", presence: Presence::Required, beside: "" }
    }

    /// The parameter for numbers greater than zero only.
    pub const fn positive(self) -> Self {
        self.within(NumberRange::Positive)
    }

    /// The parameter for numbers of zero or greater only.
    pub const fn non_negative(self) -> Self {
        self.within(NumberRange::NonNegative)
    }

    /// The parameter for numbers from `least` to `most` only, both included.
    pub const fn between(self, least: f64, most: f64) -> Self {
        self.within(NumberRange::Between(least, most))
    }

    /// The parameter for infinite numbers and not-a-number too: for functions that are about such numbers.
    pub const fn any_number(self) -> Self {
        self.within(NumberRange::Unlimited)
    }

    const fn within(mut self, range: NumberRange) -> Self {
        self.kind = match self.kind {
            Kind::Number(_) => Kind::Number(range),
            Kind::Whole(_) => Kind::Whole(range),
            other => other,
        };
        self
    }

    /// Says the dimension of the parameter.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Says what the parameter means.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// Lets the parameter be left out.
    pub const fn optional(mut self) -> Self {
        self.presence = Presence::Optional;
        self
    }

    /// Lets the parameter be left out; it then is `default`.
    pub const fn or(mut self, default: Presence) -> Self {
        self.presence = default;
        self
    }

    /// Gives the parameter a meaning only beside another key of the same map; without that it is refused.
    pub const fn beside(mut self, other: &'static str) -> Self {
        self.beside = other;
        self
    }

    /// Whether the parameter must be given.
    pub const fn is_required(&self) -> bool {
        matches!(self.presence, Presence::Required)
    }

    /// The value that holds when the parameter is left out, if there is one.
    pub fn default_value(&self) -> Option<Dynamic> {
        match self.presence {
            Presence::Required | Presence::Optional => None,
            Presence::Number(x) => Some(x.into()),
            Presence::Whole(n) => Some(n.into()),
            Presence::Text(text) => Some(text.into()),
            Presence::Boolean(truth) => Some(truth.into()),
        }
    }

    /// What may be given for the parameter, with its unit: `a positive number [force]`.
    pub fn expectation(&self) -> String {
        match self.unit {
            "" => self.kind.to_string(),
            unit => format!("{} [{unit}]", self.kind),
        }
    }
}
