//! Scenes with further machine elements: bushings, motors, moments and actuators.

use super::at;
use super::body_scenes::hinge;
use super::scenes::{add_beam, end_of, line, rod, spring, start_of};
use withy::beams::Mesh;
use withy::joints::Component;
use withy::loads::{LoadKind, PrescribedMotion, Schedule};
use withy::system::{
    Anchor, Drag, Dragged, Drive, DriveKind, Origin, PrescribedRest, Scene, SpeedLaw, Spring,
    SpringKind, SpringLaw,
};

/// Two beams in bushings, which are springs of zero length with dampers. The first beam is supported by a bushing at the ground, the second one by a bushing
/// at the end of the first and by a damper at the ground. A motor prescribes the angle at the end of the first beam, another one the speed at the end of the second.
/// A named moment acts inside the first beam, and wind acts on its end.
pub fn bushed(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("bushed");
    let one = add_beam(&mut scene, line(at(0.2, 0.1), at(2.0, 0.9)), mesh, rod());
    let other = add_beam(&mut scene, line(at(2.1, 1.1), at(3.6, 0.4)), mesh, rod());
    let (foot, top) = (start_of(&mut scene, one), end_of(&mut scene, one));
    let (next, tip) = (start_of(&mut scene, other), end_of(&mut scene, other));
    let bushing = |from: Anchor, to: Anchor| SpringKind::Length(vec![from, to]);
    let law = |stiffness: f64| SpringLaw::Linear { stiffness, natural: 0.0 };
    let ground = Anchor::Ground(at(0.3, -0.2));
    spring(&mut scene, bushing(ground, Anchor::Station(foot)), law(50.0), 0.8);
    spring(&mut scene, bushing(Anchor::Station(top), Anchor::Station(next)), law(30.0), 1.2);
    let kind = bushing(Anchor::Ground(at(4.0, 1.0)), Anchor::Station(tip));
    let (name, origin) = (scene.free_name("damper"), Origin::Zero);
    scene
        .add_spring(Spring { name, kind, law: None, origin, damping: 0.7.into(), rest: None })
        .unwrap();
    let sine = |rate: f64| Schedule::Sine { amplitude: 0.4, rate, phase: 0.0 };
    let motions =
        [(top, PrescribedMotion::Position(sine(1.3))), (tip, PrescribedMotion::Rate(sine(0.7)))];
    for (station, motion) in motions {
        let mut motions = [None, None, None];
        motions[Component::Rotation as usize] = Some(motion);
        let (name, kind) = (scene.free_name("motor"), DriveKind::Motor);
        scene.add_drive(Drive { name, kind, station, motions }).unwrap();
    }
    let station = scene.station(other, 0.8).unwrap();
    let torque = LoadKind::Moment { station, moment: 2.0 };
    scene.add_named_load("torque".to_owned(), torque, Schedule::hold_for(1.3).unwrap()).unwrap();
    let law = SpeedLaw { linear: 0.3, quadratic: 0.1 };
    let (name, on) = (scene.free_name("drag"), Dragged::Point { station: tip, law });
    scene.add_drag(Drag { name, on, wind: at(2.0, -1.0) }).unwrap();
    scene.gravity = at(0.0, -2.0);
    scene
}

/// Two hinged beams with actuators: a cylinder with a damper, a rope over three points that is wound up, and a servo with a prescribed rate of its rest angle.
pub fn actuated(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("actuated");
    let boom = add_beam(&mut scene, line(at(0.0, 0.0), at(2.0, 0.6)), mesh, rod());
    let jib = add_beam(&mut scene, line(at(2.0, 0.6), at(3.4, 0.2)), mesh, rod());
    let (foot, top) = (start_of(&mut scene, boom), end_of(&mut scene, boom));
    let (knee, tip) = (start_of(&mut scene, jib), end_of(&mut scene, jib));
    hinge(&mut scene, foot, None);
    hinge(&mut scene, top, Some(knee));
    let middle = scene.station(boom, 0.5).unwrap();
    let sine = |amplitude: f64| Schedule::Sine { amplitude, rate: 1.7, phase: 0.4 };
    let cylinder = SpringKind::Length(vec![Anchor::Ground(at(0.9, -0.8)), Anchor::Station(middle)]);
    let rope = vec![Anchor::Ground(at(-0.5, 1.5)), Anchor::Station(top), Anchor::Station(tip)];
    let length = Schedule::table(vec![(0.0, 1.1), (0.35, 1.0), (1.0, 1.2)]).unwrap();
    let actuators = [
        (cylinder, Some(1.1), PrescribedMotion::Position(length), 40.0),
        (SpringKind::Length(rope), None, PrescribedMotion::Rate(sine(-0.3)), 20.0),
        (
            SpringKind::Torsion([Anchor::Station(top), Anchor::Station(knee)]),
            None,
            PrescribedMotion::Rate(sine(0.8)),
            3.0,
        ),
    ];
    for (kind, start, motion, stiffness) in actuators {
        let (name, origin) = (scene.free_name("actuator"), Origin::Zero);
        let law = Some(SpringLaw::Linear { stiffness, natural: 0.0 });
        let rest = Some(PrescribedRest { start, motion });
        scene.add_spring(Spring { name, kind, law, origin, damping: 0.3.into(), rest }).unwrap();
    }
    scene.gravity = at(0.0, -2.0);
    scene
}
