//! Calls from Python as text of the language. The arguments are the variables `a0`, `a1`, ….

use withy::script::packages::language;

use crate::names::Finders;
use crate::value::Value;

/// Call of a function.
pub fn function(name: &str, arguments: &[Value]) -> String {
    format!("{name}({})", variables(0..arguments.len()))
}

/// Call of a method of the first value. A text where the method requires a beam, a station or another named object of the scene
/// is the name of that object.
pub fn method(name: &str, values: &[Value]) -> String {
    let call = format!("a0.{name}({})", variables(1..values.len()));
    let has_texts = values.iter().skip(1).any(|value| matches!(value, Value::Text(_)));
    let replaced = match values.first() {
        Some(Value::Object(of)) if has_texts => names_replaced(name, &of.type_name, values),
        _ => String::new(),
    };
    format!("{replaced}{call}")
}

fn names_replaced(name: &str, receiver: &str, values: &[Value]) -> String {
    let catalog = language();
    let row = catalog.members(receiver).into_iter().find(|row| row.name == name);
    let (Some(row), Some(finders)) = (row, Finders::of(&catalog, receiver)) else {
        return String::new();
    };
    let arguments = row.parameters.iter().zip(values.iter().enumerate().skip(1));
    let texts = arguments.filter(|(_, (_, value))| matches!(value, Value::Text(_)));
    texts.map(|(of, (index, _))| finders.statement(&of.kind, &format!("a{index}"))).collect()
}

fn variables(numbers: std::ops::Range<usize>) -> String {
    numbers.map(|number| format!("a{number}")).collect::<Vec<_>>().join(", ")
}
