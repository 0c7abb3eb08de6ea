//! The binary: exit codes, first lines of messages, files, interrupts, and closed pipes.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

fn withy() -> Command {
    Command::new(env!("CARGO_BIN_EXE_withy"))
}

fn script(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("script.rhai");
    fs::write(&file, text).expect("the script is written");
    (folder, file)
}

fn run(text: &str) -> Output {
    let (folder, file) = script(text);
    withy().arg("run").arg(file).current_dir(folder.path()).output().expect("withy starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("withy was not killed by a signal")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn first_line(output: &Output) -> String {
    said(output).lines().next().unwrap_or_default().to_owned()
}

#[test]
fn valid_script_prints_and_exits_with_0() {
    let output = run("print(1/20); check(true, \"fine\");");
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert_eq!(output.stdout, b"0.05\n");
    assert_eq!(said(&output), "the check passed\n");
}

#[test]
fn failed_check_exits_with_1_after_the_whole_script() {
    let output = run("\ncheck(1 > 2, \"one is more\");\nprint(\"after\");");
    assert_eq!(code(&output), 1);
    assert_eq!(output.stdout, b"after\n");
    assert_eq!(said(&output), "line 2: check failed: one is more\n1 of 1 checks failed\n");
}

#[test]
fn quiet_hides_the_summary_but_not_the_script() {
    let (_folder, file) = script("print(1); check(true);");
    let output = withy().arg("run").arg(file).arg("--quiet").output().expect("withy starts");
    assert_eq!((output.stdout.as_slice(), said(&output).as_str()), (b"1\n".as_slice(), ""));
}

#[test]
fn wrong_script_exits_with_2_and_shows_the_location() {
    let output = run("let a = 1;\nprint(sqr(a));");
    assert_eq!(code(&output), 2);
    let shown = said(&output);
    assert_eq!(first_line(&output), "error: there is no function 'sqr'");
    assert!(shown.contains("script.rhai:2:7"), "{shown}");
    assert!(shown.contains("help: did you mean 'sqrt'? sqrt(x)"), "{shown}");
    assert!(!shown.contains('\u{1b}'), "no colours in a pipe: {shown}");
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let (folder, _) = script("");
    let latin = folder.path().join("latin.rhai");
    fs::write(&latin, b"// ok\n// \xe4\n").expect("the file is written");
    let cases = [
        (Path::new("missing.rhai"), "there is no such file"),
        (folder.path(), "it is a folder"),
        (&latin, "line 2 is not UTF-8 text"),
    ];
    for (file, why) in cases {
        let output = withy().arg("run").arg(file).output().expect("withy starts");
        assert_eq!(code(&output), 2);
        let line = first_line(&output);
        assert!(line.starts_with("error: cannot read the script") && line.contains(why), "{line}");
    }
}

#[test]
fn help_lists_commands_and_exit_codes() {
    let output = withy().arg("--help").output().expect("withy starts");
    assert_eq!(code(&output), 0);
    let help = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        ["run", "check", "repl", "docs", "Exit codes"].iter().all(|word| help.contains(word)),
        "{help}"
    );
}

#[test]
fn a_wrong_option_exits_with_2() {
    let output = withy().args(["run", "--outt", "x"]).output().expect("withy starts");
    assert_eq!(code(&output), 2);
}

#[test]
fn check_command_neither_prints_nor_evaluates_checks() {
    let (folder, file) = script("print(1); check(false);");
    let output =
        withy().arg("check").arg(&file).current_dir(&folder).output().expect("withy starts");
    assert_eq!(code(&output), 0);
    assert!(output.stdout.is_empty());
    fs::write(&file, "let x = ;").expect("the script is written");
    let output = withy().arg("check").arg(&file).output().expect("withy starts");
    assert_eq!(code(&output), 2);
}

#[test]
fn endless_recursion_is_an_error_and_not_a_crash() {
    let output = run("fn f(n) { 1 + f(n + 1) } f(0);");
    assert_eq!(code(&output), 2, "{}", said(&output));
    assert_eq!(first_line(&output), "error: functions call each other too deeply");
}

#[test]
fn the_report_is_written_also_after_a_failure() {
    let (folder, file) = script("throw \"no\";");
    let report = folder.path().join("report.json");
    let output =
        withy().arg("run").arg(&file).arg("--report").arg(&report).output().expect("withy starts");
    assert_eq!(code(&output), 2);
    let text = fs::read_to_string(&report).expect("the report");
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(value, serde_json::json!({ "simulations": [] }));
    let left: Vec<_> = fs::read_dir(folder.path()).expect("the folder").collect();
    assert_eq!(left.len(), 2, "only the script and the report: {left:?}");
}

