//! Impacts: the impulse depends on bodies and constraints only, at any step size, and the coefficient of restitution holds.
#![allow(clippy::unwrap_used)]

use crate::common::rails::bead;
use crate::common::scenes::{self, add_beam, line, start_of};
use crate::common::tracks::{self, hold, section, track};
use crate::common::{at, run, settings, simulate};
use withy::beams::{Mesh, Section};
use withy::integrators::Method;
use withy::joints::{Components, EndAction, JointKind, Partner, TrackEnd};
use withy::simulation::{ArrivalKind, Invariant, Simulation};
use withy::system::{Anchor, Scene, SpringKind, SpringLaw};

fn spring(scene: &mut Scene, kind: SpringKind, stiffness: f64, natural: f64, damping: f64) {
    scenes::spring(scene, kind, SpringLaw::Linear { stiffness, natural }, damping);
}

fn assert_kept(simulation: &Simulation, tolerance: f64) {
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < tolerance, "{name}: {drift:e}");
    }
}

/// Bar of 2 kg with axial stiffness `EA`. A bead of 1 kg moves along it with speed 3 from the middle.
fn bar_with_bead(axial: f64, mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("bar");
    let section = Section {
        axial_stiffness: axial,
        shear_stiffness: 0.4 * axial,
        bending_stiffness: 0.01 * axial,
        mass_per_length: 2.0,
        rotary_inertia: 0.01,
    };
    add_beam(&mut scene, line(at(0.0, 0.0), at(1.0, 0.0)), mesh, section);
    bead(&mut scene, 0.5, 1.0, at(3.0, 0.0), EndAction::Bounce);
    scene
}

#[test]
fn springs_and_dampers_to_the_ground_take_no_impulse() {
    for (axial, spans) in [(1e4, 4), (1e4, 16), (1e8, 5)] {
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        for dt in [0.01, 0.005, 0.001] {
            let mut scene = bar_with_bead(axial, &mesh);
            let start = Anchor::Station(start_of(&mut scene, 0));
            let foot = Anchor::Ground(at(-1.0, 0.0));
            spring(&mut scene, SpringKind::Length(vec![foot, start]), 50.0, 1.0, 0.3);
            spring(&mut scene, SpringKind::Torsion([foot, start]), 20.0, 0.0, 0.1);
            let simulation = simulate(scene, Method::EnergyMomentum, dt, 1.0);
            let first = &simulation.arrivals()[0];
            assert_eq!(first.kind, ArrivalKind::Bounced);
            // The bar is at rest before the impact: impulse (1 + e) v m M/(m + M).
            let off = (first.impulse - at(4.0, 0.0)).norm();
            println!("EA = {axial:e}, {spans} spans, dt = {dt}: off by {off:e}");
            assert!(off < 1e-9, "{:?}", first.impulse);
            assert_kept(&simulation, 1e-11);
        }
    }
}

#[test]
fn corner_impulse_does_not_depend_on_springs_of_the_frame() {
    for dt in [0.028, 0.007] {
        let mut scene = Scene::new("frame");
        let mesh = Mesh::bspline(4, 3, 2).unwrap();
        let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)];
        let beams = [0, 1].map(|leg| {
            let axis = line(corners[leg], corners[leg + 1]);
            add_beam(&mut scene, axis, &mesh, section(1e10, 1e10))
        });
        let start = start_of(&mut scene, 0);
        hold(&mut scene, JointKind::Support(Components::Rotation), &[start]);
        for foot in [at(-1.0, 0.0), at(0.0, -1.0)] {
            let kind = SpringKind::Length(vec![Anchor::Ground(foot), Anchor::Station(start)]);
            spring(&mut scene, kind, 1000.0, 1.0, 0.0);
        }
        let track = track(&mut scene, &beams, TrackEnd::Open);
        tracks::bead(&mut scene, track, 0.5, 1.0, at(1.0, 0.0));
        let simulation = simulate(scene, Method::EnergyMomentum, dt, 1.0);
        let impulse = simulation.arrivals()[0].impulse;
        println!("dt = {dt}: {impulse:?}");
        assert!((impulse - at(2.0, -2.0) / 3.0).norm() < 1e-5, "dt = {dt}: {impulse:?}");
        assert_kept(&simulation, 1e-11);
    }
}

/// Support of the bar at the end without impact.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Foot {
    Clamped,
    Free,
}

/// Bar of mass 1 and length 1 in several pieces. A bead of mass 2 strikes its end with speed 1.
fn struck(foot: Foot, pieces: usize, restitution: f64, dt: f64) -> Simulation {
    let mut scene = Scene::new("struck bar");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 10.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    };
    let mesh = Mesh::bspline(12 / pieces, 3, 2).unwrap();
    // The bead strikes the first piece.
    for piece in 0..pieces {
        let ends = [piece + 1, piece].map(|at| 1.0 - at as f64 / pieces as f64);
        add_beam(&mut scene, line(at(ends[0], 0.0), at(ends[1], 0.0)), &mesh, section);
    }
    for piece in 1..pieces {
        let (start, [_, end]) = (start_of(&mut scene, piece - 1), tracks::ends(&mut scene, piece));
        scene.join(JointKind::Rigid, start, Partner::Station(end)).unwrap();
    }
    if foot == Foot::Clamped {
        let start = start_of(&mut scene, pieces - 1);
        hold(&mut scene, JointKind::Rigid, &[start]);
    }
    let along = 1.0 - 0.05 * pieces as f64;
    bead(&mut scene, along, 2.0, at(1.0, 0.0), EndAction::Bounce);
    scene.sliders[0].restitution = restitution;
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
    run(&mut simulation, 0.05 + 0.5 * dt).unwrap();
    run(&mut simulation, 0.1 + 2.0 * dt).unwrap();
    simulation
}

#[test]
fn the_coefficient_of_restitution_holds_at_every_step() {
    for foot in [Foot::Clamped, Foot::Free] {
        for pieces in [1, 3] {
            for restitution in [0.0, 0.5, 1.0] {
                // An axial wave crosses the bar in 0.01.
                for dt in [0.05, 0.005, 0.002, 1e-4] {
                    let simulation = struck(foot, pieces, restitution, dt);
                    let bead = simulation.scene().sliders[0].slave;
                    let bead =
                        simulation.scene().place(&bead, simulation.model().meshes()).unwrap();
                    let speed = simulation.model().velocity(&bead).x;
                    let expected = match foot {
                        Foot::Clamped => -restitution,
                        Foot::Free => (2.0 - restitution) / 3.0,
                    };
                    let what = format!("{foot:?}, {pieces} pieces, e = {restitution}, dt = {dt}");
                    println!("{what}: {speed:.9}");
                    assert!((speed - expected).abs() < 1e-8, "{what}: {speed} {expected}");
                    assert_kept(&simulation, 1e-11);
                }
            }
        }
    }
}
