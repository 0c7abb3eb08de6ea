//! Contact with walls and discs: closed forms of bounces, the energy balance at any step size and stiffness, and work counts.
#![allow(clippy::unwrap_used)]

use crate::common::{Random, at, orders, scenes, sci, simulate};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::simulation::{Invariant, Simulation, StepSize};
use withy::system::{
    Obstacle, ObstacleShape, ParticleDefinition, Scene, StartMotion, StationVelocity,
};

pub fn wall(point: Vec2, normal: Vec2, stiffness: f64, restitution: f64) -> Obstacle {
    Obstacle {
        name: "wall".to_owned(),
        shape: ObstacleShape::HalfPlane { point, normal: normal.normalize() },
        targets: Vec::new(),
        radius: 0.0,
        stiffness,
        restitution,
        friction: 0.0,
    }
}

pub fn disc(centre: Vec2, radius: f64, stiffness: f64, restitution: f64) -> Obstacle {
    let shape = ObstacleShape::Disc { centre, radius };
    Obstacle {
        name: "disc".to_owned(),
        shape,
        ..wall(at(0.0, 0.0), at(0.0, 1.0), stiffness, restitution)
    }
}

/// Particle of mass 1 with a start velocity.
pub fn ball(position: Vec2, velocity: Vec2, obstacle: Obstacle) -> Scene {
    let mut scene = Scene::new("ball");
    let ball = ParticleDefinition { name: "ball".to_owned(), position };
    let station = scene.add_particle(ball, 1.0).unwrap();
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    scene.add_obstacle(obstacle).unwrap();
    scene
}

pub fn position(simulation: &Simulation) -> Vec2 {
    simulation.model().control_points().next().unwrap()[0]
}

pub fn column(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.history().column(name).unwrap()
}

pub fn assert_balanced(simulation: &Simulation, tolerance: f64) {
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < tolerance, "{}, {name}: {drift:.1e}", simulation.scene().name);
    }
}

/// A ball falls from a height of 1 on a linear contact (`m = 1`, `g = 10`).
///
/// While it is in contact, the penetration is `g/ω² (cos ωt - 1) - v/ω sin ωt` with `ω² = k/m`, so depth and duration have closed forms.
#[test]
fn bouncing_ball_agrees_with_the_closed_form() {
    let (k, g, v) = (1e4_f64, 10.0_f64, 20.0_f64.sqrt());
    let omega = k.sqrt();
    let sink = g / k;
    let depth = sink + (sink * sink + v * v / k).sqrt();
    let contact = 2.0 * (std::f64::consts::PI - (v * omega / g).atan()) / omega;
    let period = 2.0 * v / g + contact;
    assert!((depth - 0.045_732_538_5).abs() < 1e-10 && (period - 0.926_290_256_6).abs() < 1e-10);
    let scene = || {
        let mut scene = ball(at(0.3, 1.0), at(0.0, 0.0), wall(at(0.0, 0.0), at(0.0, 1.0), k, 1.0));
        scene.gravity = at(0.0, -g);
        scene
    };
    for method in [Method::EnergyMomentum, Method::FourthOrder] {
        let found = [400, 800, 1600, 3200].map(|steps: u32| {
            let simulation =
                simulate(scene(), method, StepSize::Fixed(period / f64::from(steps)), 2.0 * period);
            assert_balanced(&simulation, 1e-12);
            let deepest = column(&simulation, "wall.gap").into_iter().fold(0.0, f64::min);
            // The second apex is at the height of the start.
            [(position(&simulation) - at(0.3, 1.0)).norm(), (deepest + depth).abs()]
        });
        let errors = found.map(|[apex, _]| apex);
        println!("{method:?}: {} {:?}", sci(&errors), orders(&errors));
        assert!(errors[3] < 1e-5, "{errors:?}");
        let order = (errors[0] / errors[3]).log2() / 3.0;
        assert!(order > 1.7 || errors[3] < 1e-12, "{errors:?}");
        assert!(found[3][1] < 1e-4, "{found:?}");
    }
}

