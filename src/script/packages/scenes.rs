//! Scenes: beams, point masses, stations, supports and joints, masses and initial velocities.

use std::rc::Rc;

use rhai::Dynamic;

use super::geometry::CURVE;
use super::sections::{MESH_KINDS, SECTION, mesh_of};
use crate::beams::{Mesh, TaperQuadrature};
use crate::geometry::{Curve, Vec2};
use crate::joints::{JointKind, Partner};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, either, name, number, object, options, point, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method, property};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::joint::JointHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::section::SectionHandle;
use crate::script::handles::station::{StationHandle, here};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::system::{
    BeamDefinition, ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity, SystemError,
};

pub const TABLE: BindingTable = BindingTable {
    name: "scenes",
    doc: "A scene describes beams, particles, joints, masses and loads. scene.start(…) creates a \
        simulation of it.",
    types: &[SCENE, BEAM, STATION, JOINT],
    setup: ROD,
    constants: &[],
    rows: &[
        function("new_scene", &[name("name").or(Presence::Text("scene"))], |call| {
            Ok(Dynamic::from(SceneHandle::new(Scene::new(call.text("name")?.as_str()))))
        })
        .returns(Returns::object(SCENE))
        .summary("Creates an empty scene; its name appears in messages and reports.")
        .example("let scene = new_scene(\"pendulum\");")
        .with_related(&["beam", "start"]),
        method(SCENE, "beam", &[options("options", BEAM_KEYS)], beam)
            .returns(Returns::object(BEAM))
            .summary("Adds a beam that is free of stress in its undeformed shape.")
            .doc(
                "axis is a curve. basis is a mesh or a knot vector; default: 16 cubic C2 spans, 32 if a slider slides on \
                the beam, up to 64 if a curved axis, a varying section or close forces require it. \
                velocity and spin define the initial rigid body motion; spin is about the \
                point `about`, default: the centre of mass. Default names: beam1, beam2, …",
            )
            .example("let mast = scene.beam(#{ name: \"mast\", axis: line([0, 0], [0, 3]), section: s });\nprint(mast);")
            .with_related(&["section", "bspline", "line"]),
        method(SCENE, "particle", &[point("position").unit("length"), number("mass").unit("mass"), options("options", PARTICLE_KEYS).optional()], particle)
            .returns(Returns::object(STATION))
            .summary("Adds a point mass with its own position and returns its only station.")
            .doc(
                "The station accepts forces, hinges, velocities and sliders. A particle has no \
                rotation, so moments, clamps and rigid joints are refused with an error. \
                Default names: particle1, particle2, …",
            )
            .example(
                "let stone = scene.particle([0, 3], 0.5, #{ name: \"stone\", velocity: [1, 0] });\n\
                 scene.gravity([0, -9.81]);\nprint(stone);",
            )
            .with_related(&["slider", "mass"]),
        property(BEAM, "start", |call| station(call, |_| 0.0))
            .returns(Returns::object(STATION))
            .summary("Start station of the beam.")
            .example("print(rod.start);"),
        property(BEAM, "end", |call| station(call, |length| length))
            .returns(Returns::object(STATION))
            .summary("End station of the beam.")
            .example("scene.clamp(rod.end);"),
        property(BEAM, "middle", |call| station(call, |length| 0.5 * length))
            .returns(Returns::object(STATION))
            .summary("Station at half the undeformed length of the beam.")
            .example("scene.spring(rod.middle, [0, 1], #{ stiffness: 100 });"),
        method(BEAM, "at", &[number("s").unit("length").doc("undeformed arc length from the start")], |call| {
            let s = call.number("s")?;
            station(call, |_| s)
        })
        .returns(Returns::object(STATION))
        .summary("Returns the station of the beam at an undeformed arc length from its start.")
        .example("scene.hinge(rod.at(rod.length / 2));"),
        property(BEAM, "length", |call| Ok(call.receiver::<BeamHandle>()?.length().into()))
            .returns(Returns::NUMBER.unit("length"))
            .summary("Undeformed length of the beam.")
            .example("check(rod.length == 2);"),
        property(BEAM, "name", |call| Ok(call.receiver::<BeamHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the beam.")
            .example("check(rod.name == \"rod\");"),
        property(SCENE, "name", |call| Ok(call.receiver::<SceneHandle>()?.scene().borrow().name.clone().into()))
            .returns(Returns::TEXT)
            .summary("Name of the scene.")
            .example("check(new_scene(\"pendulum\").name == \"pendulum\");"),
        method(SCENE, "clamp", &[AT], |call| join(call, JointKind::Rigid))
            .returns(Returns::object(JOINT))
            .summary("Fixes the position and the angle of a station.")
            .doc("At an interior station the mesh becomes C0, so that the shear force can jump \
                there.")
            .example("scene.clamp(rod.start);")
            .with_related(&["hinge", "rigid"]),
        method(SCENE, "hinge", &[AT, OTHER], |call| join(call, JointKind::Hinge))
            .returns(Returns::object(JOINT))
            .summary("Fixes the position of a station, or joins two stations so that they can rotate \
                relative to each other.")
            .example("scene.hinge(rod.start);")
            .with_related(&["clamp", "rigid", "release"]),
        method(SCENE, "rigid", &[AT, object("other", STATION)], |call| join(call, JointKind::Rigid))
            .returns(Returns::object(JOINT))
            .summary("Joins two stations rigidly: their relative position and angle stay as in the \
                undeformed scene.")
            .example(
                "let arm = scene.beam(#{ axis: line([2, 0], [2, 1]), basis: bspline(4), section: s });\n\
                 scene.rigid(rod.end, arm.start);",
            )
            .with_related(&["hinge"]),
        method(SCENE, "mass", &[AT, number("mass").unit("mass"), ROTARY], |call| {
            let (station, scene) = here(call, "station")?;
            let (mass, rotary_inertia) = (call.number("mass")?, call.number("rotary_inertia")?);
            scene.borrow_mut().add_mass(PointMass { station, mass, rotary_inertia })?;
            Ok(Dynamic::UNIT)
        })
        .summary("Attaches a point mass to a station.")
        .example("scene.mass(rod.end, 1.5);"),
        method(SCENE, "velocity", &[AT, point("velocity").unit("length/time"), SPIN], |call| {
            let (station, scene) = here(call, "station")?;
            let (velocity, spin) = (call.point("velocity")?, call.optional_number("spin"));
            let earlier = scene.borrow().velocities.iter().rev().find(|one| one.station == station).copied();
            if let Some(earlier) = earlier.filter(|one| (one.velocity, one.spin) != (velocity, spin)) {
                let at = scene.borrow().describe(&station);
                report_replaced(call, &format!("the velocity at {at}"), (earlier.velocity, velocity));
            }
            scene.borrow_mut().velocities.push(StationVelocity { station, velocity, spin });
            Ok(Dynamic::UNIT)
        })
        .summary("Sets the initial velocity of the node at a station, and of no other node.")
        .doc("Use scene.beam(#{ …, velocity: [1, 0], spin: 2 }) for the initial velocity of a \
            whole beam. Where a moving body is joined to a beam at rest, the node of the beam \
            needs the velocity of the joined point of the body: set it with this function.")
        .example("scene.velocity(rod.end, [0, -1]);")
        .with_related(&["beam"]),
        method(SCENE, "gravity", &[point("acceleration").unit("length/time²")], |call| {
            let gravity = call.point("acceleration")?;
            let handle = call.receiver::<SceneHandle>()?;
            let earlier = std::mem::replace(&mut handle.change().gravity, gravity);
            if earlier != Vec2::zeros() && earlier != gravity {
                let name = handle.scene().borrow().name.clone();
                report_replaced(call, &format!("the gravity of '{name}'"), (earlier, gravity));
            }
            Ok(Dynamic::UNIT)
        })
        .summary("Sets the acceleration of gravity; default: none.")
        .doc("A scene has one acceleration of gravity. A second call replaces the first one and \
            prints a note.")
        .example("scene.gravity([0, -9.81]);"),
    ],
};

fn report_replaced(call: &Call, what: &str, (earlier, now): (Vec2, Vec2)) {
    let [earlier, now] = [earlier, now]
        .map(|vector| format!("({}, {})", format_number(vector.x), format_number(vector.y)));
    call.context().print_message(&format!("note: {what} was {earlier} and is now {now}"));
}

pub(super) const ROD: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });";

