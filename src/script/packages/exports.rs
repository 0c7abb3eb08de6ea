//! Export of simulations and tables for other programs.

use rhai::Dynamic;

use super::error_estimates::{ERROR, wanted_estimate};
use super::pictures::subjects::as_history;
use super::recording::{Missing, expect_near, report_diverged_rerun};
use super::simulations::{SIMULATION, SPINNING};
use super::sweeps::SWEEP_TABLE;
use super::tables::{TABULAR, table};
use crate::output::{TableHeading, vtk_collection};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, boolean, choice, either, integer, number, object, options, text,
};
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::simulation::{SimulationHandle, Visited};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::presentation::arrays::archive;
use crate::script::presentation::grids::Grids;
use crate::script::state::settings::RunMode;
use crate::script::studies::sweeps::table::SweepTable;

pub const TABLE: BindingTable = BindingTable {
    name: "exports",
    doc: "Exports of simulations for other programs: ParaView, NumPy, tables. Each file is \
        written completely or not at all. `withy convert` exports a saved simulation without \
        its script.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("write_vtk", &[OF, VTK_FILE, options("options", FRAMES).optional()], write_vtk)
            .summary("Writes frames of the motion for ParaView: RUN.pvd with the times, and a grid \
                RUN/RUN_0001.vtu … for each frame.")
            .doc(
                "A beam is a line through its knots and three points between each two of them, \
                with double points where a joint divides it; particles and centres of rigid \
                bodies are points. The cell field `body` numbers beams first, then particles, \
                then rigid bodies. Point fields are arc_length, velocity, angle [rad], N, Q \
                and M, zero on particles and rigid bodies. Velocities and section forces need \
                complete states: stored ones (option `snapshots`), or those of the run \
                repeated in a copy, which takes the time of the run and is compared bit for \
                bit. If the repeated run differs, because a function had changed the \
                simulation or it started from an equilibrium, only the shape is written, with \
                a note. Frames are recorded configurations, without interpolation. Frames of \
                an earlier, longer export are not deleted, but the .pvd does not list them.",
            )
            .example("sim.run_to(2);\nwrite_vtk(sim, \"spin.pvd\", #{ every: 0.5 });\nwrite_vtk(sim, \"shape.pvd\", #{ frames: 3, fields: \"shape\" });")
            .with_related(&["write_npz", "plot_motion", "save"]),
        function("write_npz", &[ARRAYED, NPZ_FILE, options("options", NPZ).optional()], write_npz)
            .summary("Writes all recorded data as arrays for NumPy.")
            .doc(
                "`t` holds the times of the configurations; `points.NAME` the control points \
                (or nodes) of a beam, by time, point and coordinate, or the positions of a \
                particle, by time and coordinate; `history.COLUMN` each column of the history, \
                whose times are `history.t`. For the table of a sweep there is an array for \
                each numeric parameter and result, with NaN in failed rows. With `error: true`, \
                `error.NAME` holds the estimated errors of a station or column at `history.t`. \
                All numbers are doubles with full accuracy.",
            )
            .example("sim.run_to(1);\nwrite_npz(sim, \"spin.npz\");")
            .with_related(&["write_vtk", "write_states", "write_csv"]),
        function("write_csv", &[TABULAR, CSV_FILE, options("options", HEADER).optional()], write_csv)
            .summary("Writes a table as plain CSV for other programs: column names in the first \
                line, no comments.")
            .doc(
                "For a simulation or a history all columns are written; for an array of maps a \
                row for each map and a column for each key, in alphabetical order, empty where \
                the key is missing. With `error: true`, the estimated errors of each column of a \
                simulation or history follow it in a column NAME.error. All digits are kept. A text that begins with = + - or @ gets an apostrophe, so that \
                spreadsheets do not evaluate it. write_history adds a comment on the \
                simulation and units in the column names.",
            )
            .example(
                "sim.run_to(1);\nwrite_csv(sim, \"spin.csv\");\nwrite_csv(sim.history.after(0.5), \"late.csv\", #{ units: true });\n\
                 write_csv([#{ mesh: 8, error: 0.1 }, #{ mesh: 16, error: 0.02 }], \"errors.csv\");",
            )
            .with_related(&["write_parquet", "write_history", "cells"]),
        function("write_parquet", &[TABULAR, PARQUET_FILE], write_parquet)
            .summary("Writes a table as Apache Parquet, if withy was built with this feature.")
            .doc(
                "Parquet needs many crates and is an optional feature of the build: `cargo \
                install --path . --features parquet`. Without it the call is refused with an \
                error, which a script can catch. Columns are doubles, integers, booleans or \
                texts; `dimension.NAME` of the metadata is the dimension of a column.",
            )
            .example("sim.run_to(1);\ntry { write_parquet(sim, \"spin.parquet\"); } catch (error) { print(error); }")
            .with_related(&["write_csv", "write_npz"]),
    ],
};

