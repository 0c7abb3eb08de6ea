//! Every admissible mesh: three rigid motions and no other zero-energy mode, no locking, and correct frequencies.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::{free_beam, spaghetti};
use crate::common::sliding::{kicked_sliding_particle, sliding_particle};
use crate::common::{run, settings};
use withy::beams::{Mesh, Section};
use withy::geometry::{Basis, KnotVector};
use withy::integrators::Method;
use withy::joints::{JointKind, Partner, SlidingRule};
use withy::simulation::Simulation;
use withy::system::System;
use withy::vibration::Modes;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spans {
    Equal,
    /// The last span is ten times as long as the first one.
    Graded,
}

fn mesh(spans: usize, degree: usize, continuity: usize, lengths: Spans) -> Mesh {
    let length = |at: usize| match lengths {
        Spans::Equal => 1.0,
        Spans::Graded => 10_f64.powf(at as f64 / (spans - 1).max(1) as f64),
    };
    let total: f64 = (0..spans).map(length).sum();
    let mut end = 0.0;
    let mut knots = vec![0.0; degree + 1];
    for at in 0..spans - 1 {
        end += length(at) / total;
        knots.extend(vec![end; degree - continuity]);
    }
    knots.extend(vec![1.0; degree + 1]);
    Mesh::new(Basis::BSpline(KnotVector::new(degree, knots).unwrap()))
}

/// All degrees and continuities, with equal and graded spans.
fn kinds() -> impl Iterator<Item = (usize, usize, Spans)> {
    let of_degree = |degree| (0..degree).map(move |continuity| (degree, continuity));
    let lengths = |(degree, continuity)| {
        [Spans::Equal, Spans::Graded].map(|lengths| (degree, continuity, lengths))
    };
    (1..=10).flat_map(of_degree).flat_map(lengths)
}

/// Lowest angular frequencies of a free, slender beam of length 10 with a high axial stiffness.
fn frequencies(mesh: &Mesh, count: usize) -> Vec<f64> {
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 4e5,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-2,
    };
    let model = System::assemble(&free_beam(mesh, section)).unwrap();
    let modes = Modes::of(&model, count, &mut || true).unwrap();
    modes.all().iter().map(|mode| mode.angular_frequency()).collect()
}

#[test]
fn no_mesh_has_spurious_modes() {
    // Spline of degree 7 on 40 spans. The six lowest bending modes are accurate to 1e-10.
    let exact = frequencies(&mesh(40, 7, 6, Spans::Equal), 12);
    for (degree, continuity, lengths) in kinds() {
        let mut worst = [0.0_f64; 2];
        for (at, spans) in [(0, 8), (1, 16)] {
            let found = frequencies(&mesh(spans, degree, continuity, lengths), 8);
            let rigid = found.iter().take_while(|frequency| **frequency == 0.0).count();
            assert_eq!(rigid, 3, "degree {degree}, C{continuity}, {lengths:?}: {found:?}");
            let errors =
                found.iter().zip(&exact).skip(3).map(|(one, other)| (one / other - 1.0).abs());
            worst[at] = errors.fold(0.0, f64::max);
        }
        let [coarse, fine] = worst;
        println!(
            "degree {degree}, C{continuity}, {lengths:?}: five elastic modes off by {coarse:.1e} with 8 spans, {fine:.1e} with 16"
        );
        // A spurious mode would shift all higher modes by at least 0.3 of their frequency.
        let allowed = [0.35, 0.2, 0.05][degree.min(3) - 1];
        assert!(
            fine < allowed && (fine < 0.6 * coarse || fine < 1e-4),
            "degree {degree}, C{continuity}, {lengths:?}"
        );
    }
}

#[test]
fn coarse_meshes_have_only_three_modes_without_stiffness() {
    for (degree, continuity, lengths) in kinds() {
        for spans in 1..=5 {
            let mesh = mesh(spans, degree, continuity, lengths);
            let count = (mesh.basis().functions() * 3).min(6);
            let found = frequencies(&mesh, count);
            let rigid = found.iter().filter(|frequency| **frequency == 0.0).count();
            assert_eq!(
                rigid, 3,
                "{spans} spans, degree {degree}, C{continuity}, {lengths:?}: {found:?}"
            );
        }
    }
}

