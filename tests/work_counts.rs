//! The work of named benchmarks, pinned: a change of it must be meant.
#![allow(clippy::unwrap_used)]

mod common;

use common::{scenes, simulate};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::model::Scene;

const EXPECTED: &str = "\
spaghetti, C2             unknowns  51 band 11 steps  75 iterations 225 most 3 factorised 225 retries 0
spaghetti, C2, EA = 1e10  unknowns  51 band 11 steps  75 iterations 225 most 3 factorised 225 retries 0
spaghetti, C2, dt = 0.2   unknowns  51 band 11 steps  39 iterations 141 most 4 factorised 141 retries 0
spaghetti, C1             unknowns  48 band 11 steps  75 iterations 226 most 4 factorised 226 retries 0
spaghetti, linear         unknowns  33 band  5 steps  75 iterations 225 most 3 factorised 225 retries 0
spaghetti, trapezoidal    unknowns  48 band 11 steps  75 iterations 231 most 4 factorised 231 retries 0
curved pendulum           unknowns  49 band 11 steps 150 iterations 450 most 3 factorised 450 retries 0
blown cantilever          unknowns  48 band 11 steps 150 iterations 450 most 3 factorised 450 retries 0
four-bar linkage          unknowns 145 band 11 steps 150 iterations 548 most 4 factorised 548 retries 0
flying loop               unknowns 196 band 21 steps 150 iterations 450 most 3 factorised 450 retries 0
hoop                      unknowns  48 band 25 steps 150 iterations 450 most 3 factorised 450 retries 0
";

fn benchmarks() -> Vec<(&'static str, Scene, Method, f64)> {
    use Method::{EnergyMomentum, Trapezoidal};
    let smooth = Mesh::bspline(14, 3, 2).unwrap();
    let paper = Mesh::bspline(7, 3, 1).unwrap();
    let linear = Mesh::lagrange(10, 1).unwrap();
    vec![
        ("spaghetti, C2", scenes::spaghetti(&smooth, 1e4), EnergyMomentum, 0.1),
        ("spaghetti, C2, EA = 1e10", scenes::spaghetti(&smooth, 1e10), EnergyMomentum, 0.1),
        ("spaghetti, C2, dt = 0.2", scenes::spaghetti(&smooth, 1e4), EnergyMomentum, 0.2),
        ("spaghetti, C1", scenes::spaghetti(&paper, 1e4), EnergyMomentum, 0.1),
        ("spaghetti, linear", scenes::spaghetti(&linear, 1e4), EnergyMomentum, 0.1),
        ("spaghetti, trapezoidal", scenes::spaghetti(&paper, 1e4), Trapezoidal, 0.1),
        ("curved pendulum", scenes::curved_pendulum(&smooth), EnergyMomentum, 0.05),
        ("blown cantilever", scenes::blown_cantilever(&smooth), EnergyMomentum, 0.05),
        ("four-bar linkage", scenes::four_bar_linkage(&smooth), EnergyMomentum, 0.05),
        ("flying loop", scenes::flying_loop(&smooth), EnergyMomentum, 0.05),
        ("hoop", scenes::hoop(&smooth), EnergyMomentum, 0.05),
    ]
}

#[test]
fn the_work_of_the_benchmarks_is_what_it_was() {
    let line = |(name, scene, method, dt): (&str, Scene, Method, f64)| {
        let simulation = simulate(scene, method, dt, 7.5);
        let work = simulation.counts();
        format!(
            "{name:25} unknowns {:3} band {:2} steps {:3} iterations {:3} most {} factorised {:3} retries {}\n",
            simulation.unknowns(),
            simulation.half_bandwidth(),
            work.steps,
            work.newton_iterations,
            work.newton_max,
            work.factorisations,
            work.retries
        )
    };
    let found: String = benchmarks().into_iter().map(line).collect();
    assert_eq!(found, EXPECTED, "\n{found}");
}
