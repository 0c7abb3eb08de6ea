//! Brakes and clutches: closed forms of slipping and holding, balances, and refused scenes.
#![allow(clippy::unwrap_used)]

use crate::common::{at, run, settings, simulate, step};
use withy::beams::Station;
use withy::integrators::Method;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadKind, Schedule};
use withy::simulation::{Simulation, SimulationError};
use withy::statics::{Equilibrium, Loading, StaticsError};
use withy::system::{
    Anchor, BrakeLaw, DampingLaw, Origin, RigidBodyDefinition, Scene, Spring, SpringKind,
    StartMotion,
};

const METHOD: Method = Method::EnergyMomentum;

fn wheel(scene: &mut Scene, name: &str, inertia: f64, spin: f64) -> Station {
    let motion = StartMotion { velocity: at(0.0, 0.0), spin, centre: None };
    let wheel = RigidBodyDefinition {
        name: name.into(),
        position: at(0.0, 0.0),
        angle: 0.0,
        points: Vec::new(),
        outline: Vec::new(),
        motion,
    };
    let body = scene.add_rigid_body(wheel, 1.0, inertia).unwrap();
    let centre = Station::on_rigid_body(body, 0);
    scene.join(JointKind::Hinge, centre, Partner::Ground).unwrap();
    centre
}

fn add_brake(scene: &mut Scene, sections: [Anchor; 2], limit: Schedule, deflection: f64) {
    let kind = SpringKind::Brake { sections, law: BrakeLaw { limit, deflection } };
    let (law, origin, damping) = (None, Origin::Zero, DampingLaw::default());
    let brake = Spring { name: "brake".into(), kind, law, origin, damping, rest: None };
    scene.add_spring(brake).unwrap();
}

/// Wheel with the inertia 0.5 and the angular velocity 10, with a brake to the ground.
fn braked(limit: Schedule, deflection: f64) -> Scene {
    let mut scene = Scene::new("braked");
    let centre = wheel(&mut scene, "wheel", 0.5, 10.0);
    let ground = Anchor::Ground(at(0.0, 0.0));
    add_brake(&mut scene, [ground, Anchor::Station(centre)], limit, deflection);
    scene
}

/// Two wheels with the given inertias and the angular velocities 10 and -2, connected by a clutch.
pub fn clutch(inertias: [f64; 2], limit: f64, deflection: f64) -> Scene {
    let mut scene = Scene::new("clutch");
    let sections = [("a", inertias[0], 10.0), ("b", inertias[1], -2.0)]
        .map(|(name, inertia, spin)| Anchor::Station(wheel(&mut scene, name, inertia, spin)));
    add_brake(&mut scene, sections, Schedule::constant(limit).unwrap(), deflection);
    scene
}

fn last(simulation: &Simulation, column: &str) -> f64 {
    *simulation.history().column(column).unwrap().last().unwrap()
}

fn assert_balanced(simulation: &Simulation) {
    let column = |name: &str| simulation.history().column(name).unwrap();
    let (energy, work, lost) = (column("energy"), column("work"), column("dissipated"));
    for at in 0..energy.len() {
        let balance = energy[at] - work[at] + lost[at] - energy[0];
        assert!(balance.abs() <= 1e-11 * energy[0].max(1e-3), "{balance:e} in row {at}");
    }
}

/// The wheel stops after `J ω/M = 2.5` and turns by `J ω²/(2 M) = 12.5`, and its whole energy of 25 is dissipated.
#[test]
fn a_braked_wheel_stops_at_the_time_and_angle_of_the_closed_form() {
    for dt in [0.1, 0.04, 0.01] {
        let limit = Schedule::constant(2.0).unwrap();
        let simulation = simulate(braked(limit, 1e-6), METHOD, dt, 5.0);
        assert_balanced(&simulation);
        let error = last(&simulation, "brake.angle") - 12.5;
        // The error of the angular velocity in the step of the stop is at most M dt/J.
        assert!(error.abs() < 2.0 * dt * dt + 2e-6, "{dt}: {error:e}");
        assert!((last(&simulation, "dissipated.brake") - 25.0).abs() < 20.0 * dt * dt, "{dt}");
    }
}

