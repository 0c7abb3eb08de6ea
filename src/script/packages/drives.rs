//! Script functions for supports that fix some displacements or the angle of a station, prescribed motions of stations, and motors.

use rhai::{Dynamic, FnPtr, ImmutableString};

use super::scenes::{JOINT, SCENE, STATION, newest_joint};
use super::schedules::{
    DELAY, SAMPLE, SCHEDULE_KINDS, controlled_schedule_of, expect_controller, sample_clock_of,
    schedule_of,
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
    doc: "A support fixes displacements or the rotation of a station; a drive prescribes them as \
        functions of time. Prescribed components are not unknowns: position and angle are \
        exact at the end of every step, and the required force is the reaction. With drives E \
        - W + D, p - ∫F dt and L - ∫M dt stay constant to rounding. The history has work.NAME \
        of every drive and every named load, NAME.torque of a motor, and NAME.x, NAME.y and \
        NAME.angle of a drive made by scene.move: its force in x and y and its moment, as \
        means of each step. The product of the moment and the rotation is exactly the work, \
        for any rotation. scene.record(\"NAME.power\") adds the mean power of each step.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "support", &[AT, options("options", SUPPORT_KEYS)], support)
            .returns(Returns::object(JOINT))
            .summary("Fixes some displacements of a station to the ground: x, y, angle, or the \
                displacement normal to a direction.")
            .doc("A roller on a floor is #{ y: true }. along: [1, 0] is the same, given by the \
                free direction, and along: [1, 1] is an inclined roller; its reaction is \
                normal to this direction. With angle: true it is a guide, which does not \
                rotate. Use scene.clamp to fix everything and scene.hinge to fix the position.")
            .example("scene.hinge(rod.start);\nscene.support(rod.end, #{ y: true });\nlet cart = scene.particle([0, 1], 2);\nscene.support(cart, #{ along: [1, -1] });\n\
                      scene.gravity([0, -9.81]);\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
                      check_close(sim.velocity(cart).norm(), 9.81 * sqrt(0.5), 1e-9);")
            .with_related(&["clamp", "hinge", "move"]),
        method(SCENE, "move", &[AT, options("options", MOVE_KEYS)], drive)
            .summary("Prescribes the motion of a station: x, y and angle, or some of them, as \
                functions of time.")
            .doc("x and y are displacements from the undeformed position, angle is the rotation \
                from the undeformed angle. Each must be 0 at t = 0 and must not jump; a jump \
                is refused with an error when the run reaches it. schedules::smooth_step of \
                std/schedules moves to a place in a given time. Steps end at kinks; a function \
                declares them by schedule(|t| …, [times]). x_speed and y_speed prescribe rates \
                instead, starting from the undeformed position: a function of time, or a \
                controller |t, q| …, called at the start of every step. The initial velocity \
                of the node is that of the function; for a beam at rest this is an impact. \
                scene.equilibrium evaluates drives at the option `time`, in proportion to the \
                load factor.")
            .example("scene.move(rod.start, #{ x: 0, y: |t| 0.01 * (1 - cos(40 * t)), angle: 0, name: \"shaker\" });\n\
                      let sim = scene.start(#{ dt: 0.005 });\nsim.run_to(0.5);\n\
                      check_close(sim.position(rod.start).y, 0.01 * (1 - cos(20)), 1e-14);\n\
                      check(sim.history.drift(\"energy\") < 1e-10);\nprint(sim.history.last(\"work.shaker\"));\n\
                      // A trolley that is driven to x = 3 by its speed.\n\
                      let yard = new_scene(\"yard\");\nlet trolley = yard.particle([0, 0], 1);\n\
                      yard.move(trolley, #{ x_speed: |t, q| 2 * (3 - q.position(trolley).x), y: 0 });")
            .with_related(&["motor", "support"]),
        method(SCENE, "motor", &[AT, options("options", MOTOR_KEYS)], motor)
            .summary("Rotates a section relative to the ground: by a prescribed angle, at a \
                prescribed speed, or with a torque.")
            .doc("angle is the rotation since the start, a function of time; it is exact at the \
                end of every step. speed is a rate: a built-in schedule is integrated exactly, \
                a function of time at three Gauss points of each step, and a note tells when \
                it changes faster than that. torque is a moment, \
                positive counter-clockwise. speed and torque may also be sampled controllers \
                |t, q| …; see scene.force for the times of the calls and for sample and delay. \
                The section can still move in x and y: add a hinge to fix it.")
            .example("scene.hinge(rod.start);\nscene.motor(rod.start, #{ angle: |t| 0.5 * t * t });\n\
                      let sim = scene.start(#{ dt: 0.1 });\nsim.run_to(2);\n\
                      check_close(sim.angle(rod.start), 2, 1e-12);\n\
                      print(sim.history.last(\"motor1.torque\"));")
            .with_related(&["move", "moment"]),
    ],
};

