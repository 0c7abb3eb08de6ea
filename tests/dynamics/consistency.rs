//! Consistency of forces, their derivatives, energies and inertia for every mesh, joint, mass and load.
#![allow(clippy::unwrap_used)]

use crate::common::probe::{self, STEP, advance, condensed, differences, settle, tangent};
use crate::common::{Random, at, meshes, scenes};
use nalgebra::{DMatrix, DVector};
use withy::beams::Station;
use withy::geometry::Vec2;
use withy::integrators::{Forces, Inertia, Mechanism, Solution, Stage};
use withy::loads::{LoadFrame, LoadKind};
use withy::system::{
    ContactTarget, Element, Obstacle, ObstacleShape, ParticleDefinition, RigidBodyDefinition,
    Scene, StartMotion, System,
};

const STAGES: [Stage; 3] = [Stage::Midpoint, Stage::DampedMidpoint(0.6), Stage::End];

/// Checks every scene on every mesh, each at a random state with random increments.
fn for_all(mut check: impl FnMut(&str, &Scene, &mut System, &[f64])) {
    let mut random = Random(20);
    for (name, mesh) in meshes(4) {
        for scene in scenes::all(&mesh) {
            let mut model = System::assemble(&scene).unwrap();
            let first = random.vector(model.unknowns(), 0.2);
            advance(&mut model, Stage::Midpoint, &first);
            let increments = random.vector(model.unknowns(), 0.2);
            model.begin_step(STEP, &Stage::ALL).unwrap();
            check(&format!("{} on {name}", scene.name), &scene, &mut model, &increments);
        }
    }
}

fn assert_close(what: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64) {
    let error = (found - expected).amax() / expected.amax();
    assert!(error < tolerance, "{what}: off by {error:.1e} of the largest entry");
}

#[test]
fn the_tangent_is_the_derivative_of_the_condensed_forces() {
    for_all(|name, _, model, increments| {
        for stage in STAGES {
            settle(model, stage, increments);
            let found = tangent(model, stage, increments);
            let expected = differences(increments, 1e-3, &mut |u| condensed(model, stage, u))
                .rows(0, increments.len())
                .into_owned();
            assert_close(&format!("{name}, {stage:?}"), &found, &expected, 2e-8);
        }
    });
}

/// Heavy particle and heavy roller that penetrate a wall and a disc, with friction.
fn touching() -> Scene {
    let mut scene = Scene::new("touching");
    let ball = ParticleDefinition { name: "ball".into(), position: at(0.4, 0.3) };
    scene.add_particle(ball, 1e4).unwrap();
    let roller = RigidBodyDefinition {
        name: "roller".into(),
        position: at(-0.2, 0.1),
        angle: 0.0,
        points: Vec::new(),
        outline: Vec::new(),
        motion: StartMotion::default(),
    };
    scene.add_rigid_body(roller, 1e4, 1e3).unwrap();
    let stations = [Station::on_particle(0), Station::on_rigid_body(0, 0)];
    let targets = stations.map(ContactTarget::Point).to_vec();
    let (point, normal) = (at(0.0, 2.0), at(0.6, 0.8));
    let floor = Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point, normal },
        targets,
        radius: 0.3,
        stiffness: 50.0,
        restitution: 1.0,
        friction: 0.07,
    };
    let shape = ObstacleShape::Disc { centre: at(0.5, -0.9), radius: 2.0 };
    scene.add_obstacle(Obstacle { name: "peg".into(), shape, ..floor.clone() }).unwrap();
    scene.add_obstacle(floor).unwrap();
    scene
}

#[test]
fn tangent_of_frictional_contact_is_the_derivative_of_its_forces() {
    let mut random = Random(31);
    for _ in 0..40 {
        let mut model = System::assemble(&touching()).unwrap();
        let first = random.vector(model.unknowns(), 0.05);
        advance(&mut model, Stage::Midpoint, &first);
        let increments = random.vector(model.unknowns(), 0.2);
        for stage in STAGES {
            model.begin_step(STEP, &Stage::ALL).unwrap();
            // The second correction fits the friction to the corrected normal force.
            settle(&mut model, stage, &increments);
            settle(&mut model, stage, &increments);
            let found = tangent(&mut model, stage, &increments);
            let model = &mut model;
            let expected = differences(&increments, 1e-4, &mut |u| condensed(model, stage, u))
                .rows(0, increments.len())
                .into_owned();
            assert_close(&format!("{stage:?}"), &found, &expected, 1e-7);
        }
    }
}

