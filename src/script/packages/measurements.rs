//! Tables of measurements.

use rhai::{Array, Dynamic, Map};

use crate::analysis::ParsedCsv;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::text;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};

pub const TABLE: BindingTable = BindingTable {
    name: "measurements",
    doc: "Tables of other programs as arrays of numbers.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function("read_csv", &[text("file").doc("file name in the output folder, or in the folder of the script")], read_csv)
            .returns(Returns::MAP)
            .summary("Reads a table of numbers and returns a map of its columns by name, each an \
                array.")
            .doc("The first line has the column names, separated by commas, or by semicolons or \
                tabs; numbers of the latter may have decimal commas. Lines that begin with # and \
                a second line of dimensions, as write_csv writes it, are ignored. Every cell must \
                be a finite number.")
            .example(
                "write_csv([#{ t: 0, x: 1 }, #{ t: 0.5, x: 0.25 }], \"measured.csv\");\nlet measured = read_csv(\"measured.csv\");\ncheck(measured.x == [1, 0.25]);",
            )
            .with_related(&["fit", "write_csv"]),
    ],
};

fn read_csv(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    let at = |error: ScriptError| error.at(CallPart::Argument(0));
    let bytes = call.context().read_file(&file).map_err(at)?;
    let failure = |why: String| call.error(format!("\"{file}\": {why}")).at(CallPart::Argument(0));
    let text =
        String::from_utf8(bytes).map_err(|_| failure("the file is not UTF-8 text".into()))?;
    let sheet = ParsedCsv::parse(&text).map_err(|error| failure(error.to_string()))?;
    if sheet.is_empty() {
        return Err(failure("the file has no rows".into()));
    }
    let column = |name: &String| {
        let number = |row| sheet.number(row, name).map(Dynamic::from);
        let numbers = (0..sheet.len()).map(number).collect::<Result<Array, _>>();
        let numbers = numbers.map_err(|error| failure(error.to_string()))?;
        Ok((name.as_str().into(), numbers.into()))
    };
    Ok(sheet.columns().iter().map(column).collect::<Result<Map, ScriptError>>()?.into())
}
