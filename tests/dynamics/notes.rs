//! Warnings about motion that the time steps do not resolve, and their absence in resolved runs.
#![allow(clippy::unwrap_used)]

use crate::common::notepad::Notepad;
use crate::common::scenes::{end_of, line, spring};
use crate::common::{at, run, settings, simulate};
use withy::beams::{Mesh, Section, Station};
use withy::integrators::Method;
use withy::joints::{
    EndAction, JointKind, Partner, Restraint, Slider, SlidingRule, StartVelocities,
};
use withy::script::engine::runner::{self, Ending, RunOutcome};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};
use withy::simulation::{NoMonitor, Simulation, StepControl, StepSize, Warning};
use withy::system::{
    Anchor, BeamDefinition, ParticleDefinition, Scene, SpringKind, SpringLaw, StartMotion,
    StationVelocity,
};

const METHODS: [Method; 3] = [Method::EnergyMomentum, Method::Trapezoidal, Method::FourthOrder];

/// Steel strip in `m`, `kg`, `s`: length 300 mm, width 25 mm, thickness 1 mm.
fn steel() -> Section {
    let (area, second) = (25e-6, 25e-3 * 1e-9 / 12.0);
    Section {
        axial_stiffness: 2.1e11 * area,
        shear_stiffness: 0.8e11 * area * 5.0 / 6.0,
        bending_stiffness: 2.1e11 * second,
        mass_per_length: 7850.0 * area,
        rotary_inertia: 7850.0 * second,
    }
}

fn beam(scene: &mut Scene, to: withy::geometry::Vec2, spans: usize, section: Section) -> usize {
    let name = scene.free_name("beam");
    let definition = BeamDefinition {
        name,
        axis: line(at(0.0, 0.0), to),
        mesh: Mesh::bspline(spans, 3, 2).unwrap(),
        section: section.into(),
        motion: StartMotion::default(),
    };
    scene.add_beam(definition).unwrap()
}

/// Clamped steel ruler under gravity that starts suddenly, and its first natural period.
fn ruler() -> (Scene, f64) {
    let (mut scene, section, length) = (Scene::new("ruler"), steel(), 0.3);
    beam(&mut scene, at(length, 0.0), 8, section);
    let start = Station::on_beam(0, 0.0);
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene.gravity = at(0.0, -9.81);
    let first = 1.875_104_068_711_961_f64.powi(2);
    let angular =
        first * (section.bending_stiffness / section.mass_per_length).sqrt() / length.powi(2);
    (scene, std::f64::consts::TAU / angular)
}

fn motion(notes: &[Warning]) -> Option<(f64, f64, Option<f64>)> {
    notes.iter().find_map(|note| match note {
        Warning::Motion { dt, unresolved_fraction: share, lowest, .. } => {
            Some((*dt, *share, *lowest))
        }
        _ => None,
    })
}

/// Warnings other than those about phase errors.
fn without_phase(simulation: &Simulation) -> Vec<Warning> {
    let notes = simulation.warnings().into_iter();
    notes.filter(|note| !matches!(note, Warning::Phase { .. })).collect()
}

/// Accumulated phase error [rad] and share of the kinetic energy in the warning; `None` without a warning.
fn phase(simulation: &Simulation) -> Option<(f64, f64)> {
    simulation.warnings().iter().find_map(|note| match note {
        Warning::Phase { phase, share, .. } => Some((*phase, *share)),
        _ => None,
    })
}

#[test]
fn phase_error_of_a_spinning_beam_is_reported() {
    // A free stiff beam rotates by 2 atan(Ω h/2) per step, except for its small rotary inertia.
    let spinning = |dt: f64, end: f64| {
        let mut scene = Scene::new("spinning");
        beam(&mut scene, at(0.3, 0.0), 4, steel());
        scene.beams[0].motion.spin = 1.0;
        simulate(scene, Method::EnergyMomentum, dt, end)
    };
    for dt in [0.1, 0.3] {
        let run = spinning(dt, 60.0);
        let exact = 60.0 - run.model().end_angles(0).0;
        let (lost, share) = phase(&run).unwrap();
        println!("dt = {dt}: lost {lost:.4} of {exact:.4}, share {share:.3}");
        assert!((lost / exact - 1.0).abs() < 0.15 && share > 0.9, "{lost} {exact} {share}");
    }
    assert_eq!(phase(&spinning(0.02, 60.0)), None);
}

