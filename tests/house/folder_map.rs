//! The folder map of docs/architecture.md names every file of `src`, and none that is not there.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::path::Path;

use crate::layering::crates;

/// The words of all entries of the map that are about the files of a folder, by its path.
type Map = BTreeMap<String, String>;

/// The map, by folder: an entry begins at the left margin, or below its folder with two blanks; all else goes on with the one above.
fn map(document: &str) -> Map {
    let text = document.split_once("## Folder map").unwrap().1;
    let text = text.split_once("```text\n").unwrap().1.split_once("```").unwrap().0;
    let mut map = Map::new();
    let (mut layer, mut folder) = (String::new(), String::new());
    for line in text.lines() {
        let first = line.split_whitespace().next().unwrap_or_default();
        let is_folder = first.ends_with('/');
        match line.len() - line.trim_start().len() {
            0 if !line.is_empty() => {
                layer = if is_folder { first.to_owned() } else { String::new() };
                folder.clone_from(&layer);
            }
            2 => folder = if is_folder { format!("{layer}{first}") } else { layer.clone() },
            _ => {}
        }
        let words = map.entry(folder.clone()).or_default();
        words.push_str(line);
        words.push('\n');
    }
    map
}

/// The names of files in the words of a folder, each as often as it is written; paths that begin elsewhere are left out.
fn named(words: &str) -> Vec<&str> {
    let paths = words.split(|c: char| !(c.is_alphanumeric() || "_./*".contains(c)));
    let paths = paths.map(|path| path.trim_end_matches('.')).filter(|path| path.ends_with(".rs"));
    paths.filter(|path| !path.starts_with("tests/")).collect()
}

/// The files below a folder, as paths that begin with `from`.
fn files(folder: &Path, from: &str, all: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{from}{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            files(&path, &format!("{name}/"), all);
        } else if name.ends_with(".rs") {
            all.push(name);
        }
    }
}

/// The folder of the map that a file belongs to: the deepest one that it is in.
fn home<'m>(map: &'m Map, file: &str) -> &'m str {
    map.keys().filter(|folder| file.starts_with(folder.as_str())).max_by_key(|f| f.len()).unwrap()
}

#[test]
fn the_folder_map_names_every_file_and_no_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let map = map(&std::fs::read_to_string(root.join("docs/architecture.md")).unwrap());
    let mut all = Vec::new();
    let [mechanics, others] = crates();
    files(&others, "", &mut all);
    all.retain(|file| !file.starts_with("mechanics/"));
    files(&mechanics, "", &mut all);
    all.sort();
    let mut wrong = Vec::new();
    for (folder, words) in &map {
        let own: Vec<_> = all.iter().filter(|file| home(&map, file) == folder).collect();
        let names = named(words);
        let is_named = |file: &str, name: &str| file == name || file.ends_with(&format!("/{name}"));
        for file in &own {
            let name = file.rsplit('/').next().unwrap();
            let namesakes = own.iter().filter(|other| is_named(other, name)).count();
            let written = names.iter().filter(|written| is_named(written, name)).count();
            let is_own = name != "mod.rs" && name != "tests.rs";
            if is_own && written != namesakes {
                wrong.push(format!("{file} is missing"));
            }
        }
        for name in names {
            if !own.iter().any(|file| is_named(file, name)) {
                wrong.push(format!("{folder} has no {name}"));
            }
        }
    }
    assert!(wrong.is_empty(), "docs/architecture.md, folder map:\n{}", wrong.join("\n"));
}
