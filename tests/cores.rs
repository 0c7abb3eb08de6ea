//! Large beams are worked on by several threads at once, with the bits of one.
#![allow(clippy::unwrap_used)]

mod common;

use common::sliding_scenes::abacus;
use common::{scenes, settings};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::joints::SlidingRule;
use withy::model::{Model, ModelState, Scene};
use withy::simulation::{Simulation, Unwatched};

/// Runs a few steps with up to so many threads; the state at the end, and what was left of the equations.
fn state(scene: &Scene, method: Method, threads: usize) -> (ModelState, usize) {
    let mut simulation = Simulation::start(scene.clone(), settings(method, 0.01)).unwrap();
    simulation.use_threads(threads);
    for _ in 0..2 {
        simulation.step(&mut Unwatched).unwrap();
    }
    (simulation.model().state(), simulation.counts().newton_iterations)
}

/// How many threads work on a scene at most.
fn threads(scene: &Scene, allowed: usize) -> usize {
    Model::assemble(scene).unwrap().divide(allowed)
}

#[test]
fn any_number_of_threads_comes_to_the_same_bits() {
    let section = scenes::spaghetti_section(1e4, 100.0);
    let bspline = |spans, degree, continuity| Mesh::bspline(spans, degree, continuity).unwrap();
    let lagrange = |elements, degree| Mesh::lagrange(elements, degree).unwrap();
    let cases = [
        (scenes::spaghetti(&bspline(6100, 3, 2), 1e4), 3),
        (scenes::blown_cantilever(&bspline(4001, 3, 1)), 2),
        (scenes::curved_pendulum(&lagrange(4003, 2)), 2),
        (scenes::cantilever(&lagrange(4100, 1), section), 2),
        (scenes::spaghetti(&bspline(4050, 5, 4), 1e4), 2),
        (abacus(&bspline(4100, 3, 2), SlidingRule::Conserving), 2),
    ];
    for (scene, parts) in cases {
        assert_eq!(threads(&scene, 3), parts, "{}", scene.name);
        for method in [Method::EnergyMomentum, Method::GeneralizedAlpha { rho_infinity: 0.8 }] {
            let one = state(&scene, method, 1);
            for allowed in [2, 3] {
                assert!(state(&scene, method, allowed) == one, "{}, {allowed}", scene.name);
            }
        }
    }
}

#[test]
fn small_beams_and_closed_ones_are_left_to_one_thread() {
    let mesh = |spans| Mesh::bspline(spans, 3, 2).unwrap();
    assert_eq!(threads(&scenes::spaghetti(&mesh(14), 1e4), 8), 1);
    assert_eq!(threads(&scenes::spaghetti(&mesh(3999), 1e4), 8), 1);
    // The numbers of a ring go to and fro.
    assert_eq!(threads(&scenes::hoop(&mesh(6000)), 8), 1);
}
