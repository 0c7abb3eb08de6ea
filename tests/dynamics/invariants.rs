//! What every integrator claims to keep, on every mesh and scene; and that what is not claimed is not kept.
#![allow(clippy::unwrap_used)]

use crate::common::{
    assert_energy_never_grows, at, body_scenes, energies, meshes, run, scenes, settings, simulate,
};
use withy::beams::Mesh;
use withy::integrators::{EnergyClaim, INTEGRATORS, Interval, Method};
use withy::loads::{LoadKind, Schedule};
use withy::model::Model;
use withy::newton::Tolerance;
use withy::simulation::{History, Invariant, Simulation, SimulationError};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn assert_kept(label: &str, history: &History, invariant: Invariant, tolerance: f64) -> f64 {
    let drift = history.drift(invariant);
    assert!(drift <= tolerance, "{label}: {invariant:?} drifts by {drift:.1e}");
    drift
}

#[test]
fn every_claim_holds_on_every_mesh_and_scene() {
    for entry in INTEGRATORS {
        let claims = [
            (Invariant::Energy, entry.claims.energy == EnergyClaim::Kept),
            (Invariant::Momentum, entry.claims.momentum),
            (Invariant::AngularMomentum, entry.claims.angular_momentum),
            (Invariant::Gap, true),
        ];
        let mut worst = [f64::NAN; 4];
        for (mesh_name, mesh) in meshes(6) {
            for scene in scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh)) {
                let label = format!("{}, {}, {mesh_name}", entry.name, scene.name);
                let simulation = simulate(scene, entry.method, 0.1, 7.5);
                for (worst, (invariant, _)) in
                    worst.iter_mut().zip(claims).filter(|(_, (_, claimed))| *claimed)
                {
                    let drift = assert_kept(&label, simulation.history(), invariant, 1e-12);
                    *worst = worst.max(drift);
                }
                if entry.claims.energy == EnergyClaim::Decays {
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
fn what_is_not_claimed_is_seen_to_fail() {
    for entry in INTEGRATORS {
        let simulation = simulate(scenes::spaghetti(&smooth(14), 1e4), entry.method, 0.1, 7.5);
        let drift = |invariant| simulation.history().drift(invariant);
        if entry.claims.energy != EnergyClaim::Kept {
            assert!(drift(Invariant::Energy) > 1e-4, "{}", entry.name);
        }
        if entry.claims.energy == EnergyClaim::Nothing {
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
fn energy_and_momenta_stand_still_from_the_start_at_any_step() {
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
fn energy_and_momenta_stand_still_for_a_thousand_units_of_time() {
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
fn energy_stands_still_a_hundred_million_lengths_away() {
    let load = Schedule::hold_for(2.5).unwrap();
    let section = scenes::spaghetti_section(1e4, 100.0);
    let scene = scenes::thrown(&smooth(14), section, load, at(1e8, 1e8));
    let far = simulate(scene, Method::EnergyMomentum, 0.1, 7.5);
    let near = simulate(scenes::spaghetti(&smooth(14), 1e4), Method::EnergyMomentum, 0.1, 7.5);
    // Positions there are multiples of 1.5e-8: the drawing itself is rounded, what follows from it is not.
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

/// Runs a scene that must fail after `good` steps; what went before must be kept and finite.
fn assert_fails_cleanly(scene: withy::model::Scene, dt: f64, good: usize) -> SimulationError {
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
fn an_absurd_load_is_an_error_that_keeps_the_history() {
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
fn an_absurd_step_is_an_error_that_keeps_the_history() {
    let error = assert_fails_cleanly(scenes::spaghetti(&smooth(8), 1e4), 1e200, 0);
    assert!(matches!(error, SimulationError::Step { .. }), "{error}");
}

#[test]
fn half_a_turn_in_a_step_is_tried_again_in_smaller_steps() {
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
fn a_restored_state_goes_on_bit_for_bit_as_it_did() {
    for entry in INTEGRATORS {
        for scene in scenes::all(&smooth(6)).into_iter().chain(body_scenes::all(&smooth(6))) {
            let mut model = Model::assemble(&scene).unwrap();
            let mut integrator = entry.method.build(&mut model, Tolerance::default());
            let mut advance = |model: &mut Model, steps: std::ops::Range<u32>| {
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
