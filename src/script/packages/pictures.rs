//! Pictures and files of simulations.

use std::path::Path;

use rhai::{Array, Dynamic};

use super::histories::HISTORY;
use super::recording::{expect_all_rows, expect_near, expect_rows_between};
use super::simulations::{SIMULATION, SPINNING};
use crate::geometry::Vec2;
use crate::output::{
    CsvTable, LineChart, MotionPicture, Page, Panel, PictureKind, Scale, Snapshot,
};
use crate::script::handles::history::HistoryHandle;
use crate::script::handles::report::history_table;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::looks::sight::{drift_lines, line_chart};
use crate::script::rows::call::Call;
use crate::script::rows::kind::{Kind, Scripted};
use crate::script::rows::options::Options;
use crate::script::rows::parameter::{Parameter, array, boolean, either, number, options, text};
use crate::script::rows::table::{Table, function};
use crate::script::words::error::{Place, ScriptError};
use crate::script::words::numbers::format_number;
use crate::simulation::{Configuration, History};

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
            .summary("Draws snapshots of the motion in one picture, knots or nodes marked, particles as dots, axes equal.")
            .example("sim.run_to(2);\nplot_motion(sim, \"spin.svg\", #{ every: 0.5, trace: [rod.end] });")
            .see(&["plot_history"]),
        function("plot_history", &[RECORDED, COLUMNS, FILE, options("options", HISTORY_OPTIONS).optional()], plot_history)
            .summary("Draws columns of the history over time.")
            .doc("Of several histories, each must have the columns named.")
            .example(
                "sim.run_to(2);\nplot_history(sim, [\"kinetic\", \"strain\", \"energy\"], \"energy.svg\");\n\
                 plot_history(sim, [\"strain\"], \"strain.svg\", #{ average: true, title: \"Strain energy\" });",
            )
            .see(&["plot_drift", "column", "averaged"]),
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
const MOTION: &[Parameter] = &[
    number("every")
        .positive()
        .unit("time")
        .doc("between snapshots; a twentieth of the time shown unless given")
        .optional(),
    number("from").unit("time").doc("first snapshot; the start unless given").optional(),
    number("to").unit("time").doc("last snapshot; the present unless given").optional(),
    array("trace").doc("stations whose paths are drawn").optional(),
    text("title").doc("the name of the simulation unless given").optional(),
];
const HISTORY_OPTIONS: &[Parameter] = &[
    text("title").doc("the name of the simulation unless given").optional(),
    boolean("logarithmic").doc("whether magnitudes are drawn on a logarithmic axis").optional(),
    boolean("average")
        .doc("whether each value is drawn as its mean with the one before, as `averaged` gives it")
        .optional(),
];

/// Most snapshots of one picture.
const MOST_SNAPSHOTS: f64 = 2000.0;

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

fn plot_motion(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let simulations = simulations(call)?;
    let options = call.options_or_defaults("options")?;
    let picture = |of: &SimulationHandle| {
        call.proceed()?;
        motion(call, of, &options)
    };
    let mut pictures = simulations.iter().map(picture).collect::<Result<Vec<_>, ScriptError>>()?;
    match pictures.len() {
        1 => write_picture(call, &pictures.remove(0)),
        _ => write_picture(call, &MotionPicture::side_by_side(pictures)),
    }
}

/// A point in plain numbers, as it is drawn.
pub(super) fn plain(point: &Vec2) -> (f64, f64) {
    (point.x, point.y)
}

/// A configuration as a snapshot that is drawn.
pub(super) fn snapshot(configuration: &Configuration) -> Snapshot {
    let plain_line = |line: &Vec<Vec2>| line.iter().map(plain).collect();
    Snapshot {
        time: configuration.time,
        lines: configuration.lines.iter().map(plain_line).collect(),
        marks: configuration.marks.iter().map(plain).collect(),
        particles: configuration.particles.iter().map(plain).collect(),
    }
}

fn motion(
    call: &Call,
    of: &SimulationHandle,
    options: &Options,
) -> Result<MotionPicture, ScriptError> {
    let given = |name: &str| options.number_if_given(name);
    let simulation = of.simulation();
    let (from, to) = (given("from").unwrap_or(0.0), given("to").unwrap_or(simulation.time()));
    let every = given("every").unwrap_or_else(|| ((to - from) / 20.0).max(f64::MIN_POSITIVE));
    if to < from || from > simulation.time() || to < 0.0 {
        let told =
            format!("there is nothing from t = {} to {}", format_number(from), format_number(to));
        let hint =
            format!("the simulation has run from t = 0 to {}", format_number(simulation.time()));
        return Err(call.error(told).hint(hint));
    }
    let last = to.min(simulation.time());
    let count = ((last - from) / every + 1e-9).floor().max(0.0);
    if count > MOST_SNAPSHOTS {
        return Err(call
            .error(format!("{count} snapshots are too many for a picture"))
            .hint("choose a larger `every`"));
    }
    let title = options.text_if_given("title")?.unwrap_or_else(|| of.name().to_owned());
    let mut picture = MotionPicture::new(title)
        .beams(simulation.scene().beams.iter().map(|beam| beam.name.clone()));
    let times = (0..=count as usize).map(|index| from + index as f64 * every);
    // The last snapshot is asked for by itself, whether or not `every` meets it.
    let is_met = last - (from + count * every) <= 1e-9 * every;
    for time in times.chain((!is_met).then_some(last)) {
        if let Some(configuration) = simulation.configuration_near(time)? {
            expect_near(call, of, (time, configuration.time), every)?;
            picture = picture.snapshot(snapshot(&configuration));
        }
    }
    for station in
        stations(call, &options.array("trace").unwrap_or_default(), Place::Key("trace".into()))?
    {
        let path = simulation.path(&station.on(of)?);
        let inside = path
            .iter()
            .filter(|(time, _)| (from..=to).contains(time))
            .map(|(_, point)| plain(point));
        picture = picture.trace(format!("path of {}", station.show()), inside.collect());
    }
    Ok(picture)
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
    let chart = |of: &HistoryHandle| {
        let title = title.clone().unwrap_or_else(|| of.of.name().to_owned());
        let values = |history: &History, name: &str| {
            read(history, name).map(|values| values.into_iter().map(shown).collect())
        };
        of.read(|history| line_chart(title, history, &names, values).y_scale(scale))
    };
    write_charts(call, histories.iter().map(chart).collect())
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
    let names = of_beams.chain(of_particles);
    let comment = "control points (nodes) of all beams, and particles";
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