/// The random rotations are larger and smaller than the deflection, so that some brakes slip and others hold.
/// The wheels are heavy, because light wheels with a stiff brake use a linearisation that is not the derivative at the iterate.
#[test]
fn the_tangent_of_a_brake_is_the_derivative_of_its_moment() {
    let (mut random, mut varying) = (Random(35), 0);
    for (deflection, movement) in [(0.5, 0.02), (0.5, 0.2), (0.01, 0.5)] {
        for _ in 0..10 {
            let scene = super::brakes::clutch([1e4, 2e4], 30.0, deflection);
            let mut model = System::assemble(&scene).unwrap();
            let first = random.vector(model.unknowns(), movement);
            advance(&mut model, Stage::Midpoint, &first);
            let increments = random.vector(model.unknowns(), movement);
            for stage in STAGES {
                model.begin_step(STEP, &Stage::ALL).unwrap();
                settle(&mut model, stage, &increments);
                let found = tangent(&mut model, stage, &increments);
                let model = &mut model;
                let expected = differences(&increments, 1e-4, &mut |u| condensed(model, stage, u))
                    .rows(0, increments.len())
                    .into_owned();
                // A brake that slips in the whole step has a constant moment.
                if expected.amax() == 0.0 {
                    assert_eq!(found.amax(), 0.0);
                    continue;
                }
                varying += 1;
                assert_close(&format!("{stage:?}"), &found, &expected, 1e-7);
            }
        }
    }
    assert!(varying > 30, "{varying}");
}

#[test]
fn the_tangent_of_contact_between_bodies_is_the_derivative_of_its_forces() {
    let mut random = Random(33);
    for (spans, friction) in [(1, 0.0), (5, 0.0), (1, 0.1), (5, 0.1)] {
        let mesh = withy::beams::Mesh::bspline(spans, 3, 2).unwrap();
        let mut wrong = 0;
        for _ in 0..10 {
            let mut model = System::assemble(&scenes::crowded(&mesh, friction)).unwrap();
            let first = random.vector(model.unknowns(), 0.1);
            advance(&mut model, Stage::Midpoint, &first);
            let increments = random.vector(model.unknowns(), 0.1);
            for stage in STAGES {
                model.begin_step(STEP, &Stage::ALL).unwrap();
                // The second correction fits the friction to the corrected normal force.
                settle(&mut model, stage, &increments);
                settle(&mut model, stage, &increments);
                let found = tangent(&mut model, stage, &increments);
                let model = &mut model;
                let expected = differences(&increments, 1e-3, &mut |u| condensed(model, stage, u))
                    .rows(0, increments.len())
                    .into_owned();
                let error = (found - &expected).amax() / expected.amax();
                wrong += usize::from(error > 1e-6);
            }
        }
        // On several spans, derivatives of the axis jump where a nearest point passes a knot, and a nearest point can jump within a difference.
        let allowed = if spans == 1 { 0 } else { 15 };
        assert!(wrong <= allowed, "{spans} spans, friction {friction}: {wrong} of 30 differ");
    }
}

#[test]
fn condensed_forces_equal_those_of_converged_section_forces() {
    for_all(|name, _, model, increments| {
        for stage in STAGES {
            let mut unsettled = vec![0.0; model.degrees_of_freedom()];
            let expected = DVector::from_vec(condensed(model, stage, increments));
            let mismatch = model.add_forces(stage, increments, 1.0, &mut unsettled);
            model.add_mismatch_forces(1.0, &mut unsettled);
            let mut settled = vec![0.0; model.degrees_of_freedom()];
            model.correct_section_forces(&vec![0.0; increments.len()]);
            let left = model.add_forces(stage, increments, 1.0, &mut settled);
            assert!(mismatch > 1e-3 && left < 1e-14, "{name}, {stage:?}: {mismatch:e} {left:e}");
            for forces in [unsettled, settled] {
                let error = (DVector::from_vec(forces) - &expected).amax() / expected.amax();
                assert!(error < 1e-13, "{name}, {stage:?}: {error:.1e}");
            }
            model.begin_step(STEP, &Stage::ALL).unwrap();
        }
    });
}

#[test]
fn strain_error_of_corrected_section_forces_is_quadratic_in_the_correction() {
    for_all(|name, _, model, increments| {
        let direction = Random(5).vector(increments.len(), 1.0);
        for stage in STAGES {
            let mut missed = |size: f64| {
                settle(model, stage, increments);
                condensed(model, stage, increments);
                let correction: Vec<f64> = direction.iter().map(|d| size * d).collect();
                model.correct_section_forces(&correction);
                let u: Vec<f64> = increments.iter().zip(&correction).map(|(u, c)| u + c).collect();
                let mut out = vec![0.0; model.degrees_of_freedom()];
                model.add_forces(stage, &u, 1.0, &mut out)
            };
            let order = (missed(1e-4) / missed(1e-5)).log10();
            assert!(order > 1.9, "{name}, {stage:?}: order {order}");
        }
    });
}

