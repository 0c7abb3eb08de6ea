//! Sweeps: equal bytes on one core and on all, interrupted and continued sweeps, and memory use.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// Sweep of flights of a beam, some of which fail.
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

fn table(file: &Path, out: &str) -> Vec<u8> {
    fs::read(file.with_file_name(out).join("flights.csv")).unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn any_number_of_cores_gives_the_same_bytes() {
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
fn killed_sweep_continues_with_unfinished_rows() {
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
    // Only the truncated record is lost.
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
fn journal_of_another_sweep_is_not_used() {
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

/// Three parts in separate folders, from machines with other names. The second one is killed and continued.
#[test]
fn merged_parts_equal_the_output_of_a_single_run() {
    let (folder, file) = script(&flights(300));
    let whole = withy(&file, "whole").output().unwrap();
    assert_eq!(whole.status.code(), Some(0), "{}", said(&whole));
    let part = |number: usize, out: &str| {
        let mut command = withy(&file, out);
        command.args(["--part", &format!("{number}/3")]);
        command
    };
    let joined = |folders: &[&str]| {
        let mut command = withy(&file, "joined");
        command.arg("--merge").args(folders.iter().map(|name| file.with_file_name(name)));
        command.output().unwrap()
    };
    for (number, out) in [(1, "a"), (3, "b")] {
        let output = part(number, out).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert!(output.stdout.is_empty());
        assert_eq!(
            said(&output),
            format!("100 finished cases are kept in '{}'\n", file.with_file_name(out).display())
        );
    }
    let refused = |folders: &[&str], message: &str| {
        let output = joined(folders);
        assert_eq!(output.status.code(), Some(2));
        assert!(said(&output).contains(message), "{}", said(&output));
    };
    refused(&["a", "b"], "of the 3 parts of the study 'flights' these are missing: 2");
    refused(&["nowhere"], "no part of the study 'flights'");
    // The part is truncated in the middle, as by a kill, then refused, then continued.
    let second = part(2, "c").output().unwrap();
    assert_eq!(second.status.code(), Some(0), "{}", said(&second));
    let kept = file.with_file_name("c").join("flights.2-of-3.part");
    let bytes = fs::read(&kept).unwrap();
    fs::write(&kept, &bytes[..bytes.len() / 2]).unwrap();
    refused(&["a", "b", "c"], "part 2 of 3 of the study 'flights' is not finished");
    let again = part(2, "c").output().unwrap();
    assert!(said(&again).contains("rows are known from an earlier run"), "{}", said(&again));
    let output = joined(&["c", "b", "a"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!((output.stdout, table(&file, "joined")), (whole.stdout, table(&file, "whole")));
    assert!(kept.exists(), "parts stay");

    fs::create_dir(folder.path().join("d")).unwrap();
    fs::copy(&kept, file.with_file_name("d").join("flights.2-of-3.part")).unwrap();
    refused(&["a", "b", "c", "d"], "part 2 of 3 of the study 'flights' exists twice");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("sim.run_to(1)", "sim.run_to(2)")).unwrap();
    refused(&["a", "b", "c"], "is not a part of this study");
}

#[test]
fn merged_parts_of_other_studies_equal_the_output_of_a_single_run() {
    let text = "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
        let scene = |mesh| {
            let scene = new_scene(\"rod\");
            scene.beam(#{ axis: line([0, 0], [2, 0]), basis: mesh, section: s, spin: 1 });
            scene
        };
        study_stability(#{ name: \"map\", scene: |cell| scene.call(bspline(2)), end: 1, rows: #{ dt: [0.1, 0.05] },
            columns: #{ integrator: [energy_momentum(), trapezoidal()] } });
        study_convergence(#{ name: \"steps\", scene: scene, integrators: [energy_momentum(), fourth_order()],
            meshes: [bspline(2)], dts: [0.2, 0.1], times: [1] });";
    let (_folder, file) = script(text);
    let whole = withy(&file, "whole").output().unwrap();
    assert_eq!(whole.status.code(), Some(0), "{}", said(&whole));
    for number in ["1/2", "2/2"] {
        let output = withy(&file, "parts").args(["--part", number]).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    }
    let parts = file.with_file_name("parts");
    let names = fs::read_dir(&parts).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    assert_eq!(
        names,
        ["map.1-of-2.part", "map.2-of-2.part", "steps.1-of-2.part", "steps.2-of-2.part"]
    );
    let output = withy(&file, "joined").arg("--merge").arg(&parts).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(output.stdout, whole.stdout);
    let read = |out: &str, name: &str| fs::read(file.with_file_name(out).join(name)).unwrap();
    for name in ["map.csv", "map.svg", "steps.csv", "steps.svg"] {
        assert_eq!(read("joined", name), read("whole", name), "{name}");
    }
    fs::remove_file(parts.join("steps.2-of-2.part")).unwrap();
    let output = withy(&file, "joined").arg("--merge").arg(&parts).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        said(&output).contains("of the 2 parts of the study 'steps' these are missing: 2"),
        "{}",
        said(&output)
    );
}

#[test]
fn steps_of_all_runs_are_limited_and_a_check_writes_nothing() {
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

/// Scatter plots select points at random and maps average cells, as the pictures state. Pictures of selected rows have names of their own.
#[test]
fn pictures_show_all_rows_and_have_distinct_names() {
    let (_folder, file) = script(
        r#"
        let lots = study_sweep(#{ name: "lots", samples: sobol(4000), parameters: #{ a: uniform(0, 1), b: uniform(-1, 1) }, run: |p| #{ y: p.a + p.b } });
        lots.plot("a", "b");
        lots.plot_matrix();
        let grid = study_sweep(#{ name: "grid", parameters: #{ a: linspace(0, 1, 400), b: linspace(0, 1, 400) }, run: |p| #{ y: p.a * p.b } });
        grid.plot("a", "b", "y");
        grid.plot("a", "y");
        grid.table.where(|row| row.a < 0.5).plot("a", "y");
        grid.table.where(|row| row.a > 0.5).plot("a", "y");
        "#,
    );
    let output = withy(&file, "out").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let picture = |name: &str| {
        let name = format!("{name}.svg");
        fs::read_to_string(file.with_file_name("out").join(name)).unwrap()
    };
    let [scatter, matrix] = ["lots-a-b", "lots-matrix"].map(picture);
    assert!(scatter.contains("2000 of 4000 points, selected at random"));
    assert!(matrix.contains("lots: 500 of 4000 runs, selected at random"));
    // The axis is not logarithmic because of its smallest point alone.
    assert!(!scatter.contains("10⁻"), "{}", &scatter[..2000]);
    let map = picture("grid-a-b-y");
    assert!(map.contains("each drawn cell is the mean of 3 × 3"));
    assert!(map.len() < 4_000_000, "{}", map.len());
    let [all, low, high] = ["grid-a-y", "grid-a-y-2", "grid-a-y-3"].map(picture);
    assert!(all != low && low != high && high != all);
}

/// If all runs fail, the first one is repeated to locate its error. It neither prints nor writes.
#[test]
fn failed_runs_of_a_sweep_print_and_write_nothing() {
    let (_folder, file) = script(
        r#"
        study_sweep(#{ name: "failing", parameters: #{ x: [1, 2] }, run: |p| {
            print("printed by a run");
            if p.x > 1 { write_csv([#{ a: 1 }], "written.csv"); }
            throw "no " + p.x;
        } });
        "#,
    );
    let output = withy(&file, "out").output().unwrap();
    assert_ne!(output.status.code(), Some(0));
    assert!(said(&output).contains("no 1"), "{}", said(&output));
    assert!(!String::from_utf8_lossy(&output.stdout).contains("printed by a run"));
    let text = fs::read_to_string(&file).unwrap().replace("p.x > 1", "p.x > 0");
    fs::write(&file, text).unwrap();
    let output = withy(&file, "out").output().unwrap();
    assert!(said(&output).contains("no file is written here"), "{}", said(&output));
    assert!(!file.with_file_name("out").join("written.csv").exists());
}

#[test]
fn sensitivity_reports_the_number_of_omitted_rows() {
    let (_folder, file) = script(
        r#"
        let sweep = study_sweep(#{
            name: "some fail", samples: saltelli(64), parameters: #{ a: uniform(0, 1), b: uniform(0, 1) },
            run: |p| { if p.a > 0.99 { throw "too much"; } #{ y: p.a + p.b } },
        });
        print(sweep.failures.count);
        sweep.sensitivity("y");
        "#,
    );
    let output = withy(&file, "out").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let message = said(&output);
    let message = message.lines().find(|line| line.contains("the sensitivity of 'y'")).unwrap();
    assert!(
        message.contains("of 256 rows") && message.contains("blocks are left out"),
        "{message}"
    );
}

/// In the long test a million rows within 200 MB, in the short test a tenth of them within 100 MB. A run beyond the limit fails.
#[cfg(target_os = "linux")]
#[test]
fn a_million_rows_fit_into_200_megabytes() {
    let (values, megabytes) =
        if std::env::var_os("WITHY_LONG").is_some() { (1000, "200") } else { (316, "100") };
    let (_folder, file) = script(&format!(
        "let values = linspace(0, 1, {values});
        let sweep = study_sweep(#{{ name: \"many\", parameters: #{{ a: values, b: values }}, run: |p| #{{ y: p.a * p.b, z: p.a - p.b }} }});
        check(sweep.table.count == {values} * {values});"
    ));
    let output = withy(&file, "out").args(["--quiet", "--max-memory", megabytes]).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let written = fs::read_to_string(file.with_file_name("out").join("many.csv")).unwrap();
    assert_eq!(written.lines().filter(|line| !line.starts_with('#')).count(), values * values + 1);
}
