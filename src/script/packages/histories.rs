//! Histories: time intervals, columns, drifts.

use rhai::{Array, Dynamic, INT};

use super::recording::expect_all_rows;
use super::simulations::SPINNING;
use crate::geometry::{larger, smaller};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::parameter::{Parameter, choice, number, text};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding, method, property};
use crate::script::handles::history::HistoryHandle;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::format_number;
use crate::simulation::{History, Invariant};

pub const TABLE: BindingTable = BindingTable {
    name: "histories",
    doc: "Table with a row for each step, or as the option record selects. Columns: t, kinetic, \
        strain, potential, energy, work, momentum_x, momentum_y, impulse_x, impulse_y, \
        angular_momentum, angular_impulse, gap, dt, newton_iterations, retries. Each slider \
        adds NAME.position, NAME.speed, NAME.force, NAME.force_x and NAME.force_y, where NAME \
        is its name.",
    types: &[HISTORY],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(HISTORY, "after", &[T], |call| window(call, |call| Ok((call.number("t")?, f64::INFINITY))))
            .returns(Returns::object(HISTORY))
            .summary("Returns the rows from a time on.")
            .example("sim.run_to(1);\ncheck(sim.history.after(0.5).first(\"t\") == 0.5);")
            .with_related(&["before", "between"]),
        method(HISTORY, "before", &[T], |call| window(call, |call| Ok((f64::NEG_INFINITY, call.number("t")?))))
            .returns(Returns::object(HISTORY))
            .summary("Returns the rows up to a time.")
            .example("sim.run_to(1);\ncheck(sim.history.before(0.5).last(\"t\") == 0.5);"),
        method(HISTORY, "between", &[number("from").unit("time"), number("to").unit("time")], |call| {
            window(call, |call| Ok((call.number("from")?, call.number("to")?)))
        })
        .returns(Returns::object(HISTORY))
        .summary("Returns the rows between two times, both included.")
        .example("sim.run_to(1);\ncheck(sim.history.between(0.2, 0.4).rows == 3);"),
        method(HISTORY, "drift", &[choice("invariant", &["energy", "momentum", "angular_momentum", "gap"])], drift)
            .returns(Returns::NUMBER)
            .summary("Returns the largest change of an invariant since the first row, relative to \
                its scale.")
            .doc(
                "energy: E - W + D relative to the largest energy; momentum: p - ∫F dt and \
                angular_momentum: L - ∫M dt relative to the largest momenta that the energy \
                allows; gap: the largest gap of a joint, a length.",
            )
            .example("sim.run_to(1);\ncheck(sim.history.drift(\"energy\") < 1e-12);")
            .with_related(&["invariants"]),
        method(HISTORY, "column", &[COLUMN], |call| Ok(numbers(column(call, History::column)?)))
            .returns(Returns::NUMBERS)
            .summary("Returns the values of a column as an array.")
            .example("sim.step(4);\ncheck(sim.history.column(\"t\").len() == 5);")
            .with_related(&["averaged"]),
        method(HISTORY, "averaged", &[COLUMN], averaged)
            .returns(Returns::NUMBERS)
            .summary("Returns a column in which each value is the mean of itself and the value in \
                the row before.")
            .doc(
                "This removes alternation from step to step, as in a constraint force. Each \
                mean belongs to the middle of its step. The first value and the first value \
                after the start are unchanged, because values that belong to a step do not \
                exist at the start.",
            )
            .example("sim.step(2);\nlet h = sim.history;\ncheck(h.column(\"t\") == [0, 0.1, 0.2]);\ncheck_close(h.averaged(\"t\")[2], 0.15, 1e-14);")
            .with_related(&["column", "plot_history"]),
        statistic("first", "Returns the value of a column in the first row.", |call| pick(call, |column| column.first().copied())),
        statistic("last", "Returns the value of a column in the last row.", |call| pick(call, |column| column.last().copied())),
        statistic("largest", "Returns the largest value of a column.", |call| pick(call, |column| column.into_iter().reduce(larger))),
        statistic("smallest", "Returns the smallest value of a column.", |call| pick(call, |column| column.into_iter().reduce(smaller))),
        property(HISTORY, "rows", |call| {
            let rows = call.receiver::<HistoryHandle>()?.read(|history| history.samples().len());
            Ok(Dynamic::from(rows as INT))
        })
        .returns(Returns::INTEGER)
        .summary("Number of rows, including the start.")
        .example("sim.step(4);\ncheck(sim.history.rows == 5);"),
        property(HISTORY, "columns", |call| {
            let history = call.receiver::<HistoryHandle>()?;
            let names = history.read(|history| {
                history.columns().map(|(name, _)| Dynamic::from(name.to_owned())).collect::<Array>()
            });
            Ok(names.into())
        })
        .returns(Returns::ARRAY)
        .summary("Names of the columns: first those of every history, then those of springs, drives, \
            sliders and recorded quantities of the scene.")
        .example("check(sim.history.columns.contains(\"energy\"));")
        .with_related(&["column", "record"]),
    ],
};