const AT: Parameter = object("station", STATION);
const NAME: Parameter = text("name").optional();
const SUPPORT_KEYS: &[Parameter] = &[
    boolean("x").doc("true to fix x").optional(),
    boolean("y").doc("true to fix y").optional(),
    boolean("angle").doc("true to fix the angle").optional(),
    point("along")
        .doc("direction along which the station can move, in place of x and y")
        .optional(),
];
const MOVE_KEYS: &[Parameter] = &[
    either("x", SCHEDULE_KINDS).unit("length").optional(),
    either("y", SCHEDULE_KINDS).unit("length").optional(),
    either("angle", SCHEDULE_KINDS).unit("rad").optional(),
    either(SPEEDS[0], SCHEDULE_KINDS)
        .unit("length/time")
        .doc("rate of x, in place of x; also a controller |t, q| …")
        .optional(),
    either(SPEEDS[1], SCHEDULE_KINDS)
        .unit("length/time")
        .doc("rate of y, in place of y; also a controller |t, q| …")
        .optional(),
    NAME,
    SAMPLE,
    DELAY,
];
const SPEEDS: [&str; 2] = ["x_speed", "y_speed"];
const MOTOR_KEYS: &[Parameter] = &[
    either("angle", SCHEDULE_KINDS).unit("rad").doc("rotation since the start").optional(),
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
                let message =
                    format!("{odd} is given together with along; along already determines x and y");
                return Err(call.error(message).at(CallPart::Key(odd.into())));
            }
            let kind = if is_held("angle") { JointKind::guide } else { JointKind::roller };
            let message = "along has no direction: it is [0, 0]";
            let hint = "write along: [1, 1], or another direction in which the station can move";
            let refused = || call.error(message).hint(hint).at(CallPart::Key("along".into()));
            Some(kind(options.point("along")?).ok_or_else(refused)?)
        }
        false => Components::among(|at| is_held(at.name())).map(JointKind::Support),
    };
    let Some(held) = held else {
        return Err(call
            .error("no component is fixed")
            .hint("write #{ y: true }, or set some of x, y and angle")
            .at(CallPart::Argument(1)));
    };
    scene.borrow_mut().join(held, station, Partner::Ground)?;
    newest_joint(call)
}

fn drive(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let beat = sample_clock_of(&options)?;
    let mut motions = [None, None, None];
    for (motion, component) in motions.iter_mut().zip(Component::ALL) {
        let key = component.name();
        if options.has(key) {
            let rate = match component {
                Component::Rotation => "scene.motor(station, #{ speed: |t, q| … })".to_owned(),
                _ => format!("{key}_speed: |t, q| …"),
            };
            *motion = Some(PrescribedMotion::Position(place_of(call, &options, key, &rate)?));
        }
    }
    for (motion, key) in motions.iter_mut().zip(SPEEDS).filter(|(_, key)| options.has(key)) {
        if motion.is_some() {
            let place = key.trim_end_matches("_speed");
            let message = format!("both {place} and {key} are given");
            let hint = format!("leave out {place} or {key}");
            return Err(call.error(message).hint(hint).at(CallPart::Key(key.into())));
        }
        let scene = call.receiver::<SceneHandle>()?;
        let rate = controlled_schedule_of(call, &options, key, &scene, beat)?;
        *motion = Some(PrescribedMotion::Rate(rate));
    }
    if motions.iter().all(Option::is_none) {
        return Err(call
            .error("no component is moved")
            .hint("write #{ y: |t| 0.1 * t }, or set some of x, y and angle")
            .at(CallPart::Argument(1)));
    }
    expect_controller(call, beat, motions.iter().flatten().map(PrescribedMotion::schedule))?;
    add(call, DriveKind::Move, motions, &options)
}

pub(super) fn place_of(
    call: &Call,
    options: &Options,
    key: &str,
    rate: &str,
) -> Result<Schedule, ScriptError> {
    let function = options.get_if::<FnPtr>(key);
    if function.is_some_and(|function| call.arguments_of(&function) == Some(2)) {
        let message = format!(
            "{key} is a position; a controller must not set it, because it would jump at every \
            call"
        );
        let hint = format!("prescribe the rate instead: {rate}");
        return Err(call.error(message).hint(hint).at(CallPart::Key(key.into())));
    }
    schedule_of(call, options, key)
}

fn motor(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let mut given = ["angle", "speed", "torque"].into_iter().filter(|key| options.has(key));
    let Some(key) = given.next() else {
        let message = "the angle, speed or torque is missing";
        let hint = "give one of angle, speed and torque: #{ angle: |t| 3 * t * t }";
        return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
    };
    if let Some(odd) = given.next() {
        let message = format!("both {key} and {odd} are given");
        return Err(call
            .error(message)
            .hint(format!("leave out {odd}"))
            .at(CallPart::Key(odd.into())));
    }
    let beat = sample_clock_of(&options)?;
    let schedule = match key {
        "angle" => place_of(call, &options, key, "speed: |t, q| …")?,
        _ => controlled_schedule_of(call, &options, key, &call.receiver::<SceneHandle>()?, beat)?,
    };
    expect_controller(call, beat, std::iter::once(&schedule))?;
    match key {
        "angle" => add(
            call,
            DriveKind::Motor,
            [None, None, Some(PrescribedMotion::Position(schedule))],
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
                let message = format!("the angle of {place} is fixed, so a torque has no effect");
                return Err(call
                    .error(message)
                    .hint("use scene.hinge in place of scene.clamp")
                    .at(CallPart::Argument(0)));
            }
            let name = name_of(&options).unwrap_or_else(|| scene.borrow().free_name("motor"));
            let kind = LoadKind::Moment { station, moment: 1.0 };
            scene.borrow_mut().add_named_load(name, kind, schedule).map_err(drive_error)?;
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
    scene.borrow_mut().add_drive(drive).map_err(drive_error)?;
    Ok(Dynamic::UNIT)
}

pub(super) fn drive_error(error: SystemError) -> ScriptError {
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
