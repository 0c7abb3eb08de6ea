//! Springs, dampers, tendons and torsion springs of a scene, and what a simulation says about them.

use rhai::{Dynamic, ImmutableString};

use super::scenes::{SCENE, STATION};
use super::simulations::SIMULATION;
use super::sliding::meant;
use crate::geometry::Vec2;
use crate::model::{Anchor, ModelError, Origin, RestoringLaw, Spring, SpringKind, SpringState};
use crate::output::significant;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::rows::call::Call;
use crate::script::rows::kind::{Details, Kind, Scripted, Type};
use crate::script::rows::options::Options;
use crate::script::rows::parameter::{
    Parameter, Presence, array, callback, choice, either, number, object, options, point, points,
    text,
};
use crate::script::rows::returns::Returns;
use crate::script::rows::table::{Table, method, property};
use crate::script::words::error::{Place, ScriptError};
use crate::script::words::numbers::as_number;

/// Springs and dampers.
pub const TABLE: Table = Table {
    name: "springs and dampers",
    doc: "What stores energy and gives it back, and what takes it. The energies of springs are a part of the energy of the scene, and \
          what dampers take is kept in the ledger: E - W + D stays constant to rounding with energy_momentum() and fourth_order(), at any \
          step and any stiffness. The history has stored and dissipated, and for each of them NAME.length or NAME.angle, NAME.force, \
          stored.NAME and dissipated.NAME.",
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
            resist(call, SpringKind::Way(anchors), &call.options("options")?)
        })
        .returns(Returns::object(SPRING))
        .summary("A spring between two stations, or a station and a point of the ground; a damper may act beside it.")
        .doc("It pulls with stiffness · (distance - length), and with damping · the rate of the distance. A spring as stiff as a rod takes no more \
              iterations than a soft one. Where the distance is zero it has no direction and no force. A law is asked when the spring is made, at so many elongations \
              of its range that the polygon through them is right to 1e-7 of the largest force: its energy is known exactly, and files keep it. Printed, the spring \
              tells how far it is off; a law that 20 000 points do not meet, as one that jumps, is refused.")
        .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100, length: 0.5, damping: 0.5 });\n\
                  scene.spring([2, -2], bead, #{ stiffness: 20, acts: \"pull\" });\n\
                  scene.spring([0, 1], bead, #{ law: |e| 20 * e + 5 * e * e * e, range: [-2, 2] });\n\
                  let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
                  check(sim.history.drift(\"energy\") < 1e-12);\ncheck(sim.history.last(\"dissipated\") > 0);")
        .see(&["damper", "tendon", "torsion_spring", "spring_force"]),
        method(SCENE, "damper", &[FROM, TO, options("options", DAMPER_KEYS)], |call| {
            let anchors = vec![anchor(call, "from")?, anchor(call, "to")?];
            let options = call.options("options")?;
            let law = (None, Origin::Zero);
            add(call, SpringKind::Way(anchors), law, &options)
        })
        .returns(Returns::object(SPRING))
        .summary("A damper between two stations, or a station and a point of the ground: a force against the rate of their distance.")
        .example("scene.damper(rod.end, [2, -1], #{ damping: 3 });")
        .see(&["spring"]),
        method(SCENE, "tendon", &[array("places").doc("stations and points of the ground"), options("options", SPRING_KEYS)], tendon)
            .returns(Returns::object(SPRING))
            .summary("A rope over three or more places, with one tension: it slides over those between its ends without friction.")
            .doc("It resists its whole length; with acts: \"pull\" it hangs slack where it is shorter than `length`.")
            .example("let rope = scene.tendon([[0, 1], rod.end, bead], #{ stiffness: 1e4, acts: \"pull\" });\nprint(rope);")
            .see(&["spring"]),
        method(SCENE, "torsion_spring", &[object("from", STATION), either("to", TURNED), options("options", TORSION_KEYS).optional()], torsion)
            .returns(Returns::object(SPRING))
            .summary("A spring, and a damper beside it, that turns two sections, or a section and the ground, towards each other.")
            .doc("Its moment is stiffness · (angle of the second section less that of the first one - angle), and damping · the rate of that. The angle is followed \
                  over any number of turns.")
            .example("let arm = scene.beam(#{ axis: line([2, 0], [3, 0]), basis: bspline(4), section: s });\n\
                      scene.hinge(rod.end, arm.start);\n\
                      scene.torsion_spring(rod.end, arm.start, #{ stiffness: 3, damping: 0.1 });\n\
                      scene.torsion_spring(arm.end, #{ stiffness: 0.1 });")
            .see(&["spring", "hinge"]),
        property(SPRING, "name", |call| Ok(call.receiver::<SpringHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Its name.")
            .example("check(scene.spring(rod.end, bead, #{ stiffness: 1 }).name == \"spring1\");"),
        method(SIMULATION, "spring_force", &[WHICH], |call| asked(call, |spring| spring.force))
            .returns(Returns::NUMBER.unit("force"))
            .summary("The force of a spring and its damper, positive where they pull, the mean of the last step; of a torsion spring the moment.")
            .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100, length: 0.9 });\nlet sim = scene.start(#{ dt: 0.01 });\n\
                      check_close(sim.spring_force(s1), 10, 1e-9);")
            .see(&["spring_length", "spring"]),
        method(SIMULATION, "spring_length", &[WHICH], |call| asked(call, |spring| spring.elongation))
            .returns(Returns::NUMBER.unit("length"))
            .summary("How long a spring or a tendon is; of a torsion spring the angle.")
            .example("let s1 = scene.spring(rod.end, bead, #{ stiffness: 100 });\nlet sim = scene.start(#{ dt: 0.01 });\n\
                      check_close(sim.spring_length(s1), 1, 1e-9);")
            .see(&["spring_force", "spring"]),
    ],
};

/// The spring type.
pub(super) const SPRING: Type = Type::of::<SpringHandle>();

const WHICH: Parameter = object("spring", SPRING);
const PLACE: &[Kind] = &[Kind::Object(STATION), Kind::Point];
const FROM: Parameter = either("from", PLACE);
const TO: Parameter = either("to", PLACE);
const TURNED: &[Kind] = &[Kind::Object(STATION), Kind::Options(TORSION_KEYS)];

const ACTS: [(&str, Acts); 3] = [("both", Acts::Both), ("pull", Acts::Pull), ("push", Acts::Push)];
const STIFFNESS: Parameter = number("stiffness").positive().unit("force/length").optional();
const DAMPING: Parameter = number("damping").unit("force·time/length").or(Presence::Number(0.0));
const SPRING_KEYS: &[Parameter] = &[
    STIFFNESS,
    number("length").unit("length").doc("where it is at ease; as drawn unless given").optional(),
    choice("acts", &[ACTS[0].0, ACTS[1].0, ACTS[2].0])
        .doc("a rope can only pull, a bumper only push")
        .or(Presence::Text("both")),
    points("table")
        .doc("points [length, force] in place of a stiffness: a polygon, which goes on beyond its ends as in its last parts")
        .optional(),
    callback("law").doc("the force over the elongation, |e| …, in place of a stiffness").optional(),
    point("range").unit("length").doc("the elongations for which the law is asked; beyond it goes on straight").beside("law").optional(),
    DAMPING,
    text("name").optional(),
];
const DAMPER_KEYS: &[Parameter] =
    &[number("damping").positive().unit("force·time/length"), text("name").optional()];
const TORSION_KEYS: &[Parameter] = &[
    number("stiffness").positive().unit("force·length/rad").optional(),
    number("angle")
        .unit("rad")
        .doc("where it is at ease, with the ground from the x axis like sim.angle; as drawn unless given")
        .optional(),
    points("table").doc("points [angle, moment] in place of a stiffness").optional(),
    callback("law")
        .doc("the moment over the angle beyond ease, |a| …, in place of a stiffness")
        .optional(),
    point("range")
        .unit("rad")
        .doc("the angles for which the law is asked")
        .beside("law")
        .optional(),
    number("damping").unit("force·length·time/rad").or(Presence::Number(0.0)),
    text("name").optional(),
];

/// Which way a spring acts.
#[derive(Debug, Clone, Copy, Default)]
enum Acts {
    #[default]
    Both,
    Pull,
    Push,
}

/// A spring of a scene.
#[derive(Clone)]
pub(super) struct SpringHandle {
    scene: SceneHandle,
    index: usize,
}

impl SpringHandle {
    /// Its index in a scene, if it is one of it.
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
            let law = spring.law.as_ref().map(RestoringLaw::describe);
            let damping = (spring.damping > 0.0).then(|| significant(spring.damping, 6));
            let lines = [("law", law), ("damping", damping)];
            lines
                .into_iter()
                .filter_map(|(label, value)| Some((label.to_owned(), value?)))
                .collect()
        };
        self.described(of).unwrap_or_default()
    }
}

