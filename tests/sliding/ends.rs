//! Sliders at the ends of beams: exact arrival times, and conservation of energy and momenta.
#![allow(clippy::unwrap_used)]

use crate::common::rails::{bead, bouncing_bead, clamped_rail, rail};
use crate::common::sliding::{PAPER_STEP, sliding_particle};
use crate::common::{at, run, sci, settings};
use withy::beams::Mesh;
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, SlidingRule};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{Arrival, ArrivalKind, Invariant, NoMonitor, Simulation, SimulationError};
use withy::system::{MasterEnd, Scene, SliderState};

const ROUNDING: f64 = 1e-12;
const ACTIONS: [EndAction; 3] = [EndAction::Stop, EndAction::Bounce, EndAction::Release];

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

/// Methods that conserve all invariants. The second one has backward substeps.
const METHODS: [Method; 2] = [Method::EnergyMomentum, Method::FourthOrder];

fn start(scene: Scene, method: Method, dt: f64) -> Simulation {
    Simulation::start(scene, settings(method, dt)).unwrap()
}

fn simulated(scene: Scene, method: Method, dt: f64, end: f64) -> Simulation {
    let mut simulation = start(scene, method, dt);
    run(&mut simulation, end).unwrap();
    simulation
}

fn assert_kept(label: &str, simulation: &Simulation, tolerance: f64) -> [f64; 4] {
    let drifts = Invariant::ALL.map(|(_, invariant)| simulation.history().drift(invariant));
    assert!(drifts.iter().all(|drift| *drift <= tolerance), "{label}: {drifts:?}");
    drifts
}

fn position(simulation: &Simulation) -> f64 {
    simulation.model().slider_position(0)
}

fn speed(simulation: &Simulation) -> f64 {
    simulation.model().slider_speed(0)
}

fn kinds(simulation: &Simulation) -> Vec<ArrivalKind> {
    simulation.arrivals().iter().map(|arrival| arrival.kind).collect()
}

#[test]
fn a_bead_on_a_beam_at_rest_arrives_at_the_exact_time() {
    for method in METHODS {
        // P7a: no contact force, ξ = 0.95 - 5 t/L.
        let length = 10_f64.sqrt();
        for action in ACTIONS {
            let mut scene = sliding_particle(&smooth(4), 0.0, SlidingRule::Conserving);
            scene.sliders[0].ends = action;
            let mut simulation = start(scene, method, PAPER_STEP);
            run(&mut simulation, 0.7).unwrap();
            let arrival = simulation.arrivals()[0];
            let error = arrival.time - 0.95 * length / 5.0;
            let samples = simulation.history().samples();
            let xi = simulation.history().column("slider1.position").unwrap();
            let rows = samples.iter().zip(xi).filter(|(row, _)| row.measures.time <= arrival.time);
            let straight = |(row, xi): (&withy::simulation::Sample, f64)| {
                (xi - (0.95 - 5.0 * row.measures.time / length)).abs()
            };
            let off = rows.map(straight).fold(0.0, f64::max);
            let force = simulation.history().column("slider1.force").unwrap();
            let force = force.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            assert_eq!(arrival.end, Some(MasterEnd::Start));
            println!("{action:?}: time off by {error:.1e}, ξ by {off:.1e}, force {force:.1e}");
            // The contact force vanishes up to the rounding error of the gap over the square of the substep.
            let nothing = if method == Method::FourthOrder { 1e-9 } else { 1e-10 };
            assert!(
                error.abs() < 1e-13 && off < 1e-13 && force < nothing,
                "{error:e} {off:e} {force:e}"
            );
            assert_kept(&format!("{action:?}"), &simulation, ROUNDING);
            match action {
                EndAction::Stop => {
                    assert_eq!(simulation.time(), arrival.time);
                    assert!(position(&simulation).abs() < 1e-14, "{}", position(&simulation));
                    assert!(simulation.ending().unwrap().contains("the start of its beam"));
                    let again = simulation.step(&mut NoMonitor).unwrap_err();
                    assert!(matches!(again, SimulationError::Ended { .. }), "{again}");
                }
                EndAction::Bounce | EndAction::Contact => {
                    assert_eq!(arrival.kind, ArrivalKind::Bounced);
                    assert!(speed(&simulation) > 0.0 && position(&simulation) > 0.0);
                    assert_eq!(simulation.time(), 0.7);
                }
                EndAction::Release => {
                    assert_eq!(simulation.slider_state(0), SliderState::Released);
                    assert_eq!(speed(&simulation), 0.0);
                    assert!(position(&simulation).abs() < 1e-14);
                    // The released bead moves in a straight line.
                    let bead = simulation.model().control_points().last().unwrap()[0];
                    let expected = at(3.0, 1.0).normalize() * (0.95 * length - 5.0 * 0.7);
                    assert!((bead - expected).norm() < 1e-12, "{bead:?}");
                }
            }
        }
    }
}

