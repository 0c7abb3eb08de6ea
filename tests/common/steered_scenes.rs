//! Scenes with controllers: functions of time and state that are evaluated at the start of every step and kept constant during it.

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

/// Initial value of a controller.
const START: f64 = 0.4;

fn controller() -> Schedule {
    Schedule::Sampled(Rc::new(Cell::new(START)))
}

/// Sets the values of all controllers for the next step, as a function of the time and of the end position of the first body.
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

/// Resets all controllers of a scene, which its copies share, to their initial values.
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

/// Hinged arm under a controlled torque, with a forearm driven by a controlled motor and a controlled follower force at its end.
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

/// Trolley: a rigid body with a controlled speed. A beam hinged to it off its centre carries another rigid body and is loaded by a controlled moment.
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
