//! Time of a Newton iteration and of a step, in nanoseconds per unknown, for ten to a million unknowns.
//!
//! `cargo bench --bench step` prints all tables. Options after `--`:
//! - `--csv FILE`: measures only times that depend on the number of unknowns, and writes a table for `benches/compare_lapack.py FILE`.
//! - `--spans 1000,10000`: measures only beams with these numbers of spans.
//! - `--steps BEAMS,SPANS,STEPS`: only takes steps, for example to count instructions with valgrind.
//! - `--threads 1`: uses one thread. By default, large beams use all cores.
#![allow(clippy::unwrap_used)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::{Forces, INTEGRATORS, Inertia, Interval, Mechanism, Method, Stage};
use withy::joints::{EndAction, Restraint, Slider, SlidingRule, StartVelocities};
use withy::linalg::{BorderShape, BorderedMatrix};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::newton::Tolerance;
use withy::simulation::{NoMonitor, Simulation, SimulationSettings};
use withy::system::{BeamDefinition, ParticleDefinition, Scene, StartMotion, System};

/// Approximate duration of each measurement.
const TIME_LIMIT: Duration = Duration::from_millis(300);
const FEWEST_REPEATS: usize = 5;
const DT: f64 = 0.1;
/// End time of the flying spaghetti.
const END: f64 = 7.5;
/// Number of steps of a run with sliders.
const RUN: usize = 15;

/// Scene of a free beam. Its span length is that of the flying spaghetti, for any number of spans.
fn flying_scene(spans: usize) -> Scene {
    let mut scene = Scene::new("bench");
    let length = 10.0 / 14.0 * spans as f64;
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    let beam = BeamDefinition {
        name: "rod".to_owned(),
        axis: Curve::line(Vec2::zeros(), Vec2::new(0.6, -0.8) * length).unwrap(),
        mesh: Mesh::bspline(spans, 3, 2).unwrap(),
        section: section.into(),
        motion: StartMotion::default(),
    };
    let rod = scene.add_beam(beam).unwrap();
    let station = scene.station(rod, length).unwrap();
    let push = Schedule::hold_for(2.5).unwrap();
    let force = LoadKind::Force { station, force: Vec2::new(8.0, 0.0), frame: LoadFrame::Dead };
    scene.add_load(force, push.clone());
    scene.add_load(LoadKind::Moment { station, moment: -80.0 }, push);
    scene
}

fn flying_beam(spans: usize) -> System {
    System::assemble(&flying_scene(spans)).unwrap()
}

/// Free beam with particles that slide along it.
fn beaded_beam(spans: usize, beads: usize) -> System {
    let mut scene = flying_scene(spans);
    let length = scene.beams[0].axis.length();
    for bead in 0..beads {
        let arc_length = length * (bead as f64 + 0.5) / beads as f64;
        let station = Station::on_beam(0, arc_length);
        let position = scene.drawn_at(&station).unwrap();
        let particle = ParticleDefinition { name: format!("bead{bead}"), position };
        let slave = scene.add_particle(particle, 1.0).unwrap();
        let slider = Slider {
            name: format!("slider{bead}"),
            slave,
            master: 0,
            track: None,
            arc_length,
            rule: SlidingRule::Conserving,
            ends: EndAction::Bounce,
            restitution: 1.0,
            friction: 0.0,
            static_friction: None,
            restraint: Restraint::Place,
            velocities: StartVelocities::Check,
        };
        scene.add_slider(slider).unwrap();
    }
    System::assemble(&scene).unwrap()
}

/// Duration of a step with sliders.
fn sliding_cost(spans: usize, beads: usize) -> (usize, (f64, f64), f64) {
    let mut model = beaded_beam(spans, beads);
    let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
    let (mut steps, mut iterations) = (0, 0);
    let start = model.state();
    let cost = measure(|| {
        // The run is restarted repeatedly, so that the particles stay on the beam.
        let step = steps % RUN;
        if step == 0 {
            model.restore(&start);
        }
        let interval = Interval::between(step as f64 * DT, (step + 1) as f64 * DT);
        steps += 1;
        timed(|| iterations += integrator.step(&mut model, interval).unwrap().iterations)
    });
    (model.unknowns(), cost, iterations as f64 / steps as f64)
}

