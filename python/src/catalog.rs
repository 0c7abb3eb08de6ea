//! Catalog of the language for Python: the module and its stubs are created from it.

use pyo3::prelude::*;
use withy::script::bindings::catalog::Catalog;
use withy::script::bindings::kind::Kind;
use withy::script::bindings::parameter::Parameter;
use withy::script::bindings::table::{CallSyntax, FunctionBinding};
use withy::script::packages::language;

use crate::names::Finders;

/// Function, method or property of the language.
#[pyclass(frozen, get_all, module = "withy._native")]
pub struct Binding {
    /// Name.
    name: &'static str,
    /// "function", "method" or "property".
    form: &'static str,
    /// Type before the dot; empty for functions.
    receiver: &'static str,
    /// Parameters.
    parameters: Vec<BindingParameter>,
    /// Type of the return value and of its elements; empty if several are possible.
    returns: Vec<&'static str>,
    /// Signature in the language.
    signature: String,
    /// Description.
    doc: String,
}

/// Parameter of a binding, or key of its options.
#[pyclass(frozen, get_all, from_py_object, module = "withy._native")]
#[derive(Clone)]
pub struct BindingParameter {
    /// Name.
    name: &'static str,
    /// Names of the accepted types.
    types: Vec<&'static str>,
    /// Keys of a map of options.
    keys: Vec<BindingParameter>,
    /// True if the parameter can be omitted.
    is_optional: bool,
    /// True if the argument can be the name of an object of the scene.
    accepts_name: bool,
    /// Dimension and description.
    doc: String,
}

/// Returns all functions, methods and properties of the language.
#[pyfunction]
pub fn bindings() -> Vec<Binding> {
    let catalog = language();
    catalog.rows().filter_map(|row| binding(&catalog, row)).collect()
}

/// Returns the native types of the language with their descriptions.
#[pyfunction]
pub fn types() -> Vec<(&'static str, &'static str)> {
    let catalog = language();
    let types = catalog.tables().flat_map(|table| table.types);
    types.map(|of| (of.name(), of.doc())).collect()
}

fn binding(catalog: &Catalog, row: &'static FunctionBinding) -> Option<Binding> {
    let form = match row.form {
        CallSyntax::Function => "function",
        CallSyntax::Method(_) => "method",
        CallSyntax::Property(_) => "property",
        CallSyntax::Operator => return None,
    };
    let kind = row.returns.kind;
    let returns = match kind.likely().type_name() {
        _ if row.returns.is_nothing() => vec!["nothing"],
        None => Vec::new(),
        Some(word) => {
            let element = kind.element().and_then(|of| of.type_name());
            [Some(word), element].into_iter().flatten().collect()
        }
    };
    let receiver = row.receiver().map_or("", |of| of.name());
    let finders = Finders::of(catalog, receiver);
    let with_names = |of: &Parameter| BindingParameter {
        accepts_name: finders.as_ref().is_some_and(|finders| finders.accept(&of.kind)),
        ..parameter(of)
    };
    let doc = format!("{} {}", row.summary, row.doc).trim_end().to_owned();
    Some(Binding {
        name: row.name,
        form,
        receiver,
        parameters: row.parameters.iter().map(with_names).collect(),
        returns,
        signature: row.signature(),
        doc,
    })
}

fn parameter(of: &Parameter) -> BindingParameter {
    let keys = match of.kind {
        Kind::Options(keys) => keys.iter().map(parameter).collect(),
        _ => Vec::new(),
    };
    let unit = if of.unit.is_empty() { String::new() } else { format!("[{}] ", of.unit) };
    BindingParameter {
        name: of.name,
        types: type_names(&of.kind),
        keys,
        is_optional: !of.is_required(),
        accepts_name: false,
        doc: format!("{unit}{}", of.doc).trim_end().to_owned(),
    }
}

fn type_names(kind: &Kind) -> Vec<&'static str> {
    match kind {
        Kind::Number(_) | Kind::Numeric => vec!["number"],
        Kind::Integer(_) => vec!["whole number"],
        Kind::Text | Kind::Name | Kind::Choice(_) => vec!["text"],
        Kind::Boolean => vec!["truth value"],
        Kind::Point | Kind::Array | Kind::Numbers | Kind::Points => vec!["array"],
        Kind::Function => vec!["function"],
        Kind::Options(_) => vec!["map"],
        Kind::Object(of) => vec![of.name()],
        Kind::Either(kinds) => kinds.iter().flat_map(type_names).collect(),
        Kind::Any => Vec::new(),
    }
}
