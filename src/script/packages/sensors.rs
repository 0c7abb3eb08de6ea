//! Sensors: additional columns of the history, and single readings.

use rhai::{Array, Dynamic, FnPtr, Map};

use super::equilibria::EQUILIBRIUM;
use super::scenes::{BEAM, JOINT, SCENE, STATION};
use super::simulations::SIMULATION;
use super::sliding::{SLIDER, SliderHandle};
use super::statistics::map;
use super::vectors::VECTOR;
use crate::beams::{SectionForces, Station};
use crate::geometry::{Vec2, is_on_length};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, Scripted};
use crate::script::bindings::parameter::{Parameter, callback, either, number, object, text};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::joint::JointHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::simulation::History;
use crate::system::{Reactions, Scene, SectionSample, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "sensors",
    doc: "A scene records what it is asked to: scene.record(\"rod.end.x\") makes a column of the history, which is told, drawn, saved and counted like every other. \
          A ready sensor is an object, a place and a quantity. Places of a beam: rod.start, rod.end, rod[0.5] (arc length as drawn); with x, y, vx, vy, speed, ax, ay, angle, spin, \
          N, Q, M, axial_strain, shear_strain, curvature. A particle has x to ay; a rigid body x to ay, angle and spin, of its centre of mass, and of its points: hub.x, hub.pin.y. A beam, a particle or a body as a whole: energy, kinetic, strain, axial, shear, bending, potential. \
          Joints, counted by kind as they were made (hinge1, hinge2, clamp1, rigid1): force, fx, fy, moment, on the station that was named first, and mean_force, mean_fx, mean_fy, mean_moment in the mean of the last step. Sliders: present_force, present_force_x, present_force_y, on the beam. Section forces, accelerations and forces are \
          those of the present moment, by the equations of motion, of second order like the motion; where a stiff beam rings from step to step they ring with it, and \
          sim.history.averaged(column) does not. A scene without sensors pays nothing.",
    types: &[],
    setup: HANGING,
    constants: &[],
    rows: &[
        method(SCENE, "record", &[text("column").doc("a ready sensor, or the name of a column for a function"), callback("function").doc("|q| …, gives a number; q is the simulation").optional()], record)
            .summary("Records one more column in the histories of simulations that are started from here on.")
            .doc(
                "A function is asked at the start, and after every recorded step as soon as that is done; it looks, and does not move the simulation. Of the parts of a step of \
                 scene.step that had to be halved, the last is asked alone. A simulation with a function cannot be saved, and studies leave functions out; with ready sensors it can, and they do not.",
            )
            .example(
                "scene.record(\"rod.end.x\");\nscene.record(\"height\", |q| q.position(rod.end).y + 3);\nlet sim = scene.start(#{ dt: 0.05 });\nsim.run_to(1);\n\
                 check(sim.history.column(\"rod.end.x\").len() == 21);\ncheck_close(sim.history.last(\"height\"), sim.position(rod.end).y + 3, 1e-15);",
            )
            .see(&["statistics", "spectrum", "column", "every", "plot_history"]),
        method(SIMULATION, "section_forces", &[object("beam", BEAM), S], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<SimulationHandle>()?);
            let index = beam.own(handle.scene())?;
            let simulation = handle.simulation();
            known(call, simulation.scene(), index, &beam)?;
            match wanted(call, simulation.scene(), index)? {
                Some(at) => Ok(told(&simulation.section_forces(&at)?).into()),
                None => Ok(along(&simulation.section_forces_along(index)?)),
            }
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Array(&ValueKind::Map)]))
        .summary("Axial force, shear force and moment of a beam: at an arc length, or along all of it.")
        .doc(
            "The map holds N (positive in tension), Q (positive to the left of the axis) and M (positive counter-clockwise) [force, force, force·length], which the part of the beam that follows puts on \
             the part before, in the frame of the section; and axial_strain, shear_strain and curvature. Forces follow from strains by the law of the material; where that is damped (Kelvin–Voigt), what the present rates of strain add is in N, Q and M. Where steps are too long for these rates, they alternate; then the mean rates of the last two steps are carried on to the present and used instead (not in the first step after a start or a blow). Along a beam there is one for each knot and three between, with \
             its arc length s; where a joint cuts the beam there are two of one s. They balance loads and inertia up to the ends of a beam, with errors that fall with the length of a \
             span to the power of the degree (N, Q), and to that of two or more (M). Of linear elements each has one value. \
             A force, moment, mass, spring or slider *inside* a beam jumps where smooth functions cannot: over two spans beside it M errs by a part of what a span is long, and Q rings by up to a fifth of the jump on any mesh. \
             A joint cuts a beam: where such values count, make it of two beams with scene.rigid(…) there.",
        )
        .example(
            "let sim = scene.start(#{ dt: 0.01 });\nsim.step();\nlet along = sim.section_forces(rod);\ncheck(along[0].s == 0 && along.len() == 17);\n\
             check_close(sim.section_forces(rod, 2).M, 0, 1e-2);",
        )
        .see(&["reaction", "record"]),
        method(EQUILIBRIUM, "section_forces", &[object("beam", BEAM), S], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<EquilibriumHandle>()?);
            let index = beam.own(handle.scene())?;
            let rest = handle.rest();
            known(call, rest.scene(), index, &beam)?;
            match wanted(call, rest.scene(), index)? {
                Some(at) => Ok(told(&rest.section_forces(&at)?).into()),
                None => Ok(along(&rest.section_forces_along(index)?)),
            }
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Array(&ValueKind::Map)]))
        .summary("Axial force, shear force and moment of a beam at rest: at an arc length, or along all of it.")
        .doc("As those of a simulation.")
        .example(
            "scene.hinge(rod.end);\nlet rest = scene.equilibrium();\nlet middle = rest.section_forces(rod, 1);\n\
             check_close(middle.Q, 0, 1e-6);\ncheck_close(middle.M, 9.81 * 2^2 / 8, 0.06);",
        )
        .see(&["reaction"]),
        method(SIMULATION, "reaction", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.on(&handle)?;
            let reaction = handle.look(|simulation| {
                let now = simulation.instant()?;
                Ok::<_, SystemError>(simulation.model().reaction(now.given(), &place))
            })?;
            reaction.map(force_and_moment).ok_or_else(|| holds_nothing(call, &station))
        })
        .returns(Returns::MAP)
        .summary("What the support at a station gives at the present moment: force, a vector, and moment.")
        .doc(
            "By the equations of motion, with loads as they are just after the present: the configuration and the rates at the end of a step are of second order in the step size \
             with every method, and so is this. What loads, weight and supports gave together over a step, in the mean, is the change of the columns impulse_x and impulse_y over its length.",
        )
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\nlet given = sim.reaction(rod.start);\ncheck(norm(given.force) > 1 && given.moment == 0);")
        .see(&["mean_reaction", "joint_force", "section_forces", "record"]),
        method(SIMULATION, "joint_force", &[WHICH], joint_force)
            .returns(Returns::MAP)
            .summary("What a joint gives to the station that was named first: force, a vector, and moment.")
            .doc("At the present moment, by the equations of motion, of second order in the step size as those of `reaction`. A joint with the ground is a support. It is what scene.hinge gave, or its name: its kind, and \
                  the how-manieth of that. One that has let go gives nothing.")
            .example("let sim = scene.start(#{ dt: 0.01 });\ncheck(sim.joint_force(\"hinge1\").force == sim.reaction(rod.start).force);")
            .see(&["mean_joint_force", "reaction"]),
        method(SIMULATION, "mean_reaction", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.on(&handle)?;
            let given = given_in_step(call, &handle)?;
            let reaction = handle.simulation().model().reaction(&given, &place);
            reaction.map(force_and_moment).ok_or_else(|| holds_nothing(call, &station))
        })
        .returns(Returns::MAP)
        .summary("What the support at a station gave in the mean of the last step: force, a vector, and moment.")
        .doc(MEAN)
        .example(
            "scene.record(\"hinge1.mean_force\");\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\nlet momentum = sim.history.column(\"momentum_y\");\n\
             let change = (momentum[100] - momentum[99]) / 0.01;\n\
             check_close(sim.mean_reaction(rod.start).force.y - 2 * 9.81, change, 1e-9);",
        )
        .see(&["reaction", "mean_joint_force", "record"]),
        method(SIMULATION, "mean_joint_force", &[WHICH], |call| {
            let (handle, joint) = (call.receiver::<SimulationHandle>()?, joint_index(call)?);
            let given = given_in_step(call, &handle)?;
            let simulation = handle.simulation();
            let joint = simulation.model().transmission(simulation.scene(), joint)?;
            Ok(force_and_moment(joint.read(&given)))
        })
        .returns(Returns::MAP)
        .summary("What a joint gave in the mean of the last step to the station that was named first: force, a vector, and moment.")
        .doc(MEAN)
        .example(
            "scene.record(\"hinge1.mean_fy\");\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
             let given = sim.mean_joint_force(\"hinge1\").force;\n\
             check(given.y == sim.history.last(\"hinge1.mean_fy\"));",
        )
        .see(&["joint_force", "mean_reaction", "record"]),
        method(SIMULATION, "present_contact_force", &[object("slider", SLIDER)], |call| {
            let handle = call.receiver::<SimulationHandle>()?;
            let slider = call.get::<SliderHandle>("slider")?.on(&handle)?;
            let now = handle.look(|simulation| simulation.instant())?;
            Ok(Dynamic::from(now.contact(slider)))
        })
        .returns(Returns::object(VECTOR).unit("force"))
        .summary("The force of a slider on its master at the present moment.")
        .doc(
            "By the equations of motion, with the order of the motion: second, fourth with fourth_order(). contact_force and the columns NAME.force are those of the steps: \
             the mean of a step, which belongs to its middle, and may alternate from step to step. As a column: scene.record(\"NAME.present_force\").",
        )
        .example(
            "let bead = scene.slider(scene.particle([1, 0], 0.5), rod, #{ at: 0.5 });\nlet sim = scene.start(#{ dt: 0.001 });\nsim.run_to(0.1);\n\
             print(sim.present_contact_force(bead));",
        )
        .see(&["contact_force", "joint_force"]),
        method(SIMULATION, "acceleration", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.on(&handle)?;
            let acceleration = handle.look(|simulation| {
                let now = simulation.instant()?;
                Ok::<_, SystemError>(simulation.model().acceleration(&now, &place))
            })?;
            Ok(Dynamic::from(acceleration))
        })
        .returns(Returns::object(VECTOR).unit("length/time²"))
        .summary("How a station accelerates at the present moment, by the equations of motion.")
        .example("let sim = scene.start(#{ dt: 0.01 });\ncheck(norm(sim.acceleration(rod.start)) == 0);\ncheck_close(sim.acceleration(rod.end).y, -9.81, 0.5);")
        .see(&["velocity", "spin"]),
        method(SIMULATION, "spin", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.on(&handle)?;
            if !station.station.turns() {
                let told = format!("{} does not turn: it has no spin", station.show());
                return Err(call.error(told).hint("ask for the spin at a station of a beam or a body"));
            }
            Ok(handle.simulation().model().spin(&place).into())
        })
        .returns(Returns::NUMBER.unit("1/time"))
        .summary("The angular velocity of the section at a station, counter-clockwise.")
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\ncheck(sim.spin(rod.end) < 0);")
        .see(&["angle", "acceleration"]),
        method(SIMULATION, "energy", &[object("beam", BEAM)], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<SimulationHandle>()?);
            let index = beam.own(handle.scene())?;
            known(call, handle.simulation().scene(), index, &beam)?;
            let energy = handle.look(|simulation| simulation.energy_of(index));
            Ok(map(&[
                ("energy", energy.total()),
                ("kinetic", energy.kinetic),
                ("strain", energy.strain()),
                ("axial", energy.axial),
                ("shear", energy.shear),
                ("bending", energy.bending),
                ("potential", energy.potential),
            ]))
        })
        .returns(Returns::MAP.unit("energy"))
        .summary("The energy of a beam and of what stands on it, by kind: with what springs store, those of all bodies add up to that of the scene.")
        .doc("The map holds energy, kinetic, strain, axial, shear, bending and potential. Without a beam, sim.energy is that of the scene.")
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\ncheck_close(sim.energy(rod).energy, sim.energy, 1e-12);")
        .see(&["record"]),
    ],
};

