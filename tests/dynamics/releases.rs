//! Releases during a run: continuous positions and velocities, closed balances, and the later motion of a scene without the released object.
#![allow(clippy::unwrap_used)]

use std::f64::consts::FRAC_PI_2;

use crate::common::body_scenes::{add_body, hinge, point};
use crate::common::release_scenes::{all, chain, release};
use crate::common::scenes::{add_beam, drive, line, rod, start_of};
use crate::common::{at, meshes, orders, run, sci, settings, simulate};
use withy::beams::Mesh;
use withy::integrators::{EnergyClaim, INTEGRATORS, Mechanism, Method};
use withy::joints::{Component, JointKind, Partner, Releasable, Release, Trigger};
use withy::loads::{LoadFrame, LoadKind, Operation, PrescribedMotion, Schedule};
use withy::simulation::{ArchiveError, Invariant, NoMonitor, Simulation, StepControl, StepSize};
use withy::system::{
    Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, System, SystemError,
};

fn mesh() -> Mesh {
    Mesh::bspline(4, 3, 2).unwrap()
}

#[test]
fn claimed_invariants_hold_over_releases() {
    for entry in INTEGRATORS {
        for (name, mesh) in meshes(3) {
            for scene in all(&mesh) {
                let label = format!("{}, {}, {name}", entry.name, scene.name);
                let simulation = simulate(scene, entry.method, 0.02, 0.6);
                let history = simulation.history();
                let drift = |of| history.drift(of);
                let claims = entry.claims;
                if claims.energy == EnergyClaim::Conserved {
                    assert!(
                        drift(Invariant::Energy) < 1e-11,
                        "{label}: {}",
                        drift(Invariant::Energy)
                    );
                }
                if claims.momentum {
                    let momentum = drift(Invariant::Momentum);
                    assert!(momentum < 1e-11, "{label}: {momentum}");
                }
                if claims.angular_momentum {
                    let angular = drift(Invariant::AngularMomentum);
                    assert!(angular < 1e-11, "{label}: {angular}");
                }
                assert!(drift(Invariant::Gap) < 1e-11, "{label}");
            }
        }
    }
}

#[test]
fn states_are_continuous_at_releases() {
    let scene = chain(&mesh());
    let releases: Vec<(f64, Releasable)> =
        scene.release_times().zip(scene.releases.iter().map(|release| release.object)).collect();
    let mut simulation =
        Simulation::start(scene.clone(), settings(Method::EnergyMomentum, 0.02)).unwrap();
    let mut gone: Vec<Releasable> = Vec::new();
    for (time, hold) in releases {
        run(&mut simulation, time).unwrap();
        assert_eq!(simulation.releases().len(), gone.len());
        let mut model = System::assemble(&scene).unwrap();
        model.restore_releases(&scene, &gone).unwrap();
        model.restore(&simulation.model().state());
        let points = |model: &System| model.control_points().flatten().copied().collect::<Vec<_>>();
        let (before, there, unknowns) = (model.measure(), points(&model), model.unknowns());
        model.release(&scene, &gone, hold).unwrap();
        let after = model.measure();
        assert_eq!(points(&model), there);
        assert_eq!(model.unknowns() == unknowns, hold == Releasable::Spring(0));
        assert_eq!(after.momentum, before.momentum);
        assert_eq!(after.angular_momentum, before.angular_momentum);
        let [energy, had] = [after.energy, before.energy];
        assert_eq!((energy.kinetic, energy.strain), (had.kinetic, had.strain));
        let kept = energy.stored + after.dissipated;
        let had = had.stored + before.dissipated;
        assert!((kept - had).abs() <= 1e-15 * had.abs(), "{kept} {had}");
        gone.push(hold);
    }
    run(&mut simulation, 0.5).unwrap();
    assert_eq!(simulation.releases().len(), 5);
    assert_eq!(simulation.model().springs().next().unwrap().stored, 0.0);
}

/// Bead on a massless rotating rigid arm, released during the rotation.
fn sling() -> Scene {
    let mut scene = Scene::new("sling");
    let arm = add_body(&mut scene, at(0.0, 0.0), 0.0, (1.0, 1.0), &[at(2.0, 0.0)]);
    hinge(&mut scene, point(arm, 0), None);
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(2.0, 0.0) };
    let bead = scene.add_particle(bead, 0.5).unwrap();
    hinge(&mut scene, point(arm, 1), Some(bead));
    // 1 - cos 1.5t has zero initial velocity, like the bead.
    let (one, wave) = (Schedule::constant(1.0), Schedule::sine(1.0, 1.5, -FRAC_PI_2));
    let turn = Schedule::combined(Operation::Sum, one.unwrap(), wave.unwrap()).unwrap();
    let turn = PrescribedMotion::Position(turn);
    drive(&mut scene, point(arm, 0), &[(Component::Rotation, turn)]);
    release(&mut scene, Releasable::Joint(1), 0.6);
    release(&mut scene, Releasable::Drive(0), 0.8);
    scene
}

