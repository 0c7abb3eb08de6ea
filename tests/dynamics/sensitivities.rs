//! Derivatives of runs with respect to parameters, compared with closed forms and with differences of exact runs, and their work counts.
#![allow(clippy::unwrap_used)]

use crate::common::steered_scenes::is_steered;
use crate::common::{
    at, body_scenes, release_scenes, run, scenes, settings, simulate, sliding_scenes,
};
use crate::drives::swung_at;
use crate::obstacles::{ball, position, wall};
use withy::beams::{Mesh, SectionVariation};
use withy::integrators::Method;
use withy::joints::SlidingRule;
use withy::loads::{LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{
    DerivativeError, NoMonitor, PerturbedSide, Simulation, SimulationError, StepControl, StepSize,
    Variation,
};
use withy::system::{
    Anchor, Element, Obstacle, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw,
};

const METHODS: [Method; 2] = [Method::EnergyMomentum, Method::FourthOrder];

fn variation(name: &str, distance: f64, scene: impl Fn(f64) -> Scene) -> Variation {
    Variation { name: name.to_owned(), distance, scenes: [scene(distance), scene(-distance)] }
}

/// Particle on a spring from the ground, initially elongated by `stretch`.
fn oscillator(stiffness: f64, mass: f64, stretch: f64) -> Scene {
    let mut scene = Scene::new("oscillator");
    let particle = ParticleDefinition { name: "bead".to_owned(), position: at(2.0 + stretch, 0.0) };
    let bead = scene.add_particle(particle, mass).unwrap();
    let law = Some(SpringLaw::Linear { stiffness, natural: 2.0 });
    let kind = SpringKind::Length(vec![Anchor::Ground(at(0.0, 0.0)), Anchor::Station(bead)]);
    let name = "spring".to_owned();
    let spring = Spring { name, kind, law, origin: Origin::Zero, damping: 0.0.into(), rest: None };
    scene.add_spring(spring).unwrap();
    scene
}

fn bead(simulation: &Simulation) -> f64 {
    simulation.model().control_points().next().unwrap()[0].x
}

#[test]
fn a_mass_on_a_spring_has_the_derivatives_of_its_closed_form() {
    let (stiffness, mass, stretch, dt, steps) = (9.0, 1.3, 0.2, 0.02, 400);
    // Discrete solution of the second-order method: the phase angle θ per step satisfies tan(θ/2) = ω Δt/2.
    let omega = f64::sqrt(stiffness / mass);
    let tangent = 0.5 * omega * dt;
    let angle = 2.0 * tangent.atan();
    let turn = f64::from(steps) * angle;
    let by_omega = -stretch * turn.sin() * f64::from(steps) * dt / (1.0 + tangent * tangent);
    let expected = [by_omega * 0.5 * omega / stiffness, -by_omega * 0.5 * omega / mass, turn.cos()];
    let all = vec![
        variation("k", 1e-4, |by| oscillator(stiffness + by, mass, stretch)),
        variation("m", 1e-5, |by| oscillator(stiffness, mass + by, stretch)),
        variation("stretch", 1e-5, |by| oscillator(stiffness, mass, stretch + by)),
    ];
    let scene = oscillator(stiffness, mass, stretch);
    let settings = settings(Method::EnergyMomentum, dt);
    let mut simulation = Simulation::start_with_derivatives(scene, settings, all).unwrap();
    run(&mut simulation, f64::from(steps) * dt).unwrap();
    assert!((bead(&simulation) - 2.0 - stretch * turn.cos()).abs() < 1e-12);
    for (parameter, expected) in expected.into_iter().enumerate() {
        let found = simulation.derivative(parameter, bead).unwrap();
        println!("{parameter}: {found:.12} and {expected:.12}: {:.1e}", found - expected);
        assert!((found - expected).abs() < 1e-8 * expected.abs().max(0.1), "{parameter}");
    }
}

/// Scene with all bending stiffnesses (0), springs and dampers (1), or loads and gravity (2) multiplied by `1 + by`.
fn scaled(scene: &Scene, what: usize, by: f64) -> Scene {
    let mut scene = scene.clone();
    let factor = 1.0 + by;
    match what {
        0 => {
            for beam in &mut scene.beams {
                if let SectionVariation::Uniform(section) = &mut beam.section {
                    section.bending_stiffness *= factor;
                }
            }
        }
        1 => {
            for beam in &mut scene.beams {
                if let SectionVariation::Uniform(section) = &mut beam.section {
                    section.mass_per_length *= factor;
                    section.axial_stiffness *= factor;
                }
            }
        }
        _ => {
            scene.gravity *= factor;
            for element in &mut scene.elements {
                match element {
                    Element::Load(load) => match &mut load.kind {
                        LoadKind::Force { force, .. } | LoadKind::Line { force, .. } => {
                            *force *= factor;
                        }
                        LoadKind::Moment { moment, .. } => *moment *= factor,
                        #[allow(unreachable_patterns)]
                        _ => (),
                    },
                    Element::Spring(spring) => match &mut spring.law {
                        Some(SpringLaw::Linear { stiffness, .. }) => *stiffness *= factor,
                        Some(SpringLaw::Table { points }) => {
                            points.iter_mut().for_each(|(_, force)| *force *= factor);
                        }
                        _ => (),
                    },
                    Element::PointMass(mass) => mass.mass *= factor,
                    _ => (),
                }
            }
        }
    }
    scene
}

fn places(simulation: &Simulation) -> Vec<f64> {
    simulation.model().control_points().flatten().flat_map(|point| [point.x, point.y]).collect()
}

#[test]
fn derivatives_of_all_scenes_are_those_of_exact_runs() {
    const DT: f64 = 0.02;
    const END: f64 = 0.6;
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let mut compared = 0;
    for method in METHODS {
        let bodies = body_scenes::all(&mesh);
        let sliding = sliding_scenes::all(&mesh, SlidingRule::default());
        let releasing = release_scenes::all(&mesh);
        let all = scenes::all(&mesh).into_iter().chain(bodies).chain(sliding).chain(releasing);
        for scene in all {
            let of = |what: usize| variation("p", 1e-5, |by| scaled(&scene, what, by));
            let start = || {
                Simulation::start_with_derivatives(
                    scene.clone(),
                    settings(method, DT),
                    vec![of(0), of(1), of(2)],
                )
            };
            if is_steered(&scene) {
                let refused = start().map(|_| ()).unwrap_err();
                assert!(
                    matches!(
                        refused,
                        SimulationError::Derivative(DerivativeError::Controlled { .. })
                    ),
                    "{refused}"
                );
                continue;
            }
            let mut simulation = start().unwrap();
            run(&mut simulation, END).unwrap();
            let plain = simulate(scene.clone(), method, DT, END);
            assert_eq!(plain.model().state(), simulation.model().state(), "{}", scene.name);
            assert_eq!(plain.counts().factorisations, simulation.counts().factorisations);
            if let Err(reason) = simulation.perturbed(0, PerturbedSide::Plus) {
                assert!(
                    matches!(reason, DerivativeError::Event { .. }),
                    "{}: {reason}",
                    scene.name
                );
                assert!(scene.releases.is_empty(), "{}: {reason}", scene.name);
                println!("{}: {reason}", scene.name);
                continue;
            }
            for what in 0..3 {
                let exact = |by: f64| places(&simulate(scaled(&scene, what, by), method, DT, END));
                // Central differences with two small increments and Richardson extrapolation, of fourth order.
                let at = |h: f64| -> Vec<f64> {
                    let pairs = exact(h).into_iter().zip(exact(-h));
                    pairs.map(|(plus, minus)| (plus - minus) / (2.0 * h)).collect()
                };
                let h = 5e-5;
                let expected: Vec<f64> =
                    at(h).into_iter().zip(at(2.0 * h)).map(|(a, b)| (4.0 * a - b) / 3.0).collect();
                let [plus, minus] = [PerturbedSide::Plus, PerturbedSide::Minus]
                    .map(|side| places(simulation.perturbed(what, side).unwrap()));
                let found = plus.iter().zip(&minus).map(|(a, b)| (a - b) / 2e-5);
                let largest = expected.iter().fold(1e-3_f64, |most, x| most.max(x.abs()));
                let error = found.zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                println!("{} {what}: {:.1e} of {largest:.1e}", scene.name, error / largest);
                // A piecewise linear law has no derivative at its corners, which some runs pass.
                let near = if scene.name == "absorbed" { 1e-5 } else { 1e-6 };
                assert!(error < near * largest, "{}, {what}: {error:e} of {largest:e}", scene.name);
                compared += 1;
            }
            let counts = simulation.derivative_counts();
            let steps = simulation.counts().steps * 6 * if method == METHODS[1] { 7 } else { 1 };
            println!("{}: {} solves for {steps} steps beside", scene.name, counts.solves);
            // A perturbed run computes its own factorisation only if the existing one does not converge, as in a few steps of a rotating slider.
            assert!(100 * counts.factorisations <= steps, "{}: {counts:?}", scene.name);
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn derivative_needs_no_factorisation_and_few_solves_per_step() {
    let mesh = Mesh::bspline(14, 3, 2).unwrap();
    let scene = scenes::spaghetti(&mesh, 1e4);
    let of = variation("EI", 1e-5, |by| scaled(&scene, 0, by));
    let settings = settings(Method::EnergyMomentum, 0.05);
    let mut simulation =
        Simulation::start_with_derivatives(scene.clone(), settings, vec![of]).unwrap();
    run(&mut simulation, 5.0).unwrap();
    let (counts, steps) = (simulation.derivative_counts(), simulation.counts().steps);
    println!("{} solves in {steps} steps", counts.solves);
    assert_eq!(counts.factorisations, 0);
    assert!(counts.solves <= 10 * steps);
}

#[test]
fn impossible_derivatives_are_rejected_with_a_reason() {
    let plain = oscillator(9.0, 1.0, 0.1);
    let of = || vec![variation("k", 1e-4, |by| oscillator(9.0 + by, 1.0, 0.1))];
    let refused = |scene: Scene, method: Method, dt: StepSize, of: Vec<Variation>| {
        let started = Simulation::start_with_derivatives(scene, settings(method, dt), of);
        match started.map(|_| ()) {
            Err(SimulationError::Derivative(reason)) => reason,
            other => panic!("{other:?}"),
        }
    };
    let reason = refused(plain.clone(), Method::Trapezoidal, 0.1.into(), of());
    assert_eq!(reason, DerivativeError::Method { method: "trapezoidal" });
    let control = StepControl::to(1e-4).into();
    let reason = refused(plain.clone(), Method::EnergyMomentum, control, of());
    assert_eq!(reason, DerivativeError::Adaptive);
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let other = vec![variation("n", 1.0, |_| scenes::spaghetti(&mesh, 1e4))];
    let reason = refused(plain.clone(), Method::EnergyMomentum, 0.1.into(), other);
    assert!(matches!(reason, DerivativeError::Form { .. }), "{reason}");
    let thrown = |until: f64| {
        let schedule = Schedule::hold_for(until).unwrap();
        scenes::thrown(&mesh, scenes::spaghetti_section(1e4, 100.0), schedule, at(0.0, 0.0))
    };
    let times = vec![variation("until", 1e-3, |by| thrown(2.5 + by))];
    let reason = refused(thrown(2.5), Method::EnergyMomentum, 0.1.into(), times);
    assert_eq!(reason, DerivativeError::Times { parameter: "until".to_owned() });
    let mut back =
        Simulation::start_with_derivatives(plain, settings(METHODS[0], 0.1), of()).unwrap();
    back.enable_snapshots(1 << 20);
    run(&mut back, 0.5).unwrap();
    assert!(back.derivative(0, bead).is_ok() && back.derivative(1, bead).is_err());
    back.back(2).unwrap();
    assert!(matches!(back.derivative(0, bead), Err(DerivativeError::NotSupported { .. })));
    back.step(&mut NoMonitor).unwrap();
}

#[test]
fn histories_of_perturbed_runs_have_the_rows_of_the_run() {
    let of = vec![variation("k", 1e-4, |by| oscillator(9.0 + by, 1.0, 0.1))];
    let scene = oscillator(9.0, 1.0, 0.1);
    let mut simulation =
        Simulation::start_with_derivatives(scene, settings(METHODS[0], 0.1), of).unwrap();
    run(&mut simulation, 1.05).unwrap();
    let beside = simulation.perturbed(0, PerturbedSide::Minus).unwrap();
    let times = |of: &Simulation| -> Vec<f64> {
        of.history().samples().iter().map(|row| row.measures.time).collect()
    };
    assert_eq!(times(beside), times(&simulation));
    assert_eq!(simulation.parameters().collect::<Vec<_>>(), [("k", 1e-4)]);
}

/// The kinetic energy jumps to `(I + m r²)/2` at the impulse of a drive. Its derivative with respect to `r` is `m r`.
#[test]
fn impulses_of_drives_act_in_perturbed_runs() {
    let scene = |by: f64| {
        let motion = PrescribedMotion::Rate(Schedule::pulse(0.5, 9.0).unwrap());
        swung_at(1.0 + by, motion)
    };
    for method in METHODS {
        let of = vec![variation("r", 1e-5, scene)];
        let mut simulation =
            Simulation::start_with_derivatives(scene(0.0), settings(method, 0.01), of).unwrap();
        run(&mut simulation, 1.0).unwrap();
        let kinetic =
            |of: &Simulation| of.history().samples().last().unwrap().measures.energy.kinetic;
        let (energy, slope) = (kinetic(&simulation), simulation.derivative(0, kinetic).unwrap());
        assert!((energy - 1.25).abs() < 2e-3, "{energy}");
        assert!((slope - 2.0).abs() < 4e-3, "{slope}");
    }
}

/// Ball that bounces obliquely on a floor with friction. The derivatives equal differences of exact runs and the closed form of the normal motion.
#[test]
fn runs_against_obstacles_have_derivatives() {
    let (dt, end) = (1e-3, 0.6);
    let scene = |stiffness: f64, restitution: f64, friction: f64, height: f64| {
        let floor = wall(at(0.0, 0.0), at(0.0, 1.0), stiffness, restitution);
        let mut scene = ball(at(0.0, height), at(2.0, -1.0), Obstacle { friction, ..floor });
        scene.gravity = at(0.0, -9.81);
        scene
    };
    let at_parameters = |what: usize, by: f64| {
        let mut values = [1e4, 0.7, 0.2, 0.5];
        values[what] += by;
        scene(values[0], values[1], values[2], values[3])
    };
    let distances = [1e-2, 1e-6, 1e-6, 1e-7];
    let names = ["stiffness", "restitution", "friction", "height"];
    let all =
        (0..4).map(|what| variation(names[what], distances[what], |by| at_parameters(what, by)));
    let settings = settings(Method::EnergyMomentum, dt);
    let mut simulation =
        Simulation::start_with_derivatives(at_parameters(0, 0.0), settings, all.collect()).unwrap();
    run(&mut simulation, end).unwrap();
    let plain = simulate(at_parameters(0, 0.0), Method::EnergyMomentum, dt, end);
    assert_eq!(plain.model().state(), simulation.model().state());
    assert!(plain.history().column("wall.force").unwrap().iter().any(|force| *force > 0.0));
    for (what, name) in names.into_iter().enumerate() {
        for component in 0..2 {
            let found = simulation.derivative(what, |run| position(run)[component]).unwrap();
            let exact = |by: f64| {
                position(&simulate(at_parameters(what, by), Method::EnergyMomentum, dt, end))
                    [component]
            };
            let h = distances[what];
            let expected = (exact(h) - exact(-h)) / (2.0 * h);
            println!("{name} {component}: {found} {expected}");
            assert!(
                (found - expected).abs() < 1e-5 * expected.abs().max(1e-3),
                "{name} {component}"
            );
        }
    }
}
