//! Forces of sliders: their times, and their order in the step size.
#![allow(clippy::unwrap_used)]

use crate::common::sliding::reference_scene;
use crate::common::{run, sci, settings};
use withy::beams::Station;
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, IntegratorEntry, Method};
use withy::joints::{SLIDING_RULES, SlidingRule};
use withy::simulation::{NoMonitor, Simulation, StepControl, StepSize};

/// Time at which the force is smooth.
const TIME: f64 = 0.2;

/// Present force at `TIME` after the given number of steps, and mean force of a step with `TIME` as its midpoint.
fn message(reference: &str, rule: SlidingRule, entry: &IntegratorEntry, steps: usize) -> [Vec2; 2] {
    let start = |dt: f64| {
        let scene = reference_scene(reference, 4, rule);
        Simulation::start(scene, settings(entry.method, dt)).unwrap()
    };
    let mut whole = start(TIME / steps as f64);
    run(&mut whole, TIME).unwrap();
    let mut half = start(TIME / (steps as f64 + 0.5));
    for _ in 0..=steps {
        half.step(&mut NoMonitor).unwrap();
    }
    [whole.instant().unwrap().contact(0), half.model().contact_force(0)]
}

/// Mean observed order of differences when steps are halved.
fn slope(changes: &[f64]) -> f64 {
    (changes[0] / changes[changes.len() - 1]).log2() / (changes.len() - 1) as f64
}

#[test]
fn present_forces_have_the_order_of_the_motion_with_every_rule_and_method() {
    for reference in ["P7b", "P8s_hinged"] {
        // With the relaxed rule, the second reference has no solution.
        let rules = SLIDING_RULES.iter().filter(|rule| rule.claims.gap || reference == "P7b");
        for rule in rules {
            for entry in INTEGRATORS {
                let found =
                    [50, 100, 200, 400].map(|steps| message(reference, rule.rule, entry, steps));
                let [present, in_step] = [0, 1].map(|which| -> Vec<f64> {
                    let pairs = found.windows(2);
                    pairs.map(|pair| (pair[0][which] - pair[1][which]).norm()).collect()
                });
                let label = format!("{reference} {} {}", rule.name, entry.name);
                println!(
                    "{label:37} {:6.2}: at the moment {} {:5.2}, in the step {} {:5.2}",
                    found[3][0].norm(),
                    sci(&present),
                    slope(&present),
                    sci(&in_step),
                    slope(&in_step)
                );
                let is_fourth = entry.claims.order == 4;
                let is_kinked = rule.rule == SlidingRule::Kinked;
                let found = match is_fourth && rule.claims.gap {
                    true => slope(&present) > 3.2,
                    // The largest steps do not resolve the fast oscillation of the kink, so the first observed order may be too small.
                    false if is_kinked => slope(&present).max(slope(&present[1..])) > 1.2,
                    false => slope(&present) > 1.4,
                };
                assert!(found, "{label}");
                // The force of a second-order step belongs to its midpoint, if it is the mean force of the step and does not alternate.
                let is_of_middle = entry.claims.momentum && entry.claims.order == 2;
                let is_mean = ["conserving", "exact"].contains(&rule.name);
                assert!(!(is_of_middle && is_mean) || slope(&in_step) > 1.7, "{label}");
                // The relaxed rule alternates, so the check must fail for it.
                let is_rough = rule.name == "relaxed" && entry.claims.momentum;
                assert!(!is_rough || slope(&in_step) < 0.0, "{label}");
            }
        }
    }
}

/// The mean force times the step equals the change of the momentum of the bead, for every rule, method and step size.
#[test]
fn the_mean_force_of_a_step_changes_the_momentum_of_the_bead() {
    let steps: [StepSize; 2] = [0.01.into(), StepControl::to(1e-4).into()];
    for rule in SLIDING_RULES {
        for entry in INTEGRATORS.iter().filter(|entry| entry.claims.momentum) {
            // The relaxed rule has no solution for small adaptive steps.
            for dt in steps.into_iter().take(if rule.claims.gap { 2 } else { 1 }) {
                let scene = reference_scene("P7b", 4, rule.rule);
                let mut simulation = Simulation::start(scene, settings(entry.method, dt)).unwrap();
                let bead = simulation.place(&Station::on_particle(0)).unwrap();
                let (mut worst, mut size) = (0.0_f64, 1.0_f64);
                for _ in 0..20 {
                    let (time, before) = (simulation.time(), simulation.model().velocity(&bead));
                    simulation.step(&mut NoMonitor).unwrap();
                    let change = simulation.model().velocity(&bead) - before;
                    let force = simulation.model().contact_force(0);
                    let impulse = force * (simulation.time() - time);
                    worst = worst.max((change + impulse).norm());
                    size = size.max(impulse.norm());
                }
                let label = format!("{} {} {dt:?}", rule.name, entry.name);
                println!("{label}: {worst:.1e} of {size:.1e}");
                assert!(worst < 1e-12 * size, "{label}: {worst:e}");
            }
        }
    }
}

/// A step of zero length has the present force.
#[test]
fn first_history_row_has_the_present_contact_force() {
    for rule in SLIDING_RULES {
        let scene = reference_scene("P7b", 4, rule.rule);
        let mut simulation = Simulation::start(scene, settings(Method::default(), 1e-5)).unwrap();
        let present = simulation.instant().unwrap().contact(0);
        let first = simulation.model().contact_force(0);
        assert!((first - present).norm() <= 1e-12 * present.norm(), "{}", rule.name);
        simulation.step(&mut NoMonitor).unwrap();
        let second = simulation.model().contact_force(0);
        println!("{:12} {first} {second}", rule.name);
        // At this speed of the slider, kinks start without load, and the force of the relaxed rule alternates.
        if ["conserving", "exact"].contains(&rule.name) {
            assert!(first.norm() > 0.05, "{}", rule.name);
            assert!((second - first).norm() < 0.01 * first.norm(), "{}", rule.name);
        }
    }
}
