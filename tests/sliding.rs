//! Sliding joints.
#![allow(clippy::unwrap_used)]

mod common;

use common::sliding::{Support, free_sliding_mass};
use common::{run, settings};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::joints::SlidingRule;
use withy::simulation::{Invariant, Simulation};

fn pairs() -> Vec<(&'static str, Mesh, Mesh)> {
    vec![
        ("C1", Mesh::bspline(2, 3, 1).unwrap(), Mesh::bspline(4, 3, 1).unwrap()),
        ("C2", Mesh::bspline(2, 3, 2).unwrap(), Mesh::bspline(4, 3, 2).unwrap()),
        ("Lagrange", Mesh::lagrange(2, 3).unwrap(), Mesh::lagrange(4, 3).unwrap()),
    ]
}

#[test]
fn probe() {
    for rule in [SlidingRule::Conserving, SlidingRule::Exact, SlidingRule::Relaxed] {
        for (name, ab, cm) in pairs() {
            for support in [Support::Free, Support::Hinged] {
                for axial in [1e2, 1e4, 1e6] {
                    for factor in [1.0, 0.1, 3.0] {
                        let scene = free_sliding_mass([&ab, &cm], axial, support, rule);
                        let dt = 0.01067 * factor;
                        let mut s =
                            Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
                        let ended = run(&mut s, 0.6);
                        let drifts = Invariant::ALL.map(|(_, i)| s.history().drift(i));
                        println!(
                            "{:10} {name:8} {support:?} EA {axial:e} dt x{factor}: steps {} t {:.4} xi {:.4} drift {} newton max {} mean {:.2} retries {} {}{}",
                            rule.entry().name,
                            s.counts().steps,
                            s.time(),
                            s.model().slider_position(s.scene(), 0),
                            common::sci(&drifts),
                            s.counts().newton_max,
                            s.counts().newton_iterations as f64 / s.counts().steps as f64,
                            s.counts().retries,
                            s.ending().unwrap_or_default(),
                            ended.err().map(|e| e.to_string()).unwrap_or_default()
                        );
                    }
                }
            }
        }
    }
}
