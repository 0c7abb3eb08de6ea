//! Damped vibration against closed forms: coupled modes, overdamped modes, a bar with a dashpot, and Kelvin–Voigt beams.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::{at, scenes};
use withy::beams::{Mesh, Relaxation, Section, Station};
use withy::joints::{Components, JointKind, Partner};
use withy::system::{
    Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, System,
};
use withy::vibration::{DampedMode, Modes, VibrationError};

fn damped(scene: &Scene, count: usize) -> Result<Vec<DampedMode>, VibrationError> {
    DampedMode::of(&System::assemble(scene).unwrap(), count, &mut || true)
}

fn connect(scene: &mut Scene, anchors: [Anchor; 2], stiffness: f64, damping: f64) {
    let law = (stiffness > 0.0).then_some(SpringLaw::Linear { stiffness, natural: 0.0 });
    let (name, kind) = (scene.free_name("spring"), SpringKind::Length(anchors.to_vec()));
    let spring =
        Spring { name, kind, law, origin: Origin::AsBuilt, damping: damping.into(), rest: None };
    scene.add_spring(spring).unwrap();
}

/// Particles in a row on the x axis, connected to the ground and to each other by springs with dampers: mass, stiffness, damping.
fn row(members: &[(f64, f64, f64)]) -> Scene {
    let mut scene = Scene::new("row");
    let mut before = Anchor::Ground(at(0.0, 0.0));
    for (number, (mass, stiffness, damping)) in (1..).zip(members) {
        let (name, position) = (format!("bead{number}"), at(f64::from(number), 0.0));
        let bead = scene.add_particle(ParticleDefinition { name, position }, *mass).unwrap();
        scene.join(JointKind::Support(Components::Y), bead, Partner::Ground).unwrap();
        connect(&mut scene, [before, Anchor::Station(bead)], *stiffness, *damping);
        before = Anchor::Station(bead);
    }
    scene
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found} {expected}");
}

/// Roots of `(2 λ² + 1.5 λ + 50)(λ² + 20) - 400`, by Durand–Kerner iteration in Python.
#[test]
fn a_damper_at_one_of_two_masses_couples_their_modes() {
    let found = damped(&row(&[(2.0, 30.0, 1.5), (1.0, 20.0, 0.0)]), 2).unwrap();
    let expected = [
        (0.155_512_966_503_554_5, 2.855_404_214_972_814_3),
        (0.219_487_033_496_445_5, 6.052_914_637_572_489),
    ];
    for (found, (decay, frequency)) in found.iter().zip(expected) {
        close(found.decay_rate, decay, 1e-12);
        close(found.angular_frequency, frequency, 1e-12);
    }
    // A perturbation of first order in the damping has a significant error.
    let scene = row(&[(2.0, 30.0, 1.5), (1.0, 20.0, 0.0)]);
    let modes = Modes::of(&System::assemble(&scene).unwrap(), 2, &mut || true).unwrap();
    let apart = (modes.decay_rates()[0] - expected[0].0).abs() / expected[0].0;
    assert!((1e-4..0.1).contains(&apart), "{apart}");
}

#[test]
fn overdamped_mass_has_two_rates_without_oscillation() {
    let found = damped(&row(&[(2.0, 18.0, 20.0)]), 2).unwrap();
    for (found, expected) in found.iter().zip([1.0, 9.0]) {
        close(found.decay_rate, expected, 1e-12);
        assert_eq!((found.angular_frequency, found.damping_ratio()), (0.0, 1.0));
    }
    // At critical damping both roots are equal.
    let critical = damped(&row(&[(2.0, 18.0, 12.0)]), 1).unwrap();
    close(critical[0].decay_rate, 3.0, 1e-7);
    assert!(damped(&row(&[(2.0, 18.0, 20.0)]), 3).is_err());
}

