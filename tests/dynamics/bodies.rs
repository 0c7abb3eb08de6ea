//! Rigid bodies against closed forms, an elliptic integral, a Runge–Kutta method and a benchmark.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::body_scenes::{add_body, hinge, pendulum, point};
use crate::common::scenes::drive;
use crate::common::{at, body_scenes, orders, simulate};
use withy::beams::Station;
use withy::geometry::{Vec2, perpendicular};
use withy::integrators::{EnergyClaim, INTEGRATORS, Mechanism, Method};
use withy::joints::Component;
use withy::loads::{PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Anchor, Element, Origin, Scene, Spring, SpringKind, SpringLaw, StartMotion};

const GRAVITY: f64 = 9.81;

fn position(simulation: &Simulation, station: &Station) -> Vec2 {
    simulation.model().position(&simulation.place(station).unwrap())
}

fn angle(simulation: &Simulation, body: usize) -> f64 {
    simulation.model().angle(simulation.scene(), &point(body, 0)).unwrap()
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean (Gauss).
fn quarter_period(k: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

#[test]
fn physical_pendulum_has_the_period_of_the_elliptic_integral() {
    let (inertia, arm, start) = (0.2, 0.8, 2.0_f64);
    let frequency = (GRAVITY * arm / (inertia + arm * arm)).sqrt();
    // Third zero crossing, after five quarters of a period.
    let end = 5.0 * quarter_period((0.5 * start).sin()) / frequency;
    for entry in INTEGRATORS {
        let errors = [100.0, 200.0, 400.0].map(|steps| {
            let scene = pendulum(inertia, arm, start);
            let simulation = simulate(scene, entry.method, end / steps, end);
            angle(&simulation, 0).abs()
        });
        let expected = match entry.claims.energy {
            // This method is of first order in the strains, which are zero here.
            EnergyClaim::NonIncreasing => 2.0,
            _ => f64::from(entry.claims.order),
        };
        let found = orders(&errors);
        println!("{}: {errors:?} {found:?}", entry.name);
        assert!((found[1] - expected).abs() < 0.2, "{}: {errors:?} {found:?}", entry.name);
    }
}

/// Angular accelerations of a double pendulum as functions of the rotations and spins (d'Alembert).
fn of_double_pendulum(state: [f64; 4]) -> [f64; 4] {
    let [turn, other, spin, other_spin] = state;
    let (one, two) = ((1.0, 0.1), (2.0, 0.2));
    let rotated = |a: Vec2, by: f64| a * by.cos() + perpendicular(a) * by.sin();
    let centre = rotated(at(0.5, 0.0), turn);
    let joint = rotated(at(1.0, 0.1), turn);
    let hanging = rotated(at((PI / 3.0).cos(), (PI / 3.0).sin()) * -0.6, other);
    let fall = at(0.0, -GRAVITY);
    let carried = joint * (-spin * spin) + hanging * (-other_spin * other_spin) - fall;
    let coupling = two.0 * joint.dot(&hanging);
    let own = one.1 + one.0 * centre.norm_squared() + two.0 * joint.norm_squared();
    let others = two.1 + two.0 * hanging.norm_squared();
    let right =
        -one.0 * perpendicular(centre).dot(&(-fall)) - two.0 * perpendicular(joint).dot(&carried);
    let other_right = -two.0 * perpendicular(hanging).dot(&carried);
    let determinant = own * others - coupling * coupling;
    let turning = (others * right - coupling * other_right) / determinant;
    let other_turning = (own * other_right - coupling * right) / determinant;
    [spin, other_spin, turning, other_turning]
}

fn runge_kutta(mut state: [f64; 4], h: f64, steps: usize) -> [f64; 4] {
    let moved = |state: [f64; 4], by: f64, rate: [f64; 4]| {
        std::array::from_fn(|at| state[at] + by * rate[at])
    };
    for _ in 0..steps {
        let a = of_double_pendulum(state);
        let b = of_double_pendulum(moved(state, 0.5 * h, a));
        let c = of_double_pendulum(moved(state, 0.5 * h, b));
        let d = of_double_pendulum(moved(state, h, c));
        state =
            std::array::from_fn(|at| state[at] + h / 6.0 * (a[at] + 2.0 * (b[at] + c[at]) + d[at]));
    }
    state
}

#[test]
fn rigid_double_pendulum_agrees_with_a_runge_kutta_method() {
    let end = 1.5;
    let exact = runge_kutta([0.0; 4], 1e-4, 15_000);
    let coarse = runge_kutta([0.0; 4], 2e-4, 7_500);
    assert!((exact[0] - coarse[0]).abs() < 1e-11 && exact[0].abs() > 0.5, "{exact:?}");
    for entry in INTEGRATORS {
        let errors = [0.02, 0.01, 0.005].map(|dt| {
            let mut scene = body_scenes::double_pendulum();
            scene.elements.retain(|element| !matches!(element, Element::Load(_)));
            let simulation = simulate(scene, entry.method, dt, end);
            let one = angle(&simulation, 0) - exact[0];
            one.hypot(angle(&simulation, 1) - PI / 3.0 - exact[1])
        });
        let expected = match entry.claims.energy {
            EnergyClaim::NonIncreasing => 2.0,
            _ => f64::from(entry.claims.order),
        };
        let found = orders(&errors);
        println!("{}: {errors:?} {found:?}", entry.name);
        assert!((found[1] - expected).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
    }
}

#[test]
fn free_body_rotates_evenly_with_a_phase_error_of_the_cube_of_its_spin() {
    let (spin, dt, end) = (3.0, 0.02, 10.0);
    let mut scene = Scene::new("gyrating");
    let body = add_body(&mut scene, at(3.0, 2.0), 0.4, (2.0, 0.5), &[at(1.0, 0.0), at(-0.3, 0.7)]);
    scene.rigid_bodies[body].motion = StartMotion { velocity: at(1.0, -2.0), spin, centre: None };
    let simulation = simulate(scene, Method::EnergyMomentum, dt, end);
    let late = spin * end + 0.4 - angle(&simulation, body);
    // 2 atan(ω Δt/2) = ω Δt - (ω Δt)³/12 + …
    let exact = end / dt * (spin * dt - 2.0 * (0.5 * spin * dt).atan());
    assert!((late - exact).abs() < 1e-11 * spin * end, "{late} {exact}");
    assert!((late / (spin.powi(3) * dt * dt * end / 12.0) - 1.0).abs() < 1e-2, "{late}");
    assert!((position(&simulation, &point(body, 0)) - at(13.0, -18.0)).norm() < 1e-12);
    let turned = angle(&simulation, body);
    let tip = at(13.0, -18.0) + at(turned.cos(), turned.sin());
    assert!((position(&simulation, &point(body, 1)) - tip).norm() < 1e-11);
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-14, "{name}: {drift:.1e}");
    }
}

#[test]
fn body_on_an_eccentric_torsion_spring_oscillates_as_a_cosine() {
    let (mass, inertia, arm, stiffness) = (1.5, 0.2, 0.4, 7.0_f64);
    let frequency = (stiffness / (inertia + mass * arm * arm)).sqrt();
    for entry in INTEGRATORS {
        let errors = [0.04, 0.02, 0.01].map(|dt| {
            let mut scene = Scene::new("balance wheel");
            let body = add_body(&mut scene, at(arm, 0.0), 0.0, (mass, inertia), &[at(-arm, 0.0)]);
            hinge(&mut scene, point(body, 1), None);
            let ends = [Anchor::Station(point(body, 1)), Anchor::Ground(at(0.0, 0.0))];
            let law = Some(SpringLaw::Linear { stiffness, natural: 0.3 });
            let (name, kind) = ("hairspring".to_owned(), SpringKind::Torsion(ends));
            let spring =
                Spring { name, kind, law, origin: Origin::Zero, damping: 0.0.into(), rest: None };
            scene.add_spring(spring).unwrap();
            let simulation = simulate(scene, entry.method, dt, 2.5);
            // The spring is unstrained if the angle of the ground minus that of the body is 0.3.
            let expected = -0.3 * (1.0 - (frequency * 2.5).cos());
            (angle(&simulation, body) - expected).abs()
        });
        let expected = f64::from(entry.claims.order);
        let found = orders(&errors);
        println!("{}: {errors:?} {found:?}", entry.name);
        assert!((found[1] - expected).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
    }
}

#[test]
fn released_rod_loads_its_hinge_with_a_quarter_of_its_weight() {
    let (mass, length) = (2.0, 1.5);
    let mut scene = Scene::new("let go");
    let inertia = mass * length * length / 12.0;
    let ends = [at(-0.5 * length, 0.0), at(0.5 * length, 0.0)];
    let body = add_body(&mut scene, at(0.5 * length, 0.0), 0.0, (mass, inertia), &ends);
    hinge(&mut scene, point(body, 1), None);
    scene.gravity = at(0.0, -GRAVITY);
    let mut simulation =
        Simulation::start(scene, crate::common::settings(Method::EnergyMomentum, 0.01)).unwrap();
    let [pivot, tip] = [1, 2].map(|end| simulation.place(&point(body, end)).unwrap());
    let now = simulation.instant().unwrap();
    let (force, moment) = simulation.model().reaction(now.reactions(), &pivot).unwrap();
    assert!((force - at(0.0, 0.25 * mass * GRAVITY)).norm() < 1e-12 && moment == 0.0, "{force}");
    let tip = simulation.model().acceleration(&now, &tip);
    assert!((tip - at(0.0, -1.5 * GRAVITY)).norm() < 1e-12, "{tip}");
}

/// Two four-bar linkages of rigid rods of 1 m and 1 kg (IFToMM benchmark A02, "N four-bars"), upright, with a tip velocity of 1 m/s.
fn windows() -> Scene {
    let mut scene = Scene::new("two four-bars");
    let rod = |scene: &mut Scene, place: Vec2, along: Vec2, motion: StartMotion| {
        let body = add_body(scene, place, 0.0, (1.0, 1.0 / 12.0), &[along * -0.5, along * 0.5]);
        scene.rigid_bodies[body].motion = motion;
        body
    };
    let posts: Vec<usize> = [0.0, 1.0, 2.0]
        .into_iter()
        .map(|x| {
            let foot = Some(at(x, 0.0));
            let motion = StartMotion { velocity: Vec2::zeros(), spin: -1.0, centre: foot };
            let post = rod(&mut scene, at(x, 0.5), at(0.0, 1.0), motion);
            hinge(&mut scene, point(post, 1), None);
            post
        })
        .collect();
    for (number, x) in [(0, 0.5), (1, 1.5)] {
        let motion = StartMotion { velocity: at(1.0, 0.0), ..StartMotion::default() };
        let beam = rod(&mut scene, at(x, 1.0), at(1.0, 0.0), motion);
        for end in [0, 1] {
            let (top, own) = (point(posts[number + end], 2), point(beam, end + 1));
            hinge(&mut scene, top, Some(own));
        }
    }
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

#[test]
fn double_four_bar_linkage_agrees_with_the_benchmark() {
    let known =
        [(1.0, -0.195_020_30), (2.0, 0.057_815_80), (5.0, -0.811_310_46), (10.0, 0.328_458_11)];
    // The motion passes through singular positions in which all rods are collinear.
    for (method, dt, tolerance) in
        [(Method::FourthOrder, 0.01, 1e-7), (Method::EnergyMomentum, 0.005, 5e-4)]
    {
        for (time, x) in known {
            let simulation = simulate(windows(), method, dt, time);
            let found = position(&simulation, &point(0, 2)).x;
            assert!((found - x).abs() < tolerance, "{method:?}, t = {time}: {found} {x}");
            let history = simulation.history();
            let energy = history.samples().last().unwrap().measures.energy.total();
            // The benchmark allows 0.1.
            assert!((energy - 35.835).abs() < 1e-11, "{energy}");
            assert!(history.drift(Invariant::AngularMomentum) < 1e-12);
            assert_eq!(simulation.counts().retries, 0);
        }
    }
}

/// Wheel with the prescribed angle `0.3 t²`, and a body hinged to its rim with a torsion spring.
fn driven_wheel() -> Scene {
    let mut scene = Scene::new("driven wheel");
    let wheel = add_body(&mut scene, at(0.0, 0.0), 0.0, (2.0, 0.3), &[at(0.5, 0.0)]);
    let hung = add_body(&mut scene, at(0.5, -0.4), 0.0, (1.0, 0.1), &[at(0.0, 0.4)]);
    hinge(&mut scene, point(wheel, 0), None);
    hinge(&mut scene, point(wheel, 1), Some(point(hung, 1)));
    let function = std::rc::Rc::new(|t: f64| Ok(0.3 * t * t));
    let motion = PrescribedMotion::Position(Schedule::Function { function, breaks: vec![] });
    drive(&mut scene, point(wheel, 0), &[(Component::Rotation, motion)]);
    let ends = [point(wheel, 1), point(hung, 1)].map(Anchor::Station);
    let law = Some(SpringLaw::Linear { stiffness: 2.0, natural: 0.0 });
    let (name, kind) = ("spring".to_owned(), SpringKind::Torsion(ends));
    let spring = Spring { name, kind, law, origin: Origin::Zero, damping: 0.0.into(), rest: None };
    scene.add_spring(spring).unwrap();
    scene
}

#[test]
fn driven_wheel_moves_its_rim_and_attached_bodies() {
    for entry in INTEGRATORS {
        let mut scene = driven_wheel();
        scene.gravity = at(0.0, -GRAVITY);
        let mut simulation = simulate(scene, entry.method, 0.02, 2.0);
        let (sin, cos) = 1.2_f64.sin_cos();
        let (along, across) = (at(cos, sin) * 0.5, at(-sin, cos) * 0.5);
        let rim = position(&simulation, &point(0, 1));
        assert!((rim - along).norm() < 1e-12, "{}: {rim}", entry.name);
        let place = simulation.place(&point(0, 1)).unwrap();
        let now = simulation.instant().unwrap();
        let acceleration = simulation.model().acceleration(&now, &place);
        // `α J r - ω² r` with ω = 0.6 t and α = 0.6. The drive obtains both from differences of its function.
        let expected = across * 0.6 - along * 1.44;
        assert!((acceleration - expected).norm() < 1e-6, "{}: {acceleration}", entry.name);
        if entry.claims.energy == EnergyClaim::Conserved {
            for (name, invariant) in Invariant::ALL {
                let drift = simulation.history().drift(invariant);
                assert!(drift < 1e-12, "{}, {name}: {drift:.1e}", entry.name);
            }
        }
    }
}

#[test]
fn equilibrium_applies_the_prescribed_rotation_of_a_wheel() {
    let loading = Loading { time: 2.0, steps: 4, ..Loading::default() };
    let rest = Equilibrium::find(driven_wheel(), loading, &mut |_| true).unwrap();
    let (sin, cos) = 1.2_f64.sin_cos();
    let turned = at(0.5 * cos + 0.4 * sin, 0.5 * sin - 0.4 * cos);
    let found = rest.model().control_points().nth(1).unwrap()[0];
    assert!((found - turned).norm() < 1e-12, "{found} {turned}");
}

#[test]
fn bandwidth_and_work_per_body_do_not_grow_with_the_length_of_a_chain() {
    let work = |bodies: usize| {
        let simulation = simulate(body_scenes::chain(bodies), Method::EnergyMomentum, 0.01, 0.2);
        let counts = simulation.counts();
        assert_eq!(simulation.model().unknowns(), 9 * bodies, "{bodies}");
        assert!(counts.newton_iterations <= 2 * counts.steps, "{bodies}: {counts:?}");
        (simulation.half_bandwidth(), counts.steps, counts.newton_max, counts.retries)
    };
    let ten = work(10);
    println!("10 bodies: band, steps, most iterations, retries {ten:?}");
    assert!(ten.0 == 4 && ten.3 == 0, "{ten:?}");
    assert_eq!(work(100), ten);
    assert_eq!(work(200), ten);
}

/// A user-defined outline moves with the body and is stored in the file.
#[test]
fn outline_rotates_with_its_body() {
    let mut scene = body_scenes::pendulum(0.2, 0.6, 0.8);
    let corners = [at(0.3, 0.6), at(-0.3, 0.5), at(-0.1, -0.7), at(0.4, -0.2)];
    scene.rigid_bodies[0].outline = corners.to_vec();
    let simulation = simulate(scene, Method::default(), 0.01, 1.0);
    let (centre, angle) = (position(&simulation, &point(0, 0)), angle(&simulation, 0));
    let drawn = simulation.configuration().unwrap().bodies.remove(0);
    let expected = corners.iter().chain(&corners[..1]).map(|corner| {
        let (sin, cos) = angle.sin_cos();
        centre + at(cos * corner.x - sin * corner.y, sin * corner.x + cos * corner.y)
    });
    assert_eq!(drawn.len(), corners.len() + 1);
    for (drawn, expected) in drawn.iter().zip(expected) {
        assert!((drawn - expected).norm() < 1e-9, "{drawn} {expected}");
    }
    let (_, again) = Simulation::from_bytes(&simulation.to_bytes("swing").unwrap()).unwrap();
    assert_eq!(again.configuration().unwrap().bodies[0], drawn);
}
