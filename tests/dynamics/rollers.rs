//! Inclined rollers: rotated scenes, closed forms, reactions, and refused input.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, carriage, point};
use crate::common::roller_scenes::{roller, unit};
use crate::common::scenes::{add_beam, end_of, line, rod, start_of};
use crate::common::{at, run, settings, simulate};
use withy::beams::{Mesh, Station};
use withy::geometry::{Vec2, cross, perpendicular};
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{
    Component, Components, JointKind, Partner, Releasable, Release, SlidingRule, Trigger,
};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{
    Drive, DriveKind, ParticleDefinition, Scene, StationVelocity, System, SystemError,
};
use withy::vibration::Modes;

const ANGLES: [f64; 4] = [0.7, -0.3, 1.2, 2.5];

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn turned(angle: f64, place: Vec2) -> Vec2 {
    unit(angle) * place.x + perpendicular(unit(angle)) * place.y
}

/// Bridge on a hinge and an inclined roller with a body at its end, rotated by an angle. At the angle zero the roller is axis-parallel.
fn bridge(angle: f64) -> Scene {
    let mut scene = Scene::new("bridge");
    let to = turned(angle, at(2.0, 0.0));
    let beam = add_beam(&mut scene, line(Vec2::zeros(), to), &smooth(6), rod());
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    let centre = to + turned(angle, at(0.3, 0.2));
    let body = add_body(&mut scene, centre, angle, (0.8, 0.1), &[at(-0.3, -0.2)]);
    scene.join(JointKind::Rigid, point(body, 1), Partner::Station(end)).unwrap();
    let kind = match angle == 0.0 {
        true => JointKind::Support(Components::Y),
        false => JointKind::InclinedRoller(unit(angle)),
    };
    scene.join(kind, end, Partner::Ground).unwrap();
    let station = scene.station(beam, 0.8).unwrap();
    let force =
        LoadKind::Force { station, force: turned(angle, at(1.0, -4.0)), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    scene.gravity = turned(angle, at(0.5, -3.0));
    scene
}

fn tip(scene: &Scene) -> Station {
    Station::on_beam(0, scene.beams[0].axis.length())
}

fn places(model: &System) -> Vec<Vec2> {
    model.control_points().flatten().copied().collect()
}

#[test]
fn rotated_scene_with_an_inclined_roller_has_the_rotated_motion() {
    for entry in INTEGRATORS {
        let upright = simulate(bridge(0.0), entry.method, 0.05, 3.0);
        let expected = places(upright.model());
        let end = |simulation: &Simulation, station: Station| {
            simulation.scene().place(&station, simulation.model().meshes()).unwrap()
        };
        for angle in ANGLES {
            let mut simulation = simulate(bridge(angle), entry.method, 0.05, 3.0);
            let off = places(simulation.model()).into_iter().zip(&expected);
            let off = off.map(|(own, place)| (own - turned(angle, *place)).norm());
            let worst = off.fold(0.0, f64::max);
            assert!(worst < 1e-9, "{} turned by {angle}: {worst:.1e}", entry.name);
            // The reaction is normal to the rolling direction, and equals the rotated reaction of the unrotated scene.
            let mut upright = simulate(bridge(0.0), entry.method, 0.05, 3.0);
            let reactions = [&mut simulation, &mut upright].map(|one| {
                let place = end(one, tip(one.scene()));
                let now = one.instant().unwrap();
                let scene = one.scene().clone();
                let (force, moment) = one.model().reaction(now.reactions(), &place).unwrap();
                let joint = one.model().transmission(&scene, 2).unwrap().read(now.reactions());
                assert!((joint.0 - force).norm() < 1e-9 && joint.1 == 0.0 && moment == 0.0);
                force
            });
            let [inclined, upright] = reactions;
            assert!(inclined.dot(&unit(angle)).abs() < 1e-12 * inclined.norm(), "{inclined}");
            let off = (inclined - turned(angle, upright)).norm();
            assert!(off < 1e-7 * upright.norm(), "{}: {inclined} {upright}", entry.name);
        }
    }
}

#[test]
fn rotated_scene_has_the_same_equilibrium_and_modes() {
    let rest = |angle: f64| {
        let mut rest = Equilibrium::find(bridge(angle), Loading::default(), &mut |_| true).unwrap();
        let place = rest.scene().place(&tip(rest.scene()), rest.model().meshes()).unwrap();
        let (force, _) = rest.reaction(&place).unwrap();
        let modes = Modes::of(rest.model(), 4, &mut || true).unwrap();
        let squares: Vec<f64> = modes.all().iter().map(|mode| mode.square).collect();
        (places(rest.model()), force, squares)
    };
    let (expected, force, squares) = rest(0.0);
    for angle in ANGLES {
        let (own, own_force, own_squares) = rest(angle);
        for (own, place) in own.iter().zip(&expected) {
            let off = (own - turned(angle, *place)).norm();
            assert!(off < 1e-11, "turned by {angle}: {off:.1e}");
        }
        let off = (own_force - turned(angle, force)).norm();
        assert!(off < 1e-9 * force.norm(), "turned by {angle}: {own_force} {force}");
        for (own, square) in own_squares.iter().zip(&squares) {
            assert!((own / square - 1.0).abs() < 1e-7, "turned by {angle}: {own} {square}");
        }
    }
}

/// For small bending, a beam on a hinge and a roller along its axis is simply supported with a free axial displacement: `ω = (π/L)² √(EI/ρA)`.
#[test]
fn beam_on_a_roller_along_its_axis_has_simply_supported_modes() {
    let mut scene = Scene::new("bridge");
    let (length, mut section) = (40.0, rod());
    section.rotary_inertia = 1e-6;
    (section.axial_stiffness, section.shear_stiffness) = (1e6, 1e6);
    let axis = line(Vec2::zeros(), unit(0.6) * length);
    let beam = add_beam(&mut scene, axis, &smooth(48), section);
    let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    roller(&mut scene, end, 0.6);
    let model = System::assemble(&scene).unwrap();
    let modes = Modes::of(&model, 3, &mut || true).unwrap();
    for (number, mode) in (1..).zip(modes.all()) {
        let wave = f64::from(number) * std::f64::consts::PI / length;
        let expected = wave.powi(4) * section.bending_stiffness / section.mass_per_length;
        assert!(
            (mode.square / expected - 1.0).abs() < 1e-5,
            "{number}: {} {expected}",
            mode.square
        );
    }
}

fn cart(angle: f64) -> Scene {
    let mut scene = Scene::new("cart");
    let cart = ParticleDefinition { name: "cart".to_owned(), position: at(1.0, 2.0) };
    let cart = scene.add_particle(cart, 2.0).unwrap();
    roller(&mut scene, cart, angle);
    scene.gravity = at(0.0, -9.81);
    scene
}

#[test]
fn cart_on_a_slope_has_the_exact_acceleration_and_reaction() {
    for entry in INTEGRATORS {
        for angle in ANGLES {
            let mut simulation = simulate(cart(angle), entry.method, 0.05, 2.0);
            let expected = at(1.0, 2.0) - unit(angle) * (0.5 * 9.81 * angle.sin() * 4.0);
            let place = places(simulation.model())[0];
            assert!((place - expected).norm() < 1e-12 * expected.norm(), "{place} {expected}");
            let own = simulation.scene().place(&Station::on_particle(0), &[]).unwrap();
            let now = simulation.instant().unwrap();
            let (force, _) = simulation.model().reaction(now.reactions(), &own).unwrap();
            let across = perpendicular(unit(angle));
            assert!((force - across * (2.0 * 9.81 * angle.cos())).norm() < 1e-12 * 20.0, "{force}");
            for (name, invariant) in Invariant::ALL {
                let drift = simulation.history().drift(invariant);
                assert!(drift < 1e-13, "{}, {name}: {drift:.1e}", entry.name);
            }
        }
    }
}

#[test]
fn released_roller_leaves_a_body_in_free_flight() {
    let mut scene = cart(0.6);
    scene
        .add_release(Release { object: Releasable::Joint(0), trigger: Trigger::Time(1.0) })
        .unwrap();
    let simulation = simulate(scene, Method::EnergyMomentum, 0.1, 2.0);
    let down = unit(0.6) * (-9.81 * 0.6_f64.sin());
    let expected = at(1.0, 2.0) + down * 1.5 + at(0.0, -9.81) * 0.5;
    let place = places(simulation.model())[0];
    assert!((place - expected).norm() < 1e-12 * expected.norm(), "{place} {expected}");
}

#[test]
fn inclined_roller_transmits_impulses_to_the_ground() {
    let mut scene = carriage(&smooth(6), SlidingRule::Conserving);
    let end = scene.joints.remove(1).station;
    roller(&mut scene, end, 0.5);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
    run(&mut simulation, 4.0).unwrap();
    let bounced = simulation.history().column("dt").unwrap().iter().any(|dt| *dt < 0.0099);
    assert!(bounced, "no wheel came to an end");
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-11, "{name}: {drift:.1e}");
    }
    let tip = *simulation.model().control_points().next().unwrap().last().unwrap();
    let off = cross(unit(0.5), tip - at(6.0, 0.0));
    assert!(off.abs() < 1e-12 && tip.x < 6.0, "{tip}: {off:.1e}");
}

