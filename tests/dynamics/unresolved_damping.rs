//! Damped materials that relax long before a step is over: what their sections transmit, beside a rod that is as good as rigid.
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

/// A rod hinged at its start, let go from the horizontal, with relaxation times of a second; beside it, if wanted, something heavy that flies.
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

/// Axial force, shear force and moment of a rigid rod that was let go from the horizontal, at an arc length, where it has turned down by an angle:
/// `θ̈ = 3g/(2L) cos θ`, `θ̇² = 3g/L sin θ`, and what lies beyond moves with the rod.
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

/// How far section forces are from those of a rigid rod, as parts of weight and of weight times length, at the worst place of the present moment.
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
fn a_rod_that_relaxes_within_a_step_transmits_what_a_rigid_one_does() {
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

/// A clamped beam of a material with relaxation times of a second, whose end is struck, alone or beside something heavy that flies.
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
fn a_beam_is_told_whose_own_motion_is_not_followed_whatever_moves_beside_it() {
    let told = |beside: bool, dt: f64| {
        simulate(struck(beside), Method::EnergyMomentum, dt, 0.3).warnings()
    };
    let alone = told(false, 0.01);
    let [Warning::Motion { unresolved_fraction: of_all, .. }] = alone.as_slice() else {
        panic!("{alone:?}")
    };
    let beside = told(true, 0.01);
    let [Warning::Beam { beam, unresolved_fraction: share, dt, period }] = beside.as_slice() else {
        panic!("{beside:?}")
    };
    println!("{}", beside[0]);
    assert_eq!(beam, "beam1");
    // It is the same motion, measured in the same way.
    assert!((share - of_all).abs() < 1e-6 && *dt == 0.01, "{share} {of_all}");
    let period = *period;
    // τ ω² h is large where ω h is small: the rate of the highest modes is far above any step's.
    assert!(period < 0.01, "{period}");
    // What nobody strikes is followed.
    assert_eq!(simulate(rod(true), Method::EnergyMomentum, 0.01, 0.3).warnings(), []);
}
