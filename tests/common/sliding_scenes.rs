//! Scenes that cover all uses of a slider in a mechanism.

use std::f64::consts::PI;

use super::at;
use super::scenes::{add_beam, end_of, line};
use super::sliding::{
    Support, free_sliding_mass, hinge_start, paper_section, particle, slider, sliding_particle,
};
use withy::beams::{Mesh, Station};
use withy::geometry::{Curve, Vec2, perpendicular};
use withy::joints::{
    EndAction, JointKind, Partner, Slider, SlidingRule, StartVelocities, TrackEnd,
};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::system::{PointMass, Scene, StartMotion, StationVelocity};

/// Adds a named slider that bounces at the ends, with projected start velocities.
fn slide(scene: &mut Scene, slave: Station, master: usize, along: f64, rule: SlidingRule) {
    let arc_length = along * scene.beams[master].axis.length();
    let (ends, velocities) = (EndAction::Bounce, StartVelocities::Project);
    let name = scene.free_name("slider");
    let slider = Slider { name, ends, velocities, ..slider(slave, master, arc_length, rule) };
    scene.add_slider(slider).unwrap();
}

/// Adds a particle on a beam with a speed relative to the beam.
fn bead(
    scene: &mut Scene,
    master: usize,
    along: f64,
    mass: f64,
    speed: f64,
    rule: SlidingRule,
) -> Station {
    let axis = &scene.beams[master].axis;
    let xi = axis.parameter_at(along * axis.length()).unwrap();
    let (place, tangent) = (axis.point(xi).unwrap(), axis.derivative(xi, 1).unwrap().normalize());
    let StartMotion { velocity, spin, centre: about } = scene.beams[master].motion;
    let arm = about.map_or(Vec2::zeros(), |about| place - about);
    let station = particle(scene, place, mass);
    let velocity = velocity + perpendicular(arm) * spin + tangent * speed;
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    slide(scene, station, master, along, rule);
    station
}

/// Three beads of different mass that pass each other on a free rotating beam.
pub fn abacus(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("abacus");
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    scene.beams[rail].motion =
        StartMotion { velocity: at(0.2, -0.3), spin: 0.7, centre: Some(at(1.5, 0.5)) };
    for (along, mass, speed) in [(0.2, 0.1, 2.0), (0.55, 0.04, -1.0), (0.8, 0.3, -1.5)] {
        bead(&mut scene, rail, along, mass, speed, rule);
    }
    scene
}

/// The same scene with beads of restitution below 1, two of which reach the end at the same time.
pub fn losing_abacus(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("abacus that loses");
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    for (along, mass, speed) in [(0.05, 0.1, -2.0), (0.95, 0.1, 2.0), (0.9, 0.3, 0.5)] {
        bead(&mut scene, rail, along, mass, speed, rule);
    }
    let coefficients = [0.6, 0.6, 0.0];
    scene.sliders.iter_mut().zip(coefficients).for_each(|(slider, e)| slider.restitution = e);
    scene
}

/// Beam that slides on a hinged beam, with a bead on the sliding beam, under gravity.
pub fn sliding_beam_with_bead(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("bead on a sliding beam");
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    let foot = at(3.0, 1.0) * 0.6;
    let arm = line(foot, foot + at(0.6, -1.2));
    let arm = add_beam(&mut scene, arm, mesh, paper_section(300.0));
    hinge_start(&mut scene, rail);
    let slave = scene.station(arm, 0.0).unwrap();
    slide(&mut scene, slave, rail, 0.6, rule);
    bead(&mut scene, arm, 0.5, 0.2, 1.0, rule);
    scene.gravity = at(0.0, -9.81);
    scene
}

/// Beam that slides on a hinged beam, with a mass, a force and a moment at its sliding end.
pub fn loaded_slave(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("loaded slave");
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    let foot = at(3.0, 1.0) * 0.7;
    let arm = add_beam(&mut scene, line(foot, foot + at(1.0, 0.4)), mesh, paper_section(300.0));
    hinge_start(&mut scene, rail);
    let station = scene.station(arm, 0.0).unwrap();
    scene.add_mass(PointMass { station, mass: 0.3, rotary_inertia: 0.02 }).unwrap();
    let pulse = Schedule::smooth_pulse(0.3).unwrap();
    let force = LoadKind::Force { station, force: at(-4.0, -3.0), frame: LoadFrame::Dead };
    scene.add_load(force, pulse.clone());
    scene.add_load(LoadKind::Moment { station, moment: 0.5 }, pulse);
    let tip = end_of(&mut scene, arm);
    scene.add_mass(PointMass { station: tip, mass: 0.2, rotary_inertia: 0.0 }).unwrap();
    slide(&mut scene, station, rail, 0.7, rule);
    scene
}

