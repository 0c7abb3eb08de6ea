//! Equilibria and small vibrations of rigid bodies, compared with closed forms.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, hinge, point};
use crate::common::{at, scenes};
use withy::beams::{Mesh, Section, Station};
use withy::integrators::Mechanism;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{ArcLength, Control, Equilibrium, Loading, StaticsError};
use withy::system::{Anchor, Scene, SpringKind, SpringLaw, System};
use withy::vibration::Modes;

const GRAVITY: f64 = 9.81;

/// Root of a function that changes from negative to positive.
fn root(f: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (from + to);
        *(if f(middle) < 0.0 { &mut from } else { &mut to }) = middle;
    }
    0.5 * (from + to)
}

/// Rigid body of mass 1 and inertia 0.2 on a hinge at the origin with a torsion spring, initially along x with its centre at 0.8.
fn lamp(stiffness: f64) -> Scene {
    let mut scene = Scene::new("lamp");
    let body = add_body(&mut scene, at(0.8, 0.0), 0.0, (1.0, 0.2), &[at(-0.8, 0.0), at(0.5, 0.3)]);
    hinge(&mut scene, point(body, 1), None);
    let ends = [Anchor::Ground(at(0.0, 0.0)), Anchor::Station(point(body, 1))];
    let law = SpringLaw::Linear { stiffness, natural: 0.0 };
    scenes::spring(&mut scene, SpringKind::Torsion(ends), law, 0.0);
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

fn squares(model: &System, count: usize) -> Vec<f64> {
    let modes = Modes::of(model, count, &mut || true).unwrap();
    modes.all().iter().map(|mode| mode.square).collect()
}

#[test]
fn lamp_on_a_spring_has_its_equilibrium_and_frequency() {
    for stiffness in [3.0, 30.0, 1e6] {
        let torque = 0.8 * GRAVITY;
        let turned = root(|a| stiffness * a + torque * a.cos(), -1.6, 0.0);
        let path = [Control::Load, Control::ArcLength(ArcLength::default())];
        for control in path {
            let loading = Loading { steps: 10, control, ..Loading::default() };
            let rest = Equilibrium::find(lamp(stiffness), loading, &mut |_| true).unwrap();
            let found = rest.model().angle(rest.scene(), &point(0, 0)).unwrap();
            assert!((found - turned).abs() < 1e-12, "{stiffness}: {found} {turned}");
            let frame = |x: f64, y: f64| {
                at(x * turned.cos() - y * turned.sin(), x * turned.sin() + y * turned.cos())
            };
            let points = rest.model().control_points().next().unwrap();
            assert!((points[2] - frame(1.3, 0.3)).norm() < 1e-12 && points[1].norm() < 1e-12);
            // The potential energy of the weight contributes to the tangent stiffness.
            let expected = (stiffness - torque * turned.sin()) / (0.2 + 0.64);
            let [square] = squares(rest.model(), 1)[..] else { panic!() };
            assert!((square / expected - 1.0).abs() < 1e-7, "{square} {expected}");
            let mut rest = rest;
            let place = rest.scene().place(&point(0, 1), &[]).unwrap();
            let (force, moment) = rest.reaction(&place).unwrap();
            assert!((force - at(0.0, GRAVITY)).norm() < 1e-10 && moment == 0.0, "{force} {moment}");
        }
        // A body on a hinge has only one mode.
        let model = System::assemble(&lamp(stiffness)).unwrap();
        assert!(Modes::of(&model, 2, &mut || true).is_err());
    }
}

#[test]
fn body_hanging_by_its_weight_has_an_equilibrium_and_a_free_body_has_none() {
    let mut scene = lamp(1.0);
    scene.elements.retain(|element| !matches!(element, withy::system::Element::Spring(_)));
    let mut free = scene.clone();
    let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
    let turned = rest.model().angle(rest.scene(), &point(0, 0)).unwrap();
    assert!((turned + std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{turned}");
    let [square] = squares(rest.model(), 1)[..] else { panic!() };
    assert!((square / (0.8 * GRAVITY / 0.84) - 1.0).abs() < 1e-7, "{square}");
    free.joints.clear();
    let refused = Equilibrium::find(free, Loading::default(), &mut |_| true).err().unwrap();
    assert!(matches!(refused, StaticsError::Unrestrained { movements: 3, .. }), "{refused}");
}

/// Slender clamped beam of length 2 with a rigid body at its tip, whose centre is `offset` beyond the tip.
fn with_tip_body(mass: f64, inertia: f64, offset: f64) -> (Scene, usize) {
    let mut scene = Scene::new("tip body");
    let section = Section {
        axial_stiffness: 1e7,
        shear_stiffness: 1e9,
        bending_stiffness: 5.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-9,
    };
    let mesh = Mesh::bspline(12, 5, 4).unwrap();
    let axis = scenes::line(at(0.0, 0.0), at(2.0, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
    let (foot, tip) = (scenes::start_of(&mut scene, beam), scenes::end_of(&mut scene, beam));
    scene.join(JointKind::Rigid, foot, Partner::Ground).unwrap();
    let points = [at(-offset, 0.0), at(0.3, 0.1)];
    let body = add_body(&mut scene, at(2.0 + offset, 0.0), 0.0, (mass, inertia), &points);
    scene.join(JointKind::Rigid, point(body, 1), Partner::Station(tip)).unwrap();
    (scene, body)
}

/// Characteristic function of bending for this beam: `w = a (cos - cosh) + b (sin - sinh)`, with the equations of motion of the body at the tip.
fn characteristic(mass: f64, inertia: f64, offset: f64, omega: f64) -> f64 {
    let (length, stiffness) = (2.0, 5.0_f64);
    let beta = (omega * omega / stiffness).powf(0.25);
    let z = beta * length;
    // Displacement and its first three derivatives for both functions.
    let even = [
        z.cos() - z.cosh(),
        -beta * (z.sin() + z.sinh()),
        -beta.powi(2) * (z.cos() + z.cosh()),
        beta.powi(3) * (z.sin() - z.sinh()),
    ];
    let odd = [
        z.sin() - z.sinh(),
        beta * (z.cos() - z.cosh()),
        -beta.powi(2) * (z.sin() + z.sinh()),
        -beta.powi(3) * (z.cos() + z.cosh()),
    ];
    let square = omega * omega;
    let balance = |w: [f64; 4]| {
        let centre = w[0] + offset * w[1];
        let force = stiffness * w[3] + mass * square * centre;
        let moment = stiffness * w[2] - square * (inertia * w[1] + mass * offset * centre);
        (force, moment)
    };
    let (a, b) = (balance(even), balance(odd));
    a.0 * b.1 - a.1 * b.0
}

#[test]
fn beam_with_a_tip_body_has_exact_frequencies() {
    for (mass, inertia, offset) in
        [(1.0, 0.05, 0.4), (3.0, 0.0, 0.5), (0.0, 0.2, 0.3), (2.0, 1.0, -0.3)]
    {
        let (scene, _) = with_tip_body(mass, inertia, offset);
        let model = System::assemble(&scene).unwrap();
        let found: Vec<f64> = squares(&model, 3).iter().map(|square| square.sqrt()).collect();
        for omega in found {
            let f = |omega: f64| characteristic(mass, inertia, offset, omega);
            let (below, above) = (omega * (1.0 - 2e-6), omega * (1.0 + 2e-6));
            assert!(f(below) * f(above) < 0.0, "{mass}, {inertia}, {offset}: {omega} is no root");
        }
        // The body adds no degrees of freedom: its four displacements are fixed by the four forces of its rigid links.
        let finite = model.unknowns() - 8;
        assert!(Modes::of(&model, finite + 1, &mut || true).is_err());
    }
}

#[test]
fn a_force_on_a_point_beyond_the_tip_bends_the_beam_with_its_moment() {
    let (mut scene, body) = with_tip_body(1.0, 0.1, 0.4);
    let station: Station = point(body, 0);
    let force = at(0.0, -1e-5);
    let always = Schedule::constant(1.0).unwrap();
    scene.add_load(LoadKind::Force { station, force, frame: LoadFrame::Dead }, always);
    let rest = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
    let points = rest.model().control_points().nth(1).unwrap();
    let (length, stiffness, arm) = (2.0_f64, 5.0, 0.4);
    let tip = length.powi(3) / 3.0 + arm * length.powi(2) / 2.0;
    let slope = length.powi(2) / 2.0 + arm * length;
    for (point, along) in [(1, 0.0), (0, 0.4), (2, 0.7)] {
        let own = if point == 2 { 0.1 } else { 0.0 };
        let expected = -1e-5 / stiffness * (tip + slope * along);
        assert!(
            ((points[point].y - own) / expected - 1.0).abs() < 1e-6,
            "{point}: {}",
            points[point].y
        );
    }
}
