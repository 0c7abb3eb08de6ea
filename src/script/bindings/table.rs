//! Binding tables, each of which declares a domain of the language.
//!
//! Checks, messages, help, definition files and the reference are derived from the tables.
//! A new domain needs a `pub const TABLE: BindingTable` in a new file of [`packages`](crate::script::packages), listed there.

use rhai::Dynamic;

use super::call::Call;
use super::kind::Type;
use super::parameter::Parameter;
use super::parameter_variants::NonsmoothCheck;
use super::returns::Returns;
use crate::script::messages::error::ScriptError;

/// Native function of a binding. Its arguments have been counted, converted and range-checked.
pub type NativeFunction = fn(&mut Call<'_, '_>) -> Result<Dynamic, ScriptError>;

/// Table of all types, constants and functions of a domain.
pub struct BindingTable {
    /// Name of the domain, which is its heading in the reference.
    pub name: &'static str,
    /// One or two sentences about the domain.
    pub doc: &'static str,
    /// Types of the domain.
    pub types: &'static [Type],
    /// First lines of every example of the domain; may be empty.
    pub setup: &'static str,
    /// Constants of the domain.
    pub constants: &'static [Constant],
    /// Functions, methods, properties and operators of the domain.
    pub rows: &'static [FunctionBinding],
}

/// Numeric constant, visible everywhere in scripts, also inside functions.
pub struct Constant {
    /// Name in scripts.
    pub name: &'static str,
    /// Value.
    pub value: f64,
    /// One-line summary.
    pub summary: &'static str,
}

/// Notation of a call.
#[derive(Clone, Copy)]
pub enum CallSyntax {
    /// Function call `name(a, b)`, or with the same meaning `a.name(b)`.
    Function,
    /// Method call `receiver.name(a, b)`. The receiver has this type.
    Method(Type),
    /// Property `receiver.name` of this type. With a setter, also `receiver.name = value`.
    Property(Type),
    /// Operator, as in `a + b`.
    Operator,
}

/// Prefix that Rhai uses for property getters.
pub const GETTER: &str = "get$";

/// Prefix that Rhai uses for property setters.
pub const SETTER: &str = "set$";

/// Name of a property getter in the engine.
pub fn getter_of(property: &str) -> String {
    format!("{GETTER}{property}")
}

/// Name of a property setter in the engine.
pub fn setter_of(property: &str) -> String {
    format!("{SETTER}{property}")
}

/// Function, method, property or operator of the language.
pub struct FunctionBinding {
    /// Name in scripts.
    pub name: &'static str,
    /// Notation.
    pub form: CallSyntax,
    /// Parameters. Optional parameters come last.
    pub parameters: &'static [Parameter],
    /// Return value.
    pub returns: Returns,
    /// One-line summary.
    pub summary: &'static str,
    /// Further help text; may be empty.
    pub doc: &'static str,
    /// Runnable example.
    pub example: &'static str,
    /// Related names.
    pub see: &'static [&'static str],
    /// Native implementation.
    pub body: NativeFunction,
    /// Setter of a writable property.
    pub setter: Option<Setter>,
    /// Check for arguments at which the result is not differentiable.
    pub corner: Option<NonsmoothCheck>,
}

/// Setter of a property.
#[derive(Clone, Copy)]
pub struct Setter {
    /// Parameter of the assigned value.
    pub value: &'static [Parameter; 1],
    /// Native implementation.
    pub body: NativeFunction,
}

/// Binding of a function: `name(a, b)`.
pub const fn function(
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Function, parameters, body)
}

/// Binding of a method of one type: `receiver.name(a, b)`.
pub const fn method(
    of: Type,
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Method(of), parameters, body)
}

/// Binding of a property of one type: `receiver.name`.
pub const fn property(of: Type, name: &'static str, body: NativeFunction) -> FunctionBinding {
    FunctionBinding::new(name, CallSyntax::Property(of), &[], body)
}

/// Binding of an operator on two values. At least one of the values must have a native type.
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

    /// Sets the return value.
    pub const fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    /// Sets the summary, which is required.
    pub const fn summary(mut self, summary: &'static str) -> Self {
        self.summary = summary;
        self
    }

    /// Sets the help text.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// Sets the example, which is required.
    pub const fn example(mut self, example: &'static str) -> Self {
        self.example = example;
        self
    }

    /// Sets related names.
    pub const fn with_related(mut self, see: &'static [&'static str]) -> Self {
        self.see = see;
        self
    }

    /// Makes the property writable.
    pub const fn writable(mut self, value: &'static [Parameter; 1], body: NativeFunction) -> Self {
        self.setter = Some(Setter { value, body });
        self
    }

    /// Sets the check for arguments at which the result is not differentiable.
    pub const fn corner(mut self, corner: NonsmoothCheck) -> Self {
        self.corner = Some(corner);
        self
    }

    /// Number of required arguments.
    pub fn required(&self) -> usize {
        self.parameters.iter().filter(|parameter| parameter.is_required()).count()
    }

    /// Type before the dot of a method or property; `None` for functions and operators.
    pub fn receiver(&self) -> Option<Type> {
        match self.form {
            CallSyntax::Method(of) | CallSyntax::Property(of) => Some(of),
            CallSyntax::Function | CallSyntax::Operator => None,
        }
    }

    /// Signature with optional parameters in brackets, for example `line(from, to)` or `simulation.step([count])`.
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
