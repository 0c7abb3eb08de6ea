//! Sliding joints: rules, sliders of a scene, and their results.

use rhai::{Array, Dynamic, Map};

use super::scenes::{BEAM, SCENE, STATION};
use super::simulations::SIMULATION;
use super::tracks::{SliderGuide, TRACK};
use super::vectors::VECTOR;
use crate::joints::{EndAction, Restraint, Side, Slider, SlidingRule, StartVelocities};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Kind, Scripted, Type};
use crate::script::bindings::parameter::{
    Parameter, Presence, choice, either, number, object, options, text,
};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, FunctionBinding, function, method, property};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::here;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::details;
use crate::simulation::Arrival;
use crate::system::{Scene, SliderError, System, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "sliding joints",
    doc: "A slider keeps a station (of a beam or a particle) on the axis of another beam, along \
        which it moves, with or without friction. A rule selects the discretisation. The history \
        has the columns NAME.position (from 0 to 1 along the beam), NAME.speed (length/time), \
        NAME.force, NAME.force_x, NAME.force_y, with friction NAME.friction, with a side \
        NAME.gap, and for a sleeve NAME.couple.",
    types: &[RULE, SLIDER],
    setup: "let scene = new_scene(\"example\");\n\
            let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 1 });\n\
            let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
            scene.clamp(rod.start);\n\
            scene.gravity([0, -10]);\n\
            let bead = scene.particle([0.5, 0], 1, #{ name: \"bead\", velocity: [1, 0] });\n\
            let ring = scene.slider(bead, rod, #{ name: \"ring\" });\n\
            let sim = scene.start(#{ dt: 0.05 });",
    constants: &[],
    rows: &[
        rule("conserving", |_| Ok(Dynamic::from(SlidingRule::Conserving)))
            .summary("Selects the conserving sliding rule (default), which keeps energy, momenta and \
                gap at any step size.")
            .doc("With energy_momentum(): keeps energy, linear momentum, angular momentum and \
                the gap to rounding. withy, docs/theory.md, section 10.")
            .with_related(&["kinked", "exact", "relaxed", "slider"]),
        rule("kinked", |_| Ok(Dynamic::from(SlidingRule::Kinked)))
            .summary("Selects the conserving rule with the kink of the beam at the contact force: \
                second to third order in the mesh up to about 64 spans, where conserving() is first order.")
            .doc("Requires meshes of smooth splines. With energy_momentum(): keeps energy, \
                linear momentum, angular momentum and the gap to rounding. Only first order \
                near the ends of the beam, and where the slider reaches 0.8 of the shear wave \
                speed of the beam, sqrt(GA/rho_A). Use conserving() for sliders with repeated \
                impacts on soft beams: with kinked() a step may have no solution. withy, \
                docs/theory.md, section 10.1.")
            .with_related(&["conserving", "exact", "relaxed"]),
        rule("exact", |_| Ok(Dynamic::from(SlidingRule::Exact)))
            .summary("Selects a rule for comparison: the slave is exactly on the beam at the end of \
                a step; the error of the angular momentum is of second order.")
            .doc("With energy_momentum(): keeps energy, linear momentum and the gap to rounding. \
                Sibileau & Muñoz, equations 15 and 17.")
            .with_related(&["conserving", "relaxed"]),
        rule("relaxed", |_| Ok(Dynamic::from(SlidingRule::Relaxed)))
            .summary("Selects a rule for comparison: the slave is on the beam in the mean of a step; \
                the gap drifts, and a step may have no solution.")
            .doc("With energy_momentum(): keeps energy, linear momentum and angular momentum to \
                rounding. Sibileau & Muñoz, equations 11 to 14.")
            .with_related(&["conserving", "exact"]),
        method(SCENE, "slider", &[object("station", STATION), ON, options("options", SLIDER_KEYS).optional()], slider)
            .returns(Returns::object(SLIDER))
            .summary("Adds a slider: a station of another beam or a particle moves along a beam or a \
                track.")
            .doc(
                "The station must lie on the undeformed beam, at `at`, to six digits; it is \
                 then moved onto it exactly. On a curved beam, whose mesh differs slightly from \
                 the curve, it is moved onto the axis of the mesh, and velocities: \"project\" \
                 makes the initial velocities compatible. A station fixed to the ground is an \
                 eyelet through which the beam slides. Simultaneous impacts are one impact. \
                 With ends: \"bounce\" the restitution law holds at any step: beams do not \
                 stretch during the impact, and springs and dampers take no part; the lost \
                 energy is in the column dissipated.NAME. With ends: \"contact\" the waves in the \
                 beam determine the rebound. The contact time is that of a wave through the \
                 beam and back, 2 L √(rho_A/EA), or less for a slider lighter than the beam. In \
                 steps shorter than an eighth of it, the slider stays in contact with the end \
                 stop until the contact force would be tensile. In much longer steps the beam \
                 is treated as rigid in the impact, and sim.notes reports this. A slider that \
                 bounces repeatedly within few steps stays in contact with the end stop until \
                 it is pulled away. With `friction`, the slider sticks to the beam or slips \
                 with a force along the beam of `friction` times the force across it (Coulomb). \
                 A slider that sticks starts to slip at `static_friction` times that force. Steps end \
                 where slip starts or ends. A slider that sticks does not creep. The work of \
                 friction is in the column dissipated.NAME, and the friction force on the beam, \
                 positive towards its end, in NAME.friction. Friction needs rule: conserving() \
                 and the integrator energy_momentum(); equilibria, modes and impacts are without \
                 friction. With `side`, the slider only pushes: it leaves the beam on that side \
                 where the present contact force becomes tensile, flies, and lands where its \
                 distance from the axis vanishes. A landing has the `restitution`; the lost \
                 energy is in the column dissipated.NAME, and the distance in NAME.gap. The \
                 station may start at a distance from the beam on that side. Beyond the ends of \
                 the beam there is no landing. A side needs a single beam, rule: conserving() \
                 and the integrator energy_momentum(), and is not available with friction or \
                 with ends: \"bounce\" and \"contact\". Default names: slider1, slider2, …",
            )
            .example(
                "let hook = scene.beam(#{ name: \"hook\", axis: line([1, 0], [1, 1]), basis: bspline(4), section: s });\n\
                 let runner = scene.slider(hook.start, rod, #{ at: 0.5, rule: conserving(), ends: \"bounce\" });\n\
                 print(runner);\n\
                 let block = scene.particle([1.5, 0], 1, #{ velocity: [0.2, 0] });\n\
                 scene.slider(block, rod, #{ name: \"brake\", friction: 0.3 });\n\
                 let sim = scene.start(#{ dt: 0.01 });\n\
                 sim.run_to(0.2);\n\
                 check(sim.history.last(\"dissipated.brake\") > 0);\n\
                 let ball = scene.particle([1, 0.1], 0.1);\n\
                 scene.slider(ball, rod, #{ name: \"hop\", side: \"above\", restitution: 0.5 });\n\
                 let sim = scene.start(#{ dt: 0.01 });\n\
                 sim.run_to(0.2);\n\
                 check(sim.history.last(\"dissipated.hop\") > 0);",
            )
            .with_related(&["particle", "track", "conserving", "contact_force"]),
        property(SLIDER, "name", |call| Ok(call.receiver::<SliderHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the slider.")
            .example("check(ring.name == \"ring\");"),
        method(SIMULATION, "contact_force", &[WHICH], |call| {
            slider_value(call, |model, slider| Dynamic::from(model.contact_force(slider)))
        })
        .returns(Returns::object(VECTOR).unit("force"))
        .summary("Returns the contact force of a slider on its beam, as the mean of the last step; \
            the force on its station is the opposite.")
        .doc(
            "The mean times the step size is the impulse on the beam in the step. The value belongs \
            to the middle of the step, to second order. Before the first step it is the present \
            force; after a release it is zero. present_contact_force has the order of the motion \
            with every rule; scene.record(\"ring.present_force\") records it. `withy docs \
            sensors` has the rules for all forces. On splines with the conserving \
            rule the force is smooth where the motion is. Where it alternates between steps \
            (kinks of Lagrange elements, the relaxed rule), averaged(\"ring.force\") of the \
            history removes this; see scripts/contact_force.rhai. Impulses of impacts at an \
            end, or at a corner of a track, are not included.",
        )
        .example("check_close(norm(sim.contact_force(ring) - sim.present_contact_force(ring)), 0, 1e-9);\nsim.step();\ncheck(sim.contact_force(ring).y < 0);")
        .with_related(&["present_contact_force", "joint_force", "slider_position", "averaged"]),
        method(SIMULATION, "slider_position", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_position(slider).into())
        })
        .returns(Returns::NUMBER)
        .summary("Returns the position of a slider on its beam or track, by undeformed length: 0 at \
            the start, 1 at the end.")
        .doc(
            "The product with the undeformed length of the beam is slider_arc_length; its rate \
            is slider_speed. In the history NAME.speed is the rate of NAME.position times that \
            length. On a closed track the turns are counted: 2.5 is half-way round for the \
            third time, -0.5 half-way back.",
        )
        .example("check_close(sim.slider_position(ring), 0.25, 1e-12);")
        .with_related(&["slider_arc_length", "slider_speed"]),
        method(SIMULATION, "slider_arc_length", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_arc_length(slider).into())
        })
        .returns(Returns::NUMBER.unit("length"))
        .summary("Returns the undeformed arc length from the start of the beam or track to the \
            slider, including all turns of a closed track; its rate is slider_speed.")
        .doc("As a column: scene.record(\"NAME.arc_length\").")
        .example(
            "check_close(sim.slider_arc_length(ring), 0.5, 1e-12);\n\
             check_close(sim.slider_arc_length(ring) / rod.length, sim.slider_position(ring), 1e-12);",
        )
        .with_related(&["slider_speed", "slider_position"]),
        method(SIMULATION, "slider_speed", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_speed(slider).into())
        })
        .returns(Returns::NUMBER.unit("length/time"))
        .summary("Returns the speed of a slider along its undeformed beam or track, positive towards \
            the end.")
        .example("check_close(sim.slider_speed(ring), 1, 1e-12);")
        .with_related(&["slider_arc_length", "slider_position"]),
        property(SIMULATION, "ended", |call| Ok(call.receiver::<SimulationHandle>()?.simulation().has_ended().into()))
            .returns(Returns::BOOLEAN)
            .summary("True if a slider has reached the end of its beam and ended the run.")
            .doc("After that run_to returns at once, step is refused with an error, and \
                functions registered for later times are not called.")
            .example("while !sim.ended {\n    sim.step();\n}\ncheck(sim.ended);\ncheck_close(sim.slider_position(ring), 1, 1e-12);")
            .with_related(&["ending", "slider"]),
        property(SIMULATION, "ending", |call| {
            Ok(call.receiver::<SimulationHandle>()?.simulation().ending().unwrap_or_default().into())
        })
        .returns(Returns::TEXT.with_remark(", empty while the run goes on"))
        .summary("Reason for which the run has ended.")
        .example("check(sim.ending == \"\");\nsim.run_to(5);\nprint(sim.ending);")
        .with_related(&["ended", "events"]),
        property(SIMULATION, "events", events)
            .returns(Returns::array_of(&ValueKind::Map).with_remark(" #{ t, slider, end, what, impulse }"))
            .summary("Events of sliders so far, at the ends of their beams and the seams of their \
                tracks, and their take-offs and landings.")
            .doc(
                "slider is the name of the slider; end is \"start\" or \"end\"; what is \
                \"stopped\", \"bounced\", \"rested\" (in contact with the end stop until the \
                contact force would be tensile or the slider is pulled away), \"released\" or, \
                on a track, \"passed\" (to the next beam). Sliders with a side have events \
                without end: \"took off\", \"landed\", \"bounced\" for a landing with \
                rebound, and \"passed\" beyond an end of the beam. impulse is the vector of the total \
                impulse of the slider on its beams in the impact with all simultaneous \
                arrivals (mass·length/time), without contact forces. On a track the map also \
                has beam, the name of the beam at whose end the event was.",
            )
            .example("sim.run_to(5);\nfor event in sim.events {\n    print(`${event.slider} ${event.what} at ${event.end}, t = ${event.t}`);\n}")
            .with_related(&["ended", "slider"]),
    ],
};

