//! Scenes with every kind of beam, joint, mass and load.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::at;
use withy::beams::{Mesh, Relaxation, Section, SectionVariation, Station};
use withy::geometry::{Curve, Vec2};
use withy::joints::{Component, Components, JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::system::{
    Anchor, BeamDefinition, ContactMember, ContactTarget, DampingLaw, Drag, Dragged, Drive,
    DriveKind, Obstacle, ObstacleShape, Origin, PairContact, ParticleDefinition, PointMass,
    RigidBodyDefinition, Scene, SpeedLaw, Spring, SpringKind, SpringLaw, StartMotion,
};

/// Section of the flying spaghetti with the given `EA = GA` and `EI`.
pub fn spaghetti_section(stiffness: f64, bending: f64) -> Section {
    Section {
        axial_stiffness: stiffness,
        shear_stiffness: stiffness,
        bending_stiffness: bending,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    }
}

pub fn rod() -> Section {
    Section {
        axial_stiffness: 2e3,
        shear_stiffness: 8e2,
        bending_stiffness: 30.0,
        mass_per_length: 1.0,
        rotary_inertia: 0.3,
    }
}

pub fn add_beam(scene: &mut Scene, axis: Curve, mesh: &Mesh, section: Section) -> usize {
    let name = format!("beam{}", scene.beams.len() + 1);
    let motion = StartMotion::default();
    scene
        .add_beam(BeamDefinition {
            name,
            axis,
            mesh: mesh.clone(),
            section: section.into(),
            motion,
        })
        .unwrap()
}

pub fn line(from: Vec2, to: Vec2) -> Curve {
    Curve::line(from, to).unwrap()
}

pub fn start_of(scene: &mut Scene, beam: usize) -> Station {
    scene.station(beam, 0.0).unwrap()
}

pub fn end_of(scene: &mut Scene, beam: usize) -> Station {
    let length = scene.beams[beam].axis.length();
    scene.station(beam, length).unwrap()
}

fn force(scene: &mut Scene, station: Station, force: Vec2, frame: LoadFrame, schedule: Schedule) {
    scene.add_load(LoadKind::Force { station, force, frame }, schedule);
}

fn always() -> Schedule {
    Schedule::constant(1.0).unwrap()
}

fn hold(time: f64) -> Schedule {
    Schedule::hold_for(time).unwrap()
}

/// Flying spaghetti (Simo & Vu-Quoc 1986, II) from (0, 8) + `shift` to (6, 0) + `shift`, with a schedule of the loads.
pub fn thrown(mesh: &Mesh, section: Section, schedule: Schedule, shift: Vec2) -> Scene {
    let mut scene = Scene::new("flying spaghetti");
    let axis = line(at(0.0, 8.0) + shift, at(6.0, 0.0) + shift);
    let beam = add_beam(&mut scene, axis, mesh, section);
    let station = end_of(&mut scene, beam);
    force(&mut scene, station, at(8.0, 0.0), LoadFrame::Dead, schedule.clone());
    scene.add_load(LoadKind::Moment { station, moment: -80.0 }, schedule);
    scene
}

/// Flying spaghetti with the step load of the literature.
pub fn spaghetti(mesh: &Mesh, stiffness: f64) -> Scene {
    thrown(mesh, spaghetti_section(stiffness, 100.0), hold(2.5), Vec2::zeros())
}

/// Flying spaghetti with the smooth pulse of the references `P1s` and `P2s`.
pub fn smooth_spaghetti(mesh: &Mesh, bending: f64) -> Scene {
    let pulse = Schedule::smooth_pulse(2.5).unwrap();
    thrown(mesh, spaghetti_section(1e4, bending), pulse, Vec2::zeros())
}

/// Free beam of length 10 along the first axis.
pub fn free_beam(mesh: &Mesh, section: Section) -> Scene {
    let mut scene = Scene::new("free beam");
    add_beam(&mut scene, line(Vec2::zeros(), at(10.0, 0.0)), mesh, section);
    scene
}

/// The same beam, clamped at its start.
pub fn cantilever(mesh: &Mesh, section: Section) -> Scene {
    let mut scene = free_beam(mesh, section);
    let start = start_of(&mut scene, 0);
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene
}

/// Quarter arc that is hinged to the ground and swings under gravity with a mass at its end.
pub fn curved_pendulum(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("curved pendulum");
    let axis = Curve::arc(at(0.5, 1.0), 2.0, 0.0, -FRAC_PI_2).unwrap();
    let beam = add_beam(&mut scene, axis, mesh, rod());
    let start = start_of(&mut scene, beam);
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    let station = end_of(&mut scene, beam);
    scene.add_mass(PointMass { station, mass: 0.7, rotary_inertia: 0.2 }).unwrap();
    scene.gravity = at(0.0, -9.81);
    scene
}

/// Clamped beam under a follower force at 0.6 of its length, a follower line load and a dead line load.
pub fn blown_cantilever(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("blown cantilever");
    let beam = add_beam(&mut scene, line(at(1.0, 0.0), at(2.5, 2.0)), mesh, rod());
    let start = start_of(&mut scene, beam);
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    let station = scene.station(beam, 1.5).unwrap();
    force(&mut scene, station, at(-4.0, 3.0), LoadFrame::Follower, hold(3.0));
    let lines = [(at(1.0, -2.0), LoadFrame::Follower), (at(0.5, -1.0), LoadFrame::Dead)];
    for (force, frame) in lines {
        let schedule = Schedule::Sine { amplitude: 1.0, rate: 1.7, phase: 0.4 };
        scene.add_load(LoadKind::Line { beam, force, frame }, schedule);
    }
    scene
}

/// Free rhombus of four hinged bars, one of which is driven by a moment.
pub fn flying_loop(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("flying four-bar loop");
    let corners = [at(0.0, 0.0), at(2.0, 0.5), at(3.0, 2.2), at(1.0, 1.7)];
    for (corner, &from) in corners.iter().enumerate() {
        let axis = line(from, corners[(corner + 1) % 4]);
        let beam = add_beam(&mut scene, axis, mesh, rod());
        scene.beams[beam].motion =
            StartMotion { velocity: at(1.0, 0.5), spin: 0.8, centre: Some(Vec2::zeros()) };
    }
    for beam in 0..4 {
        let (end, next) = (end_of(&mut scene, beam), start_of(&mut scene, (beam + 1) % 4));
        scene.join(JointKind::Hinge, end, Partner::Station(next)).unwrap();
    }
    let station = start_of(&mut scene, 0);
    scene.add_load(LoadKind::Moment { station, moment: 6.0 }, hold(1.0));
    scene
}

/// Four-bar linkage hinged to the ground at both ends, driven by a moment, under gravity.
pub fn four_bar_linkage(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("four-bar linkage");
    let corners = [at(0.0, 0.0), at(0.3, 1.0), at(2.4, 1.6), at(2.2, 0.0)];
    for pair in corners.windows(2) {
        add_beam(&mut scene, line(pair[0], pair[1]), mesh, rod());
    }
    let (first, last) = (start_of(&mut scene, 0), end_of(&mut scene, 2));
    for station in [first, last] {
        scene.join(JointKind::Hinge, station, Partner::Ground).unwrap();
    }
    for beam in 0..2 {
        let (end, next) = (end_of(&mut scene, beam), start_of(&mut scene, beam + 1));
        scene.join(JointKind::Hinge, end, Partner::Station(next)).unwrap();
    }
    scene.add_load(LoadKind::Moment { station: first, moment: -5.0 }, hold(2.0));
    scene.gravity = at(0.0, -2.0);
    scene
}

/// Free structure of a curved beam, a straight beam joined rigidly to its interior, and a hinged third beam, with a load.
pub fn flying_tree(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("flying tree");
    let arc = Curve::arc(at(0.0, 0.0), 2.0, 0.2, 1.4).unwrap();
    let fork = arc.point(0.5).unwrap();
    let tip = fork + at(1.6, 0.9);
    let trunk = add_beam(&mut scene, arc, mesh, rod());
    let branch = add_beam(&mut scene, line(fork, tip), mesh, rod());
    let leaf = add_beam(&mut scene, line(tip, tip + at(0.4, -1.3)), mesh, rod());
    for beam in [trunk, branch, leaf] {
        scene.beams[beam].motion =
            StartMotion { velocity: at(-0.4, 1.0), spin: 1.1, centre: Some(fork) };
    }
    let middle = 0.5 * scene.beams[trunk].axis.length();
    let middle = scene.station(trunk, middle).unwrap();
    let (foot, end) = (start_of(&mut scene, branch), end_of(&mut scene, branch));
    scene.join(JointKind::Rigid, foot, Partner::Station(middle)).unwrap();
    let stalk = start_of(&mut scene, leaf);
    scene.join(JointKind::Hinge, stalk, Partner::Station(end)).unwrap();
    let line = LoadKind::Line { beam: branch, force: at(1.0, 0.7), frame: LoadFrame::Dead };
    scene.add_load(line, hold(1.5));
    scene
}

/// Circular beam with rigidly joined ends under a follower force.
pub fn hoop(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("hoop");
    let circle = Curve::arc(at(1.0, 1.0), 1.5, 0.3, 0.3 + TAU).unwrap();
    let beam = add_beam(&mut scene, circle, mesh, rod());
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Rigid, start, Partner::Station(end)).unwrap();
    let station = scene.station(beam, 2.0).unwrap();
    force(&mut scene, station, at(2.0, 5.0), LoadFrame::Follower, hold(1.3));
    scene
}

