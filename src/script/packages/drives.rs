//! Supports of single components, and prescribed motions: stations that follow functions of time, motors.

use rhai::{Dynamic, FnPtr, ImmutableString};

use super::scenes::{JOINT, SCENE, STATION, newest_joint};
use super::schedules::{
    DELAY, SAMPLE, SCHEDULE_KINDS, beat_of, controlled_schedule_of, expect_controller, schedule_of,
};
use crate::joints::{Component, Components, JointKind, Partner};
use crate::loads::{LoadKind, PrescribedMotion, Schedule};
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, boolean, either, object, options, point, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::here;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{Drive, DriveKind, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "supports and drives",
    doc: "A support holds movements of a station, a drive gives them as functions of time. What is given is no unknown: place and angle are \
          exact at the end of every step, however long, and what it takes is the reaction. A drive does work: E - W + D, p - ∫F dt and L - ∫M dt stay at \
          rounding with it. The history has work.NAME of every drive and of every load with a name, NAME.torque of a motor, and NAME.x, NAME.y and NAME.angle \
          of what moves a station: its force along each, and its moment, mean of each step; a moment is the one whose work is with the angle that the section turns by, \
          exact however far that is.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "support", &[AT, options("options", SUPPORT_KEYS)], support)
            .returns(Returns::object(JOINT))
            .summary("Holds some of the movements of a station on the ground: x, y, angle, or all across a direction.")
            .doc("A roller on a floor is #{ y: true }; along: [1, 0] says the same by the direction in which it stays free, and along: [1, 1] is an inclined \
                  roller; its reaction is across that direction. angle: true beside it makes a guide of it, that does not turn. What holds everything is scene.clamp, what holds the position scene.hinge.")
            .example("scene.hinge(rod.start);\nscene.support(rod.end, #{ y: true });\nlet cart = scene.particle([0, 1], 2);\nscene.support(cart, #{ along: [1, -1] });\n\
                      scene.gravity([0, -9.81]);\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
                      check_close(sim.velocity(cart).norm(), 9.81 * sqrt(0.5), 1e-9);")
            .see(&["clamp", "hinge", "move"]),
        method(SCENE, "move", &[AT, options("options", MOVE_KEYS)], drive)
            .summary("Gives the motion of a station: x, y and angle, each a function of time, or some of them.")
            .doc("They are displacements from the place as drawn, and the turn from the angle as drawn, so that each must be 0 at t = 0 and may not jump, which is refused where it happens; schedules::smooth_step of std/schedules leads to a place in a time. Steps end \
                  where a schedule bends; a function bends at schedule(|t| …, [times]). x_speed and y_speed give a rate in place of x and y, from the place as drawn on: a function of time, or a controller \
                  |t, q| … that is asked at the start of every step, as the speed of a motor. The node there begins with the rate of the function: where its beam rests, that is a blow. At rest \
                  (scene.equilibrium) they are taken at the option `time` and put on with the loads, by the load factor.")
            .example("scene.move(rod.start, #{ x: 0, y: |t| 0.01 * (1 - cos(40 * t)), angle: 0, name: \"shaker\" });\n\
                      let sim = scene.start(#{ dt: 0.005 });\nsim.run_to(0.5);\n\
                      check_close(sim.position(rod.start).y, 0.01 * (1 - cos(20)), 1e-14);\n\
                      check(sim.history.drift(\"energy\") < 1e-10);\nprint(sim.history.last(\"work.shaker\"));\n\
                      // A trolley that is driven to x = 3 by its speed.\n\
                      let yard = new_scene(\"yard\");\nlet trolley = yard.particle([0, 0], 1);\n\
                      yard.move(trolley, #{ x_speed: |t, q| 2 * (3 - q.position(trolley).x), y: 0 });")
            .see(&["motor", "support"]),
        method(SCENE, "motor", &[AT, options("options", MOTOR_KEYS)], motor)
            .summary("Turns a section from the ground: by an angle or at a speed that is given, or with a torque.")
            .doc("angle is the turn since the start, a function of time, and exact at the end of every step. speed is a rate: its integral over a step is taken by \
                  three Gauss points, exact for polynomials of degree five. torque is a moment, counter-clockwise. speed and torque may be functions |t, q| … of the simulation too: sampled controllers, as in scene.force, where it says when they are asked, and what sample and delay make of them. The section keeps free to move along x and y \
                  unless something holds it there, so hinge it.")
            .example("scene.hinge(rod.start);\nscene.motor(rod.start, #{ angle: |t| 0.5 * t * t });\n\
                      let sim = scene.start(#{ dt: 0.1 });\nsim.run_to(2);\n\
                      check_close(sim.angle(rod.start), 2, 1e-12);\n\
                      print(sim.history.last(\"motor1.torque\"));")
            .see(&["move", "moment"]),
    ],
};