#[test]
fn bead_between_walls_bounces_at_exact_times() {
    for method in METHODS {
        for dt in [0.01, 0.1, 0.35, 2.0] {
            for mesh in [smooth(4), Mesh::lagrange(3, 3).unwrap(), Mesh::lagrange(5, 1).unwrap()] {
                let mut scene = clamped_rail(&mesh, at(3.0, 1.0));
                let velocity = at(3.0, 1.0).normalize() * 10.0;
                bead(&mut scene, 0.3, 0.5, velocity, EndAction::Bounce);
                let simulation = simulated(scene, method, dt, 4.0);
                let arrivals = simulation.arrivals();
                let exact = |index: usize| (0.7 + index as f64) / 10.0;
                let error = arrivals.iter().enumerate().map(|(n, a)| (a.time - exact(n)).abs());
                let error = error.fold(0.0, f64::max);
                let drifts = assert_kept(&format!("dt = {dt}"), &simulation, ROUNDING);
                println!(
                    "dt = {dt:4}: {} arrivals off by {error:.1e}, {:.1} tries each, drift {}",
                    arrivals.len(),
                    simulation.counts().arrival_tries as f64 / arrivals.len() as f64,
                    sci(&drifts)
                );
                assert!(arrivals.len() == 40 && error < 1e-12, "{error:e}");
                assert!(kinds(&simulation).iter().all(|kind| *kind == ArrivalKind::Bounced));
            }
        }
    }
}

#[test]
fn bead_starting_at_an_end_leaves_or_arrives_at_once() {
    for method in METHODS {
        for (along, outward) in [(0.0, -1.0), (1.0, 1.0)] {
            for action in ACTIONS {
                for dt in [0.01, 0.3] {
                    let scene = |speed: f64| {
                        let mut scene = clamped_rail(&smooth(3), at(1.0, 0.0));
                        bead(&mut scene, along, 1.0, at(speed, 0.0), action);
                        scene
                    };
                    let label = format!("{action:?} at {along}, dt = {dt}");
                    let inward = simulated(scene(-2.0 * outward), method, dt, 0.4);
                    assert!(inward.arrivals().is_empty(), "{label}");
                    let distance = (position(&inward) - along).abs();
                    assert!((distance - 0.8).abs() < 1e-12, "{label}: {distance}");

                    let away = simulated(scene(2.0 * outward), method, dt, 0.4);
                    let Arrival { time, slider, .. } = away.arrivals()[0];
                    assert_eq!((time, slider), (0.0, 0), "{label}");
                    assert_kept(&label, &away, ROUNDING);
                    match action {
                        EndAction::Stop => assert_eq!((away.time(), position(&away)), (0.0, along)),
                        EndAction::Bounce | EndAction::Contact => {
                            let distance = (position(&away) - along).abs();
                            assert!((distance - 0.8).abs() < 1e-12, "{label}: {distance}");
                        }
                        EndAction::Release => {
                            let bead = away.model().control_points().last().unwrap()[0];
                            assert!((bead.x - along - 0.8 * outward).abs() < 1e-12, "{label}");
                        }
                    }
                }
            }
        }
    }
}

