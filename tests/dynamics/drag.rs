//! Drag compared with closed forms, with every integrator.
#![allow(clippy::unwrap_used)]

use crate::common::{at, orders, scenes, simulate};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Drag, Dragged, ParticleDefinition, Scene, SpeedLaw, StartMotion, StationVelocity,
};

const GRAVITY: f64 = 9.81;

/// Particle of mass 0.5 that starts to fall.
fn stone(law: SpeedLaw, wind: Vec2) -> Scene {
    let mut scene = Scene::new("stone");
    let stone = ParticleDefinition { name: "stone".to_owned(), position: at(2.0, 5.0) };
    let station = scene.add_particle(stone, 0.5).unwrap();
    let on = Dragged::Point { station, law };
    scene.add_drag(Drag { name: "air".to_owned(), on, wind }).unwrap();
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

fn place(simulation: &Simulation) -> Vec2 {
    simulation.model().control_points().next().unwrap()[0]
}

fn assert_orders(
    scene: &dyn Fn() -> Scene,
    end: f64,
    found_at: &dyn Fn(&Simulation) -> f64,
    exact: f64,
) {
    for entry in INTEGRATORS {
        let of = |dt: f64| (found_at(&simulate(scene(), entry.method, dt, end)) - exact).abs();
        let errors = [0.02, 0.01, 0.005].map(of);
        let found = orders(&errors);
        println!("{}: {} {found:?}", entry.name, crate::common::sci(&errors));
        // The strains are zero, so the numerical damping of strains has no effect.
        let expected = match entry.claims.energy {
            EnergyClaim::NonIncreasing => 2.0,
            _ => f64::from(entry.claims.order),
        };
        assert!((found[1] - expected).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
    }
}

#[test]
fn particle_sinks_in_a_viscous_medium() {
    // m v̇ = m g - c v: y = v∞ (t - T (1 - e^(-t/T))), T = m/c.
    let (c, end) = (0.8, 1.0);
    let (time, limit) = (0.5 / c, 0.5 * GRAVITY / c);
    let exact = 5.0 - limit * (end - time * (1.0 - (-end / time).exp()));
    let law = SpeedLaw { linear: c, quadratic: 0.0 };
    assert_orders(&|| stone(law, Vec2::zeros()), end, &|s| place(s).y, exact);
}

#[test]
fn particle_falls_through_air() {
    // m v̇ = m g - k v²: y = v∞²/g ln cosh(g t/v∞), v∞² = m g/k.
    let (k, end) = (0.3, 1.0);
    let limit = (0.5 * GRAVITY / k).sqrt();
    let exact = 5.0 - limit * limit / GRAVITY * (GRAVITY * end / limit).cosh().ln();
    let law = SpeedLaw { linear: 0.0, quadratic: k };
    assert_orders(&|| stone(law, Vec2::zeros()), end, &|s| place(s).y, exact);
}

#[test]
fn particle_reaches_the_wind_velocity_and_energy_is_balanced() {
    let law = SpeedLaw { linear: 0.4, quadratic: 0.2 };
    let wind = at(4.0, 0.0);
    let mut scene = stone(law, wind);
    scene.gravity = Vec2::zeros();
    let simulation = simulate(scene, Method::EnergyMomentum, 0.05, 40.0);
    let last = simulation.history().samples().last().unwrap().measures;
    // The final velocity is that of the wind: p = m w, W = ∫ F·w dt = m w², and half of the work is dissipated.
    assert!((last.momentum - wind * 0.5).norm() < 1e-6, "{}", last.momentum);
    assert!((last.work - 0.5 * 16.0).abs() < 1e-5, "{}", last.work);
    assert!((last.dissipated - 0.25 * 16.0).abs() < 1e-5, "{}", last.dissipated);
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-13, "{name}: {drift:.1e}");
    }
}