const ARRAYED: Parameter = either("of", &[Kind::Object(SIMULATION), Kind::Object(SWEEP_TABLE)])
    .doc("a simulation, or the table of a sweep");
const OF: Parameter = object("of", SIMULATION);
const VTK_FILE: Parameter = text("file").doc("file name in the output folder, ending in .pvd");
const NPZ_FILE: Parameter = text("file").doc("file name in the output folder, ending in .npz");
const CSV_FILE: Parameter = text("file").doc("file name in the output folder, ending in .csv");
const PARQUET_FILE: Parameter =
    text("file").doc("file name in the output folder, ending in .parquet");
const FRAMES: &[Parameter] = &[
    number("from").unit("time").doc("time of the first frame; default: the start").optional(),
    number("to").unit("time").doc("time of the last frame; default: the present").optional(),
    number("every")
        .positive()
        .unit("time")
        .doc("time between frames; the last one is always written")
        .optional(),
    integer("frames")
        .between(2.0, MOST_FRAMES)
        .doc("largest number of frames, evenly spaced in time; default: 101")
        .optional(),
    choice("fields", &["all", "shape"])
        .doc(
            "\"shape\": only positions of the recorded configurations, without repeating the \
            run; \"all\": all fields if available; default: \"all\"",
        )
        .optional(),
];
const HEADER: &[Parameter] = &[
    boolean("units")
        .doc("true to write the dimensions of the columns in the second line")
        .optional(),
    ERROR,
];
const NPZ: &[Parameter] = &[ERROR];

const MISSING: Missing =
    Missing { what: "velocities, angles and section forces", instead: "fields: \"shape\"" };
const MOST_FRAMES: f64 = 100_000.0;
const FRAMES_UNLESS_GIVEN: usize = 101;

fn named(call: &Call, ending: &str) -> Result<String, ScriptError> {
    let file = call.text("file")?;
    if file.strip_suffix(ending).is_none_or(|stem| stem.is_empty() || stem.ends_with('/')) {
        let message = format!("\"{file}\" does not end in {ending}, with a name before it");
        let hint = format!("for example \"run{ending}\"");
        return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
    }
    call.context().output().path_of(&file).map_err(|error| error.at(CallPart::Argument(1)))?;
    Ok(file.to_string())
}

struct VtkFiles {
    stem: String,
    /// Name of the collection file without folder and extension.
    base: String,
    digits: usize,
}

impl VtkFiles {
    fn of(collection: &str, frames: usize) -> Self {
        let stem = collection.trim_end_matches(".pvd").to_owned();
        let base = stem.rsplit('/').next().unwrap_or_default().to_owned();
        Self { stem, base, digits: frames.to_string().len().max(4) }
    }

    fn of_frame(&self, index: usize) -> String {
        format!("{}/{}_{:0digits$}.vtu", self.stem, self.base, index + 1, digits = self.digits)
    }

    fn beside(&self, index: usize) -> String {
        format!("{}/{}_{:0digits$}.vtu", self.base, self.base, index + 1, digits = self.digits)
    }
}

fn write_vtk(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let collection = named(call, ".pvd")?;
    let of = call.get::<SimulationHandle>("of")?;
    let options = call.options_or_defaults("options")?;
    let frames = frames(call, &of, &options)?;
    if call.context().mode() == RunMode::DryRun {
        return Ok(Dynamic::UNIT);
    }
    let files = VtkFiles::of(&collection, frames.len());
    let grids = Grids::of(&of.simulation())?;
    let wish = options.text("fields").ok();
    let another = match wish.as_deref() {
        Some("shape") => true,
        wish => match write_states(call, &of, &frames, (&grids, &files))? {
            Visited::All => false,
            Visited::Diverged(time) => {
                report_diverged_rerun(call, &of, time, (MISSING, wish.is_some()))?;
                true
            }
        },
    };
    if another {
        for (number, frame) in frames.iter().enumerate() {
            call.proceed()?;
            let grid = grids.of_configuration(&of.simulation(), *frame);
            call.context().write_file(&files.of_frame(number), grid.to_vtu()?.as_bytes())?;
        }
    }
    let simulation = of.simulation();
    let time = |frame: &usize| simulation.trajectory().times()[*frame];
    let entries: Vec<(f64, String)> =
        frames.iter().enumerate().map(|(at, frame)| (time(frame), files.beside(at))).collect();
    call.context().write_file(&collection, vtk_collection(&entries).as_bytes())?;
    Ok(Dynamic::UNIT)
}

fn write_states(
    call: &Call,
    of: &SimulationHandle,
    frames: &[usize],
    (grids, files): (&Grids, &VtkFiles),
) -> Result<Visited, ScriptError> {
    let times: Vec<f64> = {
        let simulation = of.simulation();
        frames.iter().map(|frame| simulation.trajectory().times()[*frame]).collect()
    };
    of.for_each_state(&times, call.context(), &mut |number, state| {
        call.proceed()?;
        let grid = grids.of_state(state).to_vtu()?;
        call.context().write_file(&files.of_frame(number), grid.as_bytes()).map(|_| ())
    })
}

