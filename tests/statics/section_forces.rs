//! Section forces: equilibrium on every mesh, rotated and mirrored, at supports within beams, and in a rotating bar.
#![allow(clippy::unwrap_used)]

use crate::common::{at, meshes, orders, scenes, sci, settings};
use withy::beams::{Mesh, Section, SectionForces};
use withy::geometry::{Curve, Vec2, cross};
use withy::integrators::Method;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{NoMonitor, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Scene, StartMotion};

const LENGTH: f64 = 10.0;

fn section() -> Section {
    Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 0.1,
    }
}

fn turned(v: Vec2, angle: f64) -> Vec2 {
    at(angle.cos() * v.x - angle.sin() * v.y, angle.sin() * v.x + angle.cos() * v.y)
}

/// Cantilever from the origin in a direction, with a force at its tip.
fn loaded(mesh: &Mesh, direction: f64, force: Vec2) -> Equilibrium {
    let mut scene = Scene::new("cantilever");
    let axis = Curve::line(Vec2::zeros(), turned(at(LENGTH, 0.0), direction)).unwrap();
    let beam = scenes::add_beam(&mut scene, axis, mesh, section());
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    let station = scenes::end_of(&mut scene, beam);
    let load = LoadKind::Force { station, force, frame: LoadFrame::Dead };
    scene.add_load(load, Schedule::constant(1.0).unwrap());
    let loading = Loading { steps: 40, ..Loading::default() };
    Equilibrium::find(scene, loading, &mut |_| true)
        .unwrap_or_else(|error| panic!("{}: {error}", mesh.describe()))
}

/// Largest relative errors of moment and force along the beam, and relative error of the moment at the clamp.
fn errors(rest: &Equilibrium, force: Vec2) -> [f64; 3] {
    let position = |s: f64| {
        let station = withy::beams::Station::on_beam(0, s);
        let place = rest.scene().place(&station, rest.model().meshes()).unwrap();
        rest.model().position(&place)
    };
    let tip = position(LENGTH);
    let largest = cross(tip, force).abs();
    let mut worst = [0.0_f64; 3];
    for sample in rest.section_forces_along(0).unwrap() {
        let exact = cross(tip - position(sample.arc_length), force);
        let SectionForces { axial, shear, moment, .. } = sample.forces;
        let error = (moment - exact).abs() / largest;
        worst[0] = worst[0].max(error);
        worst[1] = worst[1].max((axial.hypot(shear) / force.norm() - 1.0).abs());
        if sample.arc_length == 0.0 {
            worst[2] = worst[2].max(error);
        }
    }
    worst
}

