//! Equilibria in contact with obstacles, compared with closed forms.
#![allow(clippy::unwrap_used)]

use crate::common::{at, scenes};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::joints::{Components, JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Obstacle, ObstacleShape, ParticleDefinition, Scene};
use withy::vibration::Modes;

fn floor(stiffness: f64) -> Obstacle {
    Obstacle {
        name: "floor".to_owned(),
        shape: ObstacleShape::HalfPlane { point: at(0.0, 0.0), normal: at(0.0, 1.0) },
        targets: Vec::new(),
        radius: 0.0,
        stiffness,
        restitution: 1.0,
        friction: 0.0,
    }
}

fn rest(scene: Scene, steps: usize) -> Equilibrium {
    Equilibrium::find(scene, Loading { steps, ..Loading::default() }, &mut |_| true).unwrap()
}

fn points(rest: &Equilibrium) -> Vec<Vec2> {
    rest.model().control_points().next().unwrap().to_vec()
}

/// A heavy beam on a floor is lifted at its end by the force `P`.
///
/// Euler–Bernoulli: the lifted length is `2P/q`, and the end rises by `q (2P/q)⁴/(24 EI)`.
#[test]
fn a_heavy_beam_is_lifted_off_a_floor() {
    let (bending, weight, force) = (2.0, 4.0, 1.0);
    let mut scene = Scene::new("lifted beam");
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 1e6,
        bending_stiffness: bending,
        mass_per_length: weight / 10.0,
        rotary_inertia: 1e-4,
    };
    let mesh = Mesh::bspline(60, 3, 2).unwrap();
    let beam =
        scenes::add_beam(&mut scene, scenes::line(at(0.0, 0.0), at(2.0, 0.0)), &mesh, section);
    let start = scene.station(beam, 0.0).unwrap();
    let held = JointKind::Support(Components::X);
    scene.join(held, start, Partner::Ground).unwrap();
    scene.gravity = at(0.0, -10.0);
    let end = scenes::end_of(&mut scene, beam);
    let lift = LoadKind::Force { station: end, force: at(0.0, force), frame: LoadFrame::Dead };
    scene.add_load(lift, Schedule::constant(1.0).unwrap());
    scene.add_obstacle(floor(1e6)).unwrap();
    let rest = rest(scene, 10);
    let length: f64 = 2.0 * force / weight;
    let rise = weight * length.powi(4) / (24.0 * bending);
    let found = points(&rest).last().unwrap().y;
    assert!((found / rise - 1.0).abs() < 0.02, "{found} {rise}");
}

/// A particle on a stiff floor sinks by its weight over the stiffness, and vibrates with the frequency of the contact.
#[test]
fn a_particle_rests_on_a_floor() {
    for stiffness in [10.0, 1e4, 1e9] {
        let mut scene = Scene::new("resting particle");
        let ball = ParticleDefinition { name: "ball".to_owned(), position: at(0.5, 0.0) };
        let ball = scene.add_particle(ball, 2.0).unwrap();
        let held = JointKind::Support(Components::X);
        scene.join(held, ball, Partner::Ground).unwrap();
        scene.gravity = at(0.0, -10.0);
        scene.add_obstacle(floor(stiffness)).unwrap();
        let rest = rest(scene, 2);
        let sink = points(&rest)[0].y;
        assert!((sink * stiffness / -20.0 - 1.0).abs() < 1e-9, "{stiffness}: {sink:e}");
        let modes = Modes::of(rest.model(), 1, &mut || true).unwrap();
        let frequency = modes.all()[0].angular_frequency();
        assert!((frequency / (stiffness / 2.0_f64).sqrt() - 1.0).abs() < 1e-9, "{frequency}");
    }
}

/// A wall that a bent cantilever does not reach leaves its equilibrium unchanged, and one in its way holds its tip.
#[test]
fn a_cantilever_is_bent_onto_a_wall() {
    let tip = |depth: Option<f64>| {
        let mut scene = Scene::new("cantilever");
        let mesh = Mesh::bspline(8, 3, 2).unwrap();
        let section = Section { bending_stiffness: 10.0, ..scenes::rod() };
        let axis = scenes::line(at(0.0, 0.0), at(2.0, 0.0));
        let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
        let start = scene.station(beam, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        let end = scenes::end_of(&mut scene, beam);
        let load = LoadKind::Force { station: end, force: at(0.0, -3.0), frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
        if let Some(depth) = depth {
            let shape = ObstacleShape::HalfPlane { point: at(0.0, -depth), normal: at(0.0, 1.0) };
            scene.add_obstacle(Obstacle { shape, ..floor(1e6) }).unwrap();
        }
        points(&rest(scene, 4)).last().unwrap().y
    };
    let free = tip(None);
    assert!(free < -0.6, "{free}");
    assert!((tip(Some(5.0)) - free).abs() < 1e-12);
    for depth in [0.1, 0.4] {
        assert!((tip(Some(depth)) + depth).abs() < 1e-3, "{depth}");
    }
}
