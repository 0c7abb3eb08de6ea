//! Completion of file names.

use std::fs;
use std::path::Path;

use super::candidates::{Candidate, fitting};
use crate::script::bindings::sources::FOLDER;
use crate::script::library::MODULES;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFilter {
    Any,
    Modules,
}

/// Files and folders in `folder` that match `typed`, and the start of the last path component in `typed` [bytes].
/// Hidden files match only if the last component of `typed` starts with a dot.
pub fn complete_path(typed: &str, folder: &Path, files: FileFilter) -> (usize, Vec<Candidate>) {
    let start = typed.rfind('/').map_or(0, |slash| slash + 1);
    let (parent, name) = typed.split_at(start);
    if files == FileFilter::Modules && parent == FOLDER {
        let names = MODULES.iter().filter_map(|module| module.name.strip_prefix(FOLDER));
        return (start, fitting(name, names.map(|name| Candidate::word(name, ""))));
    }
    let library = (files == FileFilter::Modules && parent.is_empty())
        .then(|| Candidate::word(FOLDER, "the standard library"));
    let entries = fs::read_dir(folder.join(parent)).into_iter().flatten().flatten();
    let candidates = entries.filter_map(|entry| {
        let known = entry.file_name().into_string().ok()?;
        if known.starts_with('.') && !name.starts_with('.') {
            return None;
        }
        match (entry.path().is_dir(), files) {
            (true, _) => Some(Candidate::word(&format!("{known}/"), "")),
            (false, FileFilter::Any) => Some(Candidate::word(&known, "")),
            (false, FileFilter::Modules) => Some(Candidate::word(known.strip_suffix(".rhai")?, "")),
        }
    });
    (start, fitting(name, library.into_iter().chain(candidates)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_completed_one_component_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("parts")).expect("a folder");
        for name in ["rods.rhai", "rods.csv", ".hidden", "parts/arch.rhai"] {
            fs::write(folder.path().join(name), "").expect("a file");
        }
        let names = |typed, files| {
            let (start, found) = complete_path(typed, folder.path(), files);
            (start, found.into_iter().map(|candidate| candidate.replacement).collect::<Vec<_>>())
        };
        assert_eq!(
            names("", FileFilter::Any),
            (0, vec!["parts/".into(), "rods.csv".into(), "rods.rhai".into()])
        );
        assert_eq!(names("ro", FileFilter::Modules), (0, vec!["rods".into()]));
        assert_eq!(names("parts/a", FileFilter::Modules), (6, vec!["arch".into()]));
        assert_eq!(names("nowhere/", FileFilter::Any), (8, vec![]));
        assert_eq!(names(".h", FileFilter::Any).1, [".hidden"]);
        assert_eq!(names("st", FileFilter::Modules), (0, vec!["std/".into()]));
        assert_eq!(names("std/se", FileFilter::Modules), (4, vec!["sections".into()]));
    }
}