/// Bead on a semicircle that is hinged at one end and falls.
pub fn bead_on_an_arc(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("bead on an arc");
    let axis = Curve::arc(at(1.0, 0.0), 1.0, PI, 2.0 * PI).unwrap();
    let arc = add_beam(&mut scene, axis, mesh, paper_section(300.0));
    hinge_start(&mut scene, arc);
    bead(&mut scene, arc, 0.25, 0.3, 0.5, rule);
    scene.gravity = at(0.0, -9.81);
    scene
}

/// Free rotating beam that slides through an eyelet fixed to the ground.
pub fn eyelet(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("eyelet");
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    let place = at(3.0, 1.0) * 0.3;
    let along = at(3.0, 1.0).normalize();
    scene.beams[rail].motion = StartMotion { velocity: along, spin: 0.9, centre: Some(place) };
    let eye = particle(&mut scene, place, 1.0);
    scene.join(JointKind::Hinge, eye, Partner::Ground).unwrap();
    slide(&mut scene, eye, rail, 0.3, rule);
    scene
}

/// Pin through two crossing beams, one hinged and one free.
pub fn pinned_cross(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("pinned cross");
    let cross = at(1.2, 0.4);
    let one = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), mesh, paper_section(300.0));
    let other = at(-0.5, 1.5);
    let other = line(cross - other * 0.4, cross + other * 0.6);
    let two = add_beam(&mut scene, other, mesh, paper_section(300.0));
    hinge_start(&mut scene, one);
    scene.beams[two].motion =
        StartMotion { velocity: at(1.0, 0.3), spin: -0.5, centre: Some(cross) };
    let pin = particle(&mut scene, cross, 0.05);
    slide(&mut scene, pin, one, 0.4, rule);
    slide(&mut scene, pin, two, 0.4, rule);
    scene
}

/// Eight sliders of all kinds, more than the border of the matrix admits: beads, a pin through two beams, an eyelet, and an arm.
pub fn crowd(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("crowd");
    let end = at(3.0, 1.0);
    let rail = add_beam(&mut scene, line(at(0.0, 0.0), end), mesh, paper_section(300.0));
    scene.beams[rail].motion =
        StartMotion { velocity: at(0.2, -0.3), spin: 0.7, centre: Some(end * 0.5) };
    for (along, mass, speed) in
        [(0.1, 0.1, 1.0), (0.25, 0.04, -0.5), (0.4, 0.2, 0.7), (0.85, 0.3, -0.6)]
    {
        bead(&mut scene, rail, along, mass, speed, rule);
    }
    let (cross, other) = (end * 0.6, at(-0.5, 1.5));
    let other = line(cross - other * 0.4, cross + other * 0.6);
    let other = add_beam(&mut scene, other, mesh, paper_section(300.0));
    let pin = particle(&mut scene, cross, 0.05);
    slide(&mut scene, pin, rail, 0.6, rule);
    slide(&mut scene, pin, other, 0.4, rule);
    let axis = &scene.beams[other].axis;
    let eye = axis.point(axis.parameter_at(0.8 * axis.length()).unwrap()).unwrap();
    let eye = particle(&mut scene, eye, 1.0);
    scene.join(JointKind::Hinge, eye, Partner::Ground).unwrap();
    slide(&mut scene, eye, other, 0.8, rule);
    let foot = end * 0.7;
    let arm = add_beam(&mut scene, line(foot, foot + at(0.6, -0.9)), mesh, paper_section(300.0));
    let foot = scene.station(arm, 0.0).unwrap();
    slide(&mut scene, foot, rail, 0.7, rule);
    scene
}

/// Two beads on a closed track of three beams that translates and rotates. One corner is rigid, one is hinged, and one beam has the opposite direction. Rules
/// that support a single beam only are replaced by the conserving rule.
pub fn triangle(mesh: &Mesh, rule: SlidingRule) -> Scene {
    let rule = match rule {
        SlidingRule::Kinked | SlidingRule::Relaxed => SlidingRule::Conserving,
        rule => rule,
    };
    let mut scene = Scene::new("triangle");
    let corners = [at(0.0, 0.0), at(2.0, 0.3), at(0.8, 1.5)];
    let motion = StartMotion { velocity: at(0.2, -0.1), spin: 0.4, centre: Some(corners[0]) };
    for [from, to] in [[0, 1], [2, 1], [2, 0]] {
        let axis = line(corners[from], corners[to]);
        let beam = add_beam(&mut scene, axis, mesh, paper_section(300.0));
        scene.beams[beam].motion = motion;
    }
    let ends = [0, 1, 2].map(|beam| end_of(&mut scene, beam));
    let starts = [0, 1, 2].map(|beam| scene.station(beam, 0.0).unwrap());
    for (kind, one, other) in [
        (JointKind::Rigid, ends[0], ends[1]),
        (JointKind::Hinge, starts[1], starts[2]),
        (JointKind::Rigid, ends[2], starts[0]),
    ] {
        scene.join(kind, one, Partner::Station(other)).unwrap();
    }
    let track = scene.add_track("track".to_owned(), &[0, 1, 2], TrackEnd::Closed).unwrap();
    for (master, along, mass, speed) in [(0, 0.8, 0.2, 2.5), (1, 0.4, 0.1, -1.0)] {
        bead(&mut scene, master, along, mass, speed, rule);
        scene.sliders.last_mut().unwrap().track = Some(track);
    }
    scene
}

