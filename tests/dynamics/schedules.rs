//! Loads and speeds that change within a step: exact impulses and positions for built-in schedules, and warnings about functions that are not resolved.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::rc::Rc;

use crate::common::scenes::drive;
use crate::common::{at, simulate};
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::Component;
use withy::loads::{LoadFrame, LoadKind, Operation, PrescribedMotion, Schedule};
use withy::simulation::{NoMonitor, Simulation, Warning};
use withy::system::{ParticleDefinition, Scene};

const DT: f64 = 0.1;

fn particle() -> (Scene, withy::beams::Station) {
    let mut scene = Scene::new("particle");
    let definition = ParticleDefinition { name: "bead".to_owned(), position: at(0.0, 0.0) };
    let station = scene.add_particle(definition, 1.0).unwrap();
    (scene, station)
}

/// Free particle of mass 1 with a schedule as its force.
fn pushed(schedule: Schedule) -> Scene {
    let (mut scene, station) = particle();
    let force = at(1.0, 0.0);
    scene.add_load(LoadKind::Force { station, force, frame: LoadFrame::Dead }, schedule);
    scene
}

/// Particle with a schedule as its prescribed speed.
fn moved(schedule: Schedule) -> Scene {
    let (mut scene, station) = particle();
    drive(&mut scene, station, &[(Component::X, PrescribedMotion::Rate(schedule))]);
    scene
}

fn function(of: impl Fn(f64) -> f64 + 'static) -> Schedule {
    Schedule::Function { function: Rc::new(move |t: f64| Ok(of(t))), breaks: Vec::new() }
}

fn place(simulation: &Simulation) -> f64 {
    simulation.model().control_points().next().unwrap()[0].x
}

fn product(a: Schedule, b: Schedule) -> Schedule {
    Schedule::combined(Operation::Product, a, b).unwrap()
}

/// Methods for which the impulse of loads is exact.
fn methods() -> impl Iterator<Item = Method> {
    INTEGRATORS.iter().filter(|entry| entry.claims.momentum).map(|entry| entry.method)
}

#[test]
fn built_in_loads_have_their_exact_impulse_at_any_step_size() {
    let pulse = |duration| Schedule::smooth_pulse(duration).unwrap();
    let sine = |rate| Schedule::sine(1.0, rate, 0.4).unwrap();
    let ramp = Schedule::ramp(0.0, 2.0).unwrap();
    // ∫ t/2 sin(ωt) dt over an integer number of periods up to 1 is -1/2ω.
    let rate = 2.0 * TAU / DT;
    let swell = product(ramp, Schedule::sine(3.0, rate, 0.0).unwrap());
    // (16/5)² times the mean of sin¹² over a period, 231/1024.
    let square = product(pulse(0.05), pulse(0.05));
    let cases = [
        (pulse(0.01), 0.01),
        (pulse(0.05), 0.05),
        (pulse(0.15), 0.15),
        (sine(2.0 * TAU / DT), 0.0),
        (sine(3.0 * TAU / DT), 0.0),
        (swell, -1.5 / rate),
        (square, 0.05 * 3.2 * 3.2 * 231.0 / 1024.0),
    ];
    for (schedule, impulse) in cases {
        for method in methods() {
            let simulation = simulate(pushed(schedule.clone()), method, DT, 1.0);
            let last = simulation.history().samples().last().unwrap().measures;
            let name = (schedule.describe(), method.entry().name);
            let missed = (last.momentum.x - impulse).abs();
            println!("{name:?}: {missed:.1e}");
            assert!(missed < 1e-14, "{name:?}: {} and {impulse}", last.momentum.x);
            assert!((last.work - 0.5 * impulse * impulse).abs() < 1e-14, "{name:?}: {}", last.work);
            let notes = simulation.warnings();
            let is_told = notes.iter().any(|note| matches!(note, Warning::Schedule { .. }));
            assert!(!is_told, "{name:?}: {notes:?}");
        }
    }
}

#[test]
fn built_in_speeds_give_exact_positions() {
    let wave = Schedule::sine(1.0, 200.0 * PI, -0.5 * PI).unwrap();
    let speed = Schedule::combined(Operation::Sum, Schedule::constant(1.0).unwrap(), wave).unwrap();
    for entry in INTEGRATORS {
        let simulation = simulate(moved(speed.clone()), entry.method, DT, 1.0);
        let missed = (place(&simulation) - 1.0).abs();
        assert!(missed < 1e-14, "{}: {missed:e}", entry.name);
        let last = simulation.history().samples().last().unwrap().measures;
        assert!((last.energy.total() - last.work).abs() < 1e-12, "{}: {last:?}", entry.name);
    }
    let pulse = Schedule::smooth_pulse(0.03).unwrap();
    let simulation = simulate(moved(pulse), Method::EnergyMomentum, DT, 0.5);
    assert!((place(&simulation) - 0.03).abs() < 1e-16);
}

#[test]
fn functions_unresolved_by_steps_are_reported_once() {
    let peak = |at: f64| move |t: f64| (-((t - at) / 0.01).powi(2)).exp();
    let jump = |t: f64| f64::from(u8::from(t < 0.537));
    let wave = |t: f64| 1.0 - (200.0 * PI * t).cos();
    let unseen = [
        ("load", pushed(function(peak(0.537))), 0.55),
        ("load", pushed(function(jump)), 0.55),
        ("load", pushed(product(Schedule::constant(3.0).unwrap(), function(jump))), 0.55),
        ("drive", moved(function(wave)), 0.05),
    ];
    for (kind, scene, time) in unseen {
        for method in [Method::EnergyMomentum, Method::FourthOrder, Method::Trapezoidal] {
            let simulation = simulate(scene.clone(), method, DT, 1.0);
            let notes = simulation.warnings();
            let message: Vec<&Warning> =
                notes.iter().filter(|note| matches!(note, Warning::Schedule { .. })).collect();
            let [note @ Warning::Schedule { change, .. }] = message[..] else {
                panic!("{kind}, {}: {notes:?}", method.entry().name)
            };
            println!("{note}");
            assert!(change.sampling_error > 0.01, "{change:?}");
            assert!(kind == "drive" || (change.time - time).abs() <= 0.5 * DT, "{change:?}");
            assert!(!note.is_new_or_worse(&notes));
        }
    }
    let seen = [
        pushed(function(|t| (2.0 * t).sin())),
        pushed(function(|t| f64::from(u8::from(t < 0.5)))),
        pushed(Schedule::Function {
            function: Rc::new(move |t: f64| Ok(jump(t))),
            breaks: vec![0.537],
        }),
        moved(function(|t| t * t)),
    ];
    for scene in seen {
        let simulation = simulate(scene, Method::EnergyMomentum, DT, 1.0);
        let notes = simulation.warnings();
        assert!(!notes.iter().any(|note| matches!(note, Warning::Schedule { .. })), "{notes:?}");
    }
}

#[test]
fn warnings_of_undone_steps_are_removed() {
    let jump = |t: f64| f64::from(u8::from(t < 0.537));
    let mut simulation = simulate(pushed(function(jump)), Method::EnergyMomentum, DT, 0.5);
    simulation.enable_snapshots(1 << 20);
    simulation.run_to(0.6, &mut NoMonitor).unwrap();
    assert_eq!(simulation.warnings().len(), 1);
    simulation.back(1).unwrap();
    assert!(simulation.warnings().is_empty(), "{:?}", simulation.warnings());
}
