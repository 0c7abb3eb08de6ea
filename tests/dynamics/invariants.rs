//! Claimed invariants of every integrator, on every mesh and scene. Invariants that are not claimed are shown to drift.
#![allow(clippy::unwrap_used)]

use crate::common::{
    assert_energy_never_grows, at, body_scenes, energies, meshes, run, scenes, settings, simulate,
};
use withy::beams::{Mesh, SectionVariation};
use withy::geometry::Vec2;
use withy::integrators::{EnergyClaim, INTEGRATORS, Interval, Method};
use withy::joints::JointKind;
use withy::loads::{LoadKind, PrescribedMotion, Schedule};
use withy::newton::Tolerance;
use withy::simulation::{History, Invariant, Simulation, SimulationError};
use withy::system::{
    DampingLaw, Dragged, DriveKind, Element, Origin, Scene, Spring, SpringKind, SpringLaw, System,
};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn assert_kept(label: &str, history: &History, invariant: Invariant, tolerance: f64) -> f64 {
    let drift = history.drift(invariant);
    assert!(drift <= tolerance, "{label}: {invariant:?} drifts by {drift:.1e}");
    drift
}

#[test]
fn claimed_invariants_hold_on_every_mesh_and_scene() {
    for entry in INTEGRATORS {
        let claims = [
            (Invariant::Energy, entry.claims.energy == EnergyClaim::Conserved),
            (Invariant::Momentum, entry.claims.momentum),
            (Invariant::AngularMomentum, entry.claims.angular_momentum),
            (Invariant::Gap, true),
        ];
        let mut worst = [f64::NAN; 4];
        for (mesh_name, mesh) in meshes(6) {
            let has_friction = entry.method != Method::FourthOrder;
            let friction = if has_friction { 0.1 } else { 0.0 };
            let all = scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh));
            for scene in all.chain([scenes::crowded(&mesh, friction)]) {
                let label = format!("{}, {}, {mesh_name}", entry.name, scene.name);
                let simulation = simulate(scene, entry.method, 0.1, 7.5);
                for (worst, (invariant, _)) in
                    worst.iter_mut().zip(claims).filter(|(_, (_, claimed))| *claimed)
                {
                    let drift = assert_kept(&label, simulation.history(), invariant, 1e-12);
                    *worst = worst.max(drift);
                }
                if entry.claims.energy == EnergyClaim::NonIncreasing {
                    assert_energy_never_grows(&label, simulation.history());
                }
            }
        }
        println!(
            "{:16} worst drift of E, p, L, gap where claimed: {}",
            entry.name,
            crate::common::sci(&worst)
        );
    }
}

#[test]
fn unclaimed_invariants_are_not_conserved() {
    for entry in INTEGRATORS {
        let simulation = simulate(scenes::spaghetti(&smooth(14), 1e4), entry.method, 0.1, 7.5);
        let drift = |invariant| simulation.history().drift(invariant);
        if entry.claims.energy != EnergyClaim::Conserved {
            assert!(drift(Invariant::Energy) > 1e-4, "{}", entry.name);
        }
        if entry.claims.energy == EnergyClaim::Unclaimed {
            let energies = energies(simulation.history());
            assert!(energies.windows(2).any(|pair| pair[1] > pair[0] + 1e-4), "{}", entry.name);
        }
        if !entry.claims.momentum {
            let pushed =
                simulate(scenes::smooth_spaghetti(&smooth(14), 100.0), entry.method, 0.1, 7.5);
            let drift = pushed.history().drift(Invariant::Momentum);
            assert!(drift > 1e-4, "{}: {drift:e}", entry.name);
        }
        if !entry.claims.angular_momentum {
            assert!(drift(Invariant::AngularMomentum) > 1e-4, "{}", entry.name);
        }
    }
}

#[test]
fn energy_and_momenta_are_constant_from_the_start_at_any_step_size() {
    for dt in [0.05, 0.1, 0.2] {
        for (name, mesh) in meshes(14) {
            let flight = simulate(scenes::spaghetti(&mesh, 1e4), Method::EnergyMomentum, dt, 7.5);
            let drifts = Invariant::ALL.map(|(_, invariant)| {
                assert_kept(&format!("{name}, dt = {dt}"), flight.history(), invariant, 1e-12)
            });
            println!(
                "dt = {dt:4} {name:20} drifts of E, p, L, gap {}",
                crate::common::sci(&drifts)
            );
        }
    }
}

