//! Contact between bodies: closed forms of impacts, balances at any step size and stiffness, and self-contact.
#![allow(clippy::unwrap_used)]

use crate::common::{Random, at, run, scenes, simulate};
use crate::obstacles::{assert_balanced, column};
use withy::beams::{BodyIndex, Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{Invariant, StepSize};
use withy::system::{
    ContactMember, ContactTarget, PairContact, ParticleDefinition, Scene, StartMotion,
    StationVelocity,
};

pub fn touching(targets: &[ContactTarget], stiffness: f64, radius: f64) -> PairContact {
    let member = |target: &ContactTarget| ContactMember { target: *target, radius };
    PairContact {
        name: "contact".to_owned(),
        members: targets.iter().map(member).collect(),
        stiffness,
        restitution: 1.0,
        friction: 0.0,
    }
}

/// Particles of mass 1 in mutual contact, with start velocities.
fn particles(places: &[(Vec2, Vec2)], stiffness: f64, radius: f64) -> Scene {
    let mut scene = Scene::new("particles");
    let targets: Vec<_> = places
        .iter()
        .enumerate()
        .map(|(index, &(position, velocity))| {
            let ball = ParticleDefinition { name: format!("ball {index}"), position };
            let station = scene.add_particle(ball, 1.0).unwrap();
            scene.velocities.push(StationVelocity { station, velocity, spin: None });
            ContactTarget::Point(station)
        })
        .collect();
    scene.add_contact(touching(&targets, stiffness, radius)).unwrap();
    scene
}

/// Mean velocities over ten steps after `end`, from displacements.
fn end_velocities(scene: Scene, dt: f64, end: f64) -> Vec<Vec2> {
    let mut simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(dt), end);
    let places = |simulation: &withy::simulation::Simulation| -> Vec<Vec2> {
        simulation.model().control_points().map(|points| points[0]).collect()
    };
    let before = places(&simulation);
    run(&mut simulation, end + 10.0 * dt).unwrap();
    assert_balanced(&simulation, 1e-12);
    let after = places(&simulation);
    after.iter().zip(before).map(|(after, before)| (after - before) / (10.0 * dt)).collect()
}

/// Newton's cradle of five masses with equal linear springs `k = 1e4`, struck at speed 1 (reference: integrated with DOP853 at 1e-13).
#[test]
fn a_cradle_of_discs_has_the_velocities_of_linear_springs() {
    let exact = [-0.132_279, -0.075_329, -0.031_011, 0.296_218, 0.942_402];
    // The penetration of 1e-4 of the radius makes the law of a disc linear to this fraction.
    let (radius, speed) = (1.0, 0.01);
    let places: Vec<_> = (0..5)
        .map(|at_index| {
            let x = 2.0 * radius * f64::from(at_index) - if at_index == 0 { 1e-4 } else { 0.0 };
            (at(x, 0.0), at(if at_index == 0 { speed } else { 0.0 }, 0.0))
        })
        .collect();
    let errors = [4e-4, 2e-4, 1e-4].map(|dt| {
        let found = end_velocities(particles(&places, 1e4, radius), dt, 0.2);
        let error = |(found, exact): (&Vec2, &f64)| (found.x / speed - exact).abs();
        found.iter().zip(&exact).map(error).fold(0.0, f64::max)
    });
    println!("{errors:?}");
    assert!(errors[2] < 2e-4 && errors[0] > 3.0 * errors[1], "{errors:?}");
}

/// Smooth discs: an oblique elastic impact reverses the relative velocity along the line of centres.
#[test]
fn oblique_impact_of_discs_without_friction_agrees_with_smooth_discs() {
    let (radius, offset) = (0.5, 0.6);
    let start = [(at(-1.0, offset), at(1.0, 0.0)), (at(0.0, 0.0), at(0.0, 0.0))];
    // The line of centres at first touch; the penetration rotates it slightly.
    let normal = at(-(1.0 - offset * offset).sqrt(), offset);
    let along = normal * normal.dot(&at(1.0, 0.0));
    let errors = [1e4, 1e6].map(|stiffness: f64| {
        let dt = 0.02 / stiffness.sqrt();
        let found = end_velocities(particles(&start, stiffness, radius), dt, 0.6);
        (found[0] - (at(1.0, 0.0) - along)).norm() + (found[1] - along).norm()
    });
    println!("{errors:?}");
    assert!(errors[1] < 2e-3 && errors[1] < 0.3 * errors[0], "{errors:?}");
}

fn section(bending: f64) -> Section {
    Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: bending,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    }
}

