//! The walls: which layer may use which, and that a file stays one idea.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// From left to right (design: main → cli → repl, exercises → script → output, analysis → simulation → … → model): a layer may use
/// those of the groups after its own, and everything below the model.
const CHAIN: &[&[&str]] = &[
    &["cli"],
    &["repl", "exercises"],
    &["script"],
    &["output", "analysis"],
    &["simulation"],
    &["statics"],
    &["vibration"],
    &["model"],
];

/// Below the model, and beside the chain: each layer with those it may use.
const BRANCHES: &[(&str, &[&str])] = &[
    ("joints", &["beams", "geometry", "elementary"]),
    ("loads", &["beams", "geometry", "elementary"]),
    ("beams", &["geometry", "elementary"]),
    ("geometry", &["elementary"]),
    ("integrators", &["newton", "linalg", "elementary"]),
    ("newton", &["linalg", "elementary"]),
    ("linalg", &["elementary"]),
    ("elementary", &[]),
    ("folders", &[]),
];

/// What a layer may use; none if it is in no table.
fn allowed(layer: &str) -> Option<Vec<&'static str>> {
    match layer {
        "main.rs" => return Some(vec!["cli"]),
        "lib.rs" => return Some(Vec::new()),
        // It draws plain data.
        "output" => return Some(vec!["elementary", "folders"]),
        _ => {}
    }
    if let Some((_, uses)) = BRANCHES.iter().find(|(name, _)| *name == layer) {
        return Some(uses.to_vec());
    }
    let own = CHAIN.iter().position(|group| group.contains(&layer))?;
    let right = CHAIN[own + 1..].iter().copied().flatten().copied();
    Some(right.chain(BRANCHES.iter().map(|(name, _)| *name)).collect())
}

/// Most lines of a file.
const LONGEST: usize = 400;

fn sources() -> Vec<(PathBuf, String)> {
    fn collect(folder: &Path, files: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = entry.path();
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                files.push((path, text));
            }
        }
    }
    let mut files = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    assert!(files.len() > 50, "src has {} files", files.len());
    files
}

fn layer(path: &Path) -> String {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let first = path.strip_prefix(src).unwrap().components().next().unwrap();
    first.as_os_str().to_string_lossy().into_owned()
}

/// The layers named after `crate::` (or, in the binary, `withy::`) in the code of a file, comments apart.
fn used(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for marker in ["crate::", "withy::"] {
            for (at, _) in code.match_indices(marker) {
                let name = code[at + marker.len()..]
                    .split(|c: char| !c.is_alphanumeric() && c != '_')
                    .next()
                    .unwrap_or_default();
                found.push((number + 1, name.to_owned()));
            }
        }
    }
    found
}

/// Uses that the table does not allow, as `file:line: layer uses layer`.
fn trespasses(files: &[(PathBuf, String)]) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        let own = layer(path);
        let Some(allowed) = allowed(&own) else {
            found.push(format!("{}: no layer '{own}' in the table", path.display()));
            continue;
        };
        for (line, name) in used(text) {
            if name != own && !allowed.contains(&name.as_str()) {
                found.push(format!("{}:{line}: {own} uses {name}", path.display()));
            }
        }
    }
    found
}

#[test]
fn layers_use_only_those_to_their_right() {
    let found = trespasses(&sources());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_trespass_is_found() {
    let beams = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/beams/mesh.rs");
    let text = "use crate::geometry::Vec2;\n// crate::model is fine here\nuse crate::integrators::Stage;\n";
    let found = trespasses(&[(beams, text.to_owned())]);
    assert!(
        found.len() == 1 && found[0].ends_with("mesh.rs:3: beams uses integrators"),
        "{found:?}"
    );
}

#[test]
fn no_file_is_longer_than_four_hundred_lines() {
    for (path, text) in sources() {
        let lines = text.lines().count();
        assert!(lines <= LONGEST, "{} has {lines} lines", path.display());
    }
}
