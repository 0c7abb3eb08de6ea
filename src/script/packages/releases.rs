//! Releases of joints, sliders, springs and drives during a run.

use rhai::{Array, Dynamic, Map};

use super::scenes::{JOINT, SCENE};
use super::simulations::SIMULATION;
use super::sliding::{SLIDER, SliderHandle};
use super::springs::{SPRING, SpringHandle};
use crate::joints::{Releasable, Release, Trigger};
use crate::script::bindings::call::Call;
use crate::script::bindings::key_sets::{KeySet, KeySets};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::{Parameter, callback, either, number, options};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, method, property};
use crate::script::handles::joint::JointHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::system::SystemError;

pub const TABLE: BindingTable = BindingTable {
    name: "releases",
    doc: "Releases of joints, sliders, springs and drives during a run. Positions and velocities \
        are continuous at a release, so that energy and momenta of the bodies are kept \
        exactly; accelerations jump. The energy stored in a released spring counts as \
        dissipated. scene.equilibrium and scene.modes ignore releases: everything is attached.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "release", &[WHAT, options("options", RELEASE_KEYS)], release)
            .summary("Releases a joint, slider, spring or drive at a time or by a condition.")
            .doc("The object is the return value of scene.hinge, scene.clamp, scene.rigid, \
                scene.support, scene.slider or scene.spring, or a name: \"hinge1\", \
                \"motor1\". With `at` a step ends at this time, and the next step is without \
                the object. `when` is a function of the simulation, |q| …, that returns true \
                for the release. It is called before every step, not within steps: the release \
                is at the end of the first step at which it returns true, so that shorter \
                steps find the time more accurately. The state at that time still contains the \
                object; a run that goes back to it and continues releases it again.")
            .example("let latch = scene.clamp(rod.start);\nlet pin = scene.hinge(rod.end);\n\
                      scene.release(pin, #{ at: 0.25 });\n\
                      scene.release(latch, #{ when: |q| q.position(rod.end).y < -0.001 });\n\
                      scene.gravity([0, -10]);\n\
                      let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.5);\n\
                      check(sim.releases[0].t == 0.25 && sim.releases.len == 2);\n\
                      check(sim.history.drift(\"energy\") < 1e-10);")
            .with_related(&["present_joint_force", "hinge", "releases"]),
        property(SIMULATION, "releases", releases)
            .returns(Returns::array_of(&ValueKind::Map).with_remark(" #{ t, name }"))
            .summary("Releases made so far by scene.release, with their times.")
            .example("let pin = scene.hinge(rod.start);\nscene.release(pin, #{ at: 0.1 });\n\
                      let sim = scene.start(#{ dt: 0.05 });\nsim.run_to(0.2);\nprint(sim.releases);")
            .with_related(&["release", "events"]),
    ],
};

const WHAT: Parameter =
    either("what", &[Kind::Object(JOINT), Kind::Object(SLIDER), Kind::Object(SPRING), Kind::Text]);
const RELEASE_KEYS: &[Parameter] = &[
    number("at").unit("time").doc("time of the release, after the start").optional(),
    callback("when").doc("condition, |q| …; returns true for the release").optional(),
];

#[derive(Clone, Copy)]
enum ReleaseWording {
    At,
    When,
}

const WORDINGS: KeySets<ReleaseWording> = KeySets {
    description: "give a time `at` or a condition `when`: |q| …",
    always_allowed: &[],
    sets: &[
        KeySet {
            meaning: ReleaseWording::At,
            description: "a time",
            keys: &["at"],
            chosen_by: None,
        },
        KeySet {
            meaning: ReleaseWording::When,
            description: "a condition",
            keys: &["when"],
            chosen_by: None,
        },
    ],
};

fn release(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let hold = hold(call, &handle)?;
    let options = call.options("options")?;
    let (trigger, condition) = match WORDINGS.choose("release", &options)? {
        ReleaseWording::At => (Trigger::Time(options.number("at")?), None),
        ReleaseWording::When => {
            let function = options.callback("when")?;
            let shape = "when: |q| q.t > 0.5, where q is the simulation";
            call.expect_arguments(&function, 1, shape)?;
            (Trigger::Outside, Some(function))
        }
    };
    handle
        .shared_for_change()
        .borrow_mut()
        .add_release(Release { object: hold, trigger })
        .map_err(|error| {
            let place = match error {
                SystemError::Value { .. } => CallPart::Key("at".into()),
                _ => CallPart::Argument(0),
            };
            ScriptError::from(error).at(place)
        })?;
    if let Some(function) = condition {
        handle.store_condition(call.store(function, "the condition of a release"));
    }
    Ok(Dynamic::UNIT)
}

fn hold(call: &Call, handle: &SceneHandle) -> Result<Releasable, ScriptError> {
    if let Some(joint) = call.get_if::<JointHandle>("what") {
        handle.expect_same(&joint.scene, "joint")?;
        return Ok(Releasable::Joint(joint.index));
    }
    if let Some(slider) = call.get_if::<SliderHandle>("what") {
        return Ok(Releasable::Slider(slider.within(handle)?));
    }
    if let Some(spring) = call.get_if::<SpringHandle>("what") {
        return Ok(Releasable::Spring(spring.within(handle)?));
    }
    let (name, holds) = (call.text("what")?, handle.scene().borrow().releasables());
    if let Some((_, hold)) = holds.iter().find(|(known, _)| *known == name.as_str()) {
        return Ok(*hold);
    }
    let is_load = handle
        .scene()
        .borrow()
        .loads()
        .any(|load| load.title.as_ref().unwrap_or(&load.name) == name.as_str());
    if is_load {
        let rows = format!("'{name}' is a load, which cannot be released");
        return Err(call
            .error(rows)
            .hint("end a force or torque by its schedule: hold_for(0.5)")
            .at(CallPart::Argument(0)));
    }
    let hint = match nearest(&name, holds.iter().map(|(known, _)| known.as_str())) {
        Some(meant) => format!("did you mean \"{meant}\"?"),
        None if holds.is_empty() => "the scene has nothing to release".to_owned(),
        None => {
            let all: Vec<&str> = holds.iter().map(|(known, _)| known.as_str()).collect();
            format!("available: {}", all.join(", "))
        }
    };
    let rows = format!("there is no joint, slider, spring or drive '{name}'");
    Err(call.error(rows).hint(hint).at(CallPart::Argument(0)))
}

fn releases(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let simulation = handle.simulation();
    let scene = simulation.scene();
    let rows = simulation.releases().iter().map(|gone| {
        let name = scene.releasable_name(scene.releases[gone.release].object);
        let entries = [("t", Dynamic::from(gone.time)), ("name", name.into())];
        Dynamic::from(entries.into_iter().map(|(key, value)| (key.into(), value)).collect::<Map>())
    });
    Ok(rows.collect::<Array>().into())
}
