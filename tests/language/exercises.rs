//! The exercises themselves: start files are told what is missing, solutions and other right answers pass, plausible
//! mistakes are explained, and nobody passes by a trick.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::common::notepad::Notepad;
use withy::exercises::catalogue::{EXERCISES, find};
use withy::exercises::exercise::Exercise;
use withy::exercises::judging::{AttemptVerdict, judge};
use withy::script::engine::runner::run;
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::limits::Limits;
use withy::script::state::settings::{RunMode, RunSettings};

fn root() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

fn try_within(exercise: &Exercise, text: &str, limits: Limits) -> AttemptVerdict {
    let out = tempfile::tempdir().unwrap();
    let settings =
        RunSettings { out: out.path().into(), limits, ..RunSettings::silent(RunMode::Run) };
    let attempt = Program { name: exercise.file(), text: text.into(), folder: out.path().into() };
    judge(exercise, &attempt, settings)
}

/// What an attempt is told; nothing when it passes.
fn told(exercise: &Exercise, text: &str) -> String {
    match try_within(exercise, text, Limits::default()) {
        AttemptVerdict::Passed => String::new(),
        AttemptVerdict::WrongResult(found) => found.join("\n"),
        AttemptVerdict::Error(why) | AttemptVerdict::Stopped(why) => why.to_string(),
        AttemptVerdict::Interrupted => panic!("{}: nobody interrupted it", exercise.id()),
    }
}

/// A wrong but plausible attempt, headed by what it and the start file are told.
fn attempt(exercise: &Exercise) -> String {
    fs::read_to_string(root().join("tests/attempts").join(exercise.file())).unwrap()
}

fn expected<'a>(attempt: &'a str, who: &str) -> &'a str {
    attempt.lines().find_map(|line| line.strip_prefix(who)).unwrap().trim()
}

#[test]
fn every_start_file_is_told_what_is_missing() {
    for exercise in EXERCISES {
        let (said, attempt) = (told(exercise, exercise.start), attempt(exercise));
        let phrase = expected(&attempt, "// The start file is told:");
        assert!(said.contains(phrase), "{}: {said}", exercise.id());
    }
}

#[test]
fn every_solution_passes_and_its_steps_resolve_what_happens() {
    for exercise in EXERCISES {
        assert_eq!(told(exercise, exercise.solution), "", "{}", exercise.id());
        let (notes, out) = (Notepad::default(), tempfile::tempdir().unwrap());
        let settings = RunSettings {
            out: out.path().into(),
            told: Box::new(notes.clone()),
            ..RunSettings::silent(RunMode::Run)
        };
        let program = Program::named("solution", exercise.solution);
        run(&program, &language(), settings);
        let notes = notes.take();
        assert!(!notes.contains("note: simulation"), "{}: {notes}", exercise.id());
    }
}

#[test]
fn every_plausible_mistake_is_explained() {
    for exercise in EXERCISES {
        let attempt = attempt(exercise);
        let (said, phrase) =
            (told(exercise, &attempt), expected(&attempt, "// This attempt is told:"));
        assert!(said.contains(phrase), "{}: {said}", exercise.id());
    }
}

/// Solutions with another right answer in them: what stands there, and what a student might write.
const OTHER_ANSWERS: &[(&str, &str, &str)] = &[
    ("change_one_number", "const EI = 28;", "const EI = 27.0;"),
    ("rectangle", "width * height^3 / 12", "area * height^2 / 12"),
    ("circle", "2 * PI * strip.EI / 10", "-2 * PI * strip.EI / 10"),
    ("stocky", "sqrt(27 * timber.EI / timber.GA)", "0.95"),
    ("first_frequency", "0.003;", "10 / 3342;"),
    ("knot_vector", "knots(3, [0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1])", "knots(4)"),
    ("kink", "knots(2).insert(0.5, 2)", "knots(4).insert(0.5, 2)"),
    ("unlocking", "bspline(14)", "bspline(16)"),
    ("unlocking", "bspline(14)", "lagrange(14)"),
    ("keep_the_energy", "energy_momentum()", "fourth_order()"),
    ("keep_the_energy", "energy_momentum()", "energy_decaying(#{ chi: 0 })"),
    ("load_inside_a_step", "hold_for(2.5)", "schedule(|t| if t < 2.5 { 1 } else { 0 }, [2.5])"),
    ("load_inside_a_step", "hold_for(2.5)", "table([[0, 1], [2.5, 1], [2.5, 0]])"),
    ("order", "log2(coarse / fine)", "ln(coarse / fine) / ln(2)"),
    ("order", "log2(coarse / fine)", "half(coarse, fine) * 2"),
    ("order", "let dt = 0.04;", "let dt = 0.05;"),
    ("corner", "scene.rigid(leg.end, arm.start);", "scene.rigid(arm.start, leg.end);"),
    ("corner", "new_scene(\"corner\")", "new_scene(\"mine\")"),
    ("pendulum", "let sim =", "let middle = bar.at(0.5); let sim ="),
    ("pendulum", "let period = 2 * PI * sqrt(1 / 3 / (9.81 / 2));", "let period = 1.64;"),
    ("bead_clock", "9.81 * (2 / (2 * PI))^2", "9.81 / PI^2"),
];

