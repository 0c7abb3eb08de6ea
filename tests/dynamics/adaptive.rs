//! Adaptive steps: invariants, accuracy for a tolerance, ends of runs, and rewinding.
#![allow(clippy::unwrap_used)]

use crate::common::reference::distance;
use crate::common::{
    assert_energy_never_grows, body_scenes, ends, run, scenes, sci, settings, simulate,
    sliding_scenes,
};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::integrators::{EnergyClaim, INTEGRATORS, IntegratorEntry, Method};
use withy::joints::SlidingRule;
use withy::loads::{LoadKind, Schedule};
use withy::simulation::{
    Invariant, NoMonitor, Simulation, SimulationError, StepControl, StepSize, Warning, WorkCounts,
};
use withy::system::{
    Anchor, Origin, PointMass, Scene, Spring, SpringKind, SpringLaw, StationVelocity,
};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn adaptive(tolerance: f64) -> StepSize {
    StepControl::to(tolerance).into()
}

const LENGTH: f64 = 10.0;

/// Distance of the ends from their exact positions, relative to the length of the beam.
fn error(simulation: &Simulation, exact: &[Vec2; 2]) -> f64 {
    distance(&ends(simulation), exact) / LENGTH
}

#[test]
fn errors_decrease_with_the_tolerance() {
    let scene = || scenes::smooth_spaghetti(&smooth(14), 100.0);
    let exact = ends(&simulate(scene(), Method::FourthOrder, 0.0125, 5.0));
    for entry in INTEGRATORS {
        // The error of a first-order method is proportional to the tolerance itself.
        let tolerances = match entry.claims.order {
            1 => [3e-2, 1e-2, 3e-3, 1e-3],
            _ => [1e-2, 1e-3, 1e-4, 1e-5],
        };
        let found = tolerances.map(|tolerance| {
            let flight = simulate(scene(), entry.method, adaptive(tolerance), 5.0);
            let (counts, error) = (*flight.counts(), error(&flight, &exact));
            println!(
                "{:18} tolerance {tolerance:7.0e} error {error:8.1e} ratio {:6.3} steps {:5} rejected {:3} factorised {:6}",
                entry.name,
                error / tolerance,
                counts.steps,
                counts.rejected,
                counts.factorisations
            );
            error / tolerance
        });
        let (least, most) = found.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), ratio| {
            (least.min(*ratio), most.max(*ratio))
        });
        assert!(most < 2.0, "{}: {found:?}", entry.name);
        assert!(most / least < 5.0, "{}: {found:?}", entry.name);
    }
}

#[test]
fn errors_and_work_are_compared_with_fixed_steps() {
    for (name, schedule) in [("P1s", Schedule::smooth_pulse(2.5)), ("P1", Schedule::hold_for(2.5))]
    {
        let section = scenes::spaghetti_section(1e4, 100.0);
        let schedule = schedule.unwrap();
        let scene = || scenes::thrown(&smooth(14), section, schedule.clone(), Vec2::zeros());
        let exact = ends(&simulate(scene(), Method::FourthOrder, 0.005, 7.5));
        for method in [Method::EnergyMomentum, Method::FourthOrder] {
            let fixed = [0.2, 0.1, 0.05, 0.025, 0.0125].map(StepSize::from);
            let varying = [1e-2, 1e-3, 1e-4, 1e-5].map(adaptive);
            let mut errors = Vec::new();
            for size in fixed.into_iter().chain(varying) {
                let flight = simulate(scene(), method, size, 7.5);
                let WorkCounts { steps, rejected, factorisations, .. } = *flight.counts();
                println!(
                    "{name:4} {:16} {size:34} error {:8.1e} steps {steps:5} rejected {rejected:3} factorised {factorisations:6}",
                    method.entry().name,
                    error(&flight, &exact),
                    size = size.to_string(),
                );
                errors.push(error(&flight, &exact));
            }
            let varying = &errors[errors.len() - 4..];
            assert!(varying[3] < 3e-5 && varying[3] < 0.2 * varying[0], "{name}: {errors:?}");
        }
    }
}

