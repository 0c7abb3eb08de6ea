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
    doc: "Each is written into a file that is named by the sweep and its columns: NAME-speed-mass-peak.svg. Rows that failed are not drawn. What sweeps have, \
          their tables have too, so that some rows can be drawn: sweep.table.where(|row| row.mass < 2).plot(\"speed\", \"peak\"). Pictures of some rows \
          are numbered from 2: NAME-speed-peak-2.svg. A column of texts or other values that are no numbers cannot be drawn; truth values are 0 and 1.",
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
        text("z").doc("what is shown as colours").optional(),
    ];
    method(of, "plot", PARAMETERS, draw)
        .summary("Draws a column over another one, or as colours over two others.")
        .doc(
            "Over a parameter that goes through an array: a curve for each combination of the others, or mean, least and largest where there are more \
             than eight. Over other columns: points, of more than 2000 rows as many, drawn by lot. The axis of x is logarithmic for logspace(…) and \
             distributions of logarithms over a decade or more. With z a map: a cell for each pair of values of two such parameters, or for points twenty by twenty; \
             the mean where several runs fall into a cell, hatched where none does. Of more than 160 values along an axis neighbours are drawn as one cell, which \
             has the mean of theirs.",
        )
        .example("sweep.plot(\"speed\", \"energy\");\nsweep.plot(\"speed\", \"mass\", \"energy\");\nsweep.table.where(|row| row.mass == 2).plot(\"speed\", \"energy\");")
        .see(&["plot_matrix", "plot_histogram", "sensitivity"])
}

const fn matrix(of: Type) -> FunctionBinding {
    method(of, "plot_matrix", &[], draw_matrix)
        .summary(
            "Draws all columns of numbers, six at most, over all others, with their histograms.",
        )
        .doc("Of more than 500 rows as many are shown, drawn by lot, the same in all panels; the histograms are of all.")
        .example("sweep.plot_matrix();\nsweep.table.plot_matrix();")
        .see(&["plot"])
}

const fn histogram(of: Type) -> FunctionBinding {
    const COLUMN: &[Parameter] = &[text("column").doc("a parameter or result")];
    method(of, "plot_histogram", COLUMN, draw_histogram)
        .summary("Draws how many runs have which values of a column.")
        .doc("Of at most 64 values that come back, each has a class of its own; else classes are equally wide.")
        .example("sweep.plot_histogram(\"energy\");\nsweep.table.plot_histogram(\"energy\");")
        .see(&["plot", "plot_matrix"])
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

/// Unused file name for a picture of some rows, which must not overwrite that of all or of other rows.
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

/// Requires rows with numbers, if the run computes all rows.
fn expect_rows(call: &Call, picture: &Picture, names: &[&str]) -> Result<(), ScriptError> {
    let context = call.context();
    let is_whole = context.mode() == RunMode::Run && context.studies().part.is_none();
    if !is_whole || picture.has_rows(names) {
        return Ok(());
    }
    let (count, all) = (picture.table.length(), picture.table.sweep().design.rows);
    let hint = match count {
        0 => "no row was chosen: loosen the condition of where(…)",
        _ => "rows that failed have no results: print(sweep.failures) says why",
    };
    let told = format!("there is nothing to draw in {count} of the {all} rows of the sweep");
    Err(call.error(told).hint(hint))
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
    let told = format!("the values of \"{name}\" are no numbers: {}", few.join(", "));
    Err(call
        .error(told)
        .hint(format!(
            "over a parameter of numbers there is a curve for each of them; where(|row| row.{name} == …) has the rows of one"
        ))
        .at(CallPart::Argument(at)))
}

fn draw(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, x, y) = (table(call)?, call.text("x")?, call.text("y")?);
    let z = call.text_if_given("z")?;
    let names: Vec<&str> = [x.as_str(), y.as_str()].into_iter().chain(z.as_deref()).collect();
    expect_columns(call, &table, &names)?;
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
    expect_rows(call, &picture, &names)?;
    let drawn = match &z {
        None => picture.over(&x, &y).map(|chart| chart.figure()),
        Some(z) => picture.map(&x, &y, z).map(|map| map.figure()),
    };
    let drawn = drawn.ok_or_else(|| ScriptError::bug("a column of a sweep is lost"))?;
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
