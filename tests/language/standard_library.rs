//! Standard library from outside: precedence over files of the same name, positions of failed checks, imports in files and at the prompt, and help.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::process::Command;

use crate::common::notepad::Notepad;
use withy::repl::editor::completion::complete;
use withy::repl::session::{Reply, Session};
use withy::repl::shell::{ReplyTarget, Shell};
use withy::script::engine::runner::{Ending, RunOutcome, run};
use withy::script::library::MODULES;
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Runs a script in a folder with files. Returns the outcome and the messages.
fn run_beside(files: &[(&str, &str)], script: &str) -> (RunOutcome, String) {
    let home = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = home.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let message = Notepad::default();
    let settings =
        RunSettings { diagnostics: Box::new(message.clone()), ..RunSettings::silent(RunMode::Run) };
    let program = Program { folder: home.path().into(), ..Program::named("main.rhai", script) };
    (run(&program, &language(), settings), message.take())
}

fn failure(outcome: &RunOutcome) -> String {
    match &outcome.ending {
        Ending::Failed(diagnostic) => diagnostic.to_string(),
        ending => panic!("{ending:?}"),
    }
}

#[test]
fn failed_check_in_the_library_is_located_at_the_calling_line() {
    let script = "import \"std/checks\" as checks;\n\nlet held = checks::assert_close(\"tip\", 1.25, 1, 0.1);\n\
                  check(!held);\ncheck(false, \"own\");\nchecks::assert_fails(\"f\", || { check(false, \"inner\"); 1 }, \"x\");";
    let (outcome, message) = run_beside(&[], script);
    let lines: Vec<_> = outcome.checks.failed().iter().map(|check| check.line).collect();
    assert_eq!(lines, [3, 5, 6, 6], "{message}");
    let expected =
        "line 3: check failed: tip: value 1.25, expected 1, difference 2.500e-1, tolerance 0.1\n";
    assert!(message.starts_with(expected), "{message}");
}

#[test]
fn every_check_reports_the_found_and_the_expected_value() {
    let cases = [
        ("assert_relative(\"EI\", 2, 1, 0.1)", ["EI", "value 2", "expected 1", "1.000e0", "0.1"]),
        ("assert_at_most(\"gap\", 0.5, 0.1)", ["gap", "value 0.5", "at most 0.1", "4.000e-1", ""]),
        (
            "assert_near(\"tip\", [1, 2], [1, 3], 0.1)",
            ["tip", "[1, 2]", "[1, 3]", "1.000e0", "0.1"],
        ),
        (
            "assert_order(\"o\", [2, 1], [4, 1], 3, 0.1)",
            ["o: order 2.000", "expected 3", "1.000", "0.1", ""],
        ),
        (
            "assert_order(\"z\", [2, 1], [0, 0], 2, 0.1)",
            ["z: the order is undefined", "errors[0]", "is 0", "2", ""],
        ),
        ("assert_close(\"none\", nan, 1, 0.1)", ["none", "nan", "expected 1", "", "0.1"]),
        ("assert_fails(\"sum\", || 1, \"x\")", ["sum", "no error", "\"x\"", "", ""]),
        (
            "assert_fails(\"root\", || sqrt(\"\"), \"y\")",
            ["root", "must be a number", "\"y\"", "", ""],
        ),
    ];
    for (call, words) in cases {
        let (outcome, message) =
            run_beside(&[], &format!("import \"std/checks\" as c; c::{call};"));
        assert_eq!(outcome.checks.failed().len(), 1, "{call}");
        assert!(
            words.iter().all(|word| message.to_lowercase().contains(&word.to_lowercase())),
            "{message}"
        );
    }
}

