//! Scenes: beams, particles, stations, supports and joints, masses and start velocities.

use std::cell::RefCell;
use std::rc::Rc;

use rhai::Dynamic;

use super::geometry::CURVE;
use super::live::SimulationHandle;
use super::sections::{MESH_KINDS, SECTION, mesh_of};
use crate::beams::{self, BodyIndex, Mesh, Station};
use crate::geometry::Curve;
use crate::joints::{JointKind, Partner};
use crate::model::{
    BeamDefinition, ModelError, ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity,
};
use crate::output::significant;
use crate::script::looks::details;
use crate::script::rows::call::Call;
use crate::script::rows::kind::{Details, Scripted, Type};
use crate::script::rows::parameter::{
    Parameter, Presence, either, name, number, object, options, point, text,
};
use crate::script::rows::table::{Table, function, method, property};
use crate::script::words::error::{Place, ScriptError};

/// Scenes and what stands in them.
pub const TABLE: Table = Table {
    name: "scenes",
    doc: "A scene is a description: beams, particles, joints, masses and loads. scene.start(…) makes a simulation of it.",
    types: &[SCENE, BEAM, STATION],
    setup: ROD,
    constants: &[],
    rows: &[
        function("new_scene", &[name("name").or(Presence::Text("scene"))], |call| {
            Ok(Dynamic::from(SceneHandle::new(Scene::new(call.text("name")?.as_str()))))
        })
        .returns("a scene")
        .summary("An empty scene; its name appears in messages and reports.")
        .example("let scene = new_scene(\"pendulum\");")
        .see(&["beam", "start"]),
        method(SCENE, "beam", &[options("options", BEAM_KEYS)], beam)
            .returns("a beam")
            .summary("Adds a beam, free of stress as drawn.")
            .doc(
                "axis is a curve; basis a mesh or a knot vector (16 cubic C2 spans unless given); velocity and spin are the \
                 rigid motion it starts with, about its centre of mass or the point `about`. Beams are called beam1, beam2, … \
                 unless they get a name.",
            )
            .example("let mast = scene.beam(#{ name: \"mast\", axis: line([0, 0], [0, 3]), section: s });\nprint(mast);")
            .see(&["section", "bspline", "line"]),
        method(SCENE, "particle", &[point("position").unit("length"), number("mass").unit("mass"), options("options", PARTICLE_KEYS).optional()], particle)
            .returns("a station")
            .summary("Adds a point mass that moves by itself; what is returned is its only station.")
            .doc(
                "The station takes forces, hinges, velocities and sliders; a particle does not turn, so it takes no moment, clamp or \
                 rigid joint. Particles are called particle1, particle2, … unless they get a name.",
            )
            .example(
                "let stone = scene.particle([0, 3], 0.5, #{ name: \"stone\", velocity: [1, 0] });\n\
                 scene.gravity([0, -9.81]);\nprint(stone);",
            )
            .see(&["slider", "mass"]),
        property(BEAM, "start", |call| station(call, |_| 0.0))
            .returns("a station")
            .summary("The station at its start.")
            .example("print(rod.start);"),
        property(BEAM, "end", |call| station(call, |length| length))
            .returns("a station")
            .summary("The station at its end.")
            .example("scene.clamp(rod.end);"),
        method(BEAM, "at", &[number("s").unit("length").doc("arc length from the start, as drawn")], |call| {
            let s = call.number("s")?;
            station(call, |_| s)
        })
        .returns("a station")
        .summary("The station at an arc length from its start, measured on the beam as drawn.")
        .example("scene.hinge(rod.at(rod.length / 2));"),
        property(BEAM, "length", |call| Ok(call.receiver::<BeamHandle>()?.length().into()))
            .returns("a number [length]")
            .summary("Its length as drawn.")
            .example("check(rod.length == 2);"),
        property(BEAM, "name", |call| Ok(call.receiver::<BeamHandle>()?.name().into()))
            .returns("a text")
            .summary("Its name.")
            .example("check(rod.name == \"rod\");"),
        property(SCENE, "name", |call| Ok(call.receiver::<SceneHandle>()?.scene().borrow().name.clone().into()))
            .returns("a text")
            .summary("Its name.")
            .example("check(new_scene(\"pendulum\").name == \"pendulum\");"),
        method(SCENE, "clamp", &[AT], |call| join(call, JointKind::Rigid))
            .summary("Holds position and angle of a station.")
            .doc("Inside a beam the mesh becomes only C0 there, so that the shear force can jump.")
            .example("scene.clamp(rod.start);")
            .see(&["hinge", "rigid"]),
        method(SCENE, "hinge", &[AT, OTHER], |call| join(call, JointKind::Hinge))
            .summary("Holds the position of a station, or joins two stations that stay free to turn against each other.")
            .example("scene.hinge(rod.start);")
            .see(&["clamp", "rigid"]),
        method(SCENE, "rigid", &[AT, object("other", STATION)], |call| join(call, JointKind::Rigid))
            .summary("Joins two stations in position and angle, as drawn.")
            .example(
                "let arm = scene.beam(#{ axis: line([2, 0], [2, 1]), basis: bspline(4), section: s });\n\
                 scene.rigid(rod.end, arm.start);",
            )
            .see(&["hinge"]),
        method(SCENE, "mass", &[AT, number("mass").unit("mass"), ROTARY], |call| {
            let (station, scene) = here(call, "station")?;
            let (mass, rotary_inertia) = (call.number("mass")?, call.number("rotary_inertia")?);
            scene.borrow_mut().add_mass(PointMass { station, mass, rotary_inertia })?;
            Ok(Dynamic::UNIT)
        })
        .summary("Puts a point mass on a station.")
        .example("scene.mass(rod.end, 1.5);"),
        method(SCENE, "velocity", &[AT, point("velocity").unit("length/time"), SPIN], |call| {
            let (station, scene) = here(call, "station")?;
            let (velocity, spin) = (call.point("velocity")?, call.number_if_given("spin"));
            scene.borrow_mut().velocities.push(StationVelocity { station, velocity, spin });
            Ok(Dynamic::UNIT)
        })
        .summary("Gives the node at a station, and it alone, a velocity to start with.")
        .doc("A beam as a whole is given a velocity where it is made: scene.beam(#{ …, velocity: [1, 0], spin: 2 }).")
        .example("scene.velocity(rod.end, [0, -1]);")
        .see(&["beam"]),
        method(SCENE, "gravity", &[point("acceleration").unit("length/time²")], |call| {
            let gravity = call.point("acceleration")?;
            call.receiver::<SceneHandle>()?.scene().borrow_mut().gravity = gravity;
            Ok(Dynamic::UNIT)
        })
        .summary("The acceleration of free fall; none unless given.")
        .example("scene.gravity([0, -9.81]);"),
    ],
};

