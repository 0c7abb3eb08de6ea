//! Pictures of sweeps.

use rhai::Dynamic;

use super::sweeps::{SETUP, SWEEP, SWEEP_TABLE, SweepHandle, no_column};
use crate::analysis::{SweepColumn, SweptValues};
use crate::output::Panel;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::parameter::{Parameter, text};
use crate::script::bindings::table::{BindingTable, FunctionBinding, method};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::state::settings::RunMode;
use crate::script::studies::sweeps::pictures::{MOST_COLUMNS, Picture};
use crate::script::studies::sweeps::table::SweepTable;

pub const TABLE: BindingTable = BindingTable {
    name: "pictures of sweeps",
    doc: "Pictures of sweeps. The file name consists of the sweep and the columns: \
        NAME-speed-mass-peak.svg. Failed rows are omitted. Tables of sweeps have the same \
        functions, so that selected rows can be plotted: sweep.table.where(|row| row.mass < \
        2).plot(\"speed\", \"peak\"). Pictures of selected rows are numbered from 2: \
        NAME-speed-peak-2.svg. Columns of texts or other values that are not numbers cannot be \
        plotted; booleans are 0 and 1.",
    types: &[],
    setup: SETUP,
    constants: &[],
    rows: &[
        plot(SWEEP),
        plot(SWEEP_TABLE),
        matrix(SWEEP),
        matrix(SWEEP_TABLE),
        histogram(SWEEP),
        histogram(SWEEP_TABLE),
    ],
};

const fn plot(of: Type) -> FunctionBinding {
    const PARAMETERS: &[Parameter] = &[
        text("x").doc("a parameter or result"),
        text("y").doc("a parameter or result"),
        text("z").doc("parameter or result shown as colours").optional(),
    ];
    method(of, "plot", PARAMETERS, draw)
        .summary("Plots a column over another one, or as colours over two others.")
        .doc(
            "Over a parameter given by an array: a curve for each combination of the other \
            parameters, or mean, minimum and maximum if there are more than eight. Over other \
            columns: points, at most 2000, selected at random. The axis of x is logarithmic \
            for logspace(…) and for logarithmic distributions over a decade or more. With z: a \
            map with a cell for each pair of values of two such parameters, or 20 × 20 cells \
            for points; a cell with several runs shows their mean, and an empty cell is \
            hatched. Of more than 160 values along an axis, neighbours are combined into one \
            cell with their mean.",
        )
        .example("sweep.plot(\"speed\", \"energy\");\nsweep.plot(\"speed\", \"mass\", \"energy\");\nsweep.table.where(|row| row.mass == 2).plot(\"speed\", \"energy\");")
        .with_related(&["plot_matrix", "plot_histogram", "sensitivity"])
}

const fn matrix(of: Type) -> FunctionBinding {
    method(of, "plot_matrix", &[], draw_matrix)
        .summary("Plots up to six numeric columns over each other, with their histograms.")
        .doc(
            "At most 500 rows are shown, selected at random and the same in all panels; the \
            histograms contain all rows.",
        )
        .example("sweep.plot_matrix();\nsweep.table.plot_matrix();")
        .with_related(&["plot"])
}

const fn histogram(of: Type) -> FunctionBinding {
    const COLUMN: &[Parameter] = &[text("column").doc("a parameter or result")];
    method(of, "plot_histogram", COLUMN, draw_histogram)
        .summary("Plots a histogram of a column.")
        .doc(
            "A column with at most 64 different, repeated values has a class for each value; \
            otherwise classes have equal width.",
        )
        .example("sweep.plot_histogram(\"energy\");\nsweep.table.plot_histogram(\"energy\");")
        .with_related(&["plot", "plot_matrix"])
}

fn table(call: &Call) -> Result<SweepTable, ScriptError> {
    let handle = call.receiver::<SweepHandle>();
    handle.map(SweepHandle::table).or_else(|_| call.receiver::<SweepTable>())
}