fn frames(
    call: &Call,
    of: &SimulationHandle,
    options: &Options,
) -> Result<Vec<usize>, ScriptError> {
    let simulation = of.simulation();
    let trajectory = simulation.trajectory();
    let from = options.optional_number("from").unwrap_or(0.0);
    let to = options.optional_number("to").unwrap_or(f64::INFINITY).min(simulation.time());
    let slack = simulation.slack();
    let first = trajectory.times().partition_point(|time| *time < from - slack);
    let end = trajectory.times().partition_point(|time| *time <= to + slack);
    let Some(last) = end.checked_sub(1).filter(|last| *last >= first) else {
        let [from, to, now] = [from, to, simulation.time()].map(format_number);
        let message = format!("'{}' has no recorded state from t = {from} to {to}", of.name());
        return Err(call.error(message).hint(format!("it has run from t = 0 to {now}")));
    };
    let at = |index: usize| trajectory.times()[index];
    let span = at(last) - at(first);
    let (every, count) = match (options.optional_number("every"), options.has("frames")) {
        (Some(_), true) => {
            return Err(call
                .error(
                    "`every` and `frames` are both given, but each determines the number of \
                    frames",
                )
                .hint("give only one of them")
                .at(CallPart::Key("frames".into())));
        }
        (Some(every), false) => (every, (span / every + 1e-9).floor()),
        (None, is_given) => {
            let most = if is_given { options.count("frames")? } else { FRAMES_UNLESS_GIVEN };
            if end - first <= most {
                return Ok((first..end).collect());
            }
            (span / (most - 1) as f64, (most - 1) as f64)
        }
    };
    if count >= MOST_FRAMES {
        return Err(call
            .error(format!("{count} frames are too many"))
            .hint("choose a larger `every`")
            .at(CallPart::Key("every".into())));
    }
    let mut frames = Vec::new();
    let wanted = (0..=count as usize).map(|number| at(first) + number as f64 * every);
    for time in wanted.chain([at(last)]) {
        let nearest = trajectory.nearest(time).unwrap_or(last).clamp(first, last);
        if options.has("every") {
            expect_near(call, of, (time, at(nearest)), every)?;
        }
        frames.push(nearest);
    }
    frames.dedup();
    Ok(frames)
}

fn write_npz(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = named(call, ".npz")?;
    let options = call.options_or_defaults("options")?;
    let archive = match call.get_if::<SweepTable>("of") {
        Some(sweep) => {
            expect_no_errors(call, &options)?;
            sweep.archive()
        }
        None => {
            let of = call.get::<SimulationHandle>("of")?;
            let estimate = wanted_estimate(call, &options, &of)?;
            let simulation = of.simulation();
            let mut archive = archive(&simulation);
            if let Some(estimate) = estimate {
                estimate.add_arrays(&mut archive, simulation.history());
            }
            archive
        }
    };
    let bytes = archive.to_bytes()?;
    call.context().write_file(&file, &bytes)?;
    Ok(Dynamic::UNIT)
}

fn write_csv(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = named(call, ".csv")?;
    let options = call.options_or_defaults("options")?;
    let has_units = options.boolean("units").unwrap_or(false);
    let heading = if has_units { TableHeading::NamesAndUnits } else { TableHeading::Names };
    let mut table = table(call)?;
    match as_history(&call.value("of")?) {
        Some(history) => {
            if let Some(estimate) = wanted_estimate(call, &options, &history.of)? {
                history.read(|rows| estimate.add_columns(&mut table, rows));
            }
        }
        None => expect_no_errors(call, &options)?,
    }
    call.context().write_file_by(&file, |file| table.write_csv(heading, file))?;
    Ok(Dynamic::UNIT)
}

fn expect_no_errors(call: &Call, options: &Options) -> Result<(), ScriptError> {
    if !options.boolean(ERROR.name).unwrap_or(false) {
        return Ok(());
    }
    Err(call
        .error("only the errors of a simulation or its history can be estimated")
        .hint("give the simulation, or leave out `error`")
        .at(CallPart::Key(ERROR.name.into())))
}

#[cfg(feature = "parquet")]
fn write_parquet(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = named(call, ".parquet")?;
    call.context().write_file(&file, &table(call)?.to_parquet()?)?;
    Ok(Dynamic::UNIT)
}

#[cfg(not(feature = "parquet"))]
fn write_parquet(call: &mut Call) -> Result<Dynamic, ScriptError> {
    named(call, ".parquet")?;
    table(call)?;
    Err(call.error("this withy was built without Parquet").hint(
        "build it with: cargo install --path . --features parquet; or use write_csv or \
            write_npz",
    ))
}
