//! Pictures of sweeps.

use rhai::Dynamic;

use super::sweeps::{SETUP, SWEEP, SWEEP_TABLE, SweepHandle, no_column};
use crate::output::Panel;
use crate::script::rows::call::Call;
use crate::script::rows::kind::Type;
use crate::script::rows::parameter::{Parameter, text};
use crate::script::rows::table::{Row, Table, method};
use crate::script::studies::sweeps::pictures::{MOST_COLUMNS, Picture};
use crate::script::studies::sweeps::table::SweepTable;
use crate::script::words::error::ScriptError;

/// The domain of pictures of sweeps.
pub const TABLE: Table = Table {
    name: "pictures of sweeps",
    doc: "Each is written into a file that is named by the sweep and its columns: NAME-speed-mass-peak.svg. Rows that failed are not drawn. What sweeps have, \
          their tables have too, so that some rows can be drawn: sweep.table.where(|row| row.mass < 2).plot(\"speed\", \"peak\").",
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

const fn plot(of: Type) -> Row {
    const PARAMETERS: &[Parameter] = &[
        text("x").doc("a parameter or result"),
        text("y").doc("a parameter or result"),
        text("z").doc("what is shown as colours").optional(),
    ];
    method(of, "plot", PARAMETERS, draw)
        .summary("Draws a column over another one, or as colours over two others.")
        .doc(
            "Over a parameter that goes through an array: a curve for each combination of the others, or mean, least and largest where there are more \
             than eight. Over other columns: points. With z a map: a cell for each pair of values of two such parameters, or for points twenty by twenty; \
             the mean where several runs fall into a cell, hatched where none does.",
        )
        .example("sweep.plot(\"speed\", \"energy\");\nsweep.plot(\"speed\", \"mass\", \"energy\");\nsweep.table.where(|row| row.mass == 2).plot(\"speed\", \"energy\");")
        .see(&["plot_matrix", "plot_histogram", "sensitivity"])
}

const fn matrix(of: Type) -> Row {
    method(of, "plot_matrix", &[], draw_matrix)
        .summary(
            "Draws all columns of numbers, six at most, over all others, with their histograms.",
        )
        .example("sweep.plot_matrix();\nsweep.table.plot_matrix();")
        .see(&["plot"])
}

const fn histogram(of: Type) -> Row {
    const COLUMN: &[Parameter] = &[text("column").doc("a parameter or result")];
    method(of, "plot_histogram", COLUMN, draw_histogram)
        .summary("Draws how many runs have which values of a column.")
        .example("sweep.plot_histogram(\"energy\");\nsweep.table.plot_histogram(\"energy\");")
        .see(&["plot", "plot_matrix"])
}

fn table(call: &Call) -> Result<SweepTable, ScriptError> {
    let handle = call.receiver::<SweepHandle>();
    handle.map(SweepHandle::table).or_else(|_| call.receiver::<SweepTable>())
}

/// Writes a picture into a file that is named by the sweep and its columns.
fn write(
    call: &Call,
    table: &SweepTable,
    columns: &[&str],
    picture: &str,
) -> Result<Dynamic, ScriptError> {
    let parts = [table.sweep().name.as_str()].into_iter().chain(columns.iter().copied());
    let name = parts.map(|part| part.replace('/', " ")).collect::<Vec<_>>().join("-");
    call.context().write_file(&format!("{name}.svg"), picture.as_bytes())?;
    Ok(Dynamic::UNIT)
}

fn expect_columns(call: &Call, table: &SweepTable, names: &[&str]) -> Result<(), ScriptError> {
    let missing = names.iter().position(|name| table.sweep().column(name).is_none());
    missing.map_or(Ok(()), |at| Err(no_column(call, table.sweep(), (names[at], at))))
}

fn draw(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, x, y) = (table(call)?, call.text("x")?, call.text("y")?);
    let z = call.text_if_given("z")?;
    let names: Vec<&str> = [x.as_str(), y.as_str()].into_iter().chain(z.as_deref()).collect();
    expect_columns(call, &table, &names)?;
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
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
    let svg = picture.matrix(&names).figure()?.to_svg()?;
    write(call, &table, &["matrix"], &svg)
}

fn draw_histogram(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, column) = (table(call)?, call.text("column")?);
    expect_columns(call, &table, &[&column])?;
    let picture = Picture { table: &table, title: table.sweep().name.clone() };
    let svg = picture.histogram(&column).figure()?.to_svg()?;
    write(call, &table, &[&column, "histogram"], &svg)
}
