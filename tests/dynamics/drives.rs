//! Prescribed motions: closed forms with every integrator, exact positions and angles, and reactions of drives.
#![allow(clippy::unwrap_used)]

use std::cell::Cell;
use std::rc::Rc;

use crate::common::body_scenes::{add_body, hinge, point};
use crate::common::scenes::{add_beam, drive, line};
use crate::common::{at, orders, run, sci, settings, simulate};
use withy::beams::{Mesh, Section, Station};
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::{Component, Components, JointKind, Partner};
use withy::loads::{LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{Invariant, NoMonitor, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{
    Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, StartMotion,
    SystemError,
};

fn function(of: impl Fn(f64) -> f64 + 'static) -> Schedule {
    Schedule::Function { function: Rc::new(move |t: f64| Ok(of(t))), breaks: Vec::new() }
}

fn section(axial: f64) -> Section {
    Section {
        axial_stiffness: axial,
        shear_stiffness: 1e3,
        bending_stiffness: 10.0,
        mass_per_length: 1.5,
        rotary_inertia: 0.1,
    }
}

const AMPLITUDE: f64 = 0.02;
const SHAKEN: f64 = 3.1;

/// Bar of one linear element with an axial base excitation. The mass matrix couples its free end with its start.
fn bar() -> Scene {
    let mut scene = Scene::new("bar");
    let mesh = Mesh::lagrange(1, 1).unwrap();
    let beam = add_beam(&mut scene, line(at(1.0, 0.0), at(3.0, 0.0)), &mesh, section(30.0));
    let start = Station::on_beam(beam, 0.0);
    let shaken = Schedule::Sine { amplitude: AMPLITUDE, rate: SHAKEN, phase: 0.0 };
    let held = PrescribedMotion::Position(Schedule::constant(0.0).unwrap());
    let given = [
        (Component::X, PrescribedMotion::Position(shaken)),
        (Component::Y, held.clone()),
        (Component::Rotation, held),
    ];
    drive(&mut scene, start, &given);
    scene
}

/// `m/3 ẍ + m/6 ü + k (x - u) = 0` from rest, with `u = a sin Ωt`.
fn of_bar(t: f64) -> f64 {
    let (mass, stiffness) = (3.0, 15.0);
    let omega = (3.0_f64 * stiffness / mass).sqrt();
    let square = SHAKEN * SHAKEN;
    let amplitude = AMPLITUDE * (omega * omega + 0.5 * square) / (omega * omega - square);
    amplitude * ((SHAKEN * t).sin() - SHAKEN / omega * (omega * t).sin())
}

#[test]
fn base_excitation_has_amplitude_and_phase_with_the_order_of_the_method() {
    let times = [1.0, 2.5, 4.0];
    for entry in INTEGRATORS {
        let error = |dt: f64| {
            let miss = |time: f64| {
                let simulation = simulate(bar(), entry.method, dt, time);
                let end = simulation.model().control_points().next().unwrap()[1].x - 3.0;
                (end - of_bar(time)).abs()
            };
            times.into_iter().map(miss).fold(0.0, f64::max)
        };
        let errors: Vec<f64> = [0.05, 0.025, 0.0125].into_iter().map(error).collect();
        let (found, expected) = (orders(&errors), f64::from(entry.claims.order));
        println!("{:18} {} {found:.2?}", entry.name, sci(&errors));
        let last = *found.last().unwrap();
        // First-order methods reach their asymptotic order at smaller steps.
        let near = if entry.claims.order == 1 { 0.4 } else { 0.25 };
        assert!((last - expected).abs() < near, "{}: {} {found:.2?}", entry.name, sci(&errors));
    }
}

/// Particle with a prescribed motion that pulls another particle on a spring.
fn towing(motion: PrescribedMotion) -> Scene {
    let mut scene = Scene::new("towing");
    let bead =
        |name: &str, x: f64| ParticleDefinition { name: name.to_owned(), position: at(x, 0.0) };
    let hand = scene.add_particle(bead("hand", 0.7), 1.0).unwrap();
    scene.add_particle(bead("free", 2.0), 1.0).unwrap();
    drive(&mut scene, hand, &[(Component::X, motion)]);
    scene
}

#[test]
fn positions_match_their_function_to_rounding_after_many_steps() {
    let scene = towing(PrescribedMotion::Position(function(|t| (1.3 * t).sin() + 0.01 * t * t)));
    let simulation = simulate(scene, Method::EnergyMomentum, 1e-3, 100.0);
    assert_eq!(simulation.counts().steps, 100_000);
    let found = simulation.model().control_points().next().unwrap()[0].x;
    let expected = 0.7 + (130.0_f64.sin() + 100.0);
    assert!((found - expected).abs() < 4.0 * f64::EPSILON * expected, "{}", found - expected);
}

/// Beam with a prescribed rotation or angular velocity at its start, with the initial angular velocity `spin`.
fn turned(
    mesh: &Mesh,
    section: Section,
    length: f64,
    motion: PrescribedMotion,
    spin: f64,
) -> Scene {
    let mut scene = Scene::new("turned");
    let beam = add_beam(&mut scene, line(at(0.0, 0.0), at(length, 0.0)), mesh, section);
    scene.beams[beam].motion =
        StartMotion { velocity: at(0.0, 0.0), spin, centre: Some(at(0.0, 0.0)) };
    let start = scene.station(beam, 0.0).unwrap();
    scene.station(beam, length).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    drive(&mut scene, start, &[(Component::Rotation, motion)]);
    scene
}

/// Section angle at an arc length.
fn angle(simulation: &Simulation, arc_length: f64) -> f64 {
    let station = Station::on_beam(0, arc_length);
    simulation.model().angle(simulation.scene(), &station).unwrap()
}

#[test]
fn prescribed_rotations_have_no_phase_error() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    for entry in INTEGRATORS {
        let scene = turned(
            &mesh,
            section(1e4),
            1.0,
            PrescribedMotion::Position(function(|t| 3.0 * t)),
            3.0,
        );
        let simulation = simulate(scene, entry.method, 0.02, 5.0);
        let (root, tip) = (angle(&simulation, 0.0), angle(&simulation, 1.0));
        // A free body would lag by ω³Δt²t/12 = 0.0045 rad.
        assert!((root - 15.0).abs() < 1e-12, "{}: {root}", entry.name);
        assert!((tip - 15.0).abs() < 5e-3, "{}: {tip}", entry.name);
        if entry.claims.energy == EnergyClaim::Conserved {
            assert!(simulation.history().drift(Invariant::Energy) < 1e-12, "{}", entry.name);
        }
    }
}

/// Angle of the spin-up of Simo and Vu-Quoc (1986).
fn spun_up(t: f64) -> f64 {
    let slow = 7.5 / std::f64::consts::PI;
    match t < 15.0 {
        true => 0.4 * (0.5 * t * t + slow * slow * ((t / slow).cos() - 1.0)),
        false => 6.0 * t - 45.0,
    }
}

/// Benchmark B4: the steady stretch of the finite-strain bar, and the largest lag of the tip of converged runs.
#[test]
fn spin_up_has_the_published_stretch_and_the_converged_lag() {
    let section = Section {
        axial_stiffness: 2.8e7,
        shear_stiffness: 1e7,
        bending_stiffness: 1.4e4,
        mass_per_length: 1.2,
        rotary_inertia: 6e-4,
    };
    let motion = PrescribedMotion::Position(Schedule::Function {
        function: Rc::new(|t: f64| Ok(spun_up(t))),
        breaks: vec![15.0],
    });
    let scene = turned(&Mesh::bspline(10, 3, 2).unwrap(), section, 10.0, motion, 0.0);
    let settings = crate::common::settings(Method::FourthOrder, 0.05);
    let mut simulation = Simulation::start(scene, settings).unwrap();
    let aside = |simulation: &Simulation| {
        let tip = *simulation.model().control_points().next().unwrap().last().unwrap();
        let angle = spun_up(simulation.time());
        let along = at(angle.cos(), angle.sin());
        (tip.dot(&along) - 10.0, tip.dot(&at(-along.y, along.x)))
    };
    crate::common::run(&mut simulation, 6.75).unwrap();
    let lag = aside(&simulation).1;
    assert!((lag + 0.57383).abs() < 1e-4, "{lag}");
    crate::common::run(&mut simulation, 10.0).unwrap();
    let lag = aside(&simulation).1;
    assert!((lag + 0.363).abs() < 2e-3, "{lag}");
    crate::common::run(&mut simulation, 20.0).unwrap();
    assert!((angle(&simulation, 0.0) - 75.0).abs() < 1e-12);
    // A small residual vibration is averaged.
    let mut stretch = 0.0;
    for step in 1..=200 {
        crate::common::run(&mut simulation, 20.0 + 0.05 * f64::from(step)).unwrap();
        stretch += aside(&simulation).0 / 200.0;
    }
    assert!((stretch - 5.1431745e-4).abs() < 5e-6, "{stretch:e}");
    assert!(simulation.history().drift(Invariant::Energy) < 1e-11);
}

#[test]
fn motions_prescribed_or_supported_twice_are_rejected() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let given =
        || PrescribedMotion::Position(Schedule::Sine { amplitude: 1.0, rate: 1.0, phase: 0.0 });
    let mut scene = turned(&mesh, section(1e4), 1.0, given(), 0.0);
    let start = Station::on_beam(0, 0.0);
    let refused = |scene: &mut Scene, component: Component| {
        let mut motions = [None, None, None];
        motions[component as usize] = Some(given());
        let kind = withy::system::DriveKind::Motor;
        let drive =
            withy::system::Drive { name: "other".to_owned(), kind, station: start, motions };
        scene.add_drive(drive).unwrap_err()
    };
    let message = refused(&mut scene, Component::X);
    assert!(matches!(&message, SystemError::AlreadyDriven { existing: "fixed", .. }), "{message}");
    let message = refused(&mut scene, Component::Rotation);
    assert!(
        matches!(&message, SystemError::AlreadyDriven { existing: "prescribed", .. }),
        "{message}"
    );
    let hold = JointKind::Support(Components::Rotation);
    let message = scene.join(hold, start, Partner::Ground).unwrap_err();
    assert!(matches!(&message, SystemError::HeldAndDriven { .. }), "{message}");
    assert_eq!((scene.drives.len(), scene.joints.len()), (1, 1));
}