/// Duration of a recorded step of a simulation with a memory limit for snapshots [bytes], and size of a snapshot [bytes].
fn recorded_cost(spans: usize, limit: usize) -> ((f64, f64), usize) {
    let (method, tolerance) = (Method::EnergyMomentum, Tolerance::default());
    let settings = SimulationSettings { method, dt: DT.into(), tolerance };
    let mut simulation = Simulation::start(flying_scene(spans), settings).unwrap();
    simulation.enable_snapshots(limit);
    let cost = measure(|| timed(|| simulation.step(&mut NoMonitor).unwrap()));
    let (kept, bytes) = simulation.stored_snapshots();
    (cost, bytes / kept.max(1))
}

/// Repeats an action that reports its own duration. Returns the smallest duration and the median, in nanoseconds.
fn measure(mut action: impl FnMut() -> Duration) -> (f64, f64) {
    let begun = Instant::now();
    let mut times = Vec::new();
    while times.len() < FEWEST_REPEATS || begun.elapsed() < TIME_LIMIT {
        times.push(action().as_secs_f64() * 1e9);
    }
    times.sort_by(f64::total_cmp);
    (times[0], times[times.len() / 2])
}

fn timed(action: impl FnOnce()) -> Duration {
    let begun = Instant::now();
    action();
    begun.elapsed()
}

/// Duration of a step of the flying spaghetti over its whole run, and mean number of Newton iterations.
fn method_cost(method: Method, spans: usize, dt: f64) -> ((f64, f64), f64) {
    let mut model = flying_beam(spans);
    let flight = (END / dt).round() as usize;
    let mut integrator = method.build(&mut model, Tolerance::default());
    let (mut steps, mut iterations) = (0, 0);
    let start = model.state();
    let cost = measure(|| {
        let step = steps % flight;
        if step == 0 {
            model.restore(&start);
        }
        let interval = Interval::between(step as f64 * dt, (step + 1) as f64 * dt);
        steps += 1;
        timed(|| iterations += integrator.step(&mut model, interval).unwrap().iterations)
    });
    (cost, iterations as f64 / steps as f64)
}

/// Memory and times of a beam.
struct Costs {
    spans: usize,
    unknowns: usize,
    /// Memory of the model and of the work space of its integrator [bytes].
    bytes: usize,
    /// Times of assembly, factorisation, solution, final residual, and a whole step [ns].
    parts: [(f64, f64); 5],
    /// Mean number of Newton iterations per step.
    iterations: f64,
}

/// Resident memory of this process [bytes].
fn occupied() -> usize {
    memory_stats::memory_stats().unwrap().physical_mem
}

fn costs(spans: usize, threads: usize) -> Costs {
    let before = occupied();
    let mut model = flying_beam(spans);
    model.divide(threads);
    let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
    let (mut steps, mut iterations) = (0, 0);
    let step = measure(|| {
        let interval = Interval::between(steps as f64 * DT, (steps + 1) as f64 * DT);
        steps += 1;
        timed(|| iterations += integrator.step(&mut model, interval).unwrap().iterations)
    });
    let bytes = occupied().saturating_sub(before);

    let unknowns = model.unknowns();
    model.begin_step(Interval::between(0.0, DT), &Stage::ALL).unwrap();
    let increments: Vec<f64> = model.rates().iter().map(|rate| DT * rate).collect();
    let mut residual = vec![0.0; model.degrees_of_freedom()];
    let half_bandwidth = model.half_bandwidth();
    let mut tangent = BorderedMatrix::zeros(unknowns, half_bandwidth, BorderShape::default());
    tangent.use_threads(threads);
    let mut assemble = |model: &mut System, tangent: &mut BorderedMatrix| {
        tangent.clear();
        let tangent = tangent.band_mut();
        residual.fill(0.0);
        model.add_inertia(2.0 / (DT * DT), &increments, &mut residual);
        model.add_inertia_tangent(2.0 / (DT * DT), tangent);
        model.add_linearised_forces(Stage::Midpoint, &increments, 1.0, &mut residual, tangent);
    };
    let assembly = measure(|| timed(|| assemble(&mut model, &mut tangent)));
    let factorisation = measure(|| {
        assemble(&mut model, &mut tangent);
        timed(|| _ = black_box(tangent.factorise().unwrap()))
    });
    assemble(&mut model, &mut tangent);
    let mut factors = tangent.factorise().unwrap();
    let right: Vec<f64> = (0..unknowns).map(|i| (i as f64).sin()).collect();
    let mut solution = right.clone();
    let solving = measure(|| {
        solution.copy_from_slice(&right);
        timed(|| factors.solve(black_box(&mut solution)))
    });
    let mut out = vec![0.0; model.degrees_of_freedom()];
    let checking = measure(|| {
        out.fill(0.0);
        timed(|| {
            model.add_inertia(2.0 / (DT * DT), &increments, &mut out);
            black_box(model.add_forces(Stage::Midpoint, &increments, 1.0, &mut out));
        })
    });
    let parts = [assembly, factorisation, solving, checking, step];
    Costs { spans, unknowns, bytes, parts, iterations: iterations as f64 / steps as f64 }
}

