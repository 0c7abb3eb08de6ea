//! HTML pages that animate simulations.

use rhai::Dynamic;

use super::pictures::files::FILE;
use super::pictures::subjects::{MOVING, simulations, stations};
use super::recording::{Missing, report_diverged_rerun};
use super::simulations::SPINNING;
use crate::beams::Station;
use crate::output::viewer::{ColourField, Viewer};
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, array, integer, number, options, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::simulation::{SimulationHandle, Visited};
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::messages::suggest::nearest;
use crate::script::presentation::plots::column_hint;
use crate::script::presentation::viewer_data::{FIELDS, FieldReader, ViewerOptions, viewer_data};
use crate::script::state::settings::RunMode;

pub const TABLE: BindingTable = BindingTable {
    name: "viewers",
    doc: "A viewer is one HTML file that plays simulations in any browser, without network and \
        without withy. `withy view FILE` creates and opens a viewer of a saved simulation, or \
        of the simulations in the variables of a script; at the prompt use `:view`.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("write_viewer", &[MOVING, FILE, options("options", VIEWER).optional()], write_viewer)
            .summary("Writes an HTML page that plays the motion, with zoom, colours and values, and \
                plots the energies below it.")
            .doc(
                "An array of simulations is shown side by side with one time and one view; of \
                more than four, two are shown at first. Frames are recorded configurations, \
                without interpolation; positions have 16 bits, which is visible only at \
                magnifications of several hundred. Colours: speed, from the configurations \
                before and after; M, N, Q and strain_energy (per length), from the stored \
                states; stretch and curvature, the change from the undeformed axis. States \
                that are not stored (option `snapshots`) are computed again in a copy of the \
                run, as by write_vtk; `fields: [\"speed\", \"stretch\", \"curvature\"]` needs \
                no states. `?` on the page lists its keys.",
            )
            .example(
                "sim.run_to(2);\nwrite_viewer(sim, \"spin.html\", #{ trails: [rod.end], columns: [\"kinetic\", \"angular_momentum\"] });\n\
                 let fine = scene.start(#{ dt: 0.05, name: \"half the step\" });\nfine.run_to(2);\n\
                 write_viewer([sim, fine], \"steps.html\", #{ labels: [\"dt = 0.1\", \"dt = 0.05\"] });",
            )
            .with_related(&["write_animation", "plot_motion", "plot_history", "viewer_page"]),
        function("viewer_page", &[MOVING, options("options", VIEWER).optional()], |call| Ok(page(call)?.into()))
            .returns(Returns::TEXT)
            .summary("Returns the page that write_viewer writes, as a text.")
            .doc("The Python module shows it in notebooks.")
            .example("sim.run_to(1);\ncheck(viewer_page(sim, #{ frames: 5 }).contains(\"<canvas\"));")
            .with_related(&["write_viewer"]),
    ],
};

const VIEWER: &[Parameter] = &[
    text("title").doc("title; default: the name of the first simulation").optional(),
    array("labels").doc("labels of the simulations; default: their names").optional(),
    number("from").unit("time").doc("time of the first frame; default: the start").optional(),
    number("to").unit("time").doc("time of the last frame; default: the present").optional(),
    integer("frames")
        .between(2.0, 20_000.0)
        .doc("largest number of frames, evenly spaced in time")
        .or(Presence::Integer(1000)),
    array("trails")
        .doc("stations whose paths are plotted; default: free ends, if there are at most eight")
        .optional(),
    array("columns")
        .doc("columns of the history; default: kinetic, strain, potential, energy and work")
        .optional(),
    array("fields")
        .doc(
            "quantities for the colours of beams: \"speed\", \"M\", \"strain_energy\", \"N\", \
            \"Q\", \"stretch\", \"curvature\"; default: speed, M, stretch and curvature",
        )
        .optional(),
];
const MISSING: Missing = Missing {
    what: "section forces and strain energy",
    instead: "fields: [\"speed\", \"stretch\", \"curvature\"]",
};

const USUAL_FIELDS: [&str; 4] = ["speed", "M", "stretch", "curvature"];

const LEDGER: [&str; 5] = ["kinetic", "strain", "potential", "energy", "work"];

fn write_viewer(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let file = call.text("file")?;
    if !file.ends_with(".html") {
        let message = format!("\"{file}\" does not end in .html");
        return Err(call
            .error(message)
            .hint("a viewer is a page: \"run.html\"")
            .at(CallPart::Argument(1)));
    }
    let page = page(call)?;
    call.context().write_file(&file, page.as_bytes())?;
    Ok(Dynamic::UNIT)
}