/// Free beam with a constant force, as a scene without joints.
pub fn towed(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("towed beam");
    let axis = Curve::through(&[at(0.0, 0.0), at(1.0, 0.4), at(2.0, 0.2), at(3.0, 1.0)]).unwrap();
    let beam = add_beam(&mut scene, axis, mesh, rod());
    let station = scene.station(beam, 1.0).unwrap();
    force(&mut scene, station, at(0.0, 3.0), LoadFrame::Dead, always());
    scene
}

/// Adds a spring with a parallel damper. A law of `None` adds a damper.
pub fn spring(
    scene: &mut Scene,
    kind: SpringKind,
    law: impl Into<Option<SpringLaw>>,
    damping: f64,
) {
    let (name, law) = (scene.free_name("spring"), law.into());
    scene
        .add_spring(Spring {
            name,
            kind,
            law,
            origin: Origin::Zero,
            damping: damping.into(),
            rest: None,
        })
        .unwrap();
}

fn linear(stiffness: f64, natural: f64) -> SpringLaw {
    SpringLaw::Linear { stiffness, natural }
}

/// Two beams that move apart, connected by a spring between interior points, a torsion spring and a tendon over four points. All are initially unstrained.
pub fn sprung(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("sprung");
    let one = add_beam(&mut scene, line(at(2.0, 0.4), at(0.3, 2.0)), mesh, rod());
    let other = add_beam(&mut scene, line(at(3.0, 0.5), at(4.0, 2.5)), mesh, rod());
    scene.beams[one].motion = StartMotion { velocity: at(-0.4, 1.0), spin: 1.1, centre: None };
    scene.beams[other].motion = StartMotion { velocity: at(0.3, 0.2), spin: -0.7, centre: None };
    let inside = [(one, 0.7), (other, 1.1), (other, 2.0), (one, 1.9)];
    let places = inside.map(|(beam, along)| scene.station(beam, along).unwrap());
    let way = |scene: &Scene, stations: &[Station]| {
        let at: Vec<Vec2> = stations.iter().map(|place| scene.drawn_at(place).unwrap()).collect();
        let length = at.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        (SpringKind::Length(stations.iter().map(|place| Anchor::Station(*place)).collect()), length)
    };
    let (between, length) = way(&scene, &places[..2]);
    spring(&mut scene, between, linear(40.0, length), 0.0);
    let (over, length) = way(&scene, &places);
    let table = vec![(0.5 * length, 0.0), (length, 0.0), (1.2 * length, 3.0), (1.5 * length, 20.0)];
    spring(&mut scene, over, SpringLaw::Table { points: table }, 0.0);
    let ends = [end_of(&mut scene, one), start_of(&mut scene, other)].map(Anchor::Station);
    let angle = 2.0_f64.atan2(1.0) - 1.6_f64.atan2(-1.7);
    spring(&mut scene, SpringKind::Torsion(ends), linear(6.0, angle), 0.0);
    scene
}

