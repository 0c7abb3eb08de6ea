//! Small vibrations: exact frequencies, and no spurious modes.
#![allow(clippy::unwrap_used)]

use crate::common::reference::{number, text};
use crate::common::{at, meshes, orders, scenes, sci};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::integrators::{Inertia, Mechanism, Method};
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::Simulation;
use withy::statics::{Equilibrium, Loading};
use withy::system::{Scene, System};
use withy::vibration::{Mode, Modes, VibrationError};

fn frequencies(scene: &Scene) -> Vec<f64> {
    let model = System::assemble(scene).unwrap();
    let all = model.unknowns();
    let modes = Modes::of(&model, all, &mut || true).unwrap();
    modes.all().iter().map(Mode::angular_frequency).collect()
}

struct Case {
    name: String,
    section: Section,
    support: String,
    flexural: Vec<f64>,
    axial: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let json: serde_json::Value = serde_json::from_str(&text("P5_frequencies.json")).unwrap();
    let numbers =
        |value: &serde_json::Value| value.as_array().unwrap().iter().map(number).collect();
    json["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(|case| {
            let values: Vec<f64> = numbers(&case["L,EA,GAs,EI,rhoA,rhoI"]);
            let [_, axial_stiffness, shear_stiffness, bending_stiffness, mass, rotary_inertia] =
                values[..]
            else {
                panic!("six values")
            };
            Case {
                name: format!("{}, {}", case["section"], case["bc"]),
                section: Section {
                    axial_stiffness,
                    shear_stiffness,
                    bending_stiffness,
                    mass_per_length: mass,
                    rotary_inertia,
                },
                support: case["bc"].as_str().unwrap().to_owned(),
                flexural: numbers(&case["flexural"]),
                // The axial frequencies depend on the supports. Here both ends are fixed axially.
                axial: case["axial"]
                    .as_array()
                    .map(|_| numbers(&case["axial"]))
                    .unwrap_or_default(),
            }
        })
        .collect()
}

/// Beam of length 10 with the given supports.
fn supported(support: &str, mesh: &Mesh, section: Section) -> Scene {
    let mut scene = Scene::new(support);
    let beam =
        scenes::add_beam(&mut scene, scenes::line(Vec2::zeros(), at(10.0, 0.0)), mesh, section);
    let held: &[(f64, JointKind)] = match support {
        "free-free" => &[],
        "cantilever" => &[(0.0, JointKind::Rigid)],
        "hinged-free" => &[(0.0, JointKind::Hinge)],
        "simply-supported" => &[(0.0, JointKind::Hinge), (10.0, JointKind::Hinge)],
        other => panic!("support {other}"),
    };
    for (arc_length, kind) in held {
        let station = scene.station(beam, *arc_length).unwrap();
        scene.join(*kind, station, Partner::Ground).unwrap();
    }
    scene
}

/// Number of zero-energy modes, and relative errors of the first six flexural and three axial frequencies.
fn vibrate(case: &Case, mesh: &Mesh) -> (usize, Vec<f64>, Vec<f64>) {
    let found = frequencies(&supported(&case.support, mesh, case.section));
    let zeros = found.iter().filter(|f| **f == 0.0).count();
    let error = |exact: &f64| found.iter().map(|f| (f / exact - 1.0).abs()).fold(1.0, f64::min);
    (zeros, case.flexural.iter().map(error).collect(), case.axial.iter().map(error).collect())
}

#[test]
fn beam_has_rigid_modes_and_no_other_modes_without_energy() {
    for case in cases() {
        for (name, mesh) in meshes(16) {
            // Two quadrature points per cubic C1 span integrate one strain too few: two hourglass modes (docs/theory.md, section 4).
            let hourglass = if name == "cubic C1, 2 points" { 2 } else { 0 };
            let rigid = match case.support.as_str() {
                "free-free" => 3,
                "hinged-free" => 1,
                _ => 0,
            };
            assert_eq!(vibrate(&case, &mesh).0, rigid + hourglass, "{}, {name}", case.name);
        }
    }
}

