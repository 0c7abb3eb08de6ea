//! Springs, dampers and tendons compared with closed forms, at any stiffness, with every integrator.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use crate::common::{at, orders, scenes, simulate};
use withy::beams::{Mesh, Section};
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::{JointKind, Partner};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, StartMotion,
    StationVelocity,
};

const NATURAL: f64 = 1.0;

fn linear(stiffness: f64, natural: f64) -> Option<SpringLaw> {
    Some(SpringLaw::Linear { stiffness, natural })
}

fn add(scene: &mut Scene, anchors: Vec<Anchor>, law: Option<SpringLaw>, damping: f64) {
    scenes::spring(scene, SpringKind::Length(anchors), law, damping);
}

/// Mass of 2 on a spring along x, elongated by `stretch`, with a parallel damper.
fn oscillator(stiffness: f64, damping: f64, stretch: f64) -> Scene {
    let mut scene = Scene::new("oscillator");
    let position = at(5.0 + NATURAL + stretch, 3.0);
    let bead = ParticleDefinition { name: "bead".to_owned(), position };
    let bead = Anchor::Station(scene.add_particle(bead, 2.0).unwrap());
    let ground = Anchor::Ground(at(5.0, 3.0));
    add(&mut scene, vec![ground, bead], linear(stiffness, NATURAL), damping);
    scene
}

fn place(simulation: &Simulation) -> f64 {
    simulation.model().control_points().next().unwrap()[0].x - 5.0 - NATURAL
}

/// `x(t)` of `m ẍ + c ẋ + k x = 0` with `x(0) = a` and zero velocity, below critical damping.
fn damped(a: f64, (m, c, k): (f64, f64, f64), t: f64) -> f64 {
    let decay = c / (2.0 * m);
    let omega = (k / m - decay * decay).sqrt();
    a * (-decay * t).exp() * ((omega * t).cos() + decay / omega * (omega * t).sin())
}

#[test]
fn damped_oscillator_converges_at_the_order_of_the_method() {
    let (k, c, end) = (18.0, 0.9, 5.0);
    for entry in INTEGRATORS {
        let errors: Vec<f64> = [0.05, 0.025, 0.0125]
            .into_iter()
            .map(|dt| {
                let simulation = simulate(oscillator(k, c, 0.3), entry.method, dt, end);
                (place(&simulation) - damped(0.3, (2.0, c, k), end)).abs()
            })
            .collect();
        let expected = f64::from(entry.claims.order);
        let found = orders(&errors);
        println!("{}: {errors:?} {found:?}", entry.name);
        assert!((found[1] - expected).abs() < 0.2, "{}: {errors:?} {found:?}", entry.name);
    }
}

/// Particle at (1, 0) on a damper to the origin, with an optional parallel spring.
fn turning(velocity: (f64, f64), law: Option<SpringLaw>) -> Scene {
    let mut scene = Scene::new("turning");
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(1.0, 0.0) };
    let bead = scene.add_particle(bead, 1.0).unwrap();
    let velocity = at(velocity.0, velocity.1);
    scene.velocities.push(StationVelocity { station: bead, velocity, spin: None });
    add(&mut scene, vec![Anchor::Ground(at(0.0, 0.0)), Anchor::Station(bead)], law, 1.0);
    scene
}

/// Position of the particle of [`turning`] at t = 1, by the classical Runge–Kutta method.
fn turned((u, v): (f64, f64), stiffness: f64) -> [f64; 2] {
    let rate = |[x, y, u, v]: [f64; 4]| {
        let length = (x * x + y * y).sqrt();
        let force = stiffness * (length - NATURAL) + (x * u + y * v) / length;
        [u, v, -force * x / length, -force * y / length]
    };
    let (dt, mut state) = (1e-3, [1.0, 0.0, u, v]);
    let ahead = |state: [f64; 4], rate: [f64; 4], by: f64| {
        std::array::from_fn(|at| state[at] + by * rate[at])
    };
    for _ in 0..1000 {
        let first = rate(state);
        let second = rate(ahead(state, first, 0.5 * dt));
        let third = rate(ahead(state, second, 0.5 * dt));
        let fourth = rate(ahead(state, third, dt));
        for at in 0..4 {
            state[at] += dt / 6.0 * (first[at] + 2.0 * (second[at] + third[at]) + fourth[at]);
        }
    }
    [state[0], state[1]]
}

