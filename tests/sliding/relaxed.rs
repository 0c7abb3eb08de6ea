//! Steps of the relaxed rule that fail have no solution. The residual for all prescribed increments `Δξ` shows this.
#![allow(clippy::unwrap_used)]

use crate::common::fixed_way::FixedWay;
use crate::common::points;
use crate::common::sliding::{PAPER_STEP, Support, free_sliding_mass, paper_meshes};
use withy::integrators::{Interval, Method};
use withy::joints::SlidingRule;
use withy::newton::Tolerance;
use withy::system::System;

fn interval(step: u32) -> Interval {
    Interval::between(f64::from(step) * PAPER_STEP, f64::from(step + 1) * PAPER_STEP)
}

/// Number of sign changes of the sliding equation for increments from 1e-7 to 0.3 in both directions.
fn solutions(model: &mut System, interval: Interval) -> usize {
    let mut found = 0;
    for direction in [-1.0, 1.0] {
        let mut fixed = FixedWay::new(model);
        let left: Vec<f64> = (0..650)
            .map(|index| {
                let way = direction * 1e-7 * 10_f64.powf(f64::from(index) / 100.0);
                fixed.left(interval, way).expect("with a given way every step has a solution")
            })
            .collect();
        found += left.windows(2).filter(|pair| pair[0].signum() != pair[1].signum()).count();
    }
    found
}

#[test]
fn relaxed_rule_stops_only_where_its_step_has_no_solution() {
    let mut ends = Vec::new();
    for support in [Support::Free, Support::Hinged] {
        for (name, meshes) in paper_meshes() {
            // Quadrature of the paper.
            let [ab, cm] = meshes.map(|mesh| points(mesh, 3));
            let scene = free_sliding_mass([&ab, &cm], 1e2, support, SlidingRule::Relaxed);
            let mut model = System::assemble(&scene).unwrap();
            let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
            let (mut step, mut before) = (0, model.state());
            let error = loop {
                let state = model.state();
                match integrator.step(&mut model, interval(step)) {
                    Ok(_) => (step, before) = (step + 1, state),
                    Err(error) => break error,
                }
            };
            let (xi, gap) = (model.slider_position(0), model.measure().gap);
            let failing = solutions(&mut model, interval(step));
            let state = model.state();
            model.restore(&before);
            let working = solutions(&mut model, interval(step - 1));
            model.restore(&state);
            println!(
                "A {support:6?} {name:14} {step} whole steps to t = {:.4}, ξ = {xi:.4}, gap {gap:.1e}: solutions of the last step {working}, of the next one {failing}",
                model.time()
            );
            assert!(working > 0, "the step that was taken has a solution");
            let at_the_end = error.to_string().contains("limit");
            assert_eq!(failing > 0, at_the_end, "{error}");
            ends.push(if at_the_end { None } else { Some(xi) });
        }
    }
    // With A free, the runs with splines reach the end of AB. All other runs stop before.
    let [free_c1, free_c2, free_lagrange, hinged @ ..] = ends.as_slice() else { unreachable!() };
    assert!(free_c1.is_none() && free_c2.is_none());
    assert!((free_lagrange.unwrap() - 0.656).abs() < 1e-3);
    assert!(hinged.iter().all(|xi| (xi.unwrap() - 0.655).abs() < 0.01), "{hinged:?}");
}
