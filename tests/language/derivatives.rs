//! Notes on derivatives with respect to parameters.

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Runs a script, which must succeed, and returns its notes.
fn message(text: &str) -> String {
    let message = Notepad::default();
    let settings =
        RunSettings { diagnostics: Box::new(message.clone()), ..RunSettings::silent(RunMode::Run) };
    let outcome = run(&Program::named("derivatives", text), &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), []);
    message.take()
}

#[test]
fn branch_on_a_parameter_is_reported_once_with_its_position() {
    let scene = "let scene = new_scene(\"driven\");
let a = scene.parameter(\"a\", 0.55);
let bead = scene.particle([0, 0], 1, #{ name: \"bead\" });
let half = a / 2;
";
    let once = message(&format!(
        "{scene}for i in 0..2 {{ scene.force(bead, [0, 1], |t| {{ let u = 2 * t; if u < half {{ 1 }} else {{ 0 }} }}); }}\n"
    ));
    assert_eq!(
        once.matches("note: line 5, column 69: < compares with 'half'").count(),
        1,
        "{once}"
    );
    assert_eq!(once.lines().count(), 1, "{once}");
    let inside = message(&format!("{scene}scene.move(bead, #{{ x: |t| floor(t / a) }});\n"));
    assert!(inside.contains("line 5, column 28: floor compares with 'a'"), "{inside}");
    // Conditions on the parameter alone or on the time alone are the same in the perturbed runs.
    let silent = message(&format!(
        "{scene}scene.force(bead, [0, 1], |t| if a > 0.3 {{ a * t }} else {{ 0 }});
scene.force(bead, [0, 1], |t| if t < 0.3 {{ a }} else {{ half * t }});
scene.force(bead, [0, 1], |t| if t < 0.3 {{ 1 }} else {{ 0 }});\n"
    ));
    assert_eq!(silent, "");
}
