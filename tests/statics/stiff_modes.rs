//! Natural frequencies of beams of any stiffness, compared with the exact solution for Timoshenko beams.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::reference::{number, text};
use crate::common::{at, scenes, sci};
use nalgebra::Matrix4;
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Scene, System};
use withy::vibration::{Mode, Modes, VibrationError};

const LENGTH: f64 = 10.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Support {
    Cantilever,
    Clamped,
    Free,
    Simple,
}

const SUPPORTS: [Support; 4] =
    [Support::Cantilever, Support::Clamped, Support::Free, Support::Simple];

impl Support {
    fn scene(self, mesh: &Mesh, section: Section) -> Scene {
        let mut scene = Scene::new("beam");
        let axis = scenes::line(Vec2::zeros(), at(LENGTH, 0.0));
        let beam = scenes::add_beam(&mut scene, axis, mesh, section);
        let held: &[(f64, JointKind)] = match self {
            Self::Free => &[],
            Self::Cantilever => &[(0.0, JointKind::Rigid)],
            Self::Clamped => &[(0.0, JointKind::Rigid), (LENGTH, JointKind::Rigid)],
            Self::Simple => &[(0.0, JointKind::Hinge), (LENGTH, JointKind::Hinge)],
        };
        for (arc_length, kind) in held {
            let station = scene.station(beam, *arc_length).unwrap();
            scene.join(*kind, station, Partner::Ground).unwrap();
        }
        scene
    }

    fn zeros(self) -> usize {
        if self == Self::Free { 3 } else { 0 }
    }

    /// First non-zero angular frequencies, including axial ones.
    fn exact(self, section: &Section, count: usize) -> Vec<f64> {
        let mut all = match self {
            Self::Simple => simply_supported(section, count + 1),
            other => roots(other, section, count),
        };
        let wave = (section.axial_stiffness / section.mass_per_length).sqrt() / LENGTH;
        all.extend((1..=count).map(|n| {
            let quarter = if self == Self::Cantilever { 0.5 } else { 0.0 };
            (n as f64 - quarter) * PI * wave
        }));
        all.sort_by(f64::total_cmp);
        all.truncate(count);
        all
    }
}

/// Both branches of the closed form, and the mode of uniform section rotation.
fn simply_supported(section: &Section, count: usize) -> Vec<f64> {
    let Section { bending_stiffness: ei, shear_stiffness: ga, .. } = *section;
    let (mass, rotary) = (section.mass_per_length, section.rotary_inertia);
    let mut all = vec![(ga / rotary).sqrt()];
    for n in 1..=count {
        let k = n as f64 * PI / LENGTH;
        let (a, c) = (mass * rotary / ga, ei * k.powi(4));
        let b = mass + k * k * (rotary + ei * mass / ga);
        let root = (b * b - 4.0 * a * c).sqrt();
        all.extend([(2.0 * c / (b + root)).sqrt(), ((b + root) / (2.0 * a)).sqrt()]);
    }
    all
}

/// Frequencies with a non-trivial solution of `GA (w'' - θ') + ρA ω² w = 0`, `EI θ'' + GA (w' - θ) + ρI ω² θ = 0` and the boundary conditions.
fn roots(support: Support, section: &Section, count: usize) -> Vec<f64> {
    let wave = (section.bending_stiffness / section.mass_per_length).sqrt() / LENGTH.powi(2);
    let cut_off = (section.shear_stiffness / section.rotary_inertia).sqrt();
    let sign = |root: f64| determinant(support, section, root * root * wave);
    let (step, mut found) = (0.004, Vec::new());
    let (mut from, mut before) = (0.3, sign(0.3));
    while found.len() < count {
        let (to, now) = (from + step, sign(from + step));
        if before * now < 0.0 {
            let (mut low, mut high) = (from, to);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if sign(middle) * before > 0.0 { low = middle } else { high = middle }
            }
            let frequency = (0.5 * (low + high)).powi(2) * wave;
            // At the cut-off frequency the second wave becomes oscillatory, and its two functions coincide.
            if (frequency / cut_off - 1.0).abs() > 1e-7 {
                found.push(frequency);
            }
        }
        (from, before) = (to, now);
    }
    found
}