#[test]
fn damped_vibration_and_adaptive_steps_have_no_phase_error_note() {
    let damped = |damping: f64, dt: StepSize, end: f64| {
        let mut scene = Scene::new("oscillator");
        let ball = ParticleDefinition { name: "ball".into(), position: at(1.5, 0.0) };
        let station = scene.add_particle(ball, 1.0).unwrap();
        let kind = SpringKind::Length(vec![Anchor::Station(station), Anchor::Ground(at(0.0, 0.0))]);
        spring(&mut scene, kind, SpringLaw::Linear { stiffness: 1.0, natural: 1.0 }, damping);
        simulate(scene, Method::EnergyMomentum, dt, end)
    };
    assert!(phase(&damped(0.0, 0.1.into(), 300.0)).is_some());
    assert!(phase(&damped(0.002, 0.1.into(), 300.0)).is_some());
    assert_eq!(phase(&damped(0.2, 0.1.into(), 300.0)), None);
    assert_eq!(phase(&damped(0.0, StepControl::to(1e-3).into(), 300.0)), None);
}

#[test]
fn vibration_periods_per_step_are_reported_only_for_coarse_steps() {
    for method in METHODS {
        let (scene, period) = ruler();
        let coarse = simulate(scene, method, 5.0, 500.0);
        let (dt, share, lowest) = motion(&coarse.warnings()).unwrap();
        let periods = dt / lowest.unwrap();
        println!("{method:?}: {periods:.3} periods a step, share {share:.3}");
        assert!((periods * period / 5.0 - 1.0).abs() < 0.01, "{periods} of {}", 5.0 / period);
        assert!(share > 0.9, "{share}");
        let (scene, _) = ruler();
        let fine = simulate(scene, method, period / 100.0, 4.0 * period);
        assert_eq!(fine.warnings(), []);
    }
}

#[test]
fn vibration_superposed_on_flight_is_reported() {
    // The bending energy is a twentieth of the translational energy, at 40 times the highest frequency that the steps resolve.
    let spinning = |bending: f64| {
        let mut scene = Scene::new("flight");
        beam(&mut scene, at(0.3, 0.0), 8, steel());
        scene.beams[0].motion.velocity = at(1.0, 0.0);
        let middle = scene.station(0, 0.15).unwrap();
        scene.velocities.push(StationVelocity {
            station: middle,
            velocity: at(1.0, bending),
            spin: None,
        });
        simulate(scene, Method::EnergyMomentum, 0.5, 50.0)
    };
    let (_, share, _) = motion(&spinning(1.0).warnings()).unwrap();
    println!("share {share:.3}");
    assert!(share < 0.2, "{share}");
    assert_eq!(spinning(0.0).warnings(), []);
}

#[test]
fn stiff_pendulum_and_scene_at_rest_cause_no_note() {
    let pendulum = |start: f64| {
        let mut scene = Scene::new("pendulum");
        beam(&mut scene, at(0.3 * start.sin(), -0.3 * start.cos()), 4, steel());
        scene.join(JointKind::Hinge, Station::on_beam(0, 0.0), Partner::Ground).unwrap();
        scene.gravity = at(0.0, -9.81);
        scene
    };
    // The swing has a period of 0.9, the first bending mode one of about 0.025. The steps are 0.4 to 2 times as long as the latter.
    for dt in [0.01, 0.03, 0.05] {
        let notes = without_phase(&simulate(pendulum(1.0), Method::EnergyMomentum, dt, 10.0));
        assert_eq!(notes, [], "dt = {dt}");
    }
    let mut floating = Scene::new("nothing happens");
    beam(&mut floating, at(0.3, 0.1), 8, steel());
    assert_eq!(simulate(floating, Method::EnergyMomentum, 5.0, 500.0).warnings(), []);
    let hanging = format!(
        "{RULER}let sim = scene.equilibrium().start(#{{ dt: 5 }});\nsim.run_to(500);\ncheck(sim.notes.is_empty());"
    );
    assert_eq!(outcome(&hanging).1, "");
}

