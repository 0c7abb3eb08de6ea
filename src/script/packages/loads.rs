//! Loads on a scene.

use std::cell::RefCell;

use rhai::Dynamic;

use super::drives::drive_error;
use super::scenes::{BEAM, SCENE, STATION};
use super::schedules::{
    DELAY, SAMPLE, SCHEDULE_KINDS, controlled_schedule_of, expect_controller, sample_clock_of,
};
use crate::loads::{LoadFrame, LoadKind, Schedule};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{
    Parameter, Presence, choice, either, number, object, options, point, text,
};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::here;
use crate::script::messages::error::ScriptError;
use crate::system::Scene;

pub const TABLE: BindingTable = BindingTable {
    name: "loads",
    doc: "Loads: forces, moments and line loads. A load acts always unless it has a schedule; a \
        number or a function of time is also accepted as a schedule.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "force", &[AT, point("force").unit("force"), WHEN, FRAME], |call| {
            let (station, scene) = here(call, "station")?;
            let kind = LoadKind::Force { station, force: call.point("force")?, frame: frame(call)? };
            let schedule = when(call)?;
            add(&scene, call, kind, schedule)
        })
        .summary("Adds a force at a station that keeps its direction or follows the section.")
        .doc("With #{ frame: \"follower\" } the components are along and across the undeformed \
            beam, or along the axes of a rigid body, and rotate with the section. A function \
            |t, q| … is a sampled controller: it is called at the start of every step with the \
            simulation q, and its value holds for the step. The mean delay of the feedback is \
            half a step; adaptive steps also call it in their middle to estimate this error. \
            Its work is counted like that of any load. With #{ sample: 0.01 } the controller \
            is called at 0, 0.01, 0.02, …, and its value is held in between. Steps end at \
            these times, so that the samples depend on the step size only by the error of the \
            method. With #{ sample: 0.01, delay: 0.003 } the value acts 0.003 later; before \
            the first value nothing acts. sim.back and sim.rewind restore the values of a \
            controller, but not variables that the function itself changes: it is called again \
            when an adaptive step is rejected, after going back, and when earlier states are \
            read, and other simulations and copies of the scene share the variables. Let the \
            function depend on t and q only, and model memory by a moving body (an integral of \
            the error is the angle of a free body under a moment); otherwise use fixed steps \
            and never go back. With a name the history has work.NAME and NAME.force.")
        .example("scene.force(rod.end, [8, 0], hold_for(2.5));\nscene.force(rod.end, [0, 1], 1, #{ frame: \"follower\" });\n\
                 scene.force(rod.end, [0, 1], |t, q| -2 * q.velocity(rod.end).y, #{ name: \"brake\" });\n\
                 scene.force(rod.middle, [0, 1], |t, q| -q.velocity(rod.middle).y, #{ sample: 0.1, delay: 0.02 });\n\
                 let sim = scene.start(#{ dt: 0.05 });\nsim.run_to(1);\n\
                 check(sim.history.last(\"work.brake\") < 0);")
        .with_related(&["moment", "line_load", "hold_for", "contact_force", "joint_force"]),
        method(SCENE, "moment", &[AT, number("moment").unit("force·length"), WHEN, NAMED], |call| {
            let (station, scene) = here(call, "station")?;
            let kind = LoadKind::Moment { station, moment: call.number("moment")? };
            let schedule = when(call)?;
            add(&scene, call, kind, schedule)
        })
        .summary("Adds a moment at a station, positive counter-clockwise.")
        .example("scene.moment(rod.end, -80, hold_for(2.5));")
        .with_related(&["force"]),
        method(SCENE, "line_load", &[object("beam", BEAM), point("force").unit("force/length"), WHEN, FRAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let beam = call.get::<BeamHandle>("beam")?.index_in(&scene)?;
            let kind = LoadKind::Line { beam, force: call.point("force")?, frame: frame(call)? };
            let schedule = when(call)?;
            add(&scene.shared_for_change(), call, kind, schedule)
        })
        .summary("Adds a force per length on a whole beam that keeps its direction or follows the \
            sections like a pressure.")
        .example("scene.line_load(rod, [0, -2], ramp(0, 1));\nscene.line_load(rod, [0, 1], 1, #{ frame: \"follower\" });")
        .with_related(&["force", "gravity"]),
    ],
};

const AT: Parameter = object("station", STATION);
const WHEN: Parameter = either("schedule", SCHEDULE_KINDS)
    .doc("schedule of the load: a schedule, a factor, or a function of time")
    .optional();
const FRAME: Parameter = options("options", &[FRAME_KEY, NAME, SAMPLE, DELAY]).optional();
const NAMED: Parameter = options("options", &[NAME, SAMPLE, DELAY]).optional();
const NAME: Parameter =
    text("name").doc("name for the history columns work.NAME and NAME.force").optional();
const FRAME_KEY: Parameter = choice("frame", &["dead", "follower"])
    .doc("\"dead\" keeps its direction, \"follower\" rotates with the section")
    .or(Presence::Text("dead"));

fn when(call: &Call) -> Result<Schedule, ScriptError> {
    let beat = sample_clock_of(&*call.options_or_defaults("options")?)?;
    let scene = call.receiver::<SceneHandle>()?;
    let schedule = controlled_schedule_of(call, call, "schedule", &scene, beat)?;
    expect_controller(call, beat, std::iter::once(&schedule))?;
    Ok(schedule)
}

fn add(
    scene: &RefCell<Scene>,
    call: &Call,
    kind: LoadKind,
    schedule: Schedule,
) -> Result<Dynamic, ScriptError> {
    match call.options_or_defaults("options")?.optional_text("name")? {
        Some(name) => {
            scene.borrow_mut().add_named_load(name, kind, schedule).map_err(drive_error)?
        }
        None => scene.borrow_mut().add_load(kind, schedule),
    }
    Ok(Dynamic::UNIT)
}

fn frame(call: &Call) -> Result<LoadFrame, ScriptError> {
    if !call.has("options") {
        return Ok(LoadFrame::Dead);
    }
    let options = call.options("options")?;
    Ok(if options.text("frame")? == "follower" { LoadFrame::Follower } else { LoadFrame::Dead })
}
