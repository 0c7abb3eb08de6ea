//! Rigid bodies of a scene, and their points.

use rhai::{Dynamic, Map};

use super::scenes::{SCENE, START_ABOUT, START_SPIN, START_VELOCITY, STATION, start_motion};
use crate::geometry::Vec2;
use crate::script::bindings::accept::as_point;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, anything, name, number, options, point, points, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::rigid_body::RigidBodyHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{RigidBodyDefinition, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "rigid bodies",
    doc: "A rigid body is a centre of mass with mass and inertia, and points that keep their places around it. Its centre and its points are stations: \
          they take hinges, clamps, rigid joints, springs, loads, masses, sensors, and slide along beams, as places of beams do; where a station is asked for, the body itself stands for its centre. Energy and momenta \
          are kept to rounding with energy_momentum() and fourth_order(), at any step.",
    types: &[BODY],
    setup: "let scene = new_scene(\"example\");\n\
            let hub = scene.body(#{ name: \"hub\", at: [0, 0], mass: 2, inertia: 0.1, points: #{ pin: [0.5, 0], top: [0, 0.2] } });",
    constants: &[],
    rows: &[
        method(SCENE, "body", &[options("options", BODY_KEYS)], body)
            .returns(Returns::object(BODY))
            .summary("Adds a rigid body.")
            .doc(
                "at is where its centre of mass is, and inertia counts about it; points are counted from it too, in the frame of the body, which is turned by \
                 angle. One of mass and inertia may be zero, if something else holds what then has no inertia. velocity and spin are the motion it starts \
                 with, about its centre or the point `about`. Pictures show it by its points, or as the polygon of `outline`, which needs one point off the centre. Bodies are called body1, body2, … unless they get a name.",
            )
            .example(
                "let pendulum = scene.body(#{ at: [0, -1], mass: 1, inertia: 0.02, points: #{ pivot: [0, 1], tip: [0, -0.5] } });\n\
                 scene.hinge(pendulum.point(\"pivot\"));\n\
                 scene.gravity([0, -9.81]);\n\
                 let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.5);\n\
                 check_close(sim.position(pendulum.point(\"tip\")).y, -1.5, 1e-12);\nprint(pendulum);",
            )
            .see(&["point", "centre", "particle", "mass"]),
        method(BODY, "point", &[name("point")], |call| {
            let body = call.receiver::<RigidBodyHandle>()?;
            Ok(Dynamic::from(body.point(call.text("point")?.as_str())?))
        })
        .returns(Returns::object(STATION))
        .summary("The station at one of its points, by its name.")
        .example("scene.hinge(hub.point(\"pin\"));")
        .see(&["centre", "body"]),
        property(BODY, "centre", |call| {
            Ok(Dynamic::from(call.receiver::<RigidBodyHandle>()?.centre()))
        })
        .returns(Returns::object(STATION))
        .summary("The station at its centre of mass.")
        .example("scene.hinge(hub.centre);")
        .see(&["point"]),
        property(BODY, "name", |call| Ok(call.receiver::<RigidBodyHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Its name.")
            .example("check(hub.name == \"hub\");"),
    ],
};

pub const BODY: Type = Type::of::<RigidBodyHandle>();

const BODY_KEYS: &[Parameter] = &[
    point("at").unit("length").doc("where its centre of mass starts"),
    number("mass").unit("mass").or(Presence::Number(0.0)).doc("zero, if it has an inertia"),
    number("inertia")
        .unit("mass·length²")
        .or(Presence::Number(0.0))
        .doc("about its centre of mass; zero, if it has a mass"),
    number("angle")
        .unit("rad")
        .or(Presence::Number(0.0))
        .doc("by which its frame is turned at the start"),
    anything("points").doc("a map of points from its centre, in its own frame [length]").optional(),
    points("outline")
        .unit("length")
        .doc("the corners of a polygon as which pictures show it, from its centre, in its own frame; else it is seen by its points")
        .optional(),
    text("name").optional(),
    START_VELOCITY,
    START_SPIN,
    START_ABOUT,
];

fn body(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let named = options.text_if_given("name")?;
    let definition = RigidBodyDefinition {
        name: named.unwrap_or_else(|| scene.scene().borrow().free_name("body")),
        position: options.point("at")?,
        angle: options.number("angle")?,
        points: points_of(&options)?,
        outline: if options.has("outline") { options.points("outline")? } else { Vec::new() },
        motion: start_motion(&options)?,
    };
    let (mass, inertia) = (options.number("mass")?, options.number("inertia")?);
    let added = scene.scene().borrow_mut().add_rigid_body(definition, mass, inertia);
    let index = added.map_err(|error| {
        let key = match &error {
            SystemError::Value { name: "rotary inertia", .. } => "inertia",
            SystemError::Value { .. } => "mass",
            SystemError::Unnamed { kind: "point", .. } => "points",
            SystemError::Outline { .. } => "outline",
            _ => "name",
        };
        ScriptError::from(error).at(CallPart::Key(key.into()))
    })?;
    Ok(Dynamic::from(RigidBodyHandle { scene, index }))
}

fn points_of(options: &Options) -> Result<Vec<(String, Vec2)>, ScriptError> {
    if !options.has("points") {
        return Ok(Vec::new());
    }
    let wrong = |told: String| {
        ScriptError::new(told)
            .at(CallPart::Key("points".into()))
            .hint("write points: #{ pin: [0.1, 0] }: names, and places from the centre of mass")
    };
    let value = options.value("points")?;
    let Some(map) = value.read_lock::<Map>() else {
        return Err(wrong("points is no map".to_owned()));
    };
    let point = |(name, at): (&rhai::Identifier, &Dynamic)| {
        let place = as_point(at).filter(|place| place.iter().all(|value| value.is_finite()));
        let place =
            place.ok_or_else(|| wrong(format!("point '{name}' is no pair of finite numbers")))?;
        Ok((name.to_string(), place))
    };
    map.iter().map(point).collect()
}
