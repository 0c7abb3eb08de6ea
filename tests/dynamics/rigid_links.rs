//! Rigid links: tangent, balances, reactions of joints on bodies, and refused input.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, hinge, point};
use crate::common::probe::{STEP, condensed, differences, settle, tangent};
use crate::common::scenes::{add_beam, end_of, line, rod, start_of};
use crate::common::{Random, at, body_scenes, meshes, run, scenes, settings, simulate};
use withy::beams::{Mesh, Station};
use withy::geometry::{Vec2, cross};
use withy::integrators::{EnergyClaim, INTEGRATORS, Mechanism, Method, Stage};
use withy::joints::{EndAction, JointKind, Partner, SlidingRule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Anchor, Origin, PointMass, Scene, Spring, SpringKind, SpringLaw, StartMotion, StationVelocity,
    System, SystemError,
};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

#[test]
fn tangent_is_the_derivative_of_forces_and_positions() {
    let mut random = Random(20);
    for (name, mesh) in meshes(4) {
        // Piecewise linear laws have no derivative at their corners.
        let is_smooth = |scene: &Scene| scene.springs().all(|at| at.damping.corners().is_empty());
        for scene in body_scenes::all(&mesh).into_iter().filter(is_smooth) {
            let mut model = System::assemble(&scene).unwrap();
            let increments = random.vector(model.unknowns(), 0.2);
            for stage in [Stage::Midpoint, Stage::DampedMidpoint(0.6), Stage::End] {
                model.begin_step(STEP, &Stage::ALL).unwrap();
                settle(&mut model, stage, &increments);
                let found = tangent(&mut model, stage, &increments);
                let forces = &mut |u: &[f64]| condensed(&mut model, stage, u);
                let expected = differences(&increments, 1e-3, forces);
                let expected = expected.rows(0, increments.len()).into_owned();
                let error = (found - &expected).amax() / expected.amax();
                assert!(error < 1e-8, "{} on {name}, {stage:?}: {error:.1e}", scene.name);
            }
        }
    }
}

#[test]
fn unclaimed_invariants_of_rigid_links_are_not_conserved() {
    for entry in INTEGRATORS {
        let drift = |scene: Scene, invariant| {
            simulate(scene, entry.method, 0.05, 3.0).history().drift(invariant)
        };
        if entry.claims.energy == EnergyClaim::Unclaimed {
            let energy = drift(body_scenes::double_pendulum(), Invariant::Energy);
            assert!(energy > 1e-4, "{}: {energy:.1e}", entry.name);
        }
        if !entry.claims.angular_momentum {
            let momentum = drift(body_scenes::dumbbell(&smooth(4)), Invariant::AngularMomentum);
            assert!(momentum > 1e-5, "{}: {momentum:.1e}", entry.name);
        }
        // Numerical damping acts on strains only, so rigid bodies are not damped.
        let decays = entry.claims.energy == EnergyClaim::NonIncreasing;
        if decays {
            let energy = drift(body_scenes::double_pendulum(), Invariant::Energy);
            assert!(energy < 1e-12, "{}: {energy:.1e}", entry.name);
        }
    }
}

#[test]
fn carriage_with_sliding_and_bouncing_wheels_conserves_all_invariants() {
    for rule in [SlidingRule::Conserving, SlidingRule::Exact] {
        let scene = body_scenes::carriage(&smooth(6), rule);
        let mut simulation =
            Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
        run(&mut simulation, 4.0).unwrap();
        let bounced = simulation.history().column("dt").unwrap().iter().any(|dt| *dt < 0.0099);
        assert!(bounced, "no wheel came to an end");
        for (name, invariant) in Invariant::ALL {
            let drift = simulation.history().drift(invariant);
            let is_kept =
                rule == SlidingRule::Conserving || invariant != Invariant::AngularMomentum;
            assert!(!is_kept || drift < 1e-11, "{rule:?}, {name}: {drift:.1e}");
        }
    }
}

