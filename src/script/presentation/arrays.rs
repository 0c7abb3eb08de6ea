//! Data of simulations as arrays: control points over time, and columns of the history.

use crate::output::{DataColumn, DataTable, DataValues, NpzArchive, NpzArray};
use crate::simulation::{History, Simulation};

pub fn archive(simulation: &Simulation) -> NpzArchive {
    let (scene, trajectory) = (simulation.scene(), simulation.trajectory());
    let times = trajectory.times();
    let mut arrays = vec![NpzArray::row("t", times.to_vec())];
    let beams = scene.beams.iter().map(|beam| (&beam.name, true));
    let particles = scene.particles.iter().map(|particle| (&particle.name, false));
    let mut from = 0;
    let bodies = scene.rigid_bodies.iter().map(|body| (&body.name, true));
    for ((name, is_beam), points) in
        beams.chain(particles).chain(bodies).zip(simulation.model().control_points())
    {
        let to = from + 2 * points.len();
        let of_body = |index: usize| trajectory.configuration(index)[from..to].to_vec();
        let points = if is_beam { Some(points.len()) } else { None };
        arrays.push(NpzArray {
            name: format!("points.{name}"),
            shape: [Some(times.len()), points, Some(2)].into_iter().flatten().collect(),
            values: (0..times.len()).flat_map(of_body).collect(),
        });
        from = to;
    }
    let history = simulation.history();
    arrays.extend(history.columns().map(|(name, _)| {
        NpzArray::row(format!("history.{name}"), history.column(name).unwrap_or_default())
    }));
    NpzArchive { arrays }
}

pub fn table(history: &History) -> DataTable {
    let column = |(name, dimension): (&str, &str)| {
        let values = history.column(name).unwrap_or_default();
        DataColumn {
            name: name.to_owned(),
            dimension: dimension.to_owned(),
            values: DataValues::Numbers(values.into_iter().map(Some).collect()),
        }
    };
    DataTable { columns: history.columns().map(column).collect() }
}
