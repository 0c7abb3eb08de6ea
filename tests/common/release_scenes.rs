//! Scenes with objects that are released during the run.

use super::at;
use super::body_scenes::{add_body, hinge, point};
use super::scenes::{add_beam, drive, end_of, line, rod, spring, start_of};
use withy::beams::Mesh;
use withy::joints::{
    Component, EndAction, JointKind, Partner, Releasable, Release, Restraint, Slider, SlidingRule,
    StartVelocities, Trigger,
};
use withy::loads::{PrescribedMotion, Schedule};
use withy::system::{Anchor, ParticleDefinition, Scene, SpringKind, SpringLaw};

pub fn release(scene: &mut Scene, hold: Releasable, time: f64) {
    scene.add_release(Release { object: hold, trigger: Trigger::Time(time) }).unwrap();
}

/// Chain with a prescribed rotation at its foot and a bead on a spring at its end. The motor, the rigid joint, the spring, the bead and the foot are released
/// one after another, both between points of the time grid and on them.
pub fn chain(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("a chain that lets go");
    let one = add_beam(&mut scene, line(at(0.0, 0.0), at(1.0, 0.5)), mesh, rod());
    let two = add_beam(&mut scene, line(at(1.0, 0.5), at(2.0, 0.0)), mesh, rod());
    let (foot, middle) = (start_of(&mut scene, one), end_of(&mut scene, one));
    let (next, tip) = (start_of(&mut scene, two), end_of(&mut scene, two));
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(2.0, 0.0) };
    let bead = scene.add_particle(bead, 0.7).unwrap();
    scene.join(JointKind::Hinge, foot, Partner::Ground).unwrap();
    scene.join(JointKind::Rigid, middle, Partner::Station(next)).unwrap();
    scene.join(JointKind::Hinge, tip, Partner::Station(bead)).unwrap();
    let turn = Schedule::Sine { amplitude: 0.3, rate: 4.0, phase: 0.0 };
    drive(&mut scene, foot, &[(Component::Rotation, PrescribedMotion::Position(turn))]);
    let ends = vec![Anchor::Ground(at(2.5, 1.0)), Anchor::Station(bead)];
    let law = SpringLaw::Linear { stiffness: 60.0, natural: 0.4 };
    spring(&mut scene, SpringKind::Length(ends), law, 0.8);
    scene.gravity = at(0.0, -3.0);
    let holds = [
        Releasable::Drive(0),
        Releasable::Joint(1),
        Releasable::Spring(0),
        Releasable::Joint(2),
        Releasable::Joint(0),
    ];
    for (hold, time) in holds.into_iter().zip([0.1, 0.17, 0.25, 0.33, 0.4]) {
        release(&mut scene, hold, time);
    }
    scene
}

/// Wheel on a bracket. The bracket is released from the ground, then the wheel from the bracket.
pub fn bracket(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("a bracket that lets go");
    let points = [at(-0.5, 0.0), at(0.5, 0.2)];
    let bracket = add_body(&mut scene, at(0.5, 0.0), 0.3, (1.0, 0.2), &points);
    let beam_start = scene.drawn_at(&point(bracket, 2)).unwrap();
    let beam = add_beam(&mut scene, line(beam_start, beam_start + at(1.0, 0.3)), mesh, rod());
    let start = start_of(&mut scene, beam);
    hinge(&mut scene, point(bracket, 1), None);
    scene.join(JointKind::Rigid, start, Partner::Station(point(bracket, 2))).unwrap();
    scene.gravity = at(0.0, -9.81);
    release(&mut scene, Releasable::Joint(0), 0.2);
    release(&mut scene, Releasable::Joint(1), 0.31);
    scene
}

/// Bead that slides on a falling rod. The hinge of the rod is released, and the bead is released in the middle of the rod.
pub fn bead(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("a bead that lets go");
    let beam = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 0.0)), mesh, rod());
    let start = start_of(&mut scene, beam);
    let particle = ParticleDefinition { name: "bead".to_owned(), position: at(1.0, 0.0) };
    let slave = scene.add_particle(particle, 0.5).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    let slider = Slider {
        name: "slider1".to_owned(),
        slave,
        master: beam,
        track: None,
        arc_length: 1.0,
        rule: SlidingRule::Conserving,
        ends: EndAction::Stop,
        restitution: 1.0,
        friction: 0.0,
        static_friction: None,
        restraint: Restraint::Place,
        velocities: StartVelocities::Check,
    };
    scene.add_slider(slider).unwrap();
    scene.gravity = at(1.0, -9.81);
    release(&mut scene, Releasable::Joint(0), 0.15);
    release(&mut scene, Releasable::Slider(0), 0.32);
    scene
}

pub fn all(mesh: &Mesh) -> Vec<Scene> {
    vec![chain(mesh), bracket(mesh), bead(mesh)]
}