fn claims(entry: &IntegratorEntry) -> [(Invariant, bool); 4] {
    [
        (Invariant::Energy, entry.claims.energy == EnergyClaim::Conserved),
        (Invariant::Momentum, entry.claims.momentum),
        (Invariant::AngularMomentum, entry.claims.angular_momentum),
        (Invariant::Gap, true),
    ]
}

#[test]
fn claimed_invariants_are_conserved_with_adaptive_steps() {
    for entry in INTEGRATORS {
        let with_sliders = sliding_scenes::all(&smooth(4), SlidingRule::Conserving);
        let flying = [scenes::spaghetti(&smooth(8), 1e4), scenes::spaghetti(&smooth(8), 1e8)];
        let others = [scenes::four_bar_linkage(&smooth(4)), scenes::flying_tree(&smooth(4))];
        let rigid = [body_scenes::double_pendulum(), body_scenes::dumbbell(&smooth(4))];
        let all = flying.into_iter().chain(others).chain(rigid).map(|scene| (scene, 3.0));
        let all = all.chain(with_sliders.into_iter().map(|scene| (scene, 0.4)));
        let mut worst = [0.0_f64; 4];
        for (scene, end) in all {
            let label = format!("{}, {}", entry.name, scene.name);
            let has_sliders = !scene.sliders.is_empty();
            let run = simulate(scene, entry.method, adaptive(3e-2), end);
            for (worst, (invariant, is_claimed)) in worst.iter_mut().zip(claims(entry)) {
                let drift = run.history().drift(invariant);
                // Sliding contacts conserve all invariants only under a midpoint rule, as with fixed steps.
                let is_claimed = is_claimed && (!has_sliders || entry.claims.angular_momentum);
                if is_claimed {
                    assert!(drift < 1e-11, "{label}: {invariant:?} drifts by {drift:.1e}");
                    *worst = worst.max(drift);
                }
            }
            if entry.claims.energy == EnergyClaim::NonIncreasing {
                assert_energy_never_grows(&label, run.history());
            }
            let sizes = run.history().column("dt").unwrap();
            assert!(sizes[2..].iter().any(|dt| (dt / sizes[1] - 1.0).abs() > 0.1), "{label}");
        }
        println!("{:18} worst drifts {}", entry.name, sci(&worst));
    }
}

#[test]
fn unclaimed_invariants_are_not_conserved_at_small_tolerances() {
    for entry in INTEGRATORS {
        let flight =
            simulate(scenes::spaghetti(&smooth(8), 1e4), entry.method, adaptive(1e-2), 7.5);
        // Every method conserves the momentum without supports, whether it claims so or not.
        let claims = claims(entry).into_iter().filter(|(of, _)| *of != Invariant::Momentum);
        for (invariant, is_claimed) in claims {
            let drift = flight.history().drift(invariant);
            assert!(is_claimed || drift > 1e-9, "{}: {invariant:?} {drift:.1e}", entry.name);
        }
    }
}

fn counted(scene: Scene, method: Method, tolerance: f64, end: f64) -> String {
    let WorkCounts { steps, rejected, retries, newton_iterations, factorisations, .. } =
        *simulate(scene, method, adaptive(tolerance), end).counts();
    format!(
        "{steps} steps, {rejected} rejected, {retries} failed, {newton_iterations} iterations, {factorisations} factorised"
    )
}

