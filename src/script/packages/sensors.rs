//! Sensors: additional columns of the history, and single readings.

use rhai::{Array, Dynamic, FnPtr, Map};

use super::equilibria::EQUILIBRIUM;
use super::scenes::{BEAM, JOINT, SCENE, STATION};
use super::simulations::SIMULATION;
use super::sliding::{SLIDER, SliderHandle};
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
use crate::system::{Reactions, Scene, SectionSample, SystemError, body_energies, section_values};

pub const TABLE: BindingTable = BindingTable {
    name: "sensors",
    doc: "Sensors record quantities: scene.record(\"rod.end.x\") adds a column to the history, \
        which is printed, plotted, saved and evaluated like every other. The name of a \
        built-in sensor consists of an object, a place and a quantity. Places of a beam: \
        rod.start, rod.middle, rod.end, rod[0.5] (undeformed arc length), with x, y, vx, vy, \
        speed, ax, ay, angle, spin, N, Q, M, axial_strain, shear_strain, curvature. Particles: x to ay. \
        Rigid bodies: x to ay, angle and spin, of the centre of mass and of points: hub.x, \
        hub.pin.y. Whole beams, particles and bodies: energy, kinetic, strain, axial, shear, \
        bending, potential. Joints, numbered by kind in the order of creation (hinge1, hinge2, \
        clamp1, rigid1): force, fx, fy, moment, force_angle (the direction of the force), on the \
        first station, and present_force, present_fx, present_fy, present_moment. Sliders: \
        present_force, present_force_x, present_force_y, present_couple (of a sleeve), on the beam, and arc_length, from the \
        start of the undeformed beam or track. Drives, motors and named loads: power, the work \
        of the last step divided by the step size. Scenes without sensors have no extra cost. \
        Forces are means of the last step unless their name begins with present_: contact_force \
        and the columns NAME.force of sliders, springs, drives and loads; joint_force, \
        reaction and the columns force, fx, fy, moment of joints. The mean times the step size \
        is the impulse of the step; it belongs to the middle of the step, to second order. \
        With fourth_order() and with adaptive steps it covers all substeps. In the first row \
        it is the present force. Exceptions: forces of springs are those at the end of the \
        step with trapezoidal() and generalized_alpha(); forces of springs and loads are those \
        of the last substep with fourth_order() and adaptive steps; contact forces with generalized_alpha() are those \
        that the method balances; impulses of impacts are part of the forces of joints and \
        supports, not of sliders. \
        Section forces, accelerations and forces with present_ are present values computed \
        from the equations of motion, with the order of the motion. They alternate where a \
        stiff beam vibrates from step to step; sim.history.averaged(column) removes this.",
    types: &[],
    setup: HANGING,
    constants: &[],
    rows: &[
        method(SCENE, "record", &[text("column").doc("built-in sensor, or name of the column for a function"), callback("function").doc("|q| …, returns a number; q is the simulation").optional()], record)
            .summary("Adds a column to the histories of simulations that are started later.")
            .doc(
                "A function is called at the start and at the end of every recorded step; it \
                must read the simulation and not advance it. If a step of scene.step had to be \
                halved, it is called only after the last part. A simulation with a function \
                cannot be saved, and studies ignore functions; built-in sensors have no such \
                restriction.",
            )
            .example(
                "scene.record(\"rod.end.x\");\nscene.record(\"height\", |q| q.position(rod.end).y + 3);\nlet sim = scene.start(#{ dt: 0.05 });\nsim.run_to(1);\n\
                 check(sim.history.column(\"rod.end.x\").len() == 21);\ncheck_close(sim.history.last(\"height\"), sim.position(rod.end).y + 3, 1e-15);",
            )
            .with_related(&["statistics", "spectrum", "column", "every", "plot_history"]),
        method(SIMULATION, "section_forces", &[object("beam", BEAM), S], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<SimulationHandle>()?);
            let index = beam.index_in(handle.scene())?;
            let simulation = handle.simulation();
            known(call, simulation.scene(), index, &beam)?;
            match wanted(call, simulation.scene(), index)? {
                Some(at) => Ok(section_forces_map(&simulation.section_forces(&at)?).into()),
                None => Ok(along(&simulation.section_forces_along(index)?)),
            }
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Array(&ValueKind::Map)]))
        .summary("Returns axial force, shear force and moment of a beam at an undeformed arc length, \
            or along the whole beam.")
        .doc(
            "The map has N (positive in tension), Q (positive to the left of the axis) and M \
            (positive counter-clockwise) [force, force, force·length], acting from the \
            following part of the beam on the preceding one, in the frame of the section; and \
            axial_strain, shear_strain and curvature. Forces follow from strains by the \
            material law; with damping (Kelvin–Voigt) they include the present strain rates. \
            If the steps are too long for these rates, which then alternate, the rates are \
            extrapolated from the means of the last two steps (not in the first step after a \
            start or an impact). For a whole beam the result is an array with a map at each \
            knot and at three points between, with the arc length s; where a joint divides the \
            beam there are two with the same s. The values balance loads and inertia up to the \
            ends of a beam; errors decrease with the span length to the power of the degree \
            (N, Q), and of at least two (M). Linear elements have one value each. A force, \
            moment, mass, spring or slider *inside* a beam causes a jump that smooth functions \
            cannot represent: in the two neighbouring spans M has an error proportional to the \
            span length, and Q oscillates by up to a fifth of the jump on any mesh. If such \
            values matter, make two beams and join them there with scene.rigid(…).",
        )
        .example(
            "let sim = scene.start(#{ dt: 0.01 });\nsim.step();\nlet along = sim.section_forces(rod);\ncheck(along[0].s == 0 && along.len() == 17);\n\
             check_close(sim.section_forces(rod, 2).M, 0, 1e-2);",
        )
        .with_related(&["reaction", "record"]),
        method(EQUILIBRIUM, "section_forces", &[object("beam", BEAM), S], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<EquilibriumHandle>()?);
            let index = beam.index_in(handle.scene())?;
            let rest = handle.equilibrium();
            known(call, rest.scene(), index, &beam)?;
            match wanted(call, rest.scene(), index)? {
                Some(at) => Ok(section_forces_map(&rest.section_forces(&at)?).into()),
                None => Ok(along(&rest.section_forces_along(index)?)),
            }
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Array(&ValueKind::Map)]))
        .summary("Returns axial force, shear force and moment of a beam in equilibrium at an \
            undeformed arc length, or along the whole beam.")
        .doc("See section_forces of a simulation for signs and accuracy.")
        .example(
            "scene.hinge(rod.end);\nlet rest = scene.equilibrium();\nlet middle = rest.section_forces(rod, 1);\n\
             check_close(middle.Q, 0, 1e-6);\ncheck_close(middle.M, 9.81 * 2^2 / 8, 0.06);",
        )
        .with_related(&["reaction"]),
        method(SIMULATION, "reaction", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.place_in(&handle)?;
            let given = mean_reactions(call, &handle)?;
            let reaction = handle.simulation().model().reaction(&given, &place);
            reaction.map(force_and_moment).ok_or_else(|| holds_nothing(call, &station))
        })
        .returns(Returns::MAP)
        .summary("Returns the mean reaction of the support at a station over the last step: force, a \
            vector, and moment.")
        .doc(MEAN)
        .example(
            "scene.record(\"hinge1.force\");\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\nlet momentum = sim.history.column(\"momentum_y\");\n\
             let change = (momentum[100] - momentum[99]) / 0.01;\n\
             check_close(sim.reaction(rod.start).force.y - 2 * 9.81, change, 1e-9);",
        )
        .with_related(&["present_reaction", "joint_force", "section_forces", "record"]),
        method(SIMULATION, "joint_force", &[WHICH], |call| {
            let (handle, joint) = (call.receiver::<SimulationHandle>()?, joint_index(call)?);
            let given = mean_reactions(call, &handle)?;
            let simulation = handle.simulation();
            let joint = simulation.model().transmission(simulation.scene(), joint)?;
            Ok(force_and_moment(joint.read(&given)))
        })
        .returns(Returns::MAP)
        .summary("Returns the mean force and moment of a joint on its first station over the last \
            step: force, a vector, and moment.")
        .doc(MEAN)
        .example(
            "scene.record(\"hinge1.fy\");\nlet sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\n\
             let given = sim.joint_force(\"hinge1\").force;\n\
             check(given.y == sim.history.last(\"hinge1.fy\"));",
        )
        .with_related(&["present_joint_force", "reaction", "record"]),
        method(SIMULATION, "present_reaction", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.place_in(&handle)?;
            let reaction = handle.with_simulation_mut(|simulation| {
                let now = simulation.instant()?;
                Ok::<_, SystemError>(simulation.model().reaction(now.reactions(), &place))
            })?;
            reaction.map(force_and_moment).ok_or_else(|| holds_nothing(call, &station))
        })
        .returns(Returns::MAP)
        .summary("Returns the present reaction of the support at a station: force, a vector, and \
            moment.")
        .doc(
            "Computed from the equations of motion, with loads evaluated just after the present \
            time; second order in the step size with every method, like configuration and \
            rates. The mean sum of the forces of loads, gravity and supports over a step is \
            the change of the columns impulse_x and impulse_y divided by the step size.",
        )
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\nlet given = sim.present_reaction(rod.start);\ncheck(norm(given.force) > 1 && given.moment == 0);")
        .with_related(&["reaction", "present_joint_force", "section_forces", "record"]),
        method(SIMULATION, "present_joint_force", &[WHICH], present_joint_force)
            .returns(Returns::MAP)
            .summary("Returns the present force and moment of a joint on its first station: force, a \
                vector, and moment.")
            .doc("Computed from the equations of motion; second order in the step size, as for \
                `present_reaction`. A joint with the ground is a support. The joint is given by the \
                return value of scene.hinge or by its name, the kind and its number. A \
                released joint has zero force.")
            .example("let sim = scene.start(#{ dt: 0.01 });\nlet force = sim.present_joint_force(\"hinge1\").force;\ncheck(force == sim.present_reaction(rod.start).force);")
            .with_related(&["joint_force", "present_reaction"]),
        method(SIMULATION, "present_contact_force", &[object("slider", SLIDER)], |call| {
            let handle = call.receiver::<SimulationHandle>()?;
            let slider = call.get::<SliderHandle>("slider")?.on(&handle)?;
            let now = handle.with_simulation_mut(|simulation| simulation.instant())?;
            Ok(Dynamic::from(now.contact(slider)))
        })
        .returns(Returns::object(VECTOR).unit("force"))
        .summary("Returns the present contact force of a slider on its master.")
        .doc(
            "Computed from the equations of motion, with the order of the motion: second, \
            fourth with fourth_order(). contact_force and the columns NAME.force are means of \
            a step, which belong to its middle and may alternate from step to step. As a \
            column: scene.record(\"NAME.present_force\").",
        )
        .example(
            "let bead = scene.slider(scene.particle([1, 0], 0.5), rod, #{ at: 0.5 });\nlet sim = scene.start(#{ dt: 0.001 });\nsim.run_to(0.1);\n\
             print(sim.present_contact_force(bead));",
        )
        .with_related(&["contact_force", "present_joint_force"]),
        method(SIMULATION, "acceleration", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.place_in(&handle)?;
            let acceleration = handle.with_simulation_mut(|simulation| {
                let now = simulation.instant()?;
                Ok::<_, SystemError>(simulation.model().acceleration(&now, &place))
            })?;
            Ok(Dynamic::from(acceleration))
        })
        .returns(Returns::object(VECTOR).unit("length/time²"))
        .summary("Returns the present acceleration of a station, computed from the equations of \
            motion.")
        .example("let sim = scene.start(#{ dt: 0.01 });\ncheck(norm(sim.acceleration(rod.start)) == 0);\ncheck_close(sim.acceleration(rod.end).y, -9.81, 0.5);")
        .with_related(&["velocity", "spin"]),
        method(SIMULATION, "spin", &[AT], |call| {
            let (handle, station) = (call.receiver::<SimulationHandle>()?, call.get::<StationHandle>("station")?);
            let place = station.place_in(&handle)?;
            if !station.station.turns() {
                let error = format!("{} has no spin, because a particle does not rotate", station.show());
                return Err(call.error(error).hint("read the spin at a station of a beam or a body"));
            }
            Ok(handle.simulation().model().spin(&place).into())
        })
        .returns(Returns::NUMBER.unit("1/time"))
        .summary("Returns the angular velocity of the section at a station, positive \
            counter-clockwise.")
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\ncheck(sim.spin(rod.end) < 0);")
        .with_related(&["angle", "acceleration"]),
        method(SIMULATION, "energy", &[object("beam", BEAM)], |call| {
            let (beam, handle) = (call.get::<BeamHandle>("beam")?, call.receiver::<SimulationHandle>()?);
            let index = beam.index_in(handle.scene())?;
            known(call, handle.simulation().scene(), index, &beam)?;
            let energy = handle.with_simulation_mut(|simulation| simulation.energy_of(index));
            Ok(named_numbers(body_energies(&energy)).into())
        })
        .returns(Returns::MAP.unit("energy"))
        .summary("Returns the energy of a beam, including the masses attached to it, by kind.")
        .doc("The map has energy, kinetic, strain, axial, shear, bending and potential. The sum \
            over all bodies and the energy of springs is the energy of the scene. Without a \
            beam, use sim.energy for the energy of the scene.")
        .example("let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\ncheck_close(sim.energy(rod).energy, sim.energy, 1e-12);")
        .with_related(&["record"]),
    ],
};