#[test]
fn energy_and_momenta_are_constant_for_a_thousand_units_of_time() {
    let flight = simulate(scenes::spaghetti(&smooth(14), 1e4), Method::EnergyMomentum, 0.1, 1000.0);
    let drifts = Invariant::ALL
        .map(|(_, invariant)| assert_kept("1000 units", flight.history(), invariant, 1e-12));
    println!(
        "after {} steps: drifts of E, p, L, gap {}",
        flight.counts().steps,
        crate::common::sci(&drifts)
    );
}

#[test]
fn energy_is_constant_a_hundred_million_lengths_from_the_origin() {
    let load = Schedule::hold_for(2.5).unwrap();
    let section = scenes::spaghetti_section(1e4, 100.0);
    let scene = scenes::thrown(&smooth(14), section, load, at(1e8, 1e8));
    let far = simulate(scene, Method::EnergyMomentum, 0.1, 7.5);
    let near = simulate(scenes::spaghetti(&smooth(14), 1e4), Method::EnergyMomentum, 0.1, 7.5);
    // Positions at this distance are multiples of 1.5e-8, so the initial geometry is rounded, but the motion is not.
    let drift = assert_kept("far away", far.history(), Invariant::Energy, 1e-12);
    assert_kept("far away", far.history(), Invariant::Momentum, 1e-12);
    let energy = |s: &Simulation| s.history().samples().last().unwrap().measures.energy.total();
    let difference = (energy(&far) / energy(&near) - 1.0).abs();
    println!("far away: energy drift {drift:.1e}, energy differs by {difference:.1e}");
    assert!(difference < 1e-6);
}

fn is_finite(history: &History) -> bool {
    let row = |sample| History::COLUMNS.iter().all(|column| (column.value)(sample).is_finite());
    history.samples().iter().all(row)
}

/// Runs a scene that must fail after `good` steps. The previous steps must be conserved and finite.
fn assert_fails_cleanly(scene: withy::system::Scene, dt: f64, good: usize) -> SimulationError {
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
    let error = run(&mut simulation, 10.0 * dt).expect_err("an absurd load cannot be balanced");
    assert!(simulation.history().samples().len() > good, "{error}");
    assert!(is_finite(simulation.history()), "{error}");
    assert!(
        simulation.model().control_points().flatten().all(|p| p.x.is_finite() && p.y.is_finite())
    );
    error
}

#[test]
fn extreme_load_is_an_error_and_history_is_kept() {
    for magnitude in [1e155, 1e300] {
        let mut scene = scenes::spaghetti(&smooth(8), 1e4);
        let station = scenes::end_of(&mut scene, 0);
        let late = Schedule::pulse(0.5, 100.0).unwrap();
        scene.add_load(LoadKind::Moment { station, moment: magnitude }, late);
        let error = assert_fails_cleanly(scene, 0.1, 5);
        println!("{error}");
        assert!(
            matches!(error, SimulationError::Step { time, .. } if (time - 0.5).abs() < 1e-9),
            "{error}"
        );
    }
}

#[test]
fn extreme_step_size_is_an_error_and_history_is_kept() {
    let error = assert_fails_cleanly(scenes::spaghetti(&smooth(8), 1e4), 1e200, 0);
    assert!(matches!(error, SimulationError::Step { .. }), "{error}");
}

#[test]
fn half_a_turn_per_step_is_retried_in_smaller_steps() {
    for method in [Method::EnergyMomentum, Method::FourthOrder] {
        let mut scene = scenes::free_beam(&smooth(8), scenes::spaghetti_section(1e6, 100.0));
        scene.beams[0].motion.spin = 9.0;
        let flight = simulate(scene, method, 0.8, 8.0);
        let counts = flight.counts();
        assert!(counts.retries > 0 && counts.steps > 10, "{counts:?}");
        let noted: usize = flight.history().samples().iter().map(|row| row.retries).sum();
        assert_eq!(noted, counts.retries);
        for (_, invariant) in Invariant::ALL {
            assert_kept("spun", flight.history(), invariant, 1e-12);
        }
        println!(
            "{method:?}, spun by 7.2 rad a step: {} steps instead of 10, {} retries",
            counts.steps, counts.retries
        );
    }
}

