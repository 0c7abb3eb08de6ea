//! Every script of `scripts/` runs through the real binary, passes its own checks and writes the files it names.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

fn scripts() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut scripts: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "rhai")).collect();
    scripts.sort();
    scripts
}

/// The names of files that a script writes: texts that end like one.
fn named_files(script: &str) -> Vec<&str> {
    let texts = script.split('"').skip(1).step_by(2);
    texts
        .filter(|text| [".svg", ".png", ".csv"].iter().any(|ending| text.ends_with(ending)))
        .collect()
}

#[test]
fn every_script_runs_and_writes_its_files() {
    assert!(scripts().len() >= 4);
    for script in scripts() {
        let out = tempfile::tempdir().unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_withy"))
            .args(["run", "--out"])
            .args([out.path(), &script])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{}: {said}", script.display());
        assert!(!said.contains("note: simulation"), "{}: {said}", script.display());
        let text = std::fs::read_to_string(&script).unwrap();
        assert!(!named_files(&text).is_empty(), "{} draws nothing", script.display());
        for file in named_files(&text) {
            let size = std::fs::metadata(out.path().join(file))
                .unwrap_or_else(|_| panic!("{file} is missing"))
                .len();
            assert!(size > 500, "{file} has {size} bytes");
        }
    }
}

#[test]
fn every_script_can_be_checked_without_running() {
    for script in scripts() {
        let output =
            Command::new(env!("CARGO_BIN_EXE_withy")).arg("check").arg(&script).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{}: {said}", script.display());
        assert!(said.contains("no errors found"), "{said}");
    }
}
