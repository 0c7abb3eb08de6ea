//! Sliding joints: rules, sliders of a scene, and their results.

use rhai::{Array, Dynamic, Map};

use super::scenes::{BEAM, SCENE, STATION};
use super::simulations::SIMULATION;
use super::tracks::{SliderGuide, TRACK};
use super::vectors::VECTOR;
use crate::joints::{EndAction, Slider, SlidingRule, StartVelocities};
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
    doc: "A slider keeps a station, the end of a beam or a particle, on the axis of another beam, along which it slides without \
          friction. Its rule says how a step does that; its history has NAME.position (from 0 to 1 along the beam), NAME.speed (length/time), NAME.force, \
          NAME.force_x and NAME.force_y.",
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
            .summary("The rule that keeps everything at any step size; the default.")
            .doc("With energy_momentum(): keeps energy, linear momentum, angular momentum and the gap to rounding. withy, docs/theory.md, section 10.")
            .see(&["kinked", "exact", "relaxed", "slider"]),
        rule("kinked", |_| Ok(Dynamic::from(SlidingRule::Kinked)))
            .summary("The conserving rule on the beam as the contact force kinks it: of second order in the mesh, where conserving() is of first.")
            .doc("On meshes of smooth splines. With energy_momentum(): keeps energy, linear momentum, angular momentum and the gap to rounding. \
                  Beside ends, and where a slider comes to 0.8 of the speed of the beam's shear waves, sqrt(GA/rho_A), it is of first order only. \
                  For sliders that are struck again and again on soft beams take conserving(): a step may have no solution. withy, docs/theory.md, section 10.1.")
            .see(&["conserving", "exact", "relaxed"]),
        rule("exact", |_| Ok(Dynamic::from(SlidingRule::Exact)))
            .summary("For comparison: the slave is exactly on the beam at the end of a step; angular momentum is lost at second order.")
            .doc("With energy_momentum(): keeps energy, linear momentum and the gap to rounding. Sibileau & Muñoz, equations 15 and 17.")
            .see(&["conserving", "relaxed"]),
        rule("relaxed", |_| Ok(Dynamic::from(SlidingRule::Relaxed)))
            .summary("For comparison: the slave is on the beam in the mean of a step; the gap drifts, and a step may have no solution.")
            .doc("With energy_momentum(): keeps energy, linear momentum and angular momentum to rounding. Sibileau & Muñoz, equations 11 to 14.")
            .see(&["conserving", "exact"]),
        method(SCENE, "slider", &[object("station", STATION), ON, options("options", SLIDER_KEYS).optional()], slider)
            .returns(Returns::object(SLIDER))
            .summary("Lets a station, a place on another beam or a particle, slide along a beam or a track.")
            .doc(
                "The joint must close at the start: the station lies on the beam as drawn, at `at`, to six digits, and is moved \
                 onto it exactly. Where the beam ends, the run \
                 stops, or the slider bounces off, or is released. A station held by the ground is an eyelet through which the \
                 beam slides. On a curved beam, whose mesh is slightly off the curve, the station is moved onto the line of the mesh, and \
                 velocities: \"project\" makes start velocities fit that line. All that bounces at one \
                 time does so in one impact. With ends: \"bounce\" restitution says how much of its speed the slider keeps, at any step: beams do not stretch in that \
                 instant, and springs and dampers give nothing; what is lost is in the column dissipated.NAME. With ends: \"contact\" the waves in the beam decide: where steps are shorter \
                 than an eighth of a blow, in which a wave runs through the beam and back, \
                 2 L √(rho_A/EA), or less for a slider that is lighter than the beam, the slider leans on the end until that would have to pull; in steps much \
                 longer than the blow the beam is struck as if it were rigid, and sim.notes tells. \
                 One that bounces again and again within few steps comes to lean on the end, until it is drawn away. Sliders are called slider1, slider2, … \
                 unless they get a name.",
            )
            .example(
                "let hook = scene.beam(#{ name: \"hook\", axis: line([1, 0], [1, 1]), basis: bspline(4), section: s });\n\
                 let runner = scene.slider(hook.start, rod, #{ at: 0.5, rule: conserving(), ends: \"bounce\" });\n\
                 print(runner);",
            )
            .see(&["particle", "track", "conserving", "contact_force"]),
        property(SLIDER, "name", |call| Ok(call.receiver::<SliderHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Its name.")
            .example("check(ring.name == \"ring\");"),
        method(SIMULATION, "contact_force", &[WHICH], |call| {
            asked(call, |model, slider| Dynamic::from(model.contact_force(slider)))
        })
        .returns(Returns::object(VECTOR).unit("force"))
        .summary("The force that a slider put on its beam in the last step, the mean of the step; its station got the opposite.")
        .doc(
            "Zero before the first step and after a release. It belongs to the middle of the step; with kinked() it is that at its end, to the order of the method, and with fourth_order() that of the \
             last of its seven parts, so of first order: present_contact_force has the order of the motion with every rule, and scene.record(\"ring.present_force\") makes a column of it. On splines and with the conserving rule it is smooth where the motion \
             is; where it alternates from step to step (kinks of Lagrange elements, the relaxed rule), averaged(\"ring.force\") of \
             the history is free of that. scripts/contact_force.rhai shows how much. The impulse of a blow at an end, or at a corner of a track, is in none of them.",
        )
        .example("check(norm(sim.contact_force(ring)) == 0);\nsim.step();\ncheck(sim.contact_force(ring).y < 0);")
        .see(&["present_contact_force", "slider_position", "averaged"]),
        method(SIMULATION, "slider_position", &[WHICH], |call| {
            asked(call, |model, slider| model.slider_position(slider).into())
        })
        .returns(Returns::NUMBER)
        .summary("Where a slider is on its beam or track: 0 at the start, 1 at the end, by length as drawn.")
        .doc(
            "Times the length of the beam as drawn it is slider_arc_length, whose rate is slider_speed: in the history NAME.speed is \
             the rate of NAME.position times that length. Round a closed track it counts on: 2.5 is half-way round for the third time, -0.5 half-way back.",
        )
        .example("check_close(sim.slider_position(ring), 0.25, 1e-12);")
        .see(&["slider_arc_length", "slider_speed"]),
        method(SIMULATION, "slider_arc_length", &[WHICH], |call| {
            asked(call, |model, slider| model.slider_arc_length(slider).into())
        })
        .returns(Returns::NUMBER.unit("length"))
        .summary("How far a slider is from the start of its beam or track, by length as drawn and with all turns of a closed track; slider_speed is its rate.")
        .example(
            "check_close(sim.slider_arc_length(ring), 0.5, 1e-12);\n\
             check_close(sim.slider_arc_length(ring) / rod.length, sim.slider_position(ring), 1e-12);",
        )
        .see(&["slider_speed", "slider_position"]),
        method(SIMULATION, "slider_speed", &[WHICH], |call| {
            asked(call, |model, slider| model.slider_speed(slider).into())
        })
        .returns(Returns::NUMBER.unit("length/time"))
        .summary("How fast a slider moves along its beam or track as drawn, positive towards the end.")
        .example("check_close(sim.slider_speed(ring), 1, 1e-12);")
        .see(&["slider_arc_length", "slider_position"]),
        property(SIMULATION, "ended", |call| Ok(call.receiver::<SimulationHandle>()?.simulation().has_ended().into()))
            .returns(Returns::TRUTH)
            .summary("Whether a slider has reached the end of its beam and ended the run.")
            .doc("After that run_to returns at once, step is an error, and functions set for later times are not called.")
            .example("while !sim.ended {\n    sim.step();\n}\ncheck(sim.ended);\ncheck_close(sim.slider_position(ring), 1, 1e-12);")
            .see(&["ending", "slider"]),
        property(SIMULATION, "ending", |call| {
            Ok(call.receiver::<SimulationHandle>()?.simulation().ending().unwrap_or_default().into())
        })
        .returns(Returns::TEXT.note(", empty while the run goes on"))
        .summary("Why the run has ended.")
        .example("check(sim.ending == \"\");\nsim.run_to(5);\nprint(sim.ending);")
        .see(&["ended", "events"]),
        property(SIMULATION, "events", events)
            .returns(Returns::array_of(&ValueKind::Map).note(" #{ t, slider, end, what, impulse }"))
            .summary("When sliders reached ends of their beams and seams of their tracks so far, and what happened there.")
            .doc(
                "slider is its name; end is \"start\" or \"end\"; what is \"stopped\", \"bounced\", \"rested\" (it leans on the \
                 end until that would have to pull: in an elastic contact, or until it is drawn away), \"released\" or, on a track, \"passed\": to the next beam. impulse is \
                 what the slider gave its beams in that instant, in the impact with all else that arrived then, a vector (mass·length/time): contact forces have no part of it. On a track \
                 the map has the name of the beam as well, at one of whose ends that was: beam.",
            )
            .example("sim.run_to(5);\nfor event in sim.events {\n    print(`${event.slider} ${event.what} at ${event.end}, t = ${event.t}`);\n}")
            .see(&["ended", "slider"]),
    ],
};

