//! The declarative table of a domain: one row for each name that scripts can use.
//!
//! From the same rows come the registration in the engine, the checks of arguments, the error messages and
//! their suggestions, help, definition files and the language reference. A domain is added by writing
//! `pub const TABLE: BindingTable` in a new file of [`packages`](crate::script::packages) and naming it in the list there.

use rhai::Dynamic;

use super::call::Call;
use super::kind::Type;
use super::parameter::Parameter;
use super::parameter_variants::NonsmoothCheck;
use super::returns::Returns;
use crate::script::messages::error::ScriptError;

/// The native body of a row. Its arguments were counted, converted and range-checked before it is called.
pub type NativeFunction = fn(&mut Call<'_, '_>) -> Result<Dynamic, ScriptError>;

/// A table: everything that one domain adds to the language.
pub struct BindingTable {
    /// The short name of the domain, a heading in the language reference.
    pub name: &'static str,
    /// A sentence or two on what the domain is for.
    pub doc: &'static str,
    /// The types that the domain brings to the language.
    pub types: &'static [Type],
    /// The lines that all examples of the domain begin with; empty when they need none.
    pub setup: &'static str,
    /// The names with a fixed value that the domain brings.
    pub constants: &'static [Constant],
    /// The functions, methods, properties and operators of the domain.
    pub rows: &'static [FunctionBinding],
}

/// A name with a fixed numeric value, visible everywhere, also inside functions.
pub struct Constant {
    /// The name of the constant in scripts.
    pub name: &'static str,
    /// The value of the constant.
    pub value: f64,
    /// One line on what the constant is.
    pub summary: &'static str,
}

/// How a row is written in a script.
#[derive(Clone, Copy)]
pub enum CallSyntax {
    /// The row is written as `name(a, b)`, or equally `a.name(b)`.
    Function,
    /// The row is written as `receiver.name(a, b)` on one type only.
    Method(Type),
    /// The row is written as `receiver.name`, and with a setter `receiver.name = value`.
    Property(Type),
    /// The row is written as `a + b`.
    Operator,
}

/// What the engine puts before the name of a property whose value is asked for,
pub const GETTER: &str = "get$";

/// and of one that is assigned.
pub const SETTER: &str = "set$";

/// The name by which the engine asks for a property.
pub fn getter_of(property: &str) -> String {
    format!("{GETTER}{property}")
}

/// The name by which the engine assigns a property.
pub fn setter_of(property: &str) -> String {
    format!("{SETTER}{property}")
}

/// A row of the language: one function, method, property or operator.
pub struct FunctionBinding {
    /// The name of the row in scripts.
    pub name: &'static str,
    /// How the row is written in a script.
    pub form: CallSyntax,
    /// The parameters of the row; optional ones stand last.
    pub parameters: &'static [Parameter],
    /// What the row gives back.
    pub returns: Returns,
    /// One line on what the row does.
    pub summary: &'static str,
    /// More on the row, where a line is not enough.
    pub doc: &'static str,
    /// A script that runs and shows the row at work.
    pub example: &'static str,
    /// Names that are related to the row.
    pub see: &'static [&'static str],
    /// The native function that does what the row does.
    pub body: NativeFunction,
    /// The writing half of a property that can be assigned: the new value and what to do with it.
    pub setter: Option<Setter>,
    /// Where what the row gives has a corner or a jump, and no derivatives by what its arguments depend on.
    pub corner: Option<NonsmoothCheck>,
}

/// The writing half of a property.
#[derive(Clone, Copy)]
pub struct Setter {
    /// The parameter for the value that is assigned.
    pub value: &'static [Parameter; 1],
    /// The native function that assigns the value.
    pub body: NativeFunction,
}

/// A row for a function: `name(a, b)`.
pub const fn function(
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Function, parameters, body)
}

/// A row for a method on values of one type: `receiver.name(a, b)`.
pub const fn method(
    of: Type,
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Method(of), parameters, body)
}

/// A row for a property of values of one type: `receiver.name`.
pub const fn property(of: Type, name: &'static str, body: NativeFunction) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Property(of), &[], body)
}

/// A row for an operator between two values, at least one of which has a type of ours.
pub const fn operator(
    symbol: &'static str,
    operands: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    FunctionBinding::new(symbol, CallSyntax::Operator, operands, body)
}

impl FunctionBinding {
    const fn new(
        name: &'static str,
        form: CallSyntax,
        parameters: &'static [Parameter],
        body: NativeFunction,
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
            corner: None,
        }
    }

    /// Says what the row gives back.
    pub const fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    /// Adds the one line of help that every row must have.
    pub const fn summary(mut self, summary: &'static str) -> Self {
        self.summary = summary;
        self
    }

    /// Adds a longer explanation of the row.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// Adds the runnable example that every row must have.
    pub const fn example(mut self, example: &'static str) -> Self {
        self.example = example;
        self
    }

    /// Adds names that are related to the row.
    pub const fn see(mut self, see: &'static [&'static str]) -> Self {
        self.see = see;
        self
    }

    /// Lets the property of the row be assigned.
    pub const fn writable(mut self, value: &'static [Parameter; 1], body: NativeFunction) -> Self {
        self.setter = Some(Setter { value, body });
        self
    }

    /// Says where what the row gives has a corner or a jump.
    pub const fn corner(mut self, corner: NonsmoothCheck) -> Self {
        self.corner = Some(corner);
        self
    }

    /// The number of arguments that must be given to the row.
    pub fn required(&self) -> usize {
        self.parameters.iter().filter(|parameter| parameter.is_required()).count()
    }

    /// The type whose method or property the row is.
    pub fn receiver(&self) -> Option<Type> {
        match self.form {
            CallSyntax::Method(of) | CallSyntax::Property(of) => Some(of),
            CallSyntax::Function | CallSyntax::Operator => None,
        }
    }

    /// How the row is written, with optional parameters in brackets: `line(from, to)`, `sim.step([count])`.
    pub fn signature(&self) -> String {
        let names = self.parameters.iter().map(|parameter| match parameter.is_required() {
            true => parameter.name.to_owned(),
            false => format!("[{}]", parameter.name),
        });
        match self.form {
            CallSyntax::Function => {
                format!("{}({})", self.name, names.collect::<Vec<_>>().join(", "))
            }
            CallSyntax::Method(of) => {
                format!("{}.{}({})", of.name(), self.name, names.collect::<Vec<_>>().join(", "))
            }
            CallSyntax::Property(of) => format!("{}.{}", of.name(), self.name),
            CallSyntax::Operator => names.collect::<Vec<_>>().join(&format!(" {} ", self.name)),
        }
    }
}