fn determinant(support: Support, section: &Section, omega: f64) -> f64 {
    let Section { bending_stiffness: ei, shear_stiffness: ga, .. } = *section;
    let (mass, rotary, square) = (section.mass_per_length, section.rotary_inertia, omega * omega);
    // EI p² + (ρI + EI ρA/GA) ω² p + ρA ω² (ρI ω²/GA - 1) = 0 for p = λ², w = exp(λ x)
    let half = 0.5 * (rotary / ei + mass / ga) * square;
    let product = mass * square * (rotary * square / ga - 1.0) / ei;
    let first = -half - (half * half - product).sqrt();
    let second = product / first;
    let shear = mass * square / ga;
    // Displacement, rotation, moment and shear force of a function at a position; Q = -M' - ρI ω² θ.
    let state = |w: f64, angle: f64, slope: f64, p: f64| {
        [w, angle, ei * slope, -(ei * p + rotary * square) * angle]
    };
    let waves = |p: f64, x: f64| {
        let a = (-p).sqrt();
        let (tau, (sin, cos)) = (a - shear / a, (a * x).sin_cos());
        [state(cos, -tau * sin, -tau * a * cos, p), state(sin, tau * cos, -tau * a * sin, p)]
    };
    let decays = |p: f64, x: f64| {
        let b = p.sqrt();
        let (tau, near, far) = (b + shear / b, (-b * x).exp(), (-b * (LENGTH - x)).exp());
        [state(near, -tau * near, tau * b * near, p), state(far, tau * far, tau * b * far, p)]
    };
    let all = |x: f64| {
        let [one, two] = waves(first, x);
        let [three, four] = if second > 0.0 { decays(second, x) } else { waves(second, x) };
        [one, two, three, four]
    };
    let held: [[usize; 2]; 2] = match support {
        Support::Cantilever => [[0, 1], [2, 3]],
        Support::Clamped => [[0, 1], [0, 1]],
        Support::Free => [[2, 3], [2, 3]],
        Support::Simple => [[0, 2], [0, 2]],
    };
    let mut rows = Vec::new();
    for (x, held) in [0.0, LENGTH].into_iter().zip(held) {
        let functions = all(x);
        for which in held {
            let row = functions.map(|of| of[which]);
            let largest = row.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
            rows.extend(row.map(|entry| entry / largest));
        }
    }
    Matrix4::from_row_slice(&rows).determinant()
}

/// `EI = 100`, `ρA = 1`. The rotary inertia is relative to `ρA L²`, with that of a solid strip as default.
fn section(ratio: f64, rotary: Option<f64>) -> Section {
    let bending_stiffness = 100.0;
    let axial_stiffness = ratio * bending_stiffness / (LENGTH * LENGTH);
    Section {
        axial_stiffness,
        shear_stiffness: axial_stiffness / 3.12,
        bending_stiffness,
        mass_per_length: 1.0,
        rotary_inertia: rotary
            .map_or(bending_stiffness / axial_stiffness, |part| part * LENGTH * LENGTH),
    }
}

fn modes(scene: &Scene, count: usize) -> Result<Modes, VibrationError> {
    Modes::of(&System::assemble(scene).unwrap(), count, &mut || true)
}

/// Relative errors of the first six frequencies, and the modes.
fn errors(
    support: Support,
    mesh: &Mesh,
    section: Section,
) -> Result<(Vec<f64>, Modes), VibrationError> {
    let zeros = support.zeros();
    let found = modes(&support.scene(mesh, section), 6 + zeros)?;
    let exact = support.exact(&section, 6);
    let frequencies = found.all()[zeros..].iter().map(Mode::angular_frequency);
    Ok((frequencies.zip(exact).map(|(found, exact)| (found / exact - 1.0).abs()).collect(), found))
}

#[test]
fn exact_frequencies_agree_with_the_reference() {
    let json: serde_json::Value = serde_json::from_str(&text("P5_frequencies.json")).unwrap();
    let mut checked = 0;
    for case in json["cases"].as_array().unwrap() {
        let numbers = |value: &serde_json::Value| -> Vec<f64> {
            value.as_array().unwrap().iter().map(number).collect()
        };
        let values = numbers(&case["L,EA,GAs,EI,rhoA,rhoI"]);
        let section = Section {
            axial_stiffness: values[1],
            shear_stiffness: values[2],
            bending_stiffness: values[3],
            mass_per_length: values[4],
            rotary_inertia: values[5],
        };
        let exact = match case["bc"].as_str().unwrap() {
            "cantilever" => roots(Support::Cantilever, &section, 6),
            "free-free" => roots(Support::Free, &section, 6),
            "simply-supported" => {
                let mut all = simply_supported(&section, 6);
                all.sort_by(f64::total_cmp);
                all
            }
            _ => continue,
        };
        for (found, reference) in exact.iter().zip(numbers(&case["flexural"])) {
            assert!((found / reference - 1.0).abs() < 1e-11, "{} {found} {reference}", case["bc"]);
            checked += 1;
        }
    }
    assert!(checked >= 36, "{checked}");
}