const RULE: Type = Type::of::<SlidingRule>();
pub(super) const SLIDER: Type = Type::of::<SliderHandle>();

const ON: Parameter = either("beam", &[Kind::Object(BEAM), Kind::Object(TRACK)]);
pub(super) const WHICH: Parameter = object("slider", SLIDER);
pub(super) const ENDS: [(&str, EndAction); 4] = [
    ("stop", EndAction::Stop),
    ("bounce", EndAction::Bounce),
    ("contact", EndAction::Contact),
    ("release", EndAction::Release),
];
const VELOCITIES: [(&str, StartVelocities); 2] =
    [("check", StartVelocities::Check), ("project", StartVelocities::Project)];

/// Largest horizontal component of the unit tangent at which a beam counts as vertical [-].
const STEEP: f64 = 1e-3;

const SLIDER_KEYS: &[Parameter] = &[
    number("at")
        .between(0.0, 1.0)
        .unit("fraction of the length")
        .doc(
            "initial position as a fraction of the undeformed length of the beam or the track; \
            default: the nearest place",
        )
        .optional(),
    object("rule", RULE).doc("sliding rule; default: conserving()").optional(),
    choice("ends", &[ENDS[0].0, ENDS[1].0, ENDS[2].0, ENDS[3].0])
        .doc(
            "event at the end of the beam or track: the run stops, the slider bounces by its \
            restitution, it stays in elastic contact, or it is released",
        )
        .or(Presence::Text("stop")),
    number("restitution")
        .between(0.0, 1.0)
        .doc(
            "ratio of the speeds after and before a bounce, for ends: \"bounce\" (default: 1, \
            no loss), or of a landing with `side` (default: 0, no rebound)",
        )
        .optional(),
    choice("side", &["left", "right", "above", "below"])
        .doc(
            "side of the beam on which the slider may leave it: left or right of the direction \
            of the beam, or above or below; default: the slider never leaves the beam",
        )
        .optional(),
    number("friction")
        .non_negative()
        .doc("coefficient of friction along the beam; default: 0")
        .optional(),
    number("static_friction")
        .non_negative()
        .doc("coefficient of friction while the slider sticks, at least `friction`; default: `friction`")
        .optional(),
    choice("velocities", &[VELOCITIES[0].0, VELOCITIES[1].0])
        .doc(
            "treatment of incompatible initial velocities across the beam: refused with an \
            error, or projected to the nearest compatible ones",
        )
        .or(Presence::Text("check")),
    text("name").optional(),
];