/// Rope through the given number of eyelets fixed to the ground, under gravity.
pub fn eyelets(spans: usize, eyelets: usize) -> Scene {
    let mut scene = Scene::new("eyelets");
    let mesh = Mesh::bspline(spans, 3, 2).unwrap();
    let rope = line(at(0.0, 0.0), at(3.0, 0.0));
    let rope = add_beam(&mut scene, rope, &mesh, paper_section(300.0));
    scene.beams[rope].motion = StartMotion { velocity: at(1.0, 0.0), spin: 0.0, centre: None };
    scene.gravity = at(0.0, -9.81);
    for eyelet in 0..eyelets {
        let along = 0.8 * (eyelet as f64 + 0.5) / eyelets as f64;
        let eye = particle(&mut scene, at(3.0 * along, 0.0), 1.0);
        scene.join(JointKind::Hinge, eye, Partner::Ground).unwrap();
        slide(&mut scene, eye, rope, along, SlidingRule::Kinked);
    }
    scene
}

/// Zigzag chain under gravity. Each link hangs in a ring that slides on the previous link and on itself.
pub fn chain(links: usize) -> Scene {
    let mut scene = Scene::new("chain");
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    for link in 0..links {
        let up = if link % 2 == 0 { 0.5 } else { -0.5 };
        let from = at(0.8 * link as f64, if up > 0.0 { 0.0 } else { 0.5 });
        add_beam(&mut scene, line(from, from + at(1.0, up)), &mesh, paper_section(300.0));
    }
    hinge_start(&mut scene, 0);
    for link in 1..links {
        let start = scene.beams[link].axis.point(0.1).unwrap();
        let ring = particle(&mut scene, start, 0.05);
        slide(&mut scene, ring, link - 1, 0.9, SlidingRule::Kinked);
        slide(&mut scene, ring, link, 0.1, SlidingRule::Kinked);
    }
    scene.gravity = at(0.0, -9.81);
    scene
}

/// Free rotating beam with the given number of beads, which pass each other.
pub fn necklace(spans: usize, beads: usize) -> Scene {
    let mut scene = Scene::new("necklace");
    let mesh = Mesh::bspline(spans, 3, 2).unwrap();
    let rail = line(at(0.0, 0.0), at(3.0, 1.0));
    let rail = add_beam(&mut scene, rail, &mesh, paper_section(300.0));
    scene.beams[rail].motion = StartMotion { velocity: at(0.2, -0.3), spin: 0.7, centre: None };
    for number in 0..beads {
        let along = 0.1 + 0.8 * (number as f64 + 0.5) / beads as f64;
        let speed = (7.0 * number as f64).sin();
        bead(&mut scene, rail, along, 0.3 / beads as f64, speed, SlidingRule::Kinked);
    }
    scene
}

/// All scenes, with one rule for all sliders.
pub fn all(mesh: &Mesh, rule: SlidingRule) -> Vec<Scene> {
    let mut scenes = vec![
        free_sliding_mass([mesh, mesh], 300.0, Support::Free, rule),
        free_sliding_mass([mesh, mesh], 300.0, Support::Hinged, rule),
        sliding_particle(mesh, 1.0, rule),
        abacus(mesh, rule),
        sliding_beam_with_bead(mesh, rule),
        loaded_slave(mesh, rule),
        bead_on_an_arc(mesh, rule),
        eyelet(mesh, rule),
        pinned_cross(mesh, rule),
        crowd(mesh, rule),
        triangle(mesh, rule),
    ];
    for slider in scenes.iter_mut().flat_map(|scene| &mut scene.sliders) {
        slider.ends = EndAction::Bounce;
    }
    scenes[0].name = "free sliding mass, A free".to_owned();
    scenes[1].name = "free sliding mass, A hinged".to_owned();
    scenes
}