const RULE: Type = Type::of::<SlidingRule>();
pub(super) const SLIDER: Type = Type::of::<SliderHandle>();

const ON: Parameter = either("beam", &[Kind::Object(BEAM), Kind::Object(TRACK)]);
pub(super) const WHICH: Parameter = object("slider", SLIDER);
const ENDS: [(&str, EndAction); 4] = [
    ("stop", EndAction::Stop),
    ("bounce", EndAction::Bounce),
    ("contact", EndAction::Contact),
    ("release", EndAction::Release),
];
const VELOCITIES: [(&str, StartVelocities); 2] =
    [("check", StartVelocities::Check), ("project", StartVelocities::Project)];
const SLIDER_KEYS: &[Parameter] = &[
    number("at")
        .between(0.0, 1.0)
        .unit("part of the length")
        .doc("where it starts, as a part of the length of the beam or the track as drawn; the nearest place unless given")
        .optional(),
    object("rule", RULE).doc("conserving() unless given").optional(),
    choice("ends", &[ENDS[0].0, ENDS[1].0, ENDS[2].0, ENDS[3].0])
        .doc("what happens where the beam or the track ends: the run stops, the slider bounces off by its restitution, it leans on the end for as long as that pushes, or it flies free")
        .or(Presence::Text("stop")),
    number("restitution")
        .between(0.0, 1.0)
        .doc("how much of its speed a slider with ends: \"bounce\" keeps where it bounces: 1 unless given, all of it")
        .optional(),
    choice("velocities", &[VELOCITIES[0].0, VELOCITIES[1].0])
        .doc("start velocities across the beam: an error, or replaced by the nearest that fit")
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
        let told = format!("the slider '{}' was added after the scene was started", self.name());
        Err(ScriptError::new(told).hint("add all sliders before scene.start(…), or start again"))
    }
}

