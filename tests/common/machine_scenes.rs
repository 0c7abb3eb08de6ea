//! Scenes with further machine elements: bushings, motors and moments.

use super::at;
use super::scenes::{add_beam, end_of, line, rod, spring, start_of};
use withy::beams::Mesh;
use withy::joints::Component;
use withy::loads::{LoadKind, PrescribedMotion, Schedule};
use withy::system::{
    Anchor, Drag, Dragged, Drive, DriveKind, Origin, Scene, SpeedLaw, Spring, SpringKind, SpringLaw,
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
    scene.add_spring(Spring { name, kind, law: None, origin, damping: 0.7.into() }).unwrap();
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
