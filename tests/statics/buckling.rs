//! Linear buckling of columns: exact loads of shear-flexible columns, convergence, large meshes and extreme stiffnesses.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{at, orders, scenes, sci};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{Buckling, BucklingError, Loading};
use withy::system::Scene;

const BENDING: f64 = 100.0;
const LENGTH: f64 = 5.0;

fn section(axial_stiffness: f64, shear_stiffness: f64) -> Section {
    Section {
        axial_stiffness,
        shear_stiffness,
        bending_stiffness: BENDING,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Free,
    Hinged,
    Clamped,
}

/// Column along the direction (0.6, 0.8), clamped or hinged at its start, with a unit load along its axis at its end.
/// The restrained ends are free to move along the axis. The lower end of a column is fixed.
fn column(mesh: &Mesh, section: Section, [lower, upper]: [End; 2]) -> Scene {
    let along = at(0.6, 0.8);
    let mut scene = Scene::new("column");
    let axis = scenes::line(Vec2::zeros(), along * LENGTH);
    let beam = scenes::add_beam(&mut scene, axis, mesh, section);
    let (start, end) = (scenes::start_of(&mut scene, beam), scenes::end_of(&mut scene, beam));
    let kind = if lower == End::Clamped { JointKind::Rigid } else { JointKind::Hinge };
    scene.join(kind, start, Partner::Ground).unwrap();
    let upper = match upper {
        End::Free => None,
        End::Hinged => Some(JointKind::InclinedRoller(along)),
        End::Clamped => Some(JointKind::InclinedGuide(along)),
    };
    upper.into_iter().for_each(|kind| scene.join(kind, end, Partner::Ground).unwrap());
    let force = LoadKind::Force { station: end, force: -along, frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    scene
}

fn factors(scene: Scene, count: usize) -> Vec<f64> {
    let found = Buckling::find(scene, Loading::default(), count, &mut || true).unwrap();
    let worst = found.critical().iter().map(|load| load.residual).fold(0.0, f64::max);
    assert!(worst < 1e-8, "residual {worst:e}");
    found.critical().iter().map(|load| load.factor).collect()
}

/// Root of a function between two arguments at which it has different signs, by bisection.
fn root(mut range: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    let rises = of(range[1]) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (range[0] + range[1]);
        range[usize::from((of(middle) > 0.0) == rises)] = middle;
    }
    range[0]
}

/// Exact load of a column whose shear angle is `γ = P θ/GA` plus a constant (Haringx, Philips Res. Rep. 3 (1948) 401–449).
/// The rotation obeys `EI θ'' + P (1 + P/GA) θ = constant`.
fn haringx(shear_stiffness: f64, ends: [End; 2]) -> f64 {
    let load = |k: f64| {
        let euler = BENDING * k * k;
        2.0 * euler / (1.0 + (1.0 + 4.0 * euler / shear_stiffness).sqrt())
    };
    let k = match ends {
        [End::Clamped, End::Free] => FRAC_PI_2 / LENGTH,
        [End::Clamped, End::Clamped] => 2.0 * PI / LENGTH,
        [End::Clamped, End::Hinged] => root([3.3 / LENGTH, 4.6 / LENGTH], |k| {
            (1.0 + load(k) / shear_stiffness) * (k * LENGTH).sin() - k * LENGTH * (k * LENGTH).cos()
        }),
        _ => PI / LENGTH,
    };
    load(k)
}

const COLUMNS: [[End; 2]; 4] = [
    [End::Clamped, End::Free],
    [End::Hinged, End::Hinged],
    [End::Clamped, End::Hinged],
    [End::Clamped, End::Clamped],
];

#[test]
fn columns_buckle_at_the_loads_of_haringx_with_third_order_in_the_span() {
    for ends in COLUMNS {
        for shear_stiffness in [500.0, 1e6] {
            let exact = haringx(shear_stiffness, ends);
            let errors = [8, 16, 32, 64].map(|spans| {
                let mesh = Mesh::bspline(spans, 3, 2).unwrap();
                let scene = column(&mesh, section(1e5, shear_stiffness), ends);
                (factors(scene, 1)[0] / exact - 1.0).abs()
            });
            let rates = orders(&errors);
            println!("{ends:?}, GA = {shear_stiffness:e}: {} {}", sci(&errors), sci(&rates));
            assert!(errors[3] < 1e-6 && rates.iter().all(|order| *order > 2.6), "{errors:?}");
        }
    }
}

#[test]
fn the_axial_stiffness_does_not_change_the_factors() {
    let mesh = Mesh::bspline(16, 3, 2).unwrap();
    for ends in COLUMNS {
        let [soft, stiff] =
            [1e4, 1e12].map(|stiffness| factors(column(&mesh, section(stiffness, 1e4), ends), 3));
        for (soft, stiff) in soft.iter().zip(&stiff) {
            assert!((soft / stiff - 1.0).abs() < 1e-8, "{ends:?}: {soft} {stiff}");
        }
    }
}

/// A clamped column with a load in the middle: the lower half is compressed and the upper half is pulled with half of the load.
/// The exact factor is the smallest root of the determinant of the eight conditions at the ends and in the middle,
/// for the solutions `1, x, cos kx, sin kx` of the lower half and `1, x, cosh kx, sinh kx` of the upper half, with `k² = P/2EI`.
#[test]
fn redundant_axial_forces_are_accurate_for_any_axial_stiffness() {
    const EXACT: f64 = 237.046_066_755_522;
    for stiffness in [1e6, 1e9, 1e12] {
        let mut scene = Scene::new("column");
        let mesh = Mesh::bspline(32, 5, 2).unwrap();
        let axis = scenes::line(Vec2::zeros(), at(0.0, LENGTH));
        let beam = scenes::add_beam(&mut scene, axis, &mesh, section(stiffness, 1e10));
        for arc_length in [0.0, LENGTH] {
            let end = scene.station(beam, arc_length).unwrap();
            scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
        }
        let station = scene.station(beam, 0.5 * LENGTH).unwrap();
        let force = at(0.0, -BENDING / LENGTH.powi(2));
        let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
        scene.add_load(kind, Schedule::constant(1.0).unwrap());
        let error = factors(scene, 1)[0] / EXACT - 1.0;
        println!("EA = {stiffness:e}: {error:.1e}");
        assert!(error.abs() < 1e-5, "EA = {stiffness:e}: {error:e}");
    }
}

#[test]
fn large_models_have_the_loads_of_haringx() {
    let ends = [End::Hinged, End::Hinged];
    // The model has 1200 unknowns, and is searched by the Lanczos method.
    let mesh = Mesh::bspline(400, 3, 2).unwrap();
    let found = factors(column(&mesh, section(1e8, 1e8), ends), 8);
    for (number, factor) in found.iter().enumerate() {
        let euler = BENDING * (PI * (number + 1) as f64 / LENGTH).powi(2);
        let exact = euler / (0.5 + (0.25 + euler / 1e8).sqrt());
        let error = factor / exact - 1.0;
        assert!(error.abs() < 1e-6, "factor {number}: {error:e}");
    }
}

#[test]
fn large_models_without_compression_have_no_critical_load() {
    let mesh = Mesh::bspline(400, 3, 2).unwrap();
    let scene = column(&mesh, section(1e6, 1e6), [End::Clamped, End::Free]);
    let pulled = Loading { factor: -1.0, ..Loading::default() };
    let error = Buckling::find(scene, pulled, 2, &mut || true).unwrap_err();
    assert_eq!(error, BucklingError::FewCriticalLoads { requested: 2, available: 0 });
}
