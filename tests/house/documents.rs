//! Every `rhai` block of the README and of `docs/` runs, and its checks pass.

#![allow(clippy::unwrap_used)]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

struct Block {
    line: usize,
    text: String,
}

fn blocks(text: &str, language: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut current: Option<Block> = None;
    for (number, line) in text.lines().enumerate() {
        match (&mut current, line.trim_start()) {
            (None, fence) if fence.strip_prefix("```") == Some(language) => {
                current = Some(Block { line: number + 2, text: String::new() });
            }
            (Some(_), fence) if fence.starts_with("```") => blocks.extend(current.take()),
            (Some(block), _) => block.text += &format!("{line}\n"),
            _ => {}
        }
    }
    blocks
}

#[test]
fn every_block_of_rhai_in_the_documents_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let documents =
        std::fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let documents: Vec<_> = documents
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .chain([root.join("README.md")])
        .collect();
    let mut count = 0;
    for document in documents {
        for block in blocks(&std::fs::read_to_string(&document).unwrap(), "rhai") {
            let name = format!("{}:{}", document.display(), block.line);
            let out = tempfile::tempdir().unwrap();
            let message = Notepad::default();
            let settings = RunSettings {
                out: out.path().to_owned(),
                diagnostics: Box::new(message.clone()),
                ..RunSettings::silent(RunMode::Run)
            };
            let outcome = run(&Program::named(&name, &block.text), &language(), settings);
            assert!(matches!(outcome.ending, Ending::Finished), "{name}: {:?}", outcome.ending);
            let message = message.take();
            assert!(!message.contains("note: simulation"), "{name}: {message}");
            assert_eq!(outcome.checks.failed(), [], "{name}");
            keep_pictures(&document, out.path());
            count += 1;
        }
    }
    assert!(count > 0, "the README has an example");
}

#[test]
fn the_readme_shows_what_its_script_prints() {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md"));
    let text = text.unwrap();
    let script = blocks(&text, "rhai").remove(0);
    let shown = blocks(&text, "text").remove(0);
    let out = tempfile::tempdir().unwrap();
    let printed = Notepad::default();
    let settings = RunSettings {
        out: out.path().to_owned(),
        printed: Box::new(printed.clone()),
        ..RunSettings::silent(RunMode::Run)
    };
    run(&Program::named("README.md", &script.text), &language(), settings);
    assert_eq!(printed.take().trim_end(), shown.text.trim_end());
}

/// Pictures in a document that its blocks draw must exist. They are written on request.
fn keep_pictures(document: &Path, drawn: &Path) {
    let text = std::fs::read_to_string(document).unwrap();
    for picture in std::fs::read_dir(drawn).unwrap().map(|entry| entry.unwrap().path()) {
        let shown = format!("pictures/{}", picture.file_name().unwrap().to_string_lossy());
        if !text.contains(&format!("({shown})")) {
            continue;
        }
        let kept = document.with_file_name(&shown);
        if std::env::var_os("WITHY_UPDATE").is_some() {
            std::fs::copy(&picture, &kept).unwrap();
        }
        assert!(
            kept.is_file(),
            "{shown} is not there: WITHY_UPDATE=1 cargo test --test house documents"
        );
    }
}

/// Inputs of a session in a document, each with its output.
fn session(block: &Block) -> Vec<(String, Vec<String>)> {
    let mut inputs: Vec<(String, Vec<String>)> = Vec::new();
    for line in block.text.lines() {
        match line.strip_prefix("withy:").and_then(|rest| rest.split_once("> ")) {
            Some((_, input)) => inputs.push((input.to_owned(), Vec::new())),
            None => inputs.last_mut().unwrap().1.push(line.trim_end().to_owned()),
        }
    }
    inputs
}

/// Returns true if two words are equal, or are numbers that differ by rounding.
fn is_same(written: &str, said: &str) -> bool {
    let number = |word: &str| word.trim_matches(|c| "(),".contains(c)).parse::<f64>();
    match (number(written), number(said)) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 1e-6 * a.abs() + 1e-9,
        _ => written == said,
    }
}

#[test]
fn sessions_of_the_documents_have_the_written_replies() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for document in ["docs/guide.md", "README.md"] {
        let text = std::fs::read_to_string(root.join(document)).unwrap();
        let is_session = |block: &Block| block.text.starts_with("withy:");
        for block in blocks(&text, "text").iter().filter(|block| is_session(block)) {
            let inputs = session(block);
            let piped: String =
                inputs.iter().map(|(input, _)| format!("{input}\nprint(\"§\");\n")).collect();
            let folder = tempfile::tempdir().unwrap();
            let said = said_by_a_session(folder.path(), &piped);
            for ((input, written), said) in inputs.iter().zip(said.split("§\n")) {
                // `:plot` and `:show` draw pictures at a terminal, but print a line into a pipe.
                if input.starts_with(":plot") || input.starts_with(":show") {
                    continue;
                }
                let place = format!("{document}:{}: {input}: {said}", block.line);
                let said: Vec<&str> = said.split_whitespace().collect();
                let written: Vec<&str> =
                    written.iter().flat_map(|line| line.split_whitespace()).collect();
                assert_eq!(written.len(), said.len(), "{place}");
                assert!(written.iter().zip(&said).all(|(a, b)| is_same(a, b)), "{place}");
                count += 1;
            }
        }
    }
    assert!(count > 10);
}

fn said_by_a_session(folder: &Path, piped: &str) -> String {
    let mut child = Command::new(env!("CARGO_BIN_EXE_withy"))
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(piped.as_bytes()).unwrap();
    String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap()
}

#[test]
fn the_language_reference_is_up_to_date() {
    let pages = withy::script::help::reference::pages(&language());
    for page in &pages {
        expect_written(&format!("docs/{}", page.file), &page.text);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/language");
    for file in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()) {
        let file = format!("language/{}", file.to_string_lossy());
        assert!(
            pages.iter().any(|page| page.file == file),
            "docs/{file} is not generated any more"
        );
    }
}

#[test]
fn the_pages_of_the_library_are_up_to_date() {
    expect_written("docs/standard_library.md", &withy::script::library::document());
}

/// Compares a generated document with the file, or writes the file on request.
fn expect_written(document: &str, current: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    if std::env::var_os("WITHY_UPDATE").is_some() {
        std::fs::write(&path, current).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == current,
        "{document} is old: run WITHY_UPDATE=1 cargo test --test house documents"
    );
}