/// Beam and particle on springs and dampers to the ground, under a load and their weight.
pub fn mounted(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("mounted");
    let beam = add_beam(&mut scene, line(at(0.5, 1.0), at(3.0, 1.4)), mesh, rod());
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(2.0, 3.0) };
    let bead = Anchor::Station(scene.add_particle(bead, 0.8).unwrap());
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    let inner = Anchor::Station(scene.station(beam, 0.9).unwrap());
    let foot = |x: f64, y: f64| Anchor::Ground(at(x, y));
    let below = SpringKind::Length(vec![foot(0.4, 0.0), Anchor::Station(start)]);
    spring(&mut scene, below, linear(60.0, 0.8), 2.0);
    let over = SpringKind::Length(vec![foot(3.5, 0.0), Anchor::Station(end), bead, inner]);
    spring(&mut scene, over, linear(15.0, 4.0), 0.4);
    let twist = SpringKind::Torsion([foot(0.0, 0.0), inner]);
    spring(&mut scene, twist, linear(5.0, 0.0), 0.3);
    let name = scene.free_name("damper");
    let kind = SpringKind::Length(vec![bead, Anchor::Station(start)]);
    scene
        .add_spring(Spring {
            name,
            kind,
            law: None,
            origin: Origin::Zero,
            damping: 1.5.into(),
            rest: None,
        })
        .unwrap();
    force(&mut scene, end, at(1.0, 2.0), LoadFrame::Dead, hold(1.1));
    scene.gravity = at(0.0, -2.0);
    scene
}