/// `E(2.5)` of the flying spaghetti.
fn energy(mesh: &Mesh, stiffness: f64) -> f64 {
    let mut simulation =
        Simulation::start(spaghetti(mesh, stiffness), settings(Method::EnergyMomentum, 0.1))
            .unwrap();
    run(&mut simulation, 2.5).unwrap();
    simulation.history().samples().last().unwrap().measures.energy.total()
}

#[test]
fn no_mesh_locks() {
    let mut worst: f64 = 0.0;
    for (degree, continuity, lengths) in kinds() {
        for spans in [1, 2, 3, 7, 14, 64] {
            let mesh = mesh(spans, degree, continuity, lengths);
            if mesh.basis().functions() > 200 {
                continue;
            }
            let soft = energy(&mesh, 1e4);
            let stiffnesses = if spans > 14 { &[1e10][..] } else { &[1e6, 1e8, 1e10] };
            for &stiffness in stiffnesses {
                let change = (energy(&mesh, stiffness) / soft - 1.0).abs();
                worst = worst.max(change);
                assert!(
                    change < 0.03,
                    "{spans} spans, degree {degree}, C{continuity}, {lengths:?}, EA = {stiffness:e}: {change}"
                );
            }
        }
    }
    println!("E(2.5) changes by {worst:.1e} at most");
}

#[test]
fn sliding_masses_agree_with_references_on_every_mesh() {
    // P7d at 0.3 and 0.55, P7c at 1, from scripts/studies/reference.
    let kicked = |mesh: &Mesh| kicked_sliding_particle(mesh, SlidingRule::Conserving);
    let turning = |mesh: &Mesh| sliding_particle(mesh, 1.0, SlidingRule::Conserving);
    for (degree, continuity, lengths) in
        kinds().filter(|(degree, continuity, _)| *degree < 8 && *continuity > 0)
    {
        let place = |spans: usize, kick: bool, end: f64| {
            let mesh = mesh(spans, degree, continuity, lengths);
            let scene = if kick { kicked(&mesh) } else { turning(&mesh) };
            let mut simulation =
                Simulation::start(scene, settings(Method::EnergyMomentum, 0.002)).unwrap();
            run(&mut simulation, end).unwrap();
            simulation.model().slider_position(0)
        };
        let errors = [
            place(32, true, 0.3) - 0.481_207,
            place(32, true, 0.55) - 0.103_545,
            place(32, false, 1.0) - 0.822_049,
        ];
        println!("degree {degree}, C{continuity}, {lengths:?}: {errors:.5?}");
        let [early, late, turned] = errors.map(f64::abs);
        let near = if degree == 2 { 8e-4 } else { 3e-4 };
        assert!(
            early < near && late < 8e-3 && turned < 1e-3,
            "degree {degree}, C{continuity}, {lengths:?}: {errors:?}"
        );
    }
}

#[test]
fn the_expected_order_depends_on_the_degree_and_on_forces_inside_beams() {
    let of = |degree| spaghetti(&Mesh::bspline(8, degree, degree - 1).unwrap(), 1e4);
    assert_eq!([1, 2, 3, 4, 5].map(|degree| of(degree).mesh_order()), [2.0, 2.0, 4.0, 4.0, 6.0]);
    let sliding = |rule| sliding_particle(&Mesh::bspline(8, 3, 2).unwrap(), 0.3, rule).mesh_order();
    assert_eq!((sliding(SlidingRule::Conserving), sliding(SlidingRule::Kinked)), (1.0, 3.0));
    let mut held = of(3);
    let middle = held.station(0, 5.0).unwrap();
    held.join(JointKind::Hinge, middle, Partner::Ground).unwrap();
    assert_eq!(held.mesh_order(), 1.0);
}
