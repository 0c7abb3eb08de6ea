//! Time of a step with many springs and with many rigid bodies, in microseconds per object. It should not depend on the number of objects.
//!
//! `cargo bench --bench machines` prints the table of docs/studies.md.
#![allow(clippy::unwrap_used)]

use std::time::{Duration, Instant};

use withy::beams::Station;
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{JointKind, Partner};
use withy::newton::Tolerance;
use withy::simulation::{NoMonitor, Simulation, SimulationSettings};
use withy::system::{
    Anchor, Origin, ParticleDefinition, RigidBodyDefinition, Scene, Spring, SpringKind, SpringLaw,
    StartMotion,
};

/// Approximate duration of each measurement.
const TIME_LIMIT: Duration = Duration::from_millis(600);
const DT: f64 = 0.01;
/// Number of steps of a run. Runs are repeated from the start.
const RUN: u32 = 50;

/// Falling row of particles with a spring between neighbours.
fn springs(count: usize) -> Scene {
    let mut scene = Scene::new("many springs");
    let mut before = None;
    for number in 0..=count {
        let name = format!("bead{number}");
        let position = Vec2::new(number as f64, 0.1 * (number % 2) as f64);
        let bead = scene.add_particle(ParticleDefinition { name, position }, 1.0).unwrap();
        if let Some(before) = before.replace(bead) {
            let kind = SpringKind::Length([before, bead].map(Anchor::Station).to_vec());
            let law = Some(SpringLaw::Linear { stiffness: 100.0, natural: 1.0 });
            let (name, damping) = (scene.free_name("spring"), 0.0.into());
            scene
                .add_spring(Spring { name, kind, law, origin: Origin::Zero, damping, rest: None })
                .unwrap();
        }
    }
    scene.gravity = Vec2::new(0.0, -1.0);
    scene
}

/// Chain of rigid bodies with a hinge between neighbours. It is hinged at one end and swings down.
fn bodies(count: usize) -> Scene {
    let mut scene = Scene::new("many bodies");
    let mut before = Partner::Ground;
    for number in 0..count {
        let body = RigidBodyDefinition {
            name: format!("body{number}"),
            position: Vec2::new(number as f64 + 0.5, 0.0),
            angle: 0.0,
            outline: Vec::new(),
            points: vec![
                ("left".to_owned(), Vec2::new(-0.5, 0.0)),
                ("right".to_owned(), Vec2::new(0.5, 0.0)),
            ],
            motion: StartMotion::default(),
        };
        let body = scene.add_rigid_body(body, 1.0, 0.1).unwrap();
        scene.join(JointKind::Hinge, Station::on_rigid_body(body, 1), before).unwrap();
        before = Partner::Station(Station::on_rigid_body(body, 2));
    }
    scene.gravity = Vec2::new(0.0, -9.81);
    scene
}

/// Duration of a step: smallest mean over a run.
fn step(scene: &Scene) -> Duration {
    let settings = || SimulationSettings {
        method: Method::EnergyMomentum,
        dt: DT.into(),
        tolerance: Tolerance::default(),
    };
    let (start, mut least) = (Instant::now(), Duration::MAX);
    while start.elapsed() < TIME_LIMIT {
        let mut simulation = Simulation::start(scene.clone(), settings()).unwrap();
        let begun = Instant::now();
        simulation.run_to(f64::from(RUN) * DT, &mut NoMonitor).unwrap();
        least = least.min(begun.elapsed() / RUN);
    }
    least
}

fn main() {
    println!("{:>8} {:>8} {:>12} {:>12}", "", "count", "step [µs]", "each [µs]");
    let row = |what: &str, count: usize, scene: &Scene| {
        let time = step(scene).as_secs_f64() * 1e6;
        println!("{what:>8} {count:>8} {time:>12.1} {:>12.2}", time / count as f64);
    };
    for count in [10, 100, 1000] {
        row("springs", count, &springs(count));
    }
    for count in [10, 100, 1000] {
        row("bodies", count, &bodies(count));
    }
}