#[test]
fn frequencies_agree_with_exact_values() {
    for case in cases() {
        for (name, mesh) in meshes(16) {
            let (_, flexural, axial) = vibrate(&case, &mesh);
            println!(
                "{:24} {name:20} flexural {} axial {}",
                case.name,
                sci(&flexural),
                sci(&axial)
            );
            let allowed = match name {
                "linear" | "cubic C1, 2 points" | "quadratic C1" => 1e-2,
                "quadratic Lagrange" => 3e-4,
                _ => 1e-4,
            };
            let axial = axial.first().copied().unwrap_or(0.0);
            assert!(flexural[0] < allowed && axial < 1e-2, "{}, {name}", case.name);
            if name == "cubic C2" {
                assert!(flexural.iter().all(|error| *error < 1.2e-2), "{}", case.name);
                // The patch rule balances constant section forces, so axial waves are not reflected at the ends of the patch.
                assert!(axial < 1e-5, "{}: {axial}", case.name);
            }
        }
    }
}

#[test]
fn frequencies_of_smooth_cubics_converge_at_third_order_or_better() {
    for case in cases() {
        let errors: Vec<f64> = [8, 16, 32]
            .map(|spans| vibrate(&case, &Mesh::bspline(spans, 3, 2).unwrap()).1[2])
            .to_vec();
        println!("{:24} third mode {} orders {:.2?}", case.name, sci(&errors), orders(&errors));
        assert!((errors[0] / errors[2]).log2() > 2.0 * 2.75, "{}", case.name);
    }
}

/// Cubic splines without shear deformation, the limit of these beams, overestimate the sixth frequency of the slender free beam by 1.8e-3 with 16 spans, for
/// any quadrature: (β₆ h)⁴/1440 with β₆ L = 20.42. This number of spans needs a higher degree.
#[test]
fn sixteen_quintic_spans_of_continuity_two_have_the_first_six_frequencies() {
    let mesh = Mesh::bspline(16, 5, 2).unwrap();
    for case in cases() {
        let (_, flexural, _) = vibrate(&case, &mesh);
        println!("{:28} quintic C2 {}", case.name, sci(&flexural));
        assert!(flexural.iter().all(|error| *error < 1e-5), "{} {}", case.name, sci(&flexural));
    }
}

fn squares(modes: &Modes) -> Vec<f64> {
    modes.all().iter().map(|mode| mode.square).collect()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs() / (a.abs() + b.abs() + f64::MIN_POSITIVE))
        .fold(0.0, f64::max)
}

/// Modes of a small beam by a dense solver, and of a finer one by iteration.
#[test]
fn the_lowest_modes_of_a_large_scene_are_those_of_a_small_one() {
    for support in ["free-free", "cantilever", "simply-supported"] {
        let section = scenes::spaghetti_section(1e6, 100.0);
        let of = |spans: usize| {
            let scene = supported(support, &Mesh::bspline(spans, 3, 2).unwrap(), section);
            let model = System::assemble(&scene).unwrap();
            (model.unknowns(), squares(&Modes::of(&model, 8, &mut || true).unwrap()))
        };
        let ((small, dense), (large, sparse)) = (of(76), of(80));
        assert!(small <= 240 && large > 240, "{small} {large}");
        let difference = largest_difference(&dense, &sparse);
        println!(
            "{support}: 76 spans at once, 80 by iteration: squares differ by {difference:.1e}"
        );
        // The discretisation errors are about 1e-6 and differ by 20 % between the meshes.
        assert!(difference < 1e-5, "{dense:?} {sparse:?}");
    }
    let scene = supported(
        "cantilever",
        &Mesh::bspline(400, 3, 2).unwrap(),
        scenes::spaghetti_section(1e6, 100.0),
    );
    let modes = Modes::of(&System::assemble(&scene).unwrap(), 4, &mut || true).unwrap();
    let coarse = supported(
        "cantilever",
        &Mesh::bspline(16, 5, 2).unwrap(),
        scenes::spaghetti_section(1e6, 100.0),
    );
    let exact = Modes::of(&System::assemble(&coarse).unwrap(), 4, &mut || true).unwrap();
    let difference = largest_difference(&squares(&modes), &squares(&exact));
    assert!(difference < 2e-6, "{difference}");
}

