//! Histories and configurations as CSV tables.

use rhai::Dynamic;

use super::files::write_csv;
use super::subjects::{histories, simulations};
use crate::output::CsvTable;
use crate::script::bindings::call::Call;
use crate::script::handles::report::history_table;
use crate::script::messages::error::ScriptError;

pub fn write_history(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let [of] =
        histories(call)?.try_into().map_err(|_| call.error("takes one simulation or history"))?;
    let table = of.read(|history| history_table(of.of.name(), history));
    write_csv(call, table)
}

pub fn write_states(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let [of] = simulations(call)?.try_into().map_err(|_| call.error("takes one simulation"))?;
    let simulation = of.simulation();
    let trajectory = simulation.trajectory();
    let scene = simulation.scene();
    let of_beams =
        scene.beams.iter().zip(simulation.model().control_points()).flat_map(|(beam, points)| {
            (0..points.len()).flat_map(move |point| {
                ["x", "y"].map(|axis| format!("{} {axis}{point} [length]", beam.name))
            })
        });
    let of_particles = scene
        .particles
        .iter()
        .flat_map(|particle| ["x", "y"].map(|axis| format!("{} {axis} [length]", particle.name)));
    let of_bodies = scene.rigid_bodies.iter().flat_map(|body| {
        let points = body.points.iter().map(|(point, _)| format!("{}.{point}", body.name));
        let places = std::iter::once(body.name.clone()).chain(points);
        places.flat_map(|place| ["x", "y"].map(|axis| format!("{place} {axis} [length]")))
    });
    let names = of_beams.chain(of_particles).chain(of_bodies);
    let comment = match scene.rigid_bodies.is_empty() {
        true => "control points (nodes) of all beams, and particles",
        false => "control points (nodes) of all beams, particles, and bodies with their points",
    };
    let table = CsvTable::new()
        .comment(format!("simulation: {}; {comment}", of.name()))
        .column("t [time]", trajectory.times().to_vec());
    let table = names.enumerate().fold(table, |table, (index, name)| {
        let values =
            (0..trajectory.times().len()).map(|row| trajectory.configuration(row)[index]).collect();
        table.column(name, values)
    });
    write_csv(call, table)
}
