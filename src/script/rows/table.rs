//! The declarative table of a domain: one row for each name that scripts can use.
//!
//! From the same rows come the registration in the engine, the checks of arguments, the error messages and
//! their suggestions, help, definition files and the language reference. A domain is added by writing
//! `pub const TABLE: Table` in a new file of [`packages`](crate::script::packages) and naming it in the list there.

use rhai::Dynamic;

use super::call::Call;
use super::kind::Type;
use super::parameter::Parameter;
use super::returns::Returns;
use crate::script::words::error::ScriptError;

/// The native body of a row. Its arguments were counted, converted and range-checked before it is called.
pub type Body = fn(&mut Call<'_, '_>) -> Result<Dynamic, ScriptError>;

/// Everything that one domain adds to the language.
pub struct Table {
    /// Short name of the domain, a heading in the language reference.
    pub name: &'static str,
    /// A sentence or two on what the domain is for.
    pub doc: &'static str,
    /// The types that the domain brings.
    pub types: &'static [Type],
    /// Lines that all examples of the domain begin with; empty when they need none.
    pub setup: &'static str,
    /// Names with a fixed value.
    pub constants: &'static [Constant],
    /// Functions, methods, properties and operators.
    pub rows: &'static [Row],
}

/// A name with a fixed numeric value, visible everywhere, also inside functions.
pub struct Constant {
    /// Name in scripts.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// One line on what it is.
    pub summary: &'static str,
}

/// How a row is written in a script.
#[derive(Clone, Copy)]
pub enum Form {
    /// `name(a, b)`, or equally `a.name(b)`.
    Function,
    /// `receiver.name(a, b)` on one type only.
    Method(Type),
    /// `receiver.name`, and with a setter `receiver.name = value`.
    Property(Type),
    /// `a + b`.
    Operator,
}

/// One exposed function, method, property or operator.
pub struct Row {
    /// Name in scripts.
    pub name: &'static str,
    /// How it is written.
    pub form: Form,
    /// What it takes; optional parameters stand last.
    pub parameters: &'static [Parameter],
    /// What it gives back.
    pub returns: Returns,
    /// One line.
    pub summary: &'static str,
    /// More, where a line is not enough.
    pub doc: &'static str,
    /// A script that runs and shows the row at work.
    pub example: &'static str,
    /// Related names.
    pub see: &'static [&'static str],
    /// What it does.
    pub body: Body,
    /// For a property that can be assigned: the new value and what to do with it.
    pub setter: Option<Setter>,
}

/// The writing half of a property.
#[derive(Clone, Copy)]
pub struct Setter {
    /// The value assigned.
    pub value: &'static [Parameter; 1],
    /// What to do with it.
    pub body: Body,
}

/// A function: `name(a, b)`.
pub const fn function(name: &'static str, parameters: &'static [Parameter], body: Body) -> Row {
    Row::new(name, Form::Function, parameters, body)
}

/// A method on values of one type: `receiver.name(a, b)`.
pub const fn method(
    of: Type,
    name: &'static str,
    parameters: &'static [Parameter],
    body: Body,
) -> Row {
    Row::new(name, Form::Method(of), parameters, body)
}

/// A property of values of one type: `receiver.name`.
pub const fn property(of: Type, name: &'static str, body: Body) -> Row {
    Row::new(name, Form::Property(of), &[], body)
}

/// An operator between two values, at least one of which has a type of ours.
pub const fn operator(symbol: &'static str, operands: &'static [Parameter], body: Body) -> Row {
    Row::new(symbol, Form::Operator, operands, body)
}

impl Row {
    const fn new(
        name: &'static str,
        form: Form,
        parameters: &'static [Parameter],
        body: Body,
    ) -> Self {
        Self {
            name,
            form,
            parameters,
            returns: Returns::NOTHING,
            summary: "",
            doc: "",
            example: "",
            see: &[],
            body,
            setter: None,
        }
    }

    /// Says what the row gives back.
    pub const fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    /// The one line of help that every row must have.
    pub const fn summary(mut self, summary: &'static str) -> Self {
        self.summary = summary;
        self
    }

    /// A longer explanation.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// The runnable example that every row must have.
    pub const fn example(mut self, example: &'static str) -> Self {
        self.example = example;
        self
    }

    /// Related names.
    pub const fn see(mut self, see: &'static [&'static str]) -> Self {
        self.see = see;
        self
    }

    /// Lets the property be assigned.
    pub const fn writable(mut self, value: &'static [Parameter; 1], body: Body) -> Self {
        self.setter = Some(Setter { value, body });
        self
    }

    /// How many arguments must be given.
    pub fn required(&self) -> usize {
        self.parameters.iter().filter(|parameter| parameter.is_required()).count()
    }

    /// The type whose method or property this is.
    pub fn receiver(&self) -> Option<Type> {
        match self.form {
            Form::Method(of) | Form::Property(of) => Some(of),
            Form::Function | Form::Operator => None,
        }
    }

    /// How the row is written, with optional parameters in brackets: `line(from, to)`, `sim.step([count])`.
    pub fn signature(&self) -> String {
        let names = self.parameters.iter().map(|parameter| match parameter.is_required() {
            true => parameter.name.to_owned(),
            false => format!("[{}]", parameter.name),
        });
        match self.form {
            Form::Function => format!("{}({})", self.name, names.collect::<Vec<_>>().join(", ")),
            Form::Method(of) => {
                format!("{}.{}({})", of.name(), self.name, names.collect::<Vec<_>>().join(", "))
            }
            Form::Property(of) => format!("{}.{}", of.name(), self.name),
            Form::Operator => names.collect::<Vec<_>>().join(&format!(" {} ", self.name)),
        }
    }
}
