//! Piecewise linear and sampled laws, slack ropes and open buffers: the energy balance closes at any stiffness, without halved steps.
#![allow(clippy::unwrap_used)]

use crate::common::{at, scenes, simulate};
use withy::beams::Mesh;
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, StartMotion,
};

/// `EA` of the beams, as a reference for the stiffness of the springs.
const OF_BEAM: f64 = 1e4;

fn add(scene: &mut Scene, anchors: Vec<Anchor>, law: SpringLaw) {
    let (name, kind) = (scene.free_name("spring"), SpringKind::Length(anchors));
    let (law, origin) = (Some(law), Origin::Zero);
    scene.add_spring(Spring { name, kind, law, origin, damping: 0.0.into(), rest: None }).unwrap();
}

/// A rope resists elongation beyond its length only, a buffer resists compression below its length only.
fn rope(stiffness: f64, length: f64) -> SpringLaw {
    let points = vec![(length - 1.0, 0.0), (length, 0.0), (length + 1.0, stiffness)];
    SpringLaw::Table { points }
}

fn buffer(stiffness: f64, length: f64) -> SpringLaw {
    let points = vec![(length - 1.0, -stiffness), (length, 0.0), (length + 1.0, 0.0)];
    SpringLaw::Table { points }
}

/// Hardening spring, sampled like a script function.
fn hardening(stiffness: f64, length: f64) -> SpringLaw {
    let force = |e: f64| Ok::<f64, ()>(stiffness * (e + 4.0 * e * e * e));
    SpringLaw::sampled((-0.51, 0.62), force).unwrap().shifted(length)
}

type Law = fn(f64, f64) -> SpringLaw;

/// Free rotating beam with a law between its ends and another one between interior points. Both are elongated by `beyond` at the start.
fn braced(law: Law, stiffness: f64, beyond: f64) -> Scene {
    let mut scene = Scene::new("braced");
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let section = scenes::spaghetti_section(OF_BEAM, 100.0);
    let beam =
        scenes::add_beam(&mut scene, scenes::line(at(1.0, 2.0), at(4.0, 6.0)), &mesh, section);
    scene.beams[beam].motion =
        StartMotion { velocity: at(3.0, -1.0), spin: 1.5, centre: Some(at(1.0, 1.0)) };
    let places = [0.0, 1.2, 3.9, 5.0].map(|s| Anchor::Station(scene.station(beam, s).unwrap()));
    add(&mut scene, vec![places[0], places[3]], law(stiffness, 5.0 - beyond));
    add(&mut scene, vec![places[1], places[2]], law(0.3 * stiffness, 2.7 - beyond));
    scene
}

/// Beam on a rope from the ground that repeatedly becomes taut under gravity, with a tendon over three of its points.
fn hanging(stiffness: f64) -> Scene {
    let mut scene = Scene::new("hanging");
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let section = scenes::spaghetti_section(OF_BEAM, 100.0);
    let beam =
        scenes::add_beam(&mut scene, scenes::line(at(0.0, 0.0), at(4.0, -1.0)), &mesh, section);
    let length = scene.beams[beam].axis.length();
    let places = [0.0, 0.5, 1.0].map(|s| Anchor::Station(scene.station(beam, s * length).unwrap()));
    let above = [at(0.0, 1.0), at(4.5, 1.0)].map(Anchor::Ground);
    add(&mut scene, vec![above[0], places[0]], rope(stiffness, 1.3));
    add(&mut scene, vec![above[1], places[2]], rope(stiffness, 2.4));
    add(&mut scene, places.to_vec(), rope(stiffness, length + 1e-3));
    scene.gravity = at(0.0, -9.81);
    scene
}

fn worst(simulation: &Simulation) -> f64 {
    let drift = |(_, invariant): &(&str, Invariant)| simulation.history().drift(*invariant);
    Invariant::ALL.iter().map(drift).fold(0.0, f64::max)
}

#[test]
fn stiff_piecewise_linear_laws_keep_energy_balance_without_more_steps() {
    for times in [1e-6, 1.0, 1e3, 1e6, 1e9, 1e12] {
        let stiffness = times * OF_BEAM;
        let all = [
            ("slack rope", braced(rope, stiffness, -0.01)),
            ("rope", braced(rope, stiffness, 0.0)),
            ("buffer", braced(buffer, stiffness, 0.0)),
            ("hardening", braced(hardening, stiffness, 0.0)),
            ("hanging", hanging(stiffness)),
        ];
        for (name, scene) in all {
            let simulation = simulate(scene, Method::EnergyMomentum, 0.05, 2.5);
            let (work, drift) = (simulation.counts(), worst(&simulation));
            let iterations = work.newton_iterations as f64 / work.steps as f64;
            let label = format!(
                "{name} {times:e}: {} steps, {} retries, {iterations:.2} iterations, {drift:.1e}",
                work.steps, work.retries
            );
            println!("{label}");
            assert!(work.steps == 50 && work.retries == 0 && iterations < 8.0, "{label}");
            assert!(drift < 1e-12, "{label}");
        }
    }
}

#[test]
fn claimed_invariants_hold_with_ropes_that_go_slack() {
    for entry in INTEGRATORS {
        for times in [1.0, 1e6, 1e12] {
            let scene = braced(rope, times * OF_BEAM, -0.01);
            let simulation = simulate(scene, entry.method, 0.02, 1.5);
            let drift = |invariant| simulation.history().drift(invariant);
            let label = format!("{} {times:e}", entry.name);
            if entry.claims.energy == EnergyClaim::Conserved {
                let energy = drift(Invariant::Energy);
                assert!(energy < 1e-12, "{label}: {energy:.1e}");
            }
            if entry.claims.momentum {
                let momentum = drift(Invariant::Momentum);
                assert!(momentum < 1e-12, "{label}: {momentum:.1e}");
            }
        }
    }
}

/// A bead falls from 0.5 above the end of a nearly inextensible rope of length 1. The step in which the rope becomes taut reverses the velocity, so the bead
/// rises to its start height.
#[test]
fn bead_bounces_on_a_stiff_rope_as_on_a_wall() {
    for stiffness in [1e9, 1e13, 1e17] {
        let mut scene = Scene::new("bead");
        let position = at(0.0, -0.5);
        let bead = ParticleDefinition { name: "bead".to_owned(), position };
        let bead = Anchor::Station(scene.add_particle(bead, 1.0).unwrap());
        add(&mut scene, vec![Anchor::Ground(at(0.0, 0.0)), bead], rope(stiffness, 1.0));
        scene.gravity = at(0.0, -9.81);
        let simulation = simulate(scene, Method::EnergyMomentum, 1e-3, 2.0);
        let work = simulation.counts();
        assert!(work.retries == 0 && work.steps == 2000, "{stiffness:e}: {} retries", work.retries);
        let drift = simulation.history().drift(Invariant::Energy);
        assert!(drift < 1e-12, "{stiffness:e}: {drift:.1e}");
        let column = simulation.history().column("spring1.length").unwrap();
        let lowest = column.iter().fold(0.0, |most: f64, length| most.max(*length));
        let last = &column[column.len() - 640..];
        let highest = last.iter().fold(1.0, |least: f64, length| least.min(*length));
        assert!(lowest < 1.004, "{stiffness:e}: {lowest}");
        // The error of a bounce within a step is at most the displacement in one step.
        assert!((highest - 0.5).abs() < 0.02, "{stiffness:e}: {highest}");
    }
}