#[test]
fn large_section_rotations_per_step_are_reported() {
    let spinning = |dt: f64| {
        let mut scene = Scene::new("spinning");
        beam(&mut scene, at(0.3, 0.0), 4, steel());
        scene.beams[0].motion.spin = 1.0;
        without_phase(&simulate(scene, Method::EnergyMomentum, dt, 10.0))
    };
    assert_eq!(spinning(0.5), []);
    let notes = spinning(1.0);
    let [Warning::Rotation { angle, .. }] = notes.as_slice() else { panic!("{notes:?}") };
    // tan(φ/2) = ω h/2
    assert!((angle - 2.0 * 0.5_f64.atan()).abs() < 1e-3, "{angle}");
}

/// Slider with a mass on a bar clamped at its start, at a fifth of the length from its end.
fn ring(stiffness: f64, mass: f64, speed: f64) -> Scene {
    let mut scene = Scene::new("bar");
    let section = Section {
        axial_stiffness: stiffness,
        shear_stiffness: stiffness / 3.0,
        bending_stiffness: 1e-3 * stiffness,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    };
    beam(&mut scene, at(1.0, 0.0), 10, section);
    scene.join(JointKind::Rigid, Station::on_beam(0, 0.0), Partner::Ground).unwrap();
    let bead = ParticleDefinition { name: "bead".into(), position: at(0.8, 0.0) };
    let slave = scene.add_particle(bead, mass).unwrap();
    let velocity = at(speed, 0.0);
    scene.velocities.push(StationVelocity { station: slave, velocity, spin: None });
    let slider = Slider {
        name: "ring".into(),
        slave,
        master: 0,
        track: None,
        arc_length: 0.8,
        rule: SlidingRule::Conserving,
        ends: EndAction::Contact,
        restitution: 1.0,
        friction: 0.0,
        static_friction: None,
        restraint: Restraint::Place,
        velocities: StartVelocities::Check,
    };
    scene.add_slider(slider).unwrap();
    scene
}

#[test]
fn only_inaccurate_bounces_are_reported() {
    // Saint-Venant's bar, struck by a body of its own mass: the exact rebound is 0.6990 for every EA.
    for (stiffness, dt) in
        [(1e4, 0.01), (1e4, 5e-4), (1e4, 1e-3), (1e6, 0.01), (1e6, 1e-4), (1e8, 0.01), (1e10, 0.01)]
    {
        let bar = simulate(ring(stiffness, 1.0, 1.0), Method::EnergyMomentum, dt, 0.6);
        let rebound = -bar.model().velocity(&slave(&bar)).x;
        let message = bar.warnings().iter().any(|note| matches!(note, Warning::Bounce { .. }));
        println!("EA = {stiffness:e}, dt = {dt}: rebound {rebound:.4}, told: {message}");
        let is_right = (rebound / 0.6990 - 1.0).abs() < 0.05;
        assert_eq!(message, !is_right, "EA = {stiffness:e}, dt = {dt}: {rebound}");
    }
    // An impact on a supported end causes no waves.
    let mut held = ring(1e10, 1.0, 1.0);
    let end = end_of(&mut held, 0);
    held.join(JointKind::Rigid, end, Partner::Ground).unwrap();
    let held = simulate(held, Method::EnergyMomentum, 0.01, 0.6);
    assert!(!held.arrivals().is_empty());
    assert_eq!(held.warnings(), []);
}

fn slave(simulation: &Simulation) -> withy::beams::BodyPoint {
    let scene = simulation.scene();
    let slave = scene.sliders[0].slave;
    scene.place(&slave, simulation.model().meshes()).unwrap()
}

#[test]
fn slider_passing_more_than_a_span_per_step_is_reported() {
    let passing = |speed: f64| simulate(ring(1e4, 1.0, -speed), Method::EnergyMomentum, 0.01, 0.02);
    let notes = passing(25.0).warnings();
    let way = notes.iter().find_map(|note| match note {
        Warning::SpansPerStep { spans, slider, .. } => Some((*spans, slider.clone())),
        _ => None,
    });
    let (spans, slider) = way.unwrap();
    assert!((spans - 2.5).abs() < 0.01 && slider == "ring", "{spans} {slider}");
    assert_eq!(passing(9.0).warnings(), []);
}

