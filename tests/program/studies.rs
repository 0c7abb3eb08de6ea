//! `withy study`: tables, files, references, other programs, interrupted and continued studies, and checks of the studies of the project.
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

/// Study of a rotating beam, in its own folder.
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
    fs::write(folder.path().join("turned.csv"), TURNED).unwrap();
    (folder, file)
}

/// Position of the tip of the beam after a rotation by one radian. The error bound allows for the small elongation.
const TURNED: &str = "# turned by t radians\nt,xtip,ytip,thtip,d_pos\n1,1.0806,1.6829,1,0.5\n";

#[test]
fn study_is_compared_with_a_table_and_with_other_programs() {
    let options = "meshes: [bspline(2)], dts: [0.2, 0.1], times: [1], repeats: 5, reference: \"turned.csv\", other_programs: \"other_programs.csv\"";
    let (folder, file) = script(options, "print(study.cheapest([1e9, 1e-9]));");
    let other_programs = "series,peer,integrator,run_time_s,t,xtip,ytip,energy_drift,machine\nA implicit,A,euler,4,1,1.0806,9.6829,,an abacus\n";
    fs::write(folder.path().join("other_programs.csv"), other_programs).unwrap();
    let output = withy(&["study", "--repeats", "2"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = printed(&output);
    assert!(text.contains("reference: turned.csv, an independent solution"), "{text}");
    assert!(text.contains("≤ "), "errors below the trusted digits are marked: {text}");
    assert!(text.contains("A implicit, euler") && text.contains("no run"), "{text}");
    assert!(text.contains("other programs measured on an abacus"), "{text}");
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
fn wrong_reference_is_reported_before_any_run() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [0.5], reference: \"turned.csv\"";
    let (_folder, file) = script(options, "");
    for command in ["study", "run"] {
        let output = withy(&[command], &file).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let message = said(&output);
        assert!(message.contains("no row at t = 0.5; the nearest rows are at t = 1"), "{message}");
    }
}

#[test]
fn reference_without_a_number_is_reported_with_its_position() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [1], reference: \"turned.csv\"";
    let (folder, file) = script(options, "");
    fs::write(folder.path().join("turned.csv"), TURNED.replace("1.6829", "nan")).unwrap();
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message =
        "\"turned.csv\": line 3, column 'ytip', holds 'nan', which is not a finite number";
    assert!(said(&output).contains(message), "{}", said(&output));
}

#[test]
fn reference_with_missing_duplicate_or_negative_values_is_reported() {
    let options = "meshes: [bspline(2)], dts: [1e-7], times: [1], reference: \"turned.csv\"";
    let (folder, file) = script(options, "");
    let (rows, other) = (TURNED.lines().take(2).collect::<Vec<_>>().join("\n"), "1,1,1,1,0.5\n");
    for (table, message) in [
        (rows, "\"turned.csv\": it has no rows"),
        (format!("{TURNED}{other}"), "lines 3 and 4 are both for t = 1, but have different values"),
        (TURNED.replace(",0.5\n", ",-0.5\n"), "line 3, column 'd_pos', holds '-0.5'"),
    ] {
        fs::write(folder.path().join("turned.csv"), table).unwrap();
        let output = withy(&["study"], &file).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(said(&output).contains(message), "{}", said(&output));
    }
}

#[test]
fn wrong_results_of_other_programs_are_reported_before_any_run() {
    let options =
        "meshes: [bspline(2)], dts: [1e-7], times: [1], other_programs: \"other_programs.csv\"";
    let (folder, file) = script(options, "");
    let other_programs = "series,peer,integrator,run_time_s,t,xtip,ytip,energy_drift,machine\nA,A,euler,4,2,1,9,,an abacus\n";
    fs::write(folder.path().join("other_programs.csv"), other_programs).unwrap();
    let output = withy(&["study", "--max-time", "20"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("\"other_programs.csv\""), "{}", said(&output));
}

#[test]
fn cases_that_exceeded_their_time_are_repeated() {
    let options = "meshes: [bspline(2)], dts: [0.1, 1e-3, 5e-4, 2e-4], times: [1], repeats: 1, reference: \"turned.csv\"";
    let (folder, file) = script(options, "");
    let journal = folder.path().join("out").join("rod.journal");
    let output = withy(&["study", "--max-steps", "900"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    // The first case is short, and the others exceed the limit.
    let known = Journal::open(&journal).unwrap().len();
    assert_eq!(known, 1);
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let message = "1 of 4 runs are known";
    assert!(said(&output).contains(message), "{}", said(&output));
    assert!(!printed(&output).contains("by a limit"), "{}", printed(&output));
}

/// Two short cases and an endless one.
const ENDLESS: &str = "meshes: [bspline(2)], dts: [0.1, 0.05, 1e-8], times: [1], repeats: 1, reference: \"turned.csv\"";

/// Waits until a journal has the given number of cases.
fn wait_for(journal: &Path, cases: usize) {
    let begun = Instant::now();
    while Journal::open(journal).unwrap().len() < cases {
        assert!(begun.elapsed() < Duration::from_secs(60), "the journal does not grow");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(unix)]
#[test]
fn interrupted_study_continues_with_unfinished_cases() {
    let (folder, file) = script(ENDLESS, "");
    let journal = folder.path().join("out").join("rod.journal");
    let running = withy(&["study"], &file).spawn().unwrap();
    wait_for(&journal, 2);
    let id = running.id().to_string();
    Command::new("kill").args(["-INT", &id]).status().unwrap();
    let output = running.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", said(&output));
    let kept = format!(
        "interrupted: 2 finished cases are kept in '{}'; the same command continues the study",
        journal.parent().unwrap().display()
    );
    assert!(said(&output).contains(&kept), "{}", said(&output));

    let known = |arguments: &[&str]| {
        let output = withy(arguments, &file).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert!(said(&output).contains("takes longer than 1 s"), "{}", said(&output));
        assert!(said(&output).contains("\n2 finished cases are kept in"), "{}", said(&output));
        assert!(!said(&output).contains("a loop may have no end"), "{}", said(&output));
        said(&output).lines().find(|line| line.contains("are known")).map(str::to_owned)
    };
    let goes_on = known(&["study", "--max-time", "1"]).unwrap();
    assert_eq!(goes_on, "study 'rod' continues: 2 of 3 runs are known from an earlier run");
    assert_eq!(known(&["study", "--max-time", "1", "--fresh"]), None);

    // The endless case is replaced by a short one. The other cases are still known, also after a run that a limit has stopped.
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("1e-8", "0.025")).unwrap();
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("2 of 3 runs are known"), "{}", said(&output));
    assert!(!journal.exists());
}

#[test]
fn finished_studies_are_not_repeated_before_the_whole_script_has_ended() {
    let options = "meshes: [bspline(2)], dts: [0.2, 0.1], times: [1], repeats: 1, reference: finest_run(#{ dt: 0.02 })";
    let second = "study_convergence(#{ name: \"steps\", scene: scene, integrators: [energy_momentum()], \
        meshes: [bspline(2)], dts: [0.2, 0.1], times: [1] }); missing();";
    let (folder, file) = script(options, second);
    let journals = ["rod", "steps"].map(|name| folder.path().join(format!("out/{name}.journal")));
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("10 finished cases are kept in"), "{}", said(&output));
    assert!(journals.iter().all(|journal| journal.exists()));

    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("missing();", "")).unwrap();
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    for message in ["'rod' continues: 4 of 4 runs", "'steps' continues: 4 of 4 runs"] {
        assert!(said(&output).contains(message), "{}", said(&output));
    }
    assert!(!journals.iter().any(|journal| journal.exists()), "nothing is left to go on with");
    let output = withy(&["study"], &file).output().unwrap();
    assert!(!said(&output).contains("continues"), "{}", said(&output));
}

#[test]
fn study_in_a_plain_run_writes_no_journal() {
    let (folder, file) = script(ENDLESS, "");
    let output = withy(&["run", "--max-time", "1"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn steps_and_time_of_each_run_are_limited() {
    let (_folder, file) = script(ENDLESS, "");
    let output = withy(&["study", "--max-steps", "25"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let options = "meshes: [bspline(2)], dts: [0.1, 1e-8], times: [1], repeats: 1, time_limit: 0.2, reference: \"turned.csv\"";
    let (_folder, file) = script(options, "");
    let output = withy(&["study"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(printed(&output).contains("more than 0.2 s"), "{}", printed(&output));
}

#[test]
fn every_study_prints_its_table_once_and_a_check_prints_none() {
    let options = "meshes: [bspline(2)], dts: [0.2, 0.1, adaptive(#{ tolerance: 1e-2 })], times: [1], repeats: 1";
    let others = "study_convergence(#{ name: \"steps\", scene: scene, integrators: [energy_momentum()], \
        meshes: [bspline(2)], dts: [0.2, 0.1], times: [1] });
        study_stability(#{ name: \"map\", scene: |cell| scene.call(bspline(2)).scene, rows: #{ dt: [0.1] }, \
        columns: #{ end: [0.5] } });
        study_cost(#{ name: \"cost\", scene: || scene.call(bspline(2)).scene, dt: 0.1, steps: 2, repeats: 1, features: #{} });";
    let (folder, file) = script(options, others);
    let output = withy(&["run"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let picture = fs::read_to_string(folder.path().join("out/rod.svg")).unwrap();
    assert!(picture.contains("energy_momentum, adaptive"), "a series of its own");
    let text = printed(&output);
    for head in [
        "study 'rod': error at",
        "study 'steps': convergence",
        "in a cell: ",
        "cost: cost of a step",
    ] {
        assert_eq!(text.matches(head).count(), 1, "{head}: {text}");
    }
    let quantities = ["position of tip", "angle of tip", "kinetic", "energy"];
    let steps = &text[text.find("study 'steps'").unwrap()..text.find("in a cell").unwrap()];
    assert_eq!(steps.lines().filter(|line| line.starts_with("all ")).count(), 1, "{steps}");
    for quantity in quantities {
        let lines = steps.lines().filter(|line| line.split("  ").next() == Some(quantity));
        assert_eq!(lines.count(), 1, "{quantity}: {steps}");
    }
    let check = Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&file).output().unwrap();
    assert_eq!((check.status.code(), printed(&check).as_str()), (Some(0), ""));
}

#[test]
fn unfinished_cells_are_listed_one_per_line() {
    let options = "meshes: [bspline(2)], dts: [0.2], times: [1], repeats: 1";
    let map = "study_stability(#{ name: \"map\", end: 0.5, rows: #{ size: [1, 2, 3, 4, 5] }, columns: #{ dt: [0.1, 0.2, 0.3] }, \
        scene: |cell| { let scene = new_scene(\"pushed\"); let bead = scene.particle([0, 0], 1); \
        scene.force(bead, [cell.size, 0], |t| if cell.size > 1 { throw \"MANY\" } else { 1 }); scene } });";
    let map = map.replace("MANY", &"much too ".repeat(30));
    let (_folder, file) = script(options, &map);
    let output = withy(&["run"], &file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = printed(&output);
    let (_, list) = text.split_once("12 of 15 cells did not finish").unwrap();
    assert!(list.contains("map.csv"), "{list}");
    let lines: Vec<&str> = list.lines().filter(|line| line.starts_with("size ")).collect();
    assert_eq!(lines.len(), 12, "{list}");
    assert!(lines.iter().all(|line| line.chars().count() < 140 && line.ends_with('…')), "{list}");
}

#[test]
fn a_check_builds_a_study_and_runs_nothing() {
    let (folder, file) = script(ENDLESS, "let best = study.cheapest(1e-3); print(best.run_time);");
    let output =
        Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "the script and the table");
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

/// Counts of the last line that the study of estimated errors prints: runs, converged runs, and the part of these, in per cent, whose largest error is within a factor of 3 of its estimate.
/// The last value is the range of the estimate over the error.
fn estimated_errors(problem: &str, meshes: &str) -> ([f64; 3], [f64; 2]) {
    let folder = tempfile::tempdir().unwrap();
    let study = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/studies/error_estimates.rhai");
    let output = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["run", "--error=never", study, "--out"])
        .arg(folder.path())
        .args(["--set", &format!("problem={problem}"), "--set", &format!("spans={meshes}")])
        .output()
        .unwrap();
    let text = printed(&output);
    let last = text.lines().rev().find(|line| line.starts_with("| all")).unwrap_or_else(|| {
        panic!("{text}{}", said(&output));
    });
    let cells: Vec<&str> = last.split('|').map(str::trim).collect();
    let number = |cell: &str| cell.trim_end_matches(" %").parse().unwrap();
    let (least, most) = cells[6].split_once(" to ").unwrap();
    ([3, 4, 5].map(|at: usize| number(cells[at])), [number(least), number(most)])
}

#[test]
fn estimated_errors_of_converged_runs_are_near_true_errors() {
    let is_long = std::env::var_os("WITHY_LONG").is_some();
    let parts: &[_] = match is_long {
        false => &[("P2s", "4,8", 20.0)],
        true => &[("P2s", "4,8,16", 40.0), ("P7b", "8,16", 75.0), ("P1s", "16,32", 25.0)],
    };
    for (problem, meshes, least) in parts {
        let ([runs, converged, within], [low, high]) = estimated_errors(problem, meshes);
        assert!(runs > converged && converged >= *least, "{problem}: {converged} of {runs}");
        assert!(within >= 90.0, "{problem}: {within} %");
        assert!(low > 0.1 && high < 10.0, "{problem}: {low} to {high}");
    }
}