const HANGING: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 0.01 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
    scene.hinge(rod.start);\n\
    scene.gravity([0, -9.81]);";

const MEAN: &str = "Means are computed only if one of the columns force, fx, fy, moment of a joint is \
    recorded, as in scene.record(\"hinge1.force\"), and then for all joints and supports; \
    otherwise use the present force. \
    Together with loads, gravity and drives they are the change of the momentum over the step; \
    their moments about a point, with each force at the midpoint of its path, are the change \
    of the angular momentum. This holds to rounding with energy_momentum() and \
    energy_decaying(), and for the momentum also with fourth_order() and trapezoidal(). The \
    means belong to the middle of the step, to second order, and include the impulses of \
    bouncing sliders. Before the first step they are the present forces. Not available with \
    generalized_alpha().";

const AT: Parameter = object("station", STATION);
const WHICH: Parameter = either("joint", &[Kind::Object(JOINT), Kind::Text]);
const S: Parameter = number("s")
    .unit("length")
    .doc("undeformed arc length from the start; default: along the whole beam")
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
        scene.change().record_outside(&column)?;
        scene.store_function(function);
        return Ok(Dynamic::UNIT);
    }
    let recorded = scene.change().record(&column);
    recorded.map_err(|error| {
        let names = scene.scene().borrow().sensor_names();
        let meant = nearest(&column, names.iter().map(String::as_str));
        let error = ScriptError::from(error).at(CallPart::Argument(0));
        match meant {
            Some(meant) => error.hint(format!("did you mean \"{meant}\"?")),
            None => error.hint(format!(
                "or give a function: scene.record(\"{column}\", |q| q.position(rod.end).x)"
            )),
        }
    })?;
    Ok(Dynamic::UNIT)
}