/// System of parallel free beams.
fn flying_beams(beams: usize, spans: usize) -> System {
    let mut scene = flying_scene(spans);
    let first = scene.beams[0].clone();
    for beam in 1..beams {
        let from = Vec2::new(20.0 * beam as f64, 0.0);
        let along = Vec2::new(0.6, -0.8) * first.axis.length();
        let axis = Curve::line(from, from + along).unwrap();
        scene
            .add_beam(BeamDefinition { name: format!("rod{beam}"), axis, ..first.clone() })
            .unwrap();
    }
    System::assemble(&scene).unwrap()
}

/// Only takes steps of free beams. The difference between two numbers of steps gives the instructions per step in valgrind.
/// The argument `rule` contains the numbers of beams, spans and steps.
fn take_steps(rule: &str, threads: usize) {
    let numbers: Vec<usize> = rule.split(',').map(|number| number.parse().unwrap()).collect();
    let [beams, spans, steps] = numbers[..] else { panic!("--steps BEAMS,SPANS,STEPS") };
    let mut model = flying_beams(beams, spans);
    model.divide(threads);
    let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
    let (start, flight) = (model.state(), (END / DT).round() as usize);
    let (mut iterations, mut corrections, mut least) = (0, 0, f64::INFINITY);
    for step in 0..steps {
        let at = step % flight;
        if at == 0 {
            model.restore(&start);
        }
        let interval = Interval::between(at as f64 * DT, (at + 1) as f64 * DT);
        let mut work = 0;
        let time = timed(|| {
            let report = integrator.step(&mut model, interval).unwrap();
            (work, corrections) = (report.iterations, corrections + report.corrections);
        });
        iterations += work;
        least = least.min(time.as_secs_f64() * 1e6);
    }
    let each = |count: usize| count as f64 / steps as f64;
    println!(
        "{} unknowns, {:.2} iterations and {:.2} corrections a step, least {least:.1} µs",
        model.unknowns(),
        each(iterations),
        each(corrections)
    );
}

/// Numbers of spans of the measured beams. The largest beam has a million unknowns.
const SPANS: [usize; 6] = [14, 100, 1000, 10_000, 100_000, 333_331];

/// Prints the times that depend on the number of unknowns.
fn print_sizes(spans: &[usize], threads: usize) {
    println!(
        "nanoseconds per unknown, least / median; iteration = assembly + factorisation + solution\n"
    );
    println!(
        "{:>7} {:>9} {:>13} {:>13} {:>13} {:>13} {:>13} {:>15} {:>11} {:>6}",
        "spans",
        "unknowns",
        "assembly",
        "factorise",
        "solve",
        "iteration",
        "residual",
        "step",
        "iterations",
        "bytes"
    );
    for &spans in spans {
        let Costs { unknowns, bytes, parts, iterations, .. } = costs(spans, threads);
        let per_unknown = |(least, median): (f64, f64)| {
            format!("{:.0} / {:.0}", least / unknowns as f64, median / unknowns as f64)
        };
        let [assembly, factorisation, solving, checking, step] = parts;
        let sum = [assembly, factorisation, solving]
            .iter()
            .fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        println!(
            "{spans:>7} {unknowns:>9} {:>13} {:>13} {:>13} {:>13} {:>13} {:>15} {iterations:>11.2} {:>6}",
            per_unknown(assembly),
            per_unknown(factorisation),
            per_unknown(solving),
            per_unknown(sum),
            per_unknown(checking),
            per_unknown(step),
            bytes / unknowns
        );
    }
}

