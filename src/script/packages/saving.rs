//! Saving and loading of simulations, access to the last used simulation, and search for objects by name.

use rhai::{Array, Dynamic};

use super::bodies::BODY;
use super::equilibria::EQUILIBRIUM;
use super::scenes::BEAM;
use super::scenes::SCENE;
use super::scenes::STATION;
use super::simulations::{SIMULATION, SPINNING};
use super::sliding::SLIDER;
use super::sliding::SliderHandle;
use super::tracks::TRACK;
use crate::beams::Station;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, array, text};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, method, property};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::notes::Notes;
use crate::script::handles::rigid_body::RigidBodyHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::{RunStart, SimulationHandle};
use crate::script::handles::station::StationHandle;
use crate::script::handles::track::TrackHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::suggest::nearest;
use crate::simulation::Simulation;
use crate::system::Scene;

pub const TABLE: BindingTable = BindingTable {
    name: "saving",
    doc: "Saving and loading of simulations. A loaded simulation, also in another script, \
        continues bit for bit like the saved one. Objects of a loaded scene are found by name.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(SIMULATION, "save", &[text("file")], save)
            .summary("Writes the simulation to a file in the output folder, completely or not at \
                all.")
            .doc(
                "The file contains the scene, the state, the history and the configurations, \
                with versions and a checksum. It does not contain earlier states to go back \
                to, nor functions registered with sim.at. A scene with a schedule that is a \
                function cannot be saved. Equal runs write equal files.",
            )
            .example("sim.run_to(1);\nsim.save(\"spinning.withy\");\nlet again = load_simulation(\"spinning.withy\");\ncheck(again.t == 1 && again.energy == sim.energy);")
            .with_related(&["load_simulation", "fork"]),
        function("load_simulation", &[text("file")], load)
            .returns(Returns::object(SIMULATION))
            .summary("Loads a simulation from a file written by sim.save, in the output folder or \
                beside the script.")
            .doc("Files that are truncated, damaged, of a later version of withy or of another \
                kind are refused with an error that gives the reason.")
            .example("sim.run_to(1);\nsim.save(\"half.withy\");\nlet on = load_simulation(\"half.withy\");\non.run_to(2);\nprint(on.position(on.scene.beam_named(\"rod\").end));")
            .with_related(&["save", "scene", "beam_named"]),
        function("simulations_among", &[array("values")], |call| Ok(simulations_among(&call.array("values")?).into()))
            .returns(Returns::array_of(&ValueKind::Object(SIMULATION)))
            .summary("Returns each simulation in an array of any values, including nested arrays, \
                once.")
            .doc("`withy view` uses it to find the simulations in the variables of a script.")
            .example("let other = sim.fork();\ncheck(simulations_among([1, sim, [other, sim]]).len() == 2);")
            .with_related(&["latest_simulation", "write_viewer"]),
        function("latest_simulation", &[], |call| {
            call.context().latest_simulation().ok_or_else(|| {
                call.error("there is no simulation yet").hint("start one: let sim = scene.start(#{ dt: 0.01 });")
            })
        })
        .returns(Returns::object(SIMULATION))
        .summary("Returns the simulation that was most recently started, loaded, forked, stepped or \
            taken back.")
        .example("check(latest_simulation().name == sim.name);")
        .with_related(&["start", "load_simulation"]),
        property(SIMULATION, "scene", |call| Ok(Dynamic::from(call.receiver::<SimulationHandle>()?.scene().clone())))
            .returns(Returns::object(SCENE))
            .summary("Scene of the simulation; for a loaded simulation, the scene saved with it.")
            .example("check(sim.scene.name == \"example\");")
            .with_related(&["beam_named", "particle_named", "body_named", "slider_named"]),
        property(EQUILIBRIUM, "scene", |call| Ok(Dynamic::from(call.receiver::<EquilibriumHandle>()?.scene().clone())))
            .returns(Returns::object(SCENE))
            .summary("Scene of the equilibrium.")
            .example("let still = new_scene(\"still\");\nlet bar = still.beam(#{ axis: line([0, 0], [1, 0]), basis: bspline(4), section: s });\nstill.clamp(bar.start);\nstill.force(bar.end, [0, -1]);\ncheck(still.equilibrium().scene.name == \"still\");")
            .with_related(&["station_named"]),
        method(SCENE, "beam_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let index = find(call, "beam", |held| held.beams.iter().map(|beam| &beam.name).collect())?;
            Ok(Dynamic::from(BeamHandle { scene, index }))
        })
        .returns(Returns::object(BEAM))
        .summary("Returns the beam with a name.")
        .example("check(scene.beam_named(\"rod\").length == 2);")
        .with_related(&["beam", "scene"]),
        method(SCENE, "particle_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let index = find(call, "particle", |held| held.particles.iter().map(|particle| &particle.name).collect())?;
            Ok(Dynamic::from(StationHandle { scene, station: Station::on_particle(index) }))
        })
        .returns(Returns::object(STATION))
        .summary("Returns the particle with a name.")
        .example("scene.particle([0, 3], 0.5, #{ name: \"stone\" });\nprint(scene.particle_named(\"stone\"));")
        .with_related(&["particle", "scene"]),
        method(SCENE, "station_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let name = call.text("name")?;
            let station = scene.scene().borrow().station_named(&name);
            let station = station.ok_or_else(|| {
                let scene = scene.scene().borrow();
                nothing_named(call, &name, &scene, "station", &scene.station_names())
            })?;
            Ok(Dynamic::from(StationHandle { scene, station }))
        })
        .returns(Returns::object(STATION))
        .summary("Returns the station with a name as in sensors: a place on a beam, such as \
            \"rod.end\" or \"rod[0.5]\", a particle, a rigid body, or a point of it.")
        .example("let tip = scene.station_named(\"rod.end\");\ncheck(sim.position(tip) == sim.position(rod.end));")
        .with_related(&["record", "beam_named", "scene"]),
        method(SCENE, "body_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let index = find(call, "body", |held| held.rigid_bodies.iter().map(|body| &body.name).collect())?;
            Ok(Dynamic::from(RigidBodyHandle { scene, index }))
        })
        .returns(Returns::object(BODY))
        .summary("Returns the rigid body with a name.")
        .example("scene.body(#{ name: \"hub\", at: [0, 1], mass: 1, inertia: 1 });\nprint(scene.body_named(\"hub\"));")
        .with_related(&["body", "scene"]),
        method(SCENE, "slider_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let index = find(call, "slider", |held| held.sliders.iter().map(|slider| &slider.name).collect())?;
            Ok(Dynamic::from(SliderHandle { scene, index }))
        })
        .returns(Returns::object(SLIDER))
        .summary("Returns the slider with a name.")
        .example("scene.slider(scene.particle([1, 0], 1), rod, #{ name: \"ring\" });\nprint(scene.slider_named(\"ring\"));")
        .with_related(&["slider", "scene"]),
        method(SCENE, "track_named", &[NAME], |call| {
            let scene = call.receiver::<SceneHandle>()?;
            let index = find(call, "track", |held| held.tracks.iter().map(|track| &track.name).collect())?;
            Ok(Dynamic::from(TrackHandle { scene, index }))
        })
        .returns(Returns::object(TRACK))
        .summary("Returns the track with a name.")
        .example("scene.track([rod], #{ name: \"course\" });\nprint(scene.track_named(\"course\"));")
        .with_related(&["track", "scene"]),
    ],
};