pub fn drive(scene: &mut Scene, station: Station, given: &[(Component, PrescribedMotion)]) {
    let mut motions = [None, None, None];
    for (component, motion) in given {
        motions[*component as usize] = Some(motion.clone());
    }
    let (name, kind) = (scene.free_name("move"), DriveKind::Move);
    scene.add_drive(Drive { name, kind, station, motions }).unwrap();
}

fn sine(amplitude: f64, rate: f64) -> Schedule {
    Schedule::Sine { amplitude, rate, phase: 0.0 }
}

/// Two hinged beams. The foot of the first has a prescribed translation and rotation, the second is supported by a roller, and a named load acts.
pub fn driven(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("driven");
    let first = add_beam(&mut scene, line(at(0.3, 0.1), at(1.5, 1.0)), mesh, rod());
    let second = add_beam(&mut scene, line(at(1.5, 1.0), at(3.0, 0.2)), mesh, rod());
    let (foot, top) = (start_of(&mut scene, first), end_of(&mut scene, first));
    let (next, tip) = (start_of(&mut scene, second), end_of(&mut scene, second));
    scene.join(JointKind::Hinge, top, Partner::Station(next)).unwrap();
    scene.join(JointKind::Support(Components::Y), tip, Partner::Ground).unwrap();
    let motions = [
        (Component::X, PrescribedMotion::Position(sine(0.2, 2.3))),
        (Component::Y, PrescribedMotion::Rate(sine(0.3, 1.7))),
        (Component::Rotation, PrescribedMotion::Rate(sine(0.4, 0.9))),
    ];
    drive(&mut scene, foot, &motions);
    let push = LoadKind::Force { station: tip, force: at(2.0, 0.0), frame: LoadFrame::Dead };
    scene.add_named_load("push".to_owned(), push, hold(2.0)).unwrap();
    scene.gravity = at(0.0, -2.0);
    scene
}