/// The ratio of shear stiffness to rotary inertia is so large that its rounding error exceeds the bending frequencies.
#[test]
fn lowest_mode_of_a_thin_strip_is_not_taken_for_a_rigid_motion() {
    let (modulus, density, thickness, width, length) = (210e9, 7850.0, 1e-3, 0.02, 4.0);
    let area = thickness * width;
    let second_moment = area * thickness * thickness / 12.0;
    let section = Section {
        axial_stiffness: modulus * area,
        shear_stiffness: modulus * area / 3.12,
        bending_stiffness: modulus * second_moment,
        mass_per_length: density * area,
        rotary_inertia: density * second_moment,
    };
    let mut scene = Scene::new("strip");
    let axis = scenes::line(Vec2::zeros(), at(length, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &Mesh::bspline(16, 3, 2).unwrap(), section);
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    let modes = Modes::of(&System::assemble(&scene).unwrap(), 2, &mut || true).unwrap();
    let wave = (section.bending_stiffness / section.mass_per_length).sqrt() / length.powi(2);
    for (mode, exact) in modes.all().iter().zip([3.516015, 22.03449]) {
        let error = mode.angular_frequency() / (exact * wave) - 1.0;
        assert!(error.abs() < 1e-3, "{error}");
    }
}

/// The search must not miss a single unstable mode far below many soft modes.
#[test]
fn unstable_mode_among_many_soft_modes_is_found_or_the_search_fails() {
    let of = |spans: usize| {
        let mut scene = Scene::new("cable and column");
        let mesh = |spans| Mesh::bspline(spans, 3, 2).unwrap();
        let soft = Section { rotary_inertia: 1e-2, ..scenes::spaghetti_section(1.0, 1e-4) };
        let cable = scenes::line(at(0.0, 5.0), at(10.0, 5.0));
        let cable = scenes::add_beam(&mut scene, cable, &mesh(spans), soft);
        let stiff = Section { rotary_inertia: 1e-2, ..scenes::spaghetti_section(1e6, 100.0) };
        let column = scenes::line(Vec2::zeros(), at(1.0, 0.0));
        let column = scenes::add_beam(&mut scene, column, &mesh(6), stiff);
        for beam in [cable, column] {
            let start = scene.station(beam, 0.0).unwrap();
            scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        }
        let station = scene.station(column, 1.0).unwrap();
        let load = LoadKind::Force { station, force: at(-400.0, 0.0), frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
        let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
        (rest.model().unknowns(), rest.modes(6, &mut || true))
    };
    let ((small, few), (large, many)) = (of(40), of(90));
    assert!(small <= 240 && large > 240);
    assert!(!few.unwrap().is_stable());
    assert!(many.map_or(true, |modes| !modes.is_stable()));
}

/// Euler's column, clamped and free: the stiffness vanishes at π² EI/(4 L²), and the lowest squared frequency decreases almost linearly.
#[test]
fn a_column_loses_its_stiffness_at_eulers_load() {
    let (bending, length) = (100.0, 10.0_f64);
    let euler = std::f64::consts::PI.powi(2) * bending / (4.0 * length * length);
    let lowest = |part: f64| {
        let section = scenes::spaghetti_section(1e8, bending);
        let mut scene = supported("cantilever", &Mesh::bspline(16, 3, 2).unwrap(), section);
        let station = scenes::end_of(&mut scene, 0);
        let force = at(-part * euler, 0.0);
        let load = LoadKind::Force { station, force, frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
        let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
        rest.modes(1, &mut || true).unwrap().all()[0].clone()
    };
    let (below, above) = (lowest(0.999), lowest(1.001));
    assert!(below.square > 0.0 && above.square < 0.0, "{} {}", below.square, above.square);
    assert!(above.growth_rate() > 0.0 && above.period().is_infinite());
    let pulled = lowest(-1.0).square / lowest(1e-9).square;
    assert!(pulled > 1.8 && pulled < 2.0, "{pulled}");
}

#[test]
fn computing_modes_does_not_change_a_simulation() {
    let run = |looks: bool| {
        let scene = scenes::cantilever(
            &Mesh::bspline(6, 3, 2).unwrap(),
            scenes::spaghetti_section(1e4, 100.0),
        );
        let mut scene = scene;
        let station = scenes::end_of(&mut scene, 0);
        let load = LoadKind::Force { station, force: at(0.0, 3.0), frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::hold_for(0.5).unwrap());
        let settings = crate::common::settings(Method::EnergyMomentum, 0.1);
        let mut simulation = Simulation::start(scene, settings).unwrap();
        for step in 1..10 {
            crate::common::run(&mut simulation, 0.1 * f64::from(step)).unwrap();
            if looks {
                assert!(simulation.modes(3, &mut || true).unwrap().all()[0].square != 0.0);
            }
        }
        simulation.model().state()
    };
    assert!(run(true) == run(false));
}

#[test]
fn mode_shapes_are_orthonormal_in_the_inertia_and_impossible_numbers_are_rejected() {
    let scene =
        scenes::cantilever(&Mesh::bspline(8, 3, 2).unwrap(), scenes::spaghetti_section(1e4, 100.0));
    let mut model = System::assemble(&scene).unwrap();
    let modes = Modes::of(&model, 5, &mut || true).unwrap();
    for (a, first) in modes.all().iter().enumerate() {
        let mut momenta = vec![0.0; model.degrees_of_freedom()];
        model.add_inertia(1.0, &first.shape, &mut momenta);
        for (b, second) in modes.all().iter().enumerate() {
            let product: f64 = second.shape.iter().zip(&momenta).map(|(x, y)| x * y).sum();
            assert!((product - f64::from(u8::from(a == b))).abs() < 1e-9, "{a} {b} {product}");
        }
    }
    let available = model.unknowns();
    for asked in [0, available + 1] {
        let error = Modes::of(&model, asked, &mut || true).unwrap_err();
        assert_eq!(error, VibrationError::Count { requested: asked, available });
    }
    let mut turned = scene;
    let station = scenes::end_of(&mut turned, 0);
    let load = LoadKind::Force { station, force: at(0.0, 3.0), frame: LoadFrame::Follower };
    turned.add_load(load, Schedule::constant(1.0).unwrap());
    let error = Modes::of(&System::assemble(&turned).unwrap(), 1, &mut || true).unwrap_err();
    assert!(matches!(error, VibrationError::Follower { .. }), "{error}");
}

/// Without rotary inertia, section rotations have no inertia, and the corresponding modes have no finite frequency.
#[test]
fn beam_without_rotary_inertia_has_a_mode_for_each_motion_with_inertia() {
    let section = Section { rotary_inertia: 0.0, ..scenes::spaghetti_section(1e6, 100.0) };
    let scene = supported("free-free", &Mesh::bspline(6, 3, 2).unwrap(), section);
    let model = System::assemble(&scene).unwrap();
    let finite = model.unknowns() * 2 / 3;
    let all = Modes::of(&model, finite, &mut || true).unwrap();
    assert!(all.all().iter().all(|mode| mode.square.is_finite()));
    assert_eq!(all.all().iter().filter(|mode| mode.is_free()).count(), 3);
    assert!(matches!(
        Modes::of(&model, finite + 1, &mut || true),
        Err(VibrationError::Count { .. })
    ));
}