#[derive(Clone)]
pub(super) struct SliderHandle {
    pub(super) scene: SceneHandle,
    pub(super) index: usize,
}

impl SliderHandle {
    fn name(&self) -> String {
        self.scene.scene().borrow().sliders[self.index].name.clone()
    }

    pub(super) fn within(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "slider").map(|()| self.index)
    }

    pub(super) fn on(&self, handle: &SimulationHandle) -> Result<usize, ScriptError> {
        self.among(handle.scene(), handle.simulation().scene())
    }

    pub(super) fn among(&self, scene: &SceneHandle, copy: &Scene) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "slider")?;
        if self.index < copy.sliders.len() {
            return Ok(self.index);
        }
        let message = format!("the slider '{}' was added after the scene was started", self.name());
        Err(ScriptError::new(message)
            .hint("add all sliders before scene.start(…), or start the scene again"))
    }
}

impl Scripted for SliderHandle {
    const NAME: &'static str = "slider";
    const DOC: &'static str = "A sliding joint of a scene.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let slider = &scene.sliders[self.index];
        let (guide, part) = details::guide_of(&scene, slider);
        let (name, slave) = (&slider.name, scene.describe(&slider.slave));
        let part = significant(part, 7);
        if slider.is_sleeve() {
            return format!("sleeve '{name}': {guide} at {part} of its length in {slave}");
        }
        let rule = slider.rule.entry().name;
        format!("slider '{name}': {slave} on {guide} at {part} of its length, {rule} rule")
    }

    fn details(&self) -> Details {
        details::of_slider(&self.scene.scene().borrow(), self.index)
    }

    fn parameter_set(
        &self,
    ) -> Option<std::rc::Rc<crate::script::bindings::parameter_variants::ParameterSet>> {
        self.scene.parameter_set()
    }
}

