//! `withy study` as a user has it: tables, files, references, rivals; interrupted and gone on with; studies of the project checked.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use withy::analysis::Journal;

fn withy(arguments: &[&str], file: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.args(arguments).arg(file).arg("--out").arg(file.with_file_name("out"));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn printed(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// A study of a spinning rod, in a folder of its own.
fn script(options: &str, after: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("script.rhai");
    let text = format!(
        "let s = section(#{{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 }});
        let scene = |mesh| {{
            let scene = new_scene(\"rod\");
            let rod = scene.beam(#{{ axis: line([0, 0], [2, 0]), basis: mesh, section: s, spin: 1 }});
            #{{ scene: scene, stations: #{{ tip: rod.end }} }}
        }};
        let study = study_work_precision(#{{ name: \"rod\", scene: scene, integrators: [energy_momentum()], {options} }});
        {after}"
    );
    fs::write(&file, text).unwrap();
    (folder, file)
}

/// Where the tip of the rod is after a turn by one radian; it stretches a little, which the bound of the error covers.
const TURNED: &str = "# turned by t radians\nt,xtip,ytip,thtip,d_pos\n1,1.0806,1.6829,1,0.5\n";

#[test]
fn a_study_is_compared_with_a_table_and_with_rivals() {
    let options = "meshes: [bspline(2)], dts: [0.2, 0.1], times: [1], repeats: 5, reference: \"turned.csv\", rivals: \"rivals.csv\"";
    let (folder, file) = script(options, "print(study.table); print(study.cheapest([1e9, 1e-9]));");
    fs::write(folder.path().join("turned.csv"), TURNED).unwrap();
    let rivals = "series,peer,integrator,run_time_s,t,xtip,ytip,energy_drift,machine\nA implicit,A,euler,4,1,1.0806,9.6829,,an abacus\n";
    fs::write(folder.path().join("rivals.csv"), rivals).unwrap();
    let output = withy(&["study", "--repeats", "2"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = printed(&output);
    assert!(text.contains("reference: turned.csv, an independent solution"), "{text}");
    assert!(text.contains("≤ "), "errors below the trusted digits are marked: {text}");
    assert!(text.contains("A implicit, euler") && text.contains("no run"), "{text}");
    assert!(text.contains("rivals measured on an abacus"), "{text}");
    let out = folder.path().join("out");
    let csv = fs::read_to_string(out.join("rod.csv")).unwrap();
    assert_eq!(csv.lines().filter(|line| line.contains("finished")).count(), 2, "{csv}");
    let picture = fs::read_to_string(out.join("rod.svg")).unwrap();
    assert!(
        picture.contains("A implicit")
            && picture.contains("an abacus")
            && picture.contains("our front")
    );
    assert!(!out.join("rod.journal").exists(), "a finished study leaves no journal");
}

#[test]
fn a_wrong_reference_is_told_before_anything_runs() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [0.5], reference: \"turned.csv\"";
    let (folder, file) = script(options, "");
    fs::write(folder.path().join("turned.csv"), TURNED).unwrap();
    for command in ["study", "run"] {
        let output = withy(&[command], &file).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let told = said(&output);
        assert!(told.contains("no row at t = 0.5; the nearest rows are at t = 1"), "{told}");
    }
}

#[test]
fn a_reference_without_a_number_is_told_with_its_place() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [1], reference: \"turned.csv\"";
    let (folder, file) = script(options, "");
    fs::write(folder.path().join("turned.csv"), TURNED.replace("1.6829", "nan")).unwrap();
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let told = "\"turned.csv\": line 3, column 'ytip', holds 'nan', which is not a finite number";
    assert!(said(&output).contains(told), "{}", said(&output));
}

#[test]
fn wrong_rivals_are_told_before_anything_runs() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [1], rivals: \"rivals.csv\"";
    let (folder, file) = script(options, "");
    let rivals = "series,peer,integrator,run_time_s,t,xtip,ytip,energy_drift,machine\nA,A,euler,4,2,1,9,,an abacus\n";
    fs::write(folder.path().join("rivals.csv"), rivals).unwrap();
    let output = withy(&["study", "--max-time", "20"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("\"rivals.csv\""), "{}", said(&output));
}

#[test]
fn what_ran_out_of_patience_is_tried_again() {
    let options = "meshes: [bspline(2)], dts: [0.1, 1e-3, 5e-4, 2e-4], times: [1], repeats: 1, reference: finest_run(#{ dt: 0.04 })";
    let (folder, file) = script(options, "print(study.table);");
    let journal = folder.path().join("out").join("rod.journal");
    let output = withy(&["study", "--max-steps", "300"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    // The runs of the reference and the first case are short; the others do not come to their end.
    let known = Journal::open(&journal).unwrap().len();
    assert!((1..=3).contains(&known), "{known}");
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let told = format!("{known} of 6 runs are known");
    assert!(said(&output).contains(&told), "{}", said(&output));
    assert!(!printed(&output).contains("given up"), "{}", printed(&output));
}

/// Two short cases, and one that takes for ever; the two runs of the reference are short, too.
const ENDLESS: &str = "meshes: [bspline(2)], dts: [0.1, 0.05, 1e-8], times: [1], repeats: 1, reference: finest_run(#{ dt: 0.02 })";

/// Waits until so many cases are in a journal.
fn wait_for(journal: &Path, cases: usize) {
    let begun = Instant::now();
    while Journal::open(journal).unwrap().len() < cases {
        assert!(begun.elapsed() < Duration::from_secs(60), "the journal does not grow");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_goes_on_where_it_was() {
    let (folder, file) = script(ENDLESS, "");
    let journal = folder.path().join("out").join("rod.journal");
    let running = withy(&["study"], &file).spawn().unwrap();
    wait_for(&journal, 4);
    let id = running.id().to_string();
    Command::new("kill").args(["-INT", &id]).status().unwrap();
    let output = running.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", said(&output));

    let known = |arguments: &[&str]| {
        let output = withy(arguments, &file).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert!(said(&output).contains("takes longer than 1 s"), "{}", said(&output));
        said(&output).lines().find(|line| line.contains("are known")).map(str::to_owned)
    };
    let goes_on = known(&["study", "--max-time", "1"]).unwrap();
    assert_eq!(goes_on, "study 'rod' goes on: 4 of 5 runs are known from an earlier run");
    assert_eq!(known(&["study", "--max-time", "1", "--fresh"]), None);

    // The same with an end: the endless case is replaced, the others are known, and so are they after a limit.
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("1e-8", "0.025")).unwrap();
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("4 of 5 runs are known"), "{}", said(&output));
    assert!(!journal.exists());
}

#[test]
fn a_study_of_a_run_keeps_no_journal() {
    let (folder, file) = script(ENDLESS, "");
    let output = withy(&["run", "--max-time", "1"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn steps_are_limited_and_each_run_has_patience() {
    let (_folder, file) = script(ENDLESS, "");
    let output = withy(&["study", "--max-steps", "70"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let options = "meshes: [bspline(2)], dts: [0.1, 1e-8], times: [1], repeats: 1, patience: 0.2, reference: finest_run(#{ dt: 0.02 })";
    let (_folder, file) = script(options, "print(study.table);");
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(printed(&output).contains("more than 0.2 s"), "{}", printed(&output));
}

#[test]
fn a_check_builds_a_study_and_runs_nothing() {
    let (folder, file) = script(ENDLESS, "let best = study.cheapest(1e-3); print(best.run_time);");
    let output =
        Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn the_studies_of_the_project_can_be_checked() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/studies");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let scripts: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "rhai")).collect();
    assert!(scripts.len() >= 3);
    for script in scripts {
        let output =
            Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&script).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}: {}", script.display(), said(&output));
    }
}
