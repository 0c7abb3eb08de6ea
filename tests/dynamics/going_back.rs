//! Runs that go back and continue are bit for bit equal to uninterrupted runs.
#![allow(clippy::unwrap_used)]

use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::rc::Rc;

use crate::common::steered_scenes::reset;
use crate::common::{
    Random, body_scenes, meshes, run, scenes, settings, sleeve_scenes, sliding_scenes, step,
};
use withy::beams::Mesh;
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{EndAction, SlidingRule};
use withy::loads::{LoadKind, Schedule};
use withy::simulation::{
    Monitor, Recording, Simulation, SimulationError, SimulationSettings, WorkCounts,
};
use withy::system::{Scene, StartMotion};

const PLENTY: usize = 1 << 28;

/// Full-precision observable state of a simulation, without the elapsed time.
fn fingerprint(simulation: &Simulation) -> String {
    let history = simulation.history();
    let columns: Vec<_> = history.columns().map(|(name, _)| history.column(name)).collect();
    let trajectory = simulation.trajectory();
    let kept = 0..trajectory.times().len();
    let configurations: Vec<_> = kept.map(|index| trajectory.configuration(index)).collect();
    let counts = WorkCounts { wall: std::time::Duration::ZERO, ..*simulation.counts() };
    let state = simulation.model().state();
    let arrivals = simulation.arrivals();
    let seen = (state, history.samples(), columns, trajectory.times(), configurations);
    format!("{seen:?} {arrivals:?} {counts:?}")
}

fn steps_of(simulation: &Simulation) -> usize {
    simulation.counts().steps
}

fn start(scene: &Scene, settings: SimulationSettings) -> Simulation {
    reset(scene);
    let mut simulation = Simulation::start(scene.clone(), settings).unwrap();
    simulation.cut_at(3.3 * simulation.dt());
    simulation
}

/// Uninterrupted run: fingerprints by number of steps, and the fingerprint at the end.
fn straight(mut simulation: Simulation, steps: usize) -> (HashMap<usize, String>, String) {
    let mut seen = HashMap::from([(0, fingerprint(&simulation))]);
    for _ in 0..steps {
        step(&mut simulation).unwrap();
        // A run may end without a further step.
        seen.entry(steps_of(&simulation)).or_insert_with(|| fingerprint(&simulation));
        if simulation.has_ended() {
            break;
        }
    }
    (seen, fingerprint(&simulation))
}

/// Steps, goes back, rewinds and forks at random, and then continues to the end of an uninterrupted run. The recording depends on the seed.
fn assert_walk_is_straight(
    label: &str,
    scene: &Scene,
    settings: SimulationSettings,
    steps: usize,
    seed: u64,
) {
    let start = || {
        let mut simulation = start(scene, settings);
        let every = |steps| Recording::Every(NonZeroUsize::new(steps).unwrap());
        simulation.record([every(1), every(3), Recording::Nothing][seed as usize % 3]);
        simulation
    };
    let (seen, end) = straight(start(), steps);
    let last = *seen.keys().max().unwrap();
    let mut random = Random(seed);
    let mut choose = |below: usize| ((random.next() + 1.0) * 0.5 * below as f64) as usize;
    let mut simulation = start();
    simulation.enable_snapshots(PLENTY);
    let mut aside: Option<Simulation> = None;
    for _ in 0..30 {
        match choose(6) {
            0 => simulation.back(choose(steps_of(&simulation) + 1)).unwrap(),
            1 => {
                let time = simulation.time() * choose(1000) as f64 / 1000.0;
                simulation.rewind(time).unwrap();
                assert!(simulation.time() <= time + simulation.slack(), "{label}");
            }
            2 => {
                let fork = simulation.fork().unwrap();
                assert_eq!(fingerprint(&fork), fingerprint(&simulation), "{label}: a fork");
                aside = Some(std::mem::replace(&mut simulation, fork));
            }
            3 => {
                if let Some(other) = aside.as_mut() {
                    std::mem::swap(other, &mut simulation);
                }
            }
            _ => {
                for _ in 0..=choose(4) {
                    if !simulation.has_ended() && steps_of(&simulation) < last {
                        step(&mut simulation).unwrap();
                    }
                }
            }
        }
        if let Some(expected) = seen.get(&steps_of(&simulation)).filter(|_| !simulation.has_ended())
        {
            assert!(fingerprint(&simulation) == *expected, "{label}: at {}", simulation.time());
        }
    }
    while !simulation.has_ended() && steps_of(&simulation) < last {
        step(&mut simulation).unwrap();
    }
    // The simulation may already be at the end of the uninterrupted run.
    if fingerprint(&simulation) != end {
        step(&mut simulation).unwrap();
    }
    assert!(fingerprint(&simulation) == end, "{label}: the end at {}", simulation.time());
}

