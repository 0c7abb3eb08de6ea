//! Friction between bodies: closed forms of impacts, sliding, sticking and rolling, and refused scenes.
#![allow(clippy::unwrap_used)]

use crate::common::{at, run, scenes, settings, simulate};
use crate::contacts::touching;
use crate::obstacles::{assert_balanced, column, wall};
use withy::beams::{BodyPoint, Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{JointKind, Partner};
use withy::simulation::Simulation;
use withy::system::{
    ContactMember, ContactTarget, Obstacle, PairContact, ParticleDefinition, RigidBodyDefinition,
    Scene, StartMotion,
};

const GRAVITY: f64 = 9.81;

fn disc(scene: &mut Scene, position: Vec2, velocity: Vec2, [mass, radius]: [f64; 2]) -> Station {
    let disc = RigidBodyDefinition {
        name: format!("disc {}", scene.rigid_bodies.len()),
        position,
        angle: 0.0,
        points: Vec::new(),
        outline: Vec::new(),
        motion: StartMotion { velocity, spin: 0.0, centre: None },
    };
    let body = scene.add_rigid_body(disc, mass, 0.5 * mass * radius * radius).unwrap();
    Station::on_rigid_body(body, 0)
}

/// Velocity and angular velocity of a rigid body.
fn rates(simulation: &Simulation, body: usize) -> [f64; 3] {
    let centre = BodyPoint::of_point(body, 0, 0.0);
    let velocity = simulation.model().velocity(&centre);
    [velocity.x, velocity.y, simulation.model().spin(&centre)]
}

/// Oblique impact of two equal discs that slips throughout: both discs get the angular impulse `μ P r`, with the normal impulse
/// `P = m (1 + e) v_n / 2`.
#[test]
fn an_oblique_impact_of_discs_sets_both_in_rotation() {
    let (mass, radius, friction, speed) = (2.0, 0.5, 0.1, at(3.0, 2.0));
    for restitution in [1.0, 0.6] {
        let mut scene = Scene::new("discs");
        let stations = [
            disc(&mut scene, at(0.0, 0.0), speed, [mass, radius]),
            disc(&mut scene, at(1.0001, 0.0), at(0.0, 0.0), [mass, radius]),
        ];
        let targets = stations.map(ContactTarget::Point);
        let contact = touching(&targets, 1e8, radius);
        scene.add_contact(PairContact { restitution, friction, ..contact }).unwrap();
        let simulation = simulate(scene, Method::EnergyMomentum, 2e-6, 0.001);
        let after = [0, 1].map(|body| rates(&simulation, body));
        let impulse = 0.5 * mass * (1.0 + restitution) * speed.x;
        let inertia = 0.5 * mass * radius * radius;
        let spin = -friction * impulse * radius / inertia;
        let along = friction * impulse / mass;
        let expected =
            [[speed.x - impulse / mass, speed.y - along, spin], [impulse / mass, along, spin]];
        for (found, expected) in after.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 0.02, "{restitution}: {after:?}, {expected:?}");
        }
        assert_balanced(&simulation, 1e-12);
    }
}

/// Stiff beam at an angle [deg], clamped at both ends, and a body that rests on it.
fn slope(degrees: f64, add: &dyn Fn(&mut Scene, Vec2) -> Station, radius: f64) -> (Scene, Vec2) {
    let angle = degrees.to_radians();
    let (along, normal) = (at(angle.cos(), angle.sin()), at(-angle.sin(), angle.cos()));
    let mut scene = Scene::new("slope");
    scene.gravity = at(0.0, -GRAVITY);
    let section = Section {
        axial_stiffness: 1e7,
        shear_stiffness: 1e7,
        bending_stiffness: 1e6,
        mass_per_length: 1.0,
        rotary_inertia: 0.1,
    };
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let beam =
        scenes::add_beam(&mut scene, scenes::line(along * -4.0, along * 4.0), &mesh, section);
    for end in [scenes::start_of(&mut scene, beam), scenes::end_of(&mut scene, beam)] {
        scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
    }
    let thickness = 0.1;
    let station = add(&mut scene, normal * (radius + thickness));
    let members = vec![
        ContactMember { target: ContactTarget::Beam(beam), radius: thickness },
        ContactMember { target: ContactTarget::Point(station), radius },
    ];
    let contact = touching(&[], 1e6, radius);
    let contact = PairContact { members, restitution: 0.3, friction: 0.3, ..contact };
    scene.add_contact(contact).unwrap();
    (scene, along)
}

fn block(scene: &mut Scene, position: Vec2) -> Station {
    scene.add_particle(ParticleDefinition { name: "block".into(), position }, 0.1).unwrap()
}

fn last_place(simulation: &Simulation) -> Vec2 {
    simulation.model().control_points().last().unwrap()[0]
}

