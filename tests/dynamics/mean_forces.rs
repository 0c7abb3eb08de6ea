//! Mean reactions of joints and supports in a step. Together with the loads they equal the changes of the momenta.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, hinge, point};
use crate::common::roller_scenes::unit;
use crate::common::scenes::{add_beam, drive, end_of, line, rod, start_of};
use crate::common::steered_scenes::is_steered;
use crate::common::{
    at, body_scenes, is_damped, orders, run, scenes, sci, settings, simulate, sliding_scenes,
};
use withy::beams::{Mesh, Station};
use withy::geometry::{Vec2, cross};
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{Component, Components, JointKind, Partner, SlidingRule};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{NoMonitor, Simulation, SimulationError};
use withy::system::Scene;

const PUSH: Vec2 = Vec2::new(3.0, -5.0);

fn mesh() -> Mesh {
    Mesh::bspline(4, 3, 2).unwrap()
}

/// Records the mean reactions of all joints.
fn listening(mut scene: Scene) -> Scene {
    for joint in scene.joint_names() {
        ["force", "fx", "fy", "moment"]
            .iter()
            .for_each(|quantity| scene.record(&format!("{joint}.{quantity}")).unwrap());
    }
    scene
}

/// Two beams with the given support and joint, loaded at the end.
fn two_beams(held: JointKind, joint: JointKind) -> (Scene, Station) {
    let mut scene = Scene::new(format!("{held:?}, {joint:?}"));
    let first = add_beam(&mut scene, line(at(0.5, 0.2), at(1.5, 0.2)), &mesh(), rod());
    let second = add_beam(&mut scene, line(at(1.5, 0.2), at(2.2, 0.9)), &mesh(), rod());
    let (foot, top) = (start_of(&mut scene, first), end_of(&mut scene, first));
    let (next, tip) = (start_of(&mut scene, second), end_of(&mut scene, second));
    scene.join(held, foot, Partner::Ground).unwrap();
    scene.join(joint, top, Partner::Station(next)).unwrap();
    (scene, tip)
}

/// Pinned rigid body with a beam and another rigid body pinned to it.
fn pinned_bodies() -> (Scene, Station) {
    let mut scene = Scene::new("rigid bodies on pins");
    let points = [at(-0.5, 0.1), at(0.6, 0.2), at(0.0, -0.4)];
    let one = add_body(&mut scene, at(1.0, 0.3), 0.2, (2.0, 0.4), &points);
    hinge(&mut scene, point(one, 1), None);
    let corner = scene.drawn_at(&point(one, 2)).unwrap();
    let beam = add_beam(&mut scene, line(corner, corner + at(1.0, 0.1)), &mesh(), rod());
    let (start, tip) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Rigid, start, Partner::Station(point(one, 2))).unwrap();
    let below = scene.drawn_at(&point(one, 3)).unwrap();
    let two = add_body(&mut scene, below - at(0.0, 0.5), 0.0, (1.0, 0.1), &[at(0.0, 0.5)]);
    hinge(&mut scene, point(two, 1), Some(point(one, 3)));
    (scene, tip)
}

/// Beam with a prescribed motion of its foot, a second beam joined to its end, and a roller support.
fn driven() -> (Scene, Station) {
    let (mut scene, tip) = two_beams(JointKind::Support(Components::Rotation), JointKind::Hinge);
    let foot = scene.joints[0].station;
    let way = |amplitude| Schedule::Sine { amplitude, rate: 2.0, phase: 0.0 };
    let given = [
        (Component::X, PrescribedMotion::Position(way(0.2))),
        (Component::Y, PrescribedMotion::Rate(way(0.4))),
    ];
    drive(&mut scene, foot, &given);
    scene.name = "driven".into();
    (scene, tip)
}