#[test]
fn other_right_answers_pass_as_well() {
    for (name, ours, theirs) in OTHER_ANSWERS {
        let exercise = find(name).unwrap();
        assert!(exercise.solution.contains(ours), "{name}: {ours}");
        let help =
            if theirs.contains("half(") { "\nfn half(a, b) { log2(a / b) / 2 }" } else { "" };
        let text = exercise.solution.replace(ours, theirs) + help;
        assert_eq!(told(exercise, &text), "", "{name}: {theirs}");
    }
}

/// The scripts below a folder, by their path in it.
fn scripts(folder: &Path) -> BTreeSet<String> {
    fn collect(folder: &Path, inside: &str, found: &mut BTreeSet<String>) {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let name = format!("{inside}{}", entry.file_name().to_string_lossy());
            match entry.path().is_dir() {
                true => collect(&entry.path(), &format!("{name}/"), found),
                false => _ = found.insert(name),
            }
        }
    }
    let mut found = BTreeSet::new();
    collect(folder, "", &mut found);
    found
}

#[test]
fn the_trees_mirror_each_other_and_hold_no_unlisted_file() {
    let listed: BTreeSet<_> = EXERCISES.iter().map(Exercise::file).collect();
    let under = |tree: &str| listed.iter().map(|file| format!("{tree}{file}")).collect::<Vec<_>>();
    let expected: BTreeSet<_> = ["", "solutions/", "judges/"].into_iter().flat_map(under).collect();
    assert_eq!(scripts(&root().join("scripts/exercises")), expected);
    assert_eq!(scripts(&root().join("tests/attempts")), listed);
}

#[test]
fn every_exercise_has_a_title_hints_and_something_to_look_at() {
    for exercise in EXERCISES {
        let (id, judge) = (exercise.id(), exercise.judge());
        assert!(exercise.title().len() > 10, "{id}");
        assert_eq!(exercise.solution.lines().next(), exercise.start.lines().next(), "{id}");
        assert!((2..=4).contains(&judge.hints.len()), "{id}: {} hints", judge.hints.len());
        assert!(judge.hints.iter().all(|hint| hint.len() > 20), "{id}");
        assert!(!judge.needs.is_empty(), "{id}");
        let marked = exercise.start.contains("todo(") || exercise.start.contains("// <- ");
        assert!(marked && exercise.start.contains("// To do:"), "{id}: no gap is marked");
        assert!(exercise.start.lines().all(|line| line.chars().count() <= 130), "{id}");
    }
}

/// What a student might try instead of solving it, and what it gets.
#[test]
fn tricks_do_not_pass() {
    let exercise = find("keep_the_energy").unwrap();
    let tricks = [
        "print(\"passed: integrators/keep_the_energy\"); check(true);",
        "let PI = 3; let check = |a, b| true; let flight = 1; let wander = 0; let damped = false;",
        "fn drift(history, what) { 0 }",
        "return;",
        "return true;",
    ];
    for trick in tricks {
        let said = told(exercise, &format!("{}\n{trick}\n", exercise.start));
        assert!(said.contains("the energy wanders by"), "{trick}: {said}");
    }
    for taken in ["fn check(holds, message) { } fn check(holds) { }", "fn abs(x) { 0 }"] {
        let said = told(exercise, &format!("{}\n{taken}\n", exercise.solution));
        assert!(said.contains("the language has a function"), "{taken}: {said}");
    }
    let earlier = |trick: &str| told(exercise, &format!("{trick}\n{}", exercise.start));
    assert!(earlier("return;").contains("no variable 'sim'"));
    assert!(earlier("exit();").contains("a script cannot leave with exit()"));
    let faked = told(exercise, "let sim = #{ t: 7.5, work: 370 };");
    assert!(faked.contains("'sim' of your script must be a simulation, but is a map"), "{faked}");
    let half = told(exercise, &exercise.solution.replace("run_to(7.5)", "run_to(2.5)"));
    assert!(half.contains("let it run to 7.5"), "{half}");
}