fn moving(scene: &mut Scene, axis: Curve, spans: usize, velocity: Vec2) -> usize {
    let mesh = Mesh::bspline(spans, 3, 2).unwrap();
    let beam = scenes::add_beam(scene, axis, &mesh, section(1.0));
    scene.beams[beam].motion = StartMotion { velocity, spin: 0.0, centre: None };
    beam
}

/// Ring of a beam with rigidly joined ends.
fn ring(scene: &mut Scene, centre: Vec2, velocity: Vec2) -> usize {
    let turn = 2.0 * std::f64::consts::PI;
    let beam = moving(scene, Curve::arc(centre, 0.5, 0.0, turn).unwrap(), 16, velocity);
    let (start, end) = (scenes::start_of(scene, beam), scenes::end_of(scene, beam));
    scene.join(JointKind::Rigid, start, Partner::Station(end)).unwrap();
    beam
}

/// Collisions of two rings off centre, of a rod with the tip of another rod, and of a particle with a rod.
fn collisions(stiffness: f64, restitution: f64, friction: f64) -> [Scene; 3] {
    let mut rings = Scene::new("rings");
    let first = ring(&mut rings, at(0.0, 0.0), at(1.0, 0.0));
    let second = ring(&mut rings, at(1.3, 0.3), at(-1.0, 0.0));
    let mut rods = Scene::new("rods");
    let lying = scenes::line(at(0.0, 0.0), at(2.0, 0.0));
    let falling = scenes::line(at(0.7, 0.3), at(0.9, 2.0));
    moving(&mut rods, lying.clone(), 12, at(0.0, 0.0));
    moving(&mut rods, falling, 12, at(0.3, -1.0));
    let mut ball = Scene::new("ball");
    moving(&mut ball, lying, 12, at(0.0, 0.0));
    let particle = ParticleDefinition { name: "ball".to_owned(), position: at(0.6, 0.2) };
    let station = ball.add_particle(particle, 0.5).unwrap();
    let velocity = at(0.4, -1.5);
    ball.velocities.push(StationVelocity { station, velocity, spin: None });
    let beams = [ContactTarget::Beam(first), ContactTarget::Beam(second)];
    let pairs = [
        (&mut rings, beams),
        (&mut rods, beams),
        (&mut ball, [ContactTarget::Beam(0), ContactTarget::Point(station)]),
    ];
    for (scene, targets) in pairs {
        let contact = touching(&targets, stiffness, 0.03);
        scene.add_contact(PairContact { restitution, friction, ..contact }).unwrap();
    }
    [rings, rods, ball]
}

#[test]
fn colliding_bodies_keep_energy_and_momenta_at_any_step_and_stiffness() {
    for entry in INTEGRATORS {
        let has_friction = entry.method != Method::FourthOrder;
        let friction = if has_friction { 0.4 } else { 0.0 };
        for (stiffness, restitution, friction) in
            [(1e3, 1.0, 0.0), (1e5, 0.6, friction), (1e9, 1.0, friction)]
        {
            for dt in [0.002, 0.01, 0.05] {
                for scene in collisions(stiffness, restitution, friction) {
                    let name = scene.name.clone();
                    let dt = StepSize::Fixed(dt);
                    let simulation = simulate(scene, entry.method, dt, 0.8);
                    let case = format!("{name}, {}, {stiffness:e}, {dt:?}", entry.name);
                    let drift = |invariant| simulation.history().drift(invariant);
                    let force = column(&simulation, "contact.force");
                    // The recorded force of the fourth-order method is that of the last substep.
                    let is_touched = force.iter().any(|force| *force > 0.1);
                    assert!(
                        is_touched || entry.method == Method::FourthOrder,
                        "{case}: no contact"
                    );
                    assert!(drift(Invariant::Momentum) < 1e-12, "{case}");
                    if entry.claims.energy == EnergyClaim::Conserved {
                        assert!(drift(Invariant::Energy) < 1e-11, "{case}");
                        let turned = drift(Invariant::AngularMomentum);
                        assert!(turned < 1e-12, "{case}: {turned:.1e}");
                    }
                }
            }
        }
    }
}

#[test]
fn iterations_do_not_depend_on_the_stiffness() {
    for (stiffness, friction) in [(1e2, 0.0), (1e5, 0.0), (1e8, 0.0), (1e5, 0.4), (1e8, 0.4)] {
        for scene in collisions(stiffness, 1.0, friction) {
            let name = scene.name.clone();
            let simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(0.01), 0.8);
            let work = simulation.counts();
            let per_step = work.newton_iterations as f64 / work.steps as f64;
            println!("{name}, {stiffness:e}, {friction}: {per_step:.2} iterations per step");
            assert!(per_step < 4.5, "{name}, {stiffness:e}: {per_step}");
        }
    }
}

