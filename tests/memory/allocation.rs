//! Steps do not allocate memory. The rows of the history are allocated in advance.
#![allow(unsafe_code, clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::common::{
    at, body_scenes, meshes, run, scenes, settings, sleeve_scenes, sliding, sliding_scenes,
};
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{JointKind, Partner, Restraint, SLIDING_RULES, Side, Slider};
use withy::simulation::{NoMonitor, Recording, Simulation, StepControl};
use withy::system::Scene;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// Counts the allocations of each thread.
struct Counting;

fn count() {
    // The counter of a thread that terminates is no longer available.
    let _ = ALLOCATIONS.try_with(|allocations| allocations.set(allocations.get() + 1));
}

// SAFETY: every call is forwarded unchanged to the system allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations_of(action: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    action();
    ALLOCATIONS.get() - before
}

#[test]
fn allocation_counter_counts_allocations() {
    assert_eq!(allocations_of(|| drop(std::hint::black_box(vec![1_u8; 100]))), 1);
}

#[test]
fn steps_of_varying_size_take_no_allocations() {
    let scene = scenes::spaghetti(&withy::beams::Mesh::bspline(14, 3, 2).unwrap(), 1e4);
    let control = StepControl { largest: Some(0.001), ..StepControl::to(1e-3) };
    let settings = settings(Method::EnergyMomentum, control);
    let mut simulation = Simulation::start(scene, settings).unwrap();
    let mut until = |end: f64| allocations_of(|| run(&mut simulation, end).unwrap());
    until(0.01);
    let (few, many) = (until(0.02), until(0.17));
    assert!(few <= 4 && many <= 4, "{few} in 10 steps, {many} in 150");
}

/// Runs a scene for few and for many steps. Both runs must take at most `most` allocations.
fn assert_bounded(label: &str, scene: Scene, method: Method, most: usize) {
    let mut simulation = Simulation::start(scene, settings(method, 0.001)).unwrap();
    let mut until = |end: f64| allocations_of(|| run(&mut simulation, end).unwrap());
    until(0.01);
    let (few, many) = (until(0.02), until(0.17));
    assert!(few <= most && many <= most, "{label}: {few} in 10 steps, {many} in 150");
    assert_eq!(simulation.counts().retries, 0, "{label}");
}

#[test]
fn a_full_store_of_snapshots_takes_no_allocations() {
    let mesh = withy::beams::Mesh::bspline(14, 3, 2).unwrap();
    let scene = scenes::spaghetti(&mesh, 1e4);
    let settings = settings(Method::EnergyMomentum, 0.001);
    let mut simulation = Simulation::start(scene, settings).unwrap();
    simulation.enable_snapshots(60_000);
    run(&mut simulation, 0.1).unwrap();
    let kept = simulation.stored_snapshots();
    assert!(kept.0 > 5 && kept.0 < 50, "{kept:?}");
    // Allocations for the rows of the history, and for the times and configurations of the trajectory.
    assert!(allocations_of(|| run(&mut simulation, 0.2).unwrap()) <= 3);
    assert_eq!(simulation.stored_snapshots(), kept);
}

#[test]
fn fifteen_times_the_steps_take_no_more_allocations() {
    for entry in INTEGRATORS {
        for (name, mesh) in meshes(4) {
            let all = scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh));
            // A release allocates new work space once. A controlled speed applies an impulse before every step, which needs separate matrices.
            let is_struck = |scene: &Scene| scene.name == "steered trolley";
            let all = all.filter(|scene| scene.releases.is_empty() && !is_struck(scene));
            for scene in all {
                let label = format!("{}, {}, {name}", entry.name, scene.name);
                // Allocations for the rows of the history, for the times and configurations of the trajectory, and for columns of the scene.
                assert_bounded(&label, scene, entry.method, 4);
            }
        }
    }
}

#[test]
fn steps_with_sliders_take_no_allocations() {
    let rules = SLIDING_RULES.iter().filter(|entry| entry.claims.gap);
    for (entry, of) in rules.flat_map(|rule| INTEGRATORS.iter().map(move |of| (rule, of))) {
        for (name, mesh) in meshes(4) {
            for mut scene in sliding_scenes::all(&mesh, entry.rule) {
                // A slider that passes a seam allocates the work space of the next beam. Without start velocities, none reaches a seam.
                if !scene.tracks.is_empty() {
                    scene.velocities.clear();
                }
                let label = format!("{}, {}, {}, {name}", of.name, entry.name, scene.name);
                // One further allocation for the columns of the sliders in the history.
                assert_bounded(&label, scene, of.method, 4);
            }
        }
    }
}

#[test]
fn steps_with_sleeves_take_no_allocations() {
    for entry in INTEGRATORS {
        for (name, mesh) in meshes(4) {
            // An impact of a bead needs matrices.
            let all = sleeve_scenes::all(&mesh).into_iter();
            for scene in all.filter(|scene| scene.name != "sleeve and bead") {
                let label = format!("{}, {}, {name}", entry.name, scene.name);
                assert_bounded(&label, scene, entry.method, 4);
            }
        }
    }
}

/// The present contact force of a unilateral slider is checked in every step. One slider slides on a fixed beam, and another one falls on it.
#[test]
fn steps_with_unilateral_sliders_take_no_allocations() {
    let mut scene = Scene::new("pushing");
    let axis = scenes::line(at(-1.0, 0.0), at(1.0, 0.0));
    let rod = scenes::add_beam(&mut scene, axis, &sliding::smooth(4), sliding::STIFF);
    for along in [0.0, 0.5, 1.0, 1.5, 2.0] {
        let station = scene.station(rod, along).unwrap();
        scene.join(JointKind::Rigid, station, Partner::Ground).unwrap();
    }
    scene.gravity = at(0.0, -9.81);
    for (x, y) in [(-0.5, 0.0), (0.3, 1.0)] {
        let bead = sliding::moving_particle(&mut scene, at(x, y), at(0.1, 0.0), 0.2);
        let slider = Slider::new(scene.free_name("slider"), bead, rod, x + 1.0);
        scene.add_slider(Slider { restraint: Restraint::OneSided(Side::Left), ..slider }).unwrap();
    }
    assert_bounded("pushing", scene, Method::EnergyMomentum, 4);
}

#[test]
fn steps_that_are_not_recorded_take_no_allocations_at_all() {
    let mesh = withy::beams::Mesh::bspline(14, 3, 2).unwrap();
    for entry in INTEGRATORS {
        let scene = scenes::spaghetti(&mesh, 1e4);
        let mut simulation = Simulation::start(scene, settings(entry.method, 0.001)).unwrap();
        simulation.record(Recording::Nothing);
        run(&mut simulation, 0.01).unwrap();
        simulation.record(Recording::Nothing);
        let taken = allocations_of(|| {
            for _ in 0..100 {
                simulation.step(&mut NoMonitor).unwrap();
            }
        });
        // The present row is overwritten in place.
        assert!(taken <= 3, "{}: {taken}", entry.name);
    }
}
