//! Unused features have no cost: equal matrices, work counts and results, bit for bit.
#![allow(clippy::unwrap_used)]

use crate::common::{scenes, settings, simulate};
use withy::analysis::FEATURES;
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::{Constraints, INTEGRATORS, Method};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{NoMonitor, Recording, Simulation};
use withy::system::{Scene, StartMotion};

const DT: f64 = 0.05;
const END: f64 = 1.0;

fn spinning() -> Scene {
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let mut scene = scenes::free_beam(&mesh, scenes::spaghetti_section(1e4, 100.0));
    scene.beams[0].motion =
        StartMotion { spin: 1.0, centre: Some(Vec2::zeros()), ..StartMotion::default() };
    scene
}

/// Size and bandwidth of the matrix, recorded data, and work counts.
fn shape(simulation: &Simulation) -> ([usize; 5], [usize; 4]) {
    let counts = simulation.counts();
    let matrix = [
        simulation.unknowns(),
        simulation.half_bandwidth(),
        simulation.model().constraint_shape().width,
        simulation.history().columns().count(),
        simulation.stored_snapshots().1,
    ];
    let work = [counts.steps, counts.newton_iterations, counts.factorisations, counts.retries];
    (matrix, work)
}

fn state(simulation: &Simulation) -> String {
    format!("{:?}", simulation.model().state())
}

#[test]
fn features_change_only_the_related_results() {
    let plain = simulate(spinning(), Method::default(), DT, END);
    for feature in FEATURES {
        let mut scene = spinning();
        (feature.add)(&mut scene).unwrap();
        let with = simulate(scene, Method::default(), DT, END);
        let ([unknowns, band, border, columns, snapshots], _) = shape(&with);
        let ([plain_unknowns, plain_band, ..], _) = shape(&plain);
        let (saved, extra) = match feature.name {
            "hinge" => (2, 0),
            "slider" => (0, 5),
            _ => (0, 0),
        };
        match feature.name {
            "slider" => assert!(unknowns > plain_unknowns && border > 0),
            name => assert_eq!(unknowns, plain_unknowns - saved, "{name}"),
        }
        assert_eq!((band, snapshots), (plain_band, 0), "{}", feature.name);
        assert_eq!(columns, plain.history().columns().count() + extra, "{}", feature.name);
        assert_eq!(border > 0, feature.name == "slider", "{}", feature.name);
    }
}

#[test]
fn declarations_without_effect_change_no_bit() {
    for entry in INTEGRATORS {
        let plain = simulate(spinning(), entry.method, DT, END);
        let mut scene = spinning();
        scene.gravity = Vec2::zeros();
        let station = scene.station(0, 5.0).unwrap();
        let same = simulate(scene.clone(), entry.method, DT, END);
        assert_eq!(shape(&same), shape(&plain), "{}", entry.name);
        assert_eq!(
            format!("{:?}", same.history().samples()),
            format!("{:?}", plain.history().samples()),
            "{}",
            entry.name
        );
        let force = LoadKind::Force { station, force: Vec2::new(1.0, 0.0), frame: LoadFrame::Dead };
        scene.add_load(force, Schedule::constant(0.0).unwrap());
        let unloaded = simulate(scene, entry.method, DT, END);
        assert_eq!(shape(&unloaded), shape(&plain), "{}", entry.name);
    }
}

#[test]
fn recording_and_snapshots_change_no_bit_of_the_motion() {
    for entry in INTEGRATORS {
        let plain = simulate(spinning(), entry.method, DT, END);
        let mut quiet = Simulation::start(spinning(), settings(entry.method, DT)).unwrap();
        quiet.record(Recording::Nothing);
        quiet.run_to(END, &mut NoMonitor).unwrap();
        let mut kept = Simulation::start(spinning(), settings(entry.method, DT)).unwrap();
        kept.enable_snapshots(10_000_000);
        kept.run_to(END, &mut NoMonitor).unwrap();
        assert_eq!((state(&quiet), state(&kept)), (state(&plain), state(&plain)), "{}", entry.name);
        assert_eq!(quiet.history().samples().len(), 2);
        assert_eq!(quiet.history().samples().last(), plain.history().samples().last());
    }
}