const NAME: Parameter = text("name");

fn simulations_among(values: &Array) -> Array {
    let mut found: Vec<SimulationHandle> = Vec::new();
    let mut left: Vec<Dynamic> = values.iter().rev().cloned().collect();
    while let Some(value) = left.pop() {
        if let Some(array) = value.read_lock::<Array>() {
            left.extend(array.iter().rev().cloned());
        } else if let Some(simulation) = value.clone().try_cast::<SimulationHandle>()
            && !found.iter().any(|other| other.is_same(&simulation))
        {
            found.push(simulation);
        }
    }
    found.into_iter().map(Dynamic::from).collect()
}

fn save(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let file = handle.simulation().to_bytes(handle.name());
    let file =
        file.map_err(|error| call.error(format!("'{}': {error}", handle.name())).advised(&error))?;
    let written = call.context().write_to_read(&call.text("file")?, file);
    written.map_err(|error| error.at(CallPart::Argument(0)))?;
    let waiting = handle.events_waiting();
    if waiting > 0 {
        call.context().print_message(&format!(
            "note: simulation '{}' was saved without its pending functions of sim.at \
            ({waiting}); register them again after load_simulation",
            handle.name()
        ));
    }
    if handle.simulation().parameters().next().is_some() {
        call.context().print_message(&format!(
            "note: simulation '{}' was saved without the derivatives by the parameters of its \
            scene; load_simulation returns a simulation without derivatives",
            handle.name()
        ));
    }
    Ok(Dynamic::UNIT)
}

fn load(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let name = call.text("file")?;
    let file = call.context().read_file(&name).map_err(|error| error.at(CallPart::Argument(0)))?;
    let loaded = Simulation::from_bytes(&file);
    let (name, mut simulation) = loaded.map_err(|error| {
        let refused = call.error(format!("cannot load \"{name}\": {error}"));
        refused.advised(&error).at(CallPart::Argument(0))
    })?;
    simulation.enable_snapshots(call.context().snapshots());
    let scene = SceneHandle::new(simulation.scene().clone());
    Ok(Dynamic::from(SimulationHandle::new(
        simulation,
        scene,
        name,
        Notes::default(),
        RunStart::Loaded,
        call.context(),
    )))
}

fn find(call: &Call, kind: &str, names: fn(&Scene) -> Vec<&String>) -> Result<usize, ScriptError> {
    let name = call.text("name")?;
    let handle = call.receiver::<SceneHandle>()?;
    let scene = handle.scene().borrow();
    let names = names(&scene);
    let found = names.iter().position(|other| **other == name.as_str());
    found.ok_or_else(|| nothing_named(call, &name, &scene, kind, &names))
}

fn nothing_named(
    call: &Call,
    name: &str,
    scene: &Scene,
    kind: &str,
    names: &[impl AsRef<str>],
) -> ScriptError {
    let meant = nearest(name, names.iter().map(AsRef::as_ref));
    let suggestion = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{}\"", name.as_ref())).collect();
    let known = match quoted.as_slice() {
        [] => format!("the scene has no {kind}s"),
        quoted => format!("its {kind}s: {}", quoted.join(", ")),
    };
    call.error(format!("the scene '{}' has no {kind} \"{name}\"", scene.name))
        .hint(format!("{suggestion}{known}"))
        .at(CallPart::Argument(0))
}