impl Scripted for SlidingRule {
    const NAME: &'static str = "sliding rule";
    const DOC: &'static str = "Discretisation of the sliding constraint in a step.";

    fn show(&self) -> String {
        let entry = self.entry();
        format!("{}: {}", entry.name, entry.summary)
    }

    fn details(&self) -> Details {
        details::of_rule(self)
    }
}

const fn rule(
    name: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    function(name, &[], body)
        .returns(Returns::object(RULE))
        .example("for rule in [conserving(), exact(), relaxed()] {\n    print(rule);\n}")
}

fn slider(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (slave, scene) = here(call, "station")?;
    let handle = call.receiver::<SceneHandle>()?;
    let guide = SliderGuide::of(call, "beam", &handle)?;
    let options = call.options_or_defaults("options")?;
    let at = options.optional_number("at");
    let name = options.optional_text("name")?;
    let ends = meant(&ENDS, &options.text("ends")?);
    let restitution = options.optional_number("restitution");
    let (master, arc_length) = guide.start(&scene.borrow(), slave, at)?;
    let side = match options.optional_text("side")? {
        Some(word) => Some(side_of(&scene.borrow(), master, arc_length, &word)?),
        None => None,
    };
    if restitution.is_some() && ends != EndAction::Bounce && side.is_none() {
        let message = "slider: 'restitution' is allowed only with ends: \"bounce\" or with 'side'";
        return Err(ScriptError::new(message).at(CallPart::Key("restitution".into())));
    }
    let restitution = restitution.unwrap_or(if side.is_some() { 0.0 } else { 1.0 });
    let definition = Slider {
        name: name.unwrap_or_else(|| scene.borrow().free_name("slider")),
        slave,
        master,
        track: guide.track(),
        arc_length,
        rule: options.get_if("rule").unwrap_or_default(),
        ends,
        restitution,
        friction: options.optional_number("friction").unwrap_or(0.0),
        static_friction: options.optional_number("static_friction"),
        restraint: side.map_or(Restraint::Place, Restraint::OneSided),
        velocities: meant(&VELOCITIES, &options.text("velocities")?),
    };
    let added = scene.borrow_mut().add_slider(definition);
    let index = added.map_err(|error| slider_error(error, at.is_some()))?;
    Ok(Dynamic::from(SliderHandle { scene: handle, index }))
}

