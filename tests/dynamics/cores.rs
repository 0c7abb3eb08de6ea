//! Large beams are divided between several threads, with the same bits as on one thread.
#![allow(clippy::unwrap_used)]

use crate::common::sliding_scenes::abacus;
use crate::common::{scenes, settings};
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{JointKind, Partner, SlidingRule};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{NoMonitor, Simulation};
use withy::system::{Scene, System, SystemState};

/// Takes two steps with at most this number of threads. Returns the final state and the number of iterations.
fn state(scene: &Scene, method: Method, threads: usize) -> (SystemState, usize) {
    let mut simulation = Simulation::start(scene.clone(), settings(method, 0.01)).unwrap();
    simulation.use_threads(threads);
    for _ in 0..2 {
        simulation.step(&mut NoMonitor).unwrap();
    }
    (simulation.model().state(), simulation.counts().newton_iterations)
}

/// Number of threads that a scene uses, at most `allowed`.
fn threads(scene: &Scene, allowed: usize) -> usize {
    System::assemble(scene).unwrap().divide(allowed)
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let section = scenes::spaghetti_section(1e4, 100.0);
    let bspline = |spans, degree, continuity| Mesh::bspline(spans, degree, continuity).unwrap();
    let lagrange = |elements, degree| Mesh::lagrange(elements, degree).unwrap();
    let cases = [
        (scenes::spaghetti(&bspline(12_100, 3, 2), 1e4), 3),
        (scenes::blown_cantilever(&bspline(8001, 3, 1)), 2),
        (scenes::curved_pendulum(&lagrange(8003, 2)), 2),
        (scenes::cantilever(&lagrange(8100, 1), section), 2),
        (scenes::spaghetti(&bspline(8050, 5, 4), 1e4), 2),
        (abacus(&bspline(8100, 3, 2), SlidingRule::Conserving), 2),
    ];
    for (scene, parts) in cases {
        assert_eq!(threads(&scene, 3), parts, "{}", scene.name);
        let one = state(&scene, Method::EnergyMomentum, 1);
        for allowed in [2, 3] {
            let some = state(&scene, Method::EnergyMomentum, allowed);
            assert!(some == one, "{}, {allowed}", scene.name);
        }
    }
}

/// A hundred beams of forty spans, in parallel or in series. The last beam is loaded. Hinges connect the ends of beams to the starts of others.
fn hundred(step: Vec2) -> Scene {
    let mut scene = Scene::new("a hundred beams");
    let mesh = Mesh::bspline(40, 3, 2).unwrap();
    let along = Vec2::new(3.0, 1.0);
    for beam in 0..100 {
        let from = step * f64::from(beam);
        scenes::add_beam(&mut scene, scenes::line(from, from + along), &mesh, scenes::rod());
    }
    if step == along {
        for beam in 1..100 {
            let end = scenes::end_of(&mut scene, beam - 1);
            let start = scenes::start_of(&mut scene, beam);
            scene.join(JointKind::Hinge, end, Partner::Station(start)).unwrap();
        }
    }
    let station = scenes::end_of(&mut scene, 99);
    let force = LoadKind::Force { station, force: Vec2::new(0.0, 2.0), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    scene
}

#[test]
fn many_bodies_give_the_same_bits_with_two_threads() {
    for step in [Vec2::new(0.0, 2.0), Vec2::new(3.0, 1.0)] {
        let scene = hundred(step);
        assert_eq!(threads(&scene, 2), 2);
        let one = state(&scene, Method::EnergyMomentum, 1);
        assert!(one == state(&scene, Method::EnergyMomentum, 2), "{step}");
    }
}

#[test]
fn methods_that_store_accelerations_give_the_same_bits() {
    let scene = scenes::spaghetti(&Mesh::bspline(8001, 3, 2).unwrap(), 1e4);
    let method = Method::GeneralizedAlpha { rho_infinity: 0.8 };
    assert!(state(&scene, method, 1) == state(&scene, method, 2));
}

#[test]
fn small_and_closed_beams_use_one_thread() {
    let mesh = |spans| Mesh::bspline(spans, 3, 2).unwrap();
    assert_eq!(threads(&scenes::spaghetti(&mesh(14), 1e4), 8), 1);
    assert_eq!(threads(&scenes::spaghetti(&mesh(7999), 1e4), 8), 1);
    // The numbering of a closed beam alternates between both branches.
    assert_eq!(threads(&scenes::hoop(&mesh(9000)), 8), 1);
}
