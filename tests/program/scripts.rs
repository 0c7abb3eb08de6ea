//! Every script of `scripts/` runs with the binary, passes its checks and writes the files that it names.

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

/// File names in the strings of a script, by their extensions.
fn named_files(script: &str) -> Vec<&str> {
    let texts = script.split('"').skip(1).step_by(2);
    texts
        .filter(|text| [".svg", ".png", ".csv"].iter().any(|ending| text.ends_with(ending)))
        .collect()
}

/// Checks the content of a file: a drawing has axis labels and lines, a picture has a size, and a table has rows of numbers below its column names.
fn expect_content(file: &str, bytes: &[u8]) {
    if file.ends_with(".png") {
        assert_eq!(&bytes[1..4], b"PNG", "{file}");
        let width = u32::from_be_bytes(bytes[16..20].try_into().unwrap());
        assert!(width > 100, "{file} is {width} pixels wide");
        return;
    }
    let text = std::str::from_utf8(bytes).unwrap();
    if file.ends_with(".svg") {
        let message = text.split_once("<desc>").unwrap().1.split_once("</desc>").unwrap().0;
        assert!(
            message.split(" | ").filter(|text| !text.is_empty()).count() > 3,
            "{file}: {message}"
        );
        assert!(text.contains("<polyline"), "{file} has no line");
        return;
    }
    let mut rows = text.lines().filter(|line| !line.starts_with('#'));
    let names = rows.next().unwrap().split(',').count();
    let numbers = rows.flat_map(|row| row.split(',')).map(|cell| cell.parse::<f64>().is_ok());
    let (all, good) = numbers.fold((0, 0), |(all, good), is| (all + 1, good + usize::from(is)));
    assert!(all > names && good == all, "{file}: {good} of {all} cells are numbers");
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
            let bytes = std::fs::read(out.path().join(file))
                .unwrap_or_else(|_| panic!("{file} is missing"));
            expect_content(file, &bytes);
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