/// Side of a beam by its name, at an arc length of the undeformed beam [length].
fn side_of(scene: &Scene, beam: usize, arc_length: f64, word: &str) -> Result<Side, ScriptError> {
    let (above, below) = match word {
        "left" => return Ok(Side::Left),
        "right" => return Ok(Side::Right),
        _ => {
            let along = scene.drawn_tangent(beam, arc_length)?.x;
            if along.abs() < STEEP {
                let name = &scene.beams[beam].name;
                let message = format!(
                    "slider: 'side' is \"{word}\", but beam '{name}' is vertical at the slider, so that \
                    neither of its sides is {word} it"
                );
                return Err(ScriptError::new(message)
                    .at(CallPart::Key("side".into()))
                    .hint("use \"left\" or \"right\" of the direction of the beam"));
            }
            if along > 0.0 { (Side::Left, Side::Right) } else { (Side::Right, Side::Left) }
        }
    };
    Ok(if word == "above" { above } else { below })
}

pub(super) fn meant<T: Copy + Default>(words: &[(&str, T)], word: &str) -> T {
    let found = words.iter().find(|(other, _)| *other == word);
    found.map(|(_, meaning)| *meaning).unwrap_or_default()
}

pub(super) fn slider_error(error: SystemError, is_placed: bool) -> ScriptError {
    let place = match &error {
        SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
            CallPart::Key("name".into())
        }
        SystemError::Slider(error) => match **error {
            SliderError::Open { .. } if is_placed => CallPart::Key("at".into()),
            SliderError::SlaveOnMaster(_) => CallPart::Argument(1),
            SliderError::FrictionRule { .. } => CallPart::Key("rule".into()),
            SliderError::StaticFriction { .. } => CallPart::Key("static_friction".into()),
            SliderError::SideWith { .. } | SliderError::OtherSide { .. } => {
                CallPart::Key("side".into())
            }
            _ => CallPart::Argument(0),
        },
        _ => CallPart::Argument(0),
    };
    ScriptError::from(error).at(place)
}