/// Without gravity, a resolved impact of a single mass rebounds with the coefficient of restitution, at any mass, stiffness and speed.
#[test]
fn a_resolved_impact_has_its_restitution() {
    for entry in INTEGRATORS {
        for (restitution, stiffness, speed) in [(0.8, 1e4, 2.0), (0.5, 3e2, 0.1), (0.2, 1e6, 30.0)]
        {
            let omega: f64 = f64::sqrt(stiffness);
            let normal = at(3.0, 4.0) / 5.0;
            let obstacle = wall(at(0.0, 0.0), normal, stiffness, restitution);
            let start = normal * (2.0 * speed / omega) + at(4.0, -3.0);
            let along = at(4.0, -3.0) / 5.0 * 0.7;
            let errors = [20.0, 40.0, 80.0].map(|per| {
                let scene = ball(start, along - normal * speed, obstacle.clone());
                let simulation = simulate(
                    scene,
                    entry.method,
                    StepSize::Fixed(1.0 / (per * omega)),
                    12.0 / omega,
                );
                let momentum = simulation.history().samples().last().unwrap().measures.momentum;
                assert!((momentum - normal * normal.dot(&momentum) - along).norm() < 1e-12);
                (normal.dot(&momentum) / speed - restitution).abs()
            });
            println!("{}, {restitution}: {}", entry.name, sci(&errors));
            assert!(errors[2] < 6e-3, "{}, {restitution}: {errors:?}", entry.name);
        }
    }
}

fn soft() -> Section {
    Section {
        axial_stiffness: 1e5,
        shear_stiffness: 4e4,
        bending_stiffness: 5.0,
        mass_per_length: 0.5,
        rotary_inertia: 1e-3,
    }
}

/// Inclined rod that falls on an obstacle.
fn falling_rod(obstacle: Obstacle) -> Scene {
    let mut scene = Scene::new("falling rod");
    scene.gravity = at(0.0, -9.81);
    let mesh = Mesh::bspline(12, 3, 2).unwrap();
    let axis = scenes::line(at(-0.8, 0.5), at(1.2, 0.9));
    scenes::add_beam(&mut scene, axis, &mesh, soft());
    scene.add_obstacle(obstacle).unwrap();
    scene
}

/// The drifts of energy and momenta stay at rounding over twelve decades of stiffness at a fixed step, and the iterations per step do not increase.
#[test]
fn the_energy_balance_holds_at_any_stiffness() {
    for (restitution, friction) in [(1.0, 0.0), (0.5, 0.0), (1.0, 0.3), (0.5, 0.8)] {
        for stiffness in [1e1, 1e4, 1e7, 1e10, 1e13] {
            let floor = wall(at(0.0, 0.0), at(0.1, 1.0), stiffness, restitution);
            let peg = disc(at(0.1, 0.0), 0.4, stiffness, restitution);
            for obstacle in [floor, peg] {
                let name = obstacle.name.clone();
                let obstacle = Obstacle { friction, radius: 0.02, ..obstacle };
                let simulation =
                    simulate(falling_rod(obstacle), Method::EnergyMomentum, 0.005, 0.8);
                let counts = simulation.counts();
                let mean = counts.newton_iterations as f64 / counts.steps as f64;
                let label = format!("{name}, {restitution}, {friction}, {stiffness:e}");
                println!("{label}: {mean:.2} iterations per step");
                assert_balanced(&simulation, 1e-10);
                assert!(mean < 8.0, "{label}: {mean}");
                let touched = column(&simulation, &format!("{name}.force"));
                assert!(touched.into_iter().any(|force| force > 0.0));
                let dissipated = column(&simulation, "dissipated");
                let largest = dissipated.iter().copied().fold(0.0, f64::max);
                for pair in dissipated.windows(2) {
                    assert!(pair[1] >= pair[0] - 1e-12 * (1.0 + largest), "{label}: {pair:?}");
                }
                // Soft contact deflects along the surface and does not slip.
                let slips = friction > 0.0 && stiffness > 10.0;
                assert!(largest > 0.01 || (restitution == 1.0 && !slips), "{label}: {largest}");
                assert!(largest == 0.0 || restitution < 1.0 || friction > 0.0, "{label}");
            }
        }
    }
}