/// Free bent beam of a Kelvin–Voigt material with a straight beam joined to its end.
pub fn damped(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("damped");
    let axis = Curve::through(&[at(0.0, 0.0), at(1.0, 0.4), at(2.0, 0.2), at(3.0, 1.0)]).unwrap();
    let bent = add_beam(&mut scene, axis, mesh, rod());
    let tail = add_beam(&mut scene, line(at(3.0, 1.0), at(3.5, 2.5)), mesh, rod());
    let (end, start) = (end_of(&mut scene, bent), start_of(&mut scene, tail));
    scene.join(JointKind::Hinge, end, Partner::Station(start)).unwrap();
    scene.beams[bent].motion = StartMotion { velocity: at(0.5, 0.2), spin: 0.0, centre: None };
    scene.beams[tail].motion = StartMotion { velocity: at(0.5, 0.2), spin: 0.0, centre: None };
    scene.add_damping(bent, Relaxation { axial: 0.01, shear: 0.02, bending: 0.1 }).unwrap();
    scene.add_damping(tail, Relaxation { axial: 0.0, shear: 0.0, bending: 0.05 }).unwrap();
    let inner = scene.station(bent, 1.0).unwrap();
    force(&mut scene, inner, at(0.0, 3.0), LoadFrame::Dead, hold(0.9));
    scene
}

/// Bent beam in wind with transverse and axial drag, and a bead with drag on a spring at its end.
pub fn dragged(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("dragged");
    let axis = Curve::through(&[at(0.0, 0.0), at(1.0, 0.4), at(2.0, 0.2), at(3.0, 1.0)]).unwrap();
    let beam = add_beam(&mut scene, axis, mesh, rod());
    scene.beams[beam].motion = StartMotion { velocity: at(0.5, 0.2), spin: 1.3, centre: None };
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(4.0, 1.5) };
    let bead = scene.add_particle(bead, 0.8).unwrap();
    let end = end_of(&mut scene, beam);
    let way = SpringKind::Length(vec![Anchor::Station(end), Anchor::Station(bead)]);
    spring(&mut scene, way, linear(30.0, 1.25_f64.sqrt()), 0.0);
    let along = |linear: f64, quadratic: f64| SpeedLaw { linear, quadratic };
    let drags = [
        (Dragged::Beam { beam, normal: along(0.3, 0.0), tangent: along(0.05, 0.0) }, at(1.0, 0.5)),
        (Dragged::Point { station: bead, law: along(0.1, 0.2) }, at(-9.0, 4.0)),
    ];
    for (on, wind) in drags {
        let name = scene.free_name("drag");
        scene.add_drag(Drag { name, on, wind }).unwrap();
    }
    scene.gravity = at(0.0, -2.0);
    scene
}

/// Bent beam and bead that penetrate a damped wall and a soft disc. The contacts stay closed, so the forces are smooth.
pub fn pressed(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("pressed");
    let axis = Curve::through(&[at(0.0, 0.0), at(1.0, 0.4), at(2.0, 0.2), at(3.0, 1.0)]).unwrap();
    let beam = add_beam(&mut scene, axis, mesh, rod());
    scene.beams[beam].motion = StartMotion { velocity: at(0.5, 0.2), spin: 0.3, centre: None };
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(4.0, 1.5) };
    scene.add_particle(bead, 0.8).unwrap();
    let wall = ObstacleShape::HalfPlane { point: at(0.0, 9.0), normal: at(0.6, 0.8) };
    let disc = ObstacleShape::Disc { centre: at(1.0, -4.0), radius: 12.0 };
    for (shape, restitution) in [(wall, 1.0), (disc, 1.0)] {
        let name = scene.free_name("obstacle");
        let (targets, radius, stiffness) = (Vec::new(), 0.5, 0.02);
        let obstacle =
            Obstacle { name, shape, targets, radius, stiffness, restitution, friction: 0.0 };
        scene.add_obstacle(obstacle).unwrap();
    }
    scene.gravity = at(0.0, -0.5);
    scene
}