fn page(call: &Call) -> Result<String, ScriptError> {
    let simulations = simulations(call)?;
    let options = call.options_or_defaults("options")?;
    let labels = labels(call, &simulations, &options)?;
    let trails = match options.has("trails") {
        true => Some(stations(call, &options.array("trails")?, CallPart::Key("trails".into()))?),
        false => None,
    };
    let trails = trails.map(|trails| assigned(&trails, &simulations)).transpose()?;
    let fields = fields(call, &options)?;
    let fields: Vec<&str> = fields.iter().map(String::as_str).collect();
    let mut motions = Vec::new();
    for (index, (of, label)) in simulations.iter().zip(labels).enumerate() {
        call.proceed()?;
        let span = span(call, of, &options)?;
        let most = options.count("frames")?;
        let frames = of.simulation().frames_between(span.0, span.1, most);
        let viewer_options = ViewerOptions {
            span,
            inside: inside(call, of, &frames, (&fields, options.has("fields")))?,
            frames,
            label,
            trails: trails.as_ref().map(|trails| trails[index].as_slice()),
            columns: &columns(call, of, &options)?,
            fields: &fields,
        };
        motions.push(viewer_data(&of.simulation(), viewer_options)?);
    }
    let title = options.text("title").map(|title| title.to_string());
    let title = title.unwrap_or_else(|_| simulations[0].name().to_owned());
    Ok(Viewer { title, motions }.to_html()?)
}

/// Fields for colouring beams, computed from states of a simulation that are restored from snapshots or computed again.
/// If the repeated run differs from the original, the result is empty after a note, or an error for explicitly requested fields.
/// The result is also empty in a dry run.
fn inside(
    call: &Call,
    of: &SimulationHandle,
    frames: &[usize],
    (names, is_asked): (&[&str], bool),
) -> Result<Vec<ColourField>, ScriptError> {
    let taken = FieldReader::of(&of.simulation(), frames.len(), names)?;
    let Some(mut taken) = taken.filter(|_| call.context().mode() != RunMode::DryRun) else {
        return Ok(Vec::new());
    };
    let times = of.simulation().trajectory().times().to_vec();
    let times: Vec<f64> = frames.iter().map(|&frame| times[frame]).collect();
    let visited = of.for_each_state(&times, call.context(), &mut |frame, state| {
        call.proceed()?;
        taken.store_frame(frame, state);
        Ok(())
    })?;
    match visited {
        Visited::All => Ok(taken.fields()),
        Visited::Diverged(time) => {
            report_diverged_rerun(call, of, time, (MISSING, is_asked))?;
            Ok(Vec::new())
        }
    }
}

fn labels(
    call: &Call,
    simulations: &[SimulationHandle],
    options: &Options,
) -> Result<Vec<String>, ScriptError> {
    let Ok(given) = options.array("labels") else {
        return Ok(simulations.iter().map(|of| of.name().to_owned()).collect());
    };
    if given.len() != simulations.len() {
        let (labels, of) = (given.len(), simulations.len());
        let message = format!("{labels} labels are given for {of} simulations");
        return Err(call
            .error(message)
            .hint("give one label for each simulation")
            .at(CallPart::Key("labels".into())));
    }
    Ok(given.iter().map(Dynamic::to_string).collect())
}

pub(super) fn span(
    call: &Call,
    of: &SimulationHandle,
    options: &Options,
) -> Result<(f64, f64), ScriptError> {
    let simulation = of.simulation();
    let from = options.optional_number("from").unwrap_or(0.0);
    let to = options.optional_number("to").unwrap_or(f64::INFINITY).min(simulation.time());
    if simulation.frames_between(from, to, 2).is_empty() {
        let [from, to, now] = [from, to, simulation.time()].map(format_number);
        let message = format!("'{}' has no recorded state from t = {from} to {to}", of.name());
        return Err(call.error(message).hint(format!("it has run from t = 0 to {now}")));
    }
    Ok((from, to))
}

fn assigned(
    given: &[StationHandle],
    simulations: &[SimulationHandle],
) -> Result<Vec<Vec<Station>>, ScriptError> {
    for station in given {
        let mut on = simulations.iter().map(|of| station.place_in(of));
        if let (false, Some(first)) = (on.clone().any(|at| at.is_ok()), on.next()) {
            first?;
        }
    }
    let of = |simulation| {
        given.iter().filter(|at| at.place_in(simulation).is_ok()).map(|at| at.station).collect()
    };
    Ok(simulations.iter().map(of).collect())
}

fn columns(
    call: &Call,
    of: &SimulationHandle,
    options: &Options,
) -> Result<Vec<String>, ScriptError> {
    let Ok(given) = options.array("columns") else {
        return Ok(LEDGER.map(str::to_owned).to_vec());
    };
    let simulation = of.simulation();
    let column = |value: &Dynamic| {
        let name = value.clone().into_string().unwrap_or_default();
        if simulation.history().dimension(&name).is_some() {
            return Ok(name);
        }
        let message = format!("the history of '{}' has no column {}", of.name(), call.show(value));
        let hint = column_hint(simulation.history(), &name);
        Err(call.error(message).hint(hint).at(CallPart::Key("columns".into())))
    };
    given.iter().map(column).collect()
}

fn fields(call: &Call, options: &Options) -> Result<Vec<String>, ScriptError> {
    let Ok(given) = options.array("fields") else {
        return Ok(USUAL_FIELDS.map(str::to_owned).to_vec());
    };
    let field = |value: &Dynamic| {
        let name = value.clone().into_string().unwrap_or_default();
        if FIELDS.contains(&name.as_str()) {
            return Ok(name);
        }
        let meant = nearest(&name, FIELDS.iter().copied());
        let suggestion = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
        let message = format!("there is no field {}", call.show(value));
        let hint = format!("{suggestion}fields: {}", FIELDS.join(", "));
        Err(call.error(message).hint(hint).at(CallPart::Key("fields".into())))
    };
    given.iter().map(field).collect()
}
