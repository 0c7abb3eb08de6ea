//! `withy docs`, run with the binary.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::process::{Command, Output};

fn docs(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_withy"))
        .arg("docs")
        .args(arguments)
        .env_remove("COLUMNS")
        .output()
        .expect("withy starts")
}

fn shown(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).expect("the output is UTF-8")
}

#[test]
fn docs_without_a_name_print_an_overview() {
    let overview = shown(&docs(&[]));
    for heading in ["The language\n", "  loads: ", "  arrays: ", "  closures: "] {
        assert!(overview.contains(heading), "{heading}\n{overview}");
    }
    assert!(overview.lines().all(|line| line.chars().count() <= 80), "{overview}");
}

#[test]
fn docs_of_a_name_have_no_colours_in_a_pipe() {
    let page = shown(&docs(&["simulation.run_to"]));
    assert!(page.starts_with("simulation.run_to(t)\nTakes steps until a time"), "{page}");
    assert!(page.contains("\nExample\n    "), "{page}");
    assert!(!page.contains('\u{1b}'), "{page}");
}

#[test]
fn example_of_a_page_runs_unchanged() {
    let page = shown(&docs(&["slider_position"]));
    let script: Vec<_> = page.lines().filter_map(|line| line.strip_prefix("    ")).collect();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("copied.rhai");
    fs::write(&file, script.join("\n")).expect("the script is written");
    let run = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["run", "--quiet"])
        .arg(&file)
        .current_dir(folder.path())
        .output()
        .expect("withy starts");
    assert!(run.status.success(), "{}\n{}", page, String::from_utf8_lossy(&run.stderr));
}

#[test]
fn terms_of_several_words_are_found() {
    for (words, topic) in [
        (&["boundary", "condition"][..], "scene.clamp"),
        (&["capstan"], "friction"),
        (&["restart", "file"], "load_simulation"),
    ] {
        let page = shown(&docs(words));
        assert!(page.contains(topic), "{words:?}: {page}");
    }
}

#[test]
fn page_width_is_that_of_the_terminal() {
    let output = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["docs", "section"])
        .env("COLUMNS", "50")
        .output()
        .expect("withy starts");
    let page = shown(&output);
    assert!(page.lines().all(|line| line.chars().count() <= 50), "{page}");
}

#[test]
fn unknown_names_are_rejected_with_a_suggestion() {
    let output = docs(&["slidr"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("error: there is no help on 'slidr'"), "{said}");
    assert!(said.contains("did you mean 'slider'?"), "{said}");
}

#[test]
fn markdown_output_equals_the_reference_in_docs() {
    let index = fs::read_to_string("docs/language.md").expect("docs/language.md");
    let shown = shown(&docs(&["--markdown"]));
    assert!(shown.starts_with(&index), "docs/language.md is old");
    let first = fs::read_to_string("docs/language/syntax.md").expect("docs/language/syntax.md");
    assert!(shown.contains(&first), "docs/language/syntax.md is old");
}

#[test]
fn definitions_are_written_for_every_table() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let target = folder.path().join("editor/definitions");
    let message = shown(&docs(&["--definitions", target.to_str().expect("a path in UTF-8")]));
    let files: Vec<_> = fs::read_dir(&target).expect("the folder").map(Result::unwrap).collect();
    assert_eq!(message.lines().count(), files.len());
    let scenes = fs::read_to_string(target.join("scenes.d.rhai")).expect("scenes.d.rhai");
    assert!(scenes.contains("\nfn beam(scene: scene, options: map) -> beam;\n"), "{scenes}");
    assert!(files.iter().all(|file| file.file_name().to_string_lossy().ends_with(".d.rhai")));
}

#[test]
fn foreign_files_are_not_replaced_by_definitions() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().to_str().expect("a path in UTF-8").to_owned();
    for _ in 0..2 {
        assert_eq!(docs(&["--definitions", &path]).status.code(), Some(0));
    }
    fs::write(folder.path().join("scenes.d.rhai"), "mine").expect("a file");
    let output = docs(&["--definitions", &path]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("is not a definition file"));
    assert_eq!(fs::read(folder.path().join("scenes.d.rhai")).expect("the file"), b"mine");
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("taken");
    fs::write(&file, "").expect("a file");
    let output = docs(&["--definitions", file.to_str().expect("a path in UTF-8")]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("cannot write") && said.contains("taken"), "{said}");
}

#[test]
fn name_and_other_output_form_exclude_each_other() {
    assert_eq!(docs(&["sin", "--markdown"]).status.code(), Some(2));
}