impl Scripted for SliderHandle {
    const NAME: &'static str = "slider";
    const DOC: &'static str = "A sliding joint of a scene.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let slider = &scene.sliders[self.index];
        let (guide, part) = details::guide_of(&scene, slider);
        format!(
            "slider '{}': {} on {guide} at {} of its length, {} rule",
            slider.name,
            scene.describe(&slider.slave),
            significant(part, 7),
            slider.rule.entry().name
        )
    }

    fn details(&self) -> Details {
        details::of_slider(&self.scene.scene().borrow(), self.index)
    }

    fn family(
        &self,
    ) -> Option<std::rc::Rc<crate::script::bindings::parameter_variants::ParameterSet>> {
        self.scene.family()
    }
}

impl Scripted for SlidingRule {
    const NAME: &'static str = "sliding rule";
    const DOC: &'static str = "How a step keeps a slider on its beam.";

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
    let at = options.number_if_given("at");
    let name = options.text_if_given("name")?;
    let ends = meant(&ENDS, &options.text("ends")?);
    let restitution = options.number_if_given("restitution");
    if restitution.is_some() && ends != EndAction::Bounce {
        let told = "slider: 'restitution' is of sliders that bounce, with ends: \"bounce\"";
        return Err(ScriptError::new(told).at(CallPart::Key("restitution".into())));
    }
    let restitution = restitution.unwrap_or(1.0);
    let (master, arc_length) = guide.start(&scene.borrow(), slave, at)?;
    let definition = Slider {
        name: name.unwrap_or_else(|| scene.borrow().free_name("slider")),
        slave,
        master,
        track: guide.track(),
        arc_length,
        rule: options.get_if("rule").unwrap_or_default(),
        ends,
        restitution,
        velocities: meant(&VELOCITIES, &options.text("velocities")?),
    };
    let added = scene.borrow_mut().add_slider(definition);
    let index = added.map_err(|error| blame(error, at.is_some()))?;
    Ok(Dynamic::from(SliderHandle { scene: handle, index }))
}

pub(super) fn meant<T: Copy + Default>(words: &[(&str, T)], word: &str) -> T {
    let found = words.iter().find(|(other, _)| *other == word);
    found.map(|(_, meaning)| *meaning).unwrap_or_default()
}

fn blame(error: SystemError, is_placed: bool) -> ScriptError {
    let place = match &error {
        SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
            CallPart::Key("name".into())
        }
        SystemError::Slider(error) => match **error {
            SliderError::Open { .. } if is_placed => CallPart::Key("at".into()),
            SliderError::OnItself(_) => CallPart::Argument(1),
            _ => CallPart::Argument(0),
        },
        _ => CallPart::Argument(0),
    };
    ScriptError::from(error).at(place)
}

fn asked(call: &Call, ask: impl FnOnce(&System, usize) -> Dynamic) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let slider = call.get::<SliderHandle>("slider")?.on(&handle)?;
    let simulation = handle.simulation();
    Ok(ask(simulation.model(), slider))
}

fn events(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let simulation = handle.simulation();
    let event = |arrival: &Arrival| {
        let slider = &simulation.scene().sliders[arrival.limit.slider].name;
        let words = [
            ("slider", slider.as_str()),
            ("end", arrival.limit.end.name()),
            ("what", arrival.kind.name()),
        ];
        let mut map: Map = words.into_iter().map(|(key, word)| (key.into(), word.into())).collect();
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
