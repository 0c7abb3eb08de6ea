//! Scenes with inclined rollers.

use super::at;
use super::body_scenes::{add_body, point};
use super::release_scenes::release;
use super::scenes::{add_beam, end_of, line, rod, spring, start_of};
use withy::beams::{Mesh, Station};
use withy::geometry::Vec2;
use withy::joints::{JointKind, Partner, Releasable};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::system::{Anchor, ParticleDefinition, Scene, SpringKind, SpringLaw, StationVelocity};

pub fn unit(angle: f64) -> Vec2 {
    at(angle.cos(), angle.sin())
}

pub fn roller(scene: &mut Scene, station: Station, angle: f64) {
    scene.join(JointKind::InclinedRoller(unit(angle)), station, Partner::Ground).unwrap();
}

/// Rigid body on an inclined roller at a point off its centre, a beam between another point of the body and an inclined guide, and a bead on an inclined guide
/// that is connected to the beam by a spring. A follower force acts on the body, and its roller is released.
pub fn on_rollers(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("on inclined rollers");
    let points = [at(-0.5, -0.2), at(0.6, 0.1)];
    let body = add_body(&mut scene, at(0.0, 0.0), 0.3, (1.0, 0.2), &points);
    let from = scene.drawn_at(&point(body, 2)).unwrap();
    let beam = add_beam(&mut scene, line(from, from + at(2.0, 0.8)), mesh, rod());
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Hinge, start, Partner::Station(point(body, 2))).unwrap();
    roller(&mut scene, point(body, 1), 0.4);
    scene.join(JointKind::InclinedGuide(unit(2.0)), end, Partner::Ground).unwrap();
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(3.0, 2.5) };
    let bead = scene.add_particle(bead, 0.7).unwrap();
    roller(&mut scene, bead, -0.9);
    scene.velocities.push(StationVelocity {
        station: bead,
        velocity: unit(-0.9) * 0.6,
        spin: None,
    });
    let middle = scene.station(beam, 1.2).unwrap();
    let way = SpringKind::Length(vec![Anchor::Station(middle), Anchor::Station(bead)]);
    spring(&mut scene, way, SpringLaw::Linear { stiffness: 20.0, natural: 1.5 }, 0.4);
    let force = LoadKind::Force {
        station: point(body, 2),
        force: at(2.0, 1.0),
        frame: LoadFrame::Follower,
    };
    scene.add_load(force, Schedule::hold_for(1.3).unwrap());
    scene.gravity = at(0.0, -3.0);
    release(&mut scene, Releasable::Joint(1), 3.03);
    scene
}