/// How examples get a beam.
pub(super) const ROD: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });";

/// The scene type, for other domains.
pub const SCENE: Type = Type::of::<SceneHandle>();
/// The beam type, for other domains.
pub const BEAM: Type = Type::of::<BeamHandle>();
/// The station type, for other domains.
pub const STATION: Type = Type::of::<StationHandle>();

/// Spans of a beam whose basis is not given.
const SPANS: usize = 16;

const AT: Parameter = object("station", STATION);
const OTHER: Parameter = object("other", STATION).doc("the ground unless given").optional();
const SPIN: Parameter = number("spin").unit("1/time").optional();
const ROTARY: Parameter = number("rotary_inertia").unit("mass·length²").or(Presence::Number(0.0));
const BEAM_KEYS: &[Parameter] = &[
    object("axis", CURVE).doc("the centroid line as drawn"),
    either("basis", MESH_KINDS).doc("a mesh or a knot vector").optional(),
    object("section", SECTION).doc("stiffness and inertia"),
    text("name").optional(),
    point("velocity").unit("length/time").doc("of the point `about`, at the start").optional(),
    number("spin").unit("1/time").doc("rate of rotation at the start").optional(),
    point("about")
        .unit("length")
        .doc("the point it turns about at the start; its centre of mass unless given")
        .optional(),
];
const PARTICLE_KEYS: &[Parameter] = &[
    text("name").optional(),
    point("velocity").unit("length/time").doc("at the start; at rest unless given").optional(),
];