#[test]
fn work_is_recorded_by_name_and_sums_to_the_total() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let motion = PrescribedMotion::Position(function(|t| 0.3 * t * t));
    let mut scene = turned(&mesh, section(1e4), 1.0, motion, 0.0);
    let station = Station::on_beam(0, 1.0);
    let wind =
        LoadKind::Force { station, force: at(0.0, 2.0), frame: withy::loads::LoadFrame::Dead };
    scene.add_named_load("wind".to_owned(), wind, Schedule::hold_for(1.0).unwrap()).unwrap();
    let simulation = simulate(scene, Method::FourthOrder, 0.05, 3.0);
    let history = simulation.history();
    let last = |name: &str| *history.column(name).unwrap().last().unwrap();
    let sum = last("work.move1") + last("work.wind");
    assert!((sum - last("work")).abs() < 1e-12 * last("work").abs(), "{sum}");
    assert!(last("wind.force") == 0.0 && last("move1.angle").abs() > 0.1);
}

/// The moment of a motor is the mean `c ω + I α + k φ` of the step, and its work is the moment times the rotation, at any step size.
#[test]
fn motor_torque_is_exact_for_any_rotation_per_step() {
    let (inertia, damping, stiffness) = (0.2, 0.5, 0.3);
    let angle = |t: f64| 2.0 * t + 5.0 * t * t;
    for dt in [0.1, 0.01] {
        let mut scene = Scene::new("rotor");
        let rotor = point(add_body(&mut scene, at(1.0, 2.0), 0.0, (1.0, inertia), &[]), 0);
        hinge(&mut scene, rotor, None);
        drive(
            &mut scene,
            rotor,
            &[(Component::Rotation, PrescribedMotion::Position(function(angle)))],
        );
        let kind = SpringKind::Torsion([Anchor::Ground(at(0.0, 0.0)), Anchor::Station(rotor)]);
        let law = Some(SpringLaw::Linear { stiffness, natural: 0.0 });
        let (name, origin, damping_law) = ("brake".to_owned(), Origin::Zero, damping.into());
        scene
            .add_spring(Spring { name, kind, law, origin, damping: damping_law, rest: None })
            .unwrap();
        let simulation = simulate(scene, Method::EnergyMomentum, dt, 1.0);
        let history = simulation.history();
        let (times, message) =
            (history.column("t").unwrap(), history.column("move1.angle").unwrap());
        let mut work = 0.0;
        for (pair, message) in times.windows(2).zip(&message[1..]) {
            let [before, after] = [angle(pair[0]), angle(pair[1])];
            let mean_spin = (after - before) / (pair[1] - pair[0]);
            let expected =
                inertia * 10.0 + damping * mean_spin + stiffness * 0.5 * (before + after);
            assert!((message - expected).abs() < 1e-10 * expected, "{message} {expected}");
            work += message * (after - before);
        }
        let kept = *history.column("work.move1").unwrap().last().unwrap();
        assert!((work - kept).abs() < 1e-11 * kept, "{work} {kept}");
        for (name, invariant) in Invariant::ALL {
            assert!(history.drift(invariant) < 1e-13, "{name}");
        }
    }
}