/// Work of the forces of a stage, and these forces.
fn work(model: &mut System, stage: Stage, increments: &[f64]) -> (f64, Vec<f64>) {
    settle(model, stage, increments);
    let mut forces = vec![0.0; model.degrees_of_freedom()];
    model.add_forces(stage, increments, 1.0, &mut forces);
    let work = forces.iter().zip(increments).map(|(force, u)| force * u).sum();
    (work, forces)
}

#[test]
fn damped_forces_dissipate_half_of_chi_times_the_squared_strain_change() {
    for_all(|name, _, model, increments| {
        let mut of = |stage| work(model, stage, increments).0;
        let damped = Stage::DampedMidpoint;
        // The difference between the strain at the end alone and the strain at the start alone is ∫ ΔΓ·C ΔΓ + EI Δκ².
        let square = of(damped(1.0)) - of(damped(-1.0));
        assert!(square > 0.0, "{name}");
        for chi in [0.0, 0.1, 0.7, 3.0] {
            let more = of(damped(chi)) - of(Stage::Midpoint);
            let error = (more - 0.5 * chi * square).abs() / square;
            assert!(error < 1e-12, "{name}, chi = {chi}: {error:.1e}");
        }
    });
}

#[test]
fn damped_stretch_of_a_rod_dissipates_the_energy_of_the_formula() {
    let (axial, length, chi) = (1e4, 10.0, 0.3);
    let mesh = withy::beams::Mesh::lagrange(3, 1).unwrap();
    let scene = scenes::free_beam(&mesh, scenes::spaghetti_section(axial, 100.0));
    let mut model = System::assemble(&scene).unwrap();
    let ends: Vec<Vec2> = model.control_points().flatten().copied().collect();
    let (first, last) = (ends[0], ends[ends.len() - 1]);
    assert!(((last - first).norm() - length).abs() < 1e-12);
    let stretch = |model: &mut System, strain: f64| -> Vec<f64> {
        let moved = |unknown: &probe::Unknown| match unknown {
            probe::Unknown::X(at) => strain * (at - first).x,
            probe::Unknown::Y(at) => strain * (at - first).y,
            probe::Unknown::Rotation => 0.0,
        };
        probe::unknowns(model).iter().map(moved).collect()
    };
    let once = stretch(&mut model, 0.02);
    advance(&mut model, Stage::Midpoint, &once);
    // Increases the strain from 0.02 by 0.03. The increment refers to the current length of the rod.
    let again = stretch(&mut model, 0.03 / 1.02);
    model.begin_step(STEP, &Stage::ALL).unwrap();
    let (damped, _) = work(&mut model, Stage::DampedMidpoint(chi), &again);
    let change = 0.5 * axial * length * (0.05_f64.powi(2) - 0.02_f64.powi(2));
    let lost = 0.5 * chi * axial * length * 0.03_f64.powi(2);
    assert!((damped - change - lost).abs() < 1e-10 * change, "{damped} {change} {lost}");
}

#[test]
fn work_of_midpoint_forces_equals_the_energy_change() {
    for_all(|name, _, model, increments| {
        let (work, forces) = work(model, Stage::Midpoint, increments);
        let before = model.measure();
        let rates = model.rates().to_vec();
        let solution = Solution {
            increments,
            constraints: &[],
            rates: &rates,
            residual: &forces,
            balanced: &[],
        };
        model.advance(&solution);
        let after = model.measure();
        let potential = |m: &withy::system::Measures| {
            m.energy.strain + m.energy.potential + m.energy.stored - m.work + m.dissipated
        };
        let error = (potential(&after) - potential(&before) - work).abs() / after.energy.strain;
        assert!(error < 1e-13, "{name}: {error:.1e}");
    });
}

fn is_damped(scene: &Scene) -> bool {
    scene.springs().any(|spring| spring.damping.is_active()) || scene.dissipating().next().is_some()
}

fn has_followers(scene: &Scene) -> bool {
    scene.loads().any(|load| {
        matches!(
            load.kind,
            LoadKind::Force { frame: LoadFrame::Follower, .. }
                | LoadKind::Line { frame: LoadFrame::Follower, .. }
        )
    })
}

