//! Pictures of history columns as functions of time, and of the drift of invariants.

use rhai::Dynamic;

use super::files::write_picture;
use super::options::{
    MARKERS, X_LABEL, X_LIMITS, X_LOG, Y_LABEL, Y_LIMITS, Y_LOG, marked, with_options,
};
use super::subjects::histories_over_time;
use crate::output::{AxisScale, LineChart, Page};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, array, boolean, choice, text};
use crate::script::handles::history::HistoryHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::packages::error_estimates::{ERROR, wanted_estimate};
use crate::script::packages::recording::expect_all_rows;
use crate::script::presentation::plots::{drift_lines, line_chart};
use crate::simulation::History;

pub const COLUMNS: Parameter = array("columns").doc("names of columns of the history");
pub const HISTORY_OPTIONS: &[Parameter] = &[
    text("title").doc("title; default: the name of the simulation").optional(),
    choice("axes", &["own", "shared"])
        .or(Presence::Text("own"))
        .doc("axes of several simulations: \"own\" axes side by side, or one \"shared\" plot"),
    boolean("logarithmic").doc("true for magnitudes on a logarithmic axis").optional(),
    boolean("average")
        .doc("true to plot the mean of each value and the one before, as `averaged` returns it")
        .optional(),
    ERROR,
    X_LABEL,
    Y_LABEL,
    X_LOG,
    Y_LOG,
    X_LIMITS,
    Y_LIMITS,
    MARKERS,
];

fn write_charts(call: &Call, charts: Vec<LineChart>) -> Result<Dynamic, ScriptError> {
    let mut charts = charts;
    match charts.len() {
        1 => write_picture(call, &charts.remove(0)),
        _ => write_picture(call, &charts.into_iter().fold(Page::row(), Page::panel)),
    }
}

pub fn plot_history(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let is_asked = |name: &str| options.boolean(name).unwrap_or(false);
    let (scale, shown): (_, fn(f64) -> f64) = match is_asked("logarithmic") {
        true => (AxisScale::Logarithmic, f64::abs),
        false => (AxisScale::Linear, |value| value),
    };
    let read = if is_asked("average") { History::averaged } else { History::column };
    let histories = histories_over_time(call)?;
    if is_asked("average") {
        let whose = histories.iter().map(|history| &history.of);
        whose.into_iter().try_for_each(|of| expect_all_rows(call, of, "`average`"))?;
    }
    let names = columns(call, &histories)?;
    let title = options.optional_text("title")?;
    let values = |history: &History, name: &str| {
        read(history, name).map(|values| values.into_iter().map(shown).collect())
    };
    let chart = |of: &HistoryHandle| {
        let title = title.clone().unwrap_or_else(|| of.of.name().to_owned());
        of.read(|history| line_chart(title, history, &names, values))
    };
    let mut charts: Vec<LineChart> = histories.iter().map(chart).collect();
    if options.text("axes")? == "shared" && charts.len() > 1 {
        let title = options.optional_text("title")?.unwrap_or_default();
        let named: Vec<String> = histories.iter().map(|of| of.of.name().to_owned()).collect();
        charts = vec![LineChart::shared(title, named.into_iter().zip(charts))];
    }
    let dress = |chart: LineChart| {
        let chart = chart.y_scale(scale).each(|at, series| marked(&options, at, series));
        with_options(&options, chart).map_err(|wrong| wrong.in_call(call))
    };
    charts = charts.into_iter().map(dress).collect::<Result<_, _>>()?;
    let is_shared = charts.len() < histories.len();
    for (number, history) in histories.iter().enumerate() {
        let Some(estimate) = wanted_estimate(call, &options, &history.of)? else { break };
        for (column, name) in names.iter().enumerate() {
            let errors = history.read(|rows| estimate.of_rows(name, rows));
            let errors = errors.map_err(|error| error.at(CallPart::Key("error".into())))?;
            let (chart, series) = match is_shared {
                true => (0, number * names.len() + column),
                false => (number, column),
            };
            charts[chart].add_band(series, &errors);
        }
    }
    write_charts(call, charts)
}

fn columns(call: &Call, histories: &[HistoryHandle]) -> Result<Vec<String>, ScriptError> {
    let columns = call.array("columns")?;
    for (history, name) in histories.iter().flat_map(|of| columns.iter().map(move |n| (of, n))) {
        history.expect_column(call, name, 1)?;
    }
    match (columns.as_slice(), histories) {
        ([], [first, ..]) => {
            let hint = format!("columns: {}", first.column_names());
            Err(call.error("no column is given").hint(hint).at(CallPart::Argument(1)))
        }
        _ => Ok(columns.iter().map(Dynamic::to_string).collect()),
    }
}

pub fn plot_drift(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let chart = |of: &HistoryHandle| of.read(|history| drift_lines(of.of.name(), history));
    write_charts(call, histories_over_time(call)?.iter().map(chart).collect())
}