/// Allowed error at any stiffness: ten times the mesh error at moderate stiffness, and a floor for rounding.
fn allowed(mode: usize, spans: usize) -> f64 {
    let wave = (mode as f64 + 1.0) * PI / spans as f64;
    10.0 * MESH_ERROR * wave.powi(4) + 1e-8
}

/// Largest frequency error of cubic splines at moderate stiffness, over `(β h)⁴`.
const MESH_ERROR: f64 = 1.0 / 100.0;

fn check(ratio: f64, rotary: Option<f64>, spans: usize, support: Support) -> Option<f64> {
    let section = section(ratio, rotary);
    let mesh = Mesh::bspline(spans, 3, 2).unwrap();
    let name = format!("EA L²/EI {ratio:.0e}, rho_I {rotary:?}, {spans} spans, {support:?}");
    match errors(support, &mesh, section) {
        Ok((errors, found)) => {
            let residual = found.all().iter().map(|mode| mode.residual).fold(0.0, f64::max);
            println!("{name}: {} residual {residual:.0e}", sci(&errors));
            let zeros = support.zeros();
            assert_eq!(found.all().iter().filter(|mode| mode.is_free()).count(), zeros, "{name}");
            assert!(residual <= 1e-6, "{name} {residual}");
            // A mesh has about as many bending modes as spans. Its other modes are axial or shear modes.
            for (mode, error) in errors.iter().enumerate().take(spans) {
                assert!(*error < allowed(mode, spans), "{name}: {}", sci(&errors));
            }
            errors.iter().copied().reduce(f64::max)
        }
        Err(error) => {
            println!("{name}: {error}");
            None
        }
    }
}

fn check_all(ratios: &[i32], rotaries: &[Option<f64>], spans: &[usize]) {
    let (mut refused, mut checked) = (0, 0);
    for &exponent in ratios {
        for &rotary in rotaries {
            for &spans in spans {
                for support in SUPPORTS {
                    let error = check(10_f64.powi(exponent), rotary, spans, support);
                    refused += usize::from(error.is_none());
                    checked += 1;
                }
            }
        }
    }
    println!("{checked} beams, {refused} refused");
    assert_eq!(refused, 0);
}

#[test]
fn beams_of_any_stiffness_have_their_first_six_frequencies() {
    check_all(&[2, 6, 10, 14], &[None, Some(1e-12)], &[4, 16, 120]);
    check_all(&[14], &[None, Some(1e-12)], &[400]);
}

#[test]
fn beams_of_the_whole_grid_have_their_first_six_frequencies() {
    let ratios = [2, 4, 6, 8, 10, 12, 14];
    check_all(&ratios, &[None, Some(1e-6), Some(1e-12)], &[4, 16, 64, 120, 400, 2000]);
}

