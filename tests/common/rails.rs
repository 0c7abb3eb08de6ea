//! Beads that reach the ends of straight beams.

use super::at;
use super::scenes::{add_beam, end_of, line};
use super::sliding::{paper_section, particle, slider};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule};
use withy::system::{Scene, StationVelocity};

/// Nearly rigid straight beam of length 1 from the origin in a direction.
pub fn rail(mesh: &Mesh, direction: Vec2) -> Scene {
    let mut scene = Scene::new("rail");
    add_beam(&mut scene, line(Vec2::zeros(), direction.normalize()), mesh, stiff());
    scene
}

pub fn stiff() -> Section {
    Section { mass_per_length: 1.0, rotary_inertia: 0.01, ..paper_section(1e4) }
}

/// The same rail with both ends clamped, which transmit axial impulses to the ground.
pub fn clamped_rail(mesh: &Mesh, direction: Vec2) -> Scene {
    let mut scene = rail(mesh, direction);
    let ends = [scene.station(0, 0.0).unwrap(), end_of(&mut scene, 0)];
    for end in ends {
        scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
    }
    scene
}

/// Adds a bead to the rail. Returns the index of its slider.
pub fn bead(scene: &mut Scene, along: f64, mass: f64, velocity: Vec2, ends: EndAction) -> usize {
    let axis = &scene.beams[0].axis;
    let (length, place) = (axis.length(), axis.point(along).unwrap());
    let station = particle(scene, place, mass);
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    let name = scene.free_name("slider");
    let slider = slider(station, 0, along * length, SlidingRule::Conserving);
    scene.add_slider(Slider { name, ends, ..slider }).unwrap()
}

/// Bead that bounces between both ends of a free beam that translates and rotates.
pub fn bouncing_bead(mesh: &Mesh, mass: f64) -> Scene {
    let mut scene = rail(mesh, at(3.0, 1.0));
    let motion = &mut scene.beams[0].motion;
    (motion.velocity, motion.spin, motion.centre) = (at(0.1, -0.2), 0.3, Some(Vec2::zeros()));
    let place = at(3.0, 1.0).normalize() * 0.4;
    let velocity = at(0.1, -0.2) + Vec2::new(-place.y, place.x) * 0.3 + place.normalize();
    bead(&mut scene, 0.4, mass, velocity, EndAction::Bounce);
    scene
}