/// Bent beam, straight beam and bead in soft mutual contact. The contacts stay closed, so the forces are smooth.
pub fn crowded(mesh: &Mesh, friction: f64) -> Scene {
    let mut scene = Scene::new("crowded");
    let axis = Curve::through(&[at(0.0, 0.0), at(1.0, 0.1), at(2.0, 0.3), at(3.0, 0.8)]).unwrap();
    let bent = add_beam(&mut scene, axis, mesh, rod());
    scene.beams[bent].motion = StartMotion { velocity: at(0.5, 0.2), spin: 0.3, centre: None };
    let straight = add_beam(&mut scene, line(at(0.4, 2.5), at(3.0, 2.8)), mesh, rod());
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(1.4, -1.5) };
    let bead = scene.add_particle(bead, 0.8).unwrap();
    let beams = [ContactTarget::Beam(bent), ContactTarget::Beam(straight)];
    let targets = beams.into_iter().chain([ContactTarget::Point(bead)]);
    let members = targets.map(|target| ContactMember { target, radius: 4.0 }).collect();
    let name = scene.free_name("contact");
    let (stiffness, restitution) = (0.5, 1.0);
    scene.add_contact(PairContact { name, members, stiffness, restitution, friction }).unwrap();
    scene
}

/// Damping law from a table of rates and forces.
pub fn absorber(points: &[(f64, f64)]) -> DampingLaw {
    DampingLaw::Curve(SpringLaw::Table { points: points.to_vec() })
}

/// Free beam with a progressive damper to the ground. A second beam is connected to it by a saturated torsion damper and by a spring with a one-way damper.
pub fn absorbed(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("absorbed");
    let one = add_beam(&mut scene, line(at(0.2, 0.4), at(2.0, 1.0)), mesh, rod());
    let other = add_beam(&mut scene, line(at(2.0, 1.0), at(3.5, 0.2)), mesh, rod());
    let (start, end) = (start_of(&mut scene, one), end_of(&mut scene, one));
    let (next, tip) = (start_of(&mut scene, other), end_of(&mut scene, other));
    scene.join(JointKind::Hinge, end, Partner::Station(next)).unwrap();
    let motion = StartMotion { velocity: at(0.5, 1.0), spin: -0.7, centre: Some(at(2.0, 1.0)) };
    scene.beams[one].motion = motion;
    scene.beams[other].motion = motion;
    let mut add = |kind, law, damping| {
        let (name, origin) = (scene.free_name("absorber"), Origin::AsBuilt);
        scene.add_spring(Spring { name, kind, law, origin, damping, rest: None }).unwrap();
    };
    let to_ground =
        SpringKind::Length(vec![Anchor::Ground(at(-1.0, -1.0)), Anchor::Station(start)]);
    let rising = [(-2.0, -4.0), (-1.0, -1.0), (-0.5, -0.25), (0.5, 0.25), (1.0, 1.0), (2.0, 4.0)];
    add(to_ground, None, absorber(&rising));
    let turn = SpringKind::Torsion([Anchor::Station(end), Anchor::Station(next)]);
    add(turn, Some(linear(2.0, 0.1)), absorber(&[(-0.4, -0.3), (0.4, 0.3), (1.0, 0.3)]));
    let across = SpringKind::Length(vec![Anchor::Station(start), Anchor::Station(tip)]);
    add(across, Some(linear(6.0, 0.2)), absorber(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 1.5)]));
    // Functions, which are sampled as piecewise linear laws.
    let over = SpringKind::Length(vec![
        Anchor::Ground(at(2.0, 3.0)),
        Anchor::Station(end),
        Anchor::Ground(at(3.0, 3.0)),
    ]);
    let hardening = |e: f64| Ok::<f64, ()>(8.0 * e + 3.0 * e * e * e);
    let fluid = |rate: f64| Ok::<f64, ()>(0.3 * rate * rate.abs());
    let law = SpringLaw::sampled((-1.5, 1.5), hardening).unwrap();
    add(over, Some(law), DampingLaw::sampled((-2.0, 2.0), fluid).unwrap());
    scene
}

