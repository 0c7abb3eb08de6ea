//! Sweeps as a user has them: the same bytes on one core and on all, interrupted and gone on with, and what they take.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A sweep of so many flights of a beam, some of which fail.
fn flights(rows: usize) -> String {
    format!(
        "let s = section(#{{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 }});
        let sweep = study_sweep(#{{
            name: \"flights\", samples: latin_hypercube({rows}), parameters: #{{ moment: uniform(-80, 80), hold: normal(1, 0.2) }},
            run: |p| {{
                let scene = new_scene(\"rod\");
                let rod = scene.beam(#{{ axis: line([0, 8], [6, 0]), basis: bspline(2), section: s }});
                scene.moment(rod.end, p.moment, hold_for(p.hold));
                if p.moment > 70 {{ throw `too much: ${{p.moment}}`; }}
                let sim = scene.start(#{{ dt: 0.1 }});
                sim.run_to(1);
                #{{ energy: sim.energy, x: sim.position(rod.end).x }}
            }},
        }});
        print(sweep.table);"
    )
}

fn script(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("script.rhai");
    fs::write(&file, text).unwrap();
    (folder, file)
}

fn withy(file: &Path, out: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.arg("study").arg(file).arg("--out").arg(file.with_file_name(out));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The table that a run wrote.
fn table(file: &Path, out: &str) -> Vec<u8> {
    fs::read(file.with_file_name(out).join("flights.csv")).unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn one_core_and_all_of_them_give_the_same_bytes() {
    let (_folder, file) = script(&flights(60));
    let all = withy(&file, "all").output().unwrap();
    assert_eq!(all.status.code(), Some(0), "{}", said(&all));
    let program = withy(&file, "one");
    let mut alone = Command::new("taskset");
    alone.args(["-c", "0"]).arg(program.get_program()).args(program.get_args());
    let one = alone.output().unwrap();
    assert_eq!(one.status.code(), Some(0), "{}", said(&one));
    assert_eq!(one.stdout, all.stdout);
    assert_eq!(table(&file, "one"), table(&file, "all"));
    let text = String::from_utf8(table(&file, "all")).unwrap();
    assert_eq!(text.lines().count(), 61);
    assert!(text.contains("too much: 7"), "{text}");
}

#[test]
fn a_killed_sweep_goes_on_where_it_was() {
    let (_folder, file) = script(&flights(1500));
    let whole = withy(&file, "whole").output().unwrap();
    assert_eq!(whole.status.code(), Some(0), "{}", said(&whole));
    let journal = file.with_file_name("out").join("flights.journal");
    for signal in ["-INT", "-KILL"] {
        let before = fs::metadata(&journal).map_or(0, |about| about.len());
        let mut running = withy(&file, "out").spawn().unwrap();
        let begun = Instant::now();
        while fs::metadata(&journal).map_or(0, |about| about.len()) < before + 500 {
            assert!(begun.elapsed() < Duration::from_secs(60), "nothing is written");
            assert!(running.try_wait().unwrap().is_none(), "it ended before it was stopped");
            std::thread::sleep(Duration::from_millis(5));
        }
        Command::new("kill").args([signal, &running.id().to_string()]).status().unwrap();
        let output = running.wait_with_output().unwrap();
        assert_ne!(output.status.code(), Some(0), "{}", said(&output));
        if signal == "-INT" {
            assert!(said(&output).contains("finished cases are kept"), "{}", said(&output));
        }
    }
    // A record that was cut off is lost, and no other.
    let bytes = fs::read(&journal).unwrap();
    fs::write(&journal, &bytes[..bytes.len() - 3]).unwrap();
    let output = withy(&file, "out").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(
        said(&output).contains("of 1500 rows are known from an earlier run"),
        "{}",
        said(&output)
    );
    assert_eq!((table(&file, "out"), output.stdout), (table(&file, "whole"), whole.stdout));
    assert!(!journal.exists());
}

#[test]
fn a_journal_of_another_sweep_is_not_taken() {
    let (_folder, file) = script(&flights(20));
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, format!("{text}\nmissing();")).unwrap();
    let output = withy(&file, "out").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("20 finished cases are kept"), "{}", said(&output));
    fs::write(&file, text.replace("energy: sim.energy", "energy: 2 * sim.energy")).unwrap();
    let output = withy(&file, "out").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(!said(&output).contains("are known"), "{}", said(&output));
}

#[test]
fn steps_of_all_runs_count_and_a_check_makes_one() {
    let (folder, file) = script(&flights(400));
    let mut limited = withy(&file, "out");
    let output = limited.args(["--max-steps", "300"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("more than 300 steps"), "{}", said(&output));
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    let check = Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&file).output().unwrap();
    assert_eq!(check.status.code(), Some(0), "{}", said(&check));
    assert!(check.stdout.is_empty() && fs::read_dir(folder.path()).unwrap().count() == 1);
}
