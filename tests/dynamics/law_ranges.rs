//! Warnings about springs and dampers beyond the range of their laws.
#![allow(clippy::unwrap_used)]

use crate::common::{at, simulate};
use withy::integrators::Method;
use withy::simulation::{NoMonitor, Simulation, Warning};
use withy::system::{
    Anchor, DampingLaw, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw,
    StationVelocity,
};

/// Particle at a distance of 5 from the ground that moves away from it, on a spring or damper called `link`.
fn held(law: Option<SpringLaw>, damping: DampingLaw, speed: f64) -> Scene {
    let mut scene = Scene::new("bead");
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(5.0, 0.0) };
    let station = scene.add_particle(bead, 1.0).unwrap();
    scene.velocities.push(StationVelocity { station, velocity: at(speed, 0.0), spin: None });
    let kind = SpringKind::Length(vec![Anchor::Ground(at(0.0, 0.0)), Anchor::Station(station)]);
    let (name, origin) = ("link".to_owned(), Origin::AsBuilt);
    scene.add_spring(Spring { name, kind, law, origin, damping, rest: None }).unwrap();
    scene
}

fn sampled(range: f64, force: impl Fn(f64) -> f64) -> SpringLaw {
    SpringLaw::sampled((-range, range), |e| Ok::<f64, ()>(force(e))).unwrap()
}

fn table(points: &[(f64, f64)]) -> SpringLaw {
    SpringLaw::Table { points: points.to_vec() }
}

fn message(simulation: &Simulation) -> Vec<String> {
    let notes = simulation.warnings();
    let of_ranges = notes.iter().filter(|note| matches!(note, Warning::Range { .. }));
    of_ranges.map(ToString::to_string).collect()
}

#[test]
fn law_outside_its_range_is_reported_once_with_the_farthest_value() {
    let cubic = || Some(sampled(0.5, |e| 10.0 * e * e * e));
    for method in [Method::EnergyMomentum, Method::FourthOrder, Method::Trapezoidal] {
        let mut simulation = simulate(held(cubic(), 0.0.into(), 6.0), method, 0.01, 2.0);
        let notes = message(&simulation);
        assert_eq!(notes.len(), 1, "{notes:?}");
        println!("{}", notes[0]);
        assert!(notes[0].starts_with("the law of spring 'link' is given from -0.5 to 0.5, but "));
        assert!(notes[0].contains("2.5"), "{}", notes[0]);
        let before = simulation.warnings();
        simulation.run_to(2.5, &mut NoMonitor).unwrap();
        assert!(simulation.warnings().iter().all(|note| !note.is_new_or_worse(&before)));
        // The exact amplitude for a speed of 0.5, (v²/5)^(1/4), is within the range.
        assert!(message(&simulate(held(cubic(), 0.0.into(), 0.5), method, 0.01, 2.0)).is_empty());
    }
    let tanh = |range| DampingLaw::Curve(sampled(range, f64::tanh));
    let notes = message(&simulate(held(None, tanh(1.0), 5.0), Method::EnergyMomentum, 0.01, 0.5));
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(notes[0].contains("damping law of damper 'link' is given from -1 to 1, but 4.9"));
    let inside = simulate(held(None, tanh(6.0), 5.0), Method::EnergyMomentum, 0.01, 0.5);
    assert!(message(&inside).is_empty());
}

#[test]
fn tables_with_straight_or_level_ends_are_not_reported() {
    let measured = table(&[(-1.0, -8.0), (-0.5, -3.0), (0.0, 0.0), (0.5, 3.0), (1.0, 8.0)]);
    let run = |law, speed| {
        message(&simulate(held(Some(law), 0.0.into(), speed), Method::EnergyMomentum, 0.01, 1.0))
    };
    assert_eq!(run(measured.clone(), 6.0).len(), 1);
    assert!(run(measured, 1.0).is_empty());
    let line = table(&[(-1.0, -8.0), (1.0, 8.0)]);
    let rope = table(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 8.0)]);
    let level = table(&[(-2.0, -8.0), (-1.0, -8.0), (1.0, 8.0), (2.0, 8.0)]);
    for law in [line, rope, level] {
        assert!(run(law.clone(), 6.0).is_empty(), "{law:?}");
    }
}
