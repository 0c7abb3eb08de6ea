//! Scenes with sliders.

use super::at;
use super::scenes::{add_beam, end_of, line};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Vec2, perpendicular};
use withy::joints::{
    EndAction, JointKind, Partner, Restraint, Slider, SlidingRule, StartVelocities,
};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::system::{ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity};

/// Support of point A of the free sliding mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    Free,
    Hinged,
}

/// Section of the free sliding mass (paper, section 4.2) with the given axial stiffness.
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
        track: None,
        arc_length,
        rule,
        ends: EndAction::Stop,
        restitution: 1.0,
        friction: 0.0,
        static_friction: None,
        restraint: Restraint::Place,
        velocities: StartVelocities::Check,
    }
}

/// Nearly rigid section.
pub const STIFF: Section = Section {
    axial_stiffness: 1e10,
    shear_stiffness: 1e10,
    bending_stiffness: 1e10,
    mass_per_length: 1.0,
    rotary_inertia: 1e-2,
};

pub fn moving_particle(scene: &mut Scene, position: Vec2, velocity: Vec2, mass: f64) -> Station {
    let station = particle(scene, position, mass);
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    station
}

pub fn hinge_start(scene: &mut Scene, beam: usize) {
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
}

pub fn particle(scene: &mut Scene, position: Vec2, mass: f64) -> Station {
    let name = scene.free_name("particle");
    scene.add_particle(ParticleDefinition { name, position }, mass).unwrap()
}

/// Free sliding mass of the paper: CM slides with C on AB. Only the node of the mass at M has a start velocity, (-10, -10).
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

/// The same beams at rest.
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

/// The same beams at rest with a smooth force pulse on M of the impulse (-10, -10) (references `P8s`).
pub fn smoothly_pushed_mass(meshes: [&Mesh; 2], support: Support, rule: SlidingRule) -> Scene {
    let mut scene = two_beams(meshes, 1e2, support, rule);
    let station = end_of(&mut scene, 1);
    let duration = 0.1;
    let force =
        LoadKind::Force { station, force: at(-10.0, -10.0) / duration, frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::smooth_pulse(duration).unwrap());
    scene
}

/// Particle that slides on the hinged beam AB of the paper, from 19/20 of its length inwards at the speed 5, while both rotate about A (references `P7`).
pub fn sliding_particle(mesh: &Mesh, spin: f64, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("sliding particle");
    let b = at(3.0, 1.0);
    let ab = add_beam(&mut scene, line(Vec2::zeros(), b), mesh, paper_section(1e2));
    scene.beams[ab].motion =
        StartMotion { velocity: Vec2::zeros(), spin, centre: Some(Vec2::zeros()) };
    hinge_start(&mut scene, ab);
    let c = b * 0.95;
    let station = particle(&mut scene, c, 1.0);
    let velocity = perpendicular(c) * spin - b.normalize() * 5.0;
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    let start = 0.95 * scene.beams[ab].axis.length();
    scene.add_slider(slider(station, ab, start, rule)).unwrap();
    scene
}

/// The same scene without initial rotation. A smooth moment at A bends the beam (reference `P7d`).
pub fn kicked_sliding_particle(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = sliding_particle(mesh, 0.0, rule);
    let (station, duration) = (scene.station(0, 0.0).unwrap(), 0.2);
    let moment = LoadKind::Moment { station, moment: 0.4 / duration };
    scene.add_load(moment, Schedule::smooth_pulse(duration).unwrap());
    scene
}

/// Meshes of beam AB (2 spans) and CM (4 spans): the paper's C¹ splines and Lagrange elements, and C² splines.
pub fn paper_meshes() -> Vec<(&'static str, [Mesh; 2])> {
    let bspline = |continuity| [2, 4].map(|spans| Mesh::bspline(spans, 3, continuity).unwrap());
    let lagrange = [2, 4].map(|elements| Mesh::lagrange(elements, 3).unwrap());
    vec![("cubic C1", bspline(1)), ("cubic C2", bspline(2)), ("cubic Lagrange", lagrange)]
}

/// The time step of the paper.
pub const PAPER_STEP: f64 = 0.01067;

/// Cubic C² splines with the given number of spans.
pub fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

/// Scene of a reference with the given number of spans in every beam.
pub fn reference_scene(reference: &str, spans: usize, rule: SlidingRule) -> Scene {
    let mesh = smooth(spans);
    match reference {
        "P7b" => sliding_particle(&mesh, 0.3, rule),
        "P7c" => sliding_particle(&mesh, 1.0, rule),
        "P7d" => kicked_sliding_particle(&mesh, rule),
        "P8s_free" => smoothly_pushed_mass([&mesh, &mesh], Support::Free, rule),
        "P8s_hinged" => smoothly_pushed_mass([&mesh, &mesh], Support::Hinged, rule),
        other => panic!("there is no reference {other}"),
    }
}
