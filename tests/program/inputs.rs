//! Inputs of a script from the command line and at the prompt, and `withy run --watch`.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

const BOOM: &str = "import \"parts\" as parts;
let load = input(\"load\", 100, #{ unit: \"N\", min: 0, max: 500, about: \"weight at the tip\" });
let name = input(\"name\", \"boom\");
fn doubled(load) { load * input(\"factor\", 2) }
print(`${name}: ${doubled(load)}, ${parts::spans}`);
";

fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn boom() -> TempDir {
    folder(&[("boom.rhai", BOOM), ("parts.rhai", "export let spans = input(\"spans\", 4);")])
}

fn withy(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    let output = command.args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn run(folder: &Path, settings: &[&str]) -> (i32, String, String) {
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = ["run", "boom.rhai"].into_iter().chain(settings).collect();
    withy(folder, &arguments)
}

#[test]
fn inputs_are_set_in_scripts_functions_and_imported_files() {
    let home = boom();
    assert_eq!(run(home.path(), &[]).1, "boom: 200, 4\n");
    let set = run(home.path(), &["load=250", "name=a = b", "factor=3", "spans=7"]);
    assert_eq!(set, (0, "a = b: 750, 7\n".into(), String::new()));
}

#[test]
fn invalid_input_values_are_rejected_before_the_run() {
    let home = boom();
    for (setting, message, place) in [
        ("load=abc", "'load' must be a number (0 to 500 N), got \"abc\"", "boom.rhai:2:12"),
        ("load=501", "'load' must be a number (0 to 500 N), got \"501\"", "boom.rhai:2:12"),
        ("factor=1.5", "'factor' must be a whole number, got \"1.5\"", "boom.rhai:4:27"),
        ("spans=", "'spans' must be a whole number, got \"\"", "parts.rhai:1:20"),
        (
            "laod=3",
            "the script has no input 'laod'",
            "did you mean 'load'? its inputs are load, name, factor, spans",
        ),
        ("load", "write NAME=VALUE, such as load=250", ""),
        ("2x=1", "'2x' is not a name", ""),
    ] {
        let (code, printed, said) = run(home.path(), &[setting]);
        assert_eq!((code, &*printed), (2, ""), "{setting}: {said}");
        assert!(said.contains(message) && said.contains(place), "{setting}: {said}");
    }
    let (code, _, said) = run(home.path(), &["load=1", "load=2"]);
    assert!(code == 2 && said.contains("the input 'load' is set twice"), "{said}");
}

#[test]
fn setting_without_an_input_is_rejected() {
    let home = folder(&[("boom.rhai", "for name in [\"a\", \"b\"] { print(input(name, 1)); }")]);
    assert_eq!(run(home.path(), &["b=2"]).1, "1\n2\n");
    let (code, printed, said) = run(home.path(), &["c=2"]);
    assert_eq!((code, &*printed), (2, "1\n1\n"));
    assert!(said.contains("the script has no input 'c'") && said.contains("a, b"), "{said}");
}

#[test]
fn input_of_an_unused_branch_may_be_set() {
    let text = "if input(\"fine\", false) { print(input(\"spans\", 2 * 4)); }";
    let home = folder(&[("boom.rhai", text)]);
    assert_eq!(run(home.path(), &["spans=3"]).0, 0);
    assert_eq!(run(home.path(), &["spans=3", "fine=true"]).1, "3\n");
}

#[test]
fn a_check_lists_the_inputs() {
    let home = boom();
    let (code, printed, _) = withy(home.path(), &["check", "boom.rhai"]);
    let rows: Vec<_> = printed.lines().map(|row| row.split_whitespace().collect()).collect();
    let rows: Vec<Vec<&str>> = rows;
    assert_eq!(code, 0);
    assert_eq!(rows[0], ["input", "default", "allowed", "description"]);
    let expected = ["load", "100", "N", "0", "to", "500", "N", "weight", "at", "the", "tip"];
    assert_eq!(rows[2], expected, "{printed}");
    for name in ["name", "factor", "spans"] {
        assert!(rows.iter().any(|row| row[0] == name), "{name}: {printed}");
    }
    let (code, _, said) = withy(home.path(), &["check", "boom.rhai", "--set", "load=600"]);
    assert!(code == 2 && said.contains("got \"600\""), "{said}");
    fs::write(home.path().join("boom.rhai"), "let a = 1;").unwrap();
    assert_eq!(withy(home.path(), &["check", "boom.rhai"]).1, "", "no inputs, no table");
}

#[test]
fn the_report_states_the_values() {
    let home = boom();
    let arguments = ["run", "boom.rhai", "--report", "r.json", "--set", "load=250"];
    assert_eq!(withy(home.path(), &arguments).0, 0);
    let report = fs::read_to_string(home.path().join("r.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let expected = serde_json::json!({ "load": 250.0, "name": "boom", "factor": 2, "spans": 4 });
    assert_eq!(report["inputs"], expected);
}

#[test]
fn a_sweep_runs_an_imported_script_with_its_inputs() {
    let sag = "export let sag = input(\"load\", 100, \"N\") / 50; let other = input(\"scale\", 1);";
    let sweep = "import \"boom\" as boom;
        let sweep = study_sweep(#{ name: \"sags\", parameters: #{ load: [100, 200, 300, 400] },
            run: |p| #{ sag: boom::sag } });
        print(sweep.table.column(\"sag\"));";
    let home = folder(&[("boom.rhai", sag), ("sweep.rhai", sweep)]);
    let (code, printed, said) = withy(home.path(), &["run", "sweep.rhai", "--set", "scale=3"]);
    assert_eq!(code, 0, "{said}");
    assert!(printed.ends_with("[2, 4, 6, 8]\n"), "{printed}");
    // At the prompt, the statements of the file do not run again.
    let (code, _, said) = withy(home.path(), &["-e", sweep]);
    assert!(code == 2 && said.contains("does not use the parameter 'load'"), "{said}");
}

#[test]
fn a_session_sets_the_inputs_of_a_file() {
    let home = boom();
    let inputs =
        [":load boom.rhai --set load=250 --set spans=5", "doubled(1)", "input(\"load\", 3)"];
    let arguments: Vec<&str> = inputs.iter().flat_map(|input| ["-e", input]).collect();
    assert_eq!(withy(home.path(), &arguments).1, "boom: 500, 5\n2\n250\n");
    assert_eq!(withy(home.path(), &["-e", "input(\"load\", 3, \"N\")"]).1, "3\n");
    for (input, message) in [
        (":load boom.rhai --set laod=3", "the script has no input 'laod'"),
        (":load boom.rhai --set load=-1", "got \"-1\""),
        (":load boom.rhai --set load", "write NAME=VALUE, such as load=250"),
    ] {
        let (code, printed, said) = withy(home.path(), &["-e", input]);
        assert!(code == 2 && printed.is_empty() && said.contains(message), "{input}: {said}");
    }
    let (_, printed, said) =
        withy(home.path(), &["repl", "boom.rhai", "--set", "load=1", "-e", "load"]);
    assert_eq!(printed, "boom: 2, 4\n1\n", "{said}");
}

/// Time limit of a wait, generous for loaded machines.
#[cfg(unix)]
const TIME_LIMIT: std::time::Duration = std::time::Duration::from_secs(60);

#[cfg(unix)]
#[test]
fn watching_runs_again_after_each_change_and_survives_errors() {
    use std::io::{BufRead, BufReader};
    use std::sync::mpsc::channel;

    let text = "import \"parts\" as parts; print(`${parts::spans} ${read_csv(\"data.csv\").a}`);
        write_csv([#{ b: 1 }], \"b.csv\"); read_csv(\"b.csv\");";
    let home = folder(&[
        ("boom.rhai", text),
        ("parts.rhai", "export let spans = 4;"),
        ("data.csv", "a\n1\n"),
    ]);
    let mut watching = Command::new(env!("CARGO_BIN_EXE_withy"));
    watching.args(["run", "boom.rhai", "--watch"]).current_dir(home.path());
    let mut watching = watching.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let (send, lines) = channel();
    let forward = |stream: Box<dyn std::io::Read + Send>| {
        let send = send.clone();
        std::thread::spawn(move || {
            let lines = BufReader::new(stream).lines().map_while(Result::ok);
            lines.for_each(|line| _ = send.send(line));
        })
    };
    let streams = [
        forward(Box::new(watching.stdout.take().unwrap())),
        forward(Box::new(watching.stderr.take().unwrap())),
    ];
    // The lines of both streams may arrive in any order.
    let wait_for = |expected: &[&str]| {
        let mut missing = expected.to_vec();
        let mut seen = Vec::new();
        while !missing.is_empty() {
            match lines.recv_timeout(TIME_LIMIT) {
                Ok(line) => {
                    missing.retain(|phrase| !line.contains(phrase));
                    seen.push(line);
                }
                Err(_) => panic!("{missing:?} were not printed, but {seen:#?}"),
            }
        }
    };
    let save = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    wait_for(&["--- run 1 of boom.rhai ---", "4 [1", "waiting for a changed file"]);
    save("parts.rhai", "export let spans = 16;");
    wait_for(&["--- run 2 of boom.rhai: parts.rhai has changed ---", "16 [1", "waiting"]);
    save("data.csv", "a\n12\n");
    wait_for(&["--- run 3 of boom.rhai: data.csv has changed ---", "16 [12", "waiting"]);
    save("boom.rhai", "let = ;");
    wait_for(&["--- run 4 of boom.rhai: boom.rhai has changed ---", "error", "waiting"]);
    save("boom.rhai", "print(\"mended\");");
    wait_for(&["--- run 5 of", "mended", "waiting"]);
    Command::new("kill").args(["-INT", &watching.id().to_string()]).status().unwrap();
    assert_eq!(watching.wait().unwrap().code(), Some(0));
    streams.into_iter().for_each(|stream| stream.join().unwrap());
}
