//! Scripts that save simulations, load them in another run, and are checked in a dry run.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, RunOutcome, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

fn run_in(out: &Path, mode: RunMode, script: &str) -> (RunOutcome, String) {
    let messages = Notepad::default();
    let settings = RunSettings {
        out: out.to_owned(),
        diagnostics: Box::new(messages.clone()),
        ..RunSettings::silent(mode)
    };
    let outcome = run(&Program::named("script", script), &language(), settings);
    (outcome, messages.take())
}

#[track_caller]
fn assert_good(outcome: &RunOutcome) {
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), []);
}

fn message(outcome: &RunOutcome) -> String {
    match &outcome.ending {
        Ending::Failed(diagnostic) => diagnostic.to_string(),
        other => panic!("{other:?}"),
    }
}

const FIRST: &str = r#"
let s = section(#{ EA: 1e4, GA: 4e3, EI: 20, rho_A: 0.5, rho_I: 1e-3 });
let scene = new_scene("bead");
let rod = scene.beam(#{ name: "rod", axis: line([0, 0], [2, -0.4]), basis: bspline(6), section: s });
let bead = scene.particle([0.5, -0.1], 1, #{ name: "bead" });
scene.clamp(rod.start);
scene.gravity([0, -9.81]);
let ring = scene.slider(bead, rod, #{ name: "ring", ends: "release" });
let sim = scene.start(#{ dt: 0.01 });
sim.at(0.7, |sim| print(sim.t));
sim.run_to(0.3);
sim.save("half.withy");
"#;

const SECOND: &str = r#"
let sim = load_simulation("half.withy");
let scene = sim.scene;
check(sim.name == "bead" && sim.t == 0.3 && sim.steps == 30);
sim.run_to(0.6);
let ring = scene.slider_named("ring");
check(sim.slider_position(ring) > 0.3 && sim.history.drift("energy") < 1e-12);
print(sim.position(scene.particle_named("bead")));
sim.back(10);
check(sim.t == 0.5);
sim.rewind(0.3);
sim.save("half.withy");
"#;

#[test]
fn saved_simulation_continues_in_a_new_process() {
    let home = tempfile::tempdir().unwrap();
    let (outcome, messages) = run_in(home.path(), RunMode::Run, FIRST);
    assert_good(&outcome);
    assert!(messages.contains("without its pending functions of sim.at (1)"), "{messages}");
    assert_eq!(outcome.files, [home.path().join("half.withy")]);
    let file = std::fs::read(home.path().join("half.withy")).unwrap();
    for _ in 0..2 {
        let (outcome, messages) = run_in(home.path(), RunMode::Run, SECOND);
        assert_good(&outcome);
        assert_eq!(messages, "");
    }
    // The second script ends in its initial state, apart from the elapsed time.
    let again = std::fs::read(home.path().join("half.withy")).unwrap();
    assert!(again.len().abs_diff(file.len()) < 20);
}

#[test]
fn check_loads_saved_simulations_and_writes_nothing() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let both = format!(
        "{FIRST}\nlet again = load_simulation(\"half.withy\");\nagain.step(3);\nagain.back(7);\nlet other = again.fork();\nother.rewind(0);\nprint(again.scene.beam_named(\"rod\").length);"
    );
    assert_good(&run_in(&out, RunMode::DryRun, &both).0);
    assert!(!out.exists());
    let refused = message(&run_in(&out, RunMode::DryRun, SECOND).0);
    assert!(
        refused.contains("no file \"half.withy\"")
            && refused.contains("first run the script that writes it"),
        "{refused}"
    );
    assert_good(&run_in(&out, RunMode::Run, FIRST).0);
    let before = std::fs::read(out.join("half.withy")).unwrap();
    assert_good(&run_in(&out, RunMode::DryRun, "let sim = load_simulation(\"half.withy\");\nsim.run_to(2);\nsim.back(500);\nsim.rewind(0.1);\nsim.save(\"half.withy\");").0);
    assert_eq!(std::fs::read(out.join("half.withy")).unwrap(), before);
}

#[test]
fn incomplete_and_foreign_files_are_rejected_with_a_reason() {
    let home = tempfile::tempdir().unwrap();
    assert_good(&run_in(home.path(), RunMode::Run, FIRST).0);
    let path = home.path().join("half.withy");
    let file = std::fs::read(&path).unwrap();
    let refusal = |content: &[u8]| {
        std::fs::write(&path, content).unwrap();
        message(&run_in(home.path(), RunMode::Run, "load_simulation(\"half.withy\");").0)
    };
    let mut newer = file.clone();
    newer[8] += 1;
    let next = format!("in format {}", newer[8]);
    let mut damaged = file.clone();
    damaged[file.len() / 2] ^= 16;
    let cases: [(&[u8], &str); 5] = [
        (&file[..file.len() / 2], "the file is truncated"),
        (b"time,energy\n", "not a restart file"),
        (b"", "not a restart file"),
        (&newer, &next),
        (&damaged, "damaged: its checksum"),
    ];
    for (content, reason) in cases {
        let messages = refusal(content);
        assert!(
            messages.contains("cannot load \"half.withy\"") && messages.contains(reason),
            "{messages}"
        );
    }
}

#[test]
fn snapshots_are_stored_only_for_scripts_that_rewind() {
    let home = tempfile::tempdir().unwrap();
    let fall = "let scene = new_scene(\"fall\");\nscene.particle([0, 0], 1);\nlet sim = scene.start(#{ dt: 0.1 });\nsim.step(3);\n";
    assert_good(&run_in(home.path(), RunMode::Run, &format!("{fall}sim.back(2);")).0);
    assert_good(&run_in(home.path(), RunMode::Run, &format!("{fall}sim.rewind(0.1);")).0);
    let kept = |script: &str| {
        // A call by a function pointer is not visible in the tokens of the script.
        let outcome =
            run_in(home.path(), RunMode::Run, &format!("{script}Fn(\"ba\" + \"ck\").call(sim);")).0;
        matches!(outcome.ending, Ending::Finished)
    };
    assert!(!kept(fall));
    assert!(kept(&format!("{fall}let back = 1;\n")));
}