pub const SCENE: Type = Type::of::<SceneHandle>();
pub const BEAM: Type = Type::of::<BeamHandle>();
pub const STATION: Type = Type::of::<StationHandle>();
pub const JOINT: Type = Type::of::<JointHandle>();

/// Largest relative difference between the length of a beam axis and its length on the mesh for which no warning is printed.
const MISSED_LENGTH: f64 = 0.01;

const AT: Parameter = object("station", STATION);
const OTHER: Parameter =
    object("other", STATION).doc("second station; default: the ground").optional();
const SPIN: Parameter = number("spin").unit("1/time").optional();
const ROTARY: Parameter = number("rotary_inertia").unit("mass·length²").or(Presence::Number(0.0));
pub(super) const START_VELOCITY: Parameter =
    point("velocity").unit("length/time").doc("initial velocity of the point `about`").optional();
pub(super) const START_SPIN: Parameter =
    number("spin").unit("1/time").doc("initial angular velocity").optional();
pub(super) const START_ABOUT: Parameter = point("about")
    .unit("length")
    .doc("centre of the initial rotation; default: the centre of mass")
    .requires_key("spin")
    .optional();
const BEAM_KEYS: &[Parameter] = &[
    object("axis", CURVE).doc("undeformed centroid line"),
    either("basis", MESH_KINDS)
        .doc("mesh or knot vector; default: chosen from the scene")
        .optional(),
    object("section", SECTION).doc("stiffness and inertia"),
    text("name").optional(),
    START_VELOCITY,
    START_SPIN,
    START_ABOUT,
];
const PARTICLE_KEYS: &[Parameter] = &[
    text("name").optional(),
    point("velocity").unit("length/time").doc("initial velocity; default: at rest").optional(),
];