#[test]
fn restored_state_continues_bit_for_bit() {
    for entry in INTEGRATORS {
        for scene in scenes::all(&smooth(6)).into_iter().chain(body_scenes::all(&smooth(6))) {
            let mut model = System::assemble(&scene).unwrap();
            let mut integrator = entry.method.build(&mut model, Tolerance::default());
            let mut advance = |model: &mut System, steps: std::ops::Range<u32>| {
                for n in steps {
                    let (start, end) = (f64::from(n) * 0.05, f64::from(n + 1) * 0.05);
                    integrator.step(model, Interval::between(start, end)).unwrap();
                }
            };
            advance(&mut model, 0..10);
            let state = model.state();
            advance(&mut model, 10..20);
            let later = model.state();
            model.restore(&state);
            assert_eq!(model.state(), state, "{}, {}", entry.name, scene.name);
            advance(&mut model, 10..20);
            assert_eq!(model.state(), later, "{}, {}", entry.name, scene.name);
        }
    }
}

/// The scenes for the tests of invariants, archives, rewinding, consistency and memory contain every element type.
#[test]
fn common_scenes_contain_every_kind_of_element() {
    let mesh = smooth(4);
    let all: Vec<Scene> = scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh)).collect();
    let springs = || all.iter().flat_map(Scene::springs);
    let (laws, damping) = (|| springs().map(|one| &one.law), || springs().map(|one| &one.damping));
    let curve = |law: &DampingLaw, is_of: fn(&SpringLaw) -> bool| match law {
        DampingLaw::Curve(curve) => is_of(curve),
        DampingLaw::Linear(_) => false,
    };
    let is_table = |law: &SpringLaw| matches!(law, SpringLaw::Table { .. });
    let is_sampled = |law: &SpringLaw| matches!(law, SpringLaw::Sampled { .. });
    let central = |one: &Spring| {
        let at_ease = matches!(one.law, Some(SpringLaw::Linear { natural: 0.0, .. }));
        at_ease && one.damping.is_active() && one.origin == Origin::Zero
    };
    let joints = || all.iter().flat_map(|scene| &scene.joints).map(|joint| joint.kind);
    let drives = || all.iter().flat_map(|scene| &scene.drives);
    let motions = || drives().flat_map(|drive| drive.motions.iter().flatten());
    let drags = || all.iter().flat_map(Scene::drags);
    let elements = || all.iter().flat_map(|scene| &scene.elements);
    let found = [
        ("a linear spring", laws().flatten().any(|law| matches!(law, SpringLaw::Linear { .. }))),
        ("a table", laws().flatten().any(is_table)),
        ("a function", laws().flatten().any(is_sampled)),
        ("a damper alone", laws().any(Option::is_none)),
        ("a damped spring without length", springs().any(central)),
        ("a damper by a table", damping().any(|law| curve(law, is_table))),
        ("a damper by a function", damping().any(|law| curve(law, is_sampled))),
        ("a torsion spring", springs().any(|one| matches!(one.kind, SpringKind::Torsion(_)))),
        ("a tendon", springs().any(|one| one.anchors().len() > 2)),
        ("drag of a beam", drags().any(|drag| matches!(drag.on, Dragged::Beam { .. }))),
        ("drag of a point", drags().any(|drag| matches!(drag.on, Dragged::Point { .. }))),
        ("wind", drags().any(|drag| drag.wind != Vec2::zeros())),
        ("a damped material", elements().any(|one| matches!(one, Element::Damping(_)))),
        ("a taper", {
            let mut beams = all.iter().flat_map(|scene| &scene.beams);
            beams.any(|beam| !matches!(beam.section, SectionVariation::Uniform(_)))
        }),
        ("a motor", drives().any(|drive| drive.kind == DriveKind::Motor)),
        ("a move", drives().any(|drive| drive.kind == DriveKind::Move)),
        ("a place", motions().any(|motion| matches!(motion, PrescribedMotion::Position(_)))),
        ("a speed", motions().any(|motion| matches!(motion, PrescribedMotion::Rate(_)))),
        ("a torque", {
            let mut loads = all.iter().flat_map(Scene::loads);
            loads.any(|load| matches!(load.kind, LoadKind::Moment { .. }))
        }),
        ("a roller", joints().any(|kind| matches!(kind, JointKind::Support(_)))),
        ("an inclined roller", joints().any(|kind| matches!(kind, JointKind::InclinedRoller(_)))),
        ("an inclined guide", joints().any(|kind| matches!(kind, JointKind::InclinedGuide(_)))),
        ("a body with points", {
            let mut bodies = all.iter().flat_map(|scene| &scene.rigid_bodies);
            bodies.any(|body| !body.points.is_empty())
        }),
        ("a release", all.iter().any(|scene| !scene.releases.is_empty())),
    ];
    let missing: Vec<&str> = found.iter().filter(|(_, is)| !is).map(|(what, _)| *what).collect();
    assert!(missing.is_empty(), "no scene has {}", missing.join(", "));
}