/// The place of a call at which a spring is attached.
fn anchor(call: &Call, name: &str) -> Result<Anchor, ScriptError> {
    match call.get_if::<StationHandle>(name) {
        Some(station) => Ok(Anchor::Station(call.receiver::<SceneHandle>()?.own(&station)?)),
        None => Ok(Anchor::Ground(call.point(name)?)),
    }
}

/// Adds what resists with the law that options describe.
fn resist(call: &Call, kind: SpringKind, options: &Options) -> Result<Dynamic, ScriptError> {
    let law = law(call, options, &kind)?;
    add(call, kind, law, options)
}

fn add(
    call: &Call,
    kind: SpringKind,
    (law, origin): Law,
    options: &Options,
) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let scene = handle.shared();
    let prefix = if law.is_none() { "damper" } else { "spring" };
    let name = options.get_if::<ImmutableString>("name").map(String::from);
    let name = name.unwrap_or_else(|| scene.borrow().free_name(prefix));
    let spring = Spring { name, kind, law, origin, damping: options.number("damping")? };
    scene.borrow_mut().add_spring(spring).map_err(blame)?;
    let index = scene.borrow().springs().count() - 1;
    Ok(Dynamic::from(SpringHandle { scene: handle, index }))
}

/// A law, and what its elongations are counted from.
type Law = (Option<RestoringLaw>, Origin);

