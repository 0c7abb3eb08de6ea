//! Published and exact results: the flying spaghetti, and its energy as a function of the stiffness.
#![allow(clippy::unwrap_used)]

use crate::common::reference::{Table, distance};
use crate::common::{at, ends, meshes, points, scenes, simulate};
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::simulation::{Invariant, Simulation};

fn bspline(spans: usize, degree: usize, continuity: usize) -> Mesh {
    Mesh::bspline(spans, degree, continuity).unwrap()
}

fn lagrange(elements: usize, degree: usize) -> Mesh {
    Mesh::lagrange(elements, degree).unwrap()
}

/// Flying spaghetti at t = 7.5 with steps of 0.1.
fn fly(mesh: &Mesh, method: Method) -> Simulation {
    simulate(scenes::spaghetti(mesh, 1e4), method, 0.1, 7.5)
}

/// Energy and angular momentum at the end of the loads, t = 2.5.
fn when_released(simulation: &Simulation) -> (f64, f64) {
    let row = simulation.history().between(2.5, 2.5).samples()[0].measures;
    (row.energy.total(), row.angular_momentum)
}

fn assert_digits(found: f64, expected: f64, unit: f64) {
    assert!((found - expected).abs() <= 0.51 * unit, "{found} is not {expected}");
}

fn assert_ends(simulation: &Simulation, expected: [Vec2; 2]) {
    let error = distance(&ends(simulation), &expected);
    assert!(error < 1e-8, "{:?} are not {expected:?}", ends(simulation));
}

/// C¹ cubics of Sibileau & Muñoz with three Gauss points per span. The pinned results are from an independent program that is not part of this repository. The
/// results for the locking table are in docs/theory.md, section 4.
fn paper_cubics() -> Mesh {
    points(bspline(7, 3, 1), 3)
}

#[test]
fn seven_c1_spans_reproduce_the_recorded_flight() {
    let flight = fly(&paper_cubics(), Method::EnergyMomentum);
    let (energy, angular_momentum) = when_released(&flight);
    assert_digits(energy, 378.80136246, 1e-8);
    assert_digits(angular_momentum, -229.590894, 1e-6);
    assert_ends(&flight, [at(17.29509801, 8.15998773), at(16.44383674, -0.09744164)]);
}

#[test]
fn ten_linear_elements_reproduce_the_recorded_flight() {
    let flight = fly(&lagrange(10, 1), Method::EnergyMomentum);
    assert_digits(when_released(&flight).0, 380.07926047, 1e-8);
    assert_ends(&flight, [at(17.13720609, 8.21827676), at(16.55098127, -0.17369076)]);
}

#[test]
fn trapezoidal_rule_reproduces_the_recorded_flight() {
    let flight = fly(&paper_cubics(), Method::Trapezoidal);
    assert_digits(when_released(&flight).0, 374.282850, 1e-6);
    assert_ends(&flight, [at(17.06268344, 8.32680696), at(16.38276885, -0.27137152)]);
    let free = flight.history().between(2.5, 7.5);
    let energies: Vec<f64> = free.samples().iter().map(|row| row.measures.energy.total()).collect();
    let lowest = energies.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = energies.iter().copied().fold(0.0, f64::max);
    assert_digits(lowest, 369.74, 1e-2);
    assert_digits(highest, 374.74, 1e-2);
}

/// `E(2.5)`, or `None` if the run fails.
fn energy(mesh: &Mesh, stiffness: f64, dt: f64) -> Option<f64> {
    let scene = scenes::spaghetti(mesh, stiffness);
    let settings = crate::common::settings(Method::EnergyMomentum, dt);
    let mut simulation = Simulation::start(scene, settings).unwrap();
    crate::common::run(&mut simulation, 2.5).ok().map(|()| when_released(&simulation).0)
}

/// Name, mesh, and `E(2.5)` for values of `EA = GA`.
type Row = (&'static str, Mesh, &'static [(f64, f64)]);