/// Both wheels reach the common speed `(J₁ ω₁ + J₂ ω₂)/(J₁ + J₂) = 1`, and the energy `½ J₁ J₂/(J₁ + J₂) (ω₁ - ω₂)² = 27` is dissipated.
#[test]
fn a_clutch_keeps_the_angular_momentum() {
    let simulation = simulate(clutch([0.5, 1.5], 3.0, 1e-5), METHOD, 0.01, 4.0);
    assert_balanced(&simulation);
    let momentum = simulation.history().column("angular_momentum").unwrap();
    assert!(momentum.iter().all(|one| (one - momentum[0]).abs() < 1e-13), "{momentum:?}");
    assert!((last(&simulation, "kinetic") - 1.0).abs() < 1e-9);
    assert!((last(&simulation, "dissipated.brake") - 27.0).abs() < 1e-3);
}

/// Under a moment of half the limit, the brake deflects by half of its deflection and does not creep in 2000 steps.
#[test]
fn a_held_brake_does_not_creep() {
    let deflection = 1e-3;
    let mut scene = Scene::new("held");
    let centre = wheel(&mut scene, "wheel", 0.5, 0.0);
    let ground = Anchor::Ground(at(0.0, 0.0));
    let limit = Schedule::constant(4.0).unwrap();
    add_brake(&mut scene, [ground, Anchor::Station(centre)], limit, deflection);
    let moment = LoadKind::Moment { station: centre, moment: 2.0 };
    scene.add_load(moment, Schedule::constant(1.0).unwrap());
    let mut simulation = Simulation::start(scene, settings(METHOD, 0.02)).unwrap();
    run(&mut simulation, 10.0).unwrap();
    let before = last(&simulation, "brake.angle");
    run(&mut simulation, 50.0).unwrap();
    assert!((before - 0.5 * deflection).abs() < 1e-12, "{before:e}");
    assert!((last(&simulation, "brake.angle") - before).abs() < 1e-14);
    assert!((last(&simulation, "brake.force") - 2.0).abs() < 1e-9);
    assert_balanced(&simulation);
}

/// The limit rises from zero at t = 1 to 8 at t = 2. It removes the angular momentum 4 up to t = 2, and the rest of 1 with the rate 8.
#[test]
fn a_rising_limit_stops_the_wheel() {
    let rising = Schedule::table(vec![(0.0, 0.0), (1.0, 0.0), (2.0, 8.0), (6.0, 8.0)]).unwrap();
    let simulation = simulate(braked(rising, 1e-5), METHOD, 0.01, 6.0);
    assert_balanced(&simulation);
    let column = |name: &str| simulation.history().column(name).unwrap();
    let (times, angles) = (column("t"), column("brake.angle"));
    let end = last(&simulation, "brake.angle");
    let stop = angles.iter().position(|angle| (angle - end).abs() < 1e-3).unwrap();
    assert!((times[stop] - 2.125).abs() < 0.02, "{}", times[stop]);
}

#[test]
fn going_back_keeps_every_bit() {
    let ramp = Schedule::ramp(0.0, 1.0).unwrap();
    let mut simulation = Simulation::start(braked(ramp, 1e-4), settings(METHOD, 0.03)).unwrap();
    simulation.enable_snapshots(1 << 24);
    run(&mut simulation, 3.0).unwrap();
    let whole = last(&simulation, "brake.angle").to_bits();
    simulation.rewind(0.5).unwrap();
    run(&mut simulation, 3.0).unwrap();
    assert_eq!(last(&simulation, "brake.angle").to_bits(), whole);
}

#[test]
fn unsupported_scenes_and_negative_limits_are_rejected() {
    let scene = braked(Schedule::constant(2.0).unwrap(), 1e-4);
    let started = Simulation::start(scene.clone(), settings(Method::FourthOrder, 0.1));
    assert!(matches!(started, Err(SimulationError::FrictionMethod { .. })));
    let rest = Equilibrium::dry_run(scene, Loading::default());
    assert!(matches!(rest, Err(StaticsError::Brake { .. })));
    let falling = Schedule::table(vec![(0.0, 1.0), (2.0, -1.0)]).unwrap();
    let mut simulation = Simulation::start(braked(falling, 1e-4), settings(METHOD, 0.1)).unwrap();
    let error = (0..20).find_map(|_| step(&mut simulation).err()).unwrap();
    assert!(error.to_string().contains("must be zero or positive"), "{error}");
    assert!((simulation.time() - 1.0).abs() < 1e-9, "{}", simulation.time());
}