/// The law that options describe; none where there is a damper alone.
fn law(call: &Call, options: &Options, kind: &SpringKind) -> Result<Law, ScriptError> {
    let (ease, acts) = match kind {
        SpringKind::Torsion(_) => ("angle", Acts::Both),
        SpringKind::Way(_) => ("length", meant(&ACTS, &options.text("acts")?)),
    };
    if options.has("law") {
        return sampled(call, options, ease);
    }
    if options.has("table") {
        let odd = match acts {
            Acts::Both => ["stiffness", ease].into_iter().find(|key| options.has(key)),
            Acts::Pull | Acts::Push => Some("acts"),
        };
        if let Some(odd) = odd {
            let told = format!("a table says all about the force, and {odd} is given besides");
            let hint = format!("leave out {odd}, or the table");
            return Err(call.error(told).hint(hint).at(Place::Key(odd.into())));
        }
        let points = options.points("table")?.iter().map(|at: &Vec2| (at.x, at.y)).collect();
        return Ok((Some(RestoringLaw::Table { points }), Origin::Zero));
    }
    let Some(stiffness) = options.number_if_given("stiffness") else {
        if options.number("damping")? > 0.0 && !options.has(ease) {
            return Ok((None, Origin::Zero));
        }
        let hint = format!("give stiffness: a number, or table: [[{ease}, …], …]");
        return Err(call.error("how strongly it resists is missing").hint(hint));
    };
    let (natural, origin) = match options.number_if_given(ease) {
        Some(natural) => (natural, Origin::Zero),
        None => (0.0, Origin::AsBuilt),
    };
    let side = |before: f64, after: f64| RestoringLaw::Table {
        points: vec![(natural - 1.0, before), (natural, 0.0), (natural + 1.0, after)],
    };
    let law = match acts {
        Acts::Both => RestoringLaw::Linear { stiffness, natural },
        Acts::Pull => side(0.0, stiffness),
        Acts::Push => side(-stiffness, 0.0),
    };
    Ok((Some(law), origin))
}