#[test]
fn rotating_damper_converges_at_the_order_of_the_method() {
    let starts = [((0.0, 1.0), None), ((0.7, 1.0), None), ((0.7, 1.0), Some(20.0))];
    for entry in INTEGRATORS {
        for (start, stiffness) in starts {
            let exact = turned(start, stiffness.unwrap_or(0.0));
            let errors: Vec<f64> = [0.04, 0.02, 0.01]
                .into_iter()
                .map(|dt| {
                    let law = stiffness.and_then(|stiffness| linear(stiffness, NATURAL));
                    let simulation = simulate(turning(start, law), entry.method, dt, 1.0);
                    let found = simulation.model().control_points().next().unwrap()[0];
                    (found - at(exact[0], exact[1])).norm()
                })
                .collect();
            let expected = f64::from(entry.claims.order);
            let found = orders(&errors);
            println!("{} {start:?} {stiffness:?}: {errors:.1?} {found:.2?}", entry.name);
            // The strains are zero, so numerical damping has no effect and the first-order method is of second order.
            assert!(found[1] > expected - 0.3, "{}: {errors:?} {found:?}", entry.name);
        }
    }
}

#[test]
fn springs_without_effect_are_rejected() {
    let mut scene = Scene::new("idle");
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let axis = scenes::line(at(0.0, 0.0), at(2.0, 0.0));
    let rod = scenes::add_beam(&mut scene, axis, &mesh, scenes::spaghetti_section(1e4, 100.0));
    let [start, end] = [0.0, 2.0].map(|s| Anchor::Station(scene.station(rod, s).unwrap()));
    let ground = |x: f64| Anchor::Ground(at(x, 0.0));
    let spring = |kind: SpringKind| {
        let (name, law) = ("idle".to_owned(), linear(1.0, 1.0));
        Spring { name, kind, law, origin: Origin::Zero, damping: 0.0.into(), rest: None }
    };
    for (kind, why) in [
        (SpringKind::Length(vec![end, end]), "which is the same place"),
        (SpringKind::Length(vec![ground(0.0), ground(1.0)]), "which are both on the ground"),
        (SpringKind::Length(vec![ground(0.0), end, end]), "which is the same place"),
        (SpringKind::Torsion([end, end]), "which is the same place"),
        (SpringKind::Torsion([ground(0.0), ground(1.0)]), "which are both on the ground"),
    ] {
        let error = scene.add_spring(spring(kind)).unwrap_err().to_string();
        assert!(
            error.contains(why) && error.contains(" from ") && error.contains(" to "),
            "{error}"
        );
    }
    assert_eq!(scene.springs().count(), 0);
    // A rope over pulleys on the ground and a rope that returns to its start are valid.
    scene.add_spring(spring(SpringKind::Length(vec![ground(0.0), ground(1.0), end]))).unwrap();
    let there_and_back = SpringKind::Length(vec![end, start, end]);
    scene.add_spring(Spring { name: "back".to_owned(), ..spring(there_and_back) }).unwrap();
}

#[test]
fn energy_balance_includes_increasing_dissipation_of_dampers() {
    for entry in INTEGRATORS {
        let simulation = simulate(oscillator(18.0, 0.9, 0.3), entry.method, 0.11, 20.0);
        let history = simulation.history();
        let column = history.column("dissipated").unwrap();
        let stored = history.column("stored").unwrap();
        assert!(stored[0] > 0.8 && column[0] == 0.0);
        let last = *column.last().unwrap();
        // The damper dissipates the whole energy if the method conserves energy.
        let error = (last / (0.5 * 18.0 * 0.09) - 1.0).abs();
        if entry.claims.energy == EnergyClaim::Conserved {
            assert!(history.drift(Invariant::Energy) < 1e-14, "{}", entry.name);
            assert!(error < 2e-4, "{}: {error:.1e}", entry.name);
            assert!(column.windows(2).all(|pair| pair[1] >= pair[0]), "{}", entry.name);
        }
        // Energy-decaying methods also damp the spring.
        if entry.claims.energy == EnergyClaim::NonIncreasing {
            assert!(history.drift(Invariant::Energy) > 1e-6, "{}", entry.name);
        }
    }
}