/// Clamped bar with axial vibrations and a dashpot at its end: `tanh(λ L/a) = -Z/c`, `Z = EA/a`.
#[test]
fn bar_with_an_end_dashpot_has_exact_complex_rates() {
    let strong = [30.0, 1e3, 1e5, 1e8, 1e12].map(|damping| (damping, false));
    for (damping, is_soft) in std::iter::once((3.0, true)).chain(strong) {
        let mut scene = Scene::new("bar");
        let section = Section {
            axial_stiffness: 100.0,
            shear_stiffness: 1e7,
            bending_stiffness: 1e6,
            mass_per_length: 1.0,
            rotary_inertia: 1e-2,
        };
        let mesh = Mesh::bspline(64, 3, 2).unwrap();
        let axis = scenes::line(at(0.0, 0.0), at(1.0, 0.0));
        let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
        let (start, end) = (Station::on_beam(beam, 0.0), Station::on_beam(beam, 1.0));
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        connect(&mut scene, [Anchor::Ground(at(2.0, 0.0)), Anchor::Station(end)], 0.0, damping);
        let (speed, impedance) = (10.0, 10.0);
        let found = damped(&scene, 3).unwrap();
        let share = if is_soft { damping / impedance } else { impedance / damping };
        let first = if is_soft { 0.5 } else { 0.0 };
        for (number, found) in found.iter().enumerate() {
            close(found.decay_rate, speed * share.atanh(), 1e-5);
            let frequency = (number as f64 + first) * PI * speed;
            assert!((found.angular_frequency - frequency).abs() < 1e-3, "{found:?} {frequency}");
        }
    }
}

/// A dashpot of any strength at the end of a coarse cantilever acts as a support. Its velocity is the support force over `c`.
#[test]
fn a_strong_dashpot_is_a_support_that_creeps() {
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let mut propped = scenes::cantilever(&mesh, scenes::rod());
    let tip = scenes::end_of(&mut propped, 0);
    propped.join(JointKind::Support(Components::Y), tip, Partner::Ground).unwrap();
    let modes = Modes::of(&System::assemble(&propped).unwrap(), 5, &mut || true).unwrap();
    let mut yielding = Vec::new();
    for power in [3, 5, 7, 9, 12, 16, 20] {
        let damping = 10_f64.powi(power);
        let mut scene = scenes::cantilever(&mesh, scenes::rod());
        let tip = scenes::end_of(&mut scene, 0);
        let beyond = Anchor::Ground(at(10.0, 7.0));
        connect(&mut scene, [beyond, Anchor::Station(tip)], 0.0, damping);
        let found = damped(&scene, 6).unwrap();
        // The motion of the dashpot changes the frequencies by second-order terms only.
        let (creeping, vibrating) = found.split_first().unwrap();
        assert!(creeping.angular_frequency == 0.0 && creeping.decay_rate > 0.0, "{creeping:?}");
        yielding.push((damping * creeping.decay_rate, damping * vibrating[0].decay_rate));
        for (found, mode) in vibrating.iter().zip(modes.all()) {
            let tolerance = 1e-9 + 1e5 / (damping * damping);
            close(found.angular_frequency, mode.angular_frequency(), tolerance);
        }
    }
    let (creep, yields) = yielding[2];
    yielding[2..].iter().for_each(|(found, _)| close(*found, creep, 1e-7));
    // For stronger dashpots, the decay rate is smaller than the rounding of the frequency.
    yielding[2..4].iter().for_each(|(_, first)| close(*first, yields, 1e-4));
}

/// A mass on a spring with a damper of any strength: `λ = (-c ± √(c² - 4 k m))/2m`.
#[test]
fn a_mass_with_a_damper_of_any_strength_has_both_roots_of_its_equation() {
    let (mass, stiffness): (f64, f64) = (2.0, 18.0);
    for damping in [0.0, 1e-6, 1e-3, 1.0, 20.0, 1e3, 1e6, 1e9, 1e13] {
        let found = damped(&row(&[(mass, stiffness, damping)]), 1).unwrap();
        let decay = 0.5 * damping / mass;
        let square = decay * decay - stiffness / mass;
        if square < 0.0 {
            assert!((found[0].decay_rate - decay).abs() < 1e-14, "{damping}: {found:?}");
            close(found[0].angular_frequency, (-square).sqrt(), 1e-13);
            continue;
        }
        let found = damped(&row(&[(mass, stiffness, damping)]), 2).unwrap();
        let fast = decay + square.sqrt();
        close(found[0].decay_rate, stiffness / mass / fast, 1e-12);
        close(found[1].decay_rate, fast, 1e-12);
        assert!(found.iter().all(|at| at.angular_frequency == 0.0), "{found:?}");
    }
}