#[test]
fn drift_beyond_the_tolerance_is_reported_with_its_time() {
    let script = "import \"std/checks\" as checks;
let scene = new_scene(\"turning\");
let s = section(#{ EA: 100, GA: 100, EI: 1, rho_A: 1, rho_I: 1 });
scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(2), section: s, spin: 3 });
let sim = scene.start(#{ dt: 0.2, integrator: trapezoidal() });
sim.run_to(1);
checks::assert_conserved(sim.history, [\"energy\", \"momentum\"], 1e-12);";
    let (_, message) = run_beside(&[], script);
    assert!(message.contains("line 7: check failed: energy: drift "), "{message}");
    assert!(message.contains("from t = 0 to 1, expected 0, tolerance 1e-12"), "{message}");
    assert!(!message.contains("momentum: drift"), "{message}");
}

#[test]
fn user_file_does_not_replace_a_library_module() {
    let files = [
        ("std/checks.rhai", "fn assert_close(a, b, c, d) { throw \"mine\" }"),
        ("std/mine.rhai", ""),
    ];
    let (outcome, message) =
        run_beside(&files, "import \"std/checks\" as c; c::assert_close(\"x\", 1, 1, 0);");
    assert!(matches!(outcome.ending, Ending::Finished), "{:?} {message}", outcome.ending);
    let (outcome, _) = run_beside(&files, "import \"std/mine\" as mine;");
    let said = failure(&outcome);
    assert!(said.contains("your own folder cannot be called std"), "{said}");
}

#[test]
fn imported_files_can_import_the_library_and_errors_show_the_trace() {
    let parts = "import \"std/sections\" as sections;\nfn steel(size) {\n    sections::rectangle(#{ width: size, hight: size } + sections::steel())\n}\n";
    let (outcome, _) =
        run_beside(&[("parts.rhai", parts)], "import \"parts\" as parts;\nparts::steel(0.1);");
    let said = failure(&outcome);
    for words in [
        "unknown option 'hight'",
        "parts.rhai:3:41",
        "in the library, raised at std/sections.rhai:",
        "called at line 2",
    ] {
        assert!(said.contains(words), "{words}\n{said}");
    }
}

#[test]
fn functions_and_closures_of_the_user_keep_their_names_and_variables() {
    let script = "import \"std/shapes\" as shapes;\nimport \"std/shapes\" as again;
fn sampled(function, pieces) { \"mine\" }
fn point(given) { \"mine\" }
let k = 2;
let wave = shapes::sine([0, 0], [1, 0], 0.1, 1);
check(wave.length > 1 && sampled(1, 2) == \"mine\");
check_close(again::sampled(|u| [u, k * u], 8).length, sqrt(5), 1e-12);";
    let (outcome, message) = run_beside(&[], script);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), [], "{message}");
}

#[test]
fn error_in_a_closure_of_the_user_keeps_its_position() {
    let script = "import \"std/shapes\" as shapes;\nshapes::sampled(|u|\n    [u, lost], 8);";
    let (outcome, _) = run_beside(&[], script);
    let Ending::Failed(diagnostic) = &outcome.ending else { panic!("{:?}", outcome.ending) };
    assert_eq!(diagnostic.location_text().as_deref(), Some("main.rhai:3:9"), "{diagnostic}");
}

#[test]
fn the_prompt_imports_the_library() {
    let message = Notepad::default();
    let settings =
        RunSettings { diagnostics: Box::new(message.clone()), ..RunSettings::silent(RunMode::Run) };
    let mut session = Session::new(language(), settings).unwrap();
    for input in
        ["import \"std/checks\" as checks;", "let a = 2;", "checks::assert_close(\"a\", a, 1, 0.1)"]
    {
        let reply = session.eval(input);
        assert!(matches!(reply, Reply::Done | Reply::Value(_)), "{input}: {reply:?}");
    }
    assert!(message.take().starts_with("line 3: check failed: a: value 2"));
}

#[test]
fn help_explains_modules_and_their_functions() {
    let docs = |name: &str| {
        let output =
            Command::new(env!("CARGO_BIN_EXE_withy")).args(["docs", name]).output().unwrap();
        String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
    };
    assert!(
        docs("sections::rectangle")
            .starts_with("sections::rectangle(options)\nA solid rectangle.\n")
    );
    assert!(docs("std/sections").starts_with("The library: std/sections\n"));
    assert!(docs("std/secions").contains("did you mean 'std/sections'?"));
    for module in MODULES {
        assert!(docs("").contains(&format!("\n  {}: ", module.name)), "{}", docs(""));
    }
}

#[test]
fn imported_names_are_completed_at_the_prompt() {
    let session = Session::new(language(), RunSettings::silent(RunMode::Run)).unwrap();
    let mut shell = Shell::new(session, ReplyTarget::Pipe);
    shell.submit("import \"std/sections\" as parts;");
    let (_, found) = complete("parts::rect", 11, &shell.surroundings());
    let written: Vec<_> = found.iter().map(|candidate| candidate.display.as_str()).collect();
    assert_eq!(written, ["rectangle(options)"]);
}