/// The present reactions of joints balance the weight and the inertia of a body.
#[test]
fn joint_forces_agree_with_the_accelerations_of_a_body() {
    let mut scene = body_scenes::dumbbell(&smooth(6));
    scene.elements.retain(|element| matches!(element, withy::system::Element::PointMass(_)));
    let fixed = 1;
    let mut simulation = simulate(scene, Method::EnergyMomentum, 0.01, 0.5);
    let scene = simulation.scene().clone();
    let place = |simulation: &Simulation, station: &Station| {
        scene.place(station, simulation.model().meshes()).unwrap()
    };
    let [centre, held] = [point(fixed, 0), point(fixed, 1)].map(|at| place(&simulation, &at));
    let rigid = simulation.model().transmission(&scene, 1).unwrap();
    let now = simulation.instant().unwrap();
    let (force, moment) = rigid.read(now.reactions());
    let model = simulation.model();
    let acceleration = model.acceleration(&now, &centre);
    let inertia = (1.2 * acceleration).norm();
    assert!((force - 1.2 * acceleration).norm() < 1e-10 * inertia, "{force} {acceleration}");
    let arm = model.position(&held) - model.position(&centre);
    // The acceleration of the point gives the angular acceleration: a_p - a_c = α J r - ω² r.
    let relative = model.acceleration(&now, &held) - acceleration;
    let spin = model.spin(&centre);
    let turning = cross(arm, relative) / arm.norm_squared();
    let inward = -relative.dot(&arm) / arm.norm_squared();
    assert!((inward - spin * spin).abs() < 1e-9 * spin * spin, "{inward} {spin}");
    let sum = moment + cross(arm, force) - 0.2 * turning;
    assert!(sum.abs() < 1e-10 * moment.abs().max(inertia), "{sum:e} {moment}");
}

#[test]
fn clamp_at_a_point_transmits_the_moment_of_the_body() {
    let mut scene = Scene::new("bracket");
    let body = add_body(&mut scene, at(1.0, 0.5), 0.3, (2.0, 0.1), &[at(-0.4, 0.1), at(0.3, 0.0)]);
    let beam = scenes::add_beam(
        &mut scene,
        scenes::line(at(4.0, 0.0), at(5.0, 0.0)),
        &smooth(3),
        scenes::spaghetti_section(1e4, 100.0),
    );
    let end = scenes::start_of(&mut scene, beam);
    scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
    scene.join(JointKind::Rigid, point(body, 1), Partner::Ground).unwrap();
    scene.gravity = at(0.0, -10.0);
    let mut simulation = simulate(scene, Method::EnergyMomentum, 0.1, 0.2);
    let scene = simulation.scene().clone();
    let at_point = scene.place(&point(body, 1), simulation.model().meshes()).unwrap();
    let joint = simulation.model().transmission(&scene, 1).unwrap();
    let now = simulation.instant().unwrap();
    let arm = at(1.0, 0.5) - simulation.model().position(&at_point);
    let expected = (at(0.0, 20.0), 20.0 * arm.x);
    for (force, moment) in [
        simulation.model().reaction(now.reactions(), &at_point).unwrap(),
        joint.read(now.reactions()),
    ] {
        assert!((force - expected.0).norm() < 1e-12 && (moment - expected.1).abs() < 1e-12);
    }
}

#[test]
fn redundant_supports_of_a_body_are_rejected_by_name() {
    let held = |points: &[Station]| {
        let mut scene = Scene::new("held");
        add_body(&mut scene, at(0.0, 0.0), 0.4, (1.0, 0.1), &[at(-0.5, 0.0), at(0.5, 0.2)]);
        scene.gravity = at(0.0, -1.0);
        points.iter().for_each(|station| hinge(&mut scene, *station, None));
        System::assemble(&scene).map(|_| ())
    };
    assert!(held(&[point(0, 1)]).is_ok());
    for points in [[point(0, 1), point(0, 2)], [point(0, 0), point(0, 2)]] {
        let error = held(&points).unwrap_err();
        assert_eq!(error, SystemError::HeldTwice { body: "body1".to_owned() }, "{error}");
    }
    // A chain of a hundred bodies is not overconstrained.
    assert!(System::assemble(&body_scenes::chain(100)).is_ok());
    // A parallel linkage is overconstrained, although none of its bars is alone.
    let mut scene = Scene::new("parallel bars");
    let across = add_body(
        &mut scene,
        at(1.0, 1.0),
        0.0,
        (1.0, 0.1),
        &[at(-1.0, 0.0), at(0.1, 0.0), at(1.0, 0.0)],
    );
    for (number, x) in [(1, 0.0), (2, 1.1), (3, 2.0)] {
        let bar = add_body(&mut scene, at(x, 0.5), 0.0, (1.0, 0.1), &[at(0.0, -0.5), at(0.0, 0.5)]);
        hinge(&mut scene, point(bar, 1), None);
        hinge(&mut scene, point(bar, 2), Some(point(across, number)));
    }
    assert!(matches!(System::assemble(&scene), Err(SystemError::HeldTwice { .. })));
}

