//! Scenes in which beams slide through sleeves without length.

use super::at;
use super::body_scenes::add_body;
use super::scenes::{add_beam, end_of, line, spaghetti_section};
use super::sliding::moving_particle;
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::joints::{EndAction, Restraint, Slider, StartVelocities};
use withy::system::{Scene, StartMotion};

fn soft() -> Section {
    Section { bending_stiffness: 5.0, rotary_inertia: 0.05, ..spaghetti_section(5e2, 5.0) }
}

/// Adds a sleeve that releases its beam at the ends, with projected start velocities.
pub fn sleeve(scene: &mut Scene, holder: Station, beam: usize, along: f64) {
    let slider = Slider::new(scene.free_name("sleeve"), holder, beam, along);
    let (restraint, ends) = (Restraint::PlaceAndDirection, EndAction::Release);
    let velocities = StartVelocities::Project;
    scene.add_slider(Slider { restraint, ends, velocities, ..slider }).unwrap();
}

pub fn moving(scene: &mut Scene, beam: usize, velocity: Vec2, spin: f64) {
    scene.beams[beam].motion = StartMotion { velocity, spin, centre: None };
}

/// Flying beam that slides through a sleeve at the end of another flying beam.
pub fn on_a_beam(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("sleeve on a beam");
    let holder = add_beam(&mut scene, line(at(0.3, -1.0), at(0.0, 0.0)), mesh, soft());
    let rod = add_beam(&mut scene, line(at(-1.2, 0.2), at(1.2, -0.2)), mesh, soft());
    moving(&mut scene, holder, at(-0.5, 0.1), 1.0);
    moving(&mut scene, rod, at(1.5, 0.4), -1.0);
    let (mouth, along) = (end_of(&mut scene, holder), 0.5 * scene.beams[rod].axis.length());
    sleeve(&mut scene, mouth, rod, along);
    scene
}

/// Flying bent beam that slides through a sleeve at a point of a flying rigid body.
pub fn on_a_body(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("sleeve on a body");
    let arc = Curve::arc(at(0.0, -2.0), 2.0, 2.2, 0.9).unwrap();
    let rod = add_beam(&mut scene, arc, mesh, soft());
    let body = add_body(&mut scene, at(0.2, -0.4), 0.0, (0.5, 0.1), &[at(-0.2, 0.4)]);
    moving(&mut scene, rod, at(1.0, 0.3), 0.6);
    let along = scene.nearest_arc_length(rod, &Station::on_rigid_body(body, 1)).unwrap();
    sleeve(&mut scene, Station::on_rigid_body(body, 1), rod, along);
    scene
}

/// Heavy beam that slides through a sleeve on the ground.
pub fn on_the_ground(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("sleeve on the ground");
    let rod = add_beam(&mut scene, line(at(-0.7, 0.4), at(1.0, -0.5)), mesh, soft());
    moving(&mut scene, rod, at(0.3, -0.2), 0.5);
    scene.gravity = at(0.0, -9.81);
    let along = 0.45 * scene.beams[rod].axis.length();
    let place = scene.drawn_at(&Station::on_beam(rod, along)).unwrap();
    let holder = scene.add_holder("sleeve", place).unwrap();
    sleeve(&mut scene, holder, rod, along);
    scene
}

/// Two flying beams with sleeves at their ends on a third beam.
pub fn two_on_a_beam(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("two sleeves on a beam");
    let rod = add_beam(&mut scene, line(at(-1.5, 0.0), at(1.5, 0.0)), mesh, soft());
    moving(&mut scene, rod, at(0.0, 0.5), 0.4);
    for (side, speed) in [(-1.0, 0.6), (1.0, -0.9)] {
        let axis = line(at(0.7 * side, -1.0), at(0.5 * side, 0.0));
        let holder = add_beam(&mut scene, axis, mesh, soft());
        moving(&mut scene, holder, at(speed, 0.0), -side);
        let mouth = end_of(&mut scene, holder);
        sleeve(&mut scene, mouth, rod, 1.5 + 0.5 * side);
    }
    scene
}

/// Beam through a sleeve on another beam, on which a bead slides and bounces.
pub fn with_a_bead(mesh: &Mesh) -> Scene {
    let mut scene = Scene { name: "sleeve and bead".to_owned(), ..on_a_beam(mesh) };
    let bead = moving_particle(&mut scene, at(0.06, -0.2), at(-0.9, 3.0), 0.3);
    let along = 0.8 * scene.beams[0].axis.length();
    let (ends, velocities) = (EndAction::Bounce, StartVelocities::Project);
    let slider = Slider::new("bead", bead, 0, along);
    scene.add_slider(Slider { ends, velocities, ..slider }).unwrap();
    scene
}

/// Flying beam that slides through sleeves on five free bodies.
pub fn on_five_bodies(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("sleeves on five bodies");
    let rod = add_beam(&mut scene, line(at(-1.5, 0.0), at(1.5, 0.0)), mesh, soft());
    moving(&mut scene, rod, at(0.2, 0.3), 0.5);
    for number in -2..=2 {
        let x = 0.07 + 0.5 * f64::from(number);
        let body = add_body(&mut scene, at(x, 0.0), 0.0, (0.2, 0.02), &[]);
        scene.rigid_bodies[body].motion.velocity = at(-0.4 * x, 0.2);
        sleeve(&mut scene, Station::on_rigid_body(body, 0), rod, 1.5 + x);
    }
    scene
}

pub fn all(mesh: &Mesh) -> Vec<Scene> {
    let of_beams = [on_a_beam(mesh), two_on_a_beam(mesh), with_a_bead(mesh)];
    let of_bodies = [on_a_body(mesh), on_the_ground(mesh), on_five_bodies(mesh)];
    of_beams.into_iter().chain(of_bodies).collect()
}
