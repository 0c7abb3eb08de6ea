//! Kelvin–Voigt damping compared with closed forms, at any relaxation time, with every integrator.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::{at, orders, scenes, simulate};
use withy::beams::{Mesh, Relaxation, Section};
use withy::geometry::Vec2;
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{Scene, StartMotion, System};
use withy::vibration::Modes;

const BENDING: f64 = 2.0;
const LENGTH: f64 = 2.0;

fn alike(time: f64) -> Relaxation {
    Relaxation { axial: time, shear: time, bending: time }
}

/// Slender beam along x of a material with a single relaxation time.
fn slender(time: f64) -> Scene {
    let mut scene = Scene::new("slender");
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 1e6,
        bending_stiffness: BENDING,
        mass_per_length: 0.5,
        rotary_inertia: 1e-7,
    };
    let mesh = Mesh::bspline(8, 4, 3).unwrap();
    let axis = scenes::line(at(0.0, 0.0), at(LENGTH, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &mesh, section);
    scene.add_damping(beam, alike(time)).unwrap();
    scene
}

fn push(scene: &mut Scene, along: f64, down: f64, until: f64) {
    let station = scene.station(0, along).unwrap();
    let force = LoadKind::Force { station, force: at(0.0, -down), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::hold_for(until).unwrap());
}

/// `ω` of a mode of a slender beam with the eigenvalue `β L`.
fn frequency(beta: f64) -> f64 {
    beta * beta * (BENDING / 0.5_f64).sqrt() / (LENGTH * LENGTH)
}

/// Values of `height` at the control points after each step between two times.
fn heights(scene: Scene, dt: f64, (from, end): (f64, f64), height: fn(&[Vec2]) -> f64) -> Vec<f64> {
    let mut simulation = simulate(scene, Method::EnergyMomentum, dt, from);
    let mut heights = Vec::new();
    while simulation.time() < end {
        let next = simulation.time() + dt;
        crate::common::run(&mut simulation, next).unwrap();
        heights.push(height(simulation.model().control_points().next().unwrap()));
    }
    heights
}

/// Local maxima, interpolated with parabolas.
fn peaks(values: &[f64]) -> Vec<f64> {
    let vertex = |around: &[f64]| {
        let (slope, bend) =
            (0.5 * (around[2] - around[0]), around[2] - 2.0 * around[1] + around[0]);
        around[1] - 0.5 * slope * slope / bend
    };
    let is_peak = |around: &&[f64]| around[0] < around[1] && around[1] >= around[2];
    values.windows(3).filter(is_peak).map(vertex).collect()
}

fn assert_decrement(label: &str, heights: &[f64], ratio: f64) {
    let peaks = peaks(heights);
    let (first, last) = (peaks[0], peaks[peaks.len() - 1]);
    let found = (first / last).ln() / (peaks.len() - 1) as f64;
    let expected = 2.0 * PI * ratio / (1.0 - ratio * ratio).sqrt();
    println!("{label}: {} peaks, decrement {found}, expected {expected}", peaks.len());
    assert!((found / expected - 1.0).abs() < 2e-3, "{label}: {found} {expected}");
}

#[test]
fn cantilever_oscillation_decays_by_its_relaxation_time() {
    let omega = frequency(1.875_104_068_711_961);
    let (ratio, period) = (0.02, 2.0 * PI / omega);
    let mut scene = slender(2.0 * ratio / omega);
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    push(&mut scene, LENGTH, 1e-4, 1.3 * period);
    let modes = Modes::of(&System::assemble(&scene).unwrap(), 2, &mut || true).unwrap();
    let message: Vec<f64> = modes.damping_ratios().collect();
    assert!((message[0] / ratio - 1.0).abs() < 1e-4, "{message:?}");
    // The damping ratio is proportional to the frequency.
    assert!((message[1] / message[0] - 6.2669).abs() < 2e-3, "{message:?}");
    let tip = |points: &[Vec2]| points[points.len() - 1].y;
    let heights = heights(scene, period / 300.0, (3.0 * period, 9.0 * period), tip);
    assert_decrement("cantilever", &heights, ratio);
}

