//! Scenes with rigid bodies whose points are connected by rigid links.

use std::f64::consts::FRAC_PI_3;

use super::at;
use super::scenes::{add_beam, end_of, line, spaghetti_section, spring, start_of};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::joints::{
    EndAction, JointKind, Partner, Restraint, Slider, SlidingRule, StartVelocities,
};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::system::{
    Anchor, PointMass, RigidBodyDefinition, Scene, SpringKind, SpringLaw, StartMotion,
};

pub fn add_body(
    scene: &mut Scene,
    position: Vec2,
    angle: f64,
    (mass, inertia): (f64, f64),
    points: &[Vec2],
) -> usize {
    let name = scene.free_name("body");
    let names = ('a'..).map(String::from);
    let points = names.zip(points.iter().copied()).collect();
    let motion = StartMotion::default();
    let body = RigidBodyDefinition { name, position, angle, points, outline: Vec::new(), motion };
    scene.add_rigid_body(body, mass, inertia).unwrap()
}

/// Station at the point of a rigid body with this number, or at its centre.
pub fn point(body: usize, number: usize) -> Station {
    Station::on_rigid_body(body, number)
}

pub fn hinge(scene: &mut Scene, station: Station, other: Option<Station>) {
    let partner = other.map_or(Partner::Ground, Partner::Station);
    scene.join(JointKind::Hinge, station, partner).unwrap();
}

fn soft() -> Section {
    Section { bending_stiffness: 30.0, rotary_inertia: 0.3, ..spaghetti_section(2e3, 30.0) }
}

/// Physical pendulum: a rigid body on a hinge at the distance `arm` from its centre of mass, rotated by an angle, with a point beyond its centre.
pub fn pendulum(inertia: f64, arm: f64, angle: f64) -> Scene {
    let mut scene = Scene::new("rigid pendulum");
    let direction = at(angle.sin(), -angle.cos());
    let points = [at(0.0, arm), at(0.1, -0.5 * arm)];
    let body = add_body(&mut scene, direction * arm, angle, (1.0, inertia), &points);
    hinge(&mut scene, point(body, 1), None);
    scene.gravity = at(0.0, -9.81);
    scene
}

/// Double pendulum of two rigid bodies hinged off the axis, with a dead force and a follower force.
pub fn double_pendulum() -> Scene {
    let mut scene = Scene::new("rigid double pendulum");
    let one = add_body(&mut scene, at(0.5, 0.0), 0.0, (1.0, 0.1), &[at(-0.5, 0.0), at(0.5, 0.1)]);
    // The frame of the body is rotated by 60°.
    let place = at(1.0, 0.1) - at(FRAC_PI_3.cos(), FRAC_PI_3.sin()) * 0.6;
    let points = [at(0.6, 0.0), at(0.6, -0.2)];
    let other = add_body(&mut scene, place, FRAC_PI_3, (2.0, 0.2), &points);
    hinge(&mut scene, point(one, 1), None);
    hinge(&mut scene, point(one, 2), Some(point(other, 1)));
    scene.gravity = at(0.0, -9.81);
    let hold = Schedule::hold_for(1.3).unwrap();
    let station = point(other, 2);
    let dead = LoadKind::Force { station, force: at(2.0, 1.0), frame: LoadFrame::Dead };
    scene.add_load(dead, hold.clone());
    let follower = LoadKind::Force { station, force: at(0.0, -3.0), frame: LoadFrame::Follower };
    scene.add_load(follower, hold.clone());
    scene.add_load(LoadKind::Moment { station: point(one, 2), moment: 0.7 }, hold);
    scene
}

/// Free beam with a hinged rigid body at one end and a rigidly joined one, off its centre, at the other. A point mass, a spring between points and a torsion
/// spring are attached.
pub fn dumbbell(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("flying dumbbell");
    let beam = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 0.0)), mesh, soft());
    let hung =
        add_body(&mut scene, at(-0.4, -0.3), 0.0, (0.8, 0.1), &[at(0.4, 0.3), at(-0.2, 0.5)]);
    let fixed =
        add_body(&mut scene, at(3.5, 0.2), 0.0, (1.2, 0.2), &[at(-0.5, -0.2), at(0.2, 0.6)]);
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    hinge(&mut scene, start, Some(point(hung, 1)));
    scene.join(JointKind::Rigid, point(fixed, 1), Partner::Station(end)).unwrap();
    let mass = PointMass { station: point(hung, 2), mass: 0.3, rotary_inertia: 0.05 };
    scene.add_mass(mass).unwrap();
    let ends = [point(hung, 2), point(fixed, 2)].map(Anchor::Station);
    let stretch = SpringLaw::Linear { stiffness: 4.0, natural: 3.0 };
    spring(&mut scene, SpringKind::Length(ends.to_vec()), stretch, 0.0);
    let turn = [Anchor::Station(start), Anchor::Station(point(hung, 0))];
    let twist = SpringLaw::Linear { stiffness: 2.0, natural: 0.3 };
    spring(&mut scene, SpringKind::Torsion(turn), twist, 0.0);
    let motion = StartMotion { velocity: at(0.5, 1.0), spin: 0.9, centre: Some(at(1.0, 0.0)) };
    scene.beams[beam].motion = motion;
    scene.rigid_bodies.iter_mut().for_each(|body| body.motion = motion);
    scene
}

