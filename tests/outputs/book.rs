//! Outputs by name, and what is pinned of them.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::fingerprint::fingerprint;

/// Outputs by name.
#[derive(Default)]
pub struct Book(BTreeMap<String, Vec<u8>>);

/// Fingerprints and names.
const PINNED: &str = "tests/outputs/pinned.txt";

impl Book {
    /// Keeps an output under a name that no other has.
    pub fn keep(&mut self, name: impl Into<String>, output: impl Into<Vec<u8>>) {
        let name = name.into();
        assert!(self.0.insert(name.clone(), output.into()).is_none(), "'{name}' is kept twice");
    }

    /// Keeps every file below a folder, but for withy's own records of what it has written there.
    pub fn keep_files(&mut self, name: &str, folder: &Path) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        for entry in entries.map(Result::unwrap) {
            let file = entry.file_name().to_string_lossy().into_owned();
            match entry.file_type().unwrap().is_dir() {
                true => self.keep_files(&format!("{name}/{file}"), &entry.path()),
                false if file.starts_with('.') => (),
                false => self.keep(format!("{name}/{file}"), fs::read(entry.path()).unwrap()),
            }
        }
    }

    /// Keeps the names of the files of a folder alone.
    pub fn keep_file_names(&mut self, name: &str, folder: &Path) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        self.keep(name, format!("{names:?}"));
    }

    /// Fails where an output is not what is pinned; pins it where that is wanted.
    pub fn compare(&self) {
        if let Ok(folder) = std::env::var("WITHY_OUTPUTS") {
            self.write_to(Path::new(&folder));
        }
        let found: BTreeMap<_, _> = self
            .0
            .iter()
            .map(|(name, output)| {
                (name.as_str(), format!("{:016x}", fingerprint(output.iter().copied())))
            })
            .collect();
        if std::env::var_os("WITHY_UPDATE").is_some() {
            let lines = found.iter().fold(String::new(), |mut lines, (name, print)| {
                let _ = writeln!(lines, "{print} {name}");
                lines
            });
            fs::write(PINNED, lines).unwrap();
        }
        let pinned = fs::read_to_string(PINNED).unwrap_or_default();
        let pinned: BTreeMap<_, _> = pinned
            .lines()
            .filter_map(|line| line.split_once(' '))
            .map(|(print, name)| (name, print.to_owned()))
            .collect();
        let names = found.keys().chain(pinned.keys());
        let mut other: Vec<_> =
            names.filter(|name| found.get(*name) != pinned.get(*name)).collect();
        other.sort_unstable();
        other.dedup();
        assert!(
            other.is_empty(),
            "{} of {} outputs are not what is pinned; WITHY_OUTPUTS=FOLDER writes them, WITHY_UPDATE=1 pins them anew:\n{other:#?}",
            other.len(),
            found.len()
        );
    }

    /// One file for each output; what may not stand in the name of a file is a `~`.
    fn write_to(&self, folder: &Path) {
        fs::create_dir_all(folder).unwrap();
        for (name, output) in &self.0 {
            let allowed = |c: char| c.is_alphanumeric() || ",.-_ ".contains(c);
            let file: String = name.chars().map(|c| if allowed(c) { c } else { '~' }).collect();
            fs::write(folder.join(file), output).unwrap();
        }
    }
}