const HANGING: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 0.01 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
    scene.hinge(rod.start);\n\
    scene.gravity([0, -9.81]);";

const MEAN: &str = "It is summed up while steps are made, where one of the columns mean_force, mean_fx, mean_fy, mean_moment is recorded, as in \
    scene.record(\"hinge1.mean_force\"), and then for all joints and supports. With loads, weight and drives, these forces change the momentum over the step, and with \
    the moments about a place, each force in the middle of its way over the step, the angular momentum: to rounding with energy_momentum() and energy_decaying(), and \
    the momentum with fourth_order() and trapezoidal() too. It belongs to the middle of the step, to second order, and holds the blows of sliders that bounced. \
    Zero before the first step. generalized_alpha() has none.";

const AT: Parameter = object("station", STATION);
const WHICH: Parameter = either("joint", &[Kind::Object(JOINT), Kind::Text]);
const S: Parameter = number("s")
    .unit("length")
    .doc("arc length from the start, as drawn; along the beam if not given")
    .optional();

fn record(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (scene, column) = (call.receiver::<SceneHandle>()?, call.text("column")?);
    if History::COLUMNS.iter().any(|own| own.name == column.as_str()) {
        let taken = SystemError::DuplicateSensor { name: column.to_string() };
        return Err(ScriptError::from(taken).at(CallPart::Argument(0)));
    }
    if let Some(function) = call.get_if::<FnPtr>("function") {
        call.expect_arguments(&function, 1, "|q| …, a function of the simulation")?;
        let function = call.store(function, &format!("the function of the column '{column}'"));
        scene.scene().borrow_mut().record_outside(&column)?;
        scene.keep_function(function);
        return Ok(Dynamic::UNIT);
    }
    let recorded = scene.scene().borrow_mut().record(&column);
    recorded.map_err(|error| {
        let names = scene.scene().borrow().sensor_names();
        let meant = nearest(&column, names.iter().map(String::as_str));
        let told = ScriptError::from(error).at(CallPart::Argument(0));
        match meant {
            Some(meant) => told.hint(format!("did you mean \"{meant}\"?")),
            None => told.hint(format!(
                "or give a function: scene.record(\"{column}\", |q| q.position(rod.end).x)"
            )),
        }
    })?;
    Ok(Dynamic::UNIT)
}

