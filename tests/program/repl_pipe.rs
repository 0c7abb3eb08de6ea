//! Sessions without a terminal, run with the binary: values, exit codes, no prompt and no colours.
#![allow(clippy::unwrap_used)]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn withy(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder).env("TERM", "xterm-256color").env("LANG", "C.UTF-8");
    command
}

/// Runs a session with `input` from a pipe. Returns exit code, output and error output.
fn piped_in(folder: &Path, arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut command = withy(folder);
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    message(child.wait_with_output().unwrap())
}

fn piped(input: &str) -> (i32, String, String) {
    piped_in(tempfile::tempdir().unwrap().path(), &["repl"], input)
}

fn evaluated(inputs: &[&str]) -> (i32, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let arguments = inputs.iter().flat_map(|input| ["-e", input]);
    message(withy(folder.path()).args(arguments).output().unwrap())
}

fn message(output: Output) -> (i32, String, String) {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

const SPINNING: &str = "let scene = new_scene(\"spin\");
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let rod = scene.beam(#{
    axis: line([0, 0], [2, 0]),
    basis: bspline(4), section: s, spin: 1
});
let sim = scene.start(#{ dt: 0.1 });
";

#[test]
fn piped_session_prints_only_values() {
    let (code, replies, complaints) = piped("let a = 2;\na ^ 3\n\"x\"\n[1, 2.5]\nans.len\n");
    assert_eq!((code, &*replies, &*complaints), (0, "8\n\"x\"\n[1, 2.5]\n2\n", ""));
    assert_eq!(piped(""), (0, String::new(), String::new()));
}

#[test]
fn lines_of_an_unfinished_input_are_joined() {
    let (code, replies, complaints) =
        piped("fn f(x) {\n  x + 1\n}\nlet a = [1,\n 2];\nf(a[0]) +\n  a[1]\n");
    assert_eq!((code, &*replies, &*complaints), (0, "4\n", ""));
}

#[test]
fn quit_and_help_words_of_other_prompts_are_accepted() {
    for word in ["quit", "exit", "quit()", "exit();"] {
        let message = piped(&format!("1\n{word}\nnonsense\n"));
        assert_eq!(message, (0, "1\n".into(), String::new()), "{word}");
    }
    let (code, replies, complaints) = piped("let quit = 3;\nquit\n");
    assert_eq!((code, &*replies, &*complaints), (0, "3\n", ""));
    let (code, replies, _) = piped("help\n");
    assert!(code == 0 && replies.starts_with("Commands of the prompt"), "{replies}");
    assert!(replies.contains(":quit") && replies.lines().count() < 30, "{replies}");
    let (_, replies, _) = piped(":help topics\n");
    assert!(replies.starts_with("Help\n") && replies.lines().count() > 50, "{replies}");
    let (_, replies, _) = piped(&format!("{SPINNING}sim?\n"));
    assert!(replies.starts_with("sim is a variable: a simulation"), "{replies}");
    let (_, replies, _) = piped("help sine\n");
    assert!(replies.contains("sine("), "{replies}");
    let (code, _, complaints) = piped("clear\n");
    assert!(code == 2 && complaints.contains(":reset deletes all variables"), "{complaints}");
}

#[test]
fn a_file_name_cannot_control_the_terminal() {
    let (code, replies, complaints) = piped("1\n:save a\u{1b}[31m.rhai\n");
    assert_eq!((code, &*complaints), (0, ""));
    assert!(replies.starts_with("1\nsaved to a") && !replies.contains('\u{1b}'), "{replies:?}");
}

#[test]
fn terms_of_mechanics_find_related_names() {
    for (word, found) in [
        ("damping", "energy_decaying"),
        ("support", "scene.support(station, options)"),
        ("roller", "scene.slider(station, rail)"),
        ("plot", "plot_motion(sim, \"name\")"),
        ("spring", "scene.spring(from, to"),
    ] {
        let (_, replies, complaints) = piped(&format!("?{word}\n"));
        assert!(format!("{replies}{complaints}").contains(found), "{word}: {replies}{complaints}");
    }
}

#[test]
fn an_error_ends_the_session_with_2() {
    let (code, replies, complaints) = piped("1\nlet b = nonsense;\n2\n");
    assert_eq!((code, &*replies), (2, "1\n"));
    assert!(complaints.starts_with("error: there is no variable 'nonsense' here"), "{complaints}");
    assert!(complaints.contains("prompt:2:9") && !complaints.contains('\u{1b}'), "{complaints}");
}

#[test]
fn continuation_lines_belong_to_the_previous_input() {
    let input = "let x = [3, 1]\n  .map(|x| 2 * x);\nif x[0] > 9 {\n  1\n}\nelse {\n  2\n}\n/// Documented.\nfn f() { 5 }\nf()\n";
    let (code, replies, complaints) = piped(input);
    assert_eq!((code, &*replies, &*complaints), (0, "2\n5\n", ""));
}

#[test]
fn unfinished_input_is_an_error() {
    let (code, _, complaints) = piped("let a = [1,\n2");
    assert_eq!(code, 2);
    assert!(complaints.contains("prompt:"), "{complaints}");
}

#[test]
fn a_failed_check_exits_with_1() {
    let (code, replies, complaints) = piped("check(1 > 2, \"one is more than two\");\n3\n");
    assert_eq!((code, &*replies), (1, "3\n"));
    assert!(complaints.contains("line 1: check failed: one is more than two"), "{complaints}");
}

#[test]
fn inputs_of_the_command_line_share_a_session() {
    assert_eq!(evaluated(&["let a = 1/20;", "a"]), (0, "0.05\n".into(), String::new()));
    assert_eq!(evaluated(&["fn f(x) { 2*x }\nf(4)"]).1, "8\n");
    let (code, replies, _) = evaluated(&["oops()", "1"]);
    assert_eq!((code, &*replies), (2, ""));
    assert_eq!(evaluated(&[":quit", "1"]).1, "");
}

#[test]
fn commands_act_on_the_last_simulation() {
    let input = format!(
        "{SPINNING}:step 10\n:back 5\n:run 0.8\n:invariants\n:plot energy\n:plot drift\n:show\n:vars\n:explain\n"
    );
    let (code, replies, complaints) = piped(&input);
    assert_eq!((code, &*complaints), (0, ""), "{replies}");
    for expected in [
        "t = 1 after 10 steps\nt = 0.5 after 5 steps\nt = 0.8 after 8 steps\n",
        "energy E - W + D",
        "energy [energy]: 10.333",
        "drift of angular momentum: ",
        "t = 0.8\nbeam1: from ",
        "sim    simulation  simulation 'spin' at t = 0.8",
        "sliders",
    ] {
        assert!(replies.contains(expected), "{expected}\n{replies}");
    }
    assert!(!replies.contains('\u{1b}') && !replies.contains('⠀'), "{replies}");
}

#[test]
fn variables_are_listed_one_per_line() {
    let input = "let parts = #{ one: 1, many: [1, 2, 3], text: \"a b\" };\nimport \"std/mechanisms\" as parts_of;\n:vars\n";
    let (code, replies, complaints) = piped(input);
    assert_eq!((code, &*complaints), (0, ""), "{replies}");
    assert!(replies.contains(r#"map     #{many: [1, 2, 3], one: 1, text: "a b"}"#), "{replies}");
    assert!(replies.contains("four_bar(_)") && !replies.contains("anon$"), "{replies}");
    assert!(!replies.contains("triangle_tip"), "private functions stay private: {replies}");
}

#[test]
fn watched_expressions_are_shown_after_every_step() {
    let input =
        format!("{SPINNING}:watch sim.steps\n:step 2\n:run 0.35\nsim.step();\n:watch\n:step\n");
    let (code, replies, complaints) = piped(&input);
    assert_eq!((code, &*complaints), (0, ""), "{replies}");
    let expected = [
        "t = 0   sim.steps = 0",
        "t = 0.1   sim.steps = 1",
        "t = 0.2   sim.steps = 2",
        "t = 0.3   sim.steps = 3",
        "t = 0.35   sim.steps = 4",
        "t = 0.4   sim.steps = 5",
        "t = 0.5 after 6 steps",
    ];
    assert_eq!(replies.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn errors_of_commands_are_explained() {
    for (input, expected) in [
        (":step", "there is no simulation yet"),
        (":stepp", "did you mean :step?"),
        (":step x", "'x' is not a number of steps"),
        (":run", "a time is missing"),
        (":quit now", "':quit' takes no argument, got 'now'"),
        (":plot", "there is no simulation yet"),
        (":save", "the name of a file is missing"),
        (":load nowhere.rhai", "there is no such file"),
        ("?slidr", "slider"),
        (":watch nonsense", "there is no variable 'nonsense'"),
        ("5 % 0", "division by zero"),
        ("let f = |x| x; f.call()", "the function does not accept"),
    ] {
        let (code, _, complaints) = piped(&format!("{input}\n"));
        assert!(code == 2 && complaints.contains(expected), "{input}: {complaints}");
    }
    let (code, _, complaints) = piped(&format!("{SPINNING}:plot enrgy\n"));
    assert!(code == 2 && complaints.contains("did you mean \"energy\"?"), "{complaints}");
    for (input, expected) in [
        (":watch sim.step()", "advances a simulation"),
        (":watch sim.t\n:run nan", "finite"),
        (":show 7", "no configuration is stored for this time"),
    ] {
        let (code, _, complaints) = piped(&format!("{SPINNING}{input}\n"));
        assert!(code == 2 && complaints.contains(expected), "{input}: {complaints}");
    }
    let (code, _, complaints) = piped(&format!("{SPINNING}:back 3\n"));
    assert!(code == 2 && complaints.contains("back"), "{complaints}");
}

#[test]
fn saved_session_gives_the_same_result() {
    let folder = tempfile::tempdir().unwrap();
    let asked = "`${sim.t} ${sim.energy} ${sim.position(rod.end).y}`\n";
    let input = format!(
        "{SPINNING}:watch sim.t\n:step 7\n:watch\nsim\n:back 2\n:run 0.63\n:save turn.rhai\n{asked}"
    );
    let (code, replies, complaints) = piped_in(folder.path(), &["repl"], &input);
    assert_eq!((code, &*complaints), (0, ""));
    let end = replies.lines().last().unwrap();
    let (code, loaded, complaints) = piped_in(folder.path(), &["repl", "turn.rhai"], asked);
    assert_eq!((code, &*complaints), (0, ""));
    assert_eq!(loaded.lines().last(), Some(end));
    let run = message(withy(folder.path()).args(["run", "turn.rhai"]).output().unwrap());
    assert_eq!(run.0, 0, "{}", run.2);
}

#[test]
fn foreign_file_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mine.rhai"), "print(1);").unwrap();
    let (code, _, complaints) = piped_in(folder.path(), &["repl"], "1\n:save mine.rhai\n");
    assert!(code == 2 && complaints.contains("was not written by this session"), "{complaints}");
    let (code, replies, _) =
        piped_in(folder.path(), &["repl"], "1\n:save a.rhai\n2\n:save a.rhai\n");
    assert_eq!((code, &*replies), (0, "1\nsaved to a.rhai\n2\nsaved to a.rhai\n"));
    assert_eq!(std::fs::read_to_string(folder.path().join("mine.rhai")).unwrap(), "print(1);");
    let (code, _, _) = piped_in(folder.path(), &["repl"], "1\n:save a.rhai\n");
    assert_eq!(code, 2, "another session's file");
}

#[test]
fn file_is_evaluated_first_and_its_errors_are_located_in_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("parts.rhai"), "let a = 5;\nfn half(x) { x / 2 }\na")
        .unwrap();
    let (code, replies, _) = piped_in(folder.path(), &["repl", "parts.rhai"], "half(a)\n");
    assert_eq!((code, &*replies), (0, "2.5\n"));
    std::fs::write(folder.path().join("wrong.rhai"), "let a = 5;\nlet b = c;\n").unwrap();
    let (code, replies, complaints) = piped_in(folder.path(), &["repl", "wrong.rhai"], "1\n");
    assert_eq!((code, &*replies), (2, ""));
    assert!(complaints.contains("wrong.rhai:2:9"), "{complaints}");
}

#[test]
fn limits_hold_for_each_input() {
    let folder = tempfile::tempdir().unwrap();
    let (code, replies, complaints) =
        piped_in(folder.path(), &["repl", "--max-time", "0.3"], "1\nloop { }\n2\n");
    assert_eq!((code, &*replies), (2, "1\n"));
    assert!(complaints.contains("longer than 0.3 s"), "{complaints}");
}

#[test]
fn written_files_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let input = format!("{SPINNING}sim.step(3);\nplot_motion(sim, \"spin.svg\");\n");
    let (code, _, complaints) = piped_in(folder.path(), &["repl", "--out", "pictures"], &input);
    assert_eq!(code, 0);
    assert!(complaints.contains("wrote") && complaints.contains("spin.svg"), "{complaints}");
    assert!(folder.path().join("pictures/spin.svg").exists());
}

#[test]
fn commands_make_and_undo_adaptive_steps() {
    let adaptive = SPINNING.replace("dt: 0.1", "dt: adaptive(#{ tolerance: 1e-3 })");
    let (code, replies, complaints) = piped(&format!("{adaptive}:step 3\n:back 3\n:run 1\n"));
    let message = format!("{replies}{complaints}");
    assert_eq!(code, 0, "{message}");
    for place in ["after 3 steps", "t = 0 after 0 steps", "t = 1 after"] {
        assert!(message.contains(place), "{place}: {message}");
    }
}
