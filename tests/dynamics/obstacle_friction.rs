//! Friction of obstacles: closed forms of sliding, sticking, rolling and belt friction, and refused methods.
#![allow(clippy::unwrap_used)]

use super::obstacles::{assert_balanced, ball, column, disc, position, wall};
use crate::common::{at, scenes, settings, simulate};
use std::f64::consts::PI;
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::Method;
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::Simulation;
use withy::system::{ContactTarget, Obstacle, PointMass, RigidBodyDefinition, Scene, StartMotion};

const GRAVITY: f64 = 9.81;

/// Start speed of the block up the incline.
const SPEED: f64 = 2.0;

/// Block that slides up an incline. The initial normal force is in equilibrium.
fn incline(degrees: f64, friction: f64, stiffness: f64) -> (Scene, Vec2) {
    let angle = degrees.to_radians();
    let (up, normal) = (at(angle.cos(), angle.sin()), at(-angle.sin(), angle.cos()));
    let start = normal * (-GRAVITY * angle.cos() / stiffness);
    let floor = wall(at(0.0, 0.0), normal, stiffness, 0.5);
    let mut scene = ball(start, up * SPEED, Obstacle { friction, ..floor });
    scene.gravity = at(0.0, -GRAVITY);
    (scene, up)
}

/// The block decelerates with `g (sin α + μ cos α)`, and returns if `tan α > μ`.
/// The step that contains the reversal has an error of the velocity of at most `2 μ g cos α dt`.
#[test]
fn block_on_an_incline_agrees_with_the_closed_form() {
    let friction = 0.3;
    for degrees in [30.0_f64, 15.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (climbing, sliding) =
            (GRAVITY * (sin + friction * cos), GRAVITY * (sin - friction * cos));
        let (stop, top) = (SPEED / climbing, SPEED * SPEED / (2.0 * climbing));
        for dt in [0.01, 0.0025] {
            let after = |end: f64| {
                let (scene, up) = incline(degrees, friction, 1e8);
                let simulation = simulate(scene, Method::EnergyMomentum, dt, end);
                assert_balanced(&simulation, 1e-12);
                up.dot(&position(&simulation))
            };
            let climbed = SPEED * 0.25 - 0.5 * climbing * 0.0625;
            assert!((after(0.25) - climbed).abs() < 1e-8, "{degrees}, {dt}");
            let later = top - 0.5 * sliding.max(0.0) * (1.0 - stop).powi(2);
            let largest = 2.0 * friction * GRAVITY * cos * dt;
            assert!((after(1.0) - later).abs() < largest, "{degrees}, {dt}");
        }
    }
}

/// A block that sticks does not move after the vibration of its contact has decayed, at steps of many periods of this vibration.
#[test]
fn a_sticking_block_does_not_creep() {
    let (scene, up) = incline(15.0, 0.3, 1e8);
    let mut simulation = simulate(scene, Method::EnergyMomentum, 0.01, 10.0);
    let place = up.dot(&position(&simulation));
    crate::common::run(&mut simulation, 50.0).unwrap();
    assert!((up.dot(&position(&simulation)) - place).abs() < 1e-13);
    assert_balanced(&simulation, 1e-12);
}

/// A disc of radius `r` that slides with `v` rolls with `2v/3` after the time `v/(3 μ g)`.
#[test]
fn a_sliding_disc_starts_to_roll() {
    let (radius, mass, speed, friction, stiffness) = (0.5, 2.0, 3.0, 0.3, 1e7);
    let mut scene = Scene::new("roller");
    scene.gravity = at(0.0, -GRAVITY);
    let roller = RigidBodyDefinition {
        name: "roller".into(),
        position: at(0.0, radius - mass * GRAVITY / stiffness),
        angle: 0.0,
        points: Vec::new(),
        outline: Vec::new(),
        motion: StartMotion { velocity: at(speed, 0.0), spin: 0.0, centre: None },
    };
    let body = scene.add_rigid_body(roller, mass, 0.5 * mass * radius * radius).unwrap();
    let targets = vec![ContactTarget::Point(Station::on_rigid_body(body, 0))];
    let floor = wall(at(0.0, 0.0), at(0.0, 1.0), stiffness, 0.5);
    scene.add_obstacle(Obstacle { friction, radius, targets, ..floor }).unwrap();
    let rolls = speed / (3.0 * friction * GRAVITY);
    let mut simulation = simulate(scene, Method::EnergyMomentum, 0.005, 0.9 * rolls);
    let travelled = |t: f64| speed * t - 0.5 * friction * GRAVITY * t * t;
    let now = simulation.time();
    assert!((position(&simulation).x - travelled(now)).abs() < 1e-9);
    crate::common::run(&mut simulation, 1.0).unwrap();
    let momentum = simulation.history().samples().last().unwrap().measures.momentum;
    assert!((momentum.x / mass - 2.0 / 3.0 * speed).abs() < 1e-6);
    let lost = mass * speed * speed / 6.0;
    assert!((column(&simulation, "dissipated").last().unwrap() - lost).abs() < 1e-6);
    assert_balanced(&simulation, 1e-12);
}