#[test]
fn sling_throws_along_the_tangent_with_second_order_error() {
    let (turn, spin) = (1.0 - 0.9_f64.cos(), 1.5 * 0.9_f64.sin());
    let along = at(-turn.sin(), turn.cos());
    let end = at(turn.cos(), turn.sin()) * 2.0 + along * (2.0 * spin * 0.4);
    let (later, angle) = (1.5 * 1.2_f64.sin(), 1.0 - 1.2_f64.cos());
    for entry in INTEGRATORS {
        let errors: Vec<(f64, f64)> = [0.05, 0.025, 0.0125]
            .into_iter()
            .map(|dt| {
                let simulation = simulate(sling(), entry.method, dt, 1.0);
                let bead = simulation.model().control_points().next().unwrap()[0];
                // After its release, the arm keeps the angular velocity of the motor.
                let turned = simulation.model().section_angle(0).unwrap();
                ((bead - end).norm(), (turned - angle - 0.2 * later).abs())
            })
            .collect();
        let flown: Vec<f64> = errors.iter().map(|error| error.0).collect();
        let found = orders(&flown);
        println!("{:18} {} {found:.2?} {errors:?}", entry.name, sci(&flown));
        // Velocities of points on rigid links are of second order with every method, and so is the velocity of the bead after its release.
        assert!(
            found[1] > f64::from(entry.claims.order.min(2)) - 0.4,
            "{}: {found:.2?}",
            entry.name
        );
        assert!(errors[2].1 < 2e-3, "{}: {errors:?}", entry.name);
    }
}

#[test]
fn released_rod_falls_like_a_free_rod() {
    // Clamps at both ends hold the beam at rest. After the release it equals a free beam in the same state.
    for entry in INTEGRATORS {
        let mut held = Scene::new("shelf");
        let beam = add_beam(&mut held, line(at(0.0, 0.0), at(2.0, 0.0)), &mesh(), rod());
        let mut free = held.clone();
        free.name = "free".to_owned();
        for end in [0.0, 2.0] {
            let station = held.station(beam, end).unwrap();
            held.join(JointKind::Rigid, station, Partner::Ground).unwrap();
        }
        release(&mut held, Releasable::Joint(0), 0.2);
        release(&mut held, Releasable::Joint(1), 0.2);
        let push = |scene: &mut Scene, from: f64| {
            let station = scene.station(beam, 0.5).unwrap();
            let kind = LoadKind::Force { station, force: at(0.3, -1.0), frame: LoadFrame::Dead };
            scene.add_load(kind, Schedule::ramp(from, from + 0.1).unwrap());
        };
        push(&mut held, 0.2);
        push(&mut free, 0.0);
        let one = simulate(held, entry.method, 0.02, 0.8);
        let other = simulate(free, entry.method, 0.02, 0.6);
        let (one, other) = (one.model(), other.model());
        let pairs = one.control_points().flatten().zip(other.control_points().flatten());
        let apart = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{}: {apart}", entry.name);
    }
}

#[test]
fn energy_of_a_released_spring_enters_the_energy_balance() {
    for entry in INTEGRATORS {
        let mut scene = Scene::new("snap");
        let bead = ParticleDefinition { name: "bead".to_owned(), position: at(1.5, 0.0) };
        let bead = scene.add_particle(bead, 2.0).unwrap();
        scene
            .add_spring(Spring {
                name: "spring".to_owned(),
                kind: SpringKind::Length(vec![Anchor::Ground(at(0.0, 0.0)), Anchor::Station(bead)]),
                law: Some(SpringLaw::Linear { stiffness: 8.0, natural: 1.0 }),
                origin: Origin::Zero,
                damping: 0.0.into(),
                rest: None,
            })
            .unwrap();
        release(&mut scene, Releasable::Spring(0), 0.3);
        let simulation = simulate(scene, entry.method, 0.01, 1.0);
        let history = simulation.history();
        let (stored, dissipated) = (history.column("stored"), history.column("dissipated"));
        let (stored, dissipated) = (stored.unwrap(), dissipated.unwrap());
        // The elongation is 0.5 cos 2t.
        let energy = 4.0 * (0.5 * 0.6_f64.cos()).powi(2);
        assert!((stored[30] - energy).abs() < 1e-3, "{}: {}", entry.name, stored[30]);
        assert_eq!(stored[31..].iter().fold(0.0, |a: f64, b| a.max(*b)), 0.0);
        assert_eq!(dissipated[30], 0.0);
        assert!(dissipated[31..].iter().all(|taken| *taken == stored[30]), "{}", entry.name);
        let speed = simulation.model().velocity(&simulation.place(&bead).unwrap()).norm();
        assert!((speed - 0.6_f64.sin()).abs() < 1e-3, "{}: {speed}", entry.name);
    }
}

