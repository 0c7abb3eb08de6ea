//! Coulomb friction of sliders: closed forms, orders, energy balances and transitions.
#![allow(clippy::unwrap_used)]

use std::rc::Rc;

use crate::common::scenes::{add_beam, line};
use crate::common::sliding::{STIFF, moving_particle};
use crate::common::{at, run, sci, settings, simulate, step, wild_scenes};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Vec2, unit};
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule};
use withy::loads::{PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation, SimulationError, Warning};
use withy::system::{Drive, DriveKind, Scene, StartMotion, SystemError};

const METHOD: Method = Method::EnergyMomentum;

fn mesh() -> Mesh {
    Mesh::bspline(4, 3, 2).unwrap()
}

fn add_slider(scene: &mut Scene, bead: Station, beam: usize, along: f64, friction: f64) {
    let name = scene.free_name("slider");
    let slider = Slider::new(name, bead, beam, along);
    scene.add_slider(Slider { ends: EndAction::Bounce, friction, ..slider }).unwrap();
}

/// Block that is pushed uphill with a speed of 2 on a beam of length 10.
fn incline(degrees: f64, friction: f64) -> Scene {
    let mut scene = Scene::new("incline");
    let uphill = unit(degrees.to_radians());
    let rod = add_beam(&mut scene, line(uphill * -5.0, uphill * 5.0), &mesh(), STIFF);
    for along in [0.0, 10.0] {
        let end = scene.station(rod, along).unwrap();
        scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
    }
    scene.gravity = at(0.0, -9.81);
    let block = moving_particle(&mut scene, Vec2::zeros(), uphill * 2.0, 1.0);
    add_slider(&mut scene, block, rod, 5.0, friction);
    scene
}

/// Bead at a distance of 1 from the axis of a bar that rotates at the rate 1, with a start velocity along the bar.
fn turning_bar(friction: f64, velocity: f64) -> Scene {
    let mut scene = Scene::new("turning bar");
    let rod = add_beam(&mut scene, line(at(-3.0, 0.0), at(3.0, 0.0)), &mesh(), STIFF);
    scene.beams[rod].motion =
        StartMotion { velocity: Vec2::zeros(), spin: 1.0, centre: Some(Vec2::zeros()) };
    let station = scene.station(rod, 3.0).unwrap();
    scene.join(JointKind::Hinge, station, Partner::Ground).unwrap();
    let rate = PrescribedMotion::Rate(Schedule::Constant(1.0));
    let (kind, motions) = (DriveKind::Motor, [None, None, Some(rate)]);
    scene.drives.push(Drive { name: "motor".to_owned(), kind, station, motions });
    let ring = moving_particle(&mut scene, at(1.0, 0.0), at(velocity, 1.0), 1.0);
    add_slider(&mut scene, ring, rod, 4.0, friction);
    scene
}

/// Bead that slides with the speed 2 along a free, rotating flexible beam.
fn flying(friction: f64, rotation: f64) -> Scene {
    let mut scene = Scene::new("flying");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 20.0,
        mass_per_length: 0.5,
        rotary_inertia: 1e-2,
    };
    let along = unit(rotation);
    let across = at(-along.y, along.x);
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(Vec2::zeros(), along * 4.0), &mesh, section);
    scene.beams[rod].motion =
        StartMotion { velocity: Vec2::zeros(), spin: 1.0, centre: Some(along * 2.0) };
    let ring = moving_particle(&mut scene, along, along * 2.0 - across, 1.0);
    add_slider(&mut scene, ring, rod, 1.0, friction);
    scene
}

fn place(simulation: &Simulation) -> f64 {
    simulation.model().slider_arc_length(0)
}

fn assert_invariants(label: &str, simulation: &Simulation, tolerance: f64) {
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < tolerance, "{label}: {name} drifts by {drift:e}");
    }
}

/// Energies lost by friction in all rows never decrease.
fn assert_dissipation_grows(label: &str, simulation: &Simulation) {
    let lost = simulation.history().column("dissipated.slider1").unwrap();
    let scale = lost.last().unwrap().abs();
    assert!(lost.windows(2).all(|pair| pair[1] >= pair[0] - 1e-14 * scale), "{label}");
}

