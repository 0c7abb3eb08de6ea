//! Syntax colours in editors: the grammar in the repository matches the language, and the engine of VS Code gives the colours of the prompt.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use withy::script::help::grammar::grammar;
use withy::script::packages::language;
use withy::script::presentation::highlight::{
    COMMENT, CONSTANT, FUNCTION, KEYWORD, NUMBER, TEXT, Vocabulary, highlight,
};

const GRAMMAR: &str = "docs/editors/vscode/withy.tmLanguage.json";

#[test]
fn the_grammar_of_the_repository_is_that_of_the_language() {
    let text = grammar(&language());
    if std::env::var_os("WITHY_UPDATE").is_some() {
        fs::write(GRAMMAR, &text).unwrap();
    }
    let command = Command::new(env!("CARGO_BIN_EXE_withy")).args(["docs", "--grammar"]).output();
    assert!(command.unwrap().stdout == text.as_bytes());
    let kept = fs::read_to_string(GRAMMAR).unwrap_or_default();
    assert!(kept == text, "{GRAMMAR} is old: withy docs --grammar > {GRAMMAR}");
}

fn scripts(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => scripts(&path, found),
            false if path.extension().is_some_and(|ending| ending == "rhai") => found.push(path),
            false => (),
        }
    }
}

/// Colour of each byte at the prompt.
fn colours_of_the_prompt(text: &str, vocabulary: &Vocabulary) -> Vec<&'static str> {
    let styles = [KEYWORD, NUMBER, TEXT, COMMENT, FUNCTION, CONSTANT].map(|style| style.0);
    let mut colours = Vec::with_capacity(text.len());
    let drawn = highlight(text, None, vocabulary);
    let mut colour = "0";
    for (index, piece) in drawn.split("\x1b[").enumerate() {
        let shown = match index {
            0 => piece,
            _ => {
                let (numbers, shown) = piece.split_once('m').unwrap();
                colour = styles.into_iter().find(|style| *style == numbers).unwrap_or("0");
                shown
            }
        };
        colours.extend(std::iter::repeat_n(colour, shown.len()));
    }
    assert_eq!(colours.len(), text.len());
    colours
}

/// Colour of each byte in an editor.
fn colours_of_the_editor(text: &str, pieces: &serde_json::Value) -> Vec<&'static str> {
    let mut colours = Vec::with_capacity(text.len());
    for piece in pieces.as_array().unwrap() {
        let style = match piece[1].as_str().unwrap() {
            "keyword" => KEYWORD.0,
            "number" => NUMBER.0,
            "text" => TEXT.0,
            "comment" => COMMENT.0,
            "function" => FUNCTION.0,
            "constant" => CONSTANT.0,
            _ => "0",
        };
        colours.extend(std::iter::repeat_n(style, piece[0].as_str().unwrap().len()));
    }
    assert_eq!(colours.len(), text.len());
    colours
}

/// Uses the Node packages in the folder `WITHY_TEXTMATE`.
#[test]
fn editor_grammar_gives_the_colours_of_the_prompt() {
    let Some(modules) = std::env::var_os("WITHY_TEXTMATE") else {
        eprintln!(
            "SKIPPED: WITHY_TEXTMATE names no folder with vscode-textmate and vscode-oniguruma"
        );
        return;
    };
    let mut files = Vec::new();
    for folder in ["scripts", "stdlib", "tests/suite"] {
        scripts(Path::new(folder), &mut files);
    }
    assert!(files.len() > 30);
    let output = Command::new("node")
        .arg("tests/program/textmate.mjs")
        .arg(modules)
        .arg(GRAMMAR)
        .args(&files)
        .output()
        .expect("node starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let message = String::from_utf8(output.stdout).unwrap();
    let vocabulary = Vocabulary::of_language(&language());
    let mut odd = Vec::new();
    for (file, pieces) in files.iter().zip(message.lines()) {
        let text = fs::read_to_string(file).unwrap();
        let ours = colours_of_the_prompt(&text, &vocabulary);
        let theirs = colours_of_the_editor(&text, &serde_json::from_str(pieces).unwrap());
        let mut lines = Vec::new();
        for (at, letter) in text.char_indices().filter(|(_, letter)| !letter.is_whitespace()) {
            let line = text[..at].lines().count().max(1);
            if ours[at] != theirs[at] && lines.last() != Some(&line) {
                lines.push(line);
                odd.push(format!(
                    "{}:{line} at '{letter}': {} and {}",
                    file.display(),
                    ours[at],
                    theirs[at]
                ));
            }
        }
    }
    assert!(odd.is_empty(), "{} lines differ:\n{}", odd.len(), odd.join("\n"));
}
