//! `withy convert`, and its output in the target programs, if they are installed.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SCRIPT: &str = "
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene(\"swing\");
let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });
scene.hinge(rod.start);
scene.particle([1, 3], 1);
scene.gravity([0, -9.81]);
let sim = scene.start(#{ dt: 0.02 });
sim.run_to(1);
let p = sim.position(rod.end);
print(`[${p.x}, ${p.y}]`);
try { write_parquet(sim, \"run.parquet\"); } catch { }
sim.save(\"run.withy\");";

fn withy(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.args(arguments).current_dir(folder).output().expect("withy starts")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Folder with a saved simulation in `out`, and the printed position of the end of its beam.
fn saved() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("swing.rhai"), SCRIPT).expect("the script is written");
    let output = withy(folder.path(), &["run", "swing.rhai", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    (folder, String::from_utf8(output.stdout).expect("a place"))
}

#[test]
fn a_saved_simulation_is_converted_beside_itself_or_into_a_folder() {
    let (folder, _) = saved();
    let home = folder.path();
    let output = withy(home, &["convert", "out/run.withy", "--to", "npz"]);
    assert_eq!((output.status.code(), said(&output).as_str()), (Some(0), "wrote out/run.npz\n"));
    let output = withy(home, &["convert", "out/run.withy", "--to", "csv", "--out", "tables", "-q"]);
    assert_eq!((output.status.code(), said(&output).as_str()), (Some(0), ""));
    let table = fs::read_to_string(home.join("tables/run.csv")).expect("a table");
    assert!(table.starts_with("t,kinetic,") && table.contains("\ntime,energy,"), "{table}");
    let output = withy(home, &["convert", "out/run.withy", "--to", "vtk"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("wrote out/run.pvd\n"), "{}", said(&output));
    let frames = fs::read_dir(home.join("out/run")).expect("frames");
    assert_eq!(
        frames
            .filter(|frame| frame.as_ref().is_ok_and(|f| f.file_name() != *".withy-written"))
            .count(),
        51
    );
    let output = withy(home, &["convert", "out/run.withy", "--to", "html"]);
    assert_eq!((output.status.code(), said(&output).as_str()), (Some(0), "wrote out/run.html\n"));
    let page = fs::read_to_string(home.join("out/run.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.contains("<canvas"), "{page}");
    let old = fs::read(home.join("out/run.npz")).expect("an archive");
    withy(home, &["convert", "out/run.withy", "--to", "npz"]);
    assert_eq!(fs::read(home.join("out/run.npz")).expect("an archive"), old, "equal bytes");
}

#[test]
fn files_that_cannot_be_converted_are_rejected() {
    let (folder, _) = saved();
    let home = folder.path();
    let output = withy(home, &["convert", "no.withy", "--to", "vtk"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("there is no file \"no.withy\""), "{}", said(&output));
    let output = withy(home, &["convert", "swing.rhai", "--to", "npz"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("this is not a restart file"), "{}", said(&output));
    let output = withy(home, &["convert", "out/run.withy", "--to", "exe"]);
    assert_eq!(output.status.code(), Some(2));
    let output = withy(home, &["convert", "out/run.withy", "--to", "vtk", "--max-steps", "10"]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!home.join("out/run.pvd").exists(), "a collection names whole frames alone");
}

/// Uses the Python interpreter in `WITHY_PYTHON`, which needs numpy, meshio, pyvista and pyarrow.
#[test]
fn other_programs_read_the_written_files() {
    let Some(python) = std::env::var_os("WITHY_PYTHON") else {
        eprintln!("SKIPPED: WITHY_PYTHON names no Python with numpy, meshio, pyvista and pyarrow");
        return;
    };
    let (folder, end) = saved();
    let home = folder.path();
    for format in ["npz", "csv", "vtk"] {
        let output = withy(home, &["convert", "out/run.withy", "--to", format]);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    }
    let times: Vec<f64> = fs::read_to_string(home.join("out/run.pvd"))
        .expect("a collection")
        .split("timestep=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap_or_default().parse().expect("a time"))
        .collect();
    assert_eq!((times.len(), times[0], times[50]), (51, 0.0, 1.0));
    let expected = format!("{{\"position\": {end}, \"last\": -2, \"times\": {times:?}}}");
    fs::write(home.join("out/expected.json"), expected).expect("a file");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/exports.py");
    let output =
        Command::new(python).arg(script).arg(home.join("out")).output().expect("Python starts");
    assert!(output.status.success(), "{}", said(&output));
    eprintln!("{}", String::from_utf8_lossy(&output.stdout));
}