#[test]
fn rewinding_restores_the_states_of_every_scene() {
    for (number, (name, mesh)) in meshes(4).into_iter().enumerate() {
        let all = scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh));
        for scene in all.chain(sleeve_scenes::all(&mesh)) {
            let entry = INTEGRATORS[number % INTEGRATORS.len()];
            let label = format!("{}, {}, {name}", entry.name, scene.name);
            assert_walk_is_straight(
                &label,
                &scene,
                settings(entry.method, 0.05),
                12,
                number as u64,
            );
        }
    }
}

#[test]
fn rewinding_restores_states_with_slider_events() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let rule = SlidingRule::Conserving;
    let mut arrivals = 0;
    let actions = [EndAction::Bounce, EndAction::Release, EndAction::Stop];
    for (ends, entry) in
        actions.into_iter().flat_map(|ends| INTEGRATORS.iter().map(move |entry| (ends, entry)))
    {
        let carriage = body_scenes::carriage(&mesh, rule);
        let all = sliding_scenes::all(&mesh, rule).into_iter().chain([carriage]);
        for (number, mut scene) in all.enumerate() {
            scene.sliders.iter_mut().for_each(|slider| slider.ends = ends);
            let label = format!("{}, {}, {ends:?}", entry.name, scene.name);
            let settings = settings(entry.method, 0.02);
            let mut probe = start(&scene, settings);
            run(&mut probe, 0.6).unwrap();
            arrivals += probe.arrivals().len();
            assert_walk_is_straight(&label, &scene, settings, 30, number as u64);
        }
    }
    assert!(arrivals > 20, "only {arrivals} arrivals");
}

/// Beam that rotates so fast that every full step fails.
fn fast_spinner() -> Scene {
    let mesh = Mesh::bspline(3, 3, 2).unwrap();
    let mut scene = scenes::free_beam(&mesh, scenes::spaghetti_section(1e4, 100.0));
    scene.beams[0].motion = StartMotion { spin: 30.0, ..StartMotion::default() };
    scene
}

#[test]
fn rewinding_restores_states_over_halved_steps() {
    for method in INTEGRATORS.iter().map(|entry| entry.method) {
        let (scene, settings) = (fast_spinner(), settings(method, 0.4));
        let mut probe = start(&scene, settings);
        run(&mut probe, 2.0).unwrap();
        assert!(probe.counts().retries > 3 && probe.counts().steps > 8, "{:?}", probe.counts());
        for seed in 0..20 {
            assert_walk_is_straight("fast spinner", &scene, settings, 5, seed);
        }
    }
}

#[test]
fn rewinding_restores_states_under_a_function_of_time() {
    let mut scene = scenes::towed(&Mesh::bspline(3, 3, 2).unwrap());
    let schedule =
        Schedule::Function { function: Rc::new(|t: f64| Ok((3.0 * t).cos())), breaks: vec![0.17] };
    let station = scenes::end_of(&mut scene, 0);
    scene.add_load(LoadKind::Moment { station, moment: 2.0 }, schedule);
    assert_walk_is_straight("function", &scene, settings(Method::EnergyMomentum, 0.05), 12, 7);
}

/// Stops a run at its n-th monitor call.
struct StopAt(usize);

impl Monitor for StopAt {
    fn continues(&mut self, _time: f64) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 > 0
    }
}

#[test]
fn run_interrupted_at_any_step_continues_unchanged() {
    let (scene, settings) = (fast_spinner(), settings(Method::EnergyMomentum, 0.4));
    let mut whole = start(&scene, settings);
    run(&mut whole, 2.0).unwrap();
    for question in 1..12 {
        let mut stopped = start(&scene, settings);
        let ended = stopped.run_to(2.0, &mut StopAt(question));
        assert!(matches!(ended, Err(SimulationError::Interrupted { .. })));
        run(&mut stopped, 2.0).unwrap();
        assert_eq!(fingerprint(&stopped), fingerprint(&whole), "stopped at question {question}");
    }
}

#[test]
fn ended_run_can_be_rewound() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let mut scene = sliding_scenes::abacus(&mesh, SlidingRule::Conserving);
    scene.sliders.iter_mut().for_each(|slider| slider.ends = EndAction::Stop);
    let mut simulation = start(&scene, settings(Method::EnergyMomentum, 0.02));
    simulation.enable_snapshots(PLENTY);
    run(&mut simulation, 5.0).unwrap();
    assert!(simulation.has_ended());
    let (end, time) = (fingerprint(&simulation), simulation.time());
    simulation.rewind(0.5 * time).unwrap();
    assert!(!simulation.has_ended() && simulation.arrivals().is_empty());
    run(&mut simulation, 5.0).unwrap();
    assert_eq!(fingerprint(&simulation), end);
}