/// Free beam with a spring between its ends and another one between interior points.
fn braced(stiffness: f64, damping: f64) -> Scene {
    let mut scene = Scene::new("braced");
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let section = scenes::spaghetti_section(1e4, 100.0);
    let beam =
        scenes::add_beam(&mut scene, scenes::line(at(1.0, 2.0), at(4.0, 6.0)), &mesh, section);
    scene.beams[beam].motion =
        StartMotion { velocity: at(3.0, -1.0), spin: 1.5, centre: Some(at(1.0, 1.0)) };
    let places = [0.0, 1.2, 3.9, 5.0].map(|s| Anchor::Station(scene.station(beam, s).unwrap()));
    add(&mut scene, vec![places[0], places[3]], linear(stiffness, 5.0), damping);
    add(&mut scene, vec![places[1], places[2]], linear(0.3 * stiffness, 2.7), damping);
    scene
}

#[test]
fn stiff_springs_and_dampers_keep_energy_balance_without_more_iterations() {
    // EA = 1e4, so the stiffness of the springs is 1e-6 to 1e12 of it.
    for stiffness in [1e-2, 1e4, 1e10, 1e16] {
        for damping in [0.0, 1.0, 1e6] {
            let label = format!("stiffness {stiffness:e}, damping {damping:e}");
            let simulation =
                simulate(braced(stiffness, damping), Method::EnergyMomentum, 0.05, 5.0);
            let history = simulation.history();
            let drifts: Vec<f64> =
                Invariant::ALL.iter().map(|(_, invariant)| history.drift(*invariant)).collect();
            let work = simulation.counts();
            let iterations = work.newton_iterations as f64 / work.steps as f64;
            println!("{label}: {} {iterations:.2} {}", crate::common::sci(&drifts), work.retries);
            assert!(drifts.iter().all(|drift| *drift < 1e-12), "{label}: {drifts:?}");
            assert!(iterations < 5.0 && work.retries == 0, "{label}: {iterations}");
        }
    }
}

/// Pendulum of length 1 whose rod is a spring. Its stiffness is 1e12 times the weight at its end per length.
fn on_a_stiff_spring() -> Scene {
    let mut scene = Scene::new("pendulum");
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(1.0, 0.0) };
    let bead = Anchor::Station(scene.add_particle(bead, 1.0).unwrap());
    add(&mut scene, vec![Anchor::Ground(at(0.0, 0.0)), bead], linear(1e13, 1.0), 0.0);
    scene.gravity = at(0.0, -9.81);
    scene
}

#[test]
fn stiff_spring_acts_as_a_rigid_rod() {
    // A pendulum released from the height of its hinge has the period 4 K(1/√2) √(L/g).
    let period = 4.0 * 1.854_074_677_301_372 / 9.81_f64.sqrt();
    let simulation = simulate(on_a_stiff_spring(), Method::EnergyMomentum, 1e-3, period);
    let back = simulation.model().control_points().next().unwrap()[0];
    assert!((back - at(1.0, 0.0)).norm() < 1e-5 && (back.norm() - 1.0).abs() < 1e-10, "{back}");
    assert!(simulation.history().drift(Invariant::Energy) < 1e-12);
}

#[test]
fn tendon_force_is_constant_along_its_path() {
    // Atwood machine with massless pulleys: masses of 3 and 1 on one rope over two points of the ground.
    let mut scene = Scene::new("Atwood");
    let mut hang = |name: &str, x: f64, mass: f64| {
        let bead = ParticleDefinition { name: name.to_owned(), position: at(x, -2.0) };
        Anchor::Station(scene.add_particle(bead, mass).unwrap())
    };
    let (heavy, light) = (hang("heavy", 0.0, 3.0), hang("light", 1.0, 1.0));
    let over = [at(0.0, 0.0), at(1.0, 0.0)].map(Anchor::Ground);
    let stiffness = 1e8;
    let natural = 5.0 - 2.0 * 3.0 * 1.0 / 4.0 * 9.81 / stiffness;
    add(&mut scene, vec![heavy, over[0], over[1], light], linear(stiffness, natural), 0.0);
    scene.gravity = at(0.0, -9.81);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 0.4);
    let fallen = -2.0 - simulation.model().control_points().next().unwrap()[0].y;
    let expected = 0.5 * 9.81 * (3.0 - 1.0) / 4.0 * 0.16;
    assert!((fallen - expected).abs() < 1e-6, "{fallen} {expected}");
    let tension = *simulation.history().column("spring1.force").unwrap().last().unwrap();
    assert!((tension - 14.715).abs() < 1e-3, "{tension}");
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-12, "{name}: {drift:.1e}");
    }
}

