//! Options of functions that a script defines itself, refused as those of the language are.

use rhai::{Dynamic, Map};

use crate::script::call::Call;
use crate::script::error::{Place, ScriptError};
use crate::script::parameter::{anything, array, text};
use crate::script::suggest::nearest;
use crate::script::table::{Table, function};

/// Options of a script's own functions.
pub const TABLE: Table = Table {
    name: "options of functions",
    doc: "What a function of a script needs to take a map of options as the functions of withy do.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[function(
        "read_options",
        &[
            text("owner").doc("the name of the function that takes the options, for messages"),
            anything("options").doc("what it was given: a map"),
            array("required").doc("the names of those that must be given"),
            anything("defaults").doc("a map of the others with what holds when they are left out"),
        ],
        read_options,
    )
    .returns("a map")
    .summary("The options of a function, those left out filled in; refused when one is unknown or missing.")
    .doc("An option without a default has the default `()`. Kinds and ranges are checked by the functions that the values are given to.")
    .example(
        "fn mast(options) {\n    let given = read_options(\"mast\", options, [\"height\"], #{ spans: 8 });\n    \
         `${given.height} with ${given.spans} spans`\n}\ncheck(mast(#{ height: 3 }) == \"3 with 8 spans\");",
    )
    .see(&["section"])],
};

fn read_options(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let owner = call.text("owner")?;
    let given = map(call, "options", &owner)?;
    let mut options = map(call, "defaults", "read_options")?;
    let required = call.array("required")?;
    let required: Vec<String> = required.iter().map(ToString::to_string).collect();
    let optional = options.keys().map(|key| key.to_string());
    let known: Vec<String> = required.iter().cloned().chain(optional).collect();
    if let Some(unknown) = given.keys().find(|name| !known.iter().any(|key| key == name.as_str())) {
        let meant = nearest(unknown, known.iter().map(String::as_str));
        let meant = meant.map(|name| format!("did you mean '{name}'? ")).unwrap_or_default();
        return Err(ScriptError::new(format!("{owner}: unknown option '{unknown}'"))
            .hint(format!("{meant}known options: {}", known.join(", ")))
            .at(Place::Key(unknown.to_string())));
    }
    if let Some(missing) = required.iter().find(|name| !given.contains_key(name.as_str())) {
        let told = format!("{owner}: the option '{missing}' is missing");
        let needed = format!("it needs {}", required.join(", "));
        return Err(ScriptError::new(told).hint(needed));
    }
    options.extend(given);
    Ok(options.into())
}

fn map(call: &Call, name: &str, owner: &str) -> Result<Map, ScriptError> {
    let value = call.value(name)?;
    value.clone().try_cast::<Map>().ok_or_else(|| {
        let told = format!("{owner}: '{name}' must be a map, got {}", call.describe(&value));
        ScriptError::new(told).hint("write #{ key: value, … }")
    })
}