#[test]
fn vibration_of_a_free_beam_decays_and_flight_continues() {
    let omega = frequency(4.730_040_744_862_704);
    let (ratio, period) = (0.03, 2.0 * PI / omega);
    let mut scene = slender(2.0 * ratio / omega);
    scene.beams[0].motion = StartMotion { velocity: at(3.0, 1.0), spin: 0.0, centre: None };
    for (along, down) in [(0.0, -1e-4), (LENGTH, -1e-4), (0.5 * LENGTH, 2e-4)] {
        push(&mut scene, along, down, 1.3 * period);
    }
    let sag = |points: &[Vec2]| {
        let last = points.len() - 1;
        points[last / 2].y + points[last - last / 2].y - points[0].y - points[last].y
    };
    let heights = heights(scene, period / 300.0, (3.0 * period, 8.0 * period), sag);
    assert_decrement("free beam", &heights, ratio);
}

/// Free rotating bent beam, loaded by a smoothly increasing force.
fn tumbling(relaxation: Relaxation) -> Scene {
    let mut scene = Scene::new("tumbling");
    let axis = withy::geometry::Curve::arc(at(0.0, 0.0), 1.5, 0.2, 1.9).unwrap();
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let beam = scenes::add_beam(&mut scene, axis, &mesh, scenes::rod());
    scene.beams[beam].motion = StartMotion { velocity: at(1.0, 0.5), spin: 1.5, centre: None };
    scene.add_damping(beam, relaxation).unwrap();
    let station = scenes::end_of(&mut scene, beam);
    let force = LoadKind::Force { station, force: at(0.0, 12.0), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::smooth_pulse(2.0).unwrap());
    scene
}

fn tip(simulation: &Simulation) -> Vec2 {
    crate::common::ends(simulation)[1]
}

#[test]
fn damped_tumbling_beam_converges_at_the_order_of_the_method() {
    let relaxation = Relaxation { axial: 1e-3, shear: 2e-3, bending: 0.02 };
    let end = 0.8;
    let exact = tip(&simulate(tumbling(relaxation), Method::FourthOrder, 5e-4, end));
    for entry in INTEGRATORS {
        let errors: Vec<f64> = [0.01, 0.005, 0.0025]
            .map(|dt| (tip(&simulate(tumbling(relaxation), entry.method, dt, end)) - exact).norm())
            .into();
        let found = orders(&errors);
        println!("{}: {} {found:?}", entry.name, crate::common::sci(&errors));
        let expected = f64::from(entry.claims.order);
        assert!((found[1] - expected).abs() < 0.25, "{}: {errors:?} {found:?}", entry.name);
    }
}

#[test]
fn energy_balance_includes_material_dissipation_at_any_relaxation_time() {
    for time in [1e-9, 1e-4, 1e-2, 1.0, 1e3, 1e6] {
        for method in [Method::EnergyMomentum, Method::FourthOrder] {
            let simulation = simulate(tumbling(alike(time)), method, 0.05, 4.0);
            let history = simulation.history();
            let drifts = Invariant::ALL.map(|(_, invariant)| history.drift(invariant));
            let work = simulation.counts();
            let iterations = work.newton_iterations as f64 / work.steps as f64;
            let label = format!("{time:e}, {}", method.entry().name);
            println!("{label}: {} {iterations:.2} {}", crate::common::sci(&drifts), work.retries);
            assert!(drifts.iter().all(|drift| *drift < 1e-12), "{label}: {drifts:?}");
            let parts = if method == Method::FourthOrder { 7.0 } else { 1.0 };
            assert!(iterations < 5.0 * parts && work.retries == 0, "{label}: {iterations}");
            let all = history.column("dissipated").unwrap();
            assert_eq!(all, history.column("dissipated.beam1").unwrap());
            assert!(all[all.len() - 1] > 0.0 && all[0] == 0.0, "{label}");
            if method == Method::EnergyMomentum {
                assert!(all.windows(2).all(|pair| pair[1] >= pair[0]), "{label}");
            }
        }
    }
}

