//! Every `rhai` block of the README and of `docs/` runs, and its checks pass.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use withy::script::catalog::Catalog;
use withy::script::context::{Mode, Settings};
use withy::script::program::Program;
use withy::script::runner::{Ending, run};

/// A fenced block, and the line of its document that it begins at.
struct Block {
    line: usize,
    text: String,
}

/// The fenced blocks of a language.
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
            let settings = Settings { out: out.path().to_owned(), ..Settings::silent(Mode::Run) };
            let outcome = run(&Program::named(&name, &block.text), &Catalog::standard(), settings);
            assert!(matches!(outcome.ending, Ending::Finished), "{name}: {:?}", outcome.ending);
            assert_eq!(outcome.checks.failed(), [], "{name}");
            count += 1;
        }
    }
    assert!(count > 0, "the README has an example");
}

#[test]
fn the_language_reference_is_up_to_date() {
    expect_written("docs/language.md", &withy::script::reference::reference(&Catalog::standard()));
}

#[test]
fn the_pages_of_the_library_are_up_to_date() {
    expect_written("docs/standard_library.md", &withy::script::library::document());
}

/// Compares a document that is made with what is written, or writes it when asked to.
fn expect_written(document: &str, current: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    if std::env::var_os("WITHY_UPDATE").is_some() {
        std::fs::write(&path, current).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == current,
        "{document} is old: run WITHY_UPDATE=1 cargo test --test documents"
    );
}