#[test]
fn step_grid_cut_remains_after_a_rewind() {
    let scene = scenes::spaghetti(&Mesh::bspline(4, 3, 2).unwrap(), 1e4);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
    simulation.enable_snapshots(PLENTY);
    run(&mut simulation, 0.3).unwrap();
    simulation.cut_at(0.15);
    simulation.rewind(0.0).unwrap();
    run(&mut simulation, 0.3).unwrap();
    assert_eq!(simulation.history().column("t").unwrap(), [0.0, 0.1, 0.15, 0.2, 0.3]);
}

#[test]
fn memory_limit_drops_the_oldest_snapshots_except_the_start() {
    let scene = scenes::spaghetti(&Mesh::bspline(14, 3, 2).unwrap(), 1e4);
    let settings = settings(Method::EnergyMomentum, 0.1);
    let mut simulation = Simulation::start(scene.clone(), settings).unwrap();
    simulation.enable_snapshots(100_000);
    let beginning = fingerprint(&simulation);
    for _ in 0..200 {
        step(&mut simulation).unwrap();
        let (_, bytes) = simulation.stored_snapshots();
        assert!(bytes <= 100_000, "{bytes}");
    }
    let (kept, bytes) = simulation.stored_snapshots();
    println!("{} bytes a snapshot of the flying spaghetti", bytes / kept);
    assert!(kept > 10 && bytes > 80_000, "{kept} snapshots in {bytes} bytes");
    let end = fingerprint(&simulation);
    let refusal = simulation.back(kept).unwrap_err();
    assert!(
        matches!(refusal, SimulationError::NoSnapshot { steps, .. } if steps == kept - 2),
        "{refusal:?}"
    );
    let advice = withy::script::messages::advice::hint_for(&refusal).unwrap();
    let message = format!("{refusal}; {advice}");
    for part in
        ["limit of 0.1 MB", &format!("last {} steps", kept - 2), "sim.rewind(0)", "snapshots: 64"]
    {
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(fingerprint(&simulation), end, "a refusal changes nothing");
    simulation.back(kept - 2).unwrap();
    simulation.rewind(0.0).unwrap();
    assert_eq!(fingerprint(&simulation), beginning);
    for _ in 0..200 {
        step(&mut simulation).unwrap();
    }
    assert_eq!(fingerprint(&simulation), end);
    simulation.enable_snapshots(50_000);
    let (fewer, bytes) = simulation.stored_snapshots();
    assert!(fewer < kept && bytes <= 50_000);
    simulation.back(fewer - 2).unwrap();
    simulation.enable_snapshots(0);
    assert_eq!(simulation.stored_snapshots(), (0, 0));
}

#[test]
fn impossible_rewinds_are_rejected_with_a_reason() {
    let scene = scenes::spaghetti(&Mesh::bspline(4, 3, 2).unwrap(), 1e4);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
    run(&mut simulation, 1.0).unwrap();
    let message = |refused: Result<(), SimulationError>| refused.unwrap_err().to_string();
    assert!(message(simulation.back(3)).contains("stores no snapshots"));
    simulation.enable_snapshots(10);
    assert!(message(simulation.back(3)).contains("exceeds the memory limit of 0.00001 MB"));
    assert!(message(simulation.back(11)).contains("only 10 were taken"));
    for time in [-0.5, 1.5, f64::NAN, f64::INFINITY] {
        assert!(message(simulation.rewind(time)).contains("covers t = 0 to 1"));
    }
    simulation.enable_snapshots(PLENTY);
    run(&mut simulation, 2.0).unwrap();
    assert!(message(simulation.back(15)).contains("snapshots are stored from t = 1 on"));
    simulation.back(10).unwrap();
    simulation.back(0).unwrap();
    simulation.rewind(1.0).unwrap();
    assert_eq!(simulation.time(), 1.0);
}

#[test]
fn fork_and_original_are_independent() {
    let scene = scenes::spaghetti(&Mesh::bspline(4, 3, 2).unwrap(), 1e4);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
    simulation.enable_snapshots(PLENTY);
    run(&mut simulation, 1.0).unwrap();
    let mut fork = simulation.fork().unwrap();
    let before = fingerprint(&simulation);
    run(&mut fork, 2.0).unwrap();
    assert_eq!(fingerprint(&simulation), before);
    run(&mut simulation, 2.0).unwrap();
    assert_eq!(fingerprint(&fork), fingerprint(&simulation));
    fork.back(15).unwrap();
    assert_eq!((fork.time(), simulation.time()), (0.5, 2.0));
}
