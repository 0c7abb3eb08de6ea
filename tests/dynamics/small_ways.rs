//! Springs and dampers whose length passes through zero or changes by a small fraction: closed forms, orders and energy balances.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, point};
use crate::common::scenes::drive;
use crate::common::{Random, at, orders, sci, simulate};
use std::f64::consts::FRAC_PI_2;
use withy::geometry::Vec2;
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::Component;
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Anchor, DampingLaw, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw,
    StationVelocity,
};

const STIFFNESS: f64 = 9.0;
const DAMPING: f64 = 0.5;
const SPEED: f64 = 0.3;
/// Direction of all motion, not parallel to an axis.
const DIRECTION: Vec2 = Vec2::new(0.6, 0.8);

fn spring(kind: SpringKind, law: Option<SpringLaw>, damping: f64) -> Spring {
    let damping = DampingLaw::Linear(damping);
    Spring { name: "spring".to_owned(), kind, law, origin: Origin::Zero, damping, rest: None }
}

/// Particle of mass 1 at a distance of 1 from the anchor of a damper, which moves through the anchor.
fn passing(law: Option<SpringLaw>, damping: f64, velocity: Vec2) -> Scene {
    let mut scene = Scene::new("passing");
    let (name, anchor) = ("bead".to_owned(), at(2.0, -1.0));
    let position = anchor + DIRECTION;
    let station = scene.add_particle(ParticleDefinition { name, position }, 1.0).unwrap();
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    let kind = SpringKind::Length(vec![Anchor::Ground(anchor), Anchor::Station(station)]);
    if law.is_none() {
        let force = DIRECTION * -3.0;
        let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
        scene.add_load(kind, Schedule::constant(1.0).unwrap());
    }
    scene.add_spring(spring(kind, law, damping)).unwrap();
    scene
}

fn place(simulation: &Simulation) -> f64 {
    let point = simulation.model().control_points().next().unwrap()[0];
    (point - at(2.0, -1.0)).dot(&DIRECTION)
}

/// `ẍ + c ẋ + k x = 0` and `ẍ + c ẋ = -3`, both with x(0) = 1 and a start velocity. The motions pass the anchor three times and once.
#[test]
fn damper_through_its_anchor_converges_at_the_order_of_the_method() {
    let end = 4.0;
    let central = SpringLaw::Linear { stiffness: STIFFNESS, natural: 0.0 };
    let half = 0.5 * DAMPING;
    let omega = (STIFFNESS - half * half).sqrt();
    let (sin, cos) = (omega * end).sin_cos();
    let swings = (-half * end).exp() * (cos + (SPEED + half) / omega * sin);
    let limit = -3.0 / DAMPING;
    let drawn = 1.0 + limit * end + (SPEED - limit) / DAMPING * (1.0 - (-DAMPING * end).exp());
    let line = vec![(-2.0, -2.0 * STIFFNESS), (2.0, 2.0 * STIFFNESS)];
    let table = SpringLaw::Table { points: line };
    for (law, expected) in [(Some(central), swings), (Some(table), swings), (None, drawn)] {
        for entry in INTEGRATORS {
            let error = |dt: f64| {
                let scene = passing(law.clone(), DAMPING, DIRECTION * SPEED);
                (place(&simulate(scene, entry.method, dt, end)) - expected).abs()
            };
            let errors = [0.04, 0.02, 0.01].map(error);
            let found = orders(&errors);
            println!("{:18} {} {found:.2?}", entry.name, sci(&errors));
            // No strains occur that numerical damping could act on.
            let expected = match entry.claims.energy {
                EnergyClaim::NonIncreasing => 2.0,
                _ => f64::from(entry.claims.order),
            };
            assert!((found[1] - expected).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
        }
    }
}

/// Independent of the minimum distance and of the damping coefficient.
#[test]
fn damper_passing_near_its_anchor_keeps_the_energy_balance() {
    let mut random = Random(17);
    for (damping, velocity) in [(0.5, 3.0), (20.0, 40.0), (1e6, 1.0), (1e12, 1.0)] {
        for law in [None, Some(SpringLaw::Linear { stiffness: STIFFNESS, natural: 0.0 })] {
            for _ in 0..6 {
                let aside = at(-DIRECTION.y, DIRECTION.x) * (0.02 * random.next());
                let velocity = (aside - DIRECTION) * velocity;
                let scene = passing(law.clone(), damping, velocity);
                let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 1.0);
                for (name, invariant) in Invariant::ALL {
                    let drift = simulation.history().drift(invariant);
                    assert!(drift < 1e-12, "{name} of {damping}, {velocity}: {drift:.1e}");
                }
                let taken = simulation.history().column("dissipated").unwrap();
                let all = taken.last().unwrap();
                let falls = taken.windows(2).map(|pair| pair[0] - pair[1]).fold(0.0, f64::max);
                assert!(falls <= 1e-15 * all, "{falls} of {all}");
            }
        }
    }
}

/// Body with the prescribed motion `a sin 5t` at the end of a spring and of a torsion spring with an initial angle of 90°.
fn driven_by_little(stiffness: f64, amplitude: f64) -> Scene {
    let mut scene = Scene::new("foot");
    let foot = add_body(&mut scene, at(7.0, 2.0), FRAC_PI_2, (1e-3, 1e-3), &[]);
    let station = point(foot, 0);
    let motion = || {
        let schedule = Schedule::Sine { amplitude, rate: 5.0, phase: 0.0 };
        PrescribedMotion::Position(schedule)
    };
    drive(&mut scene, station, &[(Component::X, motion()), (Component::Rotation, motion())]);
    let law = SpringLaw::Linear { stiffness, natural: 6.0 };
    let ends = |ground: Vec2| [Anchor::Ground(ground), Anchor::Station(station)];
    let way = SpringKind::Length(ends(at(1.0, 2.0)).to_vec());
    scene.add_spring(spring(way, Some(law), 0.0)).unwrap();
    let law = SpringLaw::Linear { stiffness, natural: FRAC_PI_2 };
    let torsion = SpringKind::Torsion(ends(at(0.0, 0.0)));
    let torsion = Spring { name: "torsion".to_owned(), ..spring(torsion, Some(law), 0.0) };
    scene.add_spring(torsion).unwrap();
    scene
}

/// The work of a drive on a spring is complete in the energy balance, for amplitudes from 1e-2 to 1e-10 of the length of the spring.
#[test]
fn spring_with_small_displacement_keeps_the_energy_balance() {
    for stiffness in [1e-6, 1.0, 1e12] {
        for amplitude in [1e-2, 1e-6, 1e-10] {
            let scene = driven_by_little(stiffness, amplitude);
            let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 1.0);
            let label = format!("stiffness {stiffness:e}, amplitude {amplitude:e}");
            let history = simulation.history();
            let drift = history.drift(Invariant::Energy);
            assert!(drift < 1e-14, "{label}: {drift:.1e}");
            // Each spring stores ½ k a² sin². The tolerance allows for rounding of the position.
            let expected = stiffness * (amplitude * 5.0_f64.sin()).powi(2);
            let stored = *history.column("stored").unwrap().last().unwrap();
            assert!((stored / expected - 1.0).abs() < 1e-5, "{label}: {stored} {expected}");
        }
    }
}