#[test]
fn work_counts_equal_recorded_counts() {
    let mesh = smooth(14);
    let flights = [
        counted(scenes::spaghetti(&mesh, 1e4), Method::EnergyMomentum, 1e-3, 7.5),
        counted(scenes::smooth_spaghetti(&mesh, 100.0), Method::EnergyMomentum, 1e-3, 7.5),
        counted(scenes::smooth_spaghetti(&mesh, 100.0), Method::FourthOrder, 1e-4, 7.5),
        counted(scenes::curved_pendulum(&mesh), Method::EnergyMomentum, 1e-3, 5.0),
        counted(
            sliding_scenes::abacus(&mesh, SlidingRule::Conserving),
            Method::EnergyMomentum,
            1e-3,
            0.5,
        ),
    ];
    let expected = [
        "572 steps, 60 rejected, 0 failed, 1723 iterations, 1907 factorised",
        "563 steps, 8 rejected, 0 failed, 1703 iterations, 1730 factorised",
        "93 steps, 7 rejected, 0 failed, 2519 iterations, 2702 factorised",
        "404 steps, 24 rejected, 0 failed, 1212 iterations, 1284 factorised",
        "31 steps, 1 rejected, 0 failed, 93 iterations, 96 factorised",
    ];
    assert_eq!(flights, expected);
}

#[test]
fn steps_end_at_load_jumps_and_are_small_after_them() {
    let scene = scenes::spaghetti(&smooth(14), 1e4);
    let control = StepControl { first: Some(1e-3), ..StepControl::to(1e-3) };
    let flight = simulate(scene, Method::EnergyMomentum, control, 5.0);
    let rows = flight.history().samples();
    let jump = rows.iter().position(|row| row.measures.time == 2.5).unwrap();
    let [before, after] = [rows[jump - 1].dt, rows[jump + 1].dt];
    assert!(before > 2e-3 && (after - 1e-3).abs() < 1e-12, "{before} {after}");
    assert!(rows[jump + 5].dt > 2e-3, "it grows again: {}", rows[jump + 5].dt);
    assert_eq!(rows.last().unwrap().measures.time, 5.0);
    for pair in rows.windows(2) {
        assert_eq!(pair[1].dt, pair[1].measures.time - pair[0].measures.time);
    }
}

#[test]
fn runs_in_pieces_do_not_reduce_the_step_size() {
    let scene = || scenes::smooth_spaghetti(&smooth(14), 100.0);
    let settings = settings(Method::EnergyMomentum, adaptive(1e-3));
    let mut pieces = Simulation::start(scene(), settings).unwrap();
    for piece in 1..=50 {
        let wish = pieces.dt();
        // The remaining step is so short that its size must not affect the next one.
        let time = pieces.time() + if piece % 2 == 0 { 1e-4 } else { 1.01 * wish };
        run(&mut pieces, time).unwrap();
        assert_eq!(pieces.time(), time);
        assert!(piece % 2 == 1 || pieces.dt() >= 0.99 * wish, "{piece}: {} {wish}", pieces.dt());
    }
    let limited = StepControl { largest: Some(0.05), ..StepControl::to(1e-1) };
    let flight = simulate(scene(), Method::EnergyMomentum, limited, 2.0);
    assert!(flight.history().column("dt").unwrap().iter().all(|dt| *dt <= 0.05 + 1e-15));
    assert!(flight.counts().steps >= 40);
}

/// Full-precision state of a simulation, without the elapsed time.
fn fingerprint(simulation: &Simulation) -> String {
    let counts = WorkCounts { wall: Default::default(), ..*simulation.counts() };
    let (rows, dt) = (simulation.history().samples(), simulation.dt());
    format!("{:?} {rows:?} {dt:?} {counts:?}", simulation.model().state())
}

