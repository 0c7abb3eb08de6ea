//! Claimed invariants of each sliding rule, for all uses of a slider in a mechanism.
#![allow(clippy::unwrap_used)]

use crate::common::sliding::{
    PAPER_STEP, Support, free_sliding_mass, paper_meshes, sliding_particle,
};
use crate::common::{
    assert_energy_never_grows, meshes, run, sci, settings, simulate, sleeve_scenes, sliding_scenes,
};
use withy::beams::Mesh;
use withy::integrators::{EnergyClaim, INTEGRATORS, Interval, Method, StepError};
use withy::joints::{RuleClaims, SLIDING_RULES, SlidingRule};
use withy::newton::Tolerance;
use withy::simulation::{Invariant, Simulation};
use withy::system::{Arriving, MasterEnd, MasterLimit, Scene, System};

const ROUNDING: f64 = 1e-12;

fn start(scene: Scene, dt: f64) -> Simulation {
    Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap()
}

fn drifts(simulation: &Simulation) -> [f64; 4] {
    Invariant::ALL.map(|(_, invariant)| simulation.history().drift(invariant))
}

/// Claims of a rule, in the order of the invariants.
fn claimed(claims: RuleClaims) -> [bool; 4] {
    [claims.energy, true, claims.angular_momentum, claims.gap]
}

#[test]
fn free_sliding_mass_conserves_all_invariants_in_at_most_five_iterations() {
    println!(
        "mesh            A       EA     dt/dt0 steps  drift of E, p, L, gap              most mean"
    );
    for (name, [ab, cm]) in paper_meshes() {
        for support in [Support::Free, Support::Hinged] {
            for axial in [1e2, 1e4, 1e6] {
                for factor in [0.1, 1.0, 3.0] {
                    let scene =
                        free_sliding_mass([&ab, &cm], axial, support, SlidingRule::Conserving);
                    let mut flight = start(scene, factor * PAPER_STEP);
                    run(&mut flight, 1.0).unwrap();
                    let (counts, drifts) = (*flight.counts(), drifts(&flight));
                    let label = format!("{name:15} {support:?} EA = {axial:e}, {factor} Δt");
                    println!(
                        "{name:15} {support:7?} {axial:e} {factor:6} {:5}  {}  {} {:.2}",
                        counts.steps,
                        sci(&drifts),
                        counts.newton_max,
                        counts.newton_iterations as f64 / counts.steps as f64
                    );
                    assert!(flight.ending().is_some(), "{label}: stopped at the end of AB");
                    assert!(drifts.iter().all(|drift| *drift <= ROUNDING), "{label}: {drifts:?}");
                    assert!(support == Support::Free || factor > 1.0 || counts.steps > 50);
                    let rows = &flight.history().samples()[1..];
                    assert!(counts.newton_max <= 5, "{label}: {} iterations", counts.newton_max);
                    // No step fails, except at the end of the beam.
                    let retries = rows.split_last().unwrap().1.iter().map(|row| row.retries);
                    assert_eq!(retries.sum::<usize>(), 0, "{label}");
                    assert!(counts.arrival_tries <= 10, "{label}: {} tries", counts.arrival_tries);
                }
            }
        }
    }
}

#[test]
fn conserving_rule_keeps_the_claims_of_the_integrator_on_every_mesh_and_scene() {
    for entry in INTEGRATORS.iter().filter(|entry| entry.claims.angular_momentum) {
        let keeps_energy = entry.claims.energy == EnergyClaim::Conserved;
        let mut worst = [0.0_f64; 4];
        for (mesh_name, mesh) in meshes(4) {
            let sliding = sliding_scenes::all(&mesh, SlidingRule::Conserving);
            for scene in sliding.into_iter().chain(sleeve_scenes::all(&mesh)) {
                let label = format!("{}, {}, {mesh_name}", entry.name, scene.name);
                let flight = simulate(scene, entry.method, 0.01, 0.7);
                let drifts = drifts(&flight);
                let claimed = [keeps_energy, true, true, true];
                for ((drift, claimed), worst) in drifts.iter().zip(claimed).zip(&mut worst) {
                    assert!(!claimed || *drift <= ROUNDING, "{label}: {drifts:?}");
                    *worst = worst.max(*drift);
                }
                if entry.claims.energy == EnergyClaim::NonIncreasing {
                    assert_energy_never_grows(&label, flight.history());
                }
            }
        }
        println!("{:16} worst drift of E, p, L, gap {}", entry.name, sci(&worst));
    }
}

#[test]
fn every_rule_conserves_only_its_claimed_invariants() {
    for entry in SLIDING_RULES {
        for (name, [ab, cm]) in paper_meshes() {
            for support in [Support::Free, Support::Hinged] {
                let scene = free_sliding_mass([&ab, &cm], 1e2, support, entry.rule);
                let mut flight = start(scene, PAPER_STEP);
                // The relaxed rule may stop because a step has no solution.
                let ended = run(&mut flight, 1.0);
                assert!(ended.is_ok() || !entry.claims.gap, "{}: {ended:?}", entry.name);
                let label = format!("{:10} {name:14} {support:6?}", entry.name);
                let drifts = drifts(&flight);
                println!("{label} t = {:.3} drift of E, p, L, gap {}", flight.time(), sci(&drifts));
                for (drift, claimed) in drifts.into_iter().zip(claimed(entry.claims)) {
                    if claimed {
                        assert!(drift <= ROUNDING, "{label}: {drift:.1e}");
                    } else {
                        assert!((1e-6..2e-2).contains(&drift), "{label}: {drift:.1e}");
                    }
                }
            }
        }
    }
}

