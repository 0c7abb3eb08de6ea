//! Numbers as text, with a chosen number of digits.

use rhai::Dynamic;

use crate::script::call::Call;
use crate::script::error::ScriptError;
use crate::script::numbers::{format_fixed, format_scientific};
use crate::script::parameter::{Parameter, Presence, number, whole};
use crate::script::table::{Table, function};

/// Formats for numbers.
pub const TABLE: Table = Table {
    name: "text",
    doc: "Numbers print with as many digits as they need: 0.05, 3, 1e-12. These functions choose the digits.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function("sci", &[X, DIGITS.or(Presence::Whole(2))], |call| write(call, format_scientific))
            .returns("a text")
            .summary("A number with an exponent; two digits after the point unless told otherwise.")
            .example("check(sci(1.234e-13) == \"1.23e-13\");\ncheck(sci(1250, 1) == \"1.2e3\");")
            .see(&["fixed"]),
        function("fixed", &[X, DIGITS.or(Presence::Whole(3))], |call| write(call, format_fixed))
            .returns("a text")
            .summary("A number with a fixed count of digits after the point; three unless told otherwise.")
            .example("check(fixed(0.05) == \"0.050\");\ncheck(fixed(PI, 1) == \"3.1\");")
            .see(&["sci", "round_to"]),
    ],
};

const X: Parameter = number("x").any_number();
const DIGITS: Parameter = whole("digits").between(0.0, 17.0).doc("digits after the point");

fn write(call: &Call, format: fn(f64, usize) -> String) -> Result<Dynamic, ScriptError> {
    Ok(format(call.number("x")?, call.count("digits")?).into())
}
