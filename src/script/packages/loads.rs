//! Loads on a scene.

use std::cell::RefCell;

use rhai::Dynamic;

use super::drives::blame;
use super::scenes::{BEAM, SCENE, STATION};
use super::schedules::{
    DELAY, SAMPLE, SCHEDULE_KINDS, beat_of, controlled_schedule_of, expect_controller,
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
    doc: "A load is where, what and when. Without a schedule it acts always; a number or a function of time will do too.",
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
        .summary("A force at a station; it keeps its direction, or follows the section.")
        .doc("With #{ frame: \"follower\" } its components are along the beam as drawn and across it, or along the axes of a rigid body, and turn with the section. \
A function of two arguments, |t, q| …, is a sampled controller: it is asked at the start of every step with the simulation, as \
              scene.record asks, and its value holds for the step, so that the feedback is late by half a step in the mean, of first order in dt; adaptive steps ask it in their middle too, and see what it misses. Its work is counted like that \
              of any load. With #{ sample: 0.01 } it is a digital one, asked at 0, 0.01, 0.02, … and held between; steps end there, so that how long they are does not change what it sees by more than the error of the method; \
              with #{ sample: 0.01, delay: 0.003 } what it says acts 0.003 later, and nothing does before the first command. What it said goes back with the simulation. A function that changes a variable of its own has a memory which does not go back with the simulation: it is asked again when a step of varying size is rejected, after sim.back and sim.rewind, and \
              when earlier states are looked at, and another simulation of the scene, or a copy, finds it as the last one left it; so let it depend on t and q, and keep sums in what moves (an integral of the error is the angle of a free body under a moment), or take fixed steps and go only forward. With a name the history has work.NAME and NAME.force.")
        .example("scene.force(rod.end, [8, 0], hold_for(2.5));\nscene.force(rod.end, [0, 1], 1, #{ frame: \"follower\" });\n\
                 scene.force(rod.end, [0, 1], |t, q| -2 * q.velocity(rod.end).y, #{ name: \"brake\" });\n\
                 scene.force(rod.middle, [0, 1], |t, q| -q.velocity(rod.middle).y, #{ sample: 0.1, delay: 0.02 });\n\
                 let sim = scene.start(#{ dt: 0.05 });\nsim.run_to(1);\n\
                 check(sim.history.last(\"work.brake\") < 0);")
        .see(&["moment", "line_load", "hold_for"]),
        method(SCENE, "moment", &[AT, number("moment").unit("force·length"), WHEN, NAMED], |call| {
            let (station, scene) = here(call, "station")?;
            let kind = LoadKind::Moment { station, moment: call.number("moment")? };
            let schedule = when(call)?;
            add(&scene, call, kind, schedule)
        })
        .summary("A moment at a station, counter-clockwise.")
        .example("scene.moment(rod.end, -80, hold_for(2.5));")
        .see(&["force"]),
        method(SCENE, "line_load", &[object("beam", BEAM), point("force").unit("force/length"), WHEN, FRAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let beam = call.get::<BeamHandle>("beam")?.own(&scene)?;
            let kind = LoadKind::Line { beam, force: call.point("force")?, frame: frame(call)? };
            let schedule = when(call)?;
            add(&scene.shared(), call, kind, schedule)
        })
        .summary("A force per length on a whole beam; it keeps its direction, or follows the sections like a pressure.")
        .example("scene.line_load(rod, [0, -2], ramp(0, 1));\nscene.line_load(rod, [0, 1], 1, #{ frame: \"follower\" });")
        .see(&["force", "gravity"]),
    ],
};

const AT: Parameter = object("station", STATION);
const WHEN: Parameter = either("schedule", SCHEDULE_KINDS)
    .doc("when it acts: a schedule, a factor, or a function of time")
    .optional();
const FRAME: Parameter = options("options", &[FRAME_KEY, NAME, SAMPLE, DELAY]).optional();
const NAMED: Parameter = options("options", &[NAME, SAMPLE, DELAY]).optional();
const NAME: Parameter =
    text("name").doc("by which the history has work.NAME and what the load is").optional();
const FRAME_KEY: Parameter = choice("frame", &["dead", "follower"])
    .doc("dead keeps its direction, follower turns with the section")
    .or(Presence::Text("dead"));

fn when(call: &Call) -> Result<Schedule, ScriptError> {
    let beat = beat_of(&*call.options_or_defaults("options")?)?;
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
    match call.options_or_defaults("options")?.text_if_given("name")? {
        Some(name) => scene.borrow_mut().add_named_load(name, kind, schedule).map_err(blame)?,
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