pub(super) fn slider_value(
    call: &Call,
    ask: impl FnOnce(&System, usize) -> Dynamic,
) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let slider = call.get::<SliderHandle>("slider")?.on(&handle)?;
    let simulation = handle.simulation();
    Ok(ask(simulation.model(), slider))
}

fn events(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let simulation = handle.simulation();
    let event = |arrival: &Arrival| {
        let slider = &simulation.scene().sliders[arrival.slider].name;
        let end = arrival.end.map(|end| ("end", end.name()));
        let words = [("slider", slider.as_str()), ("what", arrival.kind.name())];
        let words = words.into_iter().chain(end);
        let mut map: Map = words.map(|(key, word)| (key.into(), word.into())).collect();
        map.insert("t".into(), arrival.time.into());
        map.insert("impulse".into(), Dynamic::from(arrival.impulse));
        if let Some(beam) = arrival.beam {
            map.insert("beam".into(), simulation.scene().beams[beam].name.clone().into());
        }
        Dynamic::from(map)
    };
    Ok(Dynamic::from(simulation.arrivals().iter().map(event).collect::<Array>()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joints::SLIDING_RULES;

    #[test]
    fn every_rule_of_the_registry_has_a_row_with_its_claims_and_its_source() {
        for entry in SLIDING_RULES {
            let row = TABLE.rows.iter().find(|row| row.name == entry.name).unwrap();
            let claims = [
                (entry.claims.energy, "energy"),
                (true, "linear momentum"),
                (entry.claims.angular_momentum, "angular momentum"),
                (entry.claims.gap, "the gap"),
            ];
            let kept: Vec<&str> =
                claims.into_iter().filter(|(keeps, _)| *keeps).map(|(_, what)| what).collect();
            let kept = match kept.as_slice() {
                [first @ .., last] => {
                    let first = first.join(", ");
                    format!("With energy_momentum(): keeps {first} and {last} to rounding.")
                }
                [] => String::new(),
            };
            assert!(row.doc.contains(&kept), "{}: {}", entry.name, row.doc);
            assert!(
                row.doc.ends_with(&format!(" {}.", entry.source)),
                "{}: {}",
                entry.name,
                row.doc
            );
        }
    }
}
