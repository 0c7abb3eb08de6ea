//! Pictures and files of simulations.

use std::path::Path;

use rhai::{Array, Dynamic};

use super::chart_options::{
    MARKERS, X_LABEL, X_LIMITS, X_LOG, Y_LABEL, Y_LIMITS, Y_LOG, dressed, marked,
};
use super::histories::HISTORY;
use super::motion_pictures::{MOTION, plot_motion};
use super::recording::{expect_all_rows, expect_rows_between};
use super::simulations::{SIMULATION, SPINNING};
use crate::geometry::Vec2;
use crate::output::{CsvTable, LineChart, Page, Panel, PictureKind, Scale};
use crate::script::handles::history::HistoryHandle;
use crate::script::handles::report::history_table;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::looks::sight::{drift_lines, line_chart};
use crate::script::rows::call::Call;
use crate::script::rows::kind::{Kind, Scripted};
use crate::script::rows::parameter::{
    Parameter, Presence, array, boolean, choice, either, options, text,
};
use crate::script::rows::table::{Table, function};
use crate::script::words::error::{Place, ScriptError};
use crate::simulation::History;

/// The domain of pictures and files.
pub const TABLE: Table = Table {
    name: "pictures",
    doc: "Pictures are SVG or PNG by the ending of the file name, tables are CSV; all go into the output folder. Given an \
          array of simulations, a picture shows them side by side.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("plot_motion", &[MOVING, FILE, options("options", MOTION).optional()], plot_motion)
            .summary("Draws snapshots of the motion in one picture, axes equal, with supports, joints, sliders and loads.")
            .doc(
                "Knots or nodes are dots, particles larger ones. The last snapshot is the present unless `to` is given, and symbols are those of that time: a support is a triangle, or a wall \
                 where it clamps, a joint a ring, or a square where it is rigid, a slider a diamond, a load an arrow, as long as it acts. At the prompt `:show` takes the same options.",
            )
            .example("sim.run_to(2);\nplot_motion(sim, \"spin.svg\", #{ every: 0.5, trace: [rod.end] });\nplot_motion(sim, \"large.svg\", #{ magnify: 10, every: 1, x_limits: [-1, 3] });")
            .see(&["plot", "plot_history", "plot_along", "plot_field"]),
        function("plot_history", &[RECORDED, COLUMNS, FILE, options("options", HISTORY_OPTIONS).optional()], plot_history)
            .summary("Draws columns of the history over time.")
            .doc("Of several histories, each must have the columns named. Other numbers than columns are drawn by `plot`.")
            .example(
                "sim.run_to(2);\nplot_history(sim, [\"kinetic\", \"strain\", \"energy\"], \"energy.svg\");\n\
                 plot_history(sim, [\"strain\"], \"strain.svg\", #{ average: true, title: \"Strain energy\" });\n\
                 let other = scene.start(#{ name: \"trapezoidal\", dt: 0.1, integrator: trapezoidal() });\nother.run_to(2);\n\
                 plot_history([sim, other], [\"strain\"], \"two.svg\", #{ axes: \"shared\", x_limits: [0, 1] });",
            )
            .see(&["plot", "plot_drift", "plot_along", "column", "averaged"]),
        function("plot_drift", &[RECORDED, FILE], plot_drift)
            .summary("Draws how far energy and momenta have drifted, on a logarithmic axis.")
            .example("sim.run_to(2);\nplot_drift(sim, \"drift.png\");")
            .see(&["drift"]),
        function("write_history", &[RECORDED, FILE], write_history)
            .summary("Writes all columns of the history as CSV, every digit kept.")
            .example("sim.run_to(1);\nwrite_history(sim, \"spin.csv\");")
            .see(&["write_csv", "write_npz"]),
        function("write_states", &[either("of", &[Kind::Object(SIMULATION)]), FILE], write_states)
            .summary("Writes the control points (or nodes) of all beams, and the particles, over time as CSV.")
            .example("sim.run_to(1);\nwrite_states(sim, \"points.csv\");")
            .see(&["write_npz", "write_vtk"]),
    ],
};

pub(super) const MOVING: Parameter =
    either("of", &[Kind::Object(SIMULATION), Kind::Array]).doc("a simulation, or an array of them");
const RECORDED: Parameter =
    either("of", &[Kind::Object(SIMULATION), Kind::Object(HISTORY), Kind::Array])
        .doc("a simulation or history, or an array of them");
