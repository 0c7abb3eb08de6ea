//! Help within the language.

use rhai::Dynamic;

use super::language;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::of_any_type;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::help::lookup::{WIDTH, page};
use crate::script::messages::error::{CallPart, ScriptError};

pub const TABLE: BindingTable = BindingTable {
    name: "help",
    doc: "Help on names of the language. The same pages are in docs/language.md, and shown by \
        withy docs NAME.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[function(
        "help",
        &[of_any_type("name")
            .doc("a name in quotes, or a value whose type is explained")
            .optional()],
        help,
    )
    .summary("Prints the help on a name, with an example; without a name an overview.")
    .doc(
        "The name may be that of a function, a method (sim.run_to or simulation.run_to), a \
            type, an option, a constant, a heading of this reference, or a word of the \
            language such as for.",
    )
    .example("help(\"section\");\nhelp(\"simulation.run_to\");\nhelp(vec(1, 2));\nhelp();")],
};

fn help(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let name = match call.value("name") {
        Err(_) => String::new(),
        Ok(value) if value.is_string() => value.to_string(),
        Ok(value) => call.type_of(&value),
    };
    let page = page(&language(), &name)
        .map_err(|unknown| call.error(&unknown).hint(unknown.hint()).at(CallPart::Argument(0)))?;
    call.context().print(page.plain(WIDTH).trim_end());
    Ok(Dynamic::UNIT)
}
