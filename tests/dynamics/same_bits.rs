//! Reproducibility: pinned states of scenes of every kind are equal on every machine and with every C library, and repeated runs write equal files.
//!
//! `WITHY_UPDATE=1 cargo test --test dynamics same_bits` records intended changes.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Debug;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::fingerprint::fingerprint;
use crate::common::sliding::{Support, free_sliding_mass, kicked_sliding_particle};
use crate::common::{at, meshes, rails, run, scenes, settings, sliding_scenes};
use withy::beams::{Mesh, Section, SectionShape, Solid};
use withy::elementary;
use withy::geometry::{Curve, Vec2};
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, SlidingRule};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{Simulation, StepControl, StepSize};
use withy::statics::{ArcLength, Control, Equilibrium, Loading};
use withy::system::{Scene, StartMotion, System};
use withy::vibration::Modes;

/// Setting that keeps the GNU C library from using these instructions. The names depend on its version.
const PLAIN: (&str, &str) = (
    "GLIBC_TUNABLES",
    "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable,-FMA4_Usable,-AVX512F_Usable",
);

/// Fingerprint of all digits of a value. Names are left out, so that renaming changes no fingerprint.
fn hash(value: &impl Debug) -> u64 {
    // Scenes without springs omit these entries.
    let text = format!("{value:?}").replace(", stored: 0.0", "").replace(", dissipated: 0.0", "");
    fingerprint(without_names(&text).bytes())
}

/// Removes the names of types, variants and fields from a text of `Debug`.
fn without_names(text: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.split_inclusive(|c| !is_part(c))
        .map(|part| {
            let word = part.trim_end_matches(|c| !is_part(c));
            let is_name = word.starts_with(|c: char| c.is_alphabetic() || c == '_')
                && !["true", "false", "NaN", "inf"].contains(&word);
            if is_name { &part[word.len()..] } else { part }
        })
        .collect()
}

/// Fingerprint of a run: final state, history, and the error if a step has no solution.
fn moved(scene: Scene, method: Method, dt: impl Into<StepSize>, end: f64) -> u64 {
    let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
    let ended = run(&mut simulation, end);
    let name = &simulation.scene().name;
    assert!(simulation.counts().steps >= 10, "{name}: {} steps", simulation.counts().steps);
    let history = simulation.history();
    let columns: Vec<_> = history.columns().map(|(name, _)| history.column(name)).collect();
    hash(&(simulation.model().state(), columns, ended))
}

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

/// Rotating steel tube, loaded by a schedule of sines and a table.
fn spinning_tube() -> Scene {
    let shape = SectionShape::Tube { outer: 0.06, inner: 0.051 };
    let solid = Solid { youngs_modulus: 2.1e11, poisson: 0.29, density: 7850.0, shape };
    let mut scene = scenes::free_beam(&smooth(5), Section::from_solid(solid).unwrap());
    let velocity = at(0.3, -0.1);
    scene.beams[0].motion = StartMotion { velocity, spin: 1.3, centre: Some(at(2.0, 0.7)) };
    let station = scene.station(0, 7.0).unwrap();
    let sine = Schedule::sine(0.8, 3.0, 0.4).unwrap();
    let table = Schedule::table(vec![(0.0, 0.0), (0.2, 1.0), (0.6, -0.5)]).unwrap();
    let force = LoadKind::Force { station, force: at(200.0, 900.0), frame: LoadFrame::Follower };
    scene.add_load(force, sine);
    scene.add_load(LoadKind::Moment { station, moment: 400.0 }, table);
    scene
}

fn with_ends(mut scene: Scene, ends: EndAction) -> Scene {
    scene.sliders.iter_mut().for_each(|slider| slider.ends = ends);
    scene
}

/// Cantilever with a dead force at its tip.
fn loaded(mesh: &Mesh, force: Vec2) -> Scene {
    let mut scene = scenes::cantilever(mesh, scenes::spaghetti_section(1e4, 100.0));
    let station = scenes::end_of(&mut scene, 0);
    let load = LoadKind::Force { station, force, frame: LoadFrame::Dead };
    scene.add_load(load, Schedule::constant(1.0).unwrap());
    scene
}

fn at_rest(scene: Scene, loading: Loading) -> u64 {
    let rest = Equilibrium::find(scene, loading, &mut |_| true).unwrap();
    hash(&rest.path().points())
}

/// The deep arch of `tests/statics/equilibria.rs`, clamped at one end and hinged at the other, loaded up to its buckling load.
fn deep_arch() -> u64 {
    let lean = 17.5_f64.to_radians();
    let axis = Curve::arc(Vec2::zeros(), 100.0, -lean, PI + lean).unwrap();
    let (length, section) = (axis.length(), scenes::spaghetti_section(1e8, 1e6));
    let mut scene = Scene::new("deep arch");
    let beam = scenes::add_beam(&mut scene, axis, &smooth(40), section);
    let [start, crown, end] =
        [0.0, 0.5 * length, length].map(|at| scene.station(beam, at).unwrap());
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
    let load = LoadKind::Force { station: crown, force: at(0.0, -1000.0), frame: LoadFrame::Dead };
    scene.add_load(load, Schedule::constant(1.0).unwrap());
    let control = Control::ArcLength(ArcLength { longest: 0.05, points: 30 });
    at_rest(scene, Loading { steps: 20, control, ..Loading::default() })
}