#[test]
fn beams_of_a_damped_material_have_the_rates_of_separate_modes() {
    for tau in [1e-3, 0.3] {
        let mesh = Mesh::bspline(6, 3, 2).unwrap();
        let mut scene = scenes::cantilever(&mesh, scenes::rod());
        scene.add_damping(0, Relaxation { axial: tau, shear: tau, bending: tau }).unwrap();
        let modes = Modes::of(&System::assemble(&scene).unwrap(), 8, &mut || true).unwrap();
        let found = damped(&scene, 6).unwrap();
        let mut swinging = 0;
        for mode in modes.all() {
            let ratio = 0.5 * tau * mode.angular_frequency();
            if ratio >= 1.0 {
                continue;
            }
            let nearest = found.iter().find(|at| {
                let size = at.decay_rate.hypot(at.angular_frequency);
                (size / mode.angular_frequency() - 1.0).abs() < 1e-9
            });
            let Some(nearest) = nearest else { continue };
            close(nearest.damping_ratio(), ratio, 1e-8);
            swinging += 1;
        }
        assert!(swinging >= if tau < 0.1 { 5 } else { 1 }, "{tau}: {swinging} {found:?}");
        assert!(tau < 0.1 || found.iter().any(|at| at.angular_frequency == 0.0), "{found:?}");
    }
}

#[test]
fn undamped_modes_equal_those_without_dampers() {
    let mesh = Mesh::bspline(5, 3, 2).unwrap();
    let scene = scenes::cantilever(&mesh, scenes::rod());
    let modes = Modes::of(&System::assemble(&scene).unwrap(), 4, &mut || true).unwrap();
    for (found, mode) in damped(&scene, 4).unwrap().iter().zip(modes.all()) {
        assert!(found.decay_rate.abs() < 1e-9 * found.angular_frequency, "{found:?}");
        close(found.angular_frequency, mode.angular_frequency(), 1e-12);
    }
    let large = scenes::cantilever(&Mesh::bspline(100, 3, 2).unwrap(), scenes::rod());
    assert!(matches!(damped(&large, 1), Err(VibrationError::LargeDamped { .. })));
}

/// All roots of all modes of a beam with equal relaxation times, from fine meshes and beyond critical damping. The slow roots accumulate at `1/τ`, and each
/// has eight correct digits.
#[test]
fn strongly_damped_fine_meshes_have_the_slow_rates_of_their_modes() {
    for (spans, tau) in [(12, 1.0), (24, 100.0), (70, 1.0), (70, 1e4)] {
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let mut scene = scenes::cantilever(&mesh, scenes::rod());
        let still = System::assemble(&scene).unwrap();
        let all = match Modes::of(&still, 1000, &mut || true) {
            Err(VibrationError::Count { available, .. }) => available,
            other => panic!("{other:?}"),
        };
        let modes = Modes::of(&still, all, &mut || true).unwrap();
        scene.add_damping(0, Relaxation { axial: tau, shear: tau, bending: tau }).unwrap();
        // Roots of λ² + τω² λ + ω². The small root is computed without cancellation.
        let mut sizes: Vec<f64> = Vec::new();
        for mode in modes.all() {
            let omega = mode.angular_frequency();
            let ratio = 0.5 * tau * omega;
            match ratio > 1.0 {
                true => {
                    let sum = ratio + (ratio * ratio - 1.0).sqrt();
                    sizes.extend([omega / sum, omega * sum]);
                }
                false => sizes.push(omega),
            }
        }
        sizes.sort_by(f64::total_cmp);
        for (found, expected) in damped(&scene, 5).unwrap().iter().zip(sizes) {
            close(found.decay_rate.hypot(found.angular_frequency), expected, 1e-8);
        }
    }
}

/// The slow decay rate with a strong dashpot is the static stiffness of the beam over `c`.
#[test]
fn a_beam_creeps_back_against_a_strong_dashpot() {
    let section = scenes::rod();
    let length: f64 = 2.0;
    let compliance =
        length.powi(3) / (3.0 * section.bending_stiffness) + length / section.shear_stiffness;
    // With weaker dashpots, inertia has an effect too.
    for damping in [1e4, 1e6, 1e8] {
        let mut scene = Scene::new("stay");
        let mesh = Mesh::bspline(40, 3, 2).unwrap();
        let beam = scenes::add_beam(
            &mut scene,
            scenes::line(at(0.0, 0.0), at(length, 0.0)),
            &mesh,
            section,
        );
        let (start, end) = (Station::on_beam(beam, 0.0), Station::on_beam(beam, length));
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        connect(&mut scene, [Anchor::Ground(at(length, 3.0)), Anchor::Station(end)], 0.0, damping);
        let found = damped(&scene, 1).unwrap()[0];
        close(found.decay_rate, 1.0 / (damping * compliance), 1e-6);
        assert_eq!(found.angular_frequency, 0.0);
    }
}