/// A ring is compressed until opposite sides touch. Neighbouring points of the bent axis do not count as contact.
#[test]
fn compressed_ring_touches_itself() {
    let mut scene = Scene::new("pressed ring");
    let beam = ring(&mut scene, at(0.0, 0.0), at(0.0, 0.0));
    let length = scene.beams[beam].axis.length();
    for (share, force) in [(0.25, -40.0), (0.75, 40.0)] {
        let station = scene.station(beam, share * length).unwrap();
        let force = at(0.0, force);
        let load = LoadKind::Force { station, force, frame: LoadFrame::Dead };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
    }
    scene.add_contact(touching(&[ContactTarget::Beam(beam)], 1e4, 0.04)).unwrap();
    for dt in [0.002, 0.01] {
        let simulation = simulate(scene.clone(), Method::EnergyMomentum, StepSize::Fixed(dt), 1.0);
        assert_balanced(&simulation, 1e-11);
        let gaps = column(&simulation, "contact.gap");
        assert!(gaps[0] > 0.0, "{}", gaps[0]);
        let least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least < 0.0 && least > -0.07, "dt = {dt}: {least}");
    }
}

/// A fast particle does not pass through a thin beam, at any step size.
#[test]
fn a_step_does_not_jump_through_a_beam() {
    for dt in [0.01, 0.05, 0.2] {
        let mut scene = Scene::new("bullet");
        let mesh = Mesh::bspline(6, 3, 2).unwrap();
        let axis = scenes::line(at(0.0, -1.0), at(0.0, 1.0));
        let wall = scenes::add_beam(&mut scene, axis, &mesh, section(50.0));
        let bullet = ParticleDefinition { name: "bullet".to_owned(), position: at(-1.0, 0.13) };
        let station = scene.add_particle(bullet, 0.01).unwrap();
        let velocity = at(20.0, 0.0);
        scene.velocities.push(StationVelocity { station, velocity, spin: None });
        let targets = [ContactTarget::Beam(wall), ContactTarget::Point(station)];
        scene.add_contact(touching(&targets, 1e5, 0.01)).unwrap();
        let simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(dt), 0.4);
        assert_balanced(&simulation, 1e-11);
        let position = simulation.model().control_points().nth(1).unwrap()[0];
        let wall = simulation.model().control_points().next().unwrap();
        let middle = wall.iter().map(|point| point.x).sum::<f64>() / wall.len() as f64;
        assert!(position.x < middle && middle > 0.0, "dt = {dt}: {position} {middle}");
    }
}

/// Order of the bodies, and map of their positions and velocities.
type Copy<'a> = (&'a [usize], &'a dyn Fn(Vec2) -> Vec2);

/// Rotated and mirrored copies have the same motion, as does a copy with the bodies in another order.
#[test]
fn rotated_mirrored_and_reordered_copies_agree() {
    let mut random = Random(77);
    for _ in 0..6 {
        let start = [(); 4].map(|()| random.vector(4, 1.0));
        let build = |order: &[usize], map: &dyn Fn(Vec2) -> Vec2| {
            let mut scene = Scene::new("copy");
            let mut targets = vec![ContactTarget::Beam(0); 4];
            for &index in order {
                let v = &start[index];
                let centre = at([0.0, 1.0, 0.0, 1.0][index], [0.0, 0.0, 1.0, 1.0][index]);
                let half = at(v[0], v[1]).normalize() * 0.3;
                let axis = scenes::line(map(centre - half), map(centre + half));
                let towards = (at(0.5, 0.5) - centre) * 2.0 + at(v[2], v[3]) * 0.3;
                targets[index] = ContactTarget::Beam(moving(&mut scene, axis, 4, map(towards)));
            }
            scene.add_contact(touching(&targets, 1e4, 0.03)).unwrap();
            let simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(0.005), 0.4);
            assert_balanced(&simulation, 1e-11);
            let bodies: Vec<Vec2> = targets
                .iter()
                .map(|target| {
                    let BodyIndex::Beam(beam) = target.station().body else { unreachable!() };
                    simulation.model().control_points().nth(beam).unwrap()[0]
                })
                .collect();
            (bodies, simulation.history().column("contact.force").unwrap())
        };
        let same = |point: Vec2| point;
        let turn = |p: Vec2| at(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y);
        let mirror = |p: Vec2| at(-p.x, p.y);
        let (reference, force) = build(&[0, 1, 2, 3], &same);
        assert!(force.iter().any(|force| *force > 0.0));
        let copies: [Copy<'_>; 3] =
            [(&[0, 1, 2, 3], &turn), (&[0, 1, 2, 3], &mirror), (&[2, 0, 3, 1], &same)];
        for (number, (order, map)) in copies.into_iter().enumerate() {
            let (found, _) = build(order, map);
            for (found, reference) in found.iter().zip(&reference) {
                let apart = (found - map(*reference)).norm();
                assert!(apart < 1e-8, "copy {number}: {apart:e}");
            }
        }
    }
}

