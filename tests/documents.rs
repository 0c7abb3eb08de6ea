//! Every `rhai` block of the README and of `docs/` runs, and its checks pass.

use std::path::Path;

use withy::script::catalog::Catalog;
use withy::script::context::{Mode, Settings};
use withy::script::program::Program;
use withy::script::runner::{Ending, run};

/// The fenced blocks of a language, with the line they begin at.
fn blocks(text: &str, language: &str) -> Vec<(usize, String)> {
    let (mut blocks, mut current): (Vec<(usize, String)>, Option<(usize, String)>) =
        (Vec::new(), None);
    for (number, line) in text.lines().enumerate() {
        match (&mut current, line.trim_start()) {
            (None, fence) if fence.strip_prefix("```") == Some(language) => {
                current = Some((number + 2, String::new()))
            }
            (Some(_), fence) if fence.starts_with("```") => blocks.extend(current.take()),
            (Some((_, block)), _) => *block += &format!("{line}\n"),
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
        for (line, block) in blocks(&std::fs::read_to_string(&document).unwrap(), "rhai") {
            let name = format!("{}:{line}", document.display());
            let out = tempfile::tempdir().unwrap();
            let settings = Settings { out: out.path().to_owned(), ..Settings::silent(Mode::Run) };
            let outcome = run(&Program::named(&name, &block), &Catalog::standard(), settings);
            assert!(matches!(outcome.ending, Ending::Finished), "{name}: {:?}", outcome.ending);
            assert_eq!(outcome.checks.failed(), [], "{name}");
            count += 1;
        }
    }
    assert!(count > 0, "the README has an example");
}
