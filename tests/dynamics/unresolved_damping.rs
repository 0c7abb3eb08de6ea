//! Damped materials whose relaxation time is not resolved by the steps: section forces compared with those of a rigid rod.
#![allow(clippy::unwrap_used)]

use crate::common::{at, run, scenes, simulate};
use withy::beams::{Mesh, Relaxation, Section};
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{JointKind, Partner};
use withy::simulation::{Simulation, Warning};
use withy::system::{Scene, StartMotion, StationVelocity};

const GRAVITY: f64 = 9.81;
const MASS: f64 = 2.0;
const LENGTH: f64 = 1.5;

/// Hinged rod, released from the horizontal, with relaxation times of 1. Optionally, a heavy free beam moves beside it.
fn rod(beside: bool) -> Scene {
    let mut scene = Scene::new("rod");
    scene.gravity = Vec2::new(0.0, -GRAVITY);
    let section = Section {
        axial_stiffness: 4e5,
        shear_stiffness: 2e5,
        bending_stiffness: 2e3,
        mass_per_length: MASS / LENGTH,
        rotary_inertia: 1e-7,
    };
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let axis = scenes::line(at(0.0, 0.0), at(LENGTH, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
    scene.add_damping(beam, Relaxation { axial: 1.0, shear: 1.0, bending: 1.0 }).unwrap();
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    if beside {
        let axis = scenes::line(at(0.0, 3.0), at(4.0, 3.0));
        let heavy = Section { mass_per_length: 100.0, ..section };
        let other = scenes::add_beam(&mut scene, axis, &mesh, heavy);
        scene.beams[other].motion = StartMotion { velocity: at(9.0, 1.0), spin: 1.0, centre: None };
    }
    scene
}

/// Axial force, shear force and moment at an arc length of a rigid rod that is released from the horizontal, at a rotation `angle`: `θ̈ = 3g/(2L) cos θ` and
/// `θ̇² = 3g/L sin θ`. They balance the part beyond the section.
fn of_a_rigid_rod(angle: f64, s: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let (along, line) = (LENGTH - s, MASS / LENGTH);
    let squares = 0.5 * (LENGTH * LENGTH - s * s);
    let turned = 1.5 * GRAVITY / LENGTH * cosine;
    let axial = line * (GRAVITY * sine * along + 3.0 * GRAVITY / LENGTH * sine * squares);
    let shear = line * (turned * squares - GRAVITY * cosine * along);
    let cubes = 0.5 * LENGTH * LENGTH * along - (LENGTH.powi(3) - s.powi(3)) / 6.0;
    let moment = line * (turned * cubes - 0.5 * GRAVITY * cosine * along * along);
    [axial, shear, moment]
}

/// Largest present deviation of the section forces from those of a rigid rod, relative to the weight (moments: weight times length).
fn off(simulation: &Simulation) -> f64 {
    let tip = *simulation.model().control_points().next().unwrap().last().unwrap();
    let angle = f64::atan2(-tip.y, tip.x);
    let weight = MASS * GRAVITY;
    let mut most = 0.0_f64;
    for sample in simulation.section_forces_along(0).unwrap() {
        let [axial, shear, moment] = of_a_rigid_rod(angle, sample.arc_length);
        let forces = sample.forces;
        let off = [forces.axial - axial, forces.shear - shear, (forces.moment - moment) / LENGTH];
        most = off.into_iter().map(|off| off.abs() / weight).fold(most, f64::max);
    }
    most
}

#[test]
fn rod_that_relaxes_within_a_step_transmits_the_forces_of_a_rigid_rod() {
    for method in INTEGRATORS.iter().map(|entry| entry.method) {
        for beside in [false, true] {
            let mut simulation = simulate(rod(beside), method, 0.01, 0.1);
            let mut most = 0.0_f64;
            while simulation.time() < 1.5 {
                let next = simulation.time() + 0.01;
                run(&mut simulation, next).unwrap();
                most = most.max(off(&simulation));
            }
            println!("{method:?}, {beside}: {most:e}");
            assert!(most < 0.01, "{method:?}: {most}");
        }
    }
}

/// Clamped beam of a material with relaxation times of 1 and an initial tip velocity, optionally beside a heavy free beam.
fn struck(beside: bool) -> Scene {
    let mut scene = rod(beside);
    scene.name = "struck".to_owned();
    scene.joints.clear();
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    let end = scene.station(0, LENGTH).unwrap();
    scene.velocities.push(StationVelocity { station: end, velocity: at(0.0, 1.0), spin: None });
    scene
}

#[test]
fn beam_with_unresolved_motion_is_reported_by_name() {
    let message = |beside: bool, dt: f64| {
        simulate(struck(beside), Method::EnergyMomentum, dt, 0.3).warnings()
    };
    let alone = message(false, 0.01);
    let [Warning::Motion { unresolved_fraction: of_all, .. }] = alone.as_slice() else {
        panic!("{alone:?}")
    };
    let beside = message(true, 0.01);
    let [Warning::Beam { beam, unresolved_fraction: share, dt, period }] = beside.as_slice() else {
        panic!("{beside:?}")
    };
    println!("{}", beside[0]);
    assert_eq!(beam, "beam1");
    // Both warnings measure the same motion in the same way.
    assert!((share - of_all).abs() < 1e-6 && *dt == 0.01, "{share} {of_all}");
    let period = *period;
    // τ ω² h is large although ω h is small: the highest modes decay much faster than any step resolves.
    assert!(period < 0.01, "{period}");
    // The steps resolve the motion without the initial tip velocity.
    assert_eq!(simulate(rod(true), Method::EnergyMomentum, 0.01, 0.3).warnings(), []);
}