/// Pendulum of a flexible beam, solved to a given tolerance of Newton's method.
fn solved_to(tolerance: f64) -> Simulation {
    let mut scene = Scene::new("pendulum");
    let soft = Section {
        axial_stiffness: 1e3,
        shear_stiffness: 1e3,
        bending_stiffness: 1.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    };
    let bar = beam(&mut scene, at(1.0, 0.0), 4, soft);
    scene.join(JointKind::Hinge, Station::on_beam(bar, 0.0), Partner::Ground).unwrap();
    scene.gravity = at(0.0, -9.81);
    let mut settings = settings(Method::EnergyMomentum, 0.02);
    let loose = &mut settings.tolerance;
    [loose.force, loose.strain, loose.polish] = [tolerance; 3];
    let mut simulation = Simulation::start(scene, settings).unwrap();
    simulation.run_to(2.0, &mut NoMonitor).unwrap();
    simulation
}

#[test]
fn energy_error_beyond_the_claim_is_reported() {
    let message =
        |notes: Vec<Warning>| notes.iter().any(|note| matches!(note, Warning::Drift { .. }));
    assert!(message(solved_to(1e-3).warnings()));
    assert!(!message(solved_to(1e-11).warnings()));
}

#[test]
fn notes_refer_to_steps_before_the_present_time() {
    let mut simulation =
        Simulation::start(ruler().0, settings(Method::EnergyMomentum, 0.002)).unwrap();
    simulation.enable_snapshots(10_000_000);
    run(&mut simulation, 0.1).unwrap();
    assert_eq!(simulation.warnings(), []);
    let before = *simulation.model().resolution();
    // The continuation has the same resolution record as the saved simulation.
    let (name, mut again) = Simulation::from_bytes(&simulation.to_bytes("ruler").unwrap()).unwrap();
    assert_eq!((name.as_str(), *again.model().resolution()), ("ruler", before));
    run(&mut again, 0.2).unwrap();
    run(&mut simulation, 0.2).unwrap();
    assert_eq!(again.model().resolution(), simulation.model().resolution());
    assert_ne!(*simulation.model().resolution(), before);
    let fork = simulation.fork().unwrap();
    assert_eq!(fork.model().resolution(), simulation.model().resolution());
    simulation.rewind(0.1).unwrap();
    assert_eq!(*simulation.model().resolution(), before);

    let mut coarse = Simulation::start(ruler().0, settings(Method::EnergyMomentum, 5.0)).unwrap();
    coarse.enable_snapshots(10_000_000);
    run(&mut coarse, 50.0).unwrap();
    assert!(
        motion(&coarse.warnings()).is_some()
            && motion(&coarse.fork().unwrap().warnings()).is_some()
    );
    let (_, loaded) = Simulation::from_bytes(&coarse.to_bytes("coarse").unwrap()).unwrap();
    assert_eq!(loaded.warnings(), coarse.warnings());
    coarse.back(coarse.counts().steps).unwrap();
    assert_eq!(coarse.warnings(), []);
    coarse.step(&mut NoMonitor).unwrap();
    assert_eq!(coarse.warnings(), []);
}

fn outcome(script: &str) -> (RunOutcome, String) {
    let (message, out) = (Notepad::default(), tempfile::tempdir().unwrap());
    let settings = RunSettings {
        diagnostics: Box::new(message.clone()),
        out: out.path().to_owned(),
        ..RunSettings::silent(RunMode::Run)
    };
    let outcome = runner::run(&Program::named("test", script), &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), []);
    (outcome, message.take())
}

