//! Time of a step with many sliders, in milliseconds, compared with the same scene without sliders: beads on a flying beam, a rope
//! through eyelets, and a chain whose links are connected by rings that slide on them.
//!
//! `cargo bench --bench sliders` prints the tables of docs/studies.md.
#![allow(clippy::unwrap_used)]

use std::time::{Duration, Instant};

use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::{Interval, Mechanism, Method};
use withy::joints::{
    EndAction, JointKind, Partner, Restraint, Slider, SlidingRule, StartVelocities,
};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::newton::Tolerance;
use withy::system::{BeamDefinition, ParticleDefinition, Scene, StartMotion, System};

/// Approximate duration of each measurement.
const TIME_LIMIT: Duration = Duration::from_millis(600);
const FEWEST_REPEATS: usize = 5;
/// Number of steps of a run. Runs are repeated from the start, so that no slider reaches an end of its beam.
const RUN: usize = 12;

fn add_beam(scene: &mut Scene, from: Vec2, to: Vec2, spans: usize, section: Section) -> usize {
    let beam = BeamDefinition {
        name: format!("beam{}", scene.beams.len()),
        axis: Curve::line(from, to).unwrap(),
        mesh: Mesh::bspline(spans, 3, 2).unwrap(),
        section: section.into(),
        motion: StartMotion::default(),
    };
    scene.add_beam(beam).unwrap()
}

/// Adds a particle that slides on a beam.
fn add_bead(scene: &mut Scene, master: usize, arc_length: f64, mass: f64) -> Station {
    let position = scene.drawn_at(&Station::on_beam(master, arc_length)).unwrap();
    let name = format!("bead{}", scene.particles.len());
    let bead = scene.add_particle(ParticleDefinition { name, position }, mass).unwrap();
    slide(scene, bead, master, arc_length);
    bead
}

fn slide(scene: &mut Scene, slave: Station, master: usize, arc_length: f64) {
    let slider = Slider {
        name: format!("slider{}", scene.sliders.len()),
        slave,
        master,
        track: None,
        arc_length,
        rule: SlidingRule::Kinked,
        ends: EndAction::Bounce,
        restitution: 1.0,
        friction: 0.0,
        static_friction: None,
        restraint: Restraint::Place,
        velocities: StartVelocities::Check,
    };
    scene.add_slider(slider).unwrap();
}

/// Scene of a free beam with beads. A force and a moment act at its end. Each bead has a tenth of the mass of a span.
fn beads(spans: usize, beads: usize) -> Scene {
    let mut scene = Scene::new("beads");
    let length = 10.0 / 14.0 * spans as f64;
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    let rod = add_beam(&mut scene, Vec2::zeros(), Vec2::new(0.6, -0.8) * length, spans, section);
    let station = scene.station(rod, length).unwrap();
    let push = Schedule::hold_for(2.5).unwrap();
    let force = LoadKind::Force { station, force: Vec2::new(8.0, 0.0), frame: LoadFrame::Dead };
    scene.add_load(force, push.clone());
    scene.add_load(LoadKind::Moment { station, moment: -80.0 }, push);
    for bead in 0..beads {
        // The beads are placed away from the ends.
        let along = 0.1 + 0.8 * (bead as f64 + 0.5) / beads as f64;
        add_bead(&mut scene, rod, length * along, 0.07);
    }
    scene
}

/// Scene of a rope that is drawn through eyelets fixed to the ground.
fn eyelets(spans: usize, eyelets: usize) -> Scene {
    let mut scene = Scene::new("eyelets");
    let length = spans as f64;
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 10.0,
        mass_per_length: 1.0,
        rotary_inertia: 0.1,
    };
    let rope = add_beam(&mut scene, Vec2::zeros(), Vec2::new(length, 0.0), spans, section);
    scene.beams[rope].motion =
        StartMotion { velocity: Vec2::new(3.0, 0.0), ..StartMotion::default() };
    scene.gravity = Vec2::new(0.0, -9.81);
    for eyelet in 0..eyelets {
        let arc_length = (length - 8.0) * (eyelet as f64 + 0.5) / eyelets as f64;
        let eye = add_bead(&mut scene, rope, arc_length, 1.0);
        scene.join(JointKind::Hinge, eye, Partner::Ground).unwrap();
    }
    scene
}

/// Chain of links of four spans. A ring slides on each pair of consecutive links.
fn chain(links: usize) -> Scene {
    let mut scene = Scene::new("chain");
    let section = Section {
        axial_stiffness: 1e5,
        shear_stiffness: 1e5,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 0.01,
    };
    for link in 0..links {
        // The links form a zigzag, so that consecutive links cross at their ring.
        let from = Vec2::new(0.8 * link as f64, if link % 2 == 0 { 0.0 } else { 0.5 });
        let to = from + Vec2::new(1.0, if link % 2 == 0 { 0.5 } else { -0.5 });
        add_beam(&mut scene, from, to, 4, section);
    }
    let first = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Hinge, first, Partner::Ground).unwrap();
    for link in 1..links {
        let length = scene.beams[link].axis.length();
        let ring = add_bead(&mut scene, link - 1, 0.9 * length, 0.05);
        slide(&mut scene, ring, link, 0.1 * length);
    }
    scene.gravity = Vec2::new(0.0, -9.81);
    scene
}

/// Number of unknowns, smallest duration of a step, and mean number of Newton iterations.
fn cost(scene: &Scene, dt: f64) -> (usize, Duration, f64) {
    let mut model = System::assemble(scene).unwrap();
    let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
    let start = model.state();
    let (mut steps, mut iterations, mut least) = (0, 0, Duration::MAX);
    let begun = Instant::now();
    while steps < FEWEST_REPEATS || begun.elapsed() < TIME_LIMIT {
        let step = steps % RUN;
        if step == 0 {
            model.restore(&start);
        }
        let interval = Interval::between(step as f64 * dt, (step + 1) as f64 * dt);
        let before = Instant::now();
        iterations += integrator.step(&mut model, interval).unwrap().iterations;
        // The first steps are ignored, because the initial arrangement is too regular.
        if step > 2 {
            least = least.min(before.elapsed());
        }
        steps += 1;
    }
    (model.unknowns(), least, iterations as f64 / steps as f64)
}

fn print(title: &str, rows: impl Iterator<Item = (String, Scene)>, dt: f64) {
    println!("\n{title}, dt = {dt}\n");
    println!("{:>16} {:>10} {:>12} {:>12}", "", "unknowns", "ms a step", "iterations");
    for (name, scene) in rows {
        let (unknowns, time, iterations) = cost(&scene, dt);
        println!("{name:>16} {unknowns:>10} {:>12.3} {iterations:>12.2}", time.as_secs_f64() * 1e3);
    }
}

fn main() {
    for (spans, counts) in [
        (10, [0, 1, 3, 4, 10, 30, 60, 100].as_slice()),
        (400, &[0, 1, 3, 4, 10, 30, 100, 300, 1000]),
    ] {
        let rows = counts.iter().map(|&count| (format!("{count} beads"), beads(spans, count)));
        print(&format!("A beam of {spans} spans with beads"), rows, 0.02);
    }
    let rows = [0, 1, 3, 4, 10, 30, 100].into_iter();
    let rows = rows.map(|count| (format!("{count} eyelets"), eyelets(400, count)));
    print("A rope of 400 spans through eyelets", rows, 0.01);
    let rows = [2, 3, 10, 50, 100, 200].into_iter();
    let rows = rows.map(|count| (format!("{count} links"), chain(count)));
    print("A chain of links of 4 spans", rows, 0.005);
}
