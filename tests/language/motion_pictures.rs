//! Contents of motion pictures.
#![allow(clippy::unwrap_used)]

use std::fs;

use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Number of knot markers in a picture with the given options, for a beam that has run to t = 1.
fn knots(options: &str) -> usize {
    let out = tempfile::tempdir().unwrap();
    let script = format!(
        "let s = section(#{{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 }});
let scene = new_scene(\"spin\");
scene.beam(#{{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 }});
let sim = scene.start(#{{ dt: 0.1 }});
sim.run_to(1);
plot_motion(sim, \"spin.svg\", #{{ {options} }});"
    );
    let settings = RunSettings { out: out.path().to_owned(), ..RunSettings::silent(RunMode::Run) };
    let outcome = run(&Program::named("picture", &script), &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    fs::read_to_string(out.path().join("spin.svg")).unwrap().matches("<circle").count()
}

#[test]
fn last_snapshot_shows_the_present_configuration() {
    // The times 0, 0.3, 0.6, 0.9 and 1 are as many as 0, 0.25, 0.5, 0.75 and 1.
    assert_eq!(knots("every: 0.3"), knots("every: 0.25"));
    assert_eq!(knots("every: 0.3, to: 1"), knots("every: 0.25"));
    assert_eq!(knots("every: 0.3, from: 0.3, to: 0.8"), knots("every: 0.25, to: 0.5"));
    assert_eq!(knots("every: 0.1"), knots("every: 0.1, to: 1"));
    assert!(knots("every: 0.3") > knots("every: 0.3, to: 0.9"));
}
