//! Convergence of sliding joints in time and space, with respect to fine runs and to the references with a moving mesh.
#![allow(clippy::unwrap_used)]

use crate::common::reference::Table;
use crate::common::sliding::reference_scene;
use crate::common::{at, orders, run, sci, settings, simulate};
use withy::beams::Station;
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{SLIDING_RULES, SlidingRule};
use withy::simulation::Simulation;

fn position(simulation: &Simulation, station: &Station) -> Vec2 {
    simulation.model().position(&simulation.place(station).unwrap())
}

/// Arc length of the contact on beam AB.
fn contact_length(simulation: &Simulation) -> f64 {
    10_f64.sqrt() * simulation.model().slider_position(0)
}

fn contact_point(simulation: &Simulation) -> Vec2 {
    position(simulation, &simulation.scene().sliders[0].slave)
}

#[test]
fn sliders_converge_in_time_at_second_order() {
    let cases = [
        ("P7b", 0.4),
        ("P7c", 0.4),
        ("P7c", 1.0),
        ("P7d", 0.3),
        ("P8s_free", 0.25),
        ("P8s_free", 0.4),
        ("P8s_hinged", 0.4),
        ("P8s_hinged", 0.55),
    ];
    let dts = [0.001, 0.0005, 0.00025, 0.000125];
    let check = |method: Method, rule: SlidingRule, reference: &str, end: f64| {
        let found: Vec<(f64, Vec2)> = dts
            .into_iter()
            .map(|dt| {
                let flight = simulate(reference_scene(reference, 4, rule), method, dt, end);
                (contact_length(&flight), contact_point(&flight))
            })
            .collect();
        let change = |pair: &[(f64, Vec2)]| {
            (pair[0].0 - pair[1].0).abs().max((pair[0].1 - pair[1].1).norm())
        };
        let changes: Vec<f64> = found.windows(2).map(change).collect();
        let slopes = orders(&changes);
        println!(
            "{:16} {rule:10?} {reference:10} t = {end:4} change on halving {} orders {slopes:.2?}",
            method.entry().name,
            sci(&changes)
        );
        // The relaxed rule comes close to having no solution, so its increments are irregular.
        let margin = match rule {
            SlidingRule::Relaxed => 0.5,
            SlidingRule::Kinked => 0.3,
            SlidingRule::Conserving | SlidingRule::Exact => 0.2,
        };
        assert!((slopes[1] - 2.0).abs() < margin, "{rule:?}, {reference}: {slopes:?}");
    };
    for (reference, end) in cases {
        for entry in SLIDING_RULES.iter().filter(|entry| entry.claims.gap) {
            check(Method::EnergyMomentum, entry.rule, reference, end);
        }
        check(Method::Trapezoidal, SlidingRule::Conserving, reference, end);
    }
    check(Method::EnergyMomentum, SlidingRule::Relaxed, "P7d", 0.3);
    check(Method::EnergyMomentum, SlidingRule::Relaxed, "P8s_free", 0.4);
}

/// Errors of the contact length, the contact point and a third point, for increasing numbers of spans.
fn errors_in_space(
    reference: &str,
    end: f64,
    dt: f64,
    third: (&str, &str, Station),
    spans: &[usize],
) -> [Vec<f64>; 3] {
    let table = Table::read(&format!("{reference}.csv"));
    let exact = |x: &str, y: &str| at(table.at(end, x), table.at(end, y));
    let mut errors = [const { Vec::new() }; 3];
    for &spans in spans {
        let scene = reference_scene(reference, spans, SlidingRule::Conserving);
        let flight = simulate(scene, Method::EnergyMomentum, dt, end);
        errors[0].push((contact_length(&flight) - table.at(end, "S")).abs());
        errors[1].push((contact_point(&flight) - exact("xC", "yC")).norm());
        errors[2].push((position(&flight, &third.2) - exact(third.0, third.1)).norm());
    }
    for (what, errors) in ["S", "C", &third.0[1..]].iter().zip(&errors) {
        println!("{reference:10} t = {end} {what}: {} orders {:.2?}", sci(errors), orders(errors));
    }
    errors
}

