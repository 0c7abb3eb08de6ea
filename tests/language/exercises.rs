//! Exercises: start files and plausible mistakes have the expected findings, solutions and other right answers pass, and cheats fail.

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

/// Messages of the judge for an attempt; empty if the attempt passes.
fn messages(exercise: &Exercise, text: &str) -> String {
    match try_within(exercise, text, Limits::default()) {
        AttemptVerdict::Passed => String::new(),
        AttemptVerdict::WrongResult(found) => found.join("\n"),
        AttemptVerdict::Error(why) | AttemptVerdict::Stopped(why) => why.to_string(),
        AttemptVerdict::Interrupted => panic!("{}: nobody interrupted it", exercise.id()),
    }
}

/// A plausible mistake. Its first two lines contain parts of the findings for the start file and for this attempt.
fn attempt(exercise: &Exercise) -> String {
    fs::read_to_string(root().join("tests/attempts").join(exercise.file())).unwrap()
}

fn expected<'a>(attempt: &'a str, who: &str) -> &'a str {
    attempt.lines().find_map(|line| line.strip_prefix(who)).unwrap().trim()
}

#[test]
fn every_start_file_reports_its_missing_part() {
    for exercise in EXERCISES {
        let (said, attempt) = (messages(exercise, exercise.start), attempt(exercise));
        let phrase = expected(&attempt, "// Finding for the start file:");
        assert!(said.contains(phrase), "{}: {said}", exercise.id());
    }
}

/// Exercises whose steps shift the phase of vibrations.
const LONG_STEPS: [&str; 3] =
    ["integrators/keep_the_energy", "integrators/order", "sliding/corner"];

#[test]
fn every_solution_passes_with_resolved_steps() {
    for exercise in EXERCISES {
        assert_eq!(messages(exercise, exercise.solution), "", "{}", exercise.id());
        let (notes, out) = (Notepad::default(), tempfile::tempdir().unwrap());
        let settings = RunSettings {
            out: out.path().into(),
            diagnostics: Box::new(notes.clone()),
            ..RunSettings::silent(RunMode::Run)
        };
        let program = Program::named("solution", exercise.solution);
        run(&program, &language(), settings);
        let notes = notes.take();
        // These exercises take long steps and compare only quantities that do not depend on the phase of vibration.
        let is_long = LONG_STEPS.contains(&exercise.id().as_str());
        let is_silent = |line: &str| !line.contains("note: simulation");
        let is_allowed = |line: &str| is_long && line.contains("shifted the phase");
        assert!(
            notes.lines().all(|line| is_silent(line) || is_allowed(line)),
            "{}: {notes}",
            exercise.id()
        );
    }
}

#[test]
fn every_plausible_mistake_is_explained() {
    for exercise in EXERCISES {
        let attempt = attempt(exercise);
        let (said, phrase) =
            (messages(exercise, &attempt), expected(&attempt, "// Finding for this attempt:"));
        assert!(said.contains(phrase), "{}: {said}", exercise.id());
    }
}

/// Other right answers: the exercise, a text of its solution, and the text that a student might write instead.
const OTHER_ANSWERS: &[(&str, &str, &str)] = &[
    ("change_one_number", "const EI = 28;", "const EI = 27.0;"),
    ("rectangle", "width * height^3 / 12", "width * height * height^2 / 12"),
    (
        "rectangle",
        "width * height^3 / 12",
        "mean(linspace(-0.49995, 0.49995, 10000).map(|y| y^2)) * width * height^3",
    ),
    ("circle", "2 * PI * EI / length", "-2 * PI * EI / length"),
    ("circle", "2 * PI * EI / length", "{ let curvature = 6.2832 / length; curvature * EI }"),
    ("stocky", "sqrt(27 * EI / GA)", "3 * sqrt(3 * EI / GA)"),
    ("first_frequency", "0.0003 * frequency", "0.005 * frequency / 16.71"),
    (
        "first_frequency",
        "0.0003 * frequency",
        "2 * PI * frequency * 0.5^2 / 1.875^2 * sqrt(12 * 7850 / 2.1e11)",
    ),
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
    ("pendulum", "2 * PI * sqrt(L / 3 / (g / 2))", "2 * PI * sqrt(2 / 3 * L / g)"),
    ("bead_clock", "gravity * (period / (2 * PI))^2", "gravity * period^2 / 39.478"),
    (
        "bounces",
        "(length - x + 2 * length * (n - 1)) / speed",
        "((2 * n - 1) * length - x) / speed",
    ),
    ("launch", "behind / sqrt(2 * height / 9.81)", "behind * sqrt(9.81 / 2 / height)"),
    ("friction_angle", "atan(friction)", "asin(friction / sqrt(1 + friction^2))"),
    ("friction_angle", "atan(friction)", "radians(degrees(atan(friction)))"),
    ("bounce_heights", "drop * restitution^(2 * n)", "drop * (restitution^n)^2"),
    ("belt", "exp(friction * angle)", "(1 + friction * angle / 1e6)^1e6"),
    ("jam", "spacing / (2 * friction)", "0.5 * spacing / friction"),
    ("take_off", "\"above\"", "\"left\""),
    (
        "take_off",
        "2 * radius / 3 + speed^2 / (3 * gravity)",
        "(2 * gravity * radius + speed^2) / (3 * gravity)",
    ),
    ("best_angle", "linspace(20, 60, 41)", "linspace(15, 65, 101)"),
    ("whose_stiffness", "let EI = 24.7;", "let EI = found.parameters.EI;"),
];