/// The law of a function, which is asked over a range of elongations now and never again.
fn sampled(call: &Call, options: &Options, ease: &str) -> Result<Law, ScriptError> {
    let function = options.callback("law")?;
    call.expect_arguments(&function, 1, "law: |e| 100 * e, e being the elongation")?;
    let odd = options.given().find(|key| ["stiffness", "table"].contains(key));
    if let Some(odd) = odd {
        let told = format!("a law says all about the force, and {odd} is given besides");
        let hint = format!("leave out {odd}, or the law");
        return Err(call.error(told).hint(hint).at(Place::Key(odd.into())));
    }
    if !options.has("range") {
        let told = "for which elongations the law is asked is missing";
        let hint = "give range: [-0.1, 0.1], from the shortest to the longest";
        return Err(call.error(told).hint(hint).at(Place::Key("law".into())));
    }
    let range = options.point("range")?;
    if range.x >= range.y {
        let told = format!("the range [{}, {}] does not rise", range.x, range.y);
        let hint = "give the smaller elongation first";
        return Err(call.error(told).hint(hint).at(Place::Key("range".into())));
    }
    let force = |elongation: f64| {
        let value = call.invoke(&function, [Dynamic::from(elongation)])?;
        as_number(&value).filter(|force| force.is_finite()).ok_or_else(|| {
            let told = format!("the law gives no finite number at the elongation {elongation}");
            call.error(told).at(Place::Key("law".into()))
        })
    };
    let law = RestoringLaw::sampled((range.x, range.y), force)?;
    if let Some((error, largest)) = law.missed() {
        let [error, largest] = [error, largest].map(|force| significant(force, 3));
        let told = format!(
            "the law jumps or swings too fast: the finest polygon is off by {error}, its largest force being {largest}"
        );
        return Err(call.error(told).hint("make a jump a short ramp").at(Place::Key("law".into())));
    }
    Ok(match options.number_if_given(ease) {
        Some(natural) => (Some(law.shifted(natural)), Origin::Zero),
        None => (Some(law), Origin::AsBuilt),
    })
}

fn tendon(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let mut anchors = Vec::new();
    for (index, place) in call.array("places")?.into_iter().enumerate() {
        let wanted = (&Kind::Either(PLACE), "a station, or a point [x, y] of the ground");
        let accepted = call.accept("tendon", &format!("place {}", index + 1), wanted, place)?;
        anchors.push(match accepted.read_lock::<StationHandle>() {
            Some(station) => Anchor::Station(scene.own(&station)?),
            None => Anchor::Ground(accepted.clone().cast::<Vec2>()),
        });
    }
    if anchors.len() < 3 {
        let told =
            format!("a tendon goes over three or more places, and {} are given", anchors.len());
        return Err(call
            .error(told)
            .hint("between two places, use scene.spring")
            .at(Place::Argument(0)));
    }
    resist(call, SpringKind::Way(anchors), &call.options("options")?)
}

fn torsion(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let from = Anchor::Station(scene.own(&call.get::<StationHandle>("from")?)?);
    match call.get_if::<StationHandle>("to") {
        Some(to) => {
            let to = Anchor::Station(scene.own(&to)?);
            let options = call.options_or_defaults("options")?;
            resist(call, SpringKind::Torsion([from, to]), &options)
        }
        None => {
            let ground = Anchor::Ground(Vec2::zeros());
            resist(call, SpringKind::Torsion([ground, from]), &call.options("to")?)
        }
    }
}

/// Points at what is wrong in the call.
fn blame(error: ModelError) -> ScriptError {
    let place = match &error {
        ModelError::Unnamed { .. } | ModelError::DuplicateName { .. } => Place::Key("name".into()),
        ModelError::Value { name, .. }
            if ["length", "damping", "stiffness", "table"].contains(name) =>
        {
            Place::Key((*name).into())
        }
        _ => Place::Argument(0),
    };
    ScriptError::from(error).at(place)
}

/// Asks a simulation about the spring of a call.
fn asked(call: &Call, ask: impl FnOnce(&SpringState) -> f64) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let spring = call.get::<SpringHandle>("spring")?;
    handle.scene().expect_same(&spring.scene, "spring")?;
    let simulation = handle.simulation();
    match simulation.model().springs().nth(spring.index) {
        Some(state) => Ok(ask(&state).into()),
        None => {
            let told = format!("'{}' was added after the scene was started", spring.name());
            Err(call.error(told).hint("add everything before scene.start(…), or start again"))
        }
    }
}