/// Mean observed order of errors when spans are doubled.
fn slope(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// Returns true if the errors decrease with at least this order, or if all errors are small.
fn converges(errors: &[f64], order: f64, small: f64) -> bool {
    slope(errors) > order || errors.iter().all(|error| *error < small)
}

#[test]
fn a_sliding_particle_converges_to_the_references_at_first_order_in_space() {
    // The exact tangent jumps at a loaded contact. A mesh that is smooth there distributes the jump over its spans.
    let b = ("xB", "yB", Station::on_beam(0, 10_f64.sqrt()));
    for (reference, end) in [("P7b", 0.2), ("P7b", 0.4), ("P7c", 0.4), ("P7c", 1.0), ("P7d", 0.3)] {
        let [length, point, tip] = errors_in_space(reference, end, 0.0005, b, &[8, 16, 32, 64]);
        assert!((0.75..1.35).contains(&slope(&point)), "{reference}: {point:?}");
        // The error of the contact length changes its sign during refinement.
        assert!(converges(&length, 0.6, 1.2e-3), "{reference}: {length:?}");
        assert!(converges(&tip, 0.75, 0.0), "{reference}: {tip:?}");
        assert!(length[3] < 5e-4 && point[3] < 1e-3 && tip[3] < 3e-3, "{reference}");
    }
}

#[test]
fn two_beams_converge_to_the_references_at_first_order_in_space() {
    let m = ("xM", "yM", Station::on_beam(1, 1.0));
    for reference in ["P8s_free", "P8s_hinged"] {
        for (end, farthest) in [(0.1, 1e-3), (0.2, 5e-3), (0.3, 6e-3)] {
            let [length, point, mass] =
                errors_in_space(reference, end, 0.0005, m, &[8, 16, 32, 64]);
            // The contact point converges more slowly and irregularly, as with the fixed-mesh solver of the references.
            assert!(converges(&mass, 0.8, 2e-5), "{reference}: {mass:?}");
            assert!(mass[3] < 2e-3 && length[3] < farthest && point[3] < farthest, "{reference}");
        }
    }
}

#[test]
fn energies_converge_to_those_of_the_references() {
    for (reference, end) in [("P7b", 0.4), ("P7c", 0.4), ("P7d", 0.3), ("P8s_hinged", 0.2)] {
        let table = Table::read(&format!("{reference}.csv"));
        let errors: Vec<f64> = [8, 16, 32, 64]
            .into_iter()
            .map(|spans| {
                let scene = reference_scene(reference, spans, SlidingRule::Conserving);
                let flight = simulate(scene, Method::EnergyMomentum, 0.0005, end);
                let energy = flight.history().samples().last().unwrap().measures.energy;
                let kinetic = energy.kinetic - table.at(end, "KE");
                kinetic.abs().max((energy.strain - table.at(end, "SE")).abs())
            })
            .collect();
        let share: Vec<f64> = errors.iter().map(|error| error / table.at(end, "E")).collect();
        println!(
            "{reference:10} t = {end} KE, SE: {} of E, orders {:.2?}",
            sci(&share),
            orders(&share)
        );
        assert!(converges(&share, 0.6, 1e-5) && share[3] < 1e-3, "{reference}: {share:?}");
    }
}

#[test]
fn sliders_reverse_at_the_reference_turning_points() {
    // Turning point ξ, and time of passing 0.95 on the way out: P7c, P8s hinged (README of the references).
    for (reference, turning, end, back) in
        [("P7c", 0.42165, 1.2, 1.101_05), ("P8s_hinged", 0.2687, 0.7, 0.628_61)]
    {
        let scene = reference_scene(reference, 32, SlidingRule::Conserving);
        let mut flight = Simulation::start(scene, settings(Method::EnergyMomentum, 0.001)).unwrap();
        run(&mut flight, end).unwrap();
        let history = flight.history();
        let (xi, speed, force) = (
            history.column("slider1.position").unwrap(),
            history.column("slider1.speed").unwrap(),
            history.column("slider1.force").unwrap(),
        );
        let turned = (1..xi.len() - 1).min_by(|a, b| xi[*a].total_cmp(&xi[*b])).unwrap();
        let samples = history.samples();
        let out = (turned..xi.len()).find(|row| xi[*row] > 0.95).unwrap();
        let found = samples[out].measures.time;
        let around = &samples[turned - 5..turned + 6];
        let iterations = around.iter().map(|row| row.newton_iterations).max().unwrap();
        println!(
            "{reference:10} turns at ξ = {:.5}, t = {:.3} with {iterations} iterations at most, speed {:.2} → {:.2}; passes 0.95 at t = {found:.4}",
            xi[turned],
            samples[turned].measures.time,
            speed[turned - 5],
            speed[turned + 5]
        );
        assert!((xi[turned] - turning).abs() < 2e-3, "{}", xi[turned]);
        assert!((found - back).abs() < 5e-3, "{found}");
        assert!(speed[turned - 5] < 0.0 && speed[turned + 5] > 0.0 && iterations <= 3);
        let largest = |rows: &[f64]| rows.iter().fold(0.0, |most: f64, force| most.max(*force));
        assert!(largest(&force[turned - 5..turned + 6]) <= largest(&force));
        assert_eq!(flight.counts().retries, 0);
    }
}