/// Writes the smallest times that depend on the number of unknowns, in nanoseconds per unknown.
fn write_sizes(file: &str, threads: usize) {
    let mut table = "spans,unknowns,assembly,factorise,solve,residual,step,bytes\n".to_owned();
    for Costs { spans, unknowns, bytes, parts, .. } in SPANS.map(|spans| costs(spans, threads)) {
        let parts = parts.map(|(least, _)| format!("{:.2}", least / unknowns as f64)).join(",");
        table += &format!("{spans},{unknowns},{parts},{}\n", bytes / unknowns);
    }
    std::fs::write(file, table).unwrap();
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name)?;
        Some(arguments[at + 1].as_str())
    };
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let threads = option("--threads").map_or(cores, |threads| threads.parse().unwrap());
    if let Some(file) = option("--csv") {
        return write_sizes(file, threads);
    }
    if let Some(rule) = option("--steps") {
        return take_steps(rule, threads);
    }
    if let Some(spans) = option("--spans") {
        let spans = spans.split(',').map(|spans| spans.parse().unwrap());
        return print_sizes(&spans.collect::<Vec<usize>>(), threads);
    }
    print_sizes(&SPANS, threads);
    println!("\nmicroseconds per step of the flying spaghetti, least / median\n");
    println!("{:>18} {:>6} {:>6} {:>15} {:>11}", "integrator", "spans", "dt", "step", "iterations");
    let chosen = [Method::EnergyMomentum, Method::FourthOrder];
    let few = chosen.into_iter().flat_map(|method| [(method, 8, 0.05), (method, 32, 0.025)]);
    let all = INTEGRATORS.iter().map(|entry| (entry.method, 14, DT));
    for (method, spans, dt) in all.chain(few) {
        let ((least, median), iterations) = method_cost(method, spans, dt);
        let step = format!("{:.1} / {:.1}", least / 1e3, median / 1e3);
        let name = method.entry().name;
        println!("{name:>18} {spans:>6} {dt:>6} {step:>15} {iterations:>11.2}");
    }
    println!(
        "\nmicroseconds per step of a simulation, least / median, without and with snapshots\n"
    );
    println!("{:>6} {:>17} {:>17} {:>17} {:>10}", "spans", "none", "filling", "full", "bytes");
    for spans in [14, 100, 1000] {
        let per_step =
            |(least, median): (f64, f64)| format!("{:.2} / {:.2}", least / 1e3, median / 1e3);
        let (none, _) = recorded_cost(spans, 0);
        let (filling, bytes) = recorded_cost(spans, 1 << 30);
        let (full, _) = recorded_cost(spans, 20 * bytes);
        let [none, filling, full] = [none, filling, full].map(per_step);
        println!("{spans:>6} {none:>17} {filling:>17} {full:>17} {bytes:>10}");
    }
    println!(
        "\nnanoseconds per unknown and step, least / median, with particles that slide along the beam\n"
    );
    println!(
        "{:>6} {:>8} {:>9} {:>13} {:>11}",
        "spans", "sliders", "unknowns", "step", "iterations"
    );
    for (spans, sliders) in
        [(10, 0), (10, 1), (100, 0), (100, 1), (100, 4), (1000, 0), (1000, 1), (1000, 4)]
    {
        let (unknowns, (least, median), iterations) = sliding_cost(spans, sliders);
        let per = |cost: f64| format!("{:.0}", cost / unknowns as f64);
        let step = format!("{} / {}", per(least), per(median));
        println!("{spans:>6} {sliders:>8} {unknowns:>9} {step:>13} {iterations:>11.2}");
    }
}
