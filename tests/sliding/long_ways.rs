//! Long paths and long runs: a thousand element boundaries, a hundred thousand steps.
#![allow(clippy::unwrap_used)]

use crate::common::rails::{bead, bouncing_bead};
use crate::common::scenes::{add_beam, end_of, line, spring, start_of};
use crate::common::sliding::{paper_section, smooth};
use crate::common::{at, run, sci, settings, simulate};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{EndAction, SlidingRule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{Anchor, Scene, SpringKind, SpringLaw};

fn drifts(simulation: &Simulation) -> [f64; 4] {
    Invariant::ALL.map(|(_, invariant)| simulation.history().drift(invariant))
}

/// Bead that slides along a free beam of 1010 spans, which rotates and bends.
fn long_way(mesh: &Mesh) -> Scene {
    let mut scene = Scene::new("long way");
    let length = 20.2;
    add_beam(&mut scene, line(Vec2::zeros(), at(length, 0.0)), mesh, paper_section(1e3));
    let spin = 0.3;
    scene.beams[0].motion.spin = spin;
    let velocity = at(12.0, (0.002 - 0.5) * length * spin);
    bead(&mut scene, 0.002, 0.2, velocity, EndAction::Stop);
    scene
}

#[test]
fn bead_passing_element_boundaries_needs_few_iterations() {
    let bspline = |continuity| Mesh::bspline(1010, 3, continuity).unwrap();
    let cases = [
        ("cubic C2", bspline(2), 0.01),
        ("cubic C2", bspline(2), 0.0013),
        ("cubic C1", bspline(1), 0.01),
        ("cubic Lagrange", Mesh::lagrange(1010, 3).unwrap(), 0.01),
        ("linear", Mesh::lagrange(1010, 1).unwrap(), 0.01),
        ("linear", Mesh::lagrange(1010, 1).unwrap(), 0.0013),
    ];
    for (name, mesh, dt) in cases {
        let flight = simulate(long_way(&mesh), Method::EnergyMomentum, dt, 1.8);
        let xi = flight.history().column("slider1.position").unwrap();
        let passed = (1010.0 * (xi.last().unwrap() - xi[0])) as usize;
        let (counts, drifts) = (flight.counts(), drifts(&flight));
        println!(
            "{name:15} dt = {dt}: {} steps, {passed} boundaries, most {} iterations, mean {:.2}, retries {}, drift {}",
            counts.steps,
            counts.newton_max,
            counts.newton_iterations as f64 / counts.steps as f64,
            counts.retries,
            sci(&drifts)
        );
        assert!(passed >= 1000, "{name}: {passed}");
        assert!(counts.newton_max <= 4 && counts.retries == 0, "{name}, dt = {dt}");
        assert!(drifts.iter().all(|drift| *drift < 1e-11), "{name}: {drifts:?}");
    }
}

/// Bead between two springs on a free beam that rotates and bends.
fn shuttle(spans: usize, stiffness: f64) -> Scene {
    let mut scene = Scene::new("shuttle");
    let section =
        Section { mass_per_length: 0.5, rotary_inertia: 0.05, ..paper_section(stiffness) };
    add_beam(&mut scene, line(Vec2::zeros(), at(2.0, 0.0)), &smooth(spans), section);
    let motion = &mut scene.beams[0].motion;
    (motion.velocity, motion.spin, motion.centre) = (at(0.1, -0.2), 1.0, Some(at(1.0, 0.0)));
    bead(&mut scene, 0.35, 1.0, at(1.1, -0.5), EndAction::Stop);
    let slave = scene.sliders[0].slave;
    for end in [start_of(&mut scene, 0), end_of(&mut scene, 0)] {
        let anchors = vec![Anchor::Station(end), Anchor::Station(slave)];
        let law = SpringLaw::Linear { stiffness: 12.0, natural: 0.9 };
        spring(&mut scene, SpringKind::Length(anchors), law, 0.0);
    }
    scene.sliders[0].rule = SlidingRule::Kinked;
    scene
}

#[test]
fn bead_on_a_kinked_axis_oscillates_for_a_hundred_thousand_steps() {
    let steps = if std::env::var_os("WITHY_LONG").is_some() { 1e5 } else { 1e4 };
    for (stiffness, dt) in [(1e2, 0.01), (1e3, 0.01)] {
        let settings = settings(Method::EnergyMomentum, dt);
        let mut simulation = Simulation::start(shuttle(3, stiffness), settings).unwrap();
        run(&mut simulation, 0.5 * steps * dt).unwrap();
        // The restored simulation continues with the same bits.
        let file = simulation.to_bytes("half way").unwrap();
        run(&mut simulation, steps * dt).unwrap();
        let at_end = simulation.model().slider_position(0).to_bits();
        let (_, mut again) = Simulation::from_bytes(&file).unwrap();
        run(&mut again, steps * dt).unwrap();
        assert_eq!(again.model().slider_position(0).to_bits(), at_end);
        let drifts = drifts(&simulation);
        println!("EA = {stiffness}: {} steps, drift {}", simulation.counts().steps, sci(&drifts));
        assert!(drifts.iter().all(|drift| *drift < 2e-11), "{drifts:?}");
    }
}

#[test]
fn bead_on_a_kinked_axis_bounces_for_a_hundred_thousand_steps() {
    let is_long = std::env::var_os("WITHY_LONG").is_some();
    let steps = if is_long { 1e5 } else { 2e4 };
    let softer: &[f64] = if is_long { &[1e4, 1e3, 1e2] } else { &[1e4, 1e3] };
    for (stiffness, spans) in softer.iter().flat_map(|stiffness| [(*stiffness, 2), (*stiffness, 8)])
    {
        let mut scene = bouncing_bead(&smooth(spans), 1.0);
        let mut section = scene.beams[0].section.mean();
        (section.axial_stiffness, section.shear_stiffness) = (stiffness, stiffness / 2.6);
        scene.beams[0].section = section.into();
        scene.sliders[0].rule = SlidingRule::Kinked;
        let settings = settings(Method::EnergyMomentum, 0.01);
        let mut simulation = Simulation::start(scene, settings).unwrap();
        let ended = run(&mut simulation, steps * 0.01);
        let (bounces, drifts) = (simulation.arrivals().len(), drifts(&simulation));
        let counts = simulation.counts();
        println!(
            "EA = {stiffness:e}, {spans} spans: {} steps, {} retries, {bounces} bounces, drift {}",
            counts.steps,
            counts.retries,
            sci(&drifts)
        );
        ended.unwrap();
        assert!(bounces as f64 > 0.002 * steps, "{bounces}");
        assert!(drifts.iter().all(|drift| *drift < 2e-11), "{drifts:?}");
    }
}

#[test]
fn a_bead_bounces_for_a_hundred_thousand_steps() {
    let mesh = Mesh::bspline(2, 3, 2).unwrap();
    let dt = 0.02;
    let scene = bouncing_bead(&mesh, 1.0);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
    for steps in [1e2, 1e3, 1e4, 1e5] {
        run(&mut simulation, steps * dt).unwrap();
        let (counts, drifts) = (simulation.counts(), drifts(&simulation));
        println!(
            "{:6} steps, {:5} bounces, {:.1} tries each, {:.2} iterations a step: drift {}",
            counts.steps,
            simulation.arrivals().len(),
            counts.arrival_tries as f64 / simulation.arrivals().len() as f64,
            counts.newton_iterations as f64 / counts.steps as f64,
            sci(&drifts)
        );
        assert!(drifts.iter().all(|drift| *drift <= 1e-9), "{drifts:?}");
    }
    assert!(simulation.counts().steps >= 100_000 && simulation.arrivals().len() > 1000);
}