/// Rigid body with a prescribed rotation about a point at a distance of 1 from its centre.
fn swung(motion: PrescribedMotion) -> Scene {
    swung_at(1.0, motion)
}

/// Rigid body with a prescribed rotation about a point at the distance `reach` from its centre.
pub fn swung_at(reach: f64, motion: PrescribedMotion) -> Scene {
    let mut scene = Scene::new("swung");
    let body = add_body(&mut scene, at(reach, 0.0), 0.0, (2.0, 0.5), &[at(-reach, 0.0)]);
    hinge(&mut scene, point(body, 1), None);
    drive(&mut scene, point(body, 1), &[(Component::Rotation, motion)]);
    scene
}

/// A jump of the prescribed rate changes the energy at once. The impulsive work equals this change, and the moment is zero afterwards.
#[test]
fn bodies_joined_to_a_drive_follow_jumps_of_its_rate() {
    let bent = || Schedule::table(vec![(0.0, 0.0), (0.5, 0.0), (1.5, 1.0)]).unwrap();
    let motions = [
        ("angle", PrescribedMotion::Position(bent())),
        ("speed", PrescribedMotion::Rate(Schedule::pulse(0.5, 9.0).unwrap())),
    ];
    for entry in INTEGRATORS {
        for (name, motion) in &motions {
            let simulation = simulate(swung(motion.clone()), entry.method, 0.01, 1.2);
            let history = simulation.history();
            let column = |name: &str| history.column(name).unwrap();
            let what = format!("{} {name}", entry.name);
            let (times, energies) = (column("t"), column("kinetic"));
            let (works, moments) = (column("work"), column("move1.angle"));
            for (row, time) in times.iter().enumerate() {
                let expected = if *time < 0.505 { 0.0 } else { 1.25 };
                let (energy, work) = (energies[row], works[row]);
                assert!((energy - expected).abs() < 2e-3, "{what} {time}: {energy}");
                assert!((work - expected).abs() < 2e-3, "{what} {time}: {work}");
                assert!(moments[row].abs() < 0.5, "{what} {time}: {}", moments[row]);
            }
            if entry.claims.energy == EnergyClaim::Conserved {
                for (name, invariant) in Invariant::ALL {
                    let drift = history.drift(invariant);
                    assert!(drift < 1e-13, "{what} {name}: {drift}");
                }
            }
        }
    }
}