/// A scene that a script holds.
#[derive(Clone)]
pub struct SceneHandle(Rc<RefCell<Scene>>);

/// A beam of a scene.
#[derive(Clone)]
pub struct BeamHandle {
    pub(super) scene: SceneHandle,
    pub(super) index: usize,
}

/// A station of a beam of a scene.
#[derive(Clone)]
pub struct StationHandle {
    pub(super) scene: SceneHandle,
    pub(super) station: Station,
}

impl SceneHandle {
    /// A handle on a scene of its own.
    pub fn new(scene: Scene) -> Self {
        Self(Rc::new(RefCell::new(scene)))
    }

    /// The scene itself.
    pub fn scene(&self) -> &RefCell<Scene> {
        &self.0
    }

    /// The station of a handle, if it is one of this scene.
    pub fn own(&self, handle: &StationHandle) -> Result<Station, ScriptError> {
        self.expect_same(&handle.scene, "station")?;
        Ok(handle.station)
    }

    /// Refuses a thing of another scene; `what` is the kind of the thing.
    pub fn expect_same(&self, other: &Self, what: &str) -> Result<(), ScriptError> {
        if Rc::ptr_eq(&self.0, &other.0) {
            return Ok(());
        }
        let (mine, other) = (&self.0.borrow().name, &other.0.borrow().name);
        let told = match mine == other {
            true => format!("the {what} belongs to another scene that is called '{other}' too"),
            false => format!("the {what} belongs to the scene '{other}', not to '{mine}'"),
        };
        Err(ScriptError::new(told).hint(format!("use a {what} of this scene")))
    }
}

impl BeamHandle {
    /// The index of the beam, if it is one of the scene.
    pub fn own(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "beam")?;
        Ok(self.index)
    }

    fn length(&self) -> f64 {
        self.scene.0.borrow().beams[self.index].axis.length()
    }

    fn name(&self) -> String {
        self.scene.0.borrow().beams[self.index].name.clone()
    }
}

impl StationHandle {
    /// The station itself.
    pub fn station(&self) -> Station {
        self.station
    }

    /// Its place in a simulation, if that is one of its scene.
    pub fn on(&self, handle: &SimulationHandle) -> Result<beams::Place, ScriptError> {
        let simulation = handle.simulation();
        self.within(handle.scene(), simulation.scene(), simulation.model().meshes())
    }

    /// Its place among the meshes of a scene that was built when it was `built`, if it is one of that scene.
    pub fn within(
        &self,
        of: &SceneHandle,
        built: &Scene,
        meshes: &[Mesh],
    ) -> Result<beams::Place, ScriptError> {
        of.own(self)?;
        let known = match self.station.body {
            BodyIndex::Beam(beam) => beam < built.beams.len(),
            BodyIndex::Particle(particle) => particle < built.particles.len(),
        };
        if !known {
            let told = format!("{} was added after the scene was started", self.show());
            return Err(
                ScriptError::new(told).hint("add everything before scene.start(…), or start again")
            );
        }
        Ok(built.place(&self.station, meshes)?)
    }
}

impl Scripted for SceneHandle {
    const NAME: &'static str = "scene";
    const DOC: &'static str = "A description of beams, particles, joints, masses and loads.";

    fn show(&self) -> String {
        let scene = self.0.borrow();
        let count = |(number, what): (usize, &str)| {
            format!("{number} {what}{}", if number == 1 { "" } else { "s" })
        };
        let always = [(scene.beams.len(), "beam")];
        let if_any = [(scene.particles.len(), "particle"), (scene.sliders.len(), "slider")];
        let last = [(scene.joints.len(), "joint"), (scene.loads().count(), "load")];
        let some = if_any.into_iter().filter(|(number, _)| *number > 0);
        let parts: Vec<String> = always.into_iter().chain(some).chain(last).map(count).collect();
        format!("scene '{}' with {}", scene.name, parts.join(", "))
    }