fn write(
    call: &Call,
    table: &SweepTable,
    columns: &[&str],
    picture: &str,
) -> Result<Dynamic, ScriptError> {
    let parts = [table.sweep().name.as_str()].into_iter().chain(columns.iter().copied());
    let name = parts.map(|part| part.replace('/', " ")).collect::<Vec<_>>().join("-");
    let file = match table.is_of_some_rows() {
        false => format!("{name}.svg"),
        true => numbered(call, &name)?,
    };
    call.context().write_file(&file, picture.as_bytes())?;
    Ok(Dynamic::UNIT)
}

/// Unused file name for a picture of some rows, so that pictures of other rows are not overwritten.
fn numbered(call: &Call, name: &str) -> Result<String, ScriptError> {
    let output = call.context().output();
    let written = output.written();
    let mut number = 2;
    loop {
        let file = format!("{name}-{number}.svg");
        if !written.contains(&output.path_of(&file)?) {
            return Ok(file);
        }
        number += 1;
    }
}

fn expect_rows(call: &Call, picture: &Picture, names: &[&str]) -> Result<(), ScriptError> {
    let context = call.context();
    let is_whole = context.mode() == RunMode::Run && context.studies().part.is_none();
    if !is_whole || picture.has_rows(names) {
        return Ok(());
    }
    let (count, all) = (picture.table.length(), picture.table.sweep().design.rows);
    let hint = match count {
        0 => "no row was selected: change the condition of where(…)",
        _ => "failed rows have no results: print(sweep.failures) shows the reasons",
    };
    let message =
        format!("{count} of the {all} rows of the sweep are selected, and none can be plotted");
    Err(call.error(message).hint(hint))
}

fn expect_columns(call: &Call, table: &SweepTable, names: &[&str]) -> Result<(), ScriptError> {
    let missing = names.iter().position(|name| table.sweep().column(name).is_none());
    if let Some(at) = missing {
        return Err(no_column(call, table.sweep(), (names[at], at)));
    }
    let words = |name: &&str| match table.sweep().column(name)? {
        SweepColumn::Parameter(SweptValues::Levels { labels, numbers: None, .. }) => Some(labels),
        _ => None,
    };
    let Some((at, labels)) =
        names.iter().map(words).enumerate().find_map(|(at, of)| Some((at, of?)))
    else {
        return Ok(());
    };
    let name = names[at];
    let few: Vec<&str> = labels.iter().take(3).map(String::as_str).collect();
    let message = format!("\"{name}\" has values that are not numbers: {}", few.join(", "));
    Err(call
        .error(message)
        .hint(format!(
            "plot over a numeric parameter for one curve per value, or select the rows of one \
            value with where(|row| row.{name} == …)"
        ))
        .at(CallPart::Argument(at)))
}

fn draw(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, x, y) = (table(call)?, call.text("x")?, call.text("y")?);
    let z = call.optional_text("z")?;
    let names: Vec<&str> = [x.as_str(), y.as_str()].into_iter().chain(z.as_deref()).collect();
    expect_columns(call, &table, &names)?;
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
    expect_rows(call, &picture, &names)?;
    let drawn = match &z {
        None => picture.over(&x, &y).map(|chart| chart.figure()),
        Some(z) => picture.map(&x, &y, z).map(|map| map.figure()),
    };
    let drawn = drawn.ok_or_else(|| ScriptError::internal_error("a column of a sweep is lost"))?;
    write(call, &table, &names, &drawn?.to_svg()?)
}

fn draw_matrix(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let table = table(call)?;
    let is_number =
        |name: &&str| table.numbers(name).is_some_and(|all| all.iter().any(|x| x.is_finite()));
    let names: Vec<&str> = table.sweep().names().filter(is_number).take(MOST_COLUMNS).collect();
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
    expect_rows(call, &picture, &names)?;
    let svg = picture.matrix(&names).figure()?.to_svg()?;
    write(call, &table, &["matrix"], &svg)
}

fn draw_histogram(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, column) = (table(call)?, call.text("column")?);
    expect_columns(call, &table, &[&column])?;
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
    expect_rows(call, &picture, &[&column])?;
    let svg = picture.histogram(&column).figure()?.to_svg()?;
    write(call, &table, &[&column, "histogram"], &svg)
}