#[test]
fn claimed_invariants_hold_with_obstacles() {
    for entry in INTEGRATORS {
        for obstacle in
            [wall(at(0.0, 0.0), at(0.1, 1.0), 1e5, 0.6), disc(at(0.1, 0.0), 0.4, 1e5, 0.6)]
        {
            let simulation = simulate(falling_rod(obstacle), entry.method, 0.002, 0.5);
            let drift = |invariant| simulation.history().drift(invariant);
            if entry.claims.energy == EnergyClaim::Conserved {
                assert!(drift(Invariant::Energy) < 1e-12, "{}", entry.name);
            }
            let momentum = drift(Invariant::Momentum);
            assert!(momentum < 1e-12 || !entry.claims.momentum, "{}: {momentum:.1e}", entry.name);
        }
    }
}

/// A contact point far from all obstacles changes no bit, and a rotated, mirrored, translated and scaled copy of a scene has the same motion.
#[test]
fn far_obstacles_change_no_bit() {
    let run = |obstacle: Option<Obstacle>| {
        let mut scene = falling_rod(wall(at(0.0, -1e3), at(0.0, 1.0), 1e5, 0.5));
        match obstacle {
            Some(obstacle) => scene.add_obstacle(obstacle).unwrap(),
            None => scene.elements.clear(),
        }
        let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 0.3);
        simulation.model().control_points().flatten().copied().collect::<Vec<_>>()
    };
    let alone = run(None);
    assert_eq!(run(Some(disc(at(0.0, -2e3), 3.0, 1e5, 1.0))), alone);
}

#[test]
fn rotated_and_shifted_copy_has_the_same_motion() {
    let (turn, shift) = (0.7_f64, at(-3.0, 11.0));
    let rotate =
        |v: Vec2| at(v.x * turn.cos() - v.y * turn.sin(), v.x * turn.sin() + v.y * turn.cos());
    let run = |place: &dyn Fn(Vec2) -> Vec2, direct: &dyn Fn(Vec2) -> Vec2| {
        let mut scene = Scene::new("copy");
        scene.gravity = direct(at(0.0, -9.81));
        let axis = scenes::line(place(at(-0.8, 0.5)), place(at(1.2, 0.9)));
        scenes::add_beam(&mut scene, axis, &Mesh::bspline(10, 3, 2).unwrap(), soft());
        let floor = wall(place(at(0.0, 0.0)), direct(at(0.0, 1.0)), 1e5, 0.6);
        scene.add_obstacle(Obstacle { friction: 0.4, radius: 0.01, ..floor }).unwrap();
        let peg = disc(place(at(1.0, 0.2)), 0.3, 1e5, 0.9);
        scene.add_obstacle(Obstacle { friction: 0.2, ..peg }).unwrap();
        let simulation = simulate(scene, Method::EnergyMomentum, 0.004, 0.6);
        simulation.model().control_points().flatten().copied().collect::<Vec<_>>()
    };
    let plain = run(&|at| at, &|along| along);
    let copy = run(&|at| rotate(at) + shift, &rotate);
    let error = plain.iter().zip(&copy).map(|(a, b)| (rotate(*a) + shift - b).norm());
    let error = error.fold(0.0, f64::max);
    assert!(error < 1e-9, "{error:.1e}");
}