/// Nearly rigid bar with a torsion spring and a damper at its hinge.
fn door(stiffness: f64, damping: f64, angle: f64) -> Scene {
    let mut scene = Scene::new("door");
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let section = Section {
        axial_stiffness: 1e9,
        shear_stiffness: 1e9,
        bending_stiffness: 1e8,
        mass_per_length: 1.0,
        rotary_inertia: 1e-6,
    };
    let bar =
        scenes::add_beam(&mut scene, scenes::line(at(0.0, 0.0), at(1.0, 0.0)), &mesh, section);
    let foot = scene.station(bar, 0.0).unwrap();
    scene.join(JointKind::Hinge, foot, Partner::Ground).unwrap();
    let kind = SpringKind::Torsion([Anchor::Ground(at(0.0, 0.0)), Anchor::Station(foot)]);
    let spring = Spring {
        name: "torsion".to_owned(),
        kind,
        law: linear(stiffness, angle),
        origin: Origin::Zero,
        damping: damping.into(),
        rest: None,
    };
    scene.add_spring(spring).unwrap();
    scene
}

#[test]
fn bar_on_a_torsion_spring_keeps_its_frequency_beyond_a_full_turn() {
    // The unstrained angle is one and a half turns away, and the motion is still that of a linear oscillator. The inertia of the bar is m L²/3 + rho_I.
    let (k, goal) = (4.0, 1.5 * TAU);
    let inertia = 1.0 / 3.0 + 1e-6;
    let end = 1.3;
    let simulation = simulate(door(k, 0.2, goal), Method::FourthOrder, 0.0025, end);
    let angle = *simulation.history().column("torsion.angle").unwrap().last().unwrap();
    let expected = goal + damped(-goal, (inertia, 0.2, k), end);
    assert!((angle - expected).abs() < 1e-5, "{angle} {expected}");
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-11, "{name}: {drift:.1e}");
    }
}

#[test]
fn only_energy_decaying_steps_dissipate_energy_of_stiff_springs() {
    for entry in INTEGRATORS {
        let simulation = simulate(oscillator(1e6, 0.0, 0.01), entry.method, 0.01, 1.0);
        let energies: Vec<f64> = crate::common::energies(simulation.history());
        let left = energies.last().unwrap() / energies[0];
        match entry.claims.energy {
            EnergyClaim::Conserved => assert!((left - 1.0).abs() < 1e-11, "{}", entry.name),
            EnergyClaim::NonIncreasing => assert!(left < 0.5, "{}: {left}", entry.name),
            EnergyClaim::Unclaimed => (),
        }
    }
}

#[test]
fn hardening_spring_given_by_a_function_has_the_period_of_the_integral() {
    // m ẍ = -(k x + b x³) from rest at a: T = 4 ∫ dx/√(2/m (U(a) - U(x))), by x = a sin φ.
    let (k, b, a, mass) = (18.0, 40.0, 0.6, 2.0);
    let law = SpringLaw::sampled((-0.8, 0.8), |e: f64| Ok::<f64, ()>(k * e + b * e * e * e));
    let law = law.unwrap().shifted(NATURAL);
    let mut scene = oscillator(1.0, 0.0, a);
    scene.elements.retain(|element| !matches!(element, withy::system::Element::Spring(_)));
    let bead = Anchor::Station(withy::beams::Station::on_particle(0));
    add(&mut scene, vec![Anchor::Ground(at(5.0, 3.0)), bead], Some(law), 0.0);
    let slices = 400;
    let mean = (0..slices).map(|slice| {
        let phi = (f64::from(slice) + 0.5) / f64::from(slices) * 0.25 * TAU;
        // U(a) - U(x) = (a² - x²)(k/2 + b (a² + x²)/4), and a² - x² = a² cos² φ.
        1.0 / (2.0 / mass * (0.5 * k + 0.25 * b * a * a * (1.0 + phi.sin().powi(2)))).sqrt()
    });
    let period = mean.sum::<f64>() / f64::from(slices) * TAU;
    let simulation = simulate(scene, Method::FourthOrder, period / 200.0, period);
    assert!((place(&simulation) - a).abs() < 1e-5, "{}", place(&simulation));
    assert!(simulation.history().drift(Invariant::Energy) < 1e-13);
}
