//! Backward steps, and steps composed of substeps.
#![allow(clippy::unwrap_used)]

use std::rc::Rc;

use crate::common::{at, body_scenes, scenes, simulate};
use withy::beams::{Mesh, Section};
use withy::integrators::{Integrator, Interval, Method, StepError};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::newton::Tolerance;
use withy::system::{Measures, Scene, System};
use withy::vibration::Modes;

fn mesh() -> Mesh {
    Mesh::bspline(6, 3, 2).unwrap()
}

/// Model and integrator after some steps of 0.05.
fn under_way(scene: &Scene, method: Method, steps: u32) -> (System, Box<dyn Integrator>) {
    let mut model = System::assemble(scene).unwrap();
    let mut integrator = method.build(&mut model, Tolerance::default());
    for n in 0..steps {
        let interval = Interval::between(f64::from(n) * 0.05, f64::from(n + 1) * 0.05);
        integrator.step(&mut model, interval).unwrap();
    }
    (model, integrator)
}

fn numbers(measures: &Measures) -> [f64; 9] {
    [
        measures.energy.kinetic,
        measures.energy.strain,
        measures.energy.potential,
        measures.work,
        measures.momentum.norm(),
        measures.angular_momentum,
        measures.impulse.norm(),
        measures.angular_impulse,
        measures.gross_impulse,
    ]
}

#[test]
fn backward_step_reverses_a_forward_step() {
    for method in [Method::EnergyMomentum, Method::FourthOrder] {
        for scene in scenes::all(&mesh()).into_iter().chain(body_scenes::all(&mesh())) {
            let (mut model, mut integrator) = under_way(&scene, method, 5);
            let before = model.measure();
            let points: Vec<_> = model.control_points().flatten().copied().collect();
            integrator.step(&mut model, Interval::between(0.25, 0.3)).unwrap();
            let moved = model.measure();
            integrator.step(&mut model, Interval::between(0.3, 0.25)).unwrap();
            let after = model.measure();
            let label = format!("{method:?}, {}", scene.name);
            assert_eq!((before.time, after.time), (0.25, 0.25), "{label}");
            assert!(numbers(&moved) != numbers(&before), "{label}: nothing happened");
            for (now, then) in model.control_points().flatten().zip(&points) {
                assert!((now - then).norm() < 1e-11, "{label}: {now:?} {then:?}");
            }
            let size = numbers(&before).iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for (now, then) in numbers(&after).iter().zip(numbers(&before)) {
                assert!((now - then).abs() < 1e-10 * size, "{label}: {now} {then}");
            }
        }
    }
}

#[test]
fn measures_of_a_composed_step_count_its_parts_once() {
    // The impulse of a constant force is known. Backward substeps must not be counted twice.
    let mut scene = scenes::free_beam(&mesh(), scenes::spaghetti_section(1e4, 100.0));
    scene.gravity = crate::common::at(0.0, -9.81);
    let (mut model, _) = under_way(&scene, Method::FourthOrder, 4);
    let measures = model.measure();
    let expected = model.total_mass() * 9.81 * 0.2;
    assert!((measures.gross_impulse / expected - 1.0).abs() < 1e-13, "{measures:?}");
    assert!((measures.impulse.norm() / expected - 1.0).abs() < 1e-13, "{measures:?}");
}

/// Towed beam with a moment that is NaN in a time interval.
fn gap_in_a_load(from: f64, to: f64) -> Scene {
    let mut scene = scenes::towed(&mesh());
    let station = scenes::end_of(&mut scene, 0);
    let function = move |t: f64| Ok(if t > from && t < to { f64::NAN } else { t });
    let schedule = Schedule::Function { function: Rc::new(function), breaks: vec![] };
    scene.add_load(LoadKind::Moment { station, moment: 2.0 }, schedule);
    scene
}

#[test]
fn failed_part_fails_the_step_and_restores_its_start() {
    // Of the step from 0.25 to 0.3, the first substep evaluates the load at 0.2509, the third one at 0.2701 and the last one at 0.2991.
    for (from, to) in [(0.2502, 0.2535), (0.2695, 0.2707), (0.2985, 0.3)] {
        let (mut model, mut integrator) =
            under_way(&gap_in_a_load(from, to), Method::FourthOrder, 5);
        let before = model.state();
        let whole = Interval::between(0.25, 0.3);
        let error = integrator.step(&mut model, whole).unwrap_err();
        let StepError::Load { interval, .. } = &error else { panic!("{error}") };
        assert_eq!(*interval, whole, "the step is blamed, not its part");
        assert_eq!(model.state(), before, "a gap from {from}");
    }
}

#[test]
fn iterations_before_a_failed_part_are_counted() {
    // The load starts after the first substep.
    let mut scene = scenes::free_beam(&mesh(), scenes::spaghetti_section(1e4, 100.0));
    scene.beams[0].motion.spin = 1.0;
    let station = scenes::end_of(&mut scene, 0);
    let late = Schedule::Function {
        function: Rc::new(|t: f64| Ok(if t > 0.04 { 1e300 } else { 0.0 })),
        breaks: vec![],
    };
    scene.add_load(LoadKind::Moment { station, moment: 1.0 }, late);
    let (mut model, mut integrator) = under_way(&scene, Method::FourthOrder, 0);
    let before = model.state();
    let error = integrator.step(&mut model, Interval::between(0.0, 0.05)).unwrap_err();
    let StepError::Newton { source, before: earlier, .. } = &error else { panic!("{error}") };
    assert!(*earlier > 0, "{error}");
    assert_eq!(error.factorisations(), source.factorisations() + earlier);
    assert_eq!(model.state(), before);
}

/// Slender cantilever with an optional transverse tip load.
fn cantilever(load: Option<Schedule>) -> Scene {
    let section = Section { rotary_inertia: 1e-4, ..scenes::spaghetti_section(1e6, 100.0) };
    let mut scene = scenes::cantilever(&mesh(), section);
    if let Some(schedule) = load {
        let (station, force) = (scenes::end_of(&mut scene, 0), at(0.0, 0.01));
        scene.add_load(LoadKind::Force { station, force, frame: LoadFrame::Dead }, schedule);
    }
    scene
}

#[test]
fn slow_loads_do_not_excite_a_cantilever_much_faster_than_a_step() {
    // The phase angle of the lowest mode per step is 2π or 4π plus or minus the phase angle of the load, 0.3. The first frequencies are for the substeps of
    // this method, the last ones for those of Suzuki (1990), for which the energy grows 25-fold.
    let model = System::assemble(&cantilever(None)).unwrap();
    let modes = Modes::of(&model, 1, &mut || true).unwrap();
    let lowest = modes.all()[0].angular_frequency();
    for frequency in [6.739, 7.668, 28.46, 34.99, 8.506, 10.674] {
        let dt = frequency / lowest;
        let load = Schedule::sine(1.0, 0.3 / dt, 0.0).unwrap();
        let flight = simulate(cantilever(Some(load)), Method::FourthOrder, dt, 2500.0 * dt);
        let samples = flight.history().samples();
        let largest = |from: usize, to: usize| {
            let energies = samples[from..to].iter().map(|row| row.measures.energy.total());
            energies.fold(0.0, f64::max)
        };
        let (early, late) = (largest(0, 100), largest(2400, 2500));
        println!(
            "ω Δt = {frequency:6.3}: energy {early:.3e} at first, {late:.3e} after 2400 steps"
        );
        assert!(late < 1.25 * early, "{frequency}: {early:e} {late:e}");
    }
}