/// The number of equal modes exceeds the block size of the search.
#[test]
fn all_of_many_equal_modes_are_found() {
    let (beams, mesh, section) = (7, Mesh::bspline(14, 3, 2).unwrap(), section(1e8, None));
    let mut scene = Scene::new("comb");
    for number in 0..beams {
        let height = f64::from(number);
        let axis = scenes::line(at(0.0, height), at(LENGTH, height));
        let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
        let start = scene.station(beam, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    }
    assert!(System::assemble(&scene).unwrap().unknown_kinds().len() > 240);
    let found = modes(&scene, 10).unwrap();
    let single = modes(&Support::Cantilever.scene(&mesh, section), 2).unwrap();
    for (number, mode) in found.all().iter().enumerate() {
        let expected = single.all()[number / 7].angular_frequency();
        let error = (mode.angular_frequency() / expected - 1.0).abs();
        assert!(error < 1e-9, "mode {number}: {error:.1e}");
    }
}

/// The highest modes of a small scene are as accurate as the lowest. Axial frequencies are proportional to the square root of the axial stiffness.
#[test]
fn all_modes_of_a_small_stiff_beam_are_found() {
    let axial = |ratio: f64| -> Vec<f64> {
        let scene = Support::Free.scene(&Mesh::bspline(8, 3, 2).unwrap(), section(ratio, None));
        let found = modes(&scene, 33).unwrap();
        let is_axial = |mode: &&Mode| {
            let across = mode.shape.chunks(3).map(|point| point[1].abs() + LENGTH * point[2].abs());
            let along = mode.shape.chunks(3).map(|point| point[0].abs());
            across.fold(0.0, f64::max) < 1e-6 * along.fold(0.0, f64::max)
        };
        let residual = found.all().iter().map(|mode| mode.residual).fold(0.0, f64::max);
        println!("EA L²/EI {ratio:.0e}: residual {residual:.1e}");
        found.all()[3..].iter().filter(is_axial).map(Mode::angular_frequency).collect()
    };
    let (soft, stiff) = (axial(1e6), axial(1e14));
    assert_eq!((soft.len(), stiff.len()), (10, 10));
    for (soft, stiff) in soft.iter().zip(&stiff) {
        assert!((stiff / (1e4 * soft) - 1.0).abs() < 1e-9, "{soft} {stiff}");
    }
}

/// The prestress is the section force that balances the load. It must not be lost in the rounding of the strain.
#[test]
fn a_stiff_column_loses_its_stiffness_at_eulers_load() {
    for (ratio, spans) in [(1e6, 20), (1e10, 20), (1e12, 100)] {
        let section = section(ratio, None);
        let euler = PI.powi(2) * section.bending_stiffness / (4.0 * LENGTH * LENGTH);
        let lowest = |part: f64| {
            let mut scene =
                Support::Cantilever.scene(&Mesh::bspline(spans, 3, 2).unwrap(), section);
            let station = scenes::end_of(&mut scene, 0);
            let load =
                LoadKind::Force { station, force: at(-part * euler, 0.0), frame: LoadFrame::Dead };
            scene.add_load(load, Schedule::constant(1.0).unwrap());
            let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
            rest.modes(1, &mut || true).unwrap().all()[0].square
        };
        // Shear reduces the critical load of a column by the ratio of load to shear stiffness.
        let (below, half, above) = (lowest(0.9999), lowest(0.5), lowest(1.0001));
        println!("EA L²/EI {ratio:.0e}: {below:e} {half:e} {above:e}");
        if ratio > 1e7 {
            assert!(below > 0.0 && above < 0.0, "{ratio:e}: {below} {above}");
            assert!((below / above + 1.0).abs() < 1e-2, "{ratio:e}: {below} {above}");
        }
        assert!(half > 100.0 * below.abs());
    }
}

struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % count
    }
}

/// Ordinary scenes converge, and agree with finer meshes or the exact solution.
fn random_scenes(count: usize) {
    let mut random = Random(7);
    for number in 0..count {
        let (spans, degree) = (1 + random.below(300), 1 + random.below(5));
        let support = SUPPORTS[random.below(4)];
        let ratio = 10_f64.powf(2.0 + 8.0 * random.below(1000) as f64 / 1000.0);
        let mesh = Mesh::bspline(spans, degree, degree - 1).unwrap();
        let section = section(ratio, None);
        let scene = support.scene(&mesh, section);
        let available = System::assemble(&scene).unwrap().unknown_kinds().len();
        let (zeros, asked) = (support.zeros(), (6 + support.zeros()).min(available));
        let name = format!("{number}: {support:?}, {}, EA L²/EI {ratio:.1e}", mesh.describe());
        let found = match modes(&scene, asked) {
            Ok(found) => found,
            Err(error) => panic!("{name}: {error}"),
        };
        assert_eq!(found.all().iter().filter(|mode| mode.is_free()).count(), zeros, "{name}");
        // Meshes of odd degree with enough spans are near the exact solution. The accuracy of other meshes depends on their quadrature rule.
        if degree % 2 == 1 && spans >= 60 {
            let exact = support.exact(&section, 6);
            for (mode, (found, exact)) in found.all()[zeros..].iter().zip(exact).enumerate() {
                let error = (found.angular_frequency() / exact - 1.0).abs();
                let wave = (mode as f64 + 1.0) * PI / spans as f64;
                let allowed = if degree == 1 { wave * wave } else { wave.powi(4) } + 1e-8;
                assert!(error < allowed, "{name}, mode {mode}: {error:.1e}");
            }
        }
    }
}

#[test]
fn modes_of_random_plain_scenes_converge() {
    random_scenes(40);
}

#[test]
fn modes_of_all_random_plain_scenes_converge() {
    random_scenes(216);
}
