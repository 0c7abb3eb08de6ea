//! Pictures of history columns as functions of time, and of the drift of invariants.

use rhai::Dynamic;

use super::files::write_picture;
use super::options::{
    MARKERS, X_LABEL, X_LIMITS, X_LOG, Y_LABEL, Y_LIMITS, Y_LOG, expect_options_for_panels, marked,
    with_options,
};
use super::subjects::histories_over_time;
use crate::output::{AxisScale, LineChart, Page};
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, Presence, array, boolean, choice, text};
use crate::script::handles::history::HistoryHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::packages::error_estimates::{ERROR, wanted_estimate};
use crate::script::packages::recording::expect_all_rows;
use crate::script::presentation::plots::{by_dimension, drift_lines, line_chart};
use crate::script::studies::error_estimate::ErrorEstimate;
use crate::simulation::History;

pub const COLUMNS: Parameter = array("columns").doc("names of columns of the history");
pub const HISTORY_OPTIONS: &[Parameter] = &[
    text("title").doc("title; default: the name of the simulation").optional(),
    choice("axes", &["own", "shared"])
        .or(Presence::Text("own"))
        .doc("axes of several simulations: \"own\" axes side by side, or one \"shared\" plot"),
    choice("panels", &["by_unit", "one"])
        .or(Presence::Text("by_unit"))
        .doc("panels of columns with different units: one for each unit, or \"one\" for all"),
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

pub fn plot_history(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let histories = histories_over_time(call)?;
    if is_asked(&options, "average") {
        let whose = histories.iter().map(|history| &history.of);
        whose.into_iter().try_for_each(|of| expect_all_rows(call, of, "`average`"))?;
    }
    let names = columns(call, &histories)?;
    let groups = match options.text("panels")?.as_str() {
        "one" => vec![names],
        _ => histories[0].read(|history| by_dimension(&names, |name| history.dimension(name))),
    };
    expect_options_for_panels(&options, groups.len()).map_err(|wrong| wrong.in_call(call))?;
    let estimate = |of: &HistoryHandle| wanted_estimate(call, &options, &of.of);
    let estimates = histories.iter().map(estimate).collect::<Result<_, _>>()?;
    let charts_of = HistoryCharts { call, options: &options, histories, estimates };
    let mut charts = Vec::new();
    for (row, group) in groups.iter().enumerate() {
        let of_row = charts_of.of(group)?.into_iter();
        charts.extend(of_row.map(|chart| if row == 0 { chart } else { chart.title("") }));
    }
    write_charts(call, charts, groups.len())
}

fn write_charts(
    call: &Call,
    mut charts: Vec<LineChart>,
    rows: usize,
) -> Result<Dynamic, ScriptError> {
    match charts.len() {
        1 => write_picture(call, &charts.remove(0)),
        count => {
            write_picture(call, &charts.into_iter().fold(Page::grid(count / rows), Page::panel))
        }
    }
}

fn is_asked(options: &Options, name: &str) -> bool {
    options.boolean(name).unwrap_or(false)
}

struct HistoryCharts<'a> {
    call: &'a Call<'a, 'a>,
    options: &'a Options,
    histories: Vec<HistoryHandle>,
    estimates: Vec<Option<ErrorEstimate>>,
}

impl HistoryCharts<'_> {
    fn of(&self, names: &[String]) -> Result<Vec<LineChart>, ScriptError> {
        let title = self.options.optional_text("title")?;
        let chart = |of: &HistoryHandle| {
            let title = title.clone().unwrap_or_else(|| of.of.name().to_owned());
            of.read(|history| line_chart(title, history, names, |of, name| self.values(of, name)))
        };
        let mut charts: Vec<LineChart> = self.histories.iter().map(chart).collect();
        let is_shared = self.options.text("axes")? == "shared" && charts.len() > 1;
        if is_shared {
            let whose = self.histories.iter().map(|of| of.of.name().to_owned());
            charts = vec![LineChart::shared(title.unwrap_or_default(), whose.zip(charts))];
        }
        charts = charts.into_iter().map(|chart| self.dressed(chart)).collect::<Result<_, _>>()?;
        for (number, (history, estimate)) in self.histories.iter().zip(&self.estimates).enumerate()
        {
            let Some(estimate) = estimate else { break };
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
        Ok(charts)
    }

    fn values(&self, history: &History, name: &str) -> Option<Vec<f64>> {
        let read =
            if is_asked(self.options, "average") { History::averaged } else { History::column };
        let mut values = read(history, name)?;
        if is_asked(self.options, "logarithmic") {
            values.iter_mut().for_each(|value| *value = value.abs());
        }
        Some(values)
    }

    fn dressed(&self, mut chart: LineChart) -> Result<LineChart, ScriptError> {
        if is_asked(self.options, "logarithmic") {
            chart = chart.y_scale(AxisScale::Logarithmic);
        }
        let chart = chart.each(|at, series| marked(self.options, at, series));
        with_options(self.options, chart).map_err(|wrong| wrong.in_call(self.call))
    }
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
    write_charts(call, histories_over_time(call)?.iter().map(chart).collect(), 1)
}
