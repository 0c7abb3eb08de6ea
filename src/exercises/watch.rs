//! Detects that the file of an attempt was saved with changes.
//! The files are read periodically, because some file systems do not report changes.

use std::time::Duration;

use super::attempt::LARGEST;
use super::catalogue::EXERCISES;
use super::exercise::Exercise;
use super::workbook::Workbook;
use crate::sandbox_fs::read_file;

pub const INTERVAL: Duration = Duration::from_millis(200);

pub struct Watcher<'a> {
    workbook: &'a Workbook,
    files: Vec<Seen>,
}

struct Seen {
    content: Option<Vec<u8>>,
    was_missing: bool,
}

impl<'a> Watcher<'a> {
    pub fn new(workbook: &'a Workbook) -> Self {
        let look = |exercise| Seen { content: content(workbook, exercise), was_missing: false };
        Self { workbook, files: EXERCISES.iter().map(look).collect() }
    }

    /// Returns the first exercise, in the order of the catalogue, whose file has changed.
    /// A file that is empty or missing in a single check does not count as changed, because an editor may be saving it.
    pub fn changed(&mut self) -> Option<&'static Exercise> {
        EXERCISES.iter().zip(&mut self.files).find_map(|(exercise, seen)| {
            let now = content(self.workbook, exercise);
            let is_away = now.as_ref().is_none_or(Vec::is_empty);
            let was_away = std::mem::replace(&mut seen.was_missing, is_away);
            let is_half_saved = is_away && !was_away;
            if is_half_saved || seen.content == now {
                return None;
            }
            seen.content = now;
            Some(exercise)
        })
    }
}

fn content(workbook: &Workbook, exercise: &Exercise) -> Option<Vec<u8>> {
    read_file(&workbook.file(exercise), LARGEST).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn each_file_change_is_reported_once_and_short_absences_are_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let workbook = Workbook::near(folder.path());
        workbook.fill().unwrap();
        let mut watcher = Watcher::new(&workbook);
        assert_eq!(watcher.changed(), None);
        let file = workbook.file(&EXERCISES[1]);
        fs::remove_file(&file).unwrap();
        assert_eq!(watcher.changed(), None);
        fs::write(&file, "new").unwrap();
        assert_eq!(watcher.changed(), Some(&EXERCISES[1]));
        fs::write(&file, "new").unwrap();
        assert_eq!(watcher.changed(), None);
        fs::remove_file(&file).unwrap();
        assert_eq!(watcher.changed(), None);
        assert_eq!(
            watcher.changed(),
            Some(&EXERCISES[1]),
            "it stays away: what was said of it is old"
        );
        assert_eq!(watcher.changed(), None);
    }

    #[test]
    fn briefly_empty_file_is_not_reported_as_a_change() {
        let folder = tempfile::tempdir().unwrap();
        let workbook = Workbook::near(folder.path());
        workbook.fill().unwrap();
        let mut watcher = Watcher::new(&workbook);
        let file = workbook.file(&EXERCISES[1]);
        fs::write(&file, "").unwrap();
        assert_eq!(watcher.changed(), None);
        fs::write(&file, "new").unwrap();
        assert_eq!(watcher.changed(), Some(&EXERCISES[1]));
        fs::write(&file, "").unwrap();
        assert_eq!(watcher.changed(), None);
        assert_eq!(watcher.changed(), Some(&EXERCISES[1]), "it stays empty");
        assert_eq!(watcher.changed(), None);
    }
}