fn joint_force(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, joint) = (call.receiver::<SimulationHandle>()?, joint_index(call)?);
    let (now, joint) = handle.look(|simulation| {
        let joint = simulation.model().transmission(simulation.scene(), joint)?;
        Ok::<_, SystemError>((simulation.instant()?, joint))
    })?;
    Ok(force_and_moment(joint.read(now.given())))
}

fn joint_index(call: &mut Call) -> Result<usize, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let name = match call.get_if::<JointHandle>("joint") {
        Some(joint) => {
            handle.scene().expect_same(&joint.scene, "joint")?;
            joint.name()
        }
        None => call.text("joint")?.into(),
    };
    let names = handle.simulation().scene().joint_names();
    let found = names.iter().position(|other| *other == name);
    found.ok_or_else(|| unknown(call, &name, "joint", names.iter().map(String::as_str)))
}

/// Mean forces of joints and supports over the last step, if they are accumulated.
fn given_in_step(call: &Call, handle: &SimulationHandle) -> Result<Reactions, ScriptError> {
    handle.simulation().model().given_in_step().ok_or_else(|| {
        let names = handle.simulation().scene().joint_names();
        let joint = names.first().map_or("hinge1", String::as_str);
        call.error("what joints and supports gave over a step was not summed up")
            .hint(format!("write scene.record(\"{joint}.mean_force\") before scene.start(…)"))
    })
}

