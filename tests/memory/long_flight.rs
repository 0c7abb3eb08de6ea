//! A million steps of free flight: no invariant drifts, and the memory does not grow.
#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;

use crate::common::{run, scenes, settings};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::loads::{LoadKind, Schedule};
use withy::simulation::{Invariant, Recording, Simulation};
use withy::system::Scene;

const DT: f64 = 0.05;
const STEPS: usize = 1_000_000;
/// End of the loads [time].
const REST: f64 = 2.5;

/// Free beam that two moments bend and rotate.
fn thrown() -> Scene {
    let mesh = Mesh::bspline(2, 3, 2).unwrap();
    let mut scene = scenes::free_beam(&mesh, scenes::spaghetti_section(1e4, 100.0));
    let ends = [scene.station(0, 0.0).unwrap(), scenes::end_of(&mut scene, 0)];
    for (station, moment) in ends.into_iter().zip([-20.0, 60.0]) {
        let schedule = Schedule::hold_for(REST).unwrap();
        scene.add_load(LoadKind::Moment { station, moment }, schedule);
    }
    scene
}

fn resident() -> usize {
    memory_stats::memory_stats().unwrap().physical_mem
}

#[test]
fn million_steps_conserve_all_invariants_in_constant_memory() {
    let mut simulation = Simulation::start(thrown(), settings(Method::EnergyMomentum, DT)).unwrap();
    simulation.record(Recording::Every(NonZeroUsize::new(10_000).unwrap()));
    let end = |steps: usize| REST + steps as f64 * DT;
    run(&mut simulation, end(STEPS / 10)).unwrap();
    let before = resident();
    run(&mut simulation, end(STEPS)).unwrap();
    let grown = resident().saturating_sub(before);
    let rows = simulation.history().samples().len();
    assert!(rows < 110, "{rows} rows");
    assert!(grown < 1_000_000, "the memory has grown by {grown} bytes");
    let counts = simulation.counts();
    assert!(counts.steps >= STEPS && counts.retries == 0, "{counts:?}");
    let flight = simulation.history().between(REST, f64::INFINITY);
    for (name, invariant) in Invariant::ALL {
        let drift = flight.drift(invariant);
        println!("{name}: {drift:.1e}");
        assert!(drift <= 1e-9, "{name} drifts by {drift:.1e}");
    }
    let strain = flight.column("strain").unwrap();
    let vibrates = strain.iter().fold(0.0, |most: f64, energy| most.max(*energy));
    assert!(vibrates > 1e-3 * flight.column("energy").unwrap()[0], "it must vibrate");
}