fn modes(scene: &Scene, count: usize) -> u64 {
    let model = System::assemble(scene).unwrap();
    let modes = Modes::of(&model, count, &mut || true).unwrap();
    let shapes: Vec<_> = (0..count).map(|mode| modes.shapes().displaced(mode, 0.1)).collect();
    hash(&(modes.all(), shapes))
}

/// Values of all elementary functions, including large arguments and the limits of their domains.
fn elementary_functions() -> u64 {
    use elementary::*;
    let ofs: [fn(f64) -> f64; 17] = [
        sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln, log2,
        log10, square,
    ];
    let pairs: [fn(f64, f64) -> f64; 4] = [atan2, hypot, power, log];
    let arguments: Vec<f64> =
        (-600..600).map(|i| f64::from(i) * 0.0173 * (1.0 + f64::from(i * i))).collect();
    let small: Vec<f64> = (-500..=500).map(|i| f64::from(i) / 500.0).collect();
    let mut found = Vec::new();
    // The sign of NaN depends on the machine, but is not visible to users.
    let mut keep = |x: f64| found.push(if x.is_nan() { None } else { Some(x) });
    for x in arguments.iter().chain(&small) {
        ofs.iter().for_each(|of| keep(of(*x)));
        for y in [-2.5, 1e-3, 0.7, 3.0, 40.0] {
            pairs.iter().for_each(|of| keep(of(*x, y)));
        }
        (-3..9).for_each(|n| keep(whole_power(*x, n)));
    }
    hash(&found)
}

/// Fingerprints of scenes of all kinds.
fn all() -> Vec<(String, u64)> {
    use EndAction::{Bounce, Release, Stop};
    use Method::{EnergyDecaying, EnergyMomentum, FourthOrder, GeneralizedAlpha, Trapezoidal};
    use SlidingRule::{Conserving, Exact, Relaxed};
    let decaying = EnergyDecaying { chi: 0.1 };
    let alpha = GeneralizedAlpha { rho_infinity: 0.8 };
    let mut all = vec![("elementary functions".to_owned(), elementary_functions())];
    let mut keep = |name: &str, hash: u64| all.push((name.to_owned(), hash));

    for (name, mesh) in meshes(6) {
        let scene = scenes::spaghetti(&mesh, 1e4);
        keep(&format!("spaghetti, {name}"), moved(scene, EnergyMomentum, 0.1, 4.0));
    }
    let methods = [
        ("trapezoidal", Trapezoidal),
        ("energy-decaying", decaying),
        ("fourth order", FourthOrder),
        ("generalized alpha", alpha),
    ];
    for (name, method) in methods {
        keep(
            &format!("spaghetti, {name}"),
            moved(scenes::spaghetti(&smooth(7), 1e4), method, 0.1, 4.0),
        );
        keep(
            &format!("curved pendulum, {name}"),
            moved(scenes::curved_pendulum(&smooth(4)), method, 0.05, 1.5),
        );
    }
    for scene in scenes::all(&smooth(5)).into_iter().skip(1) {
        keep(&scene.name.clone(), moved(scene, EnergyMomentum, 0.05, 2.0));
    }
    let smooth_pulse = scenes::smooth_spaghetti(&smooth(6), 500.0);
    keep("spaghetti, smooth pulse", moved(smooth_pulse, EnergyMomentum, 0.1, 4.0));
    keep("spinning tube", moved(spinning_tube(), EnergyMomentum, 0.02, 0.8));

    let tolerance = StepControl::to(1e-3);
    keep(
        "adaptive spaghetti",
        moved(scenes::spaghetti(&smooth(6), 1e4), EnergyMomentum, tolerance, 4.0),
    );
    keep("adaptive pendulum", moved(scenes::curved_pendulum(&smooth(4)), alpha, tolerance, 1.0));
    let mass = |rule| free_sliding_mass([&smooth(2), &smooth(4)], 100.0, Support::Hinged, rule);
    let bouncing = with_ends(mass(Conserving), Bounce);
    keep("adaptive sliding mass", moved(bouncing, EnergyMomentum, tolerance, 0.3));

    for (name, rule) in [("conserving", Conserving), ("exact", Exact), ("relaxed", Relaxed)] {
        keep(
            &format!("sliding mass, {name}"),
            moved(with_ends(mass(rule), Stop), EnergyMomentum, 0.01, 0.5),
        );
    }
    let bouncing = rails::bouncing_bead(&smooth(4), 0.5);
    keep("bouncing bead", moved(bouncing, EnergyMomentum, 0.05, 3.0));
    keep(
        "sliding mass, released",
        moved(with_ends(mass(Conserving), Release), EnergyMomentum, 0.01, 0.5),
    );
    for (name, method) in methods {
        keep(
            &format!("kicked particle, {name}"),
            moved(
                with_ends(kicked_sliding_particle(&smooth(4), Conserving), Bounce),
                method,
                0.02,
                0.6,
            ),
        );
    }
    for scene in sliding_scenes::all(&smooth(4), Conserving).into_iter().skip(3) {
        keep(&scene.name.clone(), moved(scene, EnergyMomentum, 0.02, 0.7));
    }

    keep(
        "equilibrium by steps of load",
        at_rest(loaded(&smooth(8), at(-3.0, 6.0)), Loading { steps: 6, ..Loading::default() }),
    );
    keep("equilibrium along the path", deep_arch());
    keep("all modes", modes(&loaded(&smooth(6), at(0.0, 1.0)), 12));
    keep(
        "lowest modes of many",
        modes(&scenes::cantilever(&smooth(150), scenes::spaghetti_section(1e4, 100.0)), 5),
    );
    all
}