fn holds_nothing(call: &Call, station: &StationHandle) -> ScriptError {
    call.error(format!("nothing holds the scene at {}", station.show()))
        .hint("ask where scene.clamp(…) or scene.hinge(…) ties it to the ground")
}

fn unknown<'a>(
    call: &Call,
    name: &str,
    what: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> ScriptError {
    let all: Vec<&str> = known.clone().collect();
    let hint = match (nearest(name, known), all.as_slice()) {
        (Some(meant), _) => format!("did you mean \"{meant}\"?"),
        (None, []) => format!("the scene has no {what}s"),
        (None, all) => format!("there are: {}", all.join(", ")),
    };
    call.error(format!("there is no {what} '{name}'")).hint(hint).at(CallPart::Argument(0))
}

fn known(call: &Call, built: &Scene, index: usize, beam: &BeamHandle) -> Result<(), ScriptError> {
    if index < built.beams.len() {
        return Ok(());
    }
    let told = format!("{} was added after the scene was started", beam.show());
    Err(call.error(told).hint("add everything before scene.start(…), or start again"))
}

fn wanted(call: &Call, scene: &Scene, beam: usize) -> Result<Option<Station>, ScriptError> {
    let Some(station) = call.number_if_given("s") else { return Ok(None) };
    let length = scene.beams[beam].axis.length();
    if !is_on_length(station, length) {
        let beam = scene.beams[beam].name.clone();
        let refused = ScriptError::from(SystemError::StationOutside { beam, station, length });
        return Err(refused.at(CallPart::Argument(1)));
    }
    Ok(Some(Station::on_beam(beam, station.clamp(0.0, length))))
}

fn force_and_moment((force, moment): (Vec2, f64)) -> Dynamic {
    let map = [("force", Dynamic::from(force)), ("moment", moment.into())];
    map.into_iter().map(|(name, value)| (name.into(), value)).collect::<Map>().into()
}

fn told(forces: &SectionForces) -> Map {
    let entries = [
        ("N", forces.axial),
        ("Q", forces.shear),
        ("M", forces.moment),
        ("axial_strain", forces.axial_strain),
        ("shear_strain", forces.shear_strain),
        ("curvature", forces.curvature),
    ];
    entries.into_iter().map(|(name, value)| (name.into(), value.into())).collect()
}

fn along(samples: &[SectionSample]) -> Dynamic {
    let row = |sample: &SectionSample| {
        let mut row = told(&sample.forces);
        row.insert("s".into(), sample.arc_length.into());
        Dynamic::from(row)
    };
    samples.iter().map(row).collect::<Array>().into()
}