#[test]
fn material_damping_dissipates_all_energy_except_rigid_motion() {
    for entry in INTEGRATORS {
        let simulation = simulate(tumbling(alike(0.05)), entry.method, 0.05, 60.0);
        let last = simulation.history().samples().last().unwrap().measures;
        assert!(last.dissipated > 1e-3, "{}", entry.name);
        let before = simulation.history().samples().iter().rev().nth(200).unwrap().measures;
        let late = (last.dissipated - before.dissipated) / last.dissipated;
        let is_exact = entry.claims.energy == EnergyClaim::Conserved;
        assert!(!is_exact || late.abs() < 1e-4, "{}: {late:e}", entry.name);
    }
}

#[test]
fn damping_does_not_affect_a_beam_at_rest() {
    let scene = |damped: bool| {
        let mut scene = slender(if damped { 0.3 } else { 0.0 });
        let start = scene.station(0, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        let station = scene.station(0, LENGTH).unwrap();
        let force = LoadKind::Force { station, force: at(0.3, -1.0), frame: LoadFrame::Dead };
        scene.add_load(force, Schedule::constant(1.0).unwrap());
        scene
    };
    let rest = |damped: bool| {
        let loading = withy::statics::Loading::default();
        let rest =
            withy::statics::Equilibrium::find(scene(damped), loading, &mut |_| true).unwrap();
        rest.model().control_points().next().unwrap().to_vec()
    };
    assert_eq!(rest(true), rest(false));
}

#[test]
fn present_forces_include_viscous_forces() {
    let scene = tumbling(Relaxation { axial: 1e-3, shear: 2e-3, bending: 0.02 });
    let mut simulation = simulate(scene, Method::FourthOrder, 0.01, 0.6);
    let rates = |simulation: &Simulation| {
        use withy::integrators::Mechanism;
        simulation.model().rates().to_vec()
    };
    let before = rates(&simulation);
    let (mut copy, dt) = (simulation.fork().unwrap(), 1e-5);
    let now = copy.instant().unwrap();
    crate::common::run(&mut simulation, 0.6 + dt).unwrap();
    let after = rates(&simulation);
    let found = now.accelerations();
    let largest = found.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    for ((before, after), found) in before.iter().zip(&after).zip(found) {
        let mean = (after - before) / dt;
        assert!((mean - found).abs() < 1e-3 * largest, "{mean} {found} {largest}");
    }
}

/// The section moment follows from strains and strain rates, and is in equilibrium with the reaction of the clamp.
#[test]
fn section_forces_include_viscous_forces() {
    let omega = frequency(1.875_104_068_711_961);
    let mut scene = slender(0.6 / omega);
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    push(&mut scene, LENGTH, 1e-2, f64::MAX);
    let mut simulation = simulate(scene, Method::EnergyDecaying { chi: 1.0 }, 0.002, 0.05);
    let mut viscous = 0.0_f64;
    for _ in 0..20 {
        let next = simulation.time() + 0.02;
        crate::common::run(&mut simulation, next).unwrap();
        let section = simulation.section_forces(&start).unwrap();
        let now = simulation.instant().unwrap();
        let model = simulation.model();
        let (_, given) = model.transmission(simulation.scene(), 0).unwrap().read(now.reactions());
        let of_strain = BENDING * section.curvature;
        assert!(
            (given + section.moment).abs() < 5e-3 * 1e-2 * LENGTH,
            "{given} {}",
            section.moment
        );
        viscous = viscous.max((section.moment - of_strain).abs() / given.abs());
        let along = simulation.section_forces_along(0).unwrap();
        assert!((along[0].forces.moment - section.moment).abs() < 1e-12 * section.moment.abs());
    }
    println!("up to {viscous} of the moment at the clamp is viscous");
    assert!(viscous > 0.2);
}

#[test]
fn rigid_rotation_causes_no_viscous_forces() {
    let mut scene = slender(0.1);
    scene.beams[0].motion = StartMotion { velocity: at(3.0, 1.0), spin: 2.0, centre: None };
    let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 0.0);
    for sample in simulation.section_forces_along(0).unwrap() {
        // EA γ for a strain rate at rounding: 1e6 · 0.1 · 1e-16, times a small factor.
        let forces = sample.forces;
        let largest = forces.axial.abs().max(forces.shear.abs()).max(forces.moment.abs());
        assert!(largest < 1e-8, "{forces:?}");
    }
}
