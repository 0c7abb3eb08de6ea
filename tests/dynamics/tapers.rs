//! Dynamics of beams with varying sections.
#![allow(clippy::unwrap_used)]

use crate::common::{at, meshes, scenes, simulate};
use withy::beams::{Mesh, Section, SectionVariation};
use withy::integrators::Method;
use withy::simulation::{Invariant, Simulation};
use withy::system::{Scene, StartMotion, System};

fn section(factor: f64) -> Section {
    let rod = scenes::rod();
    Section {
        axial_stiffness: factor * rod.axial_stiffness,
        shear_stiffness: factor * rod.shear_stiffness,
        bending_stiffness: factor * factor * rod.bending_stiffness,
        mass_per_length: factor * rod.mass_per_length,
        rotary_inertia: factor * factor * rod.rotary_inertia,
    }
}

fn thrown(mesh: &Mesh, variation: SectionVariation) -> Scene {
    let mut scene = Scene::new("thrown");
    let axis = scenes::line(at(1.0, 0.0), at(4.0, 1.0));
    let beam = scenes::add_beam(&mut scene, axis, mesh, section(1.0));
    scene.beams[beam].section = variation;
    scene.beams[beam].motion =
        StartMotion { velocity: at(1.0, -2.0), spin: 2.0, centre: Some(at(1.0, 0.0)) };
    scene
}

fn tip(simulation: &Simulation) -> withy::geometry::Vec2 {
    crate::common::ends(simulation)[1]
}

#[test]
fn a_taper_between_equal_sections_is_a_uniform_beam() {
    for (name, mesh) in meshes(5) {
        let same = SectionVariation::Numbers(vec![
            (0.0, section(1.3)),
            (0.4, section(1.3)),
            (1.0, section(1.3)),
        ]);
        let [one, other] = [same, section(1.3).into()]
            .map(|variation| simulate(thrown(&mesh, variation), Method::EnergyMomentum, 0.05, 3.0));
        let apart = (tip(&one) - tip(&other)).norm();
        assert!(apart < 1e-11, "{name}: {apart:.1e}");
    }
}

#[test]
fn momenta_at_the_start_are_integrals_of_the_taper() {
    // ρA = ρ (2 - s) and ρI = ρ_I (2 - s)². Section numbers are interpolated linearly, here on one interval with s from 0 to 1.
    let variation = SectionVariation::Numbers(vec![(0.0, section(2.0)), (1.0, section(1.0))]);
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let mut model = System::assemble(&thrown(&mesh, variation.clone())).unwrap();
    let (length, rod) = (10.0_f64.sqrt(), scenes::rod());
    let mass = 1.5 * length * rod.mass_per_length;
    assert!((model.total_mass() / mass - 1.0).abs() < 1e-13);
    let measured = model.measure();
    // Centre of mass: ∫ s (2 - s) ds / 1.5 = (2/3)/1.5 of the length from the start.
    let centre = at(3.0, 1.0) * (2.0 / 3.0 / 1.5);
    let spin_of_centre = at(-2.0 * centre.y, 2.0 * centre.x);
    let momentum = (at(1.0, -2.0) + spin_of_centre) * mass;
    assert!(
        (measured.momentum - momentum).norm() < 1e-12 * momentum.norm(),
        "{}",
        measured.momentum
    );
    // Moment of inertia about the start: ∫ s² (2 - s) ds L³ ρA + ∫ (4 - 3 s) ds L ρI, as (2 - s)² is 4 at one end and 1 at the other.
    let inertia = (2.0 / 3.0 - 0.25) * length.powi(3) * rod.mass_per_length
        + 2.5 * length * rod.rotary_inertia;
    let about_start = mass * (centre.x * -2.0 - centre.y) + 2.0 * inertia;
    let expected = about_start + momentum.y;
    assert!(
        (measured.angular_momentum / expected - 1.0).abs() < 1e-12,
        "{}",
        measured.angular_momentum
    );
}

#[test]
fn flying_tapered_beam_conserves_all_invariants() {
    let variation = SectionVariation::Numbers(vec![
        (0.0, section(3.0)),
        (0.3, section(1.0)),
        (1.0, section(0.2)),
    ]);
    for (name, mesh) in meshes(6) {
        let simulation =
            simulate(thrown(&mesh, variation.clone()), Method::EnergyMomentum, 0.05, 10.0);
        for (invariant_name, invariant) in Invariant::ALL {
            let drift = simulation.history().drift(invariant);
            assert!(drift < 1e-12, "{name}, {invariant_name}: {drift:.1e}");
        }
    }
}

#[test]
fn falling_tapered_beam_has_no_strain() {
    let variation = SectionVariation::Numbers(vec![(0.0, section(3.0)), (1.0, section(0.2))]);
    let mut scene = thrown(&Mesh::bspline(6, 3, 2).unwrap(), variation);
    scene.beams[0].motion = StartMotion { velocity: at(1.0, 0.0), ..StartMotion::default() };
    scene.gravity = at(0.0, -9.81);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 1.0);
    assert!((tip(&simulation) - at(5.0, 1.0 - 0.5 * 9.81)).norm() < 1e-12);
    let last = simulation.history().samples().last().unwrap().measures;
    assert!(last.energy.strain < 1e-20, "{}", last.energy.strain);
}
