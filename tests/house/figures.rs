//! Figures of the README and of docs/studies.md are reproducible: each has a command whose script exists.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;

const DOCUMENTS: [&str; 2] = ["docs/studies.md", "README.md"];

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn text(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

/// Piece of a document: a heading, the commands of a shell block, or a table with its first line.
enum Piece {
    Heading,
    Commands(Vec<String>),
    Table(usize),
}

/// Pieces of a document in order, with the lines of tables. A table is a Markdown table with numbers, or a text block.
fn pieces(document: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut fence: Option<(String, usize, Vec<String>)> = None;
    let mut last = "";
    for (number, line) in document.lines().enumerate() {
        if let Some(language) = line.strip_prefix("```") {
            match fence.take() {
                None => fence = Some((language.to_owned(), number + 1, Vec::new())),
                Some((language, _, lines)) if language == "sh" => {
                    pieces.push(Piece::Commands(lines));
                }
                Some((language, begun, _)) if language == "text" => {
                    pieces.push(Piece::Table(begun))
                }
                Some(_) => {}
            }
        } else if let Some((_, _, lines)) = &mut fence {
            lines.push(line.split(" #").next().unwrap().trim().to_owned());
        } else if line.starts_with("## ") || line.starts_with("### ") {
            pieces.push(Piece::Heading);
        } else if line.starts_with('|') && !last.starts_with('|') {
            pieces.push(Piece::Table(number + 1));
        }
        last = line;
    }
    pieces
}

/// Error of a command whose file does not exist or that this test does not know.
fn fault(command: &str) -> Option<String> {
    let words: Vec<&str> = command.split_whitespace().collect();
    let missing = |name: &str| (!path(name).is_file()).then(|| format!("{command}: no {name}"));
    match words[..] {
        ["withy", "run" | "study", script, ..] => missing(script),
        ["python3", script, ..] => missing(script),
        ["cargo", "bench", "--bench", bench, ..] => {
            let declared = text("Cargo.toml").contains(&format!("name = \"{bench}\""));
            let undeclared = || (!declared).then(|| format!("{command}: no such bench"));
            missing(&format!("benches/{bench}.rs")).or_else(undeclared)
        }
        ["cargo", "build" | "test", ..] | ["pip", "install", ..] => None,
        _ => Some(format!("{command}: not known to this test")),
    }
}

#[test]
fn each_table_of_the_studies_has_its_command_above_it() {
    let mut has_command = false;
    let (mut tables, mut wrong) = (0, Vec::new());
    for piece in pieces(&text("docs/studies.md")) {
        match piece {
            Piece::Heading => has_command = false,
            Piece::Commands(commands) => {
                has_command = commands.iter().any(|command| {
                    !command.starts_with("pip ") && !command.starts_with("cargo build")
                });
                wrong.extend(commands.iter().filter_map(|command| fault(command)));
            }
            Piece::Table(line) => {
                tables += 1;
                if !has_command {
                    wrong.push(format!("docs/studies.md:{line}: no command in this section"));
                }
            }
        }
    }
    assert!(tables > 8, "only {tables} tables were found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_the_documents_run_exist() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for document in DOCUMENTS {
        for line in text(document).lines() {
            for code in line.split('`').skip(1).step_by(2) {
                let is_file =
                    ["benches/", "scripts/", "tests/"].iter().any(|f| code.starts_with(f));
                let is_plain = !code.contains(['*', ' ', '…']) && code.contains('.');
                if is_file && is_plain && !path(code).is_file() {
                    wrong.push(format!("{document}: no {code}"));
                }
                let runs = ["withy run scripts", "withy study scripts", "cargo bench --bench"];
                if runs.iter().any(|start| code.starts_with(start)) {
                    wrong.extend(fault(code));
                    count += 1;
                }
            }
        }
    }
    assert!(count > 0, "no command was found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Measured statements of the README, each with the command that reproduces it in the same paragraph.
const MEASURED: &[(&str, &str)] = &[
    ("times faster than the best EXUDYN runs", "`python3 benches/exudyn/pairs.py`"),
    ("no conserving method gains energy", "`withy study scripts/studies/stability.rhai`"),
];

#[test]
fn figures_of_the_readme_name_their_command() {
    let readme = text("README.md");
    for (figure, command) in MEASURED {
        let paragraphs = readme.split("\n\n").flat_map(|part| part.split("\n- "));
        let words = |part: &str| part.split_whitespace().collect::<Vec<_>>().join(" ");
        let message = paragraphs.map(words).find(|part| part.contains(figure));
        assert!(
            message.is_some_and(|part| part.contains(command)),
            "README.md: {figure}: {command}"
        );
        let inside = command.trim_matches('`');
        assert_eq!(fault(inside), None);
    }
}