fn pushed() -> Vec<(Scene, Station)> {
    let roller = JointKind::Support(Components::Y);
    let mut scenes = vec![
        two_beams(JointKind::Hinge, JointKind::Hinge),
        two_beams(JointKind::Rigid, JointKind::Rigid),
        two_beams(JointKind::Rigid, JointKind::Hinge),
        two_beams(roller, JointKind::Rigid),
        two_beams(JointKind::InclinedRoller(unit(0.6)), JointKind::Rigid),
        two_beams(JointKind::InclinedGuide(unit(-1.1)), JointKind::Hinge),
        pinned_bodies(),
        driven(),
    ];
    for (scene, tip) in &mut scenes {
        let load = LoadKind::Force { station: *tip, force: PUSH, frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
    }
    scenes
}

#[test]
fn mean_reactions_and_loads_change_the_momenta() {
    for entry in INTEGRATORS.iter().filter(|entry| entry.claims.momentum) {
        let mut worst = [0.0_f64; 2];
        for (scene, tip) in pushed() {
            let label = format!("{}, {}", scene.name, entry.name);
            let is_driven = !scene.drives.is_empty();
            let joints = scene.joints.iter();
            let held = joints.filter(|joint| joint.partner == Partner::Ground);
            let held: Vec<Station> = held.map(|joint| joint.station).collect();
            let scene = listening(scene);
            let mut simulation = Simulation::start(scene, settings(entry.method, 0.02)).unwrap();
            let places = held.iter().chain([&tip]);
            let places: Vec<_> = places.map(|place| simulation.place(place).unwrap()).collect();
            // Before the first step, the means are the present reactions.
            let now = simulation.instant().unwrap();
            let model = simulation.model();
            assert_eq!(&model.mean_reactions().unwrap(), now.reactions(), "{label}");
            for step in 0..40 {
                let before: Vec<Vec2> =
                    places.iter().map(|place| simulation.model().position(place)).collect();
                let begun = simulation.history().samples().last().unwrap().measures;
                simulation.step(&mut NoMonitor).unwrap();
                let ended = simulation.history().samples().last().unwrap().measures;
                let dt = ended.time - begun.time;
                let model = simulation.model();
                let given = model.mean_reactions().unwrap();
                let (mut force, mut moment, mut size) = (Vec2::zeros(), 0.0, 1.0);
                // The drive acts at the first station only.
                for drive in 0..simulation.scene().drives.len() {
                    let drive = model.drive(drive);
                    let (by, _) = model.reaction(&given, &places[0]).unwrap();
                    assert!((drive.force - by).norm() < 1e-9 * (1.0 + by.norm()), "{label}");
                }
                for (place, before) in places.iter().zip(before) {
                    let middle = (before + model.position(place)) * 0.5;
                    let (by, turning) = model.reaction(&given, place).unwrap_or((PUSH, 0.0));
                    force += by;
                    moment += cross(middle, by) + turning;
                    size += by.norm() + turning.abs();
                }
                let change = (ended.momentum - begun.momentum) / dt;
                let off = (change - force).norm() / size;
                worst[0] = worst[0].max(off);
                assert!(off < 2e-11, "{label}, step {step}: {change} {force}");
                // Substeps have different midpoints, and the displacement of a driven point differs from its mean velocity times the step.
                if entry.claims.angular_momentum
                    && entry.method != Method::FourthOrder
                    && !is_driven
                {
                    let change = (ended.angular_momentum - begun.angular_momentum) / dt;
                    let off = (change - moment).abs() / size;
                    worst[1] = worst[1].max(off);
                    assert!(off < 2e-11, "{label}, step {step}: {change} {moment}");
                }
            }
        }
        println!("{:16} Δp/Δt off by {:.1e}, ΔL/Δt by {:.1e}", entry.name, worst[0], worst[1]);
    }
}

#[test]
fn means_of_a_very_short_step_are_the_forces_at_its_ends() {
    let short = 1e-6;
    let lets_go = |scene: &Scene| {
        is_steered(scene) || is_damped(scene) || scene.release_times().any(|time| time == 0.4)
    };
    let mut joints = 0;
    for scene in scenes::all(&mesh()).into_iter().filter(|scene| !lets_go(scene)) {
        let name = scene.name.clone();
        let count = scene.joints.len();
        let methods = INTEGRATORS.iter().filter(|entry| entry.claims.momentum);
        for method in methods.map(|entry| entry.method) {
            let mut simulation = simulate(listening(scene.clone()), method, 0.02, 0.4);
            let read = |simulation: &mut Simulation| -> Vec<(Vec2, f64)> {
                let now = simulation.instant().unwrap();
                let model = simulation.model();
                let force = |joint| {
                    model.transmission(simulation.scene(), joint).unwrap().read(now.reactions())
                };
                (0..count).map(force).collect()
            };
            let before = read(&mut simulation);
            run(&mut simulation, 0.4 + short).unwrap();
            let after = read(&mut simulation);
            let Some(given) = simulation.model().mean_reactions() else { continue };
            for joint in 0..count {
                let transmission =
                    simulation.model().transmission(simulation.scene(), joint).unwrap();
                let (force, moment) = transmission.read(&given);
                let ((f0, m0), (f1, m1)) = (before[joint], after[joint]);
                let scale = 1.0 + f0.norm() + m0.abs();
                let off = (force - (f0 + f1) * 0.5).norm() + (moment - 0.5 * (m0 + m1)).abs();
                assert!(
                    off < 2e-5 * scale,
                    "{name}, {method:?}, {joint}: {force} {f0} {f1}, {moment} {m0} {m1}"
                );
                joints += 1;
            }
        }
    }
    assert!(joints > 50, "{joints}");
}

/// Velocities of points of rigid bodies are of second order at the ends of steps. Changes of the step size would disturb them, so steps are constant.
#[test]
fn mean_forces_between_rigid_bodies_agree_with_end_forces_at_second_order() {
    for scene in [body_scenes::pendulum(0.2, 0.6, 0.8), body_scenes::double_pendulum()] {
        let joint = scene.joints.len() - 1;
        let errors = [0.01, 0.005, 0.0025].map(|dt| {
            let scene = listening(scene.clone());
            let mut simulation = Simulation::start(scene, settings(Method::default(), dt)).unwrap();
            let joint = simulation.model().transmission(simulation.scene(), joint).unwrap();
            let mut before = joint.read(simulation.instant().unwrap().reactions()).0;
            let mut worst = 0.0_f64;
            while simulation.time() < 0.5 - 0.1 * dt {
                simulation.step(&mut NoMonitor).unwrap();
                let after = joint.read(simulation.instant().unwrap().reactions()).0;
                let mean = joint.read(&simulation.model().mean_reactions().unwrap()).0;
                worst = worst.max((mean - (before + after) * 0.5).norm());
                before = after;
            }
            worst
        });
        println!("{}: {} {:.2?}", scene.name, sci(&errors), orders(&errors));
        assert!(orders(&errors).iter().all(|order| *order > 1.8), "{}: {errors:?}", scene.name);
    }
}

#[test]
fn accumulating_mean_forces_changes_no_bit_of_the_motion() {
    let sliding = sliding_scenes::all(&mesh(), SlidingRule::Kinked);
    let all = scenes::all(&mesh()).into_iter().chain(body_scenes::all(&mesh())).chain(sliding);
    for scene in all {
        for entry in INTEGRATORS.iter().filter(|entry| entry.claims.momentum) {
            let rows = |scene: Scene| {
                let simulation = simulate(scene, entry.method, 0.02, 0.2);
                let points: Vec<_> =
                    simulation.model().control_points().flatten().copied().collect();
                format!("{:?} {points:?}", simulation.history().samples())
            };
            let label = format!("{}, {}", scene.name, entry.name);
            assert_eq!(rows(scene.clone()), rows(listening(scene.clone())), "{label}");
        }
    }
}

#[test]
fn methods_without_mean_forces_are_rejected() {
    let (scene, _) = two_beams(JointKind::Hinge, JointKind::Hinge);
    let method = Method::GeneralizedAlpha { rho_infinity: 0.8 };
    let refused = Simulation::start(listening(scene), settings(method, 0.02)).err().unwrap();
    assert!(matches!(refused, SimulationError::NoMeanForces { .. }), "{refused}");
}