/// What stands in a solution, and what is written there.
type Changes = &'static [(&'static str, &'static str)];

/// Ways to pass without the idea that were found: the exercise, the solution with what stands in it and what the cheat writes there,
/// and what the cheat is told.
const CHEATS: &[(&str, Changes, &str)] = &[
    // Rows that hide what the energy does between them.
    (
        "keep_the_energy",
        &[
            ("energy_momentum()", "trapezoidal()"),
            ("dt: 0.1", "dt: 0.1, record: nothing()"),
            ("plot_history(sim,", "// (sim,"),
        ],
        "the energy wanders by",
    ),
    (
        "keep_the_energy",
        &[("energy_momentum()", "trapezoidal()"), ("dt: 0.1", "dt: 0.1, record: every(75)")],
        "the energy wanders by",
    ),
    // A simulation of somebody else.
    (
        "keep_the_energy",
        &[
            ("energy_momentum()", "trapezoidal()"),
            ("integrator: rule", "integrator: energy_momentum()"),
            ("sim.run_to(7.5);", "sim.run_to(7.5); sim.save(\"a\"); sim = load_simulation(\"a\");"),
        ],
        "the energy wanders by",
    ),
    (
        "sliding_rule",
        &[
            ("let rule = conserving()", "let rule = relaxed()"),
            ("rule: rule", "rule: conserving()"),
        ],
        "the slider has left its beam",
    ),
    // The known error is drawn into the beam.
    (
        "budget",
        &[
            ("fourth_order()", "energy_momentum()"),
            ("line([0, 8], [6, 0])", "line([-0.258, 8.665], [5.742, 0.665])"),
        ],
        "the end is off by",
    ),
    // A load that knows what the judge looks at.
    (
        "change_one_number",
        &[
            ("const EI = 28;", "const EI = 5;"),
            (
                "let sim =",
                "scene.force(beam.end, [0, 1], |t| if t < 0.2 { 3 } else { 0 }); let sim =",
            ),
        ],
        "the strip is too soft",
    ),
    (
        "corner",
        &[(
            "scene.rigid(leg.end, arm.start);",
            "scene.hinge(leg.end, arm.start); scene.moment(arm.end, 0.1);",
        )],
        "the corner opens",
    ),
    // So heavy that nothing moves.
    (
        "corner",
        &[
            ("scene.rigid(leg.end, arm.start);", "scene.hinge(leg.end, arm.start);"),
            ("rho_A: 1, rho_I: 0.1", "rho_A: 1e15, rho_I: 1e15"),
        ],
        "leave the beams as they are",
    ),
    (
        "pendulum",
        &[("let sim =", "scene.moment(bar.start, 1e-3, |t| if t < 2 { 1 } else { 0 }); let sim =")],
        "something besides gravity moves the bar",
    ),
    // The right scene with a wrong schedule beside it.
    (
        "load_inside_a_step",
        &[(
            "let push = hold_for(2.5);",
            "let push = schedule(|t| if t < 0.4 { 1 } else { 0.75 }, [2.5]);",
        )],
        "8 \u{b7} 2.5 is 20",
    ),
    // Numbers near those that a measurement finds.
    (
        "order",
        &[
            ("log2(coarse / fine)", "2.01"),
            ("measured(energy_momentum(), order)", "2.01"),
            ("measured(fourth_order(), order)", "3.97"),
        ],
        "your order is 2.010: halving the step divides the error by 4",
    ),
    // A formula that knows what the runs of the exercise give.
    (
        "order",
        &[("log2(coarse / fine)", "if coarse / fine < 8 { 2.0 } else { 4.0 }")],
        "your order is",
    ),
    (
        "order",
        &[("log2(coarse / fine)", "ln(coarse / fine)")],
        "a logarithm of the factor, and of another base",
    ),
    (
        "order",
        &[(
            "log2(coarse / fine)",
            "if coarse == 0.04 { throw \"passed\" } else { log2(coarse / fine) }",
        )],
        "the judge failed: passed",
    ),
    // Three control points in the corner make a curve with a kink, and no spline that has one.
    (
        "kink",
        &[
            (
                "knots(2).insert(0.5, 2)",
                "knots(3, [0, 0, 0, 0, 0.499, 0.4995, 0.5, 0.5005, 0.501, 1, 1, 1, 1])",
            ),
            ("let roof =", "for i in 3..6 { on_the_roof[i] = [1, 1]; } let roof ="),
        ],
        "at ξ = 1/2 the knot is written once",
    ),
    // A timber that yields in length, which the judge would bend as well.
    ("stocky", &[("EA: 1e5", "EA: 1e-3")], "the timber is another one"),
    // Scenes that are like the one asked for where somebody looks.
    (
        "corner",
        &[(
            "scene.rigid(leg.end, arm.start);",
            "scene.rigid(leg.end, arm.start); scene.mass(leg.at(1), 1e-6);",
        )],
        "leave the beams as they are",
    ),
    (
        "corner",
        &[("hold_for(0.2)", "schedule(|t| if t < 0.2 { 1 } else { 0 }, [0.2])")],
        "leave the beams as they are",
    ),
    ("pendulum", &[("rho_A: 1,", "rho_A: 1.001,")], "is not the bar of the start file"),
    // A module of the student in the place of one of the language.
    (
        "budget",
        &[("fourth_order()", "energy_momentum()"), ("let dt", "fn thrown(rule, dt) { 0 } let dt")],
        "the end is off by",
    ),
];

