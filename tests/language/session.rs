//! Sessions: effects of an input on later inputs.
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;

use withy::repl::session::{Reply, Session};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

fn session() -> Session {
    in_folder(".".into())
}

fn in_folder(folder: PathBuf) -> Session {
    let settings = RunSettings { folder, ..RunSettings::silent(RunMode::Run) };
    Session::new(language(), settings).unwrap()
}

fn session_with_snapshots() -> Session {
    let settings = RunSettings { snapshots: 1_000_000, ..RunSettings::silent(RunMode::Run) };
    Session::new(language(), settings).unwrap()
}

fn value(session: &mut Session, input: &str) -> String {
    match session.eval(input) {
        Reply::Value(value) => value.to_string(),
        other => panic!("{input}: {other:?}"),
    }
}

fn done(session: &mut Session, input: &str) {
    let reply = session.eval(input);
    assert!(matches!(reply, Reply::Done), "{input}: {reply:?}");
}

/// Message of an input that fails, with position and hint.
fn refusal(session: &mut Session, input: &str) -> String {
    match session.eval(input) {
        Reply::Failed(diagnostic) => diagnostic.to_string(),
        other => panic!("{input}: {other:?}"),
    }
}

#[test]
fn variables_functions_and_closures_persist() {
    let mut session = session();
    done(&mut session, "let a = 2;");
    done(&mut session, "fn twice(x) { 2 * x }");
    done(&mut session, "let add = |x| x + a;");
    assert_eq!(value(&mut session, "twice(a) + add.call(1)"), "7");
    done(&mut session, "a = 10;");
    assert_eq!(value(&mut session, "add.call(1)"), "11", "a closure shares what it has captured");
    assert_eq!(value(&mut session, "ans + 1"), "12");
}

#[test]
fn a_function_can_be_defined_again() {
    let mut session = session();
    done(&mut session, "fn f() { 1 }");
    done(&mut session, "fn g() { f() }");
    done(&mut session, "fn f() { 2 }");
    assert_eq!(value(&mut session, "g()"), "2");
}

#[test]
fn functions_see_constants_typed_before_and_after_them() {
    let mut session = session();
    done(&mut session, "const G = 9.81;");
    done(&mut session, "fn weight(m) { m * global::G }");
    assert_eq!(value(&mut session, "weight(2)"), "19.62");
    done(&mut session, "fn area() { global::WIDTH ^ 2 }");
    done(&mut session, "const WIDTH = 3;");
    assert_eq!(value(&mut session, "area()"), "9");
    done(&mut session, "const WIDTH = 4; const WIDTH = 5;");
    assert_eq!(value(&mut session, "area()"), "25", "the last one holds");
}

#[test]
fn imports_persist() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("parts.rhai"), "fn half(x) { x / 2 }").unwrap();
    let mut session = in_folder(folder.path().into());
    done(&mut session, "import \"parts\" as parts;");
    assert_eq!(value(&mut session, "parts::half(3)"), "1.5");
    done(&mut session, "fn quarter(x) { import \"parts\" as p; p::half(p::half(x)) }");
    assert_eq!(value(&mut session, "quarter(2)"), "0.5");
    assert_eq!(value(&mut session, "parts::half(5)"), "2.5");
}

#[test]
fn a_semicolon_hides_a_value() {
    let mut session = session();
    done(&mut session, "1 + 1;");
    assert!(refusal(&mut session, "ans").contains("there is no variable 'ans'"));
    assert_eq!(value(&mut session, "1 + 1 // ;"), "2");
}

#[test]
fn constant_with_the_name_of_the_answer_is_not_overwritten() {
    let mut session = session();
    done(&mut session, "const ans = 1;");
    assert_eq!(value(&mut session, "2"), "2");
    assert_eq!(value(&mut session, "ans"), "1");
}

#[test]
fn only_the_failed_statement_of_an_input_has_no_effect() {
    let mut session = session();
    done(&mut session, "let a = 1; const G = 1; fn g() { global::G }");
    let message =
        refusal(&mut session, "let b = 2;\nlet c = a + nonsense;\nfn h() { 7 }\nlet d = 1;");
    assert!(message.contains("prompt:3:13"), "{message}");
    assert!(message.contains("let c = a + nonsense"), "{message}");
    assert_eq!(value(&mut session, "a + b + h()"), "10");
    for gone in ["c", "d"] {
        assert!(refusal(&mut session, gone).contains("there is no variable"), "{gone}");
    }
    refusal(&mut session, "{ a = 5; oops() }");
    assert_eq!(value(&mut session, "a"), "1");
    refusal(&mut session, "const G = 2 + oops();");
    assert_eq!(value(&mut session, "g()"), "1");
    let message = refusal(&mut session, "let x = lost();\nfn unknown_later() { 1 }");
    assert!(message.contains("there is no function 'lost'"), "{message}");
    assert!(refusal(&mut session, "unknown_later()").contains("there is no function"));
    assert!(!refusal(&mut session, "x").contains("declared later"));
}

#[test]
fn preview_changes_no_variable() {
    let mut session = session();
    done(&mut session, "let n = 1;");
    assert!(matches!(session.evaluate_preview("n += 1; n"), Reply::Value(_)));
    assert_eq!(value(&mut session, "n"), "1");
}

#[test]
fn error_in_a_function_typed_earlier_is_located_there() {
    let mut session = session();
    done(&mut session, "let zero = 0;");
    done(&mut session, "fn deep(x) {\n    x.wrong()\n}");
    let message = refusal(&mut session, "deep(1)");
    assert!(message.contains("prompt:3:7") && message.contains("x.wrong()"), "{message}");
    assert!(message.contains("in 'deep', called at line 5"), "{message}");
}