pub(super) const FILE: Parameter = text("file").doc("its name in the output folder");
const COLUMNS: Parameter = array("columns").doc("names of columns of the history");
const HISTORY_OPTIONS: &[Parameter] = &[
    text("title").doc("the name of the simulation unless given").optional(),
    choice("axes", &["own", "shared"])
        .or(Presence::Text("own"))
        .doc("of several simulations: each has its own, side by side, or all share them"),
    boolean("logarithmic").doc("whether magnitudes are drawn on a logarithmic axis").optional(),
    boolean("average")
        .doc("whether each value is drawn as its mean with the one before, as `averaged` gives it")
        .optional(),
    X_LABEL,
    Y_LABEL,
    X_LOG,
    Y_LOG,
    X_LIMITS,
    Y_LIMITS,
    MARKERS,
];

/// Most simulations in one picture.
const MOST_SIDE_BY_SIDE: usize = 100;

fn things<T: Scripted>(
    call: &Call,
    convert: fn(&Dynamic) -> Option<T>,
) -> Result<Vec<T>, ScriptError> {
    let of = call.value("of")?;
    let values = of.read_lock::<Array>().map_or_else(|| vec![of.clone()], |array| array.clone());
    if values.len() > MOST_SIDE_BY_SIDE {
        let told = format!(
            "{} pictures side by side are too many: {MOST_SIDE_BY_SIDE} at most",
            values.len()
        );
        return Err(call.error(told).hint("draw some of them").at(Place::Argument(0)));
    }
    let things: Option<Vec<T>> = values.iter().map(convert).collect();
    things.filter(|things| !things.is_empty()).ok_or_else(|| {
        call.error("the array must hold simulations, at least one")
            .hint("for example [first, second]")
            .at(Place::Argument(0))
    })
}

/// The simulations given.
pub(super) fn simulations(call: &Call) -> Result<Vec<SimulationHandle>, ScriptError> {
    things(call, as_simulation)
}

/// The histories given, none of them empty.
fn histories(call: &Call) -> Result<Vec<HistoryHandle>, ScriptError> {
    let histories = things(call, as_history)?;
    match histories.iter().find(|of| of.read(|rows| rows.samples().is_empty())) {
        Some(empty) => Err(empty.no_rows(call)),
        None => Ok(histories),
    }
}

/// The histories given, with rows between their ends.
fn histories_over_time(call: &Call) -> Result<Vec<HistoryHandle>, ScriptError> {
    let histories = histories(call)?;
    histories.iter().try_for_each(|history| expect_rows_between(call, &history.of))?;
    Ok(histories)
}

fn as_simulation(value: &Dynamic) -> Option<SimulationHandle> {
    value.clone().try_cast()
}

fn as_history(value: &Dynamic) -> Option<HistoryHandle> {
    let whole = |of| HistoryHandle { of, from: f64::NEG_INFINITY, to: f64::INFINITY };
    value.clone().try_cast::<HistoryHandle>().or_else(|| as_simulation(value).map(whole))
}

/// Writes a picture into the output folder, in the format that the ending of its name asks for; gives nothing to the script.
pub(super) fn write_picture(call: &Call, picture: &dyn Panel) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    let kind = PictureKind::of(Path::new(file.as_str()))?;
    let figure = picture.figure()?;
    let bytes = match kind {
        PictureKind::Svg => figure.to_svg()?.into_bytes(),
        PictureKind::Png => figure.to_png()?,
    };
    call.context().write_file(&file, &bytes)?;
    Ok(Dynamic::UNIT)
}

/// A point in plain numbers, as it is drawn.
pub(super) fn plain(point: &Vec2) -> (f64, f64) {
    (point.x, point.y)
}

/// The stations in an array that stands at a place of the call.
pub(super) fn stations(
    call: &Call,
    array: &Array,
    at: Place,
) -> Result<Vec<StationHandle>, ScriptError> {
    let stations = array.iter().map(|value| value.clone().try_cast::<StationHandle>());
    stations.collect::<Option<_>>().ok_or_else(|| {
        call.error("the array must hold stations").hint("for example [rod.end]").at(at)
    })
}

/// A chart for each history, side by side where there are several.
fn write_charts(call: &Call, charts: Vec<LineChart>) -> Result<Dynamic, ScriptError> {
    let mut charts = charts;
    match charts.len() {
        1 => write_picture(call, &charts.remove(0)),
        _ => write_picture(call, &charts.into_iter().fold(Page::row(), Page::panel)),
    }
}