/// Bead that rests at the lower end of a vertical beam, with a force that lifts it from t = 0.5 on.
fn resting(mut scene: Scene, lift: f64) -> Scene {
    bead(&mut scene, 1.0, 2.0, at(0.0, 0.0), EndAction::Bounce);
    scene.gravity = at(0.0, -9.81);
    let station = scene.sliders[0].slave;
    let force = LoadKind::Force { station, force: at(0.0, lift), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::pulse(0.5, 10.0).unwrap());
    scene
}

#[test]
fn a_bead_pressed_against_a_stop_rests_there_in_steps_of_any_size() {
    for method in METHODS {
        for dt in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let scene = resting(clamped_rail(&smooth(4), at(0.0, -1.0)), 30.0);
            let simulation = simulated(scene, method, dt, 20.0 * dt);
            assert_eq!(kinds(&simulation), [ArrivalKind::Held], "dt = {dt:e}");
        }
    }
}

#[test]
fn a_bead_pressed_against_a_stop_rests_there_until_it_is_lifted() {
    for method in METHODS {
        for dt in [0.01, 0.03] {
            let scene = resting(clamped_rail(&smooth(4), at(0.0, -1.0)), 30.0);
            let mut simulation = start(scene, method, dt);
            run(&mut simulation, 0.5).unwrap();
            assert_eq!(kinds(&simulation), [ArrivalKind::Held]);
            assert_eq!(simulation.arrivals()[0].time, 0.0);
            assert_eq!(simulation.slider_state(0), SliderState::Held(MasterEnd::End));
            assert_eq!((position(&simulation), speed(&simulation)), (1.0, 0.0));
            let weight = simulation.model().contact_force(0) - at(0.0, -2.0 * 9.81);
            assert!(weight.norm() < 1e-10, "{weight:?}");
            run(&mut simulation, 0.9).unwrap();
            assert_eq!(simulation.slider_state(0), SliderState::Sliding);
            let flight: f64 = 0.4;
            let expected = -1.0 + 0.5 * (30.0 / 2.0 - 9.81) * flight * flight;
            let bead = simulation.model().control_points().last().unwrap()[0];
            let error = (bead - at(0.0, expected)).norm();
            println!("dt = {dt}: lifted to y = {expected}, off by {error:.1e}");
            assert!(error < 1e-12, "{error:e}");
            assert_eq!(kinds(&simulation), [ArrivalKind::Held]);
            assert_kept("lifted", &simulation, ROUNDING);
        }
    }
}

#[test]
fn bead_on_the_stop_of_a_shaken_beam_conserves_energy_and_momenta() {
    for method in METHODS {
        for mesh in [smooth(4), Mesh::lagrange(2, 3).unwrap()] {
            let mut scene = rail(&mesh, at(0.0, -1.0));
            let top = scene.station(0, 0.0).unwrap();
            scene.join(JointKind::Rigid, top, Partner::Ground).unwrap();
            // Gravity starts suddenly and causes waves in the beam that throw the bead up.
            let simulation = simulated(resting(scene, 30.0), method, 0.01, 1.0);
            let kinds = kinds(&simulation);
            println!("{} arrivals, then at ξ = {}", kinds.len(), position(&simulation));
            assert!(kinds.contains(&ArrivalKind::Held) && position(&simulation) < 0.9);
            assert_kept("hanging", &simulation, ROUNDING);
        }
    }
}

#[test]
fn arrivals_late_in_a_long_run_have_exact_times() {
    for method in METHODS {
        // At t = 1000 the spacing of floating-point numbers is 1e-13, in which the bead moves by 8e-13.
        let mut scene = clamped_rail(&smooth(2), at(3.0, 1.0));
        let velocity = at(3.0, 1.0).normalize() * 7.1;
        bead(&mut scene, 0.3, 0.5, velocity, EndAction::Bounce);
        let simulation = simulated(scene, method, 20.0, 1000.0);
        let late = simulation.arrivals().iter().enumerate();
        let error = late.map(|(n, a)| (a.time - (0.7 + n as f64) / 7.1).abs() / a.time);
        let (error, arrivals) = (error.fold(0.0, f64::max), simulation.arrivals().len());
        println!("{arrivals} arrivals, times off by {error:.1e} of themselves");
        assert!(arrivals == 7100 && error < 1e-12, "{arrivals} {error:e}");
        assert_kept("long", &simulation, 1e-11);
    }
}