#[test]
fn invalid_numbers_and_names_of_a_body_are_rejected() {
    let definition = |name: &str, points: &[(&str, Vec2)]| withy::system::RigidBodyDefinition {
        name: name.to_owned(),
        position: Vec2::zeros(),
        angle: 0.0,
        points: points.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect(),
        outline: Vec::new(),
        motion: withy::system::StartMotion::default(),
    };
    let mut scene = Scene::new("wrong");
    for (mass, inertia) in
        [(0.0, 0.0), (-1.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)]
    {
        let error = scene.add_rigid_body(definition("hub", &[]), mass, inertia).unwrap_err();
        assert!(matches!(error, SystemError::Value { .. }), "{error}");
        assert!(scene.rigid_bodies.is_empty() && scene.elements.is_empty());
    }
    let twice = definition("hub", &[("a", Vec2::x()), ("a", Vec2::y())]);
    let error = scene.add_rigid_body(twice, 1.0, 1.0).unwrap_err();
    assert!(matches!(error, SystemError::DuplicateName { kind: "point", .. }), "{error}");
    let elsewhere = definition("hub", &[("centre", Vec2::x())]);
    let error = scene.add_rigid_body(elsewhere, 1.0, 1.0).unwrap_err();
    assert!(error.to_string().contains("this is the name of the centre of mass"), "{error}");
    let lost = definition("hub", &[("a", at(f64::NAN, 0.0))]);
    assert!(scene.add_rigid_body(lost, 1.0, 1.0).is_err());
    let hub = scene.add_rigid_body(definition("hub", &[("a", Vec2::x())]), 1.0, 0.0).unwrap();
    assert_eq!(scene.point_of_body(hub, "a").unwrap(), point(hub, 1));
    let error = scene.point_of_body(hub, "b").unwrap_err();
    assert_eq!(error.to_string(), "body 'hub' has no point 'b'; it has 'a'");
    let again = scene.add_rigid_body(definition("hub", &[]), 1.0, 1.0).unwrap_err();
    assert!(matches!(again, SystemError::DuplicateName { .. }), "{again}");
    // A point of a body may have inertia without mass, but not zero mass and zero inertia.
    let station = point(hub, 1);
    scene.add_mass(PointMass { station, mass: 0.0, rotary_inertia: 0.1 }).unwrap();
    assert!(scene.add_mass(PointMass { station, mass: 0.0, rotary_inertia: 0.0 }).is_err());
    scene.velocities.push(StationVelocity { station, velocity: Vec2::x(), spin: None });
    assert!(matches!(System::assemble(&scene), Err(SystemError::PointAlone { .. })));
}

#[test]
fn start_velocities_must_fit_the_joints() {
    let mut scene = body_scenes::pendulum(0.2, 0.8, 1.0);
    scene.rigid_bodies[0].motion.spin = 2.0;
    let error = System::assemble(&scene).err().unwrap();
    assert!(matches!(error, SystemError::StartVelocity { .. }), "{error}");
    scene.rigid_bodies[0].motion.centre = Some(Vec2::zeros());
    let mut model = System::assemble(&scene).unwrap();
    let energy = model.measure().energy.kinetic;
    assert!((energy - 0.5 * (0.2 + 0.64) * 4.0).abs() < 1e-14, "{energy}");
}

