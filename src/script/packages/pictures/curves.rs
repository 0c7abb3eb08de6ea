//! Charts of script arrays.

use rhai::{Dynamic, Map};

use super::files::{FILE, write_picture};
use super::options::{
    LABELS, MARKERS, OptionError, TITLE, X_LABEL, X_LIMITS, X_LOG, Y_LABEL, Y_LIMITS, Y_LOG,
    curves, expect_options_for_panels, labels, marked, with_options,
};
use crate::output::{LineChart, Point, Series};
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, array, options};
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};

pub const TABLE: BindingTable = BindingTable {
    name: "pictures of arrays",
    doc: "Charts of arrays of numbers: SVG or PNG, depending on the ending of the file name, in \
        the output folder.",
    types: &[],
    setup: RESTING,
    constants: &[],
    rows: &[
        function("plot", &[X, Y, FILE, options("options", OPTIONS).optional()], plot)
            .summary("Plots numbers over numbers: one curve, or several in the same axes.")
            .doc(
                "x and y are arrays of numbers, or arrays of such arrays with one for each \
                curve; one x can be used for all y. A number that is not finite leaves a gap; \
                on a logarithmic axis numbers that are not positive are drawn at the lower \
                end. To plot the height of a tip and the bending moment at a clamp over time, \
                record both before the start, as in the example, and plot their columns with \
                `plot_history`; `plot_along` plots the moment along the beam. At the prompt, \
                `:plot` plots any recorded or unrecorded quantity in the terminal: `:plot \
                sim.position(rod.end).y`.",
            )
            .example(
                "scene.clamp(rod.start);\nscene.force(rod.end, [0, 1]);\nscene.record(\"rod.end.y\");\nscene.record(\"rod.start.M\");\n\
                 let sim = scene.start(#{ dt: 0.1 });\nsim.run_to(2);\n\
                 plot_history(sim, [\"rod.end.y\"], \"tip.svg\");\nplot_history(sim, [\"rod.start.M\"], \"clamp.svg\");\nplot_along(sim, \"M\", \"moment.svg\");\n\
                 let h = sim.history;\nplot(h.column(\"rod.end.y\"), h.column(\"rod.start.M\"), \"both.svg\", #{ x_label: \"height\", y_label: \"moment\" });\n\
                 let x = linspace(0, 1, 11);\nplot(x, [x, x.map(|x| x^2)], \"powers.svg\", #{ labels: [\"x\", \"x²\"], markers: \"on_lines\" });",
            )
            .with_related(&["plot_history", "record", "plot_along", "plot_motion", "plot_field"]),
    ],
};

const RESTING: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 0.1 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });";

const X: Parameter = array("x").doc("numbers, or an array of numbers for each curve");
const Y: Parameter = array("y").doc("as many numbers as x, or an array of numbers for each curve");
const OPTIONS: &[Parameter] =
    &[TITLE, X_LABEL, Y_LABEL, X_LOG, Y_LOG, X_LIMITS, Y_LIMITS, MARKERS, LABELS];

const MOST_CURVES: usize = 1000;

type LabelledCurve = (String, Vec<Point>);

fn plot(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let (x, y) = (curves(call, "x", 0)?, curves(call, "y", 1)?);
    if y.len() > MOST_CURVES {
        let message =
            format!("{} curves are too many for a picture; the limit is {MOST_CURVES}", y.len());
        return Err(call.error(message).at(CallPart::Argument(1)));
    }
    if x.len() != 1 && x.len() != y.len() {
        let message = format!("x holds {} arrays, but y holds {}", x.len(), y.len());
        let hint = "give one x for all curves, or one for each curve";
        return Err(call.error(message).hint(hint).at(CallPart::Argument(0)));
    }
    let title = options.optional_text("title")?.unwrap_or_default();
    let count = y.len();
    let mut curves = Vec::new();
    for (index, y) in y.into_iter().enumerate() {
        let x = &x[index.min(x.len() - 1)];
        if x.len() != y.len() {
            let which = if count == 1 { String::new() } else { format!("curve {index}: ") };
            let message = format!("{which}x has {} numbers, but y has {}", x.len(), y.len());
            let hint = "give as many numbers in y as in x";
            return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
        }
        let name = if count == 1 { String::new() } else { format!("curve {}", index + 1) };
        curves.push((name, x.iter().copied().zip(y).collect()));
    }
    let named = labelled(&options, curves).map_err(|wrong| wrong.in_call(call))?;
    let chart = chart(&options, LineChart::new(title.as_str()), named);
    write_picture(call, &chart.map_err(|wrong| wrong.in_call(call))?)
}

fn labelled(
    options: &Options,
    mut curves: Vec<LabelledCurve>,
) -> Result<Vec<LabelledCurve>, OptionError> {
    let labels = labels(options, curves.len())?.unwrap_or_default();
    curves.iter_mut().zip(labels).for_each(|(curve, label)| curve.0 = label);
    Ok(curves)
}

fn chart(
    options: &Options,
    chart: LineChart,
    curves: Vec<LabelledCurve>,
) -> Result<LineChart, OptionError> {
    let series = curves.into_iter().enumerate();
    let series = series.map(|(at, (name, points))| marked(options, at, Series::new(name, points)));
    with_options(options, series.fold(chart, LineChart::series))
}

pub fn typed_charts(
    engine: &rhai::Engine,
    map: &Map,
    over: &str,
    groups: Vec<Vec<LabelledCurve>>,
) -> Result<Vec<LineChart>, ScriptError> {
    let options = Options::read(engine, ":plot", OPTIONS, map)?;
    let title = options.optional_text("title")?;
    let draw = || {
        expect_options_for_panels(&options, groups.len())?;
        let counts: Vec<usize> = groups.iter().map(Vec::len).collect();
        let mut named = labelled(&options, groups.into_iter().flatten().collect())?.into_iter();
        let draw_group = |count: usize| {
            let curves: Vec<LabelledCurve> = named.by_ref().take(count).collect();
            let names = curves.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
            let title = title.as_ref().map_or(names, |title| title.to_string());
            chart(&options, LineChart::new(title).x_label(over), curves)
        };
        counts.into_iter().map(draw_group).collect()
    };
    let charts: Result<_, OptionError> = draw();
    charts.map_err(|wrong| wrong.in_command(":plot"))
}
