#![allow(clippy::unwrap_used)]
mod common;
use common::sliding::{Support, free_sliding_mass};
use common::{run, settings};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::joints::SlidingRule;
use withy::simulation::Simulation;
#[test]
fn probe() {
    for (ab, cm) in [
        (Mesh::bspline(2, 3, 2).unwrap(), Mesh::bspline(4, 3, 2).unwrap()),
        (Mesh::lagrange(2, 3).unwrap(), Mesh::lagrange(4, 3).unwrap()),
    ] {
        let scene = free_sliding_mass([&ab, &cm], 1e6, Support::Free, SlidingRule::Conserving);
        let mut s = Simulation::start(scene, settings(Method::EnergyMomentum, 0.03201)).unwrap();
        let _ = run(&mut s, 0.5);
        let it: Vec<String> = s
            .history()
            .samples()
            .iter()
            .map(|r| {
                format!(
                    "{}{}",
                    r.newton_iterations,
                    if r.retries > 0 {
                        format!("r{}@{:.3}", r.retries, r.measures.time)
                    } else {
                        String::new()
                    }
                )
            })
            .collect();
        println!("{}", it.join(" "));
        let k: Vec<String> = s
            .history()
            .samples()
            .iter()
            .map(|r| format!("{:.0}/{:.0}", r.measures.energy.kinetic, r.measures.energy.strain))
            .collect();
        println!("{}", k.join(" "));
    }
}