/// A particle slides down with `g (sin α - μ cos α)` if `tan α > μ`, and sticks otherwise.
#[test]
fn a_particle_on_an_inclined_beam_slides_or_sticks() {
    let acceleration = |degrees: f64| {
        let (scene, along) = slope(degrees, &block, 0.2);
        let mut simulation = simulate(scene, Method::EnergyMomentum, 0.001, 0.3);
        let at_time = |simulation: &Simulation| along.dot(&last_place(simulation));
        let first = at_time(&simulation);
        run(&mut simulation, 0.5).unwrap();
        let second = at_time(&simulation);
        run(&mut simulation, 0.7).unwrap();
        assert_balanced(&simulation, 1e-9);
        (at_time(&simulation) - 2.0 * second + first) / 0.04
    };
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let expected = -GRAVITY * (sin - 0.3 * cos);
    assert!((acceleration(30.0) / expected - 1.0).abs() < 2e-3, "{}", acceleration(30.0));
    assert!(acceleration(10.0).abs() < 5e-3, "{}", acceleration(10.0));
}

/// A disc rolls down an inclined beam with `2 g sin α / 3` if `tan α < 3 μ`. The thickness of the beam does not matter.
#[test]
fn a_disc_rolls_down_an_inclined_beam() {
    let radius = 0.3;
    let add =
        |scene: &mut Scene, position: Vec2| disc(scene, position, at(0.0, 0.0), [0.1, radius]);
    let (scene, along) = slope(20.0, &add, radius);
    let mut simulation = simulate(scene, Method::EnergyMomentum, 0.001, 0.2);
    let places: Vec<_> = [0.4, 0.6, 0.8]
        .into_iter()
        .map(|end| {
            run(&mut simulation, end).unwrap();
            along.dot(&last_place(&simulation))
        })
        .collect();
    let found = (places[2] - 2.0 * places[1] + places[0]) / 0.04;
    let expected = -2.0 / 3.0 * GRAVITY * 20.0_f64.to_radians().sin();
    assert!((found / expected - 1.0).abs() < 2e-3, "{found}, {expected}");
    let slid = column(&simulation, "dissipated.contact").last().copied().unwrap();
    assert!(slid < 0.02 * 0.1 * GRAVITY * 0.3, "{slid}");
    assert_balanced(&simulation, 1e-9);
}

/// A cylinder on two others rests if the coefficient of friction is above `2 - √3`, the tangent of 15°.
#[test]
fn pile_of_cylinders_stands_above_critical_friction() {
    let (radius, stiffness) = (0.5, 1e6);
    let rest = |friction: f64, end: f64| {
        let mut scene = Scene::new("pile");
        scene.gravity = at(0.0, -GRAVITY);
        let places = [at(0.0, 0.5), at(1.0, 0.5), at(0.5, 0.5 + 0.75_f64.sqrt())];
        let pile = places.map(|place| {
            ContactTarget::Point(disc(&mut scene, place, at(0.0, 0.0), [1.0, radius]))
        });
        let floor = wall(at(0.0, 0.0), at(0.0, 1.0), stiffness, 0.3);
        scene.add_obstacle(Obstacle { friction, radius, targets: pile.to_vec(), ..floor }).unwrap();
        let contact = touching(&pile, stiffness, radius);
        scene.add_contact(PairContact { restitution: 0.3, friction, ..contact }).unwrap();
        let mut simulation = simulate(scene, Method::EnergyMomentum, 0.002, 1.0);
        let before = last_place(&simulation);
        run(&mut simulation, end).unwrap();
        assert_balanced(&simulation, 1e-9);
        (last_place(&simulation), last_place(&simulation) - before)
    };
    let critical = 2.0 - 3.0_f64.sqrt();
    let (place, creep) = rest(1.05 * critical, 2.0);
    assert!((place.y - 0.5 - 0.75_f64.sqrt()).abs() < 1e-3 && creep.norm() < 1e-12, "{creep:?}");
    let (place, _) = rest(0.93 * critical, 2.0);
    assert!(place.y < 1.0, "{place:?}");
}

#[test]
fn friction_of_two_particles_and_of_time_reversing_methods_is_rejected() {
    let mut scene = Scene::new("refused");
    let stations = [at(0.0, 0.0), at(2.0, 0.0)].map(|position| block_named(&mut scene, position));
    let targets = stations.map(ContactTarget::Point);
    let contact = touching(&targets, 1e4, 0.1);
    let refused = scene.add_contact(PairContact { friction: 0.3, ..contact }).unwrap_err();
    assert!(refused.to_string().contains("do not rotate"), "{refused}");
    let (scene, _) = slope(30.0, &block, 0.2);
    let refused = Simulation::start(scene, settings(Method::FourthOrder, 0.01)).err().unwrap();
    assert!(refused.to_string().contains("contact 'contact' has friction"), "{refused}");
}

fn block_named(scene: &mut Scene, position: Vec2) -> Station {
    let name = format!("block {}", scene.particles.len());
    scene.add_particle(ParticleDefinition { name, position }, 0.1).unwrap()
}