fn present_joint_force(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, joint) = (call.receiver::<SimulationHandle>()?, joint_index(call)?);
    let (now, joint) = handle.with_simulation_mut(|simulation| {
        let joint = simulation.model().transmission(simulation.scene(), joint)?;
        Ok::<_, SystemError>((simulation.instant()?, joint))
    })?;
    Ok(force_and_moment(joint.read(now.reactions())))
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

fn mean_reactions(call: &Call, handle: &SimulationHandle) -> Result<Reactions, ScriptError> {
    handle.simulation().model().mean_reactions().ok_or_else(|| {
        let names = handle.simulation().scene().joint_names();
        let joint = names.first().map_or("hinge1", String::as_str);
        call.error("mean forces of joints and supports were not recorded").hint(format!(
            "write scene.record(\"{joint}.force\") before scene.start(…), or ask for the present \
                 force by present_joint_force or present_reaction"
        ))
    })
}

pub(super) fn holds_nothing(call: &Call, station: &StationHandle) -> ScriptError {
    call.error(format!("nothing holds the scene at {}", station.show()))
        .hint("use a station with scene.clamp(…) or scene.hinge(…) to the ground")
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
        (None, all) => format!("available: {}", all.join(", ")),
    };
    call.error(format!("there is no {what} '{name}'")).hint(hint).at(CallPart::Argument(0))
}

