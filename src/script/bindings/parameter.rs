//! Parameters of bindings and keys of option maps.

use rhai::Dynamic;

use super::kind::{Kind, NumberRange, Type};

/// Parameter of a binding, or key of an option map.
#[derive(Clone, Copy)]
pub struct Parameter {
    /// Name: the key in an option map, and the name in messages.
    pub name: &'static str,
    /// Type of value.
    pub kind: Kind,
    /// Dimension, such as `force` or `force·length²`; empty for a pure number or an object.
    pub unit: &'static str,
    /// Description for the help.
    pub doc: &'static str,
    /// Requirement and default.
    pub presence: Presence,
    /// Key of the same map that must also be given; may be empty.
    pub required_key: &'static str,
}

/// Requirement and default of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Presence {
    /// The parameter is required.
    Required,
    /// The parameter is optional without a default. The native function must handle an omitted value.
    Optional,
    /// The parameter is optional and has a number as its default.
    Number(f64),
    /// The parameter is optional and has an integer as its default.
    Integer(i64),
    /// The parameter is optional and has a text as its default.
    Text(&'static str),
    /// The parameter is optional and has a boolean as its default.
    Boolean(bool),
}

/// Number parameter. The number must be finite unless [`Parameter::allow_non_finite`] is called.
pub const fn number(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Number(NumberRange::Finite))
}

/// Parameter that may be any number. Integers are not converted.
pub const fn numeric(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numeric)
}

/// Integer parameter.
pub const fn integer(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Integer(NumberRange::Finite))
}

/// Text parameter.
pub const fn text(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Text)
}

/// Parameter whose value is a name, for example the name of a scene or of a study.
pub const fn name(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Name)
}

/// Parameter whose value is one of several texts.
pub const fn choice(name: &'static str, allowed: &'static [&'static str]) -> Parameter {
    Parameter::new(name, Kind::Choice(allowed))
}

/// Boolean parameter.
pub const fn boolean(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Boolean)
}

/// Point or vector parameter, given as a vector or an array `[x, y]`.
pub const fn point(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Point)
}

/// Array parameter with values of any type.
pub const fn array(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Array)
}

/// Parameter for an array of numbers.
pub const fn numbers(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Numbers)
}

/// Parameter for an array of points.
pub const fn points(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Points)
}

/// Parameter for a function or closure.
pub const fn callback(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Function)
}

/// Parameter for a map of options with the given keys.
pub const fn options(name: &'static str, keys: &'static [Parameter]) -> Parameter {
    Parameter::new(name, Kind::Options(keys))
}

/// Parameter for a value of a native type.
pub const fn object(name: &'static str, of: Type) -> Parameter {
    Parameter::new(name, Kind::Object(of))
}

/// Parameter for a value of one of several types, which are tried in order.
pub const fn either(name: &'static str, kinds: &'static [Kind]) -> Parameter {
    Parameter::new(name, Kind::Either(kinds))
}

/// Parameter for any value.
pub const fn of_any_type(name: &'static str) -> Parameter {
    Parameter::new(name, Kind::Any)
}

impl Parameter {
    const fn new(name: &'static str, kind: Kind) -> Self {
        Self { name, kind, unit: "", doc: "", presence: Presence::Required, required_key: "" }
    }

    /// Restricts the number to be positive.
    pub const fn positive(self) -> Self {
        self.within(NumberRange::Positive)
    }

    /// Restricts the number to be zero or positive.
    pub const fn non_negative(self) -> Self {
        self.within(NumberRange::NonNegative)
    }

    /// Restricts the number to the range from `least` to `most`, including both.
    pub const fn between(self, least: f64, most: f64) -> Self {
        self.within(NumberRange::Between(least, most))
    }

    /// Allows infinity and NaN, for functions that handle such numbers.
    pub const fn allow_non_finite(self) -> Self {
        self.within(NumberRange::Unlimited)
    }

    const fn within(mut self, range: NumberRange) -> Self {
        self.kind = match self.kind {
            Kind::Number(_) => Kind::Number(range),
            Kind::Integer(_) => Kind::Integer(range),
            other => other,
        };
        self
    }

    /// Sets the dimension.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Sets the description.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// Makes the parameter optional.
    pub const fn optional(mut self) -> Self {
        self.presence = Presence::Optional;
        self
    }

    /// Makes the parameter optional with a default.
    pub const fn or(mut self, default: Presence) -> Self {
        self.presence = default;
        self
    }

    /// Requires another key of the same map.
    pub const fn requires_key(mut self, other: &'static str) -> Self {
        self.required_key = other;
        self
    }

    /// Returns true if the parameter is required.
    pub const fn is_required(&self) -> bool {
        matches!(self.presence, Presence::Required)
    }

    /// Default value; `None` if there is no default.
    pub fn default_value(&self) -> Option<Dynamic> {
        match self.presence {
            Presence::Required | Presence::Optional => None,
            Presence::Number(x) => Some(x.into()),
            Presence::Integer(n) => Some(n.into()),
            Presence::Text(text) => Some(text.into()),
            Presence::Boolean(truth) => Some(truth.into()),
        }
    }

    /// Description of the allowed values with their unit, for example `a positive number [force]`.
    pub fn expectation(&self) -> String {
        match self.unit {
            "" => self.kind.to_string(),
            unit => format!("{} [{unit}]", self.kind),
        }
    }
}