/// Discs fall on each other and lose energy in impacts. The balances hold over many openings and closings of contacts.
#[test]
fn a_heap_of_discs_keeps_its_balances() {
    let mut scene = Scene::new("heap");
    let mut random = Random(5);
    let mut targets = Vec::new();
    for index in 0..12 {
        let v = random.vector(2, 0.05);
        let position =
            at(0.45 * f64::from(index % 3) + v[0], 0.3 + 0.45 * f64::from(index / 3) + v[1]);
        let ball = ParticleDefinition { name: format!("ball {index}"), position };
        targets.push(ContactTarget::Point(scene.add_particle(ball, 1.0).unwrap()));
    }
    scene.gravity = at(0.0, -10.0);
    scene.add_contact(PairContact { restitution: 0.5, ..touching(&targets, 1e6, 0.2) }).unwrap();
    for (name, point, normal) in [
        ("floor", at(0.0, 0.0), at(0.0, 1.0)),
        ("left", at(-0.3, 0.0), at(1.0, 0.0)),
        ("right", at(1.2, 0.0), at(-1.0, 0.0)),
    ] {
        let wall = crate::obstacles::wall(point, normal, 1e6, 0.5);
        scene
            .add_obstacle(withy::system::Obstacle { name: name.to_owned(), radius: 0.2, ..wall })
            .unwrap();
    }
    let simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(0.005), 3.0);
    assert_balanced(&simulation, 1e-11);
    let least = column(&simulation, "contact.gap").into_iter().fold(0.0, f64::min);
    assert!(least > -0.01, "{least}");
    let work = simulation.counts();
    println!("{} steps, {} iterations", work.steps, work.newton_iterations);
    assert!(work.newton_iterations < 6 * work.steps);
}

/// Bodies that can touch but never do move with the same bits as without contact.
#[test]
fn bodies_that_never_touch_move_as_without_contact() {
    let build = |with_contact: bool| {
        let mut scene = Scene::new("far");
        let one = moving(&mut scene, scenes::line(at(0.0, 0.0), at(1.0, 0.2)), 6, at(0.3, 0.1));
        let two = moving(&mut scene, scenes::line(at(0.0, 3.0), at(1.0, 3.0)), 6, at(0.1, 0.2));
        if with_contact {
            let targets = [ContactTarget::Beam(one), ContactTarget::Beam(two)];
            scene.add_contact(touching(&targets, 1e5, 0.01)).unwrap();
        }
        let simulation = simulate(scene, Method::EnergyMomentum, StepSize::Fixed(0.01), 0.5);
        let points: Vec<_> = simulation.model().control_points().map(<[Vec2]>::to_vec).collect();
        (points, simulation.counts().newton_iterations)
    };
    let ((with, more), (without, fewer)) = (build(true), build(false));
    assert_eq!(more, fewer);
    assert!(with == without);
}

#[test]
fn invalid_contacts_are_rejected() {
    let mut scene = Scene::new("refused");
    let beam = moving(&mut scene, scenes::line(at(0.0, 0.0), at(1.0, 0.0)), 4, at(0.0, 0.0));
    let target = ContactTarget::Beam(beam);
    let wrong = [
        touching(&[target, target], 1e4, 0.1),
        touching(&[], 1e4, 0.1),
        touching(&[target], 0.0, 0.1),
        touching(&[target], 1e4, 0.0),
        touching(&[target, ContactTarget::Point(Station::on_particle(3))], 1e4, 0.1),
        PairContact { restitution: 1.5, ..touching(&[target], 1e4, 0.1) },
    ];
    for contact in wrong {
        let error = scene.add_contact(contact.clone()).unwrap_err();
        println!("{error}");
        assert!(scene.contacts().next().is_none(), "{contact:?}");
    }
}
