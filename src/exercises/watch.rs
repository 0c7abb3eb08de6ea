//! Which attempts were saved since one looked last.
//!
//! Files are read and compared: a few kilobytes a few times a second. That works on every file system and with every
//! editor, also with those that put a new file in the place of the old one, and a file that was saved unchanged is not
//! judged again.

use std::time::Duration;

use super::attempt::LARGEST;
use super::catalogue::EXERCISES;
use super::exercise::Exercise;
use super::workbook::Workbook;
use crate::sandbox_fs::read_file;

/// How long to wait between two looks at the attempts.
pub const INTERVAL: Duration = Duration::from_millis(200);

/// The attempts of a student as they were when one looked last.
pub struct Watcher<'a> {
    workbook: &'a Workbook,
    seen: Vec<Seen>,
}

/// What stood in a file.
struct Seen {
    content: Option<Vec<u8>>,
    /// Whether it was found empty or away since: some editors empty or move a file before they write it.
    is_away: bool,
}

impl<'a> Watcher<'a> {
    /// Looks at the attempts of a workbook for the first time.
    pub fn new(workbook: &'a Workbook) -> Self {
        let look = |exercise| Seen { content: content(workbook, exercise), is_away: false };
        Self { workbook, seen: EXERCISES.iter().map(look).collect() }
    }

    /// The first exercise, in the order of the table, whose file has another content than before. A file that is
    /// empty or not there for the first time, as between the two halves of saving, has not changed.
    pub fn changed(&mut self) -> Option<&'static Exercise> {
        EXERCISES.iter().zip(&mut self.seen).find_map(|(exercise, seen)| {
            let now = content(self.workbook, exercise);
            let is_away = now.as_ref().is_none_or(Vec::is_empty);
            let was_away = std::mem::replace(&mut seen.is_away, is_away);
            let is_half_saved = is_away && !was_away;
            if is_half_saved || seen.content == now {
                return None;
            }
            seen.content = now;
            Some(exercise)
        })
    }
}

/// What stands in a file; nothing where it cannot be read: the run that this starts tells why.
fn content(workbook: &Workbook, exercise: &Exercise) -> Option<Vec<u8>> {
    read_file(&workbook.file(exercise), LARGEST).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn each_change_is_seen_once_and_a_file_that_is_away_for_a_moment_is_none() {
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
    fn a_file_that_is_empty_for_a_moment_is_being_saved() {
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