const AT: Parameter = object("station", STATION);
const NAME: Parameter = text("name").optional();
const SUPPORT_KEYS: &[Parameter] = &[
    boolean("x").doc("whether x is held").optional(),
    boolean("y").doc("whether y is held").optional(),
    boolean("angle").doc("whether the angle is held").optional(),
    point("along")
        .doc("a direction along which the station stays free, in place of x and y")
        .optional(),
];
const MOVE_KEYS: &[Parameter] = &[
    either("x", SCHEDULE_KINDS).unit("length").optional(),
    either("y", SCHEDULE_KINDS).unit("length").optional(),
    either("angle", SCHEDULE_KINDS).unit("rad").optional(),
    either(SPEEDS[0], SCHEDULE_KINDS)
        .unit("length/time")
        .doc("in place of x, its rate; also a controller |t, q| …")
        .optional(),
    either(SPEEDS[1], SCHEDULE_KINDS)
        .unit("length/time")
        .doc("in place of y, its rate; also a controller |t, q| …")
        .optional(),
    NAME,
    SAMPLE,
    DELAY,
];
const SPEEDS: [&str; 2] = ["x_speed", "y_speed"];
const MOTOR_KEYS: &[Parameter] = &[
    either("angle", SCHEDULE_KINDS).unit("rad").doc("the turn since the start").optional(),
    either("speed", SCHEDULE_KINDS).unit("rad/time").optional(),
    either("torque", SCHEDULE_KINDS).unit("force·length").optional(),
    NAME,
    SAMPLE,
    DELAY,
];

fn support(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (station, scene) = here(call, "station")?;
    let options = call.options("options")?;
    let is_held = |key: &str| options.boolean(key).unwrap_or(false);
    let held = match options.has("along") {
        true => {
            if let Some(odd) = ["x", "y"].into_iter().find(|key| options.has(key)) {
                let told =
                    format!("along says which of x and y is held, and {odd} is given besides");
                return Err(call.error(told).at(CallPart::Key(odd.into())));
            }
            let kind = if is_held("angle") { JointKind::guide } else { JointKind::roller };
            let told = "along has no direction: it is [0, 0]";
            let hint = "write along: [1, 1], or the direction of the line on which it may move";
            let refused = || call.error(told).hint(hint).at(CallPart::Key("along".into()));
            Some(kind(options.point("along")?).ok_or_else(refused)?)
        }
        false => Components::among(|at| is_held(at.name())).map(JointKind::Support),
    };
    let Some(held) = held else {
        return Err(call
            .error("it holds nothing")
            .hint("write #{ y: true }, or some of x, y and angle")
            .at(CallPart::Argument(1)));
    };
    scene.borrow_mut().join(held, station, Partner::Ground)?;
    newest_joint(call)
}

fn drive(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let beat = beat_of(&options)?;
    let mut motions = [None, None, None];
    for (motion, component) in motions.iter_mut().zip(Component::ALL) {
        let key = component.name();
        if options.has(key) {
            let rate = match component {
                Component::Rotation => "scene.motor(station, #{ speed: |t, q| … })".to_owned(),
                _ => format!("{key}_speed: |t, q| …"),
            };
            *motion = Some(PrescribedMotion::Place(place_of(call, &options, key, &rate)?));
        }
    }
    for (motion, key) in motions.iter_mut().zip(SPEEDS).filter(|(_, key)| options.has(key)) {
        if motion.is_some() {
            let place = key.trim_end_matches("_speed");
            let told = format!("{place} says where it is, and {key} is given besides");
            let hint = format!("leave out {place} or {key}");
            return Err(call.error(told).hint(hint).at(CallPart::Key(key.into())));
        }
        let scene = call.receiver::<SceneHandle>()?;
        let rate = controlled_schedule_of(call, &options, key, &scene, beat)?;
        *motion = Some(PrescribedMotion::Rate(rate));
    }
    if motions.iter().all(Option::is_none) {
        return Err(call
            .error("it moves nothing")
            .hint("write #{ y: |t| 0.1 * t }, or some of x, y and angle")
            .at(CallPart::Argument(1)));
    }
    expect_controller(call, beat, motions.iter().flatten().map(PrescribedMotion::schedule))?;
    add(call, DriveKind::Move, motions, &options)
}