#[test]
fn inverted_pendulum_diverges_and_reading_it_changes_nothing() {
    // (I + m l²) λ² = m g l - k, with k chosen such that λ = 1.
    let (inertia, arm) = (0.5, 1.5);
    let mut scene = body_scenes::pendulum(inertia, arm, std::f64::consts::PI);
    let stiffness = 9.81 * arm - (inertia + arm * arm);
    let station = scene.point_of_body(0, "a").unwrap();
    let spring = Spring {
        name: "soft".to_owned(),
        kind: SpringKind::Torsion([Anchor::Ground(at(0.0, 0.0)), Anchor::Station(station)]),
        law: Some(SpringLaw::Linear { stiffness, natural: 0.0 }),
        origin: Origin::AsBuilt,
        damping: 0.0.into(),
        rest: None,
    };
    scene.add_spring(spring).unwrap();
    scene.rigid_bodies[0].motion.spin = 1e-3;
    scene.rigid_bodies[0].motion.centre = Some(Vec2::zeros());
    let mut simulation =
        Simulation::start(scene.clone(), settings(Method::EnergyMomentum, 0.01)).unwrap();
    let growth = |simulation: &mut Simulation| {
        simulation.modes(1, &mut || true).unwrap().all()[0].growth_rate()
    };
    let at_start = growth(&mut simulation);
    assert!((at_start - 1.0).abs() < 1e-5, "{at_start}");
    run(&mut simulation, 0.05).unwrap();
    let later = growth(&mut simulation);
    assert!((later - 1.0).abs() < 1e-5, "{later}");
    run(&mut simulation, 0.1).unwrap();
    let mut unseen = simulate(scene, Method::EnergyMomentum, 0.01, 0.05);
    run(&mut unseen, 0.1).unwrap();
    assert!(simulation.model().control_points().eq(unseen.model().control_points()));
}

#[test]
fn slider_on_a_body_point_may_leave_its_beam() {
    let mut scene = body_scenes::carriage(&smooth(6), SlidingRule::Conserving);
    scene.sliders.iter_mut().for_each(|slider| slider.ends = EndAction::Release);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.02, 6.0);
    let [one, other] = [0, 1].map(|slider| simulation.model().slider_state(slider));
    assert!(
        one != withy::system::SliderState::Sliding || other != withy::system::SliderState::Sliding
    );
    assert!(simulation.history().drift(Invariant::Energy) < 1e-11);
}

/// A moving body is hinged to the end of a beam at rest. The start velocity of this node alone must equal that of the point of the body.
#[test]
fn moving_body_sets_the_joined_end_of_a_beam_in_motion() {
    let struck = |node: Vec2| {
        let mut scene = Scene::new("vault");
        let axis = line(at(0.0, 0.0), at(4.0, 2.0));
        let beam = add_beam(&mut scene, axis, &smooth(8), rod());
        let (start, end) = (start_of(&mut scene, beam), end_of(&mut scene, beam));
        hinge(&mut scene, start, None);
        let body = add_body(&mut scene, at(4.0, 1.0), 0.0, (8.0, 1.0), &[at(0.0, 1.0)]);
        scene.rigid_bodies[body].motion =
            StartMotion { velocity: at(-3.0, 1.0), spin: 0.5, centre: None };
        hinge(&mut scene, end, Some(point(body, 1)));
        let velocity = StationVelocity { station: end, velocity: node, spin: None };
        scene.velocities.push(velocity);
        scene
    };
    let error = System::assemble(&struck(at(-3.0, 1.0))).err().unwrap();
    assert!(matches!(error, SystemError::StartVelocity { .. }), "{error}");
    let simulation = simulate(struck(at(-3.5, 1.0)), Method::EnergyMomentum, 0.005, 0.5);
    let begun = simulation.history().samples()[0].measures;
    // Kinetic energy of the body, and the small one of the beam node.
    assert!((begun.energy.kinetic - (40.0 + 0.125)).abs() < 2.0, "{}", begun.energy.kinetic);
    for (name, invariant) in Invariant::ALL {
        let drift = simulation.history().drift(invariant);
        assert!(drift < 1e-12, "{name}: {drift:.1e}");
    }
}