#[test]
fn alternative_solutions_pass() {
    for (name, ours, theirs) in OTHER_ANSWERS {
        let exercise = find(name).unwrap();
        assert!(exercise.solution.contains(ours), "{name}: {ours}");
        let help =
            if theirs.contains("half(") { "\nfn half(a, b) { log2(a / b) / 2 }" } else { "" };
        let text = exercise.solution.replace(ours, theirs) + help;
        assert_eq!(messages(exercise, &text), "", "{name}: {theirs}");
    }
}

/// Scripts below a folder, by their relative paths.
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
fn exercise_folders_match_and_contain_no_unlisted_file() {
    let listed: BTreeSet<_> = EXERCISES.iter().map(Exercise::file).collect();
    let under = |tree: &str| listed.iter().map(|file| format!("{tree}{file}")).collect::<Vec<_>>();
    let expected: BTreeSet<_> = ["", "solutions/", "judges/"].into_iter().flat_map(under).collect();
    assert_eq!(scripts(&root().join("scripts/exercises")), expected);
    assert_eq!(scripts(&root().join("tests/attempts")), listed);
}

#[test]
fn every_exercise_has_a_title_hints_required_variables_and_a_marked_gap() {
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

/// Attempts that avoid the solution of an exercise, with the expected verdicts.
#[test]
fn attempts_to_bypass_the_judge_do_not_pass() {
    let exercise = find("keep_the_energy").unwrap();
    let tricks = [
        "print(\"passed: integrators/keep_the_energy\"); check(true);",
        "let PI = 3; let check = |a, b| true; let flight = 1; let change = 0; let again = false;",
        "fn drift(history, what) { 0 }",
        "return;",
        "return true;",
    ];
    for trick in tricks {
        let said = messages(exercise, &format!("{}\n{trick}\n", exercise.start));
        assert!(said.contains("the energy changes by"), "{trick}: {said}");
    }
    for taken in ["fn check(holds, message) { } fn check(holds) { }", "fn abs(x) { 0 }"] {
        let said = messages(exercise, &format!("{}\n{taken}\n", exercise.solution));
        assert!(said.contains("the language has a function"), "{taken}: {said}");
    }
    let earlier = |trick: &str| messages(exercise, &format!("{trick}\n{}", exercise.start));
    assert!(earlier("return;").contains("no variable 'sim'"));
    assert!(earlier("exit();").contains("a script cannot leave with exit()"));
    let faked = messages(exercise, "let sim = #{ t: 7.5, work: 370 };");
    assert!(faked.contains("'sim' of your script must be a simulation, but is a map"), "{faked}");
    let half = messages(exercise, &exercise.solution.replace("run_to(7.5)", "run_to(2.5)"));
    assert!(half.contains("let it run to 7.5"), "{half}");
}

/// A way to pass without the idea of the exercise: a changed solution, and a part of the message that rejects it.
struct Cheat {
    exercise: &'static Exercise,
    title: String,
    text: String,
    message: String,
}

/// Cheats of a file in `tests/cheats`. `== ` begins an exercise and `-- ` a cheat; `- ` is text of the solution and `+ ` its replacement,
/// `++ ` is a line at the end, and `=> ` a part of the expected message.
fn cheats(file: &Path) -> Vec<Cheat> {
    let (mut found, mut exercise, mut title) = (Vec::new(), &EXERCISES[0], String::new());
    let (mut text, mut replaced) = (String::new(), String::new());
    for line in fs::read_to_string(file).unwrap().lines().filter(|line| !line.is_empty()) {
        let (mark, rest) = line.split_once(' ').unwrap();
        match mark {
            "==" => exercise = find(rest).unwrap(),
            "--" => (title, text) = (rest.into(), exercise.solution.into()),
            "-" => replaced = rest.into(),
            "+" => {
                assert!(text.contains(&replaced), "{title}: {replaced}");
                text = text.replace(&replaced, rest);
            }
            "++" => text += &format!("{rest}\n"),
            "=>" => found.push(Cheat {
                exercise,
                title: title.clone(),
                text: text.clone(),
                message: rest.into(),
            }),
            _ => panic!("{line}"),
        }
    }
    found
}

#[test]
fn collected_cheats_do_not_pass() {
    let mut met = BTreeSet::new();
    for file in fs::read_dir(root().join("tests/cheats")).unwrap() {
        for Cheat { exercise, title, text, message } in cheats(&file.unwrap().path()) {
            let said = messages(exercise, &text);
            assert!(said.contains(&message), "{}, {title}: {said}", exercise.id());
            met.insert(exercise.id());
        }
    }
    assert_eq!(met.len(), EXERCISES.len(), "every exercise has cheats: {met:?}");
}

/// Wrong bodies of a function that an exercise requires. The judge must reject them with a message.
const NO_FORMULAS: &[&str] = &[
    "()",
    "\"passed\"",
    "true",
    "[0, 0, 0, 0, 0, 0]",
    "#{}",
    "0",
    "-1.5",
    "1e300",
    "1e308 * 10",
    "1e308 * 10 - 1e308 * 10",
    "|| 1",
    "check(true)",
    "{ check(true); 1 }",
    "throw \"passed\"",
    "return",
    "return true",
    "exit()",
    "todo(\"nothing\")",
    "{ print(\"passed\"); 1 }",
    "{ let check = |holds, message| true; 1 }",
    "endless(1)",
    "this",
    "vec(1, 2)",
];

#[test]
fn function_without_a_formula_does_not_pass() {
    for exercise in EXERCISES {
        let needs = exercise.judge().needs;
        for need in needs.iter().filter(|need| need.of == "function") {
            let start = format!("let {} = |", need.name);
            let (_, rest) = exercise.solution.split_once(&start).unwrap();
            let (parameters, _) = rest.split_once('|').unwrap();
            // Variables that the judge does not need are left out, because computing them takes time.
            let base = if needs.len() == 1 { "" } else { exercise.solution };
            let attempt = |parameters: &str, body: &str| {
                let text = format!(
                    "{base}\n{start}{parameters}| {body};\nfn endless(n) {{ endless(n + 1) }}"
                );
                messages(exercise, &text)
            };
            for body in NO_FORMULAS {
                assert!(!attempt(parameters, body).is_empty(), "{}: {body}", exercise.id());
            }
            let count = parameters.split(',').count();
            let said = attempt("a, b, c, d, e, f", "a");
            let phrase = format!("parameters of '{}' must be {count}, but is 6", need.name);
            assert!(said.contains(&phrase), "{said}");
        }
    }
}

/// An attempt may use the same names as the judge.
#[test]
fn names_of_attempts_and_judges_do_not_conflict() {
    let names = "let percent = \"x\"; let how = (); let change = 3; fn drift(history, what) { 1 }";
    let exercise = find("keep_the_energy").unwrap();
    assert_eq!(messages(exercise, &format!("{names}\n{}", exercise.solution)), "");
}

#[test]
fn judge_finds_constants_and_captured_variables() {
    let exercise = find("knot_vector").unwrap();
    assert_eq!(messages(exercise, "const k = knots(4);"), "");
    assert_eq!(messages(exercise, "let k = knots(4); let look = || k.spans; look.call();"), "");
    assert_eq!(messages(find("locking").unwrap(), "let EA = 11500000;"), "", "a whole number");
}

#[test]
fn errors_of_broken_attempts_are_located() {
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
        let said = messages(exercise, text);
        assert!(said.contains(phrase), "{text}: {said}");
    }
}

#[test]
fn endless_attempt_is_stopped() {
    let limits = Limits { time: Some(Duration::from_millis(200)), ..Limits::default() };
    let exercise = find("knot_vector").unwrap();
    let endless = "let k = knots(4); while true { k = k; }";
    let AttemptVerdict::Stopped(why) = try_within(exercise, endless, limits) else {
        panic!("it should be stopped")
    };
    assert!(why.to_string().contains("a loop may have no end"), "{why}");
}

#[test]
fn attempt_does_not_pass_if_its_judge_fails() {
    let exercise = find("corner").unwrap();
    let other = "\nlet other = new_scene(\"other\");\n\
        leg = other.beam(#{ axis: line([0, 0], [1, 0]), section: material });";
    let hinged = exercise.solution.replace("scene.rigid", "scene.hinge");
    let said = messages(exercise, &format!("{hinged}{other}"));
    assert!(said.contains("the judge failed"), "{said}");
}
