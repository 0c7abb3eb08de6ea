//! Rigid bodies of a scene, and their points.

use rhai::{Dynamic, Map};

use super::scenes::{SCENE, START_ABOUT, START_SPIN, START_VELOCITY, STATION, start_motion};
use crate::geometry::Vec2;
use crate::script::bindings::accept::as_point;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, name, number, of_any_type, options, point, points, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::rigid_body::RigidBodyHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{RigidBodyDefinition, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "rigid bodies",
    doc: "Rigid bodies with a centre of mass, mass, inertia and fixed points. The centre and the \
        points are stations: they accept hinges, clamps, rigid joints, springs, loads, masses \
        and sensors, and can slide along beams. Where a station is expected, the body itself \
        stands for its centre. Energy and momenta are kept to rounding with energy_momentum() \
        and fourth_order(), at any step size.",
    types: &[BODY],
    setup: "let scene = new_scene(\"example\");\n\
            let hub = scene.body(#{ name: \"hub\", at: [0, 0], mass: 2, inertia: 0.1, points: #{ pin: [0.5, 0], top: [0, 0.2] } });",
    constants: &[],
    rows: &[
        method(SCENE, "body", &[options("options", BODY_KEYS)], body)
            .returns(Returns::object(BODY))
            .summary("Adds a rigid body.")
            .doc(
                "points are relative to the centre of mass, in the frame of the body, which is \
                rotated by angle. One of mass and inertia may be zero if other parts of the \
                scene provide the inertia of that motion. spin is about the centre or the \
                point `about`. Pictures show the points, or the polygon `outline`; this \
                requires one point away from the centre. Default names: body1, body2, …",
            )
            .example(
                "let pendulum = scene.body(#{ at: [0, -1], mass: 1, inertia: 0.02, points: #{ pivot: [0, 1], tip: [0, -0.5] } });\n\
                 scene.hinge(pendulum.point(\"pivot\"));\n\
                 scene.gravity([0, -9.81]);\n\
                 let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.5);\n\
                 check_close(sim.position(pendulum.point(\"tip\")).y, -1.5, 1e-12);\nprint(pendulum);",
            )
            .with_related(&["point", "centre", "particle", "mass"]),
        method(BODY, "point", &[name("point")], |call| {
            let body = call.receiver::<RigidBodyHandle>()?;
            Ok(Dynamic::from(body.point(call.text("point")?.as_str())?))
        })
        .returns(Returns::object(STATION))
        .summary("Returns the station at a point of the body, by name.")
        .example("scene.hinge(hub.point(\"pin\"));")
        .with_related(&["centre", "body"]),
        property(BODY, "centre", |call| {
            Ok(Dynamic::from(call.receiver::<RigidBodyHandle>()?.centre()))
        })
        .returns(Returns::object(STATION))
        .summary("Station at the centre of mass of the body.")
        .example("scene.hinge(hub.centre);")
        .with_related(&["point"]),
        property(BODY, "name", |call| Ok(call.receiver::<RigidBodyHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the body.")
            .example("check(hub.name == \"hub\");"),
    ],
};

pub const BODY: Type = Type::of::<RigidBodyHandle>();

const BODY_KEYS: &[Parameter] = &[
    point("at").unit("length").doc("initial position of the centre of mass"),
    number("mass")
        .unit("mass")
        .or(Presence::Number(0.0))
        .doc("mass; zero is allowed with an inertia"),
    number("inertia")
        .unit("mass·length²")
        .or(Presence::Number(0.0))
        .doc("inertia about the centre of mass; zero is allowed with a mass"),
    number("angle")
        .unit("rad")
        .or(Presence::Number(0.0))
        .doc("initial rotation of the frame of the body"),
    of_any_type("points")
        .doc("map of points relative to the centre, in the frame of the body [length]")
        .optional(),
    points("outline")
        .unit("length")
        .doc(
            "corners of the polygon in pictures, relative to the centre, in the frame of the \
            body; default: the points are shown",
        )
        .optional(),
    text("name").optional(),
    START_VELOCITY,
    START_SPIN,
    START_ABOUT,
];

fn body(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let named = options.optional_text("name")?;
    let definition = RigidBodyDefinition {
        name: named.unwrap_or_else(|| scene.scene().borrow().free_name("body")),
        position: options.point("at")?,
        angle: options.number("angle")?,
        points: points_of(&options)?,
        outline: if options.has("outline") { options.points("outline")? } else { Vec::new() },
        motion: start_motion(&options)?,
    };
    let (mass, inertia) = (options.number("mass")?, options.number("inertia")?);
    let added = scene.change().add_rigid_body(definition, mass, inertia);
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
    let wrong = |message: String| {
        ScriptError::new(message).at(CallPart::Key("points".into())).hint(
            "write points: #{ pin: [0.1, 0] }: names with positions relative to the centre \
                of mass",
        )
    };
    let value = options.value("points")?;
    let Some(map) = value.read_lock::<Map>() else {
        return Err(wrong("points is not a map".to_owned()));
    };
    let point = |(name, at): (&rhai::Identifier, &Dynamic)| {
        let place = as_point(at).filter(|place| place.iter().all(|value| value.is_finite()));
        let place = place
            .ok_or_else(|| wrong(format!("point '{name}' is not a pair of finite numbers")))?;
        Ok((name.to_string(), place))
    };
    map.iter().map(point).collect()
}
