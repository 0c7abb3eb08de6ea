//! Scenes with sliders.

use super::at;
use super::scenes::{add_beam, end_of, line};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule, StartVelocities};
use withy::model::{ParticleDefinition, PointMass, Scene, StationVelocity};

/// How point A of the free sliding mass is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    Free,
    Hinged,
}

/// The section of the free sliding mass (paper, section 4.2), with another axial stiffness.
pub fn paper_section(axial: f64) -> Section {
    Section {
        axial_stiffness: axial,
        shear_stiffness: axial / 2.6,
        bending_stiffness: 20.0,
        mass_per_length: 0.08,
        rotary_inertia: 0.016,
    }
}

pub fn slider(slave: Station, master: usize, arc_length: f64, rule: SlidingRule) -> Slider {
    Slider {
        name: "slider1".to_owned(),
        slave,
        master,
        arc_length,
        rule,
        ends: EndAction::Stop,
        velocities: StartVelocities::Check,
    }
}

pub fn hinge_start(scene: &mut Scene, beam: usize) {
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
}

pub fn particle(scene: &mut Scene, position: Vec2, mass: f64) -> Station {
    let name = scene.free_name("particle");
    scene.add_particle(ParticleDefinition { name, position }, mass).unwrap()
}

/// The free sliding mass of the paper: CM slides with C on AB, a mass at M starts with (-10, -10), that node alone.
pub fn free_sliding_mass(
    meshes: [&Mesh; 2],
    axial: f64,
    support: Support,
    rule: SlidingRule,
) -> Scene {
    let mut scene = two_beams(meshes, axial, support, rule);
    let station = end_of(&mut scene, 1);
    scene.velocities.push(StationVelocity { station, velocity: at(-10.0, -10.0), spin: None });
    scene
}

/// The same at rest.
pub fn two_beams(meshes: [&Mesh; 2], axial: f64, support: Support, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("free sliding mass");
    let (b, c) = (at(3.0, 1.0), at(3.0, 1.0) * 0.95);
    let ab = add_beam(&mut scene, line(Vec2::zeros(), b), meshes[0], paper_section(axial));
    let cm = add_beam(&mut scene, line(c, c + at(1.0, 0.0)), meshes[1], paper_section(axial));
    let station = end_of(&mut scene, cm);
    scene.add_mass(PointMass { station, mass: 1.0, rotary_inertia: 0.0 }).unwrap();
    if support == Support::Hinged {
        hinge_start(&mut scene, ab);
    }
    let slave = scene.station(cm, 0.0).unwrap();
    let start = 0.95 * scene.beams[ab].axis.length();
    scene.add_slider(slider(slave, ab, start, rule)).unwrap();
    scene
}
