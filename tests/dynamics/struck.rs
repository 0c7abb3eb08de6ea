//! Adaptive steps in impacts on springs and in scenes far from the origin, compared with closed forms.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use crate::common::{at, settings, simulate};
use withy::beams::Station;
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{Components, JointKind, Partner};
use withy::simulation::{Invariant, Simulation, StepControl, Warning};
use withy::system::{
    Anchor, Origin, ParticleDefinition, RigidBodyDefinition, Scene, Spring, SpringKind, SpringLaw,
    StartMotion,
};

const MASS: f64 = 2.0;
const GRAVITY: f64 = 9.81;

fn particle(scene: &mut Scene, position: Vec2, mass: f64) -> Station {
    let name = scene.free_name("particle");
    scene.add_particle(ParticleDefinition { name, position }, mass).unwrap()
}

fn spring(scene: &mut Scene, [from, to]: [Anchor; 2], law: SpringLaw) {
    let (name, kind) = (scene.free_name("spring"), SpringKind::Length(vec![from, to]));
    let (law, origin) = (Some(law), Origin::Zero);
    scene.add_spring(Spring { name, kind, law, origin, damping: 0.0.into(), rest: None }).unwrap();
}

/// Mass that falls from a height onto a linear bumper with its face at y = 1.
fn drop(stiffness: f64, height: f64) -> Scene {
    let mut scene = Scene::new("drop");
    let mass = particle(&mut scene, at(0.0, 1.0 + height), MASS);
    scene.join(JointKind::Support(Components::X), mass, Partner::Ground).unwrap();
    let points = vec![(0.0, -stiffness), (1.0, 0.0), (2.0, 0.0)];
    let anchors = [Anchor::Ground(at(0.0, 0.0)), Anchor::Station(mass)];
    spring(&mut scene, anchors, SpringLaw::Table { points });
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

/// Height of the mass at a time: free fall, and a harmonic motion about the static deflection during contact.
fn height_of_drop(stiffness: f64, height: f64, time: f64) -> f64 {
    let omega = (stiffness / MASS).sqrt();
    let (fall, sag) = ((2.0 * height / GRAVITY).sqrt(), GRAVITY / (omega * omega));
    let speed = GRAVITY * fall;
    let touch = 2.0 * touched(sag, speed, omega);
    let phase = time % (2.0 * fall + touch);
    if phase < fall {
        1.0 + height - 0.5 * GRAVITY * phase * phase
    } else if phase < fall + touch {
        let turned = omega * (phase - fall);
        1.0 - sag + sag * turned.cos() - speed / omega * turned.sin()
    } else {
        let left = 2.0 * fall + touch - phase;
        1.0 + height - 0.5 * GRAVITY * left * left
    }
}

/// Half the duration of a contact, from `q' = 0` of `q = s cos ωt - v/ω sin ωt`.
fn touched(sag: f64, speed: f64, omega: f64) -> f64 {
    (0.25 * TAU + (sag * omega / speed).atan()) / omega
}

fn adaptive(tolerance: f64) -> StepControl {
    StepControl::to(tolerance)
}

fn y(simulation: &Simulation) -> f64 {
    simulation.model().control_points().next().unwrap()[0].y
}

#[test]
fn bounces_on_a_bumper_of_any_stiffness_have_the_right_time() {
    for stiffness in [1e3, 1e6, 1e8, 1e10, 1e12, 1e16] {
        let (mut worst, mut steps, mut most) = (0.0_f64, 0, 0);
        for number in 0..20 {
            let height = 0.2 + 0.03 * f64::from(number);
            let run =
                simulate(drop(stiffness, height), Method::EnergyMomentum, adaptive(1e-4), 2.0);
            let error = (y(&run) - height_of_drop(stiffness, height, 2.0)).abs() / (1.0 + height);
            worst = worst.max(error);
            steps += run.counts().steps;
            most = most.max(run.counts().steps + run.counts().rejected);
        }
        println!(
            "{stiffness:7.0e}: error {worst:.1e}, {steps} steps, at most {most} a run with those rejected"
        );
        assert!(worst < 3e-4 && most < 600, "{stiffness:e}: {worst:e}, {most}");
    }
}

#[test]
fn bounce_on_a_stiff_bumper_has_the_right_time_with_every_method() {
    for entry in INTEGRATORS {
        for stiffness in [1e6, 1e12] {
            let run = simulate(drop(stiffness, 0.36), entry.method, adaptive(1e-3), 1.0);
            let error = (y(&run) - height_of_drop(stiffness, 0.36, 1.0)).abs();
            let counts = run.counts();
            println!(
                "{:18} {stiffness:e}: {error:.1e}, {} steps, {} rejected",
                entry.name, counts.steps, counts.rejected
            );
            // A method with forces at the ends of steps may miss the impact. A warning reports this.
            let is_told = run.warnings().iter().any(|note| matches!(note, Warning::Contact { .. }));
            assert!(error < 6e-3 || is_told, "{}: {error:e}", entry.name);
            assert!(error < 2e-4 || entry.method != Method::EnergyMomentum, "{error:e}");
        }
    }
}

#[test]
fn taut_rope_reverses_the_velocity() {
    for stiffness in [1e8, 1e10, 1e11, 1e12] {
        let mut scene = drop(1.0, 0.5);
        scene.elements.pop();
        scene.particles[0].position = at(0.0, -0.5);
        let points = vec![(0.0, 0.0), (1.0, 0.0), (2.0, stiffness)];
        let anchors = [Anchor::Ground(at(0.0, 0.0)), Anchor::Station(Station::on_particle(0))];
        spring(&mut scene, anchors, SpringLaw::Table { points });
        let run = simulate(scene, Method::EnergyMomentum, adaptive(1e-4), 2.0);
        let exact = height_of_drop(stiffness, 0.5, 2.0) - 2.0;
        println!("{stiffness:e}: {} {exact}, {} steps", y(&run), run.counts().steps);
        assert!((y(&run) - exact).abs() < 3e-4, "{stiffness:e}: {} {exact}", y(&run));
    }
}

/// Mass on a spring that is elongated by 0.2, anchored at a given position.
fn oscillator(place: Vec2) -> Scene {
    let mut scene = Scene::new("oscillator");
    let mass = particle(&mut scene, place + at(1.2, 0.0), 1.0);
    scene.join(JointKind::Support(Components::Y), mass, Partner::Ground).unwrap();
    let law = SpringLaw::Linear { stiffness: 25.0, natural: 1.0 };
    spring(&mut scene, [Anchor::Ground(place), Anchor::Station(mass)], law);
    scene
}

#[test]
fn steps_do_not_depend_on_the_position_of_the_scene() {
    let exact = 1.0 + 0.2 * 30_f64.cos();
    let found = |scene: Scene, place: f64| {
        let run = simulate(scene, Method::EnergyMomentum, adaptive(1e-4), 6.0);
        let x = run.model().control_points().next().unwrap()[0].x - place;
        println!("{place}: {x} {exact}, {} steps", run.counts().steps);
        assert!((x - exact).abs() < 2e-3, "{place}: {x} {exact}");
        run.counts().steps
    };
    let steps = found(oscillator(Vec2::zeros()), 0.0);
    for place in [10.0, 1e3, -1e5] {
        let other = found(oscillator(at(place, 0.0)), place);
        assert!(steps.abs_diff(other) <= 2, "{place}: {steps} {other}");
    }
    let mut beside = oscillator(Vec2::zeros());
    let far = particle(&mut beside, at(1e4, 0.0), 1.0);
    beside.join(JointKind::Support(Components::Position), far, Partner::Ground).unwrap();
    assert_eq!(found(beside, 0.0), steps);
}

#[test]
fn steps_of_a_single_particle_do_not_depend_on_its_position() {
    let steps = |place: f64| {
        let mut scene = Scene::new("throw");
        let mass = particle(&mut scene, at(place, place), 1.0);
        scene.velocities.push(withy::system::StationVelocity {
            station: mass,
            velocity: at(3.0, 4.0),
            spin: None,
        });
        scene.gravity = at(0.0, -GRAVITY);
        simulate(scene, Method::Trapezoidal, adaptive(1e-6), 2.0).counts().steps
    };
    assert_eq!(steps(0.0), steps(1e3));
}

#[test]
fn lengths_and_displacements_due_to_rounding_do_not_reduce_steps() {
    // Mass on a spring whose initial length is a rounding error.
    let mut scene = Scene::new("rounded");
    let mass = particle(&mut scene, at(0.1 + 0.2, 0.0), 1.0);
    let law = SpringLaw::Linear { stiffness: 25.0, natural: 0.0 };
    spring(&mut scene, [Anchor::Ground(at(0.3, 0.0)), Anchor::Station(mass)], law);
    assert_eq!(scene.extent(), 0.0);
    scene.gravity = at(0.0, -1.0);
    let steps = simulate(scene, Method::EnergyMomentum, adaptive(1e-3), 1.0).counts().steps;
    assert!(steps < 500, "{steps}");
    // Mass with a very small start velocity.
    let mut scene = Scene::new("let go");
    let mass = particle(&mut scene, at(0.0, 0.0), 1.0);
    let velocity = at(1e-9, 0.0);
    scene.velocities.push(withy::system::StationVelocity { station: mass, velocity, spin: None });
    scene.gravity = at(0.0, -GRAVITY);
    let steps = simulate(scene, Method::EnergyMomentum, adaptive(1e-3), 1.0).counts().steps;
    assert!(steps < 100, "{steps}");
}

#[test]
fn energy_returned_by_dampers_is_reported_for_the_time_reversing_method() {
    let slowed = |method, dt: f64| {
        let mut scene = Scene::new("slowed");
        let mass = particle(&mut scene, at(0.0, 0.0), 1.0);
        scene.join(JointKind::Support(Components::Y), mass, Partner::Ground).unwrap();
        let velocity = at(1.0, 0.0);
        scene.velocities.push(withy::system::StationVelocity {
            station: mass,
            velocity,
            spin: None,
        });
        let kind = SpringKind::Length(vec![Anchor::Ground(at(-5.0, 0.0)), Anchor::Station(mass)]);
        let (name, origin) = (scene.free_name("damper"), Origin::Zero);
        let damper = Spring { name, kind, law: None, origin, damping: 10.0.into(), rest: None };
        scene.add_spring(damper).unwrap();
        let run = simulate(scene, method, dt, 20.0 * dt);
        run.warnings().iter().any(|note| matches!(note, Warning::EnergyGain { .. }))
    };
    // The backward substep has a pole at λΔt = 3.557. Near it, the motion decays too slowly.
    for dt in [0.32, 0.35, 0.3545, 0.3555, 0.3557, 0.356, 0.37] {
        assert!(slowed(Method::FourthOrder, dt), "{dt}");
    }
    for dt in [0.01, 0.1, 0.3, 0.31, 0.38, 0.5, 5.0] {
        assert!(!slowed(Method::FourthOrder, dt), "{dt}");
    }
    assert!(!slowed(Method::EnergyMomentum, 0.3557));
    assert!(!slowed(Method::GeneralizedAlpha { rho_infinity: 0.5 }, 0.3557));
}

/// Rigid body at rest on two inclined rollers, at a given height.
fn resting(height: f64, directions: [f64; 2]) -> Scene {
    let mut scene = Scene::new("rest");
    let body = RigidBodyDefinition {
        name: "body".to_owned(),
        position: at(0.0, height),
        angle: 0.0,
        points: vec![("p".to_owned(), at(1.0, 0.0)), ("q".to_owned(), at(-1.0, 0.0))],
        outline: Vec::new(),
        motion: StartMotion::default(),
    };
    let body = scene.add_rigid_body(body, 2.0, 0.5).unwrap();
    for (point, rise) in [1, 2].into_iter().zip(directions) {
        let along = at(1.0, rise).normalize();
        let station = Station::on_rigid_body(body, point);
        scene.join(JointKind::InclinedRoller(along), station, Partner::Ground).unwrap();
    }
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

#[test]
fn bodies_at_rest_have_no_drift_and_no_notes() {
    for height in [0.0, -1.0, 5.0] {
        for directions in [[-1.0, 1.0], [1.0, -1.0]] {
            let run = simulate(resting(height, directions), Method::EnergyMomentum, 0.01, 1.0);
            let drift = run.history().drift(Invariant::Energy);
            println!("{height} {directions:?}: {drift:e}");
            assert!(drift < 1e-9, "{height} {directions:?}: {drift:e}");
            assert_eq!(run.warnings(), [], "{height} {directions:?}");
        }
    }
}

fn message(
    scene: Scene,
    method: Method,
    dt: impl Into<withy::simulation::StepSize>,
    end: f64,
) -> Vec<String> {
    let mut run = Simulation::start(scene, settings(method, dt)).unwrap();
    run.run_to(end, &mut withy::simulation::NoMonitor).unwrap();
    run.warnings().iter().map(Warning::to_string).collect()
}

#[test]
fn short_bounce_is_reported_with_its_steps_and_a_remedy() {
    let fixed = message(drop(1e12, 0.36), Method::EnergyMomentum, 1e-3, 0.5);
    assert!(
        fixed[0].contains("steps (dt = 0.001)") && fixed[0].contains("use dt below 0.0002"),
        "{fixed:?}"
    );
    let varying = message(drop(1e16, 0.36), Method::EnergyMomentum, adaptive(1e-3), 0.5);
    println!("{varying:?}");
    assert!(varying[0].contains("use a tolerance below 0.0002"), "{varying:?}");
}

#[test]
fn dissipative_method_is_suggested_where_it_would_help() {
    let stiff = |law| {
        let mut scene = oscillator(Vec2::zeros());
        scene.elements.pop();
        let anchors = [Anchor::Ground(Vec2::zeros()), Anchor::Station(Station::on_particle(0))];
        spring(&mut scene, anchors, law);
        scene
    };
    let line = SpringLaw::Linear { stiffness: 1e6, natural: 1.0 };
    let table = SpringLaw::Table { points: vec![(0.0, -1e6), (1.0, 0.0), (2.0, 1e6)] };
    let proposed = |law: &SpringLaw, method| {
        let message = message(stiff(law.clone()), method, 0.1, 2.0);
        assert!(message[0].contains("steps are too long for the motion"), "{message:?}");
        message[0].contains("energy_decaying")
    };
    assert!(proposed(&line, Method::EnergyMomentum));
    assert!(!proposed(&table, Method::EnergyMomentum));
    assert!(!proposed(&line, Method::EnergyDecaying { chi: 0.01 }));
}