/// Drag coefficients from nearly zero to nearly rigid, with and without wind: no step fails, invariants hold, and the position is that of the midpoint rule.
#[test]
fn energy_balance_holds_for_any_drag_without_more_steps() {
    let (mass, dt, steps) = (0.5, 0.01, 100);
    for wind in [Vec2::zeros(), at(3.0, 1.0)] {
        for linear in [1e-6, 1.0, 1e4, 1e6, 1e8, 1e10, 1e12] {
            let mut scene = stone(SpeedLaw { linear, quadratic: 0.0 }, wind);
            scene.gravity = Vec2::zeros();
            let start = at(-2.0, 4.0);
            let station = Station::on_particle(0);
            scene.velocities.push(StationVelocity { station, velocity: start, spin: None });
            let label = format!("c = {linear:e}, wind {wind}");
            let simulation = simulate(scene, Method::EnergyMomentum, dt, dt * f64::from(steps));
            let work = simulation.counts();
            assert_eq!((work.steps, work.retries), (100, 0), "{label}");
            let history = simulation.history();
            for (name, invariant) in Invariant::ALL {
                let drift = history.drift(invariant);
                assert!(drift < 1e-13, "{name}, {label}: {drift:.1e}");
            }
            // m (v1 - v0)/Δt = -c (½ (v0 + v1) - w), so v - w is multiplied by a constant factor in each step.
            let twice = 2.0 * mass / dt;
            let factor = (twice - linear) / (twice + linear);
            let all: f64 = (0..steps).map(|step| factor.powi(step)).sum();
            let travelled =
                (start - wind) * (0.5 * dt * (1.0 + factor) * all) + wind * (dt * f64::from(steps));
            let missed = (place(&simulation) - at(2.0, 5.0) - travelled).norm();
            assert!(missed < 1e-13, "{label}: {missed:.1e}");
        }
    }
}

/// The dissipated energy follows from the drag law itself. The difference of two large energies would have a rounding error of either sign.
#[test]
fn dissipation_of_strong_drag_in_wind_never_decreases() {
    let mut scene = Scene::new("grain");
    let grain = ParticleDefinition { name: "grain".to_owned(), position: at(0.0, 0.0) };
    let station = scene.add_particle(grain, 0.001).unwrap();
    let on = Dragged::Point { station, law: SpeedLaw { linear: 0.0, quadratic: 1e8 } };
    let wind = at(0.0, 100.0);
    scene.add_drag(Drag { name: "air".to_owned(), on, wind }).unwrap();
    scene.gravity = at(0.0, -GRAVITY);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 1.0);
    let rows = simulation.history().samples();
    let falls =
        rows.windows(2).filter(|two| two[1].measures.dissipated < two[0].measures.dissipated);
    assert_eq!(falls.count(), 0);
    let last = rows.last().unwrap().measures;
    assert!(last.dissipated > 0.0, "{:e}", last.dissipated);
    assert!(simulation.history().drift(Invariant::Energy) < 1e-13);
}

/// Stiff falling rod, initially along x, with a start velocity of its ends.
fn falling(direction: Vec2) -> Scene {
    let mut scene = Scene::new("falling rod");
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 1e6,
        bending_stiffness: 1e4,
        mass_per_length: 0.5,
        rotary_inertia: 1e-3,
    };
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let axis = scenes::line(at(0.0, 0.0), direction * 2.0);
    let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
    let normal = SpeedLaw { linear: 1.2, quadratic: 0.0 };
    let tangent = SpeedLaw { linear: 0.3, quadratic: 0.0 };
    let on = Dragged::Beam { beam, normal, tangent };
    scene.add_drag(Drag { name: "water".to_owned(), on, wind: Vec2::zeros() }).unwrap();
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