/// Four-bar linkage: a massless crank driven by a moment, a flexible coupler and a rocker without rotary inertia.
pub fn crank_rocker(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("crank and rocker");
    let crank = add_body(&mut scene, at(0.0, 0.0), 0.0, (0.0, 0.3), &[at(0.0, 0.5)]);
    let coupler = add_beam(&mut scene, line(at(0.0, 0.5), at(2.0, 1.5)), mesh, soft());
    let rocker =
        add_body(&mut scene, at(2.0, 0.9), 0.0, (0.9, 0.0), &[at(0.0, 0.6), at(0.0, -0.9)]);
    let (start, end) = (start_of(&mut scene, coupler), end_of(&mut scene, coupler));
    hinge(&mut scene, point(crank, 0), None);
    hinge(&mut scene, point(crank, 1), Some(start));
    hinge(&mut scene, end, Some(point(rocker, 1)));
    hinge(&mut scene, point(rocker, 2), None);
    let station = point(crank, 0);
    let drive = Schedule::hold_for(1.0).unwrap();
    scene.add_load(LoadKind::Moment { station, moment: 2.0 }, drive);
    scene.gravity = at(0.0, -3.0);
    scene
}

/// Carriage: a rigid body with two wheels that slide along a hinged beam, and a load that is hinged to it.
pub fn carriage(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("carriage");
    let section = spaghetti_section(1e4, 100.0);
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(6.0, 0.0)), mesh, section);
    let (start, end) = (start_of(&mut scene, rail), end_of(&mut scene, rail));
    hinge(&mut scene, start, None);
    hinge(&mut scene, end, None);
    let wheels = [at(-0.4, 0.2), at(0.4, 0.2), at(0.0, -0.1)];
    let body = add_body(&mut scene, at(2.0, -0.2), 0.0, (1.0, 0.1), &wheels);
    let load = add_body(&mut scene, at(2.0, -1.0), 0.0, (2.0, 0.1), &[at(0.0, 0.7)]);
    hinge(&mut scene, point(body, 3), Some(point(load, 1)));
    let moving = StartMotion { velocity: at(0.8, 0.0), ..StartMotion::default() };
    scene.rigid_bodies.iter_mut().for_each(|body| body.motion = moving);
    for (number, arc_length) in [(1, 1.6), (2, 2.4)] {
        let slider = Slider {
            name: scene.free_name("slider"),
            slave: point(body, number),
            master: rail,
            track: None,
            arc_length,
            rule,
            ends: EndAction::Bounce,
            restitution: 1.0,
            friction: 0.0,
            static_friction: None,
            restraint: Restraint::Place,
            velocities: StartVelocities::Check,
        };
        scene.add_slider(slider).unwrap();
    }
    scene.gravity = at(0.0, -2.0);
    scene
}

/// Chain of rigid bodies that is hinged at one end and falls under gravity.
pub fn chain(bodies: usize) -> Scene {
    let mut scene = Scene::new("rigid chain");
    let ends = [at(-0.5, 0.0), at(0.5, 0.0)];
    for number in 0..bodies {
        let place = at(number as f64 + 0.5, 0.0);
        let body = add_body(&mut scene, place, 0.0, (1.0, 0.1), &ends);
        let before = number.checked_sub(1).map(|before| point(before, 2));
        hinge(&mut scene, point(body, 1), before);
    }
    scene.gravity = at(0.0, -9.81);
    scene
}

/// All scenes without sliders on a mesh, including one with piecewise linear laws.
pub fn all(mesh: &Mesh) -> Vec<Scene> {
    vec![
        pendulum(0.2, 0.8, 2.0),
        double_pendulum(),
        dumbbell(mesh),
        crank_rocker(mesh),
        chain(5),
        super::release_scenes::bracket(mesh),
        super::roller_scenes::on_rollers(mesh),
        super::scenes::absorbed(mesh),
        super::steered_scenes::trolley(mesh),
    ]
}