#[test]
fn locking_table_agrees_with_the_theory_document() {
    // docs/theory.md, section 4, gives these results with fewer digits.
    let table: [Row; 7] = [
        (
            "cubic C2, 14",
            bspline(14, 3, 2),
            &[(1e4, 391.23), (1e6, 391.23), (1e8, 391.23), (1e10, 391.23)],
        ),
        ("cubic C1, 7", bspline(7, 3, 1), &[(1e4, 395.34), (1e6, 395.45), (1e8, 395.45)]),
        ("cubic C1, 7, 3 points", paper_cubics(), &[(1e4, 378.80), (1e6, 348.63), (1e8, 170.96)]),
        (
            "cubic C1, 7, 2 points",
            points(bspline(7, 3, 1), 2),
            &[(1e4, 396.03), (1e6, 396.03), (1e8, 396.03)],
        ),
        ("linear, 14", lagrange(14, 1), &[(1e4, 380.24), (1e6, 380.23), (1e8, 380.23)]),
        ("cubic Lagrange, 5, 3 points", lagrange(5, 3), &[(1e4, 385.65), (1e8, 385.68)]),
        ("cubic Lagrange, 5, 2 points", points(lagrange(5, 3), 2), &[(1e4, 389.21)]),
    ];
    for (name, mesh, figures) in table {
        for &(stiffness, expected) in figures {
            let found = energy(&mesh, stiffness, 0.1).unwrap();
            println!("{name:28} EA = {stiffness:4e}  E(2.5) = {found:.4}  ({expected})");
            assert_digits(found, expected, 1e-2);
        }
    }
}

#[test]
fn meshes_lock_only_with_at_least_as_many_force_points_as_functions() {
    let mut named = meshes(14);
    named.push(("cubic C1, 3 points", points(bspline(7, 3, 1), 3)));
    named.push(("quadratic C1, 2 points", points(bspline(14, 2, 1), 2)));
    for (name, mesh) in named {
        let [soft, stiff] = [1e4, 1e8].map(|stiffness| energy(&mesh, stiffness, 0.025).unwrap());
        println!("{name:24} E(2.5) = {soft:.3} at EA = 1e4, {stiff:.3} at 1e8");
        let locks = stiff < 0.98 * soft;
        assert_eq!(locks, mesh.point_counts().force >= mesh.basis().functions(), "{name}");
        assert!(locks || (stiff / soft - 1.0).abs() < 1e-2, "{name}: {soft} {stiff}");
    }
}

#[test]
fn smooth_cubics_need_two_iterations_a_step_at_any_stiffness() {
    for stiffness in [1e4, 1e6, 1e8, 1e10] {
        let scene = scenes::spaghetti(&bspline(14, 3, 2), stiffness);
        let flight = simulate(scene, Method::EnergyMomentum, 0.1, 7.5);
        let counts = flight.counts();
        let drift = flight.history().drift(Invariant::Energy);
        println!(
            "EA = {stiffness:6.0e}: {:.2} iterations a step, at most {}, energy drift {drift:.1e}",
            counts.newton_iterations as f64 / counts.steps as f64,
            counts.newton_max
        );
        assert!(counts.newton_max == 2 && counts.retries == 0 && drift < 1e-14);
    }
}

/// Largest position error of the ends with respect to a step-load reference.
fn step_load_error(file: &str, bending: f64, spans: usize, dt: f64) -> f64 {
    let reference = Table::read(file);
    let load = withy::loads::Schedule::hold_for(2.5).unwrap();
    let section = scenes::spaghetti_section(1e4, bending);
    let scene = scenes::thrown(&bspline(spans, 3, 2), section, load, Vec2::zeros());
    let settings = crate::common::settings(Method::EnergyMomentum, dt);
    let mut simulation = Simulation::start(scene, settings).unwrap();
    let errors = [2.5, 5.0, 7.5].map(|time| {
        crate::common::run(&mut simulation, time).unwrap();
        reference.error(&simulation)
    });
    println!("{file}, {spans} spans, dt = {dt}: {}", crate::common::sci(&errors));
    errors.into_iter().fold(0.0, f64::max)
}

#[test]
fn refinement_converges_to_the_step_load_references() {
    // The jump of the load causes wave fronts, so the errors decrease monotonically but irregularly.
    for (file, bending, within) in [("P1.csv", 100.0, 1e-2), ("P2.csv", 500.0, 2e-3)] {
        let errors = [(14, 0.05), (28, 0.025), (56, 0.0125)]
            .map(|(spans, dt)| step_load_error(file, bending, spans, dt));
        assert!(errors[1] < 0.6 * errors[0] && errors[2] < 0.6 * errors[1], "{file}: {errors:?}");
        assert!(errors[2] < within, "{file}: {errors:?}");
    }
}
