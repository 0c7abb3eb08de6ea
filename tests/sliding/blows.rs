//! Impacts at the ends of beams: compared with Saint-Venant's bar and with rigid bodies, at any step size, on any mesh.
#![allow(clippy::unwrap_used)]

use crate::common::rails::bead;
use crate::common::scenes::{add_beam, line};
use crate::common::{at, run, settings};
use withy::beams::{Mesh, Section};
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner};
use withy::simulation::{ArrivalKind, Invariant, Simulation};
use withy::system::Scene;

/// Support of the bar at the end without impact.
#[derive(Clone, Copy, PartialEq)]
enum Foot {
    Clamped,
    Free,
}

/// Speed of the bead, relative to the wave speed `c`.
const SPEED: f64 = 2e-3;

/// Bar of length 1 and mass 1, and a bead that reaches its end after 10 `L/c`.
fn bar(foot: Foot, axial: f64, mass: f64, spans: usize) -> Scene {
    let mut scene = Scene::new("bar");
    let section = Section {
        axial_stiffness: axial,
        shear_stiffness: axial / 2.6,
        bending_stiffness: 1e-3 * axial,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    };
    let mesh = Mesh::bspline(spans, 3, 2).unwrap();
    add_beam(&mut scene, line(at(0.0, 0.0), at(1.0, 0.0)), &mesh, section);
    if foot == Foot::Clamped {
        let start = scene.station(0, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    }
    bead(&mut scene, 1.0 - 10.0 * SPEED, mass, at(SPEED * axial.sqrt(), 0.0), EndAction::Contact);
    scene
}

/// Velocity of the bead after the impact, relative to that before, and the duration of the contact [`L/c`], with steps of `step` `L/c`.
fn struck(scene: Scene, step: f64) -> (f64, f64, Simulation) {
    let speed = (scene.beams[0].section.mean().axial_stiffness).sqrt();
    let dt = step / speed;
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
    run(&mut simulation, 10.0 / speed + 6.0_f64.max(3.0 * step) / speed).unwrap();
    let rows = simulation.history().samples().iter().map(|row| row.measures.time);
    let places = simulation.history().column("slider1.position").unwrap();
    let there = rows.zip(places).filter(|(_, place)| *place == 1.0).map(|(time, _)| time);
    let leant = there.clone().fold(0.0, f64::max) - there.fold(f64::INFINITY, f64::min);
    let place = |simulation: &Simulation| simulation.model().control_points().last().unwrap()[0].x;
    let (before, from) = (place(&simulation), simulation.time());
    run(&mut simulation, from + 2.0_f64.max(step) / speed).unwrap();
    let after = (place(&simulation) - before) / (simulation.time() - from);
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 2e-12, "{name}: {drift:e}");
    }
    (after / (SPEED * speed), leant * speed, simulation)
}

/// Velocity of a mass after the impact on the end of a clamped bar, relative to that before, and the duration of the first contact [`L/c`], by the method of
/// characteristics. The force of the bar is `out(t) + back(t)`, the sum of the outgoing wave and the reflected wave `back(t) = out(t - 2 L/c)`. The velocity
/// of its end is `(out - back)/Z` with `Z = ρA c` (Saint-Venant 1883; Timoshenko & Goodier, section 167). A later reflected wave may cause another contact.
/// `bar` is the mass of the bar relative to the impacting mass.
fn by_characteristics(bar: f64) -> (f64, f64) {
    const STEPS: usize = 4000;
    let h = 1.0 / STEPS as f64;
    let (mut v, mut gap, mut touches, mut lasts) = (1.0, 0.0, true, None);
    let mut out: Vec<f64> = Vec::new();
    for step in 0..16 * STEPS {
        let back = |at: usize| if at < 2 * STEPS { 0.0 } else { out[at - 2 * STEPS] };
        let (now, next) = (back(step), back(step + 1));
        if touches && bar * v + 2.0 * now < 0.0 {
            (touches, gap) = (false, 0.0);
            lasts = lasts.or(Some(step as f64 * h));
        }
        if !touches {
            let end = -2.0 * now / bar;
            gap += h * (end - v);
            touches = gap <= 0.0 && end < v;
        }
        out.push(if touches { bar * v + now } else { -now });
        if touches {
            // Trapezoidal rule for v' = -(Z v + 2 back)/m.
            v = (v * (1.0 - 0.5 * h * bar) - h * (now + next)) / (1.0 + 0.5 * h * bar);
        }
    }
    (v, lasts.unwrap())
}

#[test]
fn method_of_characteristics_gives_the_classical_values() {
    // Timoshenko & Goodier, section 167: end times of the contact for masses of one, two and four times the mass of the bar.
    for (bar, expected) in [(1.0, 3.068), (0.5, 4.708), (0.25, 5.900)] {
        let (_, lasts) = by_characteristics(bar);
        assert!((lasts - expected).abs() < 1e-3, "{bar}: {lasts}");
    }
}