/// Positions along an incline (closed form): the block slides back at 30° and stays at 15°.
#[test]
fn block_on_an_incline_slides_back_or_sticks() {
    let places = [
        (30.0, [0.2670714761, 0.2050865127, -0.3623985771, -3.2645841843]),
        (15.0, [0.3318207956, 0.3716273973, 0.3716273973, 0.3716273973]),
    ];
    for (degrees, exact) in places {
        for dt in [0.1, 0.03, 0.01] {
            let mut simulation =
                Simulation::start(incline(degrees, 0.3), settings(METHOD, dt)).unwrap();
            for (end, exact) in [0.25, 0.5, 1.0, 2.0].into_iter().zip(exact) {
                run(&mut simulation, end).unwrap();
                let error = place(&simulation) - 5.0 - exact;
                assert!(error.abs() < 2e-4, "{degrees}° dt {dt} t {end}: {error:e}");
            }
            assert_invariants("incline", &simulation, 1e-12);
            assert_dissipation_grows("incline", &simulation);
        }
    }
}

#[test]
fn a_block_that_sticks_does_not_creep() {
    let mut simulation = Simulation::start(incline(15.0, 0.3), settings(METHOD, 0.05)).unwrap();
    run(&mut simulation, 1.0).unwrap();
    let (before, lost) = (place(&simulation), simulation.history().column("dissipated").unwrap());
    run(&mut simulation, 50.0).unwrap();
    assert!((place(&simulation) - before).abs() < 1e-14, "{:e}", place(&simulation) - before);
    let after = simulation.history().column("dissipated").unwrap();
    assert!((after.last().unwrap() - lost.last().unwrap()).abs() < 1e-14);
    // The friction force on the beam balances the weight component m g sin 15°.
    let force = simulation.history().column("slider1.friction").unwrap();
    let exact = -9.81 * 15.0_f64.to_radians().sin();
    let mean = force.iter().rev().take(200).sum::<f64>() / 200.0;
    assert!((mean / exact - 1.0).abs() < 1e-3, "{mean} {exact}");
}

/// Distances from the axis at t = 2 (Runge–Kutta, tolerance 1e-13): with slip in one direction, and with a reversal.
#[test]
fn a_bead_on_a_turning_bar_converges_with_second_order() {
    for (friction, velocity, exact) in [(0.3, -1.5, -0.2576974203), (0.8, 0.0, 2.1271833188)] {
        let errors: Vec<f64> = [20.0, 40.0, 80.0, 160.0]
            .map(|steps| {
                let simulation =
                    simulate(turning_bar(friction, velocity), METHOD, 2.0 / steps, 2.0);
                assert_invariants("turning bar", &simulation, 1e-13);
                (place(&simulation) - 3.0 - exact).abs()
            })
            .to_vec();
        assert!(errors[3] < 1e-5, "{}", sci(&errors));
        let orders = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2());
        assert!(orders.into_iter().all(|order| (order - 2.0).abs() < 0.15), "{}", sci(&errors));
    }
}

/// A bar has a transverse acceleration of 2 that ends within a step. This leaves a velocity error of the bead across the bar, whose sign
/// alternates from step to step, and a contact force that reverses it. The bead no longer presses against the bar, so there is no friction.
#[test]
fn friction_does_not_follow_the_alternating_part_of_the_contact_force() {
    for steps in [10.0, 20.0, 40.0] {
        let mut scene = Scene::new("accelerated bar");
        let line = line(Vec2::zeros(), at(4.0, 0.0));
        let bar = add_beam(&mut scene, line, &Mesh::bspline(1, 1, 0).unwrap(), STIFF);
        for along in [0.0, 4.0] {
            let rate = |schedule| Some(PrescribedMotion::Rate(schedule));
            let [x, rotation] = [0, 1].map(|_| rate(Schedule::Constant(0.0)));
            let function = Rc::new(|time: f64| Ok(2.0 * time.min(0.53)));
            let ramp = Schedule::Function { function, breaks: vec![] };
            let motions = [x, rate(ramp), rotation];
            let (name, station) = (format!("drive{along}"), scene.station(bar, along).unwrap());
            scene.drives.push(Drive { name, kind: DriveKind::Move, station, motions });
        }
        let ring = moving_particle(&mut scene, at(1.0, 0.0), at(1.0, 0.0), 1.0);
        add_slider(&mut scene, ring, bar, 1.0, 0.3);
        let simulation = simulate(scene, METHOD, 1.0 / steps, 2.0);
        let column = |name: &str| simulation.history().column(name).unwrap();
        let (force, friction) = (column("slider1.force"), column("slider1.friction"));
        let last = force.len() - 1;
        assert!(force[last] > 0.1, "{force:?}");
        assert!(friction[last].abs() < 1e-12, "{friction:?}");
    }
}

#[test]
fn flying_flexible_beam_keeps_its_balances_at_any_step_size() {
    for friction in [0.3, 0.8] {
        for dt in [0.2, 0.05, 0.01] {
            let label = format!("friction {friction}, dt {dt}");
            let simulation = simulate(flying(friction, 0.0), METHOD, dt, 5.0);
            assert_invariants(&label, &simulation, 1e-12);
            assert_dissipation_grows(&label, &simulation);
        }
    }
}