    fn details(&self) -> Details {
        details::of_scene(&self.0.borrow())
    }
}

impl Scripted for BeamHandle {
    const NAME: &'static str = "beam";
    const DOC: &'static str = "A flexible beam of a scene.";

    fn show(&self) -> String {
        let scene = self.scene.0.borrow();
        let beam = &scene.beams[self.index];
        format!(
            "beam '{}' of length {}, {}",
            beam.name,
            significant(beam.axis.length(), 7),
            beam.mesh.describe()
        )
    }

    fn details(&self) -> Details {
        details::of_beam(&self.scene.0.borrow(), self.index)
    }
}

impl Scripted for StationHandle {
    const NAME: &'static str = "station";
    const DOC: &'static str = "A place on a beam, or a particle.";

    fn show(&self) -> String {
        self.scene.0.borrow().describe(&self.station)
    }

    fn details(&self) -> Details {
        details::of_station(&self.scene.0.borrow(), &self.station)
    }
}

/// The scene that is called, and one of its stations.
pub(super) fn here(call: &Call, name: &str) -> Result<(Station, Rc<RefCell<Scene>>), ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let station = scene.own(&call.get::<StationHandle>(name)?)?;
    Ok((station, scene.0))
}

fn beam(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let named = options.text("name").map(|name| name.to_string());
    let mesh = match mesh_of(&options, "basis") {
        Some(mesh) => mesh,
        None => Mesh::bspline(SPANS, 3, 2)?,
    };
    let motion = StartMotion {
        velocity: if options.has("velocity") {
            options.point("velocity")?
        } else {
            StartMotion::default().velocity
        },
        spin: options.number_if_given("spin").unwrap_or(0.0),
        about: if options.has("about") { Some(options.point("about")?) } else { None },
    };
    let definition = BeamDefinition {
        name: named.unwrap_or_else(|_| scene.0.borrow().free_name("beam")),
        axis: Curve::clone(&*options.get::<Rc<Curve>>("axis")?),
        mesh,
        section: options.get("section")?,
        motion,
    };
    let added = scene.0.borrow_mut().add_beam(definition);
    let index = added.map_err(|error| ScriptError::from(error).at(Place::Key("name".into())))?;
    Ok(Dynamic::from(BeamHandle { scene, index }))
}

fn particle(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options_or_defaults("options")?;
    let name = options.text("name").map(|name| name.to_string());
    let definition = ParticleDefinition {
        name: name.unwrap_or_else(|_| scene.0.borrow().free_name("particle")),
        position: call.point("position")?,
    };
    let added = scene.0.borrow_mut().add_particle(definition, call.number("mass")?);
    let station = added.map_err(|error| match error {
        ModelError::Value { .. } => ScriptError::from(error).at(Place::Argument(1)),
        _ => ScriptError::from(error).at(Place::Key("name".into())),
    })?;
    if options.has("velocity") {
        let velocity = options.point("velocity")?;
        let moving = StationVelocity { station, velocity, spin: None };
        scene.0.borrow_mut().velocities.push(moving);
    }
    Ok(Dynamic::from(StationHandle { scene, station }))
}

fn station(call: &mut Call, arc_length: impl FnOnce(f64) -> f64) -> Result<Dynamic, ScriptError> {
    let BeamHandle { scene, index } = call.receiver::<BeamHandle>()?;
    let length = scene.0.borrow().beams[index].axis.length();
    let station = scene.0.borrow_mut().station(index, arc_length(length))?;
    Ok(Dynamic::from(StationHandle { scene, station }))
}

fn join(call: &mut Call, kind: JointKind) -> Result<Dynamic, ScriptError> {
    let (station, scene) = here(call, "station")?;
    let partner =
        if call.has("other") { Partner::Station(here(call, "other")?.0) } else { Partner::Ground };
    scene.borrow_mut().join(kind, station, partner)?;
    Ok(Dynamic::UNIT)
}
