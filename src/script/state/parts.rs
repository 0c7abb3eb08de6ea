//! Parts of studies for distributed computation, and the search for their files before merging.

use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::sandbox_fs::Folder;
use crate::script::messages::error::ScriptError;

/// Part of every study of a script: every `of`-th case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct StudyPart {
    pub of: u32,
    pub number: u32,
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("write a part as 3/16: its number, from 1, and the number of parts")]
pub struct InvalidStudyPart;

impl FromStr for StudyPart {
    type Err = InvalidStudyPart;

    fn from_str(text: &str) -> Result<Self, InvalidStudyPart> {
        let (number, of) = text.split_once('/').ok_or(InvalidStudyPart)?;
        let (number, of) = (
            number.parse().map_err(|_| InvalidStudyPart)?,
            of.parse().map_err(|_| InvalidStudyPart)?,
        );
        if (1..=of).contains(&number) { Ok(Self { of, number }) } else { Err(InvalidStudyPart) }
    }
}

impl StudyPart {
    pub const WHOLE: Self = Self { of: 1, number: 1 };

    pub fn has(self, case: usize) -> bool {
        case % self.of as usize == self.number as usize - 1
    }

    pub fn file(self, study: &str) -> String {
        format!("{study}.{}-of-{}.part", self.number, self.of)
    }

    fn of_file(study: &str, file: &str) -> Option<Self> {
        let middle = file.strip_prefix(study)?.strip_prefix('.')?.strip_suffix(".part")?;
        let (number, of) = middle.split_once("-of-")?;
        format!("{number}/{of}").parse().ok()
    }
}

const MOST_LISTED: usize = 10;

pub fn find_parts(
    study: &str,
    folders: &[PathBuf],
) -> Result<Vec<(StudyPart, PathBuf)>, ScriptError> {
    let mut found: Vec<(StudyPart, PathBuf)> = Vec::new();
    for folder in folders {
        let names = file_names(&folder.join(study)).map_err(|error| {
            ScriptError::new(format!("cannot read the folder '{}': {error}", folder.display()))
                .hint("--merge takes the output folders (--out) of the parts")
        })?;
        let base = Path::new(study).file_name().unwrap_or_default().to_string_lossy().into_owned();
        for name in names {
            if let Some(part) = StudyPart::of_file(&base, &name) {
                found.push((part, folder.join(study).with_file_name(name)));
            }
        }
    }
    found.sort();
    let Some((StudyPart { of, .. }, _)) = found.first().cloned() else {
        let message = format!("the folders to be merged contain no part of the study '{study}'");
        return Err(ScriptError::new(message)
            .hint("create parts with withy study FILE --part 1/4 --out DIR, and so on"));
    };
    if let Some((other, path)) = found.iter().find(|(part, _)| part.of != of) {
        let message =
            format!("'{}' is one of {} parts, but others are of {of}", path.display(), other.of);
        return Err(ScriptError::new(message).hint("give only folders of the same number of parts"));
    }
    if let Some(pair) = found.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        let ((part, first), (_, second)) = (&pair[0], &pair[1]);
        let (number, first, second) = (part.number, first.display(), second.display());
        let message = format!(
            "part {number} of {of} of the study '{study}' exists twice: '{first}' and \
            '{second}'"
        );
        return Err(ScriptError::new(message).hint("give only one of their folders"));
    }
    match of as usize - found.len() {
        0 => Ok(found),
        missing => {
            let is_there =
                |number: u32| found.binary_search_by_key(&number, |(part, _)| part.number).is_ok();
            let first = (1..=of).filter(|number| !is_there(*number)).take(MOST_LISTED);
            let mut first: Vec<String> = first.map(|number| number.to_string()).collect();
            if missing > MOST_LISTED {
                first.push(format!("and {} more", missing - MOST_LISTED));
            }
            let message = format!(
                "of the {of} parts of the study '{study}' these are missing: {}",
                first.join(", ")
            );
            Err(ScriptError::new(message)
                .hint("create them with the same command and --part, or add their folders"))
        }
    }
}

fn file_names(path: &Path) -> io::Result<Vec<String>> {
    let folder = path.parent().filter(|above| !above.as_os_str().is_empty());
    let folder = match Folder::open(folder.unwrap_or(Path::new("."))) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        opened => opened?,
    };
    let files = folder.entries()?.into_iter().filter(|entry| !entry.is_folder);
    Ok(files.map(|entry| entry.name.to_string_lossy().into_owned()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_belongs_to_one_part() {
        let parts: Vec<StudyPart> = (1..=3).map(|number| StudyPart { of: 3, number }).collect();
        for case in 0..10 {
            assert_eq!(parts.iter().filter(|part| part.has(case)).count(), 1);
        }
        assert_eq!("3/16".parse(), Ok(StudyPart { of: 16, number: 3 }));
        for wrong in ["0/3", "4/3", "3", "a/b", "1/0", ""] {
            assert_eq!(wrong.parse::<StudyPart>(), Err(InvalidStudyPart), "{wrong}");
        }
    }

    #[test]
    fn missing_and_inconsistent_study_parts_are_reported() {
        let home = tempfile::tempdir().unwrap();
        let folder = |name: &str| home.path().join(name);
        let lay = |place: &str, number, of| {
            std::fs::create_dir_all(folder(place)).unwrap();
            std::fs::write(folder(place).join(StudyPart { of, number }.file("crane")), "").unwrap();
        };
        let merged = |places: &[&str]| {
            let folders: Vec<PathBuf> = places.iter().map(|place| folder(place)).collect();
            match find_parts("crane", &folders) {
                Ok(found) => found
                    .iter()
                    .map(|(part, _)| part.number.to_string())
                    .collect::<Vec<_>>()
                    .join(" "),
                Err(ScriptError::Failure(failure)) => failure.message,
                Err(other) => format!("{other:?}"),
            }
        };
        assert!(merged(&["a"]).contains("no part of the study 'crane'"));
        lay("a", 1, 3);
        lay("a", 3, 3);
        assert!(merged(&["a"]).ends_with("these are missing: 2"), "{}", merged(&["a"]));
        lay("b", 2, 3);
        assert_eq!(merged(&["a", "b"]), "1 2 3");
        lay("c", 3, 3);
        assert!(merged(&["a", "b", "c"]).contains("part 3 of 3 of the study 'crane' exists twice"));
        lay("e", 1, 1_000_000_000);
        let few = "these are missing: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, and 999999989 more";
        assert!(merged(&["e"]).ends_with(few), "{}", merged(&["e"]));
        lay("d", 1, 2);
        assert!(
            merged(&["a", "b", "d"]).contains("is one of 3 parts, but others are of 2"),
            "{}",
            merged(&["a", "b", "d"])
        );
    }
}