/// A controlled speed jumps before every step, with an impulse each time.
#[test]
fn bodies_joined_to_a_controlled_drive_have_its_speed_in_every_step() {
    let said = Rc::new(Cell::new(0.0));
    let motion = PrescribedMotion::Rate(Schedule::Sampled(Rc::clone(&said)));
    let mut simulation = simulate(swung(motion), Method::EnergyMomentum, 0.01, 0.0);
    for step in 1..=300_u32 {
        let speed = (0.1 * f64::from(step)).sin();
        said.set(speed);
        simulation.run_to(0.01 * f64::from(step), &mut NoMonitor).unwrap();
        let history = simulation.history();
        let kinetic = *history.column("kinetic").unwrap().last().unwrap();
        let expected = 1.25 * speed * speed;
        // The rotation in a step is accurate to second order.
        assert!((kinetic - expected).abs() < 1e-3, "{step}: {kinetic} {expected}");
    }
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-12, "{name}: {drift}");
    }
}

/// A start from an equilibrium with a moving drive equals a start from rest with this drive.
#[test]
fn drives_start_from_an_equilibrium_as_from_a_scene_at_rest() {
    let scene = || {
        let mut scene = swung(PrescribedMotion::Position(function(|t| 0.5 * t)));
        scene.gravity = at(0.0, -1.0);
        scene
    };
    let rest = |loading| Equilibrium::find(scene(), loading, &mut |_| true).unwrap();
    let dynamics = settings(Method::EnergyMomentum, 0.01);
    let mut begun = Simulation::start_at_rest(&rest(Loading::default()), dynamics).unwrap();
    run(&mut begun, 1.0).unwrap();
    let plain = simulate(scene(), Method::EnergyMomentum, 0.01, 1.0);
    for column in ["kinetic", "work", "move1.angle"] {
        let of = |simulation: &Simulation| simulation.history().column(column).unwrap().to_vec();
        for (one, other) in of(&begun).iter().zip(&of(&plain)) {
            assert!((one - other).abs() < 1e-10, "{column}: {one} {other}");
        }
    }

    // A start at a later time continues the drive from its value at this time.
    let later = Loading { time: 2.0, ..Loading::default() };
    let mut on = Simulation::start_at_rest(&rest(later), dynamics).unwrap();
    assert_eq!(on.time(), 2.0);
    run(&mut on, 3.0).unwrap();
    let message = on.rewind(1.0).unwrap_err().to_string();
    assert!(message.contains("the simulation covers t = 2 to 3"), "{message}");
    let history = on.history();
    let times = history.column("t").unwrap();
    assert_eq!((times[0], *times.last().unwrap()), (2.0, 3.0));
    assert!(history.drift(Invariant::Energy) < 1e-11);
    let half = Loading { factor: 0.5, ..later };
    let refused = Simulation::start_at_rest(&rest(half), dynamics).err().unwrap().to_string();
    assert!(
        refused.contains("has 'move1' at 0.5, but its function of time gives 1 at t = 2"),
        "{refused}"
    );
}