const RULER: &str = "let steel = section(#{ E: 2.1e11, nu: 0.3, density: 7850, shape: \"rectangle\", width: 0.025, height: 0.001 });
let scene = new_scene(\"ruler\");
let ruler = scene.beam(#{ axis: line([0, 0], [0.3, 0]), basis: bspline(8), section: steel });
scene.clamp(ruler.start);
scene.gravity([0, -9.81]);
";

#[test]
fn note_is_printed_once_reported_and_explained() {
    let script = format!(
        "{RULER}let sim = scene.start(#{{ dt: 5 }});\nsim.run_to(100);\nsim.run_to(200);\nsim.step(3);\nsim.run_to(300);\n\
         check(sim.notes.len() == 1);\ncheck(sim.explain().contains(\"first natural period\"));\n\
         let fork = sim.fork(\"other\");\nfork.run_to(400);\ncheck(fork.notes.len() == 1);"
    );
    let (outcome, message) = outcome(&script);
    println!("{message}");
    assert_eq!(
        message.matches("note: simulation 'ruler': steps are too long").count(),
        1,
        "{message}"
    );
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.contains("times the first natural period of the scene as drawn"), "{message}");
    let report = &outcome.simulations[0];
    let note = report["notes"][0].as_str().unwrap();
    assert!(
        note.starts_with("steps are too long") && note.contains("first natural period"),
        "{report}"
    );
    assert!(report["resolution"]["unresolved_share"].as_f64().unwrap() > 0.9, "{report}");
}

#[test]
fn notes_can_be_kept_without_printing_and_fine_steps_have_none() {
    let kept = format!(
        "{RULER}let sim = scene.start(#{{ dt: 5, notes: \"keep\" }});\nsim.run_to(100);\ncheck(sim.notes.len() == 1);\n\
         let other = sim.fork();\nother.run_to(200);"
    );
    assert_eq!(outcome(&kept).1, "");
    let fine = format!(
        "{RULER}let sim = scene.start(#{{ dt: 0.0005 }});\nsim.run_to(1);\ncheck(sim.notes.is_empty());\n\
         check(!sim.explain().contains(\"first natural period\"));"
    );
    let (outcome, message) = outcome(&fine);
    assert_eq!((message.as_str(), &outcome.simulations[0]["notes"]), ("", &serde_json::json!([])));
}

#[test]
fn unresolved_potential_well_of_a_bead_is_reported() {
    // Double well: the bead starts at rest, 6 % below the barrier.
    let script = |dt: &str, crosses: bool| {
        format!(
            "let s = section(#{{ EA: 1e7, GA: 1e7, EI: 1e6, rho_A: 10, rho_I: 10 }});
let scene = new_scene(\"wells\");
let height = |x| (1 - x^2)^2;
let points = [];
for n in 0..=40 {{ let x = -1.5 + 0.075 * n; points.push([x, height.call(x)]); }}
let shape = through(points);
let track = scene.beam(#{{ axis: shape, basis: bspline(40), section: s }});
scene.clamp(track.start);
scene.clamp(track.end);
let bead = scene.particle(shape.at(0.9), 1);
let ring = scene.slider(bead, track, #{{ name: \"ring\", ends: \"bounce\" }});
scene.gravity([0, -1]);
let sim = scene.start(#{{ dt: {dt} }});
sim.run_to(60);
check((min(sim.history.column(\"ring.position\")) < 0.5) == {crosses});"
        )
    };
    let (_, message) = outcome(&script("2.3", true));
    println!("{message}");
    assert!(message.contains("steps are too long for the motion"), "{message}");
    let (_, message) = outcome(&script("0.05", false));
    assert!(!message.contains("steps are too long"), "{message}");
}

#[test]
fn rounding_of_a_scene_at_rest_is_not_reported_as_vibration() {
    let mut scene = Scene::new("rest");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    let definition = BeamDefinition {
        name: "rod".to_owned(),
        axis: line(at(0.0, 8.0), at(6.0, 0.0)),
        mesh: Mesh::bspline(16, 3, 2).unwrap(),
        section: section.into(),
        motion: StartMotion::default(),
    };
    scene.add_beam(definition).unwrap();
    scene.join(JointKind::Rigid, Station::on_beam(0, 0.0), Partner::Ground).unwrap();
    let simulation = simulate(scene, Method::EnergyMomentum, 0.1, 10.0);
    let kinetic = simulation.history().column("kinetic").unwrap();
    assert!(kinetic.iter().any(|energy| *energy > 0.0), "it moves by rounding");
    assert!(motion(&simulation.warnings()).is_none());
}