#[test]
fn steps_of_any_size_end_at_releases() {
    for entry in INTEGRATORS {
        for scene in all(&mesh()) {
            let times: Vec<f64> = scene.release_times().collect();
            let control =
                StepControl { tolerance: 1e-5, first: None, smallest: None, largest: None };
            let simulation = simulate(scene, entry.method, StepSize::Adaptive(control), 0.6);
            let steps: Vec<f64> =
                simulation.history().samples().iter().map(|row| row.measures.time).collect();
            let label = format!("{} {}", entry.name, simulation.scene().name);
            assert!(times.iter().all(|time| steps.contains(time)), "{label}: {times:?}");
            let gone: Vec<f64> = simulation.releases().iter().map(|gone| gone.time).collect();
            assert_eq!(gone, times, "{label}");
        }
    }
}

#[test]
fn forks_and_rewinds_keep_the_state_of_releases() {
    for entry in INTEGRATORS {
        for scene in all(&mesh()) {
            let mut simulation = Simulation::start(scene, settings(entry.method, 0.02)).unwrap();
            simulation.enable_snapshots(1 << 24);
            run(&mut simulation, 0.6).unwrap();
            let (gone, state) = (simulation.releases().to_vec(), simulation.model().state());
            let unknowns = simulation.unknowns();
            let mut fork = simulation.fork().unwrap();
            fork.rewind(0.05).unwrap();
            assert!(fork.releases().is_empty() && fork.unknowns() < unknowns);
            for end in [0.18, 0.6] {
                run(&mut fork, end).unwrap();
            }
            simulation.rewind(0.18).unwrap();
            simulation.run_to(0.6, &mut NoMonitor).unwrap();
            for again in [&simulation, &fork] {
                assert_eq!(again.releases(), gone);
                assert!(again.model().state() == state, "{} {}", entry.name, again.scene().name);
            }
            let mut copy = simulation.copy_at_start().unwrap();
            let rows = simulation.history().samples().len();
            assert!(copy.run_again(&simulation, rows - 1, &mut NoMonitor).unwrap());
            let file = simulation.to_bytes("gone").unwrap();
            let (_, loaded) = Simulation::from_bytes(&file).unwrap();
            assert_eq!((loaded.releases(), loaded.unknowns()), (&gone[..], unknowns));
        }
    }
}

#[test]
fn releases_can_be_triggered_from_outside() {
    let mut scene = Scene::new("asked");
    let beam = add_beam(&mut scene, line(at(0.0, 0.0), at(2.0, 0.0)), &mesh(), rod());
    let start = start_of(&mut scene, beam);
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    scene.gravity = at(0.0, -9.81);
    scene.add_release(Release { object: Releasable::Joint(0), trigger: Trigger::Outside }).unwrap();
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.02)).unwrap();
    run(&mut simulation, 0.2).unwrap();
    assert!(simulation.waits_for_release(0) && simulation.releases().is_empty());
    let stored = simulation.to_bytes("waits");
    assert!(matches!(stored, Err(ArchiveError::Release { name }) if name == "hinge1"));
    simulation.release(0).unwrap();
    simulation.release(0).unwrap();
    assert!(!simulation.waits_for_release(0));
    assert_eq!(simulation.releases().iter().map(|gone| gone.time).collect::<Vec<_>>(), [0.2]);
    assert!(simulation.to_bytes("gone").is_ok());
    run(&mut simulation, 0.4).unwrap();
    assert!(simulation.history().drift(Invariant::Energy) < 1e-12);
}

#[test]
fn impossible_releases_are_rejected() {
    let mut scene = chain(&mesh());
    let refused = |scene: &mut Scene, hold, time| {
        scene.add_release(Release { object: hold, trigger: Trigger::Time(time) }).unwrap_err()
    };
    let message = refused(&mut scene, Releasable::Joint(0), 0.7);
    assert_eq!(
        message.to_string(),
        "'hinge1' already has a release; remove one of the two releases"
    );
    let missing = refused(&mut scene, Releasable::Slider(0), 0.7);
    assert!(matches!(missing, SystemError::Missing { kind: "slider", count: 0, .. }), "{missing}");
    scene.releases.clear();
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let message = refused(&mut scene, Releasable::Drive(0), time);
        assert!(matches!(message, SystemError::Value { name: "at", .. }), "{message}");
    }
}
