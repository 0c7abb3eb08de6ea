//! Sweeps: calls of a function for many combinations of parameter values.

use std::rc::Rc;
use std::time::Duration;

use rhai::{Array, Dynamic, FnPtr, Map};

use super::samples::SAMPLES;
use crate::analysis::{RowLayout, Sweep, SweepResults};
use crate::sampling::VarianceShare;
use crate::script::bindings::arguments::Arguments;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::option_set::{FromOption, option_set};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, callback, name, number, object, of_any_type, options, text,
};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, method, property};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::script::state::settings::RunMode;
use crate::script::studies::calls::function::RunFunction;
use crate::script::studies::case_runner::print_table;
use crate::script::studies::plan::{at_key, study_name};
use crate::script::studies::sweeps::design::{Samples, SweepPlan};
use crate::script::studies::sweeps::rows::{RowOutcome, found};
use crate::script::studies::sweeps::run::SweepRequest;
use crate::script::studies::sweeps::table::{FAILURE, FinishedSweep, SweepTable};

pub const TABLE: BindingTable = BindingTable {
    name: "sweeps",
    doc: "Sweeps call a function with many values of parameters on all cores and collect the \
        results in a table. withy study FILE saves finished runs when it is interrupted, and \
        continues from them the next time.",
    types: &[SWEEP, SWEEP_TABLE],
    setup: SETUP,
    constants: &[],
    rows: &[
        function("study_sweep", &[options("options", KEYS)], study)
            .returns(Returns::object(SWEEP))
            .summary("Calls a function with all combinations of parameters, or at sampled points, on \
                all cores, and returns a table of the results.")
            .doc(
                "`parameters` are arrays, of which all combinations are used (a grid; the \
                alphabetically last name varies fastest), or with `samples` distributions and \
                arrays, whose values are equally likely. `run` is a function of a map of the \
                values that returns a map of numbers and booleans (stored as 1 and 0), with \
                the same names in all runs. An exception, a result that is not finite or a \
                failed check makes a failed row with this reason; other rows are not affected. \
                Runs are made in other threads, with the functions and imports of the script, \
                but without its statements. The function may use numbers, texts, arrays, maps, \
                vectors, functions, sections, meshes, curves, integrators and schedules from \
                outside; each run starts with their original values. It prints nothing and \
                writes no files. The table does not depend on the number of cores. At the \
                prompt all runs are made on one core. A summary is printed, and the table is \
                written to NAME.csv.",
            )
            .example(
                "let sweep = study_sweep(#{\n    name: \"throw\", parameters: #{ angle: linspace(0.2, 1.4, 7), speed: [5, 10] },\n    \
                 run: |p| #{ range: p.speed ** 2 * sin(2 * p.angle) / 9.81 },\n});\n\
                 check(sweep.table.count == 14);\ncheck_close(max(sweep.table.column(\"range\")), 100 / 9.81, 0.01);",
            )
            .with_related(&["latin_hypercube", "sobol", "sensitivity", "study_stability"]),
        property(SWEEP, "table", |call| Ok(Dynamic::from(table_of(call)?)))
            .returns(Returns::object(SWEEP_TABLE))
            .summary("Table of all rows: parameters, results, and the reasons of failed runs.")
            .example("print(sweep.table);\ncheck(sweep.table.rows[5].energy == 9);"),
        property(SWEEP, "failures", |call| Ok(Dynamic::from(table_of(call)?.failures())))
            .returns(Returns::object(SWEEP_TABLE))
            .summary("Table of the failed rows, with their reasons.")
            .example("check(sweep.failures.count == 0);")
            .with_related(&["where"]),
        method(SWEEP, "sensitivity", &[RESULT], sensitivity)
            .returns(Returns::array_of(&ValueKind::Map))
            .summary("Returns the share of the variance of a result that each parameter explains \
                (Sobol' indices), in descending order.")
            .doc(
                "An array with a map for each parameter: parameter, first (main effect: \
                variance of the mean over all other parameters, as a fraction of the total \
                variance) and total (including interactions; () if the points do not allow \
                it). For a grid of equally likely values the indices are exact; for saltelli(…) they are estimated by \
                the formulas of M. J. W. Jansen (Computer Physics Communications 117 (1999) \
                35-43); for other points only first is estimated, from groups of neighbours. \
                Estimates from N blocks or points have an uncertainty of about 1/√N: at least \
                30 are required, and thousands resolve small shares. The number of rows \
                omitted because of failed runs is reported. Parameters must be independent, as \
                those of sweeps are.",
            )
            .example("let main = sweep.sensitivity(\"energy\")[0];\ncheck(main.parameter == \"speed\" && main.first < main.total);")
            .with_related(&["saltelli", "study_sweep"]),
        method(SWEEP_TABLE, "where", &[callback("condition").doc("|row| …, true or false")], rows_where)
            .returns(Returns::object(SWEEP_TABLE))
            .summary("Returns the rows for which a function of the row, a map, returns true; failed \
                rows have a `failure` and no results.")
            .example("check(sweep.table.where(|row| row.mass == 2 && row.energy > 2).count == 2);")
            .with_related(&["failures", "column"]),
        method(SWEEP_TABLE, "column", &[text("name")], |call| {
            let (table, name) = (call.receiver::<SweepTable>()?, call.text("name")?);
            let numbers = table.numbers(&name).ok_or_else(|| no_column(call, table.sweep(), (&name, 0)))?;
            Ok(numbers.into_iter().map(Dynamic::from).collect::<Array>().into())
        })
        .returns(Returns::NUMBERS)
        .summary("Returns a parameter or result of all rows as numbers; NaN in failed rows and where \
            the value is not a number.")
        .example("check(sweep.table.column(\"energy\") == [0.5, 2, 4.5, 1, 4, 9]);"),
        property(SWEEP_TABLE, "rows", |call| {
            let table = call.receiver::<SweepTable>()?;
            call.context().expect_room("the rows of the sweep as maps", table.length() as u64 * BYTES_OF_A_ROW)?;
            Ok(table.rows().map(|row| table.row(row).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("Array with a map for each row: parameters and results, or `failure` for a failed \
            run.")
        .example("for row in sweep.table.rows { check(row.energy == row.mass * row.speed ** 2 / 2); }"),
        property(SWEEP_TABLE, "count", |call| Ok((call.receiver::<SweepTable>()?.length() as i64).into()))
            .returns(Returns::INTEGER)
            .summary("Number of rows.")
            .example("check(sweep.table.count == 6);"),
    ],
};

pub(super) const SETUP: &str = "let sweep = study_sweep(#{\n    name: \"first\", parameters: #{ speed: [1, 2, 3], mass: [1, 2] },\n    \
            run: |p| #{ energy: p.mass * p.speed ** 2 / 2 },\n});";
pub(super) const SWEEP: Type = Type::of::<SweepHandle>();
pub(super) const SWEEP_TABLE: Type = Type::of::<SweepTable>();
const RESULT: Parameter = text("result").doc("name of a result of the runs");
const KEYS: &[Parameter] = SweepOptions::KEYS;
const BYTES_OF_A_ROW: u64 = 500;

option_set! {
    pub struct SweepOptions {
        name: String = name("name").doc("name of the study and its files"),
        parameters: Dynamic = of_any_type("parameters").doc("names with values or distributions: #{ speed: linspace(0.1, 2, 20), mass: [1, 2] }"),
        run: FnPtr = callback("run").doc("|p| …, a function of the values of a row that returns a map of numbers"),
        samples: Option<Samples> = object("samples", SAMPLES).doc("sampling plan in place of a grid: latin_hypercube(2000), sobol(4096), \
            saltelli(1024)").optional(),
        time_limit: f64 = number("time_limit").positive().unit("s").or(Presence::Number(600.0)).doc("longest time of a run by the clock"),
    }
}

impl FromOption for Samples {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        options.get(key)
    }
}

#[derive(Clone)]
pub(super) struct SweepHandle(Rc<FinishedSweep>);

impl SweepHandle {
    pub(super) fn table(self) -> SweepTable {
        SweepTable::new(self.0)
    }
}

impl Scripted for SweepHandle {
    const NAME: &'static str = "sweep";
    const DOC: &'static str = "Results of a function for many values of its parameters.";

    fn show(&self) -> String {
        let Sweep { name, design, results } = &self.0.sweep;
        let finished = design.rows - results.failures().len();
        format!("sweep '{name}': {finished} of {} runs finished", design.rows)
    }

    fn details(&self) -> Details {
        let sweep = &self.0.sweep;
        let parameters: Vec<&str> =
            sweep.design.parameters.iter().map(|of| of.name.as_str()).collect();
        vec![
            ("parameters".to_owned(), parameters.join(", ")),
            ("results".to_owned(), sweep.results.names.join(", ")),
        ]
    }
}

impl Scripted for SweepTable {
    const NAME: &'static str = "sweep table";
    const DOC: &'static str = "Rows of a sweep: parameters, results, and reasons of failed runs.";

    fn show(&self) -> String {
        self.text()
    }
}

fn table_of(call: &Call) -> Result<SweepTable, ScriptError> {
    Ok(call.receiver::<SweepHandle>()?.table())
}

pub(super) fn no_column(
    call: &Call,
    sweep: &Sweep,
    (name, argument): (&str, usize),
) -> ScriptError {
    let meant = nearest(name, sweep.names());
    let meant = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
    let names: Vec<&str> = sweep.names().collect();
    call.error(format!("the sweep '{}' has no column \"{name}\"", sweep.name))
        .hint(format!("{meant}it has {}", names.join(", ")))
        .at(CallPart::Argument(argument))
}

fn study(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let given: Options = call.options("options")?;
    let options = SweepOptions::of(&given)?;
    let Some(parameters) = options.parameters.read_lock::<Map>().map(|map| map.clone()) else {
        let message = format!("parameters are {}", call.describe(&options.parameters));
        return Err(at_key(
            call,
            "parameters",
            message,
            "for example parameters: #{ speed: linspace(0.1, 2, 20) }",
        ));
    };
    call.expect_arguments(
        &options.run,
        1,
        "run: |p| …, a function of the map of the values of a row",
    )?;
    let plan = SweepPlan::read(call, &parameters, options.samples)?;
    let names = plan.design.parameters.iter().map(|of| of.name.as_str());
    if let Some(unread) = names.clone().find(|name| *name == FAILURE) {
        return Err(at_key(
            call,
            "parameters",
            format!("'{unread}' is not allowed as the name of a parameter"),
            "choose another name: this key holds the reason of a failed row",
        ));
    }
    RunFunction::expect_read(call, ("run", &options.run), names)?;
    let context = call.context();
    let name = study_name(call, &options.name)?;
    context.output().path_of(&format!("{name}.csv"))?;
    let wall = Duration::from_secs_f64(options.time_limit.min(1e9));
    let order = SweepRequest { name, plan, function: &options.run, wall };
    let swept = match context.mode() {
        RunMode::DryRun => dry_run(call, order)?,
        RunMode::Run => order.run(call)?,
    };
    expect_other_names(call, &swept.sweep)?;
    print_table(context, &swept.summary());
    let table = SweepTable::new(Rc::new(swept));
    let name = format!("{}.csv", table.sweep().name);
    context.write_file_by(&name, |file| table.write_csv(file))?;
    Ok(Dynamic::from(SweepHandle(table.into_swept())))
}

/// Rejects a result with the name of a parameter or of the column of failures, because they are columns of the same table.
fn expect_other_names(call: &Call, sweep: &Sweep) -> Result<(), ScriptError> {
    let own = |name: &&String| sweep.design.parameters.iter().any(|of| of.name == **name);
    let wrong = sweep.results.names.iter().find(|name| own(name) || *name == FAILURE);
    wrong.map_or(Ok(()), |name| {
        let message =
            format!("run: the name '{name}' of a result is already a column of the table");
        Err(at_key(
            call,
            "run",
            message,
            "choose another name: parameters and results share one table",
        ))
    })
}

/// Result of a dry run, in which the function is called for the first row only, and all rows get its results.
fn dry_run(call: &Call, order: SweepRequest) -> Result<FinishedSweep, ScriptError> {
    RunFunction::read(call, "run", order.function)?;
    let given = order.invoked(call, 0)?;
    let (names, values) = match found(&given) {
        RowOutcome::Computed(names, values) => (names.to_vec(), values),
        RowOutcome::Failed(_) => (
            given
                .read_lock::<Map>()
                .map(|map| map.keys().map(ToString::to_string).collect())
                .unwrap_or_default(),
            Vec::new(),
        ),
        RowOutcome::Wrong(message) => {
            let hint = "its last expression must be a map of numbers: #{ peak: peak }";
            return Err(at_key(call, "run", format!("run: {message}"), hint));
        }
    };
    let SweepRequest { name, plan, .. } = order;
    let rows = plan.design.rows;
    let mut results = SweepResults::default();
    let values = if values.is_empty() { vec![0.0; names.len()] } else { values };
    results.begin(names, rows);
    (0..rows).for_each(|row| results.find(row, &values));
    let sweep = Sweep { name, design: plan.design.clone(), results };
    Ok(FinishedSweep { sweep, plan })
}

fn sensitivity(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, result) = (call.receiver::<SweepHandle>()?, call.text("result")?);
    let sweep = &handle.0.sweep;
    if sweep.results.column(&result).is_none() {
        return Err(no_column(call, sweep, (&result, 0)));
    }
    let of = |(name, share): (&str, VarianceShare)| -> Dynamic {
        let total = share.total.map_or(Dynamic::UNIT, Dynamic::from);
        let pairs = [("parameter", name.into()), ("first", share.first.into()), ("total", total)];
        pairs.into_iter().map(|(name, value)| (name.into(), value)).collect::<Map>().into()
    };
    let names = sweep.design.parameters.iter().map(|of| of.name.as_str());
    let Some(shares) = sweep.variance_fractions(&result) else {
        // There are no results in a dry run, which computes no rows.
        if call.context().mode() == RunMode::DryRun {
            let none = VarianceShare { first: 0.0, total: Some(0.0) };
            return Ok(names.map(|name| of((name, none))).collect::<Array>().into());
        }
        let (failed, rows) = (sweep.results.failures().len(), sweep.design.rows);
        if failed > 0 && matches!(sweep.design.arrangement, RowLayout::Grid) {
            let message =
                format!("{failed} of {rows} runs failed, but all runs of a grid must finish");
            let hint = "leave out the values of the failed runs, or use sampled points: samples: \
                saltelli(1024)";
            return Err(call.error(message).hint(hint).at(CallPart::Argument(0)));
        }
        return Err(call
            .error(format!("the sensitivity of '{result}' cannot be computed from these runs"))
            .hint(
                "the result must vary; a grid must have no failed rows; at least 30 points, or \
                30 blocks of saltelli(…) without failed rows, are required; saltelli(1024) \
                gives the best estimate",
            )
            .at(CallPart::Argument(0)));
    };
    let (used, rows) = (sweep.usable_rows(&result), sweep.design.rows);
    if used < rows && call.context().mode() == RunMode::Run {
        let failed = sweep.results.failures().len();
        let message = format!(
            "note: the sensitivity of '{result}' is computed from {used} of {rows} rows: \
            {failed} failed"
        );
        let blocks = match sweep.design.arrangement {
            RowLayout::Saltelli => ", and their blocks are left out",
            RowLayout::Grid | RowLayout::Points => "",
        };
        call.context().print_message(&(message + blocks));
    }
    let mut shares: Vec<(&str, VarianceShare)> = names.zip(shares).collect();
    let size = |share: &VarianceShare| share.total.unwrap_or(share.first);
    shares.sort_by(|a, b| size(&b.1).total_cmp(&size(&a.1)));
    Ok(shares.into_iter().map(of).collect::<Array>().into())
}

fn rows_where(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (table, condition) = (call.receiver::<SweepTable>()?, call.callback("condition")?);
    call.expect_arguments(&condition, 1, "|row| row.peak > 1")?;
    let mut chosen = Vec::new();
    for row in table.rows() {
        let given = call.invoke(&condition, [table.row(row).into()])?;
        match given.as_bool() {
            Ok(true) => chosen.push(row as u32),
            Ok(false) => (),
            Err(_) => {
                let message = format!("the function returns {} for a row", call.describe(&given));
                return Err(call
                    .error(message)
                    .hint("it must return true or false: |row| row.peak > 1")
                    .at(CallPart::Argument(0)));
            }
        }
    }
    Ok(Dynamic::from(table.of_rows(chosen)))
}
