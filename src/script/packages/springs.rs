//! Springs, dampers, tendons and torsion springs of a scene, and their results.

use rhai::{Dynamic, ImmutableString};

use super::scenes::{SCENE, STATION};
use super::schedules::{
    DELAY, SAMPLE, SCHEDULE_KINDS, controlled_schedule_of, expect_controller, sample_clock_of,
};
use super::simulations::SIMULATION;
use super::spring_laws::{ACTS, ParsedLaw, damping, law};
use crate::geometry::Vec2;
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Kind, NumberRange, Scripted, Type};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, array, callback, choice, either, number, object, options, point, points,
    text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{
    Anchor, BrakeLaw, DampingLaw, Origin, Scene, Spring, SpringKind, SpringLaw, SpringState,
    SystemError,
};

pub const TABLE: BindingTable = BindingTable {
    name: "springs and dampers",
    doc: "Springs store energy and dampers dissipate it. The energy of springs is part of the \
        energy of the scene; the dissipated energy is D in the balance E - W + D, which is \
        constant to rounding with energy_momentum() and fourth_order() for any step size and \
        stiffness. The history has the columns stored and dissipated, and for each spring or \
        damper NAME.length or NAME.angle, NAME.force, stored.NAME and dissipated.NAME. A \
        spring whose rest length or rest angle is a function of time is an actuator: a winch, \
        cylinder, muscle or servo. Its columns are NAME.rest_length or NAME.rest_angle, and \
        work.NAME. scene.record(\"NAME.power\") adds the power.",
    types: &[SPRING],
    setup: "let scene = new_scene(\"example\");\n\
            let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 1 });\n\
            let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
            scene.clamp(rod.start);\n\
            scene.gravity([0, -10]);\n\
            let bead = scene.particle([2, -1], 1, #{ name: \"bead\" });",
    constants: &[],
    rows: &[
        method(SCENE, "spring", &[FROM, TO, options("options", SPRING_KEYS)], |call| {
            let anchors = vec![anchor(call, "from")?, anchor(call, "to")?];
            add_damper(call, SpringKind::Length(anchors), &call.options("options")?)
        })
        .returns(Returns::object(SPRING))
        .summary("Adds a spring, optionally with a parallel damper, between two stations or between \
            a station and a point of the ground.")
        .doc("The tension is stiffness · (distance - length), plus damping · the rate of the \
            distance. Very stiff springs need no more iterations than soft ones. At distance \
            zero the direction is undefined and the force is zero; springs with length: 0 need \
            no direction. The damper acts also where the spring is slack. A law is sampled \
            when the spring is created, so that the polygon through the samples is exact to \
            1e-7 of the largest force. The stored energy is the exact integral of this \
            polygon, which files contain. print shows the remaining error. A law that needs \
            more than 20 000 samples, such as one with a jump, is refused with an error. \
            If the rest length depends on time, the damper acts on the rate of the distance \
            minus the rest length. The work of the actuator is the force times the decrease of \
            the rest length. The function must not jump. An equilibrium uses the rest length at \
            its option `time`; length_rate acts in motion only.")
        .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100, length: 0.5, damping: 0.5 });\n\
                  scene.spring([2, -2], bead, #{ stiffness: 20, acts: \"pull\" });\n\
                  scene.spring([0, 1], bead, #{ law: |e| 20 * e + 5 * e * e * e, range: [-2, 2] });\n\
                  // A winch that lifts the bead, and a cylinder that a controller extends.\n\
                  let winch = scene.spring([2, 3], bead, #{ stiffness: 1e3, length: |t| 4 - 0.5 * t, acts: \"pull\" });\n\
                  scene.spring([0, 2], rod.end, #{ stiffness: 1e3, length_rate: |t, q| 0.3 - q.position(rod.end).y });\n\
                  let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
                  check(sim.history.drift(\"energy\") < 1e-12);\ncheck(sim.history.last(\"dissipated\") > 0);\n\
                  print(sim.history.last(\"work.\" + winch.name));")
        .with_related(&["damper", "tendon", "torsion_spring", "spring_force", "motor"]),
        method(SCENE, "damper", &[FROM, TO, options("options", DAMPER_KEYS)], |call| {
            let anchors = vec![anchor(call, "from")?, anchor(call, "to")?];
            let options = call.options("options")?;
            add(call, SpringKind::Length(anchors), ParsedLaw::from(None), &options)
        })
        .returns(Returns::object(SPRING))
        .summary("Adds a damper between two stations, or between a station and a point of the \
            ground, with a force that depends on the rate of their distance.")
        .doc("damping may be a constant or a law: points [rate, force], or a function of the \
            rate, which is sampled over `rates` when the damper is created. The rate is \
            positive while the distance grows; the force is positive in tension. The force \
            must be 0 at rate 0 and have the sign of the rate, so that a damper only \
            dissipates; other laws are refused with an error. A step uses the force at its \
            mean rate. Springs, tendons and torsion springs accept the same laws.")
        .example("scene.damper(rod.end, [2, -1], #{ damping: 3 });\n\
                  // Of a fluid; saturated beyond 1; in one direction only.\n\
                  scene.damper(rod.end, [3, 0], #{ damping: |r| 2 * r * abs(r), rates: [-5, 5] });\n\
                  scene.damper(rod.end, [2, 2], #{ damping: [[-1, -4], [1, 4], [2, 4]] });\n\
                  scene.damper(bead, [2, -3], #{ damping: [[-1, 0], [0, 0], [1, 5]] });\n\
                  let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\ncheck(sim.history.drift(\"energy\") < 1e-12);")
        .with_related(&["spring"]),
        method(SCENE, "tendon", &[array("places").doc("stations and points of the ground"), options("options", SPRING_KEYS)], tendon)
            .returns(Returns::object(SPRING))
            .summary("Adds a rope over three or more places with uniform tension; it slides over the \
                inner places without friction.")
            .doc("The tension depends on the total length. With acts: \"pull\" the rope is slack \
                where it is shorter than `length`. With length: |t| … or length_rate it is \
                wound up or paid out, as by a winch.")
            .example("let rope = scene.tendon([[0, 1], rod.end, bead], #{ stiffness: 1e4, acts: \"pull\" });\nprint(rope);")
            .with_related(&["spring"]),
        method(SCENE, "torsion_spring", &[object("from", STATION), either("to", TURNED), options("options", TORSION_KEYS).optional()], torsion)
            .returns(Returns::object(SPRING))
            .summary("Adds a torsion spring, optionally with a parallel damper, between two sections \
                or between a section and the ground.")
            .doc("The moment is stiffness · (angle of the second section - angle of the first \
                section - angle), plus damping · the rate of that difference. Angles are \
                counted over any number of turns. With angle: |t| … or angle_rate the spring is \
                a servo with a finite stiffness.")
            .example("let arm = scene.beam(#{ axis: line([2, 0], [3, 0]), basis: bspline(4), section: s });\n\
                      scene.hinge(rod.end, arm.start);\n\
                      scene.torsion_spring(rod.end, arm.start, #{ stiffness: 3, damping: 0.1 });\n\
                      scene.torsion_spring(arm.end, #{ stiffness: 0.1, angle: |t| 0.2 * t });")
            .with_related(&["spring", "hinge", "brake"]),
        method(SCENE, "brake", &[object("from", STATION), either("to", BRAKED), options("options", BRAKE_KEYS).optional()], brake)
            .returns(Returns::object(SPRING))
            .summary("Adds a brake or clutch: Coulomb friction between two sections, or between a \
                section and the ground.")
            .doc("The brake holds with any moment up to `moment`, and slips with this moment \
                beyond it. While it holds, it deflects elastically by at most `deflection` and \
                does not creep. The dissipated energy is the moment times the slip. An \
                equilibrium with a brake is not unique and is refused; fourth_order() does not \
                support brakes.")
            .example("let arm = scene.beam(#{ axis: line([2, 0], [3, 0]), basis: bspline(4), section: s });\n\
                      scene.hinge(rod.end, arm.start);\n\
                      scene.brake(rod.end, arm.start, #{ moment: 0.5, name: \"clutch\" });\n\
                      // A brake on the ground that a controller applies above a speed.\n\
                      scene.brake(arm.end, #{ moment: |t, q| if abs(q.spin(arm.end)) > 3 { 2 } else { 0 } });\n\
                      let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
                      check(sim.history.drift(\"energy\") < 1e-12);\ncheck(sim.history.last(\"dissipated.clutch\") > 0);")
            .with_related(&["torsion_spring", "hinge", "motor"]),
        property(SPRING, "name", |call| Ok(call.receiver::<SpringHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the spring.")
            .example("check(scene.spring(rod.end, bead, #{ stiffness: 1 }).name == \"spring1\");"),
        method(SIMULATION, "spring_force", &[WHICH], |call| spring_value(call, |spring| spring.force))
            .returns(Returns::NUMBER.unit("force"))
            .summary("Returns the force of a spring and its damper, positive in tension, as the mean \
                of the last step; for a torsion spring the moment.")
            .doc("trapezoidal() and generalized_alpha() evaluate forces at the ends of steps; \
                with them it is the force at the end of the last step.")
            .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100, length: 0.9 });\nlet sim = scene.start(#{ dt: 0.01 });\n\
                      check_close(sim.spring_force(s1), 10, 1e-9);")
            .with_related(&["spring_length", "spring"]),
        method(SIMULATION, "spring_length", &[WHICH], |call| spring_value(call, |spring| spring.elongation))
            .returns(Returns::NUMBER.unit("length"))
            .summary("Returns the current length of a spring or tendon; for a torsion spring the \
                angle.")
            .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100 });\nlet sim = scene.start(#{ dt: 0.01 });\n\
                      check_close(sim.spring_length(s1), 1, 1e-9);")
            .with_related(&["spring_force", "spring"]),
    ],
};

pub(super) const SPRING: Type = Type::of::<SpringHandle>();

const WHICH: Parameter = object("spring", SPRING);
const PLACE: &[Kind] = &[Kind::Object(STATION), Kind::Point];
const FROM: Parameter = either("from", PLACE);
const TO: Parameter = either("to", PLACE);
const TURNED: &[Kind] = &[Kind::Object(STATION), Kind::Options(TORSION_KEYS)];
const BRAKED: &[Kind] = &[Kind::Object(STATION), Kind::Options(BRAKE_KEYS)];
const BRAKE_KEYS: &[Parameter] = &[
    either("moment", SCHEDULE_KINDS).unit("force·length").doc(
        "friction limit: a number, a schedule, a function of time |t| …, or a controller \
            |t, q| …; a brake with a normal force has the product of coefficient of friction, \
            normal force and radius",
    ),
    number("deflection")
        .positive()
        .unit("rad")
        .doc("elastic rotation at the largest moment so far")
        .or(Presence::Number(1e-4)),
    text("name").optional(),
    SAMPLE,
    DELAY,
];

const STIFFNESS: Parameter = number("stiffness").positive().unit("force/length").optional();
const DAMPING_KINDS: &[Kind] = &[Kind::Number(NumberRange::Finite), Kind::Function, Kind::Points];
const DAMPER_KINDS: &[Kind] = &[Kind::Number(NumberRange::Positive), Kind::Function, Kind::Points];
const DAMPING_DOC: &str = "constant, or law: function of the rate that returns the force, |rate| …, or points [rate, \
    force]";
const DAMPING: Parameter = either("damping", DAMPING_KINDS)
    .unit("force·time/length")
    .doc(DAMPING_DOC)
    .or(Presence::Number(0.0));
const RATES: Parameter = point("rates")
    .unit("length/time")
    .doc(
        "range of rates in which a function is sampled, such as [-1, 1]; linear extrapolation \
        beyond it, with a note",
    )
    .requires_key("damping")
    .optional();
const SPRING_KEYS: &[Parameter] = &[
    STIFFNESS,
    either("length", SCHEDULE_KINDS)
        .unit("length")
        .doc(
            "rest length, which is the length without force: a number or a function of time |t| …; default: the length in \
            the undeformed scene",
        )
        .optional(),
    either("length_rate", SCHEDULE_KINDS)
        .unit("length/time")
        .doc("rate of the rest length, as of a winch: a number, a function of time |t| … or a controller |t, q| …")
        .optional(),
    choice("acts", &[ACTS[0].0, ACTS[1].0, ACTS[2].0])
        .doc("direction of the force: \"pull\" for a rope, \"push\" for a bumper")
        .or(Presence::Text("both")),
    points("table")
        .doc(
            "points [length, force] in place of a stiffness; piecewise linear, extrapolated by \
            the last segments, with a note unless they are level",
        )
        .optional(),
    callback("law")
        .doc("function of the elongation that returns the force, |e| …, in place of a stiffness")
        .optional(),
    point("range")
        .unit("length")
        .doc("range of elongations in which the law is sampled; linear extrapolation beyond it, with a note")
        .requires_key("law")
        .optional(),
    DAMPING,
    RATES,
    text("name").optional(),
    SAMPLE,
    DELAY,
];
const DAMPER_KEYS: &[Parameter] = &[
    either("damping", DAMPER_KINDS).unit("force·time/length").doc(DAMPING_DOC),
    RATES,
    text("name").optional(),
];
const TORSION_KEYS: &[Parameter] = &[
    number("stiffness").positive().unit("force·length/rad").optional(),
    either("angle", SCHEDULE_KINDS)
        .unit("rad")
        .doc(
            "rest angle, which is the angle without moment: a number or a function of time |t| …; to the ground measured from the x axis like sim.angle; \
            default: the angle in the undeformed scene",
        )
        .optional(),
    either("angle_rate", SCHEDULE_KINDS)
        .unit("rad/time")
        .doc("rate of the rest angle: a number, a function of time |t| … or a controller |t, q| …")
        .optional(),
    points("table").doc("points [angle, moment] in place of a stiffness").optional(),
    callback("law")
        .doc(
            "function of the angle from the position without moment, returns the moment, |a| …, \
            in place of a stiffness",
        )
        .optional(),
    point("range")
        .unit("rad")
        .doc("range of angles in which the law is sampled")
        .requires_key("law")
        .optional(),
    either("damping", DAMPING_KINDS)
        .unit("force·length·time/rad")
        .doc(
            "constant, or law: function of the rate that returns the moment, |rate| …, or \
            points [rate, moment]",
        )
        .or(Presence::Number(0.0)),
    point("rates")
        .unit("rad/time")
        .doc("range of rates in which a function is sampled")
        .requires_key("damping")
        .optional(),
    text("name").optional(),
    SAMPLE,
    DELAY,
];

#[derive(Clone)]
pub(super) struct SpringHandle {
    scene: SceneHandle,
    index: usize,
}

impl SpringHandle {
    pub(super) fn within(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "spring").map(|()| self.index)
    }

    fn described<T>(&self, ask: impl FnOnce(&Spring) -> T) -> Option<T> {
        self.scene.scene().borrow().springs().nth(self.index).map(ask)
    }

    fn name(&self) -> String {
        self.described(|spring| spring.name.clone()).unwrap_or_default()
    }
}

impl Scripted for SpringHandle {
    const NAME: &'static str = "spring";
    const DOC: &'static str = "A spring, a damper or a tendon of a scene.";

    fn show(&self) -> String {
        self.described(|spring| {
            let scene = self.scene.scene().borrow();
            let place = |anchor: &Anchor| match anchor {
                Anchor::Station(station) => scene.describe(station),
                Anchor::Ground(_) if spring.kind.is_angle() => "the ground".to_owned(),
                Anchor::Ground(at) => {
                    format!("[{}, {}]", significant(at.x, 6), significant(at.y, 6))
                }
            };
            let places: Vec<String> = spring.anchors().iter().map(place).collect();
            format!("{} from {}", spring.object(), places.join(" to "))
        })
        .unwrap_or_default()
    }

    fn details(&self) -> Details {
        let of = |spring: &Spring| {
            let law = spring.law.as_ref().map(SpringLaw::describe);
            let damping = match &spring.damping {
                DampingLaw::Linear(constant) => {
                    (*constant > 0.0).then(|| significant(*constant, 6))
                }
                curve => curve.describe(),
            };
            let limit = match &spring.kind {
                SpringKind::Brake { law, .. } => Some(law.limit.describe()),
                SpringKind::Length(_) | SpringKind::Torsion(_) => None,
            };
            let lines = [("law", law), ("damping", damping), ("moment", limit)];
            lines
                .into_iter()
                .filter_map(|(label, value)| Some((label.to_owned(), value?)))
                .collect()
        };
        self.described(of).unwrap_or_default()
    }

    fn parameter_set(
        &self,
    ) -> Option<std::rc::Rc<crate::script::bindings::parameter_variants::ParameterSet>> {
        self.scene.parameter_set()
    }
}

fn anchor(call: &Call, name: &str) -> Result<Anchor, ScriptError> {
    match call.get_if::<StationHandle>(name) {
        Some(station) => {
            Ok(Anchor::Station(call.receiver::<SceneHandle>()?.own_station(&station)?))
        }
        None => Ok(Anchor::Ground(call.point(name)?)),
    }
}

fn add_damper(call: &Call, kind: SpringKind, options: &Options) -> Result<Dynamic, ScriptError> {
    let law = law(call, options, &kind)?;
    add(call, kind, law, options)
}

fn add(
    call: &Call,
    kind: SpringKind,
    ParsedLaw { law, origin, rest }: ParsedLaw,
    options: &Options,
) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let scene = handle.shared_for_change();
    let prefix = if law.is_none() { "damper" } else { "spring" };
    let name = name(options, &scene.borrow(), prefix);
    let damping = damping(call, options)?;
    add_spring(handle, Spring { name, kind, law, origin, damping, rest })
}

fn tendon(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let mut anchors = Vec::new();
    for (index, place) in call.array("places")?.into_iter().enumerate() {
        let wanted = (&Kind::Either(PLACE), "a station, or a point [x, y] of the ground");
        let accepted = call.accept("tendon", &format!("place {}", index + 1), wanted, place)?;
        anchors.push(match accepted.read_lock::<StationHandle>() {
            Some(station) => Anchor::Station(scene.own_station(&station)?),
            None => Anchor::Ground(accepted.clone().cast::<Vec2>()),
        });
    }
    if anchors.len() < 3 {
        let message =
            format!("a tendon needs three or more places, but {} are given", anchors.len());
        return Err(call
            .error(message)
            .hint("use scene.spring between two places")
            .at(CallPart::Argument(0)));
    }
    add_damper(call, SpringKind::Length(anchors), &call.options("options")?)
}

fn name(options: &Options, scene: &Scene, prefix: &str) -> String {
    let given = options.get_if::<ImmutableString>("name").map(String::from);
    given.unwrap_or_else(|| scene.free_name(prefix))
}

/// Sections between which an angle is measured, and the options. With one station, the first section is the ground.
fn sections(call: &Call) -> Result<([Anchor; 2], Options), ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let from = Anchor::Station(scene.own_station(&call.get::<StationHandle>("from")?)?);
    Ok(match call.get_if::<StationHandle>("to") {
        Some(to) => {
            let to = Anchor::Station(scene.own_station(&to)?);
            ([from, to], call.options_or_defaults("options")?)
        }
        None => ([Anchor::Ground(Vec2::zeros()), from], call.options("to")?),
    })
}

fn torsion(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (sections, options) = sections(call)?;
    add_damper(call, SpringKind::Torsion(sections), &options)
}

fn brake(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let (sections, options) = sections(call)?;
    if !options.has("moment") {
        let hint = "give the largest friction moment: scene.brake(from, to, #{ moment: 2 })";
        return Err(call.error("the moment of the brake is missing").hint(hint));
    }
    let clock = sample_clock_of(&options)?;
    let limit = controlled_schedule_of(call, &options, "moment", &scene, clock)?;
    expect_controller(call, clock, std::iter::once(&limit))?;
    let law = BrakeLaw { limit, deflection: options.number("deflection")? };
    let name = name(&options, &scene.shared_for_change().borrow(), "brake");
    let kind = SpringKind::Brake { sections, law };
    let (origin, damping) = (Origin::Zero, DampingLaw::default());
    let spring = Spring { name, kind, law: None, origin, damping, rest: None };
    add_spring(scene, spring)
}

fn add_spring(handle: SceneHandle, spring: Spring) -> Result<Dynamic, ScriptError> {
    let scene = handle.shared_for_change();
    scene.borrow_mut().add_spring(spring).map_err(spring_error)?;
    let index = scene.borrow().springs().count() - 1;
    Ok(Dynamic::from(SpringHandle { scene: handle, index }))
}

fn spring_error(error: SystemError) -> ScriptError {
    let place = match &error {
        SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
            CallPart::Key("name".into())
        }
        SystemError::ActiveDamper { .. } => CallPart::Key("damping".into()),
        SystemError::FewPoints { name, .. } => CallPart::Key((*name).into()),
        SystemError::Value { name, .. }
            if ["length", "damping", "stiffness", "table", "moment", "deflection"]
                .contains(name) =>
        {
            CallPart::Key((*name).into())
        }
        SystemError::RestValue { name, .. } => CallPart::Key((*name).into()),
        _ => CallPart::Argument(0),
    };
    ScriptError::from(error).at(place)
}

fn spring_value(
    call: &Call,
    ask: impl FnOnce(&SpringState) -> f64,
) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let spring = call.get::<SpringHandle>("spring")?;
    handle.scene().expect_same(&spring.scene, "spring")?;
    let simulation = handle.simulation();
    match simulation.model().springs().nth(spring.index) {
        Some(state) => Ok(ask(&state).into()),
        None => {
            let message = format!("'{}' was added after the scene was started", spring.name());
            Err(call
                .error(message)
                .hint("add everything before scene.start(…), or start the scene again"))
        }
    }
}
