//! Formatting of numbers with a given number of digits, and text tables.

use rhai::{Array, Dynamic};

use crate::output::{Cell, TextTable};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, array, integer, number};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{format_fixed, format_scientific};

pub const TABLE: BindingTable = BindingTable {
    name: "text",
    doc: "Formatting of numbers and tables. By default numbers print with as many digits as \
        needed: 0.05, 3, 1e-12.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function("sci", &[X, DIGITS.or(Presence::Integer(2))], |call| write(call, format_scientific))
            .returns(Returns::TEXT)
            .summary("Formats a number with an exponent; default: two digits after the decimal \
                point.")
            .example("check(sci(1.234e-13) == \"1.23e-13\");\ncheck(sci(1250, 1) == \"1.2e3\");")
            .with_related(&["fixed"]),
        function("fixed", &[X, DIGITS.or(Presence::Integer(3))], |call| write(call, format_fixed))
            .returns(Returns::TEXT)
            .summary("Formats a number with a fixed number of digits after the decimal point; \
                default: three.")
            .example("check(fixed(0.05) == \"0.050\");\ncheck(fixed(PI, 1) == \"3.1\");")
            .with_related(&["sci", "round_to", "tabulate"]),
        function("tabulate", &[array("headings"), array("rows").doc("arrays of numbers, texts or other printable values")], tabulate)
            .returns(Returns::TEXT)
            .summary("Formats a table with aligned columns: texts to the left, numbers to the right.")
            .example("print(tabulate([\"rule\", \"drift\"], [[\"conserving\", sci(2e-14)], [\"exact\", sci(3e-4)]]));")
            .with_related(&["sci", "fixed"]),
    ],
};

const X: Parameter = number("x").allow_non_finite();
const DIGITS: Parameter =
    integer("digits").between(0.0, 17.0).doc("digits after the decimal point");

fn write(call: &Call, format: fn(f64, usize) -> String) -> Result<Dynamic, ScriptError> {
    Ok(format(call.number("x")?, call.count("digits")?).into())
}

fn tabulate(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let words = |cell: &Dynamic| {
        let text = cell.clone().into_immutable_string().map(|text| text.to_string());
        text.unwrap_or_else(|_| call.show(cell))
    };
    let headings: Vec<String> = call.array("headings")?.iter().map(words).collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut table = TextTable::new(&headings);
    for (number, row) in call.array("rows")?.into_iter().enumerate() {
        let row = row.try_cast::<Array>().filter(|row| row.len() == headings.len());
        let row = row.ok_or_else(|| {
            let message = format!("row {number} is not an array of {} cells", headings.len());
            call.error(message).hint("give one cell for each heading").at(CallPart::Argument(1))
        })?;
        table.row(row.iter().map(|cell| {
            let text = words(cell);
            if text.parse::<f64>().is_ok() { Cell::Number(text) } else { Cell::Text(text) }
        }));
    }
    Ok(table.to_string().trim_end().into())
}