pub const HISTORY: Type = Type::of::<HistoryHandle>();
const T: Parameter = number("t").unit("time");
const COLUMN: Parameter = text("column").doc("name of a column of this history");

const fn statistic(
    name: &'static str,
    summary: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    method(HISTORY, name, &[COLUMN], body)
        .returns(Returns::NUMBER)
        .summary(summary)
        .example("sim.run_to(1);\nlet h = sim.history;\ncheck(h.first(\"t\") == 0 && h.last(\"t\") == 1);\ncheck(h.largest(\"kinetic\") >= h.smallest(\"kinetic\"));")
}

fn window(
    call: &Call,
    range: fn(&Call) -> Result<(f64, f64), ScriptError>,
) -> Result<Dynamic, ScriptError> {
    let (from, to) = range(call)?;
    if to < from {
        let message = format!(
            "the interval from t = {} to {} is reversed",
            format_number(from),
            format_number(to)
        );
        return Err(call.error(message).hint("give the earlier time first"));
    }
    Ok(Dynamic::from(call.receiver::<HistoryHandle>()?.between(from, to)))
}

fn drift(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let name = call.text("invariant")?;
    let known = Invariant::ALL.iter().find(|(other, _)| *other == name.as_str());
    let (_, invariant) = known
        .ok_or_else(|| ScriptError::internal_error(format!("there is no invariant '{name}'")))?;
    let history = call.receiver::<HistoryHandle>()?;
    let drift = history.read(|rows| (!rows.samples().is_empty()).then(|| rows.drift(*invariant)));
    Ok(drift.ok_or_else(|| history.no_rows(call))?.into())
}

pub(super) fn column(
    call: &Call,
    read: fn(&History, &str) -> Option<Vec<f64>>,
) -> Result<Vec<f64>, ScriptError> {
    let history = call.receiver::<HistoryHandle>()?;
    let name = history.expect_column(call, &call.value("column")?, 0)?;
    history
        .read(|history| read(history, &name))
        .ok_or_else(|| ScriptError::internal_error(format!("the history has no column '{name}'")))
}

fn averaged(call: &mut Call) -> Result<Dynamic, ScriptError> {
    expect_all_rows(call, &call.receiver::<HistoryHandle>()?.of, "the mean of neighbouring rows")?;
    Ok(numbers(column(call, History::averaged)?))
}

fn numbers(column: Vec<f64>) -> Dynamic {
    Dynamic::from(column.into_iter().map(Dynamic::from).collect::<Array>())
}

fn pick(call: &Call, pick: fn(Vec<f64>) -> Option<f64>) -> Result<Dynamic, ScriptError> {
    let picked = pick(column(call, History::column)?);
    let history = call.receiver::<HistoryHandle>()?;
    Ok(picked.ok_or_else(|| history.no_rows(call))?.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_of_every_history_are_documented() {
        let names: Vec<_> = History::COLUMNS.iter().map(|column| column.name).collect();
        let listed = format!("Columns: {}.", names.join(", "));
        assert!(TABLE.doc.contains(&listed), "{listed}");
    }
}
