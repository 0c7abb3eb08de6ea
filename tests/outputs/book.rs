//! Named outputs, compared with recorded ones: texts with readable snapshots, other files with checksums.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::fingerprint::fingerprint;

#[derive(Default)]
pub struct Book(BTreeMap<String, Vec<u8>>);

const PINNED: &str = "tests/outputs/pinned.txt";

/// Longest text that is recorded as a snapshot [bytes].
const LONGEST: usize = 20_000;

/// Prefixes of the names of generated pages, whose texts are in `docs/language`.
const GENERATED: [&str; 2] = ["pages/help", "pages/definitions"];

/// Extensions of text files with data or pictures.
const DATA: [&str; 6] = [".svg", ".csv", ".vtu", ".pvd", ".html", ".json"];

impl Book {
    pub fn keep(&mut self, name: impl Into<String>, output: impl Into<Vec<u8>>) {
        let name = name.into();
        assert!(self.0.insert(name.clone(), output.into()).is_none(), "'{name}' is kept twice");
    }

    /// Records every file below a folder, except withy's own records of written files.
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

    /// Records only the names of the files of a folder.
    pub fn keep_file_names(&mut self, name: &str, folder: &Path) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        self.keep(name, format!("{names:?}"));
    }

    /// Returns the text of an output that is recorded as a snapshot.
    fn snapshot<'o>(name: &str, output: &'o [u8]) -> Option<&'o str> {
        let is_short = (1..LONGEST).contains(&output.len());
        let is_data = DATA.iter().any(|ending| name.ends_with(ending))
            || GENERATED.iter().any(|start| name.starts_with(start));
        if is_short && !is_data { std::str::from_utf8(output).ok() } else { None }
    }

    /// Compares all texts with the snapshots, one file for each group of names.
    fn compare_texts(&self) {
        let mut groups: BTreeMap<String, String> = BTreeMap::new();
        for (name, output) in &self.0 {
            let Some(text) = Self::snapshot(name, output) else { continue };
            let group = name.split('/').take(2).collect::<Vec<_>>().join("-");
            let group: String = group
                .chars()
                .map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' })
                .collect();
            let _ = writeln!(groups.entry(group).or_default(), "──── {name}\n{text}");
        }
        let mut settings = insta::Settings::clone_current();
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| {
            for (group, text) in groups {
                insta::assert_snapshot!(group, text);
            }
        });
    }

    pub fn compare(&self) {
        if let Ok(folder) = std::env::var("WITHY_OUTPUTS") {
            self.write_to(Path::new(&folder));
        }
        self.compare_texts();
        let files = self.0.iter().filter(|(name, output)| Self::snapshot(name, output).is_none());
        let found: BTreeMap<_, _> = files
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
            "{} of {} files differ from the recorded ones; WITHY_OUTPUTS=FOLDER writes them, WITHY_UPDATE=1 records them:\n{other:#?}",
            other.len(),
            found.len()
        );
    }

    /// Writes one file for each output. Characters that file names do not allow are replaced by `~`.
    fn write_to(&self, folder: &Path) {
        fs::create_dir_all(folder).unwrap();
        for (name, output) in &self.0 {
            let allowed = |c: char| c.is_alphanumeric() || ",.-_ ".contains(c);
            let file: String = name.chars().map(|c| if allowed(c) { c } else { '~' }).collect();
            fs::write(folder.join(file), output).unwrap();
        }
    }
}
