//! Estimated discretisation errors of a simulation.

use std::time::Duration;

use rhai::{Array, Dynamic, INT, Map};

use super::integrators::INTEGRATOR;
use super::scenes::SCENE;
use super::simulations::{SIMULATION, SPINNING};
use crate::analysis::DiscretisationError;
use crate::integrators::Method;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, boolean, name, number, object, options, text,
};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::script::state::settings::RunMode;
use crate::script::studies::error_estimate::{ErrorEstimate, QuantityError};
use crate::script::studies::refined_run::{RefinedRun, RefinedRunRequest, RefinedRunRow};

pub const TABLE: BindingTable = BindingTable {
    name: "error estimates",
    doc: "Estimated discretisation errors of a simulation. Conserved energy and momenta do not \
        show that a motion is right. sim.error_estimate() repeats the run with two and four \
        times the step, and with three quarters and half of the spans, and derives the errors in \
        time and in space from the differences (Richardson extrapolation with the observed \
        order). The simulation itself is not changed.",
    types: &[ERROR_ESTIMATE, REFINED_RUN],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(SIMULATION, "error_estimate", &[options("options", KEYS).optional()], estimate)
            .returns(Returns::object(ERROR_ESTIMATE))
            .summary("Estimates the errors of positions and recorded quantities in time and in space.")
            .doc("The companion runs start where the simulation was started, call its \
                controllers, conditions and events again, and use all cores if there are no \
                such functions. Their cost is about that of the run itself. Verdicts: \
                'converged' if the observed order in time is near that of the integrator, in \
                space near that of the mesh, and the differences of the runs are similar functions of \
                time; 'pre-asymptotic' if not, then the error may differ from the estimate by more than a factor of 3 and is \
                usually smaller; 'chaotic' if nearby runs converge up to a time and separate afterwards; \
                'exact' if the runs agree to rounding. Meshes of one to three spans are compared \
                with finer meshes. A function that changes variables of the script, also a \
                load |t| …, cannot be repeated; the printed estimate then states the reason. Errors of the model \
                itself are not included, such as unknown stiffnesses.")
            .example("sim.run_to(1);\nlet error = sim.error_estimate();\nprint(error);\n\
                      check(error.verdict == \"converged\" && error.of(\"positions\").present < 0.01);")
            .with_related(&["study_convergence", "study_work_precision", "notes", "invariants"]),
        method(SCENE, "solve", &[options("options", SOLVE)], solve)
            .returns(Returns::object(REFINED_RUN))
            .summary("Runs a scene with smaller and smaller steps and finer meshes until the estimated error meets a tolerance.")
            .doc("The first run has 50 steps and the meshes as given. After each run the error is \
                estimated as by sim.error_estimate(), and steps and spans are refined by powers of \
                two where their part of the error is too large. The result has the last run, \
                `simulation`, and all runs as `rows`: the error against run time of the scene. The \
                tolerance applies to the largest error of positions in the run, relative to the \
                length of the longest beam. The search ends after 12 runs or after \
                max_time; `reached` then is false.")
            .example("let found = scene.solve(#{ to: 1, error: 1e-4 });\nprint(found.simulation);\n\
                      check(found.reached && found.simulation.t == 1);\n\
                      for run in found.rows { print(`dt = ${run.dt}: ${run.in_time}`); }")
            .with_related(&["error_estimate", "start", "study_work_precision"]),
        property(REFINED_RUN, "simulation", |call| Ok(Dynamic::from(call.receiver::<RefinedRun>()?.simulation)))
            .returns(Returns::object(SIMULATION))
            .summary("Last run of scene.solve, at its end.")
            .example("let found = scene.solve(#{ to: 0.5, error: 1e-2 });\ncheck(found.simulation.t == 0.5);"),
        property(REFINED_RUN, "reached", |call| Ok(call.receiver::<RefinedRun>()?.failure.is_none().into()))
            .returns(Returns::BOOLEAN)
            .summary("True if the tolerance of scene.solve was reached.")
            .example("check(scene.solve(#{ to: 0.5, error: 1e-2 }).reached);"),
        property(REFINED_RUN, "rows", |call| {
            let found = call.receiver::<RefinedRun>()?;
            Ok(found.rows.iter().map(|row| Dynamic::from(run(row))).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map).with_remark(" #{ spans, dt, steps, in_time, in_space, seconds, verdict }"))
        .summary("Runs of scene.solve with the largest errors of positions, relative to the length of the longest beam.")
        .example("let rows = scene.solve(#{ to: 0.5, error: 1e-2 }).rows;\ncheck(rows[0].dt == 0.01);"),
        property(ERROR_ESTIMATE, "verdict", |call| {
            let error = call.receiver::<ErrorEstimate>()?;
            let verdict = error.together().map(QuantityError::verdict);
            Ok(verdict.unwrap_or_else(|| "not estimated".to_owned()).into())
        })
        .returns(Returns::TEXT)
        .summary("Verdict on the errors of all positions together.")
        .example("sim.run_to(1);\ncheck(sim.error_estimate().verdict == \"converged\");"),
        property(ERROR_ESTIMATE, "summary", |call| Ok(call.receiver::<ErrorEstimate>()?.summary().into()))
            .returns(Returns::TEXT)
            .summary("Error of all positions together, in one line.")
            .example("sim.run_to(1);\nprint(sim.error_estimate().summary);"),
        property(ERROR_ESTIMATE, "rows", |call| {
            let error = call.receiver::<ErrorEstimate>()?;
            let rows = error.quantities.iter().map(|quantity| Dynamic::from(row(quantity)));
            Ok(rows.collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("Errors of all quantities as maps, with the keys of error.of(…).")
        .example("sim.run_to(1);\nfor row in sim.error_estimate().rows { print(`${row.name}: ${row.largest}`); }"),
        method(ERROR_ESTIMATE, "of", &[text("name")], of)
            .returns(Returns::MAP.with_remark(" #{ name, dimension, scale, present, largest, verdict, time_present, time_largest, time_order, space_present, space_largest, space_order }"))
            .summary("Errors of one quantity: \"positions\", a station such as \"rod.end\", or a column of the history.")
            .doc("`present` and `largest` are the sums of the errors in time and in space at the \
                present time, and their largest values of the run. Missing values are ().")
            .example("sim.run_to(1);\nlet tip = sim.error_estimate().of(\"rod.end\");\n\
                      check(tip.time_order > 1.5 && tip.present == tip.time_present + tip.space_present);"),
    ],
};

pub(super) const ERROR: Parameter = boolean("error")
    .doc("true to estimate the errors, as sim.error_estimate() does, and to add them")
    .optional();

const KEYS: &[Parameter] = &[number("max_time")
    .positive()
    .unit("s")
    .doc("longest time of each companion run without script functions")
    .optional()];

const SOLVE: &[Parameter] = &[
    number("to").positive().unit("time").doc("end of the run"),
    number("error")
        .positive()
        .or(Presence::Number(1e-3))
        .doc("largest error of positions, relative to the length of the longest beam"),
    object("integrator", INTEGRATOR).doc("integrator; default: energy_momentum()").optional(),
    name("name").doc("name in the report; default: the name of the scene").optional(),
    number("max_time")
        .positive()
        .unit("s")
        .or(Presence::Number(60.0))
        .doc("time after which no further run is started"),
];

const REFINED_RUN: Type = Type::of::<RefinedRun>();

pub(super) const ERROR_ESTIMATE: Type = Type::of::<ErrorEstimate>();

impl Scripted for ErrorEstimate {
    const NAME: &'static str = "error_estimate";
    const DOC: &'static str = "Estimated discretisation errors of a simulation.";

    fn show(&self) -> String {
        self.table()
    }
}

impl Scripted for RefinedRun {
    const NAME: &'static str = "refinement";
    const DOC: &'static str = "A run that was refined until its error met a tolerance.";

    fn show(&self) -> String {
        self.table()
    }
}

fn solve(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let name = options.optional_text("name")?;
    let request = RefinedRunRequest {
        name: name.unwrap_or_else(|| scene.scene().borrow().name.clone()),
        end: options.number("to")?,
        tolerance: options.number("error")?,
        method: options.get_if::<Method>("integrator").unwrap_or_default(),
        max_time: options.number("max_time")?,
    };
    let found = match call.context().mode() {
        RunMode::DryRun => RefinedRun::dry_run(&scene, &request, call.context()),
        RunMode::Run => RefinedRun::run(&scene, &request, call.context()),
    };
    Ok(Dynamic::from(found?))
}

fn run(row: &RefinedRunRow) -> Map {
    [
        ("spans", Dynamic::from(row.spans as INT)),
        ("dt", row.dt.into()),
        ("steps", Dynamic::from(row.steps as INT)),
        ("in_time", row.in_time.into()),
        ("in_space", row.in_space.into()),
        ("seconds", row.seconds.into()),
        ("verdict", row.verdict.clone().into()),
    ]
    .into_iter()
    .map(|(key, value): (&str, Dynamic)| (key.into(), value))
    .collect()
}

fn estimate(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let limit = call.options_or_defaults("options")?.optional_number("max_time");
    let limit = limit.map(|seconds| Duration::from_secs_f64(seconds.min(1e9)));
    let estimated = match call.context().mode() {
        RunMode::DryRun => ErrorEstimate::not_estimated(&handle, "the script is only checked"),
        RunMode::Run => ErrorEstimate::estimate(&handle, call.context(), limit)?,
    };
    Ok(Dynamic::from(estimated))
}

/// Error estimate for a picture or file with the option `error`; `None` without this option or in a dry run.
pub(super) fn wanted_estimate(
    call: &Call,
    options: &Options,
    handle: &SimulationHandle,
) -> Result<Option<ErrorEstimate>, ScriptError> {
    let is_wanted = options.boolean(ERROR.name).unwrap_or(false);
    match call.context().mode() {
        RunMode::Run if is_wanted => {
            ErrorEstimate::estimate(handle, call.context(), None).map(Some)
        }
        _ => Ok(None),
    }
}

fn of(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (error, name) = (call.receiver::<ErrorEstimate>()?, call.text("name")?);
    if let Some(quantity) = error.of(&name) {
        return Ok(Dynamic::from(row(quantity)));
    }
    if call.context().mode() == RunMode::DryRun {
        return Ok(Dynamic::from(row(&QuantityError::unknown(&name))));
    }
    let known = || error.quantities.iter().map(|quantity| quantity.name.as_str());
    let hint = match nearest(&name, known()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("known quantities: {}", known().collect::<Vec<_>>().join(", ")),
    };
    let message = format!("there is no error estimate of \"{name}\"");
    Err(call.error(message).hint(hint).at(CallPart::Argument(0)))
}

fn row(quantity: &QuantityError) -> Map {
    let optional = |value: Option<f64>| value.map_or(Dynamic::UNIT, Dynamic::from);
    let read = |error: &Option<DiscretisationError>| {
        let error = error.as_ref();
        let [present, largest] = [DiscretisationError::present, DiscretisationError::largest]
            .map(|read| error.map(read));
        [present, largest, error.and_then(|error| error.order)].map(optional)
    };
    let (present, largest) = quantity.total();
    let [time_present, time_largest, time_order] = read(&quantity.in_time);
    let [space_present, space_largest, space_order] = read(&quantity.in_space);
    [
        ("name", quantity.name.clone().into()),
        ("dimension", quantity.dimension.into()),
        ("scale", quantity.scale.into()),
        ("present", present.into()),
        ("largest", largest.into()),
        ("verdict", quantity.verdict().into()),
        ("time_present", time_present),
        ("time_largest", time_largest),
        ("time_order", time_order),
        ("space_present", space_present),
        ("space_largest", space_largest),
        ("space_order", space_order),
    ]
    .into_iter()
    .map(|(key, value): (&str, Dynamic)| (key.into(), value))
    .collect()
}