#[test]
fn two_beads_that_arrive_in_the_same_step_arrive_in_their_order() {
    for method in METHODS {
        for action in ACTIONS {
            for (speed, first) in [(1.0, None), (1.05, Some(1)), (0.95, Some(0))] {
                let mut scene = clamped_rail(&smooth(4), at(1.0, 0.0));
                bead(&mut scene, 0.2, 1.0, at(-1.0, 0.0), action);
                bead(&mut scene, 0.8, 0.3, at(speed, 0.0), action);
                let simulation = simulated(scene, method, 0.15, 0.3);
                let arrivals = simulation.arrivals();
                let label = format!("{action:?}, {speed}: {arrivals:?}");
                assert_kept(&label, &simulation, ROUNDING);
                let expected = |slider| if slider == 0 { 0.2 } else { 0.2 / speed };
                let stops_before = action == EndAction::Stop && first.is_some();
                assert_eq!(arrivals.len(), if stops_before { 1 } else { 2 }, "{label}");
                for arrival in arrivals {
                    let error = arrival.time - expected(arrival.slider);
                    assert!(error.abs() < 1e-12, "{label}");
                }
                assert!(first.is_none_or(|first| first == arrivals[0].slider), "{label}");
            }
        }
    }
}

#[test]
fn bounces_and_departures_work_for_extreme_bead_masses() {
    for method in METHODS {
        for mass in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for action in ACTIONS {
                for mesh in [smooth(4), Mesh::lagrange(2, 3).unwrap()] {
                    let mut scene = bouncing_bead(&mesh, mass);
                    scene.sliders[0].ends = action;
                    let simulation = simulated(scene, method, 0.02, 2.0);
                    // The substeps after the many bounces are a thousandth of a step. The rounding error of the gap is divided by their duration (theory.md,
                    // section 16).
                    let tolerance = match (method, action) {
                        (Method::FourthOrder, EndAction::Bounce) => 2e-11,
                        _ => ROUNDING,
                    };
                    let drifts =
                        assert_kept(&format!("{mass:e} {action:?}"), &simulation, tolerance);
                    println!(
                        "mass {mass:7e} {action:8?} {:4} arrivals, {:4.1} tries each, drift {}",
                        simulation.arrivals().len(),
                        simulation.counts().arrival_tries as f64
                            / simulation.arrivals().len() as f64,
                        sci(&drifts)
                    );
                    assert!(!simulation.arrivals().is_empty());
                }
            }
        }
    }
}

#[test]
fn a_bead_leaves_a_swinging_beam_without_a_jump_of_energy_or_momentum() {
    for method in METHODS {
        for mesh in [smooth(4), Mesh::bspline(3, 3, 1).unwrap(), Mesh::lagrange(4, 2).unwrap()] {
            let mut scene = sliding_particle(&mesh, 1.5, SlidingRule::Conserving);
            scene.sliders[0].ends = EndAction::Release;
            let simulation = simulated(scene, method, PAPER_STEP, 3.0);
            assert_eq!(kinds(&simulation), [ArrivalKind::Released]);
            let time = simulation.arrivals()[0].time;
            let rows = simulation.history().samples();
            let at = rows.iter().position(|row| row.measures.time == time).unwrap();
            assert!(at > 1 && at + 2 < rows.len());
            assert_kept("released", &simulation, ROUNDING);
            // The bead moves with the velocity of its release.
            let path = |index: usize| {
                let numbers = simulation.trajectory().configuration(index);
                let [.., x, y] = numbers else { unreachable!() };
                (rows[index].measures.time, crate::common::at(*x, *y))
            };
            let ((t0, x0), (t1, x1), (t2, x2)) = (path(at), path(at + 1), path(rows.len() - 1));
            let bend = (x1 - x0) / (t1 - t0) - (x2 - x0) / (t2 - t0);
            assert!(bend.norm() < 1e-11, "{bend:?}");
            assert!(rows[at + 1..].iter().all(|row| row.measures.gap == 0.0));
        }
    }
}