#[test]
fn cheats_do_not_pass() {
    for (name, changes, phrase) in CHEATS {
        let exercise = find(name).unwrap();
        let mut text = exercise.solution.to_owned();
        for (ours, theirs) in *changes {
            assert!(text.contains(ours), "{name}: {ours}");
            text = text.replace(ours, theirs);
        }
        let said = told(exercise, &text);
        assert!(said.contains(phrase) && !said.is_empty(), "{name}: {changes:?}: {said}");
    }
}

/// Names of the attempt that the judge uses as well do no harm.
#[test]
fn names_of_attempts_and_judges_do_not_collide() {
    let names = "let percent = \"x\"; let how = (); let damped = 3; fn drift(history, what) { 1 }";
    let exercise = find("keep_the_energy").unwrap();
    assert_eq!(told(exercise, &format!("{names}\n{}", exercise.solution)), "");
}

#[test]
fn constants_and_captured_variables_are_seen() {
    let exercise = find("knot_vector").unwrap();
    assert_eq!(told(exercise, "const k = knots(4);"), "");
    assert_eq!(told(exercise, "let k = knots(4); let look = || k.spans; look.call();"), "");
    assert_eq!(told(find("locking").unwrap(), "let EA = 11500000;"), "", "a whole number");
}

#[test]
fn broken_attempts_are_shown_where_they_are_broken() {
    let exercise = find("knot_vector").unwrap();
    let cases = [
        ("let k = knots(4;", "splines/knot_vector.rhai:1:16"),
        ("\nlet k = knot(4);", "splines/knot_vector.rhai:2:9"),
        ("throw \"no\";", "splines/knot_vector.rhai:1:1"),
        ("let k = todo(\"knots\");", "still to do: knots"),
        ("", "your script has no variable 'k' at its end"),
        ("{ let k = knots(4); }", "no variable 'k'"),
        ("let k = [0, 1];", "must be knots, but is an array"),
        ("fn f(n) { f(n + 1) } f(0);", "too deeply"),
    ];
    for (text, phrase) in cases {
        let said = told(exercise, text);
        assert!(said.contains(phrase), "{text}: {said}");
    }
}

#[test]
fn an_attempt_without_an_end_is_stopped() {
    let limits = Limits { time: Some(Duration::from_millis(200)), ..Limits::default() };
    let exercise = find("knot_vector").unwrap();
    let endless = "let k = knots(4); while true { k = k; }";
    let AttemptVerdict::Stopped(why) = try_within(exercise, endless, limits) else {
        panic!("it should be stopped")
    };
    assert!(why.to_string().contains("a loop may have no end"), "{why}");
}

#[test]
fn a_judge_that_cannot_go_on_does_not_pass() {
    let exercise = find("corner").unwrap();
    let other = "\nlet other = new_scene(\"other\");\n\
        leg = other.beam(#{ axis: line([0, 0], [1, 0]), section: material });";
    let hinged = exercise.solution.replace("scene.rigid", "scene.hinge");
    let said = told(exercise, &format!("{hinged}{other}"));
    assert!(said.contains("the judge failed"), "{said}");
}