/// Free beam with a flywheel hinged to one end, driven by a torsion spring, and a rigid body fixed to the other end. Both are attached at their centres.
pub fn flywheels(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("flywheels");
    let beam = add_beam(&mut scene, line(at(0.0, 1.0), at(3.0, 2.0)), mesh, rod());
    let ends = [start_of(&mut scene, beam), end_of(&mut scene, beam)];
    let joints = [JointKind::Hinge, JointKind::Rigid];
    let motion = StartMotion { velocity: at(0.4, 0.7), spin: 0.8, centre: Some(Vec2::zeros()) };
    scene.beams[beam].motion = motion;
    for (end, kind) in ends.into_iter().zip(joints) {
        let (name, position) = (scene.free_name("body"), scene.drawn_at(&end).unwrap());
        let body = RigidBodyDefinition {
            name,
            position,
            angle: 0.2,
            points: Vec::new(),
            outline: Vec::new(),
            motion,
        };
        let body = scene.add_rigid_body(body, 0.6, 0.15).unwrap();
        scene.join(kind, Station::on_rigid_body(body, 0), Partner::Station(end)).unwrap();
    }
    let wheel = [Anchor::Station(ends[0]), Anchor::Station(Station::on_rigid_body(0, 0))];
    let drawn = 0.2 - 1.0_f64.atan2(3.0);
    spring(&mut scene, SpringKind::Torsion(wheel), linear(3.0, drawn), 0.0);
    scene
}

/// Tapered curved beam of a damped material that swings about a hinge with a force at its thin end.
pub fn tapered(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("tapered");
    let axis = Curve::arc(at(0.5, 1.0), 2.0, 0.3, -1.2).unwrap();
    let beam = add_beam(&mut scene, axis, mesh, rod());
    let thin = Section { bending_stiffness: 12.0, mass_per_length: 0.6, ..rod() };
    scene.beams[beam].section =
        SectionVariation::Numbers(vec![(0.0, rod()), (0.4, rod()), (1.0, thin)]);
    scene.add_damping(beam, Relaxation { axial: 0.01, shear: 0.0, bending: 0.03 }).unwrap();
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    force(&mut scene, end, at(1.0, 2.0), LoadFrame::Dead, hold(1.1));
    scene.gravity = at(0.0, -2.0);
    scene
}

/// All scenes on a mesh with smooth forces, except those of `body_scenes::all` with rigid bodies attached off their centres and inclined rollers.
pub fn all(mesh: &Mesh) -> Vec<Scene> {
    vec![
        spaghetti(mesh, 1e4),
        curved_pendulum(mesh),
        blown_cantilever(mesh),
        flying_loop(mesh),
        four_bar_linkage(mesh),
        flying_tree(mesh),
        hoop(mesh),
        towed(mesh),
        sprung(mesh),
        mounted(mesh),
        damped(mesh),
        dragged(mesh),
        pressed(mesh),
        flywheels(mesh),
        driven(mesh),
        tapered(mesh),
        super::release_scenes::chain(mesh),
        super::machine_scenes::bushed(mesh),
        super::machine_scenes::actuated(mesh),
        super::steered_scenes::arm(mesh),
    ]
}