fn table() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dynamics/same_bits.txt")
}

#[test]
fn states_of_scenes_equal_the_recorded_states() {
    let found = all();
    assert!(found.len() >= 20);
    let text: String = found.iter().map(|(name, hash)| format!("{hash:016x} {name}\n")).collect();
    if std::env::var_os("WITHY_UPDATE").is_some() {
        fs::write(table(), text).unwrap();
        return;
    }
    let pinned = fs::read_to_string(table()).unwrap();
    let pinned: BTreeMap<&str, &str> = pinned
        .lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(hash, name)| (name, hash))
        .collect();
    let is_other = |(name, hash): &&(String, u64)| {
        pinned.get(name.as_str()).copied() != Some(format!("{hash:016x}").as_str())
    };
    let others: Vec<_> = found.iter().filter(is_other).map(|(name, _)| name.as_str()).collect();
    assert!(
        others.is_empty() && pinned.len() == found.len(),
        "other bits than were pinned: {}\n(of {} scenes; where that was meant, WITHY_UPDATE=1 cargo test --test dynamics same_bits pins them \
         anew)\n{text}",
        others.join("; "),
        found.len()
    );
}

/// Runs the same test in a child process whose C library uses no vector instructions.
#[test]
fn a_c_library_without_vector_instructions_changes_no_bit() {
    let name = "same_bits::states_of_scenes_equal_the_recorded_states";
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name])
        .env(PLAIN.0, PLAIN.1)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{said}");
}

/// Possible sources of nondeterminism: names of anonymous functions, elementary functions, and all kinds of output files.
const SCRIPT: &str = r#"
let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene("thrown");
let rod = scene.beam(#{ name: "rod", axis: arc([0, 0], 4, 0.3, 1.9), basis: bspline(6), section: slender });
scene.force(rod.end, [8, 3], sine(1, 2, 0.3));
let f = |x| switch x { 1 => "one", 2 => "two", "a" => "b", 3.5 => "c", 7..9 => "some", _ => sin(x) ^ 1.7 };
let g = |x, y| { let far = 0; for i in 0..3 { far += i * x } far + rod.length + y };
print(f);
print(f.name);
print(g.name);
print([f, #{ of: g }]);
print(#{ z: 1, a: 2, m: [f] });
for i in 1..60 {
    let x = 0.37 * i;
    print([sin(x), cos(x), tan(x), exp(x / 9), ln(x), log10(x), log2(x), x^1.3, x**0.7, atan2(x, 2), hypot(x, 3), 2^-i]);
    print([asin(1 / x - floor(1 / x)), sinh(x / 9), cosh(x / 9), tanh(x), asinh(x), acosh(1 + x), atanh(1 / (1 + x)), log(x, 7)]);
}
let sim = scene.start(#{ dt: 0.1 });
sim.at(0.5, |sim| print(sim.energy));
sim.run_to(3);
sim.save("thrown.withy");
write_history(sim, "thrown.csv");
plot_history(sim, ["kinetic", "strain"], "energies.svg");
plot_motion(sim, "motion.svg", #{ every: 0.5 });
plot_motion(sim, "motion.png", #{ every: 0.5 });
"#;

/// Standard output and output files of a run.
fn left(script: &Path, plain: bool) -> BTreeMap<String, Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.args(["run", "--quiet", "--out"]).arg(folder.path()).arg(script);
    if plain {
        command.env(PLAIN.0, PLAIN.1);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let entries = fs::read_dir(folder.path()).unwrap().map(Result::unwrap);
    let files = entries
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()));
    // The name of withy's record of written files starts with a dot.
    let files = files.filter(|(name, _)| !name.starts_with('.'));
    files.chain([("standard output".to_owned(), output.stdout)]).collect()
}

#[test]
fn equal_runs_give_equal_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("script.rhai");
    fs::write(&script, SCRIPT).unwrap();
    let once = left(&script, false);
    let names: Vec<&str> = once.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "energies.svg",
            "motion.png",
            "motion.svg",
            "standard output",
            "thrown.csv",
            "thrown.withy"
        ]
    );
    assert!(String::from_utf8_lossy(&once["standard output"]).contains("anon$"));
    for plain in [false, true] {
        let again = left(&script, plain);
        for (name, bytes) in &once {
            assert!(again.get(name) == Some(bytes), "{name} differs; plain: {plain}");
        }
    }
}
