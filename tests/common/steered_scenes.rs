//! Scenes that controllers steer: functions of time and state that are asked at the start of every step, and whose values hold for it.

use std::cell::Cell;
use std::rc::Rc;

use super::at;
use super::body_scenes::{add_body, hinge, point};
use super::scenes::{add_beam, end_of, line, rod, start_of};
use withy::beams::Mesh;
use withy::joints::{Component, JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::Simulation;
use withy::system::{Drive, DriveKind, Scene};

/// What a controller says before it is asked.
const START: f64 = 0.4;

fn controller() -> Schedule {
    Schedule::Sampled(Rc::new(Cell::new(START)))
}

/// Tells every controller of a simulation what holds for the step that begins: a function of time and of where the first body ends.
pub fn steer(simulation: &Simulation) {
    let (time, points) = (simulation.time(), simulation.model().control_points().next());
    let end = points.and_then(<[_]>::last).copied().unwrap_or_default();
    for (number, (_, schedule)) in simulation.scene().schedules().enumerate() {
        if let Schedule::Sampled(value) = schedule {
            let wanted = (1.1 * time + number as f64).cos();
            value.set(0.8 * wanted - 0.2 * end.y);
        }
    }
}

/// Gives every controller of a scene, whose copies share them, the value with which runs begin.
pub fn reset(scene: &Scene) {
    for (_, schedule) in scene.schedules() {
        if let Schedule::Sampled(value) = schedule {
            value.set(START);
        }
    }
}

pub fn is_steered(scene: &Scene) -> bool {
    scene.schedules().any(|(_, schedule)| schedule.is_sampled())
}

fn drive(scene: &mut Scene, kind: DriveKind, component: Component, station: withy::beams::Station) {
    let mut motions = [None, None, None];
    motions[component as usize] = Some(PrescribedMotion::Rate(controller()));
    let name = scene.free_name(kind.name());
    scene.add_drive(Drive { name, kind, station, motions }).unwrap();
}

/// An arm on a hinge under a controlled torque, with a forearm on it that a controlled motor turns, and a controlled thrust that turns with its end.
pub fn arm(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("steered arm");
    let upper = add_beam(&mut scene, line(at(0.0, 0.0), at(1.5, 0.4)), mesh, rod());
    let lower = add_beam(&mut scene, line(at(1.5, 0.4), at(2.6, -0.3)), mesh, rod());
    let (shoulder, elbow) = (start_of(&mut scene, upper), end_of(&mut scene, upper));
    let (wrist, tip) = (start_of(&mut scene, lower), end_of(&mut scene, lower));
    scene.join(JointKind::Hinge, shoulder, Partner::Ground).unwrap();
    scene.join(JointKind::Hinge, wrist, Partner::Station(elbow)).unwrap();
    let torque = LoadKind::Moment { station: shoulder, moment: 5.0 };
    scene.add_named_load("torque".to_owned(), torque, controller()).unwrap();
    drive(&mut scene, DriveKind::Motor, Component::Rotation, wrist);
    let force = LoadKind::Force { station: tip, force: at(0.5, 2.0), frame: LoadFrame::Follower };
    scene.add_load(force, controller());
    scene.gravity = at(0.0, -2.0);
    scene
}

/// A trolley, a rigid body at a controlled speed, with a beam on a hinge beside its centre that carries a rigid body at its end, off its centre too,
/// under a controlled moment.
pub fn trolley(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("steered trolley");
    let beam = add_beam(&mut scene, line(at(0.2, -0.1), at(0.5, -1.6)), mesh, rod());
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    let trolley = add_body(&mut scene, at(0.0, 0.0), 0.0, (2.0, 0.3), &[at(0.2, -0.1)]);
    let load = add_body(&mut scene, at(0.6, -1.9), 0.0, (0.6, 0.1), &[at(-0.1, 0.3)]);
    hinge(&mut scene, start, Some(point(trolley, 1)));
    scene.join(JointKind::Rigid, end, Partner::Station(point(load, 1))).unwrap();
    drive(&mut scene, DriveKind::Move, Component::X, point(trolley, 0));
    drive(&mut scene, DriveKind::Move, Component::Y, point(trolley, 0));
    let moment = LoadKind::Moment { station: point(load, 0), moment: 1.5 };
    scene.add_load(moment, controller());
    scene.gravity = at(0.0, -2.0);
    scene
}