#[test]
fn back_rewind_fork_save_and_load_continue_bit_for_bit() {
    for entry in INTEGRATORS {
        let slide = sliding_scenes::abacus(&smooth(4), SlidingRule::Conserving);
        for scene in [scenes::spaghetti(&smooth(4), 1e4), slide] {
            let label = format!("{}, {}", entry.name, scene.name);
            let settings = settings(entry.method, adaptive(1e-2));
            let mut straight = Simulation::start(scene.clone(), settings).unwrap();
            straight.enable_snapshots(1 << 28);
            let mut prints = vec![fingerprint(&straight)];
            for _ in 0..30 {
                let rows = straight.history().samples().len();
                straight.step(&mut NoMonitor).unwrap();
                prints.resize(straight.history().samples().len() - 1, String::new());
                assert!(prints.len() >= rows);
                prints.push(fingerprint(&straight));
            }
            let steps = straight.counts().steps;
            for back in [1, 7, steps / 2, steps] {
                let mut again = straight.fork().unwrap();
                again.back(back).unwrap();
                let kept = &prints[again.history().samples().len() - 1];
                assert!(kept.is_empty() || *kept == fingerprint(&again), "{label}: back {back}");
                let file = again.to_bytes("half way").unwrap();
                let (_, mut loaded) = Simulation::from_bytes(&file).unwrap();
                let mut fork = again.fork().unwrap();
                for simulation in [&mut again, &mut loaded, &mut fork] {
                    while simulation.history().samples().len() < prints.len() {
                        simulation.step(&mut NoMonitor).unwrap();
                    }
                    assert!(fingerprint(simulation) == prints[prints.len() - 1], "{label}: {back}");
                }
            }
            let time = 0.5 * straight.time();
            straight.rewind(time).unwrap();
            assert!(straight.time() <= time && straight.time() > 0.0, "{label}");
        }
    }
}

#[test]
fn unreachable_tolerance_is_an_error_and_history_is_kept() {
    let control = StepControl { smallest: Some(0.02), first: Some(0.1), ..StepControl::to(1e-5) };
    let settings = settings(Method::EnergyMomentum, control);
    let mut flight =
        Simulation::start(scenes::smooth_spaghetti(&smooth(8), 100.0), settings).unwrap();
    let error = run(&mut flight, 5.0).unwrap_err();
    let SimulationError::Tolerance { time, dt, error: by, .. } = error else { panic!("{error}") };
    assert!(dt <= 0.02 && by > 1.0 && time > 0.1 && time == flight.time());
    assert_eq!(flight.history().samples().last().unwrap().measures.time, time);
    let message = error.to_string();
    assert!(
        message.contains("tolerance 0.00001 requires steps below the smallest allowed one (0.02)"),
        "{message}"
    );
}

#[test]
fn unsolvable_steps_are_halved_down_to_the_smallest() {
    let mut scene = scenes::spaghetti(&smooth(8), 1e4);
    let station = scenes::end_of(&mut scene, 0);
    let late = Schedule::pulse(0.5, 100.0).unwrap();
    scene.add_load(LoadKind::Moment { station, moment: 1e300 }, late);
    let settings = settings(Method::EnergyMomentum, adaptive(1e-3));
    let mut flight = Simulation::start(scene, settings).unwrap();
    let error = run(&mut flight, 5.0).unwrap_err();
    let at_jump = matches!(
        error,
        SimulationError::Smallest { time: 0.5, .. } | SimulationError::Tolerance { time: 0.5, .. }
    );
    assert!(at_jump, "{error}");
    assert!(flight.time() == 0.5 && flight.counts().retries + flight.counts().rejected > 10);
}

/// Run of a beam from rest under a load that starts at a given time. The stop times differ from the schedule by rounding.
fn run_over_stops_that_round(first: Option<f64>, start: f64) -> Simulation {
    let schedule = match start {
        0.0 => Schedule::hold_for(0.3),
        from => Schedule::pulse(from, from + 0.3),
    };
    let section = scenes::spaghetti_section(1e4, 100.0);
    let scene = scenes::thrown(&smooth(4), section, schedule.unwrap(), Vec2::zeros());
    let control = StepControl { first, ..StepControl::to(1e-2) };
    let settings = settings(Method::EnergyMomentum, control);
    let mut flight = Simulation::start(scene, settings).unwrap();
    flight.enable_snapshots(1 << 28);
    for i in 1..=10 {
        run(&mut flight, start + i as f64 * 0.1).unwrap();
    }
    flight
}