#[test]
fn module_function_may_have_the_name_of_a_typed_function() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("parts.rhai"), "\nfn f(x) { x.lost }").unwrap();
    let mut session = in_folder(folder.path().into());
    done(&mut session, "import \"parts\" as parts;");
    done(&mut session, "fn f(x) { x.oops }");
    let message = refusal(&mut session, "f(#{ a: 1 })");
    assert!(message.contains("prompt:2:13"), "{message}");
    let message = refusal(&mut session, "parts::f(#{ a: 1 })");
    assert!(message.contains("parts.rhai:2:13"), "{message}");
}

#[test]
fn an_error_in_a_file_is_shown_in_the_file() {
    let mut session = session();
    done(&mut session, "let a = 1;");
    let reply = session.eval_program(Program::named("beam.rhai", "fn f() {\n  wrong()\n}"));
    assert!(matches!(reply, Reply::Done), "{reply:?}");
    let message = refusal(&mut session, "f()");
    assert!(message.contains("beam.rhai:2:3"), "{message}");
    let Reply::Failed(diagnostic) =
        session.eval_program(Program::named("b.rhai", "let x = 1;\nlet y = ;"))
    else {
        panic!("must fail")
    };
    assert_eq!(diagnostic.location_text().unwrap(), "b.rhai:2:9");
}

#[test]
fn unclosed_comment_is_located_at_its_line() {
    let mut session = session();
    done(&mut session, "let a = 1;");
    let message = refusal(&mut session, "a\n  /* lost");
    assert!(message.contains("prompt:3:3"), "{message}");
}

#[test]
fn division_by_assignment_works_at_every_line() {
    let mut session = session();
    done(&mut session, "let a = 1;");
    done(&mut session, "a /= 4;");
    assert_eq!(value(&mut session, "a"), "0.25");
}

#[test]
fn preview_has_no_lasting_effect() {
    let mut session = session();
    done(&mut session, "let a = 1;");
    assert_eq!(value(&mut session, "a + 1"), "2");
    let line = session.next_line();
    let Reply::Value(shown) = session.evaluate_preview("let a = 5; let b = 7; a + b") else {
        panic!()
    };
    assert_eq!(shown.to_string(), "12");
    assert_eq!(session.next_line(), line);
    assert_eq!(value(&mut session, "ans"), "2");
    assert_eq!(value(&mut session, "a"), "1");
    assert!(refusal(&mut session, "b").contains("there is no variable 'b'"));
    assert!(!session.script().unwrap().contains("let b = 7"));
}

#[test]
fn shadowed_variables_are_dropped() {
    let mut session = session();
    for index in 0..1000 {
        done(&mut session, &format!("let a = {index}; let b = a;"));
    }
    assert_eq!(session.variables().len(), 2);
    assert_eq!(value(&mut session, "a + b"), "1998");
}

#[test]
fn reset_removes_all_state() {
    let mut session = session();
    done(&mut session, "let a = 1; const B = 2;");
    done(&mut session, "fn f() { 1 }");
    session.reset();
    assert_eq!(session.next_line(), 1);
    for gone in ["a", "B", "f()", "global::B"] {
        assert!(refusal(&mut session, gone).contains("there is no"), "{gone}");
    }
}

const SPINNING: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 });\n\
    let sim = scene.start(#{ dt: 0.1 });";

/// Inputs whose saved script must give the same final state. Inputs after `!` fail.
const SESSIONS: &[&[&str]] = &[
    &["3 * 2", "sim.step(ans);", "!sim.step(2); sim.stepp();", "sim.step();"],
    &["fn q() { 3 } q()", "sim.step(ans)"],
    &["let i = 0; while i < 3 { i += 1 } i", "sim.step(ans)"],
    &["if true { 1 } else { 2 }; #{ a: 1 }", "sim.step(ans.a)"],
    &[
        "fn number.twice() { this * 2 } fn number.thrice() { this * 3 }",
        "sim.step(2.0.twice() + 2.0.thrice())",
    ],
    &["/// Two.\nprivate fn two() { 2 }", "/// Two.\nfn two() { 2 }", "sim.step(two());"],
    &["let a = 1;", "!{ a = 5; oops() }", "sim.step(a)"],
    &["let k = [1];", "!k.push(2); sim.step(2); nosuch(); k.push(3)", "sim.step(k.len)"],
    &["!let b = scene.start(#{ dt: 0.05 }); b.step(3); nosuch()", "b.step(2); sim.step(4);"],
    &["!sim.at(0.35, |s| { throw \"stop\" }); sim.step(10)", "sim.back(1);"],
    &[
        "let simulations = [sim.fork()];",
        "!simulations[0].step(3); simulations[0].oops()",
        "sim.step()",
    ],
    &["let twin = sim;", "!twin.step(2); twin.oops()", "sim.step(1)"],
    &["sim.step(2)", "return 5;", "sim.step(1)"],
];

#[test]
fn saved_sessions_give_the_same_result() {
    for inputs in SESSIONS {
        let mut first = session_with_snapshots();
        done(&mut first, SPINNING);
        for input in *inputs {
            match input.strip_prefix('!') {
                Some(wrong) => _ = refusal(&mut first, wrong),
                None => {
                    let reply = first.eval(input);
                    assert!(matches!(reply, Reply::Done | Reply::Value(_)), "{input}: {reply:?}");
                }
            }
        }
        let asked = "`${sim.steps} ${sim.t} ${sim.position(rod.end).x}`";
        let end = value(&mut first, asked);
        let script = first.script().unwrap();
        let mut second = session_with_snapshots();
        let reply = second.eval_program(Program::named("saved.rhai", &script));
        assert!(matches!(reply, Reply::Done | Reply::Value(_)), "{script}\n{reply:?}");
        assert_eq!(value(&mut second, asked), end, "{script}");
    }
}
