//! Pinned work counts of named benchmarks. Every change must be intended.
#![allow(clippy::unwrap_used)]

use crate::common::sliding::{Support, free_sliding_mass, smoothly_pushed_mass};
use crate::common::{scenes, simulate, sliding_scenes};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::joints::SlidingRule;
use withy::simulation::WorkCounts;
use withy::system::Scene;

const EXPECTED: &str = "\
spaghetti, C2             unknowns  51 band 11 steps  75 iterations 150 most 2 corrections  228 factorised 150 retries 0
spaghetti, C2, EA = 1e10  unknowns  51 band 11 steps  75 iterations 150 most 2 corrections  230 factorised 150 retries 0
spaghetti, C2, dt = 0.2   unknowns  51 band 11 steps  39 iterations  81 most 3 corrections  158 factorised  81 retries 0
spaghetti, C1             unknowns  48 band 11 steps  75 iterations 150 most 2 corrections  245 factorised 150 retries 0
spaghetti, linear         unknowns  33 band  5 steps  75 iterations 150 most 2 corrections  180 factorised 150 retries 0
spaghetti, trapezoidal    unknowns  48 band 11 steps  75 iterations 151 most 3 corrections  269 factorised 151 retries 0
spaghetti, decaying       unknowns  51 band 11 steps  75 iterations 150 most 2 corrections  187 factorised 150 retries 0
spaghetti, order 4        unknowns  51 band 11 steps  75 iterations 736 most 12 corrections 1746 factorised 736 retries 0
spaghetti, alpha          unknowns  51 band 11 steps  75 iterations 151 most 3 corrections  248 factorised 151 retries 0
curved pendulum           unknowns  49 band 11 steps 150 iterations 296 most 2 corrections  315 factorised 296 retries 0
blown cantilever          unknowns  48 band 11 steps 150 iterations 269 most 2 corrections  392 factorised 269 retries 0
four-bar linkage          unknowns 145 band 11 steps 150 iterations 366 most 3 corrections  477 factorised 366 retries 0
flying loop               unknowns 196 band 21 steps 150 iterations 300 most 2 corrections  491 factorised 300 retries 0
hoop                      unknowns  48 band 25 steps 150 iterations 289 most 2 corrections  292 factorised 289 retries 0
";

const EXPECTED_OF_SLIDERS: &str = "\
sliding mass, C1          unknowns  53 band 11 steps  35 iterations  74 most 3 corrections  141 factorised  83 retries 0 tries 4
sliding mass, C2          unknowns  41 band 11 steps  34 iterations  72 most 3 corrections  136 factorised  82 retries 0 tries 5
sliding mass, Lagrange    unknowns  65 band 11 steps  34 iterations  83 most 3 corrections  116 factorised  98 retries 0 tries 7
sliding mass, C2, hinged  unknowns  39 band 11 steps  53 iterations 113 most 3 corrections  217 factorised 126 retries 0 tries 6
sliding mass, C2, exact   unknowns  41 band 11 steps  34 iterations  72 most 3 corrections  137 factorised  82 retries 0 tries 5
sliding mass, trapezoidal unknowns  41 band 11 steps  29 iterations  67 most 3 corrections  111 factorised  67 retries 0 tries 0
sliding mass, decaying    unknowns  41 band 11 steps  34 iterations  69 most 3 corrections  115 factorised  79 retries 0 tries 5
sliding mass, order 4     unknowns  41 band 11 steps  35 iterations 367 most 13 corrections  774 factorised 409 retries 0 tries 8
sliding mass, alpha       unknowns  41 band 11 steps  29 iterations  63 most 3 corrections  117 factorised  63 retries 0 tries 0
pushed mass               unknowns 105 band 11 steps 100 iterations 197 most 2 corrections  200 factorised 197 retries 0 tries 0
abacus                    unknowns  72 band 11 steps  50 iterations  50 most 1 corrections  150 factorised  50 retries 0 tries 0
eyelet                    unknowns  56 band 11 steps  70 iterations  70 most 1 corrections  213 factorised  70 retries 0 tries 0
pinned cross              unknowns 112 band 11 steps  70 iterations 140 most 2 corrections  159 factorised 140 retries 0 tries 0
";