#[test]
fn redundant_supports_are_rejected() {
    let supported = |kinds: &[JointKind]| -> Result<(), SystemError> {
        let mut scene = Scene::new("bridge");
        let beam = add_beam(&mut scene, line(Vec2::zeros(), at(2.0, 0.0)), &smooth(4), rod());
        let end = end_of(&mut scene, beam);
        kinds.iter().try_for_each(|kind| scene.join(*kind, end, Partner::Ground))
    };
    let along = |angle: f64| JointKind::InclinedRoller(unit(angle));
    let (x, y) = (JointKind::Support(Components::X), JointKind::Support(Components::Y));
    for kinds in [
        vec![along(0.3), along(0.3)],
        vec![along(0.3), along(0.3 + std::f64::consts::PI)],
        vec![along(0.3), along(0.4), along(0.5)],
        vec![JointKind::Rigid, along(0.3)],
        vec![along(0.3), JointKind::Hinge],
        vec![x, along(0.3), y],
    ] {
        let refused = supported(&kinds);
        assert!(matches!(refused, Err(SystemError::AlreadyTied { .. })), "{kinds:?}: {refused:?}");
    }
    supported(&[along(0.3), along(0.4)]).unwrap();
    supported(&[along(0.3), JointKind::Support(Components::Rotation)]).unwrap();
    // Three rollers at points of one body whose normals meet in one point: the body is overconstrained, and can still rotate about this point.
    let mut scene = Scene::new("wheel");
    let points = [at(1.0, 0.0), at(0.0, 1.0), at(-1.0, 0.0)];
    let body = add_body(&mut scene, at(0.0, 0.0), 0.2, (1.0, 0.2), &points);
    for (number, angle) in [(1, 0.2), (2, 0.2 + 1.5), (3, 0.2)] {
        roller(&mut scene, point(body, number), angle);
    }
    assert!(System::assemble(&scene).is_ok());
    let mut scene = Scene::new("wheel");
    let body = add_body(&mut scene, at(0.0, 0.0), 0.2, (1.0, 0.2), &points);
    for number in 1..=3 {
        let arm = scene.drawn_at(&point(body, number)).unwrap();
        let along = perpendicular(arm);
        scene.join(JointKind::InclinedRoller(along), point(body, number), Partner::Ground).unwrap();
    }
    let refused = System::assemble(&scene).map(|_| ());
    assert!(matches!(refused, Err(SystemError::AlreadyTied { .. })), "{refused:?}");
}

#[test]
fn velocities_and_motions_normal_to_a_roller_are_rejected() {
    let mut scene = cart(0.5);
    let station = Station::on_particle(0);
    scene.velocities.push(StationVelocity { station, velocity: at(1.0, 0.0), spin: None });
    let refused = System::assemble(&scene).map(|_| ());
    assert!(matches!(refused, Err(SystemError::StartVelocity { .. })), "{refused:?}");
    let mut scene = cart(0.5);
    let rest = PrescribedMotion::Position(Schedule::constant(0.0).unwrap());
    let mut motions = [None, None, None];
    motions[Component::X as usize] = Some(rest);
    let (name, kind) = ("push".to_owned(), DriveKind::Move);
    let refused = scene.add_drive(Drive { name, kind, station, motions });
    assert!(matches!(refused, Err(SystemError::AlreadyDriven { .. })), "{refused:?}");
}