#[test]
fn unclaimed_invariants_of_rules_are_lost_at_second_order() {
    let cases =
        [(SlidingRule::Exact, Invariant::AngularMomentum), (SlidingRule::Relaxed, Invariant::Gap)];
    for (rule, invariant) in cases {
        let lost: Vec<f64> = [0.008, 0.004, 0.002, 0.001, 0.0005]
            .into_iter()
            .map(|dt| {
                let scene = sliding_particle(&Mesh::bspline(4, 3, 2).unwrap(), 1.0, rule);
                let flight = simulate(scene, Method::EnergyMomentum, dt, 0.16);
                flight.history().drift(invariant)
            })
            .collect();
        let orders = crate::common::orders(&lost);
        println!("{rule:?}: {invariant:?} lost {} orders {orders:.2?}", sci(&lost));
        assert!(orders[1..].iter().all(|order| (order - 2.0).abs() < 0.3), "{rule:?}");
    }
}

#[test]
fn generalized_alpha_keeps_the_gap_closed_under_every_gap_rule() {
    for entry in SLIDING_RULES.iter().filter(|entry| entry.claims.gap) {
        for scene in sliding_scenes::all(&Mesh::bspline(4, 3, 2).unwrap(), entry.rule) {
            let label = format!("{}, {}", entry.name, scene.name);
            let method = Method::GeneralizedAlpha { rho_infinity: 0.8 };
            let [.., gap] = drifts(&simulate(scene, method, 0.005, 0.3));
            assert!(gap <= ROUNDING, "{label}: {gap:e}");
        }
    }
}

#[test]
fn trapezoidal_rule_keeps_gap_and_momentum_under_every_gap_rule() {
    for entry in SLIDING_RULES.iter().filter(|entry| entry.claims.gap) {
        for scene in sliding_scenes::all(&Mesh::bspline(4, 3, 2).unwrap(), entry.rule) {
            let label = format!("{}, {}", entry.name, scene.name);
            let flight = simulate(scene, Method::Trapezoidal, 0.005, 0.3);
            let [energy, momentum, angular, gap] = drifts(&flight);
            println!("{label:50} {}", sci(&[energy, momentum, angular, gap]));
            assert!(momentum <= ROUNDING && gap <= ROUNDING, "{label}: {momentum:e} {gap:e}");
        }
    }
}

/// Action on a slider between steps.
type Deed = fn(&mut System, usize);

const DEEDS: [(&str, Deed); 4] = [
    ("nothing", |_, _| ()),
    ("bounce", |model, slider| {
        let end = if model.slider_speed(slider) < 0.0 { MasterEnd::Start } else { MasterEnd::End };
        let strike = vec![MasterLimit { slider, end }];
        model.solve_impact(&Arriving { strike, ..Arriving::default() }, 0.001).unwrap();
    }),
    ("hold", |model, slider| model.hold_at_stop(MasterLimit { slider, end: MasterEnd::End })),
    ("release", |model, slider| model.release_slider(slider)),
];

#[test]
fn restored_state_continues_bit_for_bit_after_slider_events() {
    let methods = INTEGRATORS.iter().map(|entry| entry.method);
    let pairs = methods.flat_map(|method| SLIDING_RULES.iter().map(move |entry| (method, entry)));
    for (method, entry) in pairs {
        for scene in sliding_scenes::all(&Mesh::bspline(4, 3, 2).unwrap(), entry.rule) {
            for (deed, act) in DEEDS {
                let label = format!("{method:?}, {}, {}, {deed}", entry.name, scene.name);
                let mut model = System::assemble(&scene).unwrap();
                let mut integrator = method.build(&mut model, Tolerance::default());
                let mut advance = |model: &mut System, steps: std::ops::Range<u32>| {
                    for n in steps {
                        let (start, end) = (f64::from(n) * 0.001, f64::from(n + 1) * 0.001);
                        let interval = Interval::between(start, end);
                        let mut step = integrator.step(model, interval);
                        if let Err(StepError::Overshoot { .. }) = step {
                            model.leave_tensile_stops().unwrap();
                            step = integrator.step(model, interval);
                        }
                        step.unwrap_or_else(|error| panic!("{label}: {error}"));
                    }
                };
                advance(&mut model, 0..3);
                let sliding = model.state();
                advance(&mut model, 3..6);
                let first = model.state();
                model.restore(&sliding);
                act(&mut model, 0);
                let state = model.state();
                assert_eq!(state == sliding, deed == "nothing", "{label}");
                advance(&mut model, 3..6);
                let later = model.state();
                model.restore(&state);
                assert_eq!(model.state(), state, "{label}");
                advance(&mut model, 3..6);
                assert_eq!(model.state(), later, "{label}");
                // The earlier state reverts the action.
                model.restore(&sliding);
                advance(&mut model, 3..6);
                assert_eq!(model.state(), first, "{label}");
            }
        }
    }
}