fn benchmarks() -> Vec<(&'static str, Scene, Method, f64)> {
    use Method::{EnergyDecaying, EnergyMomentum, FourthOrder, GeneralizedAlpha, Trapezoidal};
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
        ("spaghetti, decaying", scenes::spaghetti(&smooth, 1e4), EnergyDecaying { chi: 0.1 }, 0.1),
        ("spaghetti, order 4", scenes::spaghetti(&smooth, 1e4), FourthOrder, 0.1),
        (
            "spaghetti, alpha",
            scenes::spaghetti(&smooth, 1e4),
            GeneralizedAlpha { rho_infinity: 0.8 },
            0.1,
        ),
        ("curved pendulum", scenes::curved_pendulum(&smooth), EnergyMomentum, 0.05),
        ("blown cantilever", scenes::blown_cantilever(&smooth), EnergyMomentum, 0.05),
        ("four-bar linkage", scenes::four_bar_linkage(&smooth), EnergyMomentum, 0.05),
        ("flying loop", scenes::flying_loop(&smooth), EnergyMomentum, 0.05),
        ("hoop", scenes::hoop(&smooth), EnergyMomentum, 0.05),
    ]
}

/// Scenes with sliders, with their method, step size and end time.
fn sliding_benchmarks() -> Vec<(&'static str, Scene, Method, f64, f64)> {
    use Method::{EnergyDecaying, EnergyMomentum, FourthOrder, GeneralizedAlpha, Trapezoidal};
    use SlidingRule::{Conserving, Exact};
    use Support::{Free, Hinged};
    let bspline = |spans, continuity| Mesh::bspline(spans, 3, continuity).unwrap();
    let (smooth, dt) = (bspline(14, 2), 0.01067);
    let (c1, c2) = ([bspline(2, 1), bspline(4, 1)], [bspline(2, 2), bspline(4, 2)]);
    let lagrange = [2, 4].map(|elements| Mesh::lagrange(elements, 3).unwrap());
    let mass = |meshes: &[Mesh; 2], support, rule| {
        free_sliding_mass([&meshes[0], &meshes[1]], 1e2, support, rule)
    };
    let pushed = smoothly_pushed_mass([&smooth, &smooth], Hinged, Conserving);
    vec![
        ("sliding mass, C1", mass(&c1, Free, Conserving), EnergyMomentum, dt, 1.0),
        ("sliding mass, C2", mass(&c2, Free, Conserving), EnergyMomentum, dt, 1.0),
        ("sliding mass, Lagrange", mass(&lagrange, Free, Conserving), EnergyMomentum, dt, 1.0),
        ("sliding mass, C2, hinged", mass(&c2, Hinged, Conserving), EnergyMomentum, dt, 1.0),
        ("sliding mass, C2, exact", mass(&c2, Free, Exact), EnergyMomentum, dt, 1.0),
        ("sliding mass, trapezoidal", mass(&c2, Free, Conserving), Trapezoidal, dt, 0.3),
        (
            "sliding mass, decaying",
            mass(&c2, Free, Conserving),
            EnergyDecaying { chi: 0.1 },
            dt,
            1.0,
        ),
        ("sliding mass, order 4", mass(&c2, Free, Conserving), FourthOrder, dt, 1.0),
        (
            "sliding mass, alpha",
            mass(&c2, Free, Conserving),
            GeneralizedAlpha { rho_infinity: 0.8 },
            dt,
            0.3,
        ),
        ("pushed mass", pushed, EnergyMomentum, 0.005, 0.5),
        ("abacus", sliding_scenes::abacus(&smooth, Conserving), EnergyMomentum, 0.01, 0.5),
        ("eyelet", sliding_scenes::eyelet(&smooth, Conserving), EnergyMomentum, 0.01, 0.7),
        (
            "pinned cross",
            sliding_scenes::pinned_cross(&smooth, Conserving),
            EnergyMomentum,
            0.01,
            0.7,
        ),
    ]
}

fn line(
    (name, scene, method, dt, end): (&str, Scene, Method, f64, f64),
    note: impl Fn(&WorkCounts) -> String,
) -> String {
    let simulation = simulate(scene, method, dt, end);
    let work = simulation.counts();
    format!(
        "{name:25} unknowns {:3} band {:2} steps {:3} iterations {:3} most {} corrections {:4} factorised {:3} retries {}{}\n",
        simulation.unknowns(),
        simulation.half_bandwidth(),
        work.steps,
        work.newton_iterations,
        work.newton_max,
        work.corrections,
        work.factorisations,
        work.retries,
        note(work)
    )
}

#[test]
fn work_counts_of_benchmarks_equal_recorded_counts() {
    let whole = |(name, scene, method, dt)| line((name, scene, method, dt, 7.5), |_| String::new());
    let found: String = benchmarks().into_iter().map(whole).collect();
    assert_eq!(found, EXPECTED, "\n{found}");
}

#[test]
fn work_counts_of_sliders_equal_recorded_counts() {
    let tries = |work: &WorkCounts| format!(" tries {}", work.arrival_tries);
    let found: String = sliding_benchmarks().into_iter().map(|row| line(row, tries)).collect();
    assert_eq!(found, EXPECTED_OF_SLIDERS, "\n{found}");
}