/// A particle between the walls of a box, at any step size, never leaves the box by more than its energy allows.
#[test]
fn particles_stay_in_their_box() {
    let mut random = Random(7);
    for (dt, stiffness) in [(1e-3, 1e4), (0.05, 1e8), (0.5, 1e2)] {
        let mut scene = Scene::new("box");
        scene.gravity = at(0.0, -3.0);
        for (number, (normal, distance)) in
            [(at(0.0, 1.0), 1.0), (at(0.0, -1.0), 1.0), (at(1.0, 0.2), 1.5), (at(-1.0, 0.1), 1.5)]
                .into_iter()
                .enumerate()
        {
            let normal = normal.normalize();
            let name = format!("wall{number}");
            let own = wall(normal * -distance, normal, stiffness, 1.0);
            scene.add_obstacle(Obstacle { name, ..own }).unwrap();
        }
        for number in 0..5 {
            let place = random.vector(2, 0.8);
            let ball = ParticleDefinition {
                name: format!("ball{number}"),
                position: at(place[0], place[1]),
            };
            let station = scene.add_particle(ball, 0.5 + f64::from(number)).unwrap();
            let v = random.vector(2, 3.0);
            scene.velocities.push(StationVelocity {
                station,
                velocity: at(v[0], v[1]),
                spin: None,
            });
        }
        let simulation = simulate(scene, Method::EnergyMomentum, dt, 200.0 * dt);
        assert_balanced(&simulation, 1e-10);
        // The potential energy is zero at the lowest point of the box.
        let mass: f64 = (0..5).map(|number| 0.5 + f64::from(number)).sum();
        let energy = simulation.history().samples()[0].measures.energy.total() + mass * 3.0 * 1.5;
        let deepest = (2.0 * energy / stiffness).sqrt();
        for number in 0..4 {
            let gap = column(&simulation, &format!("wall{number}.gap"));
            let gap = gap.into_iter().fold(f64::INFINITY, f64::min);
            assert!(gap > -1.01 * deepest, "{dt}: {gap} {deepest}");
        }
    }
}

/// Restored runs, and runs that go back and continue, are equal bit for bit.
#[test]
fn contacts_are_rewound_and_saved() {
    let start = || {
        let floor = wall(at(0.0, 0.0), at(0.1, 1.0), 1e5, 0.6);
        let scene = falling_rod(Obstacle { friction: 0.3, radius: 0.02, ..floor });
        simulate(scene, Method::EnergyMomentum, 0.005, 0.35)
    };
    let points = |s: &Simulation| s.model().control_points().flatten().copied().collect::<Vec<_>>();
    let mut straight = start();
    straight.run_to(0.6, &mut withy::simulation::NoMonitor).unwrap();
    let mut back = start();
    back.enable_snapshots(1 << 24);
    back.run_to(0.6, &mut withy::simulation::NoMonitor).unwrap();
    back.rewind(0.4).unwrap();
    back.run_to(0.6, &mut withy::simulation::NoMonitor).unwrap();
    assert_eq!(points(&straight), points(&back));
    let saved = start();
    let bytes = saved.to_bytes("rod").unwrap();
    let (_, mut loaded) = Simulation::from_bytes(&bytes).unwrap();
    loaded.run_to(0.6, &mut withy::simulation::NoMonitor).unwrap();
    assert_eq!(points(&straight), points(&loaded));
    for name in ["wall.force", "wall.friction", "dissipated"] {
        assert_eq!(column(&straight, name), column(&loaded, name));
    }
}

/// Free rotating beam between discs: both momenta change only by the impulses of the obstacles, which the balance contains.
#[test]
fn a_spinning_rod_between_pegs_is_balanced() {
    let mut scene = falling_rod(disc(at(0.0, 0.0), 0.2, 1e6, 1.0));
    scene.gravity = Vec2::zeros();
    scene.beams[0].motion = StartMotion { velocity: at(0.0, -2.0), spin: 3.0, centre: None };
    for (number, centre) in [at(1.5, -1.0), at(-1.5, -1.0), at(0.0, -2.5)].into_iter().enumerate() {
        let name = format!("peg{number}");
        let peg = disc(centre, 0.3, 1e6, 0.7);
        scene.add_obstacle(Obstacle { name, friction: 0.5, radius: 0.02, ..peg }).unwrap();
    }
    let simulation = simulate(scene, Method::EnergyMomentum, 0.004, 3.0);
    assert_balanced(&simulation, 1e-11);
}