#[test]
fn rotated_scene_has_the_same_motion() {
    let places = [0.0, 0.7, 2.0].map(|rotation| {
        let simulation = simulate(flying(0.3, rotation), METHOD, 0.02, 2.0);
        (place(&simulation), simulation.counts().steps)
    });
    for (place, steps) in places {
        assert!((place - places[0].0).abs() < 1e-9, "{places:?}");
        assert_eq!(steps, places[0].1);
    }
}

#[test]
fn rewinding_and_continuing_keeps_every_bit() {
    let mut simulation = Simulation::start(incline(30.0, 0.3), settings(METHOD, 0.04)).unwrap();
    simulation.enable_snapshots(1 << 24);
    run(&mut simulation, 1.0).unwrap();
    let whole = place(&simulation).to_bits();
    simulation.rewind(0.2).unwrap();
    run(&mut simulation, 1.0).unwrap();
    assert_eq!(place(&simulation).to_bits(), whole);
}

#[test]
fn vanishing_friction_does_not_change_the_motion() {
    let ends = [0.0, f64::MIN_POSITIVE].map(|friction| {
        let simulation = simulate(flying(friction, 0.0), METHOD, 0.02, 1.0);
        place(&simulation)
    });
    assert!((ends[0] - ends[1]).abs() < 1e-9, "{ends:?}");
}

#[test]
fn friction_with_other_methods_and_rules_is_rejected() {
    let started = Simulation::start(incline(30.0, 0.3), settings(Method::FourthOrder, 0.1));
    let error = started.map(|_| ()).unwrap_err();
    assert!(matches!(error, SimulationError::FrictionMethod { .. }), "{error}");
    let mut scene = incline(30.0, 0.0);
    let place = scene.sliders[0].clone();
    scene.sliders.clear();
    for (friction, rule) in [(0.3, SlidingRule::Kinked), (-0.1, SlidingRule::Conserving)] {
        let slider = Slider { friction, rule, ..place.clone() };
        let error: SystemError = scene.add_slider(slider).unwrap_err();
        assert!(error.to_string().contains("friction"), "{error}");
    }
}

/// A step of one second is divided where the block stops after a quarter of it.
#[test]
fn step_ends_at_a_transition() {
    let mut simulation = Simulation::start(incline(15.0, 0.3), settings(METHOD, 1.0)).unwrap();
    step(&mut simulation).unwrap();
    let times = simulation.history().column("t").unwrap();
    let rest = 2.0 / (9.81 * (15.0_f64.to_radians().sin() + 0.3 * 15.0_f64.to_radians().cos()));
    assert!(times.iter().any(|time| (time - rest).abs() < 1e-6), "{times:?} {rest}");
}

/// Random scenes with sliders that stick, slip and bounce. Friction never adds energy, and impacts explain all other changes.
#[test]
fn random_scenes_with_friction_keep_their_balances() {
    let seeds = if std::env::var("WITHY_LONG").is_ok() { 60 } else { 14 };
    let (mut failed, mut with_fixed_friction) = (Vec::new(), 0);
    for seed in 0..seeds {
        let (mut scene, _) = wild_scenes::scene(seed);
        for (slider, friction) in scene.sliders.iter_mut().zip([0.3, 2.0, 0.05].iter().cycle()) {
            slider.rule = SlidingRule::Conserving;
            slider.friction = *friction;
        }
        let name = scene.name.clone();
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.01)).unwrap();
        if let Err(error) = run(&mut simulation, 1.0) {
            println!("{name}: {error}");
            failed.push(name);
            continue;
        }
        assert_invariants(&name, &simulation, 1e-8);
        let notes = simulation.warnings();
        with_fixed_friction +=
            usize::from(notes.iter().any(|note| matches!(note, Warning::Friction { .. })));
        let column = |name: &str| simulation.history().column(name).unwrap();
        let (lost, times) = (column("dissipated"), column("t"));
        let largest =
            |values: &[f64]| values.iter().fold(0.0, |sum: f64, value| sum.max(value.abs()));
        let scale = largest(&lost).max(largest(&column("kinetic")));
        for at in 1..lost.len() {
            let is_impact =
                simulation.arrivals().iter().any(|arrival| (arrival.time - times[at]).abs() < 1e-9);
            let gain = lost[at - 1] - lost[at];
            assert!(is_impact || gain <= 1e-9 * scale, "{name}: {gain:e} at {}", times[at]);
        }
    }
    assert!(with_fixed_friction > 0);
    assert!(10 * failed.len() as u64 <= seeds, "{failed:?}");
}