#[test]
fn resolved_rebound_agrees_with_the_bar_of_saint_venant() {
    println!("{:>5} {:>5} {:>6}  velocity  lasts", "bar", "spans", "c Δt/L");
    for (bar_mass, tolerance) in [(1.0, 0.02), (0.25, 0.02)] {
        let (velocity, lasts) = by_characteristics(bar_mass);
        println!("{bar_mass:5}  exact         {velocity:.4}   {lasts:.3}");
        for spans in [4, 10, 40] {
            for step in [0.01, 0.02, 0.05, 0.1] {
                let scene = bar(Foot::Clamped, 1e4, 1.0 / bar_mass, spans);
                let (found, leant, simulation) = struck(scene, step);
                let arrivals = simulation.arrivals().len();
                println!(
                    "{bar_mass:5} {spans:5} {step:6}  {found:.4}   {leant:.3}  {arrivals} arrivals"
                );
                assert!(arrivals <= 40);
                // Errors due to the mass of the end node and to the step size.
                let close = tolerance + 0.25 * bar_mass * (0.5 / spans as f64 + step);
                assert!((found - velocity).abs() < close, "{found} {velocity}");
                // On finer meshes, mesh-dependent oscillations after the velocity jump interrupt the contact.
                assert!(spans != 10 || (leant - lasts).abs() < 0.2, "{leant} {lasts}");
            }
        }
    }
}

#[test]
fn the_rebound_is_the_same_over_ten_decades_of_stiffness() {
    for step in [0.05, 20.0] {
        let at_stiffness = |axial: f64| struck(bar(Foot::Clamped, axial, 1.0, 10), step).0;
        let first = at_stiffness(1e2);
        for exponent in [4, 6, 8, 10, 12] {
            let found = at_stiffness(10_f64.powi(exponent));
            assert!((found - first).abs() < 1e-6, "1e{exponent}, {step}: {found} {first}");
        }
    }
}

#[test]
fn unresolved_rebound_agrees_with_a_rigid_body_at_any_step_and_mesh() {
    println!("  EA  spans  clamped    free");
    for exponent in [4, 6, 8, 10, 12] {
        for spans in [4, 10, 40] {
            let axial = 10_f64.powi(exponent);
            // Steps of at least 10 L/c, for a clamped bar and for free bars of one third of the mass of the bead and of its mass.
            for step in [10.0, 30.0] {
                let (clamped, _, simulation) = struck(bar(Foot::Clamped, axial, 1.0, spans), step);
                let kinds: Vec<_> = simulation.arrivals().iter().map(|a| a.kind).collect();
                assert_eq!(kinds, [ArrivalKind::Bounced]);
                let free = [1.0, 1.0 / 3.0]
                    .map(|mass| struck(bar(Foot::Free, axial, mass, spans), step).0);
                println!("1e{exponent:2} {spans:5}  {clamped:.6}  {:.6} {:.6}", free[0], free[1]);
                assert!((clamped + 1.0).abs() < 2e-4, "{clamped}");
                assert!(free[0].abs() < 2e-4 && (free[1] + 0.5).abs() < 2e-4, "{free:?}");
            }
        }
    }
}

#[test]
fn ring_on_a_steel_rod_leaves_its_stop_at_any_step_size() {
    // 1 kg on a clamped rod of 1 m and 1 cm²: a wave needs 0.2 ms. With the restitution 0.5 each impact halves the speed.
    let steel = Section {
        axial_stiffness: 2.1e7,
        shear_stiffness: 6.7e6,
        bending_stiffness: 175.0,
        mass_per_length: 0.785,
        rotary_inertia: 6.5e-6,
    };
    for dt in [1e-3, 1e-2, 1e-1] {
        for restitution in [1.0, 0.5] {
            let mut scene = Scene::new("rod");
            let mesh = Mesh::bspline(8, 3, 2).unwrap();
            add_beam(&mut scene, line(at(0.0, 0.0), at(1.0, 0.0)), &mesh, steel);
            let start = scene.station(0, 0.0).unwrap();
            scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
            bead(&mut scene, 0.5, 1.0, at(1.0, 0.0), EndAction::Bounce);
            scene.sliders[0].restitution = restitution;
            let mut simulation =
                Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
            run(&mut simulation, 0.9).unwrap();
            let place = simulation.model().slider_position(0);
            let expected = 1.0 - 0.4 * restitution;
            assert!((place - expected).abs() < 1e-3, "dt = {dt}, e = {restitution}: {place}");
            let lost = simulation.history().samples().last().unwrap().measures.dissipated;
            let all = 0.5 * (1.0 - restitution * restitution);
            assert!((lost - all).abs() < 1e-3, "{lost} {all}");
            assert!(simulation.history().drift(Invariant::Energy) < 1e-12);
        }
    }
}
