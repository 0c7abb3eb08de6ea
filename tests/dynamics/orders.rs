//! Orders of convergence in time and space, against fine runs and the references with a smooth pulse.
#![allow(clippy::unwrap_used)]

use crate::common::reference::{Table, distance};
use crate::common::{ends, orders, scenes, sci, simulate};
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, Method};

/// References of the spaghetti with a smooth pulse, and their bending stiffness.
const PULSES: [(&str, f64); 2] = [("P1s.csv", 100.0), ("P2s.csv", 500.0)];

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

/// Positions of the ends of the beam at t = 5, twice the duration of the pulse.
fn fly(mesh: &Mesh, bending: f64, method: Method, dt: f64) -> [Vec2; 2] {
    ends(&simulate(scenes::smooth_spaghetti(mesh, bending), method, dt, 5.0))
}

/// Extrapolation to dt → 0 from two runs of a second-order method.
fn extrapolated(mesh: &Mesh, bending: f64, dt: f64) -> [Vec2; 2] {
    let [coarse, fine] = [dt, 0.5 * dt].map(|dt| fly(mesh, bending, Method::EnergyMomentum, dt));
    [0, 1].map(|end| (fine[end] * 4.0 - coarse[end]) / 3.0)
}

/// Method of a row, with strong numerical damping where weak damping would hide the first order behind the second.
fn representative(method: Method) -> Method {
    match method {
        Method::EnergyDecaying { .. } => Method::EnergyDecaying { chi: 1.0 },
        other => other,
    }
}

#[test]
fn every_integrator_converges_in_time_at_the_order_it_claims() {
    for entry in INTEGRATORS {
        for (file, bending) in PULSES {
            // Largest step in the asymptotic range of the method.
            let largest = match entry.claims.order {
                1 => 0.0125,
                4 => 0.025,
                _ => 0.05,
            };
            let dts = [1.0, 0.5, 0.25, 0.125, 0.0625].map(|part| part * largest);
            let found = dts.map(|dt| fly(&smooth(14), bending, representative(entry.method), dt));
            let changes: Vec<f64> =
                found.windows(2).map(|pair| distance(&pair[0], &pair[1])).collect();
            let slopes = orders(&changes);
            println!(
                "{:16} {file:8} change on halving {} orders {slopes:.2?}",
                entry.name,
                sci(&changes)
            );
            // At the first step sizes, high-order methods do not resolve the fast vibrations.
            let (order, last) = (f64::from(entry.claims.order), slopes[slopes.len() - 1]);
            assert!((last - order).abs() < 0.15, "{}", entry.name);
            assert!(slopes[1..].iter().all(|slope| *slope > order - 0.2), "{}", entry.name);
        }
    }
}

#[test]
fn smooth_cubics_with_the_patch_rule_converge_in_space_at_third_order() {
    for (file, bending) in PULSES {
        let reference = Table::read(file).ends(5.0);
        let errors: Vec<f64> = [16, 32, 64]
            .into_iter()
            .map(|spans| distance(&extrapolated(&smooth(spans), bending, 0.005), &reference))
            .collect();
        let slopes = orders(&errors);
        println!("{file:8} error with 16, 32, 64 spans {} orders {slopes:.2?}", sci(&errors));
        assert!(errors[2] < 5e-5, "{file}: {}", errors[2]);
        assert!(slopes.iter().all(|slope| *slope > 2.85), "{file}: {slopes:?}");
    }
}

#[test]
fn cubic_lagrange_elements_converge_at_nearly_sixth_order_at_their_nodes() {
    // Three quadrature points per element for strain and curvature.
    let reference = Table::read("P2s.csv").ends(5.0);
    let errors: Vec<f64> = [8, 16]
        .into_iter()
        .map(|elements| {
            let mesh = Mesh::lagrange(elements, 3).unwrap();
            distance(&extrapolated(&mesh, 500.0, 0.005), &reference)
        })
        .collect();
    println!(
        "cubic Lagrange: error with 8, 16 elements {} orders {:.2?}",
        sci(&errors),
        orders(&errors)
    );
    assert!(orders(&errors)[0] > 5.0);
}

#[test]
fn refining_space_and_time_together_converges_to_the_references_at_second_order() {
    for (file, bending) in PULSES {
        let reference = Table::read(file).ends(5.0);
        let errors: Vec<f64> = [(16, 0.02), (32, 0.01), (64, 0.005)]
            .into_iter()
            .map(|(spans, dt)| {
                distance(&fly(&smooth(spans), bending, Method::EnergyMomentum, dt), &reference)
            })
            .collect();
        let slopes = orders(&errors);
        println!(
            "{file:8} error of (16, 0.02), (32, 0.01), (64, 0.005) {} orders {slopes:.2?}",
            sci(&errors)
        );
        assert!(slopes.iter().all(|slope| *slope > 1.85), "{file}: {slopes:?}");
    }
}
