//! Sleeves without length, through which a beam slides without friction.
//! A sleeve restrains the direction of the beam and its displacement across the sleeve.

use rhai::Dynamic;

use super::equilibria::EQUILIBRIUM;
use super::scenes::{BEAM, SCENE, STATION};
use super::simulations::SIMULATION;
use super::sliding::{ENDS, SLIDER, SliderHandle, WHICH, meant, slider_error, slider_value};
use crate::beams::Station;
use crate::geometry::Vec2;
use crate::joints::{Restraint, Slider, StartVelocities};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::{
    Parameter, Presence, choice, either, number, object, options, text,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::ScriptError;
use crate::system::{Scene, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "sleeves",
    doc: "A beam slides through a sleeve without length: a point that stays on the axis of the beam \
        and keeps its angle to the beam. The history has the columns of sliders and NAME.couple. \
        mechanisms::sleeve of the standard library is a sleeve of two eyelets.",
    types: &[],
    setup: SLEEVED,
    constants: &[],
    rows: &[
        method(SCENE, "sleeve", &[HOLDER, object("beam", BEAM), options("options", SLEEVE_KEYS).optional()], sleeve)
            .returns(Returns::object(SLIDER))
            .summary("Adds a sleeve without length, in which a beam slides without friction and keeps \
                its angle to the holder.")
            .doc(
                "The holder is a station of a rigid body or of another beam, or a point of the \
                 ground. A point of the ground becomes a fixed body NAME_holder, whose joint has the same name; to turn a sleeve, \
                 hold it with a hinged body and scene.move(body.centre, #{ angle: … }). The \
                 sleeve exerts a force (contact_force) and a couple (sleeve_couple). In \
                 equilibrium a moment M at the mouth pushes the beam along the sleeve with \
                 M²/2EI. In an equilibrium the compliance of kink and jump of curvature at the \
                 sleeve, which the mesh does not represent, is included in positions and forces, \
                 but not in rest.strain. In motion it is not: the beam is as stiff at the sleeve \
                 as its mesh, results converge with the spans, and rest.start first solves for \
                 the equilibrium without it. Energy, both momenta and the gap are kept to \
                 rounding with energy_momentum(); initial velocities are made compatible. The \
                 beam must be uniform, and a track cannot slide in a sleeve. Default names: sleeve1, sleeve2, … \
                 docs/theory.md, section 14.2.",
            )
            .example(
                "let hub = scene.body(#{ name: \"hub\", at: [0.5, 0], mass: 1, inertia: 1 });\n\
                 scene.hinge(hub.centre);\n\
                 scene.move(hub.centre, #{ angle: |t| 0.1 * t });\n\
                 let guide = scene.sleeve(hub.centre, rod, #{ name: \"guide\" });\n\
                 let rest = scene.equilibrium(#{ time: 1 });\n\
                 check(abs(rest.sleeve_couple(guide)) > 0.01);\n\
                 let sim = scene.start(#{ dt: 0.01 });\n\
                 sim.run_to(0.1);\n\
                 check(sim.history.drift(\"energy\") < 1e-12);\n\
                 print(sim.sleeve_couple(guide));",
            )
            .with_related(&["slider", "sleeve_couple", "contact_force", "slider_arc_length", "equilibrium"]),
        method(SIMULATION, "sleeve_couple", &[WHICH], |call| {
            slider_value(call, |model, slider| model.sleeve_couple(slider).into())
        })
        .returns(Returns::NUMBER.unit("force·length"))
        .summary("Returns the couple of a sleeve on its beam, counter-clockwise, as the mean of the \
            last step; zero for other sliders.")
        .doc("As contact_force: the mean belongs to the middle of the step, and before the first \
            step it is the present couple. The column of the history is NAME.couple; \
            scene.record(\"NAME.present_couple\") records the present couple.")
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\ncheck(sim.sleeve_couple(mouth) == sim.history.last(\"mouth.couple\"));")
        .with_related(&["sleeve", "contact_force"]),
        method(EQUILIBRIUM, "sleeve_couple", &[WHICH], |call| {
            let handle = call.receiver::<EquilibriumHandle>()?;
            let equilibrium = handle.equilibrium();
            let slider = call.get::<SliderHandle>("slider")?.among(handle.scene(), equilibrium.scene())?;
            Ok(equilibrium.model().sleeve_couple(slider).into())
        })
        .returns(Returns::NUMBER.unit("force·length"))
        .summary("Returns the couple of a sleeve on its beam in equilibrium, counter-clockwise; zero \
            for other sliders.")
        .doc("The bending moment of the beam jumps by the couple at the sleeve. The moment on the \
            holder also contains that of contact_force about the holder: the kink of the axis \
            moves its point of action.")
        .example("let rest = scene.equilibrium();\ncheck_close(rest.sleeve_couple(mouth), 0.1, 1e-3);\ncheck_close(rest.contact_force(mouth).y, 0.1, 1e-6);")
        .with_related(&["sleeve", "contact_force"]),
    ],
};

/// Cantilever that a sleeve clamps, with a support behind the sleeve.
const SLEEVED: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e5, GA: 1e5, EI: 1, rho_A: 1, rho_I: 1e-3 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([-0.5, 0], [1, 0]), basis: bspline(15), section: s });\n\
    let mouth = scene.sleeve([0, 0], rod, #{ name: \"mouth\" });\n\
    scene.support(rod.start, #{ x: true });\n\
    scene.force(rod.end, [0, -0.1], hold_for(2));";

const HOLDER: Parameter = either("holder", &[Kind::Object(STATION), Kind::Point]);

const SLEEVE_KEYS: &[Parameter] = &[
    number("at")
        .between(0.0, 1.0)
        .unit("fraction of the length")
        .doc("initial position as a fraction of the undeformed length of the beam; default: the nearest place")
        .optional(),
    choice("ends", &[ENDS[0].0, ENDS[3].0])
        .doc("stop: the sleeve is held at the ends of the beam in an equilibrium, and a run ends when it arrives there; release: the beam leaves the sleeve, and then has no equilibrium")
        .or(Presence::Text("stop")),
    text("name").optional(),
];

fn sleeve(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let master = call.get::<BeamHandle>("beam")?.index_in(&handle)?;
    let options = call.options_or_defaults("options")?;
    let (at, name) = (options.optional_number("at"), options.optional_text("name")?);
    let holder = match call.get_if::<StationHandle>("holder") {
        Some(station) => Holder::Station(handle.own_station(&station)?),
        None => Holder::Ground(call.point("holder")?),
    };
    let shared = handle.shared_for_change();
    let mut scene = shared.borrow_mut();
    let name = name.unwrap_or_else(|| scene.free_name("sleeve"));
    let ends = meant(&ENDS, &options.text("ends")?);
    let before = scene.clone();
    let sleeve = Slider {
        restraint: Restraint::PlaceAndDirection,
        ends,
        velocities: StartVelocities::Project,
        ..Slider::new(name, Station::on_beam(master, 0.0), master, 0.0)
    };
    let added = add(&mut scene, holder, sleeve, at);
    let index = added.map_err(|error| {
        *scene = before;
        slider_error(error, at.is_some())
    })?;
    drop(scene);
    Ok(Dynamic::from(SliderHandle { scene: handle, index }))
}

/// Object that holds a sleeve.
enum Holder {
    Station(Station),
    Ground(Vec2),
}

fn add(
    scene: &mut Scene,
    holder: Holder,
    sleeve: Slider,
    at: Option<f64>,
) -> Result<usize, SystemError> {
    let slave = match holder {
        Holder::Station(station) => station,
        Holder::Ground(place) => scene.add_holder(&sleeve.name, place)?,
    };
    let arc_length = match at {
        Some(part) => part * scene.beams[sleeve.master].axis.length(),
        None => scene.nearest_arc_length(sleeve.master, &slave)?,
    };
    scene.add_slider(Slider { slave, arc_length, ..sleeve })
}
