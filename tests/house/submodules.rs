//! Dependencies between the submodules of the script.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

use crate::layering::{DependencyRules, sources, without_tests};

/// Submodules in order. A submodule may use those before it.
const SUBMODULES: &[&str] = &[
    "messages",
    "source",
    "state",
    "bindings",
    "dialect",
    "library",
    "diagnose",
    "engine",
    "help",
    "presentation",
    "handles",
    "studies",
    "packages",
];

fn script() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/script")
}

/// Submodule of a file of the script.
fn submodule(path: &Path) -> Option<String> {
    let first = path.strip_prefix(script()).ok()?.components().next()?;
    first.as_os_str().to_str().filter(|name| *name != "mod.rs").map(str::to_owned)
}

/// Uses of a submodule by an earlier one.
fn violations_in(files: &[(PathBuf, String)]) -> Vec<String> {
    let place = |name: &str| SUBMODULES.iter().position(|submodule| *submodule == name);
    // Unit tests may use everything.
    let code: Vec<_> = files
        .iter()
        .map(|(path, text)| (path.clone(), without_tests(path, text).to_owned()))
        .collect();
    let rules = DependencyRules {
        part: "submodule",
        root: "script",
        of_file: &submodule,
        paths: &["crate::script::"],
        of_name: &str::to_owned,
        may_use: &|own, other| {
            let own = place(own)?;
            Some(place(other).is_some_and(|other| other < own))
        },
    };
    rules.violations(&code)
}

#[test]
fn script_submodules_use_only_submodules_to_their_left() {
    let files = sources();
    assert!(files.iter().filter(|(path, _)| submodule(path).is_some()).count() > 100);
    let found = violations_in(&files);
    assert!(found.is_empty(), "{}", found.join("\n"));
    let text =
        "use crate::script::bindings::table::Row;\nuse crate::script::messages::stop::Stop;\n";
    let found = violations_in(&[(script().join("source/program.rs"), text.to_owned())]);
    assert!(
        found.len() == 1 && found[0].ends_with("program.rs:1: source uses bindings"),
        "{found:?}"
    );
    let text = "use super::lexing::Lexed;\nuse super::super::bindings::table::Row;\n";
    let found = violations_in(&[(script().join("source/program.rs"), text.to_owned())]);
    assert!(
        found.len() == 1 && found[0].ends_with("program.rs:2: source uses bindings"),
        "{found:?}"
    );
}

#[test]
fn script_folder_contains_only_submodules() {
    let entries = fs::read_dir(script()).unwrap().map(|entry| entry.unwrap().path());
    let files: Vec<_> = entries.filter(|path| path.is_file()).collect();
    assert_eq!(files, [script().join("mod.rs")]);
}