fn plot_history(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let is_asked = |name: &str| options.boolean(name).unwrap_or(false);
    let (scale, shown): (_, fn(f64) -> f64) = match is_asked("logarithmic") {
        true => (Scale::Logarithmic, f64::abs),
        false => (Scale::Linear, |value| value),
    };
    let read = if is_asked("average") { History::averaged } else { History::column };
    let histories = histories_over_time(call)?;
    if is_asked("average") {
        let whose = histories.iter().map(|history| &history.of);
        whose.into_iter().try_for_each(|of| expect_all_rows(call, of, "`average`"))?;
    }
    let names = columns(call, &histories)?;
    let title = options.text_if_given("title")?;
    let values = |history: &History, name: &str| {
        read(history, name).map(|values| values.into_iter().map(shown).collect())
    };
    let chart = |of: &HistoryHandle| {
        let title = title.clone().unwrap_or_else(|| of.of.name().to_owned());
        of.read(|history| line_chart(title, history, &names, values))
    };
    let mut charts: Vec<LineChart> = histories.iter().map(chart).collect();
    if options.text("axes")? == "shared" && charts.len() > 1 {
        let title = options.text_if_given("title")?.unwrap_or_default();
        let named: Vec<String> = histories.iter().map(|of| of.of.name().to_owned()).collect();
        charts = vec![LineChart::shared(title, named.into_iter().zip(charts))];
    }
    let dress = |chart: LineChart| {
        let chart = chart.y_scale(scale).each(|at, series| marked(&options, at, series));
        dressed(call, &options, chart)
    };
    write_charts(call, charts.into_iter().map(dress).collect::<Result<_, _>>()?)
}

/// The names of the columns asked for, which all of the histories have.
fn columns(call: &Call, histories: &[HistoryHandle]) -> Result<Vec<String>, ScriptError> {
    let columns = call.array("columns")?;
    for (history, name) in histories.iter().flat_map(|of| columns.iter().map(move |n| (of, n))) {
        history.expect_column(call, name, 1)?;
    }
    match (columns.as_slice(), histories) {
        ([], [first, ..]) => {
            let hint = format!("columns: {}", first.column_names());
            Err(call.error("no column is named").hint(hint).at(Place::Argument(1)))
        }
        _ => Ok(columns.iter().map(Dynamic::to_string).collect()),
    }
}

fn plot_drift(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let chart = |of: &HistoryHandle| of.read(|history| drift_lines(of.of.name(), history));
    write_charts(call, histories_over_time(call)?.iter().map(chart).collect())
}

/// Writes a table into the output folder, if the name of its file ends as it should; gives nothing to the script.
pub(super) fn write_csv(call: &Call, table: CsvTable) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    if !file.ends_with(".csv") {
        return Err(call.error(format!("\"{file}\" does not end in .csv")));
    }
    call.context().write_file(&file, table.to_text()?.as_bytes())?;
    Ok(Dynamic::UNIT)
}

fn write_history(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let [of] =
        histories(call)?.try_into().map_err(|_| call.error("takes one simulation or history"))?;
    let table = of.read(|history| history_table(of.of.name(), history));
    write_csv(call, table)
}

fn write_states(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let [of] = simulations(call)?.try_into().map_err(|_| call.error("takes one simulation"))?;
    let simulation = of.simulation();
    let trajectory = simulation.trajectory();
    let scene = simulation.scene();
    let of_beams =
        scene.beams.iter().zip(simulation.model().control_points()).flat_map(|(beam, points)| {
            (0..points.len()).flat_map(move |point| {
                ["x", "y"].map(|axis| format!("{} {axis}{point} [length]", beam.name))
            })
        });
    let of_particles = scene
        .particles
        .iter()
        .flat_map(|particle| ["x", "y"].map(|axis| format!("{} {axis} [length]", particle.name)));
    let of_bodies = scene.rigid_bodies.iter().flat_map(|body| {
        let points = body.points.iter().map(|(point, _)| format!("{}.{point}", body.name));
        let places = std::iter::once(body.name.clone()).chain(points);
        places.flat_map(|place| ["x", "y"].map(|axis| format!("{place} {axis} [length]")))
    });
    let names = of_beams.chain(of_particles).chain(of_bodies);
    let comment = match scene.rigid_bodies.is_empty() {
        true => "control points (nodes) of all beams, and particles",
        false => "control points (nodes) of all beams, particles, and bodies with their points",
    };
    let table = CsvTable::new()
        .comment(format!("simulation: {}; {comment}", of.name()))
        .column("t [time]", trajectory.times().to_vec());
    let table = names.enumerate().fold(table, |table, (index, name)| {
        let values =
            (0..trajectory.times().len()).map(|row| trajectory.configuration(row)[index]).collect();
        table.column(name, values)
    });
    write_csv(call, table)
}