#[test]
fn a_rod_falls_faster_lengthwise_than_sideways() {
    let end = 1.0;
    for (direction, c) in [(at(1.0, 0.0), 1.2), (at(0.0, 1.0), 0.3)] {
        let (time, limit) = (0.5 / c, 0.5 * GRAVITY / c);
        let exact = -limit * (end - time * (1.0 - (-end / time).exp()));
        assert_orders(&|| falling(direction), end, &|s| place(s).y, exact);
    }
    // An inclined rod glides towards its lower end.
    let aslant = simulate(falling(at(0.8, 0.6)), Method::EnergyMomentum, 0.02, 2.0);
    assert!(place(&aslant).x < -0.5, "{}", place(&aslant));
    assert!(aslant.history().drift(Invariant::Energy) < 1e-13);
}

/// Free rotating bent beam with drag, in wind.
fn tumbling(quadratic: f64) -> Scene {
    let mut scene = Scene::new("tumbling");
    let axis = Curve::arc(at(0.0, 0.0), 1.5, 0.2, 1.9).unwrap();
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let beam = scenes::add_beam(&mut scene, axis, &mesh, scenes::rod());
    scene.beams[beam].motion = StartMotion { velocity: at(1.0, 0.5), spin: 3.0, centre: None };
    let normal = SpeedLaw { linear: 0.2, quadratic };
    let tangent = SpeedLaw { linear: 0.05, quadratic: 0.02 * quadratic };
    let on = Dragged::Beam { beam, normal, tangent };
    scene.add_drag(Drag { name: "air".to_owned(), on, wind: at(-2.0, 6.0) }).unwrap();
    scene
}

#[test]
fn beam_tumbling_through_air_keeps_the_energy_balance() {
    for entry in INTEGRATORS {
        let simulation = simulate(tumbling(0.5), entry.method, 0.05, 10.0);
        let history = simulation.history();
        let all = history.column("dissipated").unwrap();
        assert_eq!(all, history.column("dissipated.air").unwrap());
        assert!(all[all.len() - 1] > 1.0, "{}", entry.name);
        let claims = [
            (Invariant::Energy, entry.claims.energy == EnergyClaim::Conserved),
            (Invariant::Momentum, entry.claims.momentum),
            (Invariant::AngularMomentum, entry.claims.angular_momentum),
        ];
        for (invariant, _) in claims.into_iter().filter(|(_, claimed)| *claimed) {
            let drift = history.drift(invariant);
            assert!(drift < 1e-13, "{}, {invariant:?}: {drift:.1e}", entry.name);
        }
        if entry.method == Method::EnergyMomentum {
            assert!(all.windows(2).all(|pair| pair[1] >= pair[0]));
        }
        let work = simulation.counts();
        let iterations = work.newton_iterations as f64 / work.steps as f64;
        println!("{}: {iterations:.2} iterations", entry.name);
        let parts = if entry.method == Method::FourthOrder { 7.0 } else { 1.0 };
        assert!(work.retries == 0 && iterations < 5.0 * parts, "{}: {iterations}", entry.name);
    }
}

#[test]
fn beam_tumbling_through_air_converges_at_the_order_of_the_method() {
    let end = 0.5;
    let tip = |s: &Simulation| crate::common::ends(s)[1];
    let exact = tip(&simulate(tumbling(0.0), Method::FourthOrder, 2.5e-4, end));
    // The start excites vibrations that only much shorter steps resolve with fourth order. The tests with particles show fourth order.
    for entry in INTEGRATORS.iter().filter(|entry| entry.claims.order < 4) {
        let errors = [0.01, 0.005, 0.0025]
            .map(|dt| (tip(&simulate(tumbling(0.0), entry.method, dt, end)) - exact).norm());
        let found = orders(&errors);
        println!("{}: {} {found:?}", entry.name, crate::common::sci(&errors));
        // The derivative of k |v| v has a kink at zero, so the observed orders would be irregular with quadratic drag.
        let expected = f64::from(entry.claims.order);
        assert!(found[1] > expected - 0.3, "{}: {errors:?} {found:?}", entry.name);
    }
}