#[test]
fn forces_at_the_end_of_a_step_are_the_gradient_of_the_energy() {
    for_all(|name, scene, model, increments| {
        if has_followers(scene) || is_damped(scene) {
            return;
        }
        settle(model, Stage::End, increments);
        let found = DMatrix::from_row_slice(
            1,
            increments.len(),
            &condensed(model, Stage::End, increments)[..increments.len()],
        );
        let state = model.state();
        let mut energy = |u: &[f64]| {
            advance(model, Stage::End, u);
            let now = model.measure();
            model.restore(&state);
            vec![now.energy.strain + now.energy.potential + now.energy.stored - now.work]
        };
        let expected = differences(increments, 1e-3, &mut energy);
        assert_close(name, &found, &expected, 1e-7);
    });
}

fn is_free(scene: &Scene) -> bool {
    use withy::joints::Partner;
    scene.gravity == Vec2::zeros()
        && scene.joints.iter().all(|joint| joint.partner != Partner::Ground)
}

#[test]
fn rigid_motion_causes_no_strain_and_no_force() {
    for (name, mesh) in meshes(4) {
        for mut scene in scenes::all(&mesh).into_iter().filter(is_free) {
            scene.elements.retain(|element| !matches!(element, Element::Load(_)));
            for stage in STAGES {
                let mut model = System::assemble(&scene).unwrap();
                let u = probe::rigid(&mut model, stage, 2.1, at(3.0, -1.0), at(5.0, 4.0));
                model.begin_step(STEP, &Stage::ALL).unwrap();
                let forces = condensed(&mut model, stage, &u);
                let force = forces.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
                advance(&mut model, stage, &u);
                let strain = model.measure().energy.strain;
                let label = format!("{} on {name}, {stage:?}", scene.name);
                assert!(force < 1e-9 && strain < 1e-22, "{label}: {force:.1e} {strain:.1e}");
            }
        }
    }
}

#[test]
fn rigid_motion_of_a_deformed_beam_conserves_its_strain_energy() {
    for_all(|name, scene, model, _| {
        if !is_free(scene) {
            return;
        }
        let (before, state) = (model.measure().energy.strain, model.state());
        for stage in STAGES {
            let u = probe::rigid(model, stage, 2.1, at(3.0, -1.0), at(5.0, 4.0));
            advance(model, stage, &u);
            let change = model.measure().energy.strain / before - 1.0;
            model.restore(&state);
            assert!(change.abs() < 1e-13, "{name}, {stage:?}: {change:.1e}");
        }
    });
}

#[test]
fn internal_forces_have_no_resultant_and_no_moment() {
    for (name, mesh) in meshes(4) {
        for mut scene in scenes::all(&mesh).into_iter().filter(is_free) {
            scene.elements.retain(|element| !matches!(element, Element::Load(_)));
            let mut model = System::assemble(&scene).unwrap();
            let mut random = Random(3);
            let u = random.vector(model.unknowns(), 0.2);
            advance(&mut model, Stage::Midpoint, &u);
            model.begin_step(STEP, &Stage::ALL).unwrap();
            let forces = condensed(&mut model, Stage::End, &vec![0.0; u.len()]);
            let largest = forces.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            let sum = |wanted: fn(&probe::Unknown) -> bool, model: &mut System| -> f64 {
                let meanings = probe::unknowns(model);
                meanings.iter().zip(&forces).filter(|(u, _)| wanted(u)).map(|(_, f)| f).sum()
            };
            let x = sum(|u| matches!(u, probe::Unknown::X(_)), &mut model);
            let y = sum(|u| matches!(u, probe::Unknown::Y(_)), &mut model);
            let moment = probe::torque(&mut model, &forces);
            let worst = x.abs().max(y.abs()).max(0.1 * moment.abs()) / largest;
            assert!(worst < 1e-12, "{} on {name}: {worst:.1e}", scene.name);
        }
    }
}

#[test]
fn inertia_matrix_agrees_with_products_of_rates() {
    for_all(|name, _, model, increments| {
        let matrix = probe::inertia(model);
        assert_close(&format!("{name}, transposed"), &matrix.transpose(), &matrix, 1e-15);
        assert!(matrix.clone().cholesky().is_some(), "{name}: not positive definite");
        let columns = (0..increments.len()).map(|column| {
            let mut rates = vec![0.0; increments.len()];
            rates[column] = 1.0;
            let mut out = vec![0.0; model.degrees_of_freedom()];
            model.add_inertia(1.0, &rates, &mut out);
            DVector::from_column_slice(&out[..increments.len()])
        });
        let columns = DMatrix::from_columns(&columns.collect::<Vec<_>>());
        assert_close(name, &columns, &matrix, 1e-14);
    });
}
