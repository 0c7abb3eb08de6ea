//! Springs whose rest length or rest angle is a function of time, compared with closed forms.
#![allow(clippy::unwrap_used)]

use std::rc::Rc;

use crate::common::{at, orders, run, settings, simulate};
use withy::beams::Station;
use withy::integrators::{INTEGRATORS, Method};
use withy::loads::{PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{
    Anchor, Origin, ParticleDefinition, PrescribedRest, Scene, Spring, SpringKind, SpringLaw,
    StationVelocity,
};

const STIFFNESS: f64 = 18.0;
const DAMPING: f64 = 0.9;
const MASS: f64 = 2.0;
const SPEED: f64 = 0.25;

fn function(of: impl Fn(f64) -> f64 + 'static) -> Schedule {
    Schedule::Function { function: Rc::new(move |t: f64| Ok(of(t))), breaks: Vec::new() }
}

fn particle(scene: &mut Scene, name: &str, x: f64, mass: f64) -> Station {
    let definition = ParticleDefinition { name: name.to_owned(), position: at(x, 0.0) };
    scene.add_particle(definition, mass).unwrap()
}

/// Spring with a damper. Without a prescribed rest length, its rest length is 1.
fn rope(ends: [Anchor; 2], stiffness: f64, rest: Option<PrescribedRest>) -> Spring {
    let natural = if rest.is_some() { 0.0 } else { 1.0 };
    Spring {
        name: "rope".to_owned(),
        kind: SpringKind::Length(ends.to_vec()),
        law: Some(SpringLaw::Linear { stiffness, natural }),
        origin: Origin::Zero,
        damping: DAMPING.into(),
        rest,
    }
}

/// Particle of mass 2 at (1, 0) on a rope from the origin.
fn actuated(rest: Option<PrescribedRest>) -> Scene {
    let mut scene = Scene::new("actuated");
    let load = Anchor::Station(particle(&mut scene, "load", 1.0, MASS));
    let ends = [Anchor::Ground(at(0.0, 0.0)), load];
    scene.add_spring(rope(ends, STIFFNESS, rest)).unwrap();
    scene
}

/// Two particles in free flight, connected by a rope.
fn flying(rest: Option<PrescribedRest>, stiffness: f64) -> Scene {
    let mut scene = Scene::new("flying");
    let stations =
        [particle(&mut scene, "base", 0.0, 3.0), particle(&mut scene, "load", 1.0, MASS)];
    scene.add_spring(rope(stations.map(Anchor::Station), stiffness, rest)).unwrap();
    let (station, velocity) = (stations[1], at(0.2, 0.7));
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    scene
}

fn wound(speed: f64) -> [PrescribedRest; 2] {
    [
        PrescribedRest {
            start: Some(1.0),
            motion: PrescribedMotion::Position(function(move |t| 1.0 - speed * t)),
        },
        PrescribedRest {
            start: None,
            motion: PrescribedMotion::Rate(Schedule::constant(-speed).unwrap()),
        },
    ]
}

fn last(simulation: &Simulation, column: &str) -> f64 {
    *simulation.history().column(column).unwrap().last().unwrap()
}

/// Elongation from the rest length of [`actuated`] and its rate, with a rest length that decreases at a constant speed.
fn stretched(speed: f64, t: f64) -> [f64; 2] {
    let decay = DAMPING / (2.0 * MASS);
    let omega = (STIFFNESS / MASS - decay * decay).sqrt();
    let factor = speed / omega * (-decay * t).exp();
    let (sin, cos) = (omega * t).sin_cos();
    [factor * sin, factor * (omega * cos - decay * sin)]
}

#[test]
fn wound_up_rope_converges_at_the_order_of_the_method() {
    for entry in INTEGRATORS {
        for rest in wound(SPEED) {
            let errors: Vec<f64> = [0.05, 0.025, 0.0125]
                .into_iter()
                .map(|dt| {
                    let scene = actuated(Some(rest.clone()));
                    let simulation = simulate(scene, entry.method, dt, 2.0);
                    let column = |name: &str| simulation.history().column(name).unwrap();
                    let rows = column("t").into_iter().zip(column("rope.length"));
                    let error = |(t, length): (f64, f64)| {
                        (length - (1.0 - SPEED * t) - stretched(SPEED, t)[0]).abs()
                    };
                    rows.map(error).fold(0.0, f64::max)
                })
                .collect();
            let (found, order) = (orders(&errors), f64::from(entry.claims.order));
            println!("{}: {errors:.1?} {found:.2?}", entry.name);
            assert!((found[1] - order).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
        }
    }
}

/// The work of the winch is the integral of its force times its speed.
#[test]
fn work_of_the_actuator_is_the_integral_of_force_times_speed() {
    for rest in wound(SPEED) {
        let simulation = simulate(actuated(Some(rest)), Method::FourthOrder, 0.01, 2.0);
        let power = |t: f64| {
            let [stretch, rate] = stretched(SPEED, t);
            (STIFFNESS * stretch + DAMPING * rate) * SPEED
        };
        let points = 2000;
        let simpson = |at: usize| if at.is_multiple_of(2) { 2.0 } else { 4.0 };
        let step = 2.0 / f64::from(points);
        let inner: f64 = (1..points as usize).map(|at| simpson(at) * power(step * at as f64)).sum();
        let work = (power(0.0) + inner + power(2.0)) * step / 3.0;
        let found = last(&simulation, "work.rope");
        assert!((found - work).abs() < 1e-8 * work, "{found} {work}");
        assert_eq!(found, last(&simulation, "work"));
    }
}

#[test]
fn energy_balance_and_momenta_are_exact_at_any_step_size_and_stiffness() {
    for method in [Method::EnergyMomentum, Method::FourthOrder] {
        for (dt, stiffness) in [(0.01, 18.0), (0.3, 18.0), (0.1, 1e9)] {
            let motion = PrescribedMotion::Position(function(|t| 1.0 + 0.3 * (2.0 * t).sin()));
            let rest = PrescribedRest { start: Some(1.0), motion };
            let scene = flying(Some(rest), stiffness);
            let simulation = simulate(scene, method, dt, 3.0);
            assert!(last(&simulation, "work.rope").abs() > 1e-3);
            for (name, invariant) in Invariant::ALL {
                let drift = simulation.history().drift(invariant);
                assert!(drift < 1e-12, "{name} {method:?} {dt} {stiffness}: {drift}");
            }
        }
    }
}

/// A constant rest length gives the same bits as a spring with this natural length.
#[test]
fn constant_function_equals_a_constant_length() {
    let rest = |motion| Some(PrescribedRest { start: Some(1.0), motion });
    let run = |rest| {
        let simulation = simulate(flying(rest, 18.0), Method::EnergyMomentum, 0.05, 2.0);
        simulation.history().column("rope.force").unwrap().to_vec()
    };
    let constant = run(None);
    let still = Schedule::constant(0.0).unwrap();
    assert_eq!(run(rest(PrescribedMotion::Rate(still))), constant);
    assert_eq!(run(rest(PrescribedMotion::Position(function(|_| 1.0)))), constant);
}

#[test]
fn equilibrium_uses_the_rest_length_at_its_time_and_a_run_continues_from_it() {
    let motion = PrescribedMotion::Position(function(|t| 1.0 + 0.1 * t));
    let mut scene = actuated(Some(PrescribedRest { start: Some(1.0), motion }));
    scene.gravity = at(9.0, 0.0);
    let loading = Loading { time: 2.0, ..Loading::default() };
    let rest = Equilibrium::find(scene, loading, &mut |_| true).unwrap();
    let settings = settings(Method::EnergyMomentum, 0.01);
    let mut simulation = Simulation::start_at_rest(&rest, settings).unwrap();
    assert!((last(&simulation, "rope.length") - 2.2).abs() < 1e-12);
    let length = last(&simulation, "rope.rest_length");
    assert!((length - 1.2).abs() < 1e-14, "{length}");
    run(&mut simulation, 3.0).unwrap();
    // The load starts at rest while the rest length grows with the speed 0.1.
    let expected = 2.3 + stretched(-0.1, 1.0)[0];
    assert!((last(&simulation, "rope.length") - expected).abs() < 1e-5);
    assert!(simulation.history().drift(Invariant::Energy) < 1e-13);
}

#[test]
fn rest_lengths_that_jump_or_become_negative_are_refused() {
    let refused = |motion| {
        let (mut scene, start) = (actuated(None), Some(1.0));
        let mut spring = scene.springs().next().unwrap().clone();
        spring.name = "winch".to_owned();
        spring.rest = Some(PrescribedRest { start, motion });
        scene.add_spring(spring).unwrap_err().to_string()
    };
    let table = vec![(0.0, 1.0), (1.0, 1.0), (1.0, 0.5), (2.0, 0.5)];
    let message = refused(PrescribedMotion::Position(Schedule::table(table).unwrap()));
    assert!(message.contains("it jumps at t = 1 from 1 to 0.5"), "{message}");
    let message =
        refused(PrescribedMotion::Position(function(|t| if t > 0.0 { 2.0 } else { 1.0 })));
    assert!(message.contains("it jumps at t = 0"), "{message}");

    let [_, wound] = wound(1.0);
    let settings = settings(Method::EnergyMomentum, 0.1);
    let mut simulation = Simulation::start(actuated(Some(wound)), settings).unwrap();
    let message = run(&mut simulation, 2.0).unwrap_err().to_string();
    assert!(message.contains("rope: the length without force becomes -0.1"), "{message}");
    assert!((simulation.time() - 1.0).abs() < 1e-12);
}