#[test]
fn section_forces_balance_the_load_along_a_strongly_bent_cantilever() {
    let force = at(-1.0, 6.0);
    // Orders of M at the last doubling of spans. The force is constant, and exact up to rounding.
    let least_order = [
        ("cubic C2", 2.2),
        ("cubic C1", 2.2),
        ("cubic C0", 2.7),
        ("linear", 0.95),
        ("quadratic Lagrange", 1.9),
        ("cubic Lagrange", 2.7),
        ("quadratic C1", 1.9),
        ("degree 4, C3", 2.2),
        ("degree 5, C4", 2.3),
    ];
    let all = [16, 32, 64].map(|spans| {
        let with = |(_, mesh): (_, Mesh)| errors(&loaded(&mesh, 0.3, force), force);
        // Two points per span leave zero-energy modes, so no equilibrium exists.
        let held = meshes(spans).into_iter().filter(|(name, _)| !name.ends_with("2 points"));
        held.map(with).collect::<Vec<_>>()
    });
    let mut missed = Vec::new();
    for (index, (name, least)) in least_order.into_iter().enumerate() {
        let errors_of = |what: usize| [0, 1, 2].map(|level| all[level][index][what]);
        println!("{name:20} |(N, Q)|       {}", sci(&errors_of(1)));
        assert!(errors_of(1).iter().all(|error| *error < 1e-12), "{name}");
        for (what, label) in [(0, "M"), (2, "M at the clamp")] {
            let order = orders(&errors_of(what));
            println!("{name:20} {label:14} {} orders {order:.2?}", sci(&errors_of(what)));
            // At the clamp, degree 4 is already very accurate on the coarsest mesh.
            if order[1] < least && errors_of(what)[2] > 1e-7 {
                missed.push(format!("{name}: {label} of order {order:.2?}"));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn rotation_keeps_section_forces_and_mirroring_changes_signs_of_shear_and_moment() {
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let force = at(-1.0, 4.0);
    let along = |direction: f64, force: Vec2| {
        loaded(&mesh, direction, force).section_forces_along(0).unwrap()
    };
    let here = along(0.0, force);
    assert_eq!(here.len(), 8 * 4 + 1);
    let there = along(1.1, turned(force, 1.1));
    let mirrored = along(0.0, at(force.x, -force.y));
    let numbers = |of: &SectionForces, sign: f64| {
        [
            [of.axial, sign * of.shear, sign * of.moment],
            [of.axial_strain, sign * of.shear_strain, sign * of.curvature],
        ]
    };
    for ((here, there), mirrored) in here.iter().zip(&there).zip(&mirrored) {
        let expected = numbers(&here.forces, 1.0);
        for other in [numbers(&there.forces, 1.0), numbers(&mirrored.forces, -1.0)] {
            for (a, b) in expected.as_flattened().iter().zip(other.as_flattened()) {
                assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()), "{expected:?} {other:?}");
            }
        }
    }
}

#[test]
fn material_law_holds_at_and_between_the_quadrature_points() {
    let rest = loaded(&Mesh::bspline(7, 3, 2).unwrap(), 0.0, at(1.0, 3.0));
    for sample in rest.section_forces_along(0).unwrap() {
        let SectionForces { axial, shear, moment, .. } = sample.forces;
        let SectionForces { axial_strain, shear_strain, curvature, .. } = sample.forces;
        assert!((axial - 1e4 * axial_strain).abs() < 1e-10, "{sample:?}");
        assert!((shear - 4e3 * shear_strain).abs() < 1e-10, "{sample:?}");
        assert!((moment - 100.0 * curvature).abs() < 1e-10, "{sample:?}");
    }
}

/// Straight beam on three supports. The shear force jumps at the middle one.
#[test]
fn section_forces_on_both_sides_of_a_support_are_returned() {
    let mut scene = Scene::new("continuous beam");
    let axis = Curve::line(Vec2::zeros(), at(2.0, 0.0)).unwrap();
    let beam = scenes::add_beam(&mut scene, axis, &Mesh::bspline(8, 3, 2).unwrap(), section());
    for s in [0.0, 1.0, 2.0] {
        let station = scene.station(beam, s).unwrap();
        scene.join(JointKind::Hinge, station, Partner::Ground).unwrap();
    }
    let line = LoadKind::Line { beam, force: at(0.0, -1e-3), frame: LoadFrame::Dead };
    scene.add_load(line, Schedule::constant(1.0).unwrap());
    let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
    let along = rest.section_forces_along(0).unwrap();
    let middle: Vec<_> = along.iter().filter(|sample| sample.arc_length == 1.0).collect();
    assert_eq!(middle.len(), 2);
    let [before, behind] = [middle[0].forces, middle[1].forces];
    // Without shear deformation, the moment over the support is ql²/8, and the shear force on either side 5/8 ql.
    assert!((before.shear + behind.shear).abs() < 1e-9 && behind.shear * before.shear < 0.0);
    assert!((before.moment - behind.moment).abs() < 1e-9);
    let jump = (behind.shear - before.shear).abs();
    assert!(jump > 1.1e-3 && jump < 1.3e-3, "{jump}");
    let here = rest.section_forces(&withy::beams::Station::on_beam(0, 1.0)).unwrap();
    assert_eq!(here, behind);
}

#[test]
fn rotating_bar_is_stretched_by_its_inertia() {
    let errors = [4, 8, 16].map(|spans| {
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let stiff = Section { axial_stiffness: 1e6, shear_stiffness: 1e6, ..section() };
        let mut scene = scenes::free_beam(&mesh, stiff);
        let start = scene.station(0, 0.0).unwrap();
        scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
        scene.beams[0].motion =
            StartMotion { spin: 0.5, centre: Some(Vec2::zeros()), ..StartMotion::default() };
        // The sudden elongation causes vibrations, which numerical damping removes.
        let damped = Method::EnergyDecaying { chi: 1.0 };
        let mut simulation = Simulation::start(scene, settings(damped, 0.02)).unwrap();
        simulation.run_to(4.0, &mut NoMonitor).unwrap();
        let spin = simulation.history().samples().last().unwrap().measures.angular_momentum
            / (LENGTH.powi(3) / 3.0 + 0.1 * LENGTH);
        let largest = 0.5 * spin * spin * LENGTH * LENGTH;
        let along = simulation.section_forces_along(0).unwrap();
        let errors = along.iter().map(|sample| {
            let exact = largest * (1.0 - (sample.arc_length / LENGTH).powi(2));
            (sample.forces.axial - exact).abs() / largest
        });
        errors.fold(0.0, f64::max)
    });
    println!("turning bar, N against ½ρAω²(L² - s²): {}", sci(&errors));
    // The exact solution is for an inextensible bar, with a relative difference of 1.2e-5.
    assert!(errors.iter().all(|error| *error < 1e-4), "{errors:?}");
}