fn known(call: &Call, built: &Scene, index: usize, beam: &BeamHandle) -> Result<(), ScriptError> {
    if index < built.beams.len() {
        return Ok(());
    }
    let error = format!("{} was added after the scene was started", beam.show());
    Err(call.error(error).hint("add everything before scene.start(…), or start the scene again"))
}

fn wanted(call: &Call, scene: &Scene, beam: usize) -> Result<Option<Station>, ScriptError> {
    let Some(station) = call.optional_number("s") else { return Ok(None) };
    let length = scene.beams[beam].axis.length();
    if !is_on_length(station, length) {
        let beam = scene.beams[beam].name.clone();
        let refused = ScriptError::from(SystemError::StationOutside { beam, station, length });
        return Err(refused.at(CallPart::Argument(1)));
    }
    Ok(Some(Station::on_beam(beam, station.clamp(0.0, length))))
}

pub(super) fn force_and_moment((force, moment): (Vec2, f64)) -> Dynamic {
    let map = [("force", Dynamic::from(force)), ("moment", moment.into())];
    map.into_iter().map(|(name, value)| (name.into(), value)).collect::<Map>().into()
}

fn section_forces_map(forces: &SectionForces) -> Map {
    named_numbers(section_values(forces))
}

fn named_numbers(numbers: impl Iterator<Item = (&'static str, f64)>) -> Map {
    numbers.map(|(name, value)| (name.into(), value.into())).collect()
}

fn along(samples: &[SectionSample]) -> Dynamic {
    let row = |sample: &SectionSample| {
        let mut row = section_forces_map(&sample.forces);
        row.insert("s".into(), sample.arc_length.into());
        Dynamic::from(row)
    };
    samples.iter().map(row).collect::<Array>().into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::RECORDABLE;

    #[test]
    fn all_quantities_that_can_be_recorded_are_documented() {
        let words: Vec<&str> = TABLE.doc.split([' ', ',', '.', ':', ';']).collect();
        for (object, quantities) in RECORDABLE {
            let missing = quantities.iter().find(|quantity| !words.contains(&quantity.name));
            assert!(missing.is_none(), "{missing:?} of {object}");
        }
    }
}