/// An oblique impact that slips throughout changes the speed along the wall by `μ (1 + e) v_n`.
#[test]
fn oblique_impact_has_the_impulse_of_coulomb_friction() {
    for (friction, restitution) in [(0.1, 0.8), (0.3, 0.5)] {
        let floor = wall(at(0.0, 0.0), at(0.0, 1.0), 1e4, restitution);
        let scene = ball(at(0.0, 0.1), at(4.0, -2.0), Obstacle { friction, ..floor });
        let simulation = simulate(scene, Method::EnergyMomentum, 2e-4, 0.15);
        let momentum = simulation.history().samples().last().unwrap().measures.momentum;
        let normal_impulse = momentum.y + 2.0;
        assert!((momentum.y - 2.0 * restitution).abs() < 2e-3, "{momentum:?}");
        assert!((4.0 - momentum.x - friction * normal_impulse).abs() < 1e-9, "{momentum:?}");
        let friction_force = column(&simulation, "wall.friction");
        assert!(friction_force.iter().all(|force| *force <= 0.0));
    }
}

/// Belt friction (Euler–Eytelwein): a rope over half a peg slips if the ratio of its loads exceeds `exp(μ π)`.
#[test]
fn a_rope_round_a_peg_holds_up_to_the_ratio_of_euler_and_eytelwein() {
    let (friction, radius) = (0.3, 0.5);
    let ratio = (friction * PI).exp();
    let end_speed = |load: f64| {
        let mut scene = Scene::new("capstan");
        let rope = Section {
            axial_stiffness: 2e4,
            shear_stiffness: 1e4,
            bending_stiffness: 2e-3,
            mass_per_length: 1e-2,
            rotary_inertia: 1e-6,
        };
        let axis = Curve::arc(at(0.0, 0.0), radius, PI, 0.0).unwrap();
        let mesh = Mesh::bspline(24, 3, 2).unwrap();
        let beam = scenes::add_beam(&mut scene, axis, &mesh, rope);
        let relaxation = withy::beams::Relaxation { axial: 0.01, ..Default::default() };
        scene.add_damping(beam, relaxation).unwrap();
        let ends = [scenes::start_of(&mut scene, beam), scenes::end_of(&mut scene, beam)];
        for (station, mass) in ends.into_iter().zip([1.0, load]) {
            scene.add_mass(PointMass { station, mass, rotary_inertia: 0.0 }).unwrap();
            let force = at(0.0, -GRAVITY * mass);
            let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
            scene.add_load(kind, Schedule::ramp(0.0, 0.5).unwrap());
        }
        let peg = disc(at(0.0, 0.0), radius, 1e6, 0.3);
        scene.add_obstacle(Obstacle { friction, ..peg }).unwrap();
        let simulation = simulate(scene, Method::EnergyMomentum, 2e-3, 0.7);
        assert_balanced(&simulation, 1e-11);
        let momentum = simulation.history().samples().last().unwrap().measures.momentum;
        momentum.y.abs() / (1.0 + load)
    };
    assert!(end_speed(0.97 * ratio) < 1e-5);
    assert!(end_speed(1.03 * ratio) > 1e-2);
}

#[test]
fn methods_that_reverse_time_are_rejected_with_friction() {
    let (scene, _) = incline(15.0, 0.3, 1e6);
    let refused = Simulation::start(scene, settings(Method::FourthOrder, 0.01)).err().unwrap();
    assert_eq!(
        refused.to_string(),
        "obstacle 'wall' has friction, which the method fourth_order does not support; use the method energy_momentum"
    );
}
