//! Equilibria and vibrations of beams with varying sections, compared with closed forms.
#![allow(clippy::unwrap_used)]

use crate::common::{at, scenes};
use withy::beams::{Mesh, Section, SectionShape, SectionVariation, Solid};
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Scene, System};
use withy::vibration::{Mode, Modes};

fn clamped(variation: SectionVariation, length: f64, spans: usize) -> Scene {
    let mut scene = Scene::new("clamped");
    let mesh = Mesh::bspline(spans, 4, 3).unwrap();
    let axis = scenes::line(at(0.0, 0.0), at(length, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &mesh, scenes::rod());
    scene.beams[beam].section = variation;
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene
}

#[test]
fn deflection_of_a_tapered_cantilever_agrees_with_the_integral() {
    // EI = B (1 - a s): δ = F L³/B ∫ (1 - s)²/(1 - a s) ds. The shear deflection is F L/G, as GA is uniform.
    let (stiffness, a, length, force) = (50.0, 0.8, 2.0, 1e-4);
    let section = |bending: f64| Section {
        axial_stiffness: 1e5,
        shear_stiffness: 1e3,
        bending_stiffness: bending,
        mass_per_length: 1.0,
        rotary_inertia: 1.0,
    };
    let variation = SectionVariation::Numbers(vec![
        (0.0, section(stiffness)),
        (1.0, section(stiffness * (1.0 - a))),
    ]);
    let mut scene = clamped(variation, length, 24);
    let tip = scene.station(0, length).unwrap();
    let down = LoadKind::Force { station: tip, force: at(0.0, -force), frame: LoadFrame::Dead };
    scene.add_load(down, Schedule::constant(1.0).unwrap());
    let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
    let sunk = -rest.model().control_points().next().unwrap().last().unwrap().y;
    // u = 1 - s, 1 - a s = b + a u with b = 1 - a: ∫ u²/(b + a u) du.
    let b: f64 = 1.0 - a;
    let integral = (0.5 * a * a - a * b + b * b * ((b + a) / b).ln()) / a.powi(3);
    let expected = force * (length.powi(3) / stiffness * integral + length / 1e3);
    assert!((sunk / expected - 1.0).abs() < 1e-6, "{sunk} {expected}");
}

/// `J_n(x)` by its power series.
fn bessel(n: u32, x: f64) -> f64 {
    let mut term = (1..=n).fold(1.0, |product, k| product * 0.5 * x / f64::from(k));
    let mut sum = term;
    for k in 1..60_u32 {
        term *= -0.25 * x * x / f64::from(k) / f64::from(k + n);
        sum += term;
    }
    sum
}

/// `I_n(x)` by its power series.
fn modified_bessel(n: u32, x: f64) -> f64 {
    let mut term = (1..=n).fold(1.0, |product, k| product * 0.5 * x / f64::from(k));
    let mut sum = term;
    for k in 1..60_u32 {
        term *= 0.25 * x * x / f64::from(k) / f64::from(k + n);
        sum += term;
    }
    sum
}

/// First root of Kirchhoff's wedge, `I1 J2 + J1 I2 = 0`: `ω = z²/4 · √(E h²/(12 ρ))/L²` with `h` at the clamp.
fn wedge_root() -> f64 {
    let f = |z: f64| modified_bessel(1, z) * bessel(2, z) + bessel(1, z) * modified_bessel(2, z);
    let (mut low, mut high) = (3.0, 6.0);
    assert!(f(low) * f(high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

#[test]
fn wedge_has_the_frequencies_of_kirchhoff() {
    // Kirchhoff's wedge has a sharp tip. Here the tip height is a thousandth of that at the clamp, and shear and rotary inertia reduce the frequency by 0.2 %.
    let (young, density, height, length) = (1e9, 1000.0, 0.01, 1.0);
    let solid = |part: f64| Solid {
        youngs_modulus: young,
        poisson: 0.0,
        density,
        shape: SectionShape::Rectangle { width: 0.02, height: height * part },
    };
    let variation = SectionVariation::Dimensions(vec![(0.0, solid(1.0)), (1.0, solid(1e-3))]);
    let root = wedge_root();
    let factor = root * root / 4.0;
    assert!((factor - 5.315).abs() < 1e-3, "Kirchhoff's value: {factor}");
    let expected = factor * (young * height * height / (12.0 * density)).sqrt() / (length * length);
    let model = System::assemble(&clamped(variation, length, 40)).unwrap();
    let modes = Modes::of(&model, 1, &mut || true).unwrap();
    let found = modes.all().first().map(Mode::angular_frequency).unwrap();
    assert!((found / expected - 1.0).abs() < 3e-3, "{found} {expected}");
}

#[test]
fn tapered_bar_has_the_stretch_and_frequencies_of_its_area() {
    // Conical bar with area (1 - s/2)²: modes u = f/(1 - s/2) with f'' + β² f = 0, f(0) = 0, (f/r)'(1) = 0, r = 1 - s/2.
    let (stiffness, mass, length) = (100.0, 2.0, 3.0);
    let solid = |radius: f64| Solid {
        youngs_modulus: stiffness / std::f64::consts::PI,
        poisson: 0.0,
        density: mass / std::f64::consts::PI,
        shape: SectionShape::Circle { radius },
    };
    let variation = SectionVariation::Dimensions(vec![(0.0, solid(1.0)), (1.0, solid(0.5))]);
    // tan β = -β r/r' at the end: f' r = f r', with f = sin β s: β cos β · ½ = -½ sin β.
    let (mut low, mut high) = (std::f64::consts::FRAC_PI_2 + 1e-9, std::f64::consts::PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle.tan() + middle < 0.0 { low = middle } else { high = middle }
    }
    let expected = 0.5 * (low + high) * (stiffness / mass).sqrt() / length;
    let model = System::assemble(&clamped(variation, length, 12)).unwrap();
    let modes = Modes::of(&model, 12, &mut || true).unwrap();
    let nearest = modes
        .all()
        .iter()
        .map(|mode| (mode.angular_frequency() / expected - 1.0).abs())
        .fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-5, "{nearest:e}");
}