pub(super) fn start_motion(options: &Options) -> Result<StartMotion, ScriptError> {
    let given = |key: &str| options.has(key).then(|| options.point(key)).transpose();
    Ok(StartMotion {
        velocity: given("velocity")?.unwrap_or_default(),
        spin: options.optional_number("spin").unwrap_or(0.0),
        centre: given("about")?,
    })
}

fn beam(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let named = options.optional_text("name")?;
    let mesh = match mesh_of(&options, "basis") {
        Some(mesh) => mesh,
        None => Mesh::automatic(1)?,
    };
    let motion = start_motion(&options)?;
    let SectionHandle { variation, relaxation, .. } = options.get("section")?;
    let definition = BeamDefinition {
        name: named.unwrap_or_else(|| scene.scene().borrow().free_name("beam")),
        axis: Curve::clone(&*options.get::<Rc<Curve>>("axis")?),
        mesh,
        section: variation,
        motion,
    };
    let added = scene.change().add_beam(definition);
    let index = added.map_err(|error| ScriptError::from(error).at(CallPart::Key("name".into())))?;
    scene.change().choose_mesh(index);
    if let Some(relaxation) = relaxation {
        scene.change().add_damping(index, relaxation)?;
    }
    warn_about_taper(call, &scene, index)?;
    warn_about_length(call, &scene, index)?;
    scene.expect_constant_length(index).map_err(|error| error.at(CallPart::Key("axis".into())))?;
    Ok(Dynamic::from(BeamHandle { scene, index }))
}

fn warn_about_taper(call: &Call, scene: &SceneHandle, index: usize) -> Result<(), ScriptError> {
    let scene = scene.scene().borrow();
    let BeamDefinition { name, section, mesh, .. } = &scene.beams[index];
    let seen = TaperQuadrature::of(section, mesh)?;
    if !seen.is_coarse() {
        return Ok(());
    }
    let parts = [
        ("mass", seen.mass),
        ("axial stiffness", seen.stretching),
        ("bending stiffness", seen.bending),
    ];
    let off = parts.into_iter().filter(|(_, part)| *part >= TaperQuadrature::TOLERANCE);
    let deviations: Vec<String> =
        off.map(|(what, part)| format!("{what} by {} %", significant(100.0 * part, 2))).collect();
    call.context().print_message(&format!(
        "note: the mesh of beam '{name}' is too coarse for its varying section; errors at the \
        quadrature points: {}. Place knots where the section jumps or bends, knots(3, […]), \
        use more spans, or join separate beams there",
        deviations.join(", ")
    ));
    Ok(())
}

fn warn_about_length(call: &Call, scene: &SceneHandle, index: usize) -> Result<(), ScriptError> {
    let scene = scene.scene().borrow();
    let beam = &scene.beams[index];
    let ratio = beam.meshed_length()? / beam.axis.length();
    if (ratio - 1.0).abs() <= MISSED_LENGTH {
        return Ok(());
    }
    call.context().print_message(&format!(
        "note: the mesh of beam '{}' is too coarse for its curved axis: its length and mass are \
        {} of those of the axis; use more spans or a higher degree",
        beam.name,
        significant(ratio, 3)
    ));
    Ok(())
}

fn particle(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options_or_defaults("options")?;
    let name = options.optional_text("name")?;
    let definition = ParticleDefinition {
        name: name.unwrap_or_else(|| scene.scene().borrow().free_name("particle")),
        position: call.point("position")?,
    };
    let added = scene.change().add_particle(definition, call.number("mass")?);
    let station = added.map_err(|error| match error {
        SystemError::Value { .. } => ScriptError::from(error).at(CallPart::Argument(1)),
        _ => ScriptError::from(error).at(CallPart::Key("name".into())),
    })?;
    if options.has("velocity") {
        let velocity = options.point("velocity")?;
        let moving = StationVelocity { station, velocity, spin: None };
        scene.change().velocities.push(moving);
    }
    Ok(Dynamic::from(StationHandle { scene, station }))
}

fn station(call: &mut Call, arc_length: impl FnOnce(f64) -> f64) -> Result<Dynamic, ScriptError> {
    let BeamHandle { scene, index } = call.receiver::<BeamHandle>()?;
    let length = scene.scene().borrow().beams[index].axis.length();
    let station = scene.scene().borrow_mut().station(index, arc_length(length))?;
    Ok(Dynamic::from(StationHandle { scene, station }))
}

fn join(call: &mut Call, kind: JointKind) -> Result<Dynamic, ScriptError> {
    let (station, scene) = here(call, "station")?;
    let partner =
        if call.has("other") { Partner::Station(here(call, "other")?.0) } else { Partner::Ground };
    scene.borrow_mut().join(kind, station, partner)?;
    newest_joint(call)
}

pub(super) fn newest_joint(call: &Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let index = scene.scene().borrow().joints.len() - 1;
    Ok(Dynamic::from(JointHandle { scene, index }))
}