/// Schedule of a position; the hint for a controller suggests a rate instead.
fn place_of(
    call: &Call,
    options: &Options,
    key: &str,
    rate: &str,
) -> Result<Schedule, ScriptError> {
    let function = options.get_if::<FnPtr>(key);
    if function.is_some_and(|function| call.arguments_of(&function) == Some(2)) {
        let told = format!("{key} is a place, which would jump wherever a controller speaks");
        let hint = format!("let it give a rate, {rate}");
        return Err(call.error(told).hint(hint).at(CallPart::Key(key.into())));
    }
    schedule_of(call, options, key)
}

fn motor(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let mut given = ["angle", "speed", "torque"].into_iter().filter(|key| options.has(key));
    let Some(key) = given.next() else {
        let told = "how it turns is missing";
        let hint = "give one of angle, speed and torque: #{ angle: |t| 3 * t * t }";
        return Err(call.error(told).hint(hint).at(CallPart::Argument(1)));
    };
    if let Some(odd) = given.next() {
        let told = format!("its {key} says how it turns, and {odd} is given besides");
        return Err(call
            .error(told)
            .hint(format!("leave out {odd}"))
            .at(CallPart::Key(odd.into())));
    }
    let beat = beat_of(&options)?;
    let schedule = match key {
        "angle" => place_of(call, &options, key, "speed: |t, q| …")?,
        _ => controlled_schedule_of(call, &options, key, &call.receiver::<SceneHandle>()?, beat)?,
    };
    expect_controller(call, beat, std::iter::once(&schedule))?;
    match key {
        "angle" => add(
            call,
            DriveKind::Motor,
            [None, None, Some(PrescribedMotion::Place(schedule))],
            &options,
        ),
        "speed" => add(
            call,
            DriveKind::Motor,
            [None, None, Some(PrescribedMotion::Rate(schedule))],
            &options,
        ),
        _ => {
            let (station, scene) = here(call, "station")?;
            if scene.borrow().is_held(&station, Component::Rotation) {
                let place = scene.borrow().describe(&station);
                let told = format!("the angle of {place} is held, so that no torque turns it");
                return Err(call
                    .error(told)
                    .hint("use scene.hinge in place of scene.clamp")
                    .at(CallPart::Argument(0)));
            }
            let name = name_of(&options).unwrap_or_else(|| scene.borrow().free_name("motor"));
            let kind = LoadKind::Moment { station, moment: 1.0 };
            scene.borrow_mut().add_named_load(name, kind, schedule).map_err(blame)?;
            Ok(Dynamic::UNIT)
        }
    }
}

fn name_of(options: &Options) -> Option<String> {
    options.get_if::<ImmutableString>("name").map(String::from)
}

fn add(
    call: &Call,
    kind: DriveKind,
    motions: [Option<PrescribedMotion>; 3],
    options: &Options,
) -> Result<Dynamic, ScriptError> {
    let (station, scene) = here(call, "station")?;
    let name = name_of(options).unwrap_or_else(|| scene.borrow().free_name(kind.name()));
    let drive = Drive { name, kind, station, motions };
    scene.borrow_mut().add_drive(drive).map_err(blame)?;
    Ok(Dynamic::UNIT)
}

pub(super) fn blame(error: SystemError) -> ScriptError {
    let place = match &error {
        SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
            CallPart::Key("name".into())
        }
        SystemError::AlreadyDriven { component, .. }
        | SystemError::DriveStart { component, .. }
        | SystemError::DriveJump { component, .. } => CallPart::Key((*component).into()),
        _ => CallPart::Argument(0),
    };
    ScriptError::from(error).at(place)
}