#[test]
fn stops_that_differ_by_rounding_are_merged() {
    for first in [None, Some(1e-7)] {
        for start in [0.0, 1e3] {
            let mut flight = run_over_stops_that_round(first, start);
            assert_eq!(flight.counts().retries, 0, "{first:?} from {start}");
            let shortest = 0.2 * first.unwrap_or(1e-3);
            let sizes = flight.history().column("dt").unwrap();
            assert!(sizes[1..].iter().all(|dt| *dt > shortest), "{first:?} from {start}");
            flight.rewind(start + 0.3).unwrap();
            assert!((flight.time() - start - 0.3).abs() < 1e-9);
            for end in [0.3, 3.0 * 0.1, 0.1 + 0.1 + 0.1, 0.7] {
                run(&mut flight, start + end).unwrap();
            }
            assert!((flight.time() - start - 0.7).abs() < 1e-9);
            assert_eq!(flight.counts().retries, 0, "{first:?} from {start}");
        }
    }
}

#[test]
fn steps_at_rest_are_limited_by_the_largest_step() {
    let section = scenes::spaghetti_section(1e4, 100.0);
    let scene = scenes::free_beam(&smooth(2), section);
    for largest in [None, Some(10.0), Some(f64::MAX)] {
        let control = StepControl { first: Some(0.1), largest, ..StepControl::to(1e-3) };
        let settings = settings(Method::EnergyMomentum, control);
        let mut rest = Simulation::start(scene.clone(), settings).unwrap();
        let ran = (0..2000).try_for_each(|_| rest.step(&mut NoMonitor));
        println!("{largest:?}: t = {:e}, {ran:?}", rest.time());
        let longest = largest.unwrap_or(1e5);
        assert!(rest.time().is_finite() && rest.dt() <= longest);
        if longest < f64::MAX {
            ran.unwrap();
            assert!(rest.dt() > 0.99 * longest && rest.time() > 1900.0 * longest);
        }
    }
}

/// Clamped bar of 5 spans with an initial axial or transverse tip velocity.
fn struck_bar(velocity: Vec2) -> Scene {
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 1e6,
        bending_stiffness: 1e3,
        mass_per_length: 1.0,
        rotary_inertia: 1e-2,
    };
    let mut scene = scenes::cantilever(&smooth(5), section);
    let station = scenes::end_of(&mut scene, 0);
    scene.add_mass(PointMass { station, mass: 10.0, rotary_inertia: 0.0 }).unwrap();
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    scene
}

/// Particle on a spring of stiffness 1 and length 0, at a distance from its anchor equal to the scene length.
fn oscillator() -> Scene {
    let mut scene = Scene::new("oscillator");
    let mass = crate::common::sliding::particle(&mut scene, Vec2::new(1.0, 0.0), 1.0);
    let kind = SpringKind::Length(vec![Anchor::Ground(Vec2::zeros()), Anchor::Station(mass)]);
    let law = Some(SpringLaw::Linear { stiffness: 1.0, natural: 0.0 });
    let (name, origin) = ("spring".to_owned(), Origin::Zero);
    scene.add_spring(Spring { name, kind, law, origin, damping: 0.0.into(), rest: None }).unwrap();
    scene
}

#[test]
fn cause_of_many_steps_is_reported() {
    let decaying = Method::EnergyDecaying { chi: 0.1 };
    for (scene, method, cause) in [
        (struck_bar(Vec2::new(-0.1, 0.0)), Method::EnergyMomentum, "small fast vibration"),
        (oscillator(), decaying, "first-order method energy_decaying"),
        (oscillator(), Method::EnergyMomentum, ""),
    ] {
        let mut simulation = simulate(scene, method, adaptive(1e-4), 1.0);
        while simulation.counts().steps < 5000 {
            let end = simulation.time() + 5.0;
            run(&mut simulation, end).unwrap();
        }
        let (steps, notes) = (simulation.counts().steps, simulation.warnings());
        let message = notes.iter().find(|note| matches!(note, Warning::ManySteps { .. }));
        let message = message.map(Warning::to_string);
        println!("{steps}: {message:?}");
        assert_eq!(message.is_some(), !cause.is_empty());
        assert!(message.unwrap_or_default().contains(cause));
    }
}
