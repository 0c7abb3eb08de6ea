//! Links between the documents, and their tables of contents.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

/// Documents with a table of contents: a list of links to every section.
const WITH_CONTENTS: [&str; 3] = ["docs/cookbook.md", "docs/guide.md", "docs/theory.md"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn documents() -> Vec<PathBuf> {
    let docs = ["docs", "docs/language"].into_iter().flat_map(|folder| {
        std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path())
    });
    docs.chain(["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root().join(name)))
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect()
}

/// Lines outside of fenced blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut is_fenced = false;
    let outside = text.lines().filter(|line| {
        let is_fence = line.trim_start().starts_with("```");
        is_fenced ^= is_fence;
        !is_fenced && !is_fence
    });
    outside.collect()
}

/// Anchor of a heading, as forges generate it.
fn anchor(heading: &str) -> String {
    let kept = heading.to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

fn headings(text: &str) -> Vec<String> {
    let lines = prose(text).into_iter().filter(|line| line.starts_with('#'));
    lines.map(|line| line.trim_start_matches('#').trim().to_owned()).collect()
}

fn links(text: &str) -> Vec<String> {
    let prose = prose(text).join("\n");
    let targets = prose.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    targets.map(|(target, _)| target.to_owned()).collect()
}

fn missing(document: &Path, link: &str) -> bool {
    let (path, section) = link.split_once('#').unwrap_or((link, ""));
    let target = match path {
        "" => document.to_owned(),
        path => document.with_file_name(path),
    };
    if !target.exists() {
        return true;
    }
    if section.is_empty() || target.extension().is_none_or(|extension| extension != "md") {
        return false;
    }
    let text = std::fs::read_to_string(&target).unwrap();
    let has_heading = headings(&text).iter().any(|heading| anchor(heading) == section);
    !has_heading && !text.contains(&format!("id=\"{section}\""))
}

#[test]
fn links_of_the_documents_have_targets() {
    let mut count = 0;
    let mut wrong = Vec::new();
    for document in documents() {
        for link in links(&std::fs::read_to_string(&document).unwrap()) {
            if !link.starts_with("http") {
                count += 1;
                if missing(&document, &link) {
                    wrong.push(format!("{}: {link}", document.display()));
                }
            }
        }
    }
    assert!(count > 200, "only {count} links were found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Replaces the table of contents, the first list of links to sections of the same document.
fn with_contents(text: &str) -> String {
    let is_entry = |line: &&str| {
        line.trim_start_matches(|c: char| "-. ".contains(c) || c.is_numeric()).starts_with("[")
            && line.contains("](#")
    };
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(is_entry).expect("a table of contents");
    let behind = lines[first..].iter().position(|line| !is_entry(line)).unwrap() + first;
    let sections = prose(text).into_iter().filter_map(|line| line.strip_prefix("## "));
    let entries = sections.map(|section| {
        let (number, name) = match section.split_once(' ') {
            Some((number, name)) if number.parse::<u32>().is_ok() => (format!("{number}."), name),
            _ => ("-".to_owned(), section),
        };
        format!("{number} [{name}](#{})", anchor(section))
    });
    let before = lines[..first].iter().map(|line| (*line).to_owned());
    let after = lines[behind..].iter().map(|line| (*line).to_owned());
    before.chain(entries).chain(after).collect::<Vec<_>>().join("\n") + "\n"
}

#[test]
fn tables_of_contents_list_every_section() {
    for document in WITH_CONTENTS.map(|name| root().join(name)) {
        let text = std::fs::read_to_string(&document).unwrap();
        let current = with_contents(&text);
        if std::env::var_os("WITHY_UPDATE").is_some() {
            std::fs::write(&document, &current).unwrap();
        }
        let is_current = std::fs::read_to_string(&document).unwrap() == current;
        assert!(
            is_current,
            "{}: run WITHY_UPDATE=1 cargo test --test house links",
            document.display()
        );
    }
}