/// Bead that reaches the end of its beam at t = 1.
const BEAD: &str = "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 1 });
    let scene = new_scene(\"bead\");
    let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });
    let bead = scene.particle([1, 0], 1, #{ velocity: [1, 0] });
    let ring = scene.slider(bead, rod, #{ name: \"ring\" });
    let sim = scene.start(#{ dt: 0.3 });\n";

#[test]
fn early_end_of_a_run_is_printed_once_and_reported() {
    let (folder, file) = script(&format!("{BEAD} sim.run_to(3); sim.run_to(4);"));
    let report = folder.path().join("report.json");
    let output =
        withy().arg("run").arg(&file).arg("--report").arg(&report).output().expect("withy starts");
    assert_eq!(code(&output), 0, "{}", said(&output));
    let message = "note: simulation 'bead' ended before t = 3: slider 'ring' reached the end of its beam at t = 1\n";
    assert_eq!(said(&output), format!("{message}{NOT_ESTIMATED}"));
    let report = fs::read_to_string(&report).expect("the report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let simulation = &report["simulations"][0];
    assert_eq!(simulation["ended"], "slider 'ring' reached the end of its beam at t = 1");
    assert_eq!(simulation["events"], 1);
    let slider = &simulation["sliders"][0];
    assert_eq!(slider["name"], "ring");
    assert_eq!(slider["position"], 1.0);
    assert_eq!(slider["state"], "sliding");
    assert_eq!(slider["force"].as_array().expect("a vector").len(), 2);
}

#[test]
fn script_that_waits_for_the_end_of_a_run_can_be_checked() {
    let (_folder, file) = script(&format!(
        "{BEAD} while !sim.ended {{ sim.step(); }} print(sim.events[0].t); print(sim.contact_force(ring));"
    ));
    let output = withy().arg("check").arg(&file).output().expect("withy starts");
    assert_eq!(code(&output), 0, "{}", said(&output));
}

/// Script with a simulation, for dry runs.
const FALL: &str = r#"let scene = new_scene("fall"); let p = scene.particle([0, 10], 1); scene.gravity([0, -9.81]);
let sim = scene.start(#{ dt: 0.01 });
"#;

#[test]
fn check_ends_where_the_script_waits_for_a_simulation_result() {
    let (_folder, file) = script(&format!("{FALL}while sim.position(p).y > 5 {{ sim.step(); }}"));
    let output = withy().arg("check").arg(&file).output().expect("withy starts");
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert!(said(&output).contains("was not checked"), "{}", said(&output));
}

#[test]
fn check_explains_that_it_runs_no_simulation() {
    let late = script(&format!("{FALL}sim.run_to(2); print([sim.t].filter(|t| t > 9)[0]);"));
    let output = withy().arg("check").arg(&late.1).output().expect("withy starts");
    assert_eq!(code(&output), 2, "{}", said(&output));
    assert!(said(&output).contains("withy check runs no simulation"), "{}", said(&output));
    let early = script(&format!("{FALL}print([][0]);"));
    let output = withy().arg("check").arg(&early.1).output().expect("withy starts");
    assert!(!said(&output).contains("withy check runs no simulation"), "{}", said(&output));
}

#[test]
fn a_report_that_cannot_be_written_is_an_error() {
    let (_folder, file) = script("");
    let mut command = withy();
    command.arg("run").arg(&file).args(["--report", "/dev/null/folder/r.json"]);
    let output = command.output().expect("withy starts");
    assert_eq!(code(&output), 2);
    assert!(first_line(&output).contains("/dev/null/folder/r.json"), "{}", said(&output));
}

/// Runs a script, interrupts it after its first printed line, and waits for its end.
#[cfg(unix)]
fn interrupted(folder: &TempDir, file: &Path) -> Output {
    let mut running = withy()
        .arg("run")
        .arg(file)
        .arg("--report")
        .arg(folder.path().join("report.json"))
        .arg("--out")
        .arg(folder.path().join("out"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("withy starts");
    let mut line = String::new();
    let mut printed = BufReader::new(running.stdout.take().expect("a pipe"));
    printed.read_line(&mut line).expect("the first line");
    assert_eq!(line, "started\n");
    let id = running.id().to_string();
    Command::new("kill").args(["-INT", &id]).status().expect("kill runs");
    running.wait_with_output().expect("withy ends")
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_an_endless_loop_with_130() {
    let (folder, file) = script("print(\"started\"); loop { }");
    let output = interrupted(&folder, &file);
    assert_eq!(code(&output), 130, "{}", said(&output));
    assert!(said(&output).contains("interrupted"), "{}", said(&output));
    assert!(folder.path().join("report.json").exists());
}

#[cfg(unix)]
#[test]
fn ctrl_c_in_an_endless_run_keeps_its_history() {
    let (folder, file) = script(
        "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
         let scene = new_scene(\"a long flight\");
         scene.beam(#{ axis: line([0, 0], [10, 0]), basis: bspline(4), section: s, spin: 1 });
         let sim = scene.start(#{ dt: 0.1 });
         sim.at(1, |sim| print(\"started\"));
         sim.run_to(1e9);",
    );
    let output = interrupted(&folder, &file);
    assert_eq!(code(&output), 130, "{}", said(&output));
    let report = fs::read_to_string(folder.path().join("report.json")).expect("the report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let steps = report["simulations"][0]["steps"].as_u64().expect("steps");
    let history = fs::read_to_string(folder.path().join("out/a-long-flight-stopped.csv"));
    // Three lines are not steps: a comment, the names of the columns, and the start.
    assert_eq!(history.expect("the history").lines().count() as u64, steps + 3);
    assert!(steps >= 10);
}

#[test]
fn a_file_that_imports_itself_is_an_error_and_not_a_crash() {
    let (_folder, file) = script("import \"script\" as own;");
    let named = file.with_file_name("script.rhai");
    if named != file {
        fs::copy(&file, &named).expect("a copy");
    }
    let output = withy().arg("run").arg(&named).output().expect("withy starts");
    assert_eq!(code(&output), 2, "{}", said(&output));
    assert!(first_line(&output).contains("imports itself"), "{}", said(&output));
}

#[cfg(unix)]
#[test]
fn closed_pipe_ends_the_run_silently() {
    let (_folder, file) = script("loop { print(\"more\"); }");
    let mut running = withy()
        .arg("run")
        .arg(&file)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("withy starts");
    let mut line = String::new();
    BufReader::new(running.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
    let output = running.wait_with_output().expect("withy ends");
    assert_eq!((code(&output), said(&output).as_str()), (0, ""));
}

#[test]
fn control_sequences_are_not_printed() {
    let (_folder, file) = script(
        "print(\"\\u001b]0;title\\u0007\"); check(false, \"\\u001b[2J\"); // \u{1b}]0;title\u{7}\u{202e}
         let a = \"\u{1b}[2J\u{202e}\"; throw \"\\r\\u202e\\u200b\" + a;",
    );
    let output = withy().arg("run").arg(&file).output().expect("withy starts");
    assert_eq!(code(&output), 2, "{}", said(&output));
    for text in [&output.stdout, &output.stderr] {
        let text = String::from_utf8_lossy(text);
        let is_harmful = |letter: char| letter.is_control() && !matches!(letter, '\n' | '\t');
        assert!(!text.contains(is_harmful), "{text:?}");
        assert!(!text.contains(['\u{202e}', '\u{200b}']), "{text:?}");
        assert!(text.contains('\u{fffd}'), "{text:?}");
    }
}

const NOT_ESTIMATED: &str = "estimated error: not estimated; use --error to estimate it\n";

const SPINNING: &str = "let scene = new_scene(\"spin\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 });\n\
    let sim = scene.start(#{ dt: 0.1 });\nsim.run_to(1);\n";

#[test]
fn run_error_is_estimated_on_request_without_other_changes() {
    let (folder, file) = script(&format!("{SPINNING}print(sim.position(rod.end));"));
    let with = |option: &[&str]| {
        let mut command = withy();
        command.arg("run").arg(&file).args(option).arg("--out").arg(folder.path());
        let output = command.output().expect("withy starts");
        assert_eq!(code(&output), 0);
        (String::from_utf8_lossy(&output.stdout).into_owned(), said(&output))
    };
    let (plain, remark) = with(&[]);
    assert_eq!(remark, NOT_ESTIMATED);
    let (estimated, line) = with(&["--error"]);
    assert_eq!(plain, estimated);
    assert!(line.starts_with("estimated error of 'spin': positions "), "{line}");
    assert!(line.contains(" at t = 1, converged (in time "), "{line}");
    assert_eq!(with(&["--error=never"]).1, "");
}
