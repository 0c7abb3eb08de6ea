//! Expressions of calls from Python, whose arguments are the variables `a0`, `a1`, ….

use withy::script::bindings::catalog::Catalog;
use withy::script::bindings::kind::Kind;
use withy::script::bindings::table::FunctionBinding;
use withy::script::packages::language;

use crate::value::Value;

/// Call of a function.
pub fn function(name: &str, arguments: &[Value]) -> String {
    format!("{name}({})", variables(0..arguments.len()))
}

/// Call of a method of the first value. A text where the method requires a beam, a station or another named object of the scene
/// is the name of that object.
pub fn method(name: &str, values: &[Value]) -> String {
    let catalog = language();
    let receiver = match values.first() {
        Some(Value::Object(reference)) => reference.type_name.as_str(),
        _ => "",
    };
    let members = catalog.members(receiver);
    let row = members.iter().find(|row| row.name == name);
    let scene = match receiver {
        "scene" => Some("a0"),
        _ => members.iter().any(|row| row.name == "scene").then_some("a0.scene"),
    };
    let argument = |index: usize| {
        let is_text = matches!(values[index], Value::Text(_));
        let finder = row.filter(|_| is_text).and_then(|row| finder(&catalog, row, index - 1));
        match (scene, finder) {
            (Some(scene), Some(finder)) => format!("{scene}.{finder}(a{index})"),
            _ => format!("a{index}"),
        }
    };
    let arguments: Vec<String> = (1..values.len()).map(argument).collect();
    format!("a0.{name}({})", arguments.join(", "))
}

/// Method of scenes that finds the object for a parameter by its name, such as `beam_named`.
fn finder(catalog: &Catalog, row: &FunctionBinding, parameter: usize) -> Option<&'static str> {
    let Kind::Object(of) = row.parameters.get(parameter)?.kind else { return None };
    let finders = catalog.members("scene").into_iter();
    let mut finders = finders.filter_map(|row| Some((row.name, row.name.strip_suffix("_named")?)));
    finders.find(|(_, object)| of.name().ends_with(object)).map(|(name, _)| name)
}

fn variables(numbers: std::ops::Range<usize>) -> String {
    numbers.map(|number| format!("a{number}")).collect::<Vec<_>>().join(", ")
}
