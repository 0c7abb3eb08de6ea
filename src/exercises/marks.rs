//! File with the marks of a class: one mark per line in JSON. Marks of unchanged attempts are reused.

use std::collections::BTreeMap;
use std::fs::{File, TryLockError};
use std::io::{self, Write};
use std::path::Path;

use serde_json::{Value, json};

use super::exercise::Exercise;
use super::grading::Mark;
use super::submissions::Submission;
use crate::sandbox_fs::Folder;

/// Maximum size of the file of marks [bytes].
const LARGEST: u64 = 1 << 30;

const HEAD: &str = "{\"student\":";

#[derive(Debug, Default)]
pub struct KnownMarks(BTreeMap<StudentExercise, KnownMark>);

type StudentExercise = (String, String);

#[derive(Debug)]
struct KnownMark {
    fingerprint: String,
    mark: Mark,
    message: String,
}

#[derive(Debug)]
pub struct MarksFile(File);

/// Opens or creates the file of marks and reads it.
pub fn open(path: &Path) -> io::Result<(KnownMarks, MarksFile)> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let (folder, name) = (Folder::open(folder)?, Path::new(path.file_name().unwrap_or_default()));
    let mut file = folder.append(name)?;
    // The file is locked before it is read, so that no mark written by another run is missed.
    file.try_lock().map_err(|refused| match refused {
        TryLockError::WouldBlock => io::Error::other("another process is writing to it"),
        TryLockError::Error(error) => error,
    })?;
    let bytes = folder.read(name, LARGEST)?;
    let text = String::from_utf8_lossy(&bytes);
    let known: Vec<_> = text.lines().filter_map(read_line).collect();
    // If a run was killed during its first write, the file consists of one incomplete line.
    let begun = text.trim();
    if known.is_empty() && !begun.starts_with(HEAD) && !HEAD.starts_with(begun) {
        return Err(io::Error::other("the file exists and is not a file of marks"));
    }
    // A killed run may have left an incomplete last line, which is removed, or a line without line break, which is completed.
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    match &bytes[whole..] {
        [] => (),
        rest if read_line(&String::from_utf8_lossy(rest)).is_some() => file.write_all(b"\n")?,
        _ => file.set_len(whole as u64)?,
    }
    Ok((KnownMarks(known.into_iter().collect()), MarksFile(file)))
}

fn read_line(line: &str) -> Option<(StudentExercise, KnownMark)> {
    let line: Value = serde_json::from_str(line).ok()?;
    let text = |key: &str| Some(line.get(key)?.as_str()?.to_owned());
    let mark = Mark::of(&text("result")?)?;
    let fingerprint = text("fingerprint").unwrap_or_default();
    let known = KnownMark { fingerprint, mark, message: text("message")? };
    Some(((text("student")?, text("exercise")?), known))
}

impl KnownMarks {
    pub fn find(
        &self,
        submission: &Submission,
        exercise: &Exercise,
        fingerprint: &str,
    ) -> Option<(Mark, String)> {
        let known = self.0.get(&(submission.student.clone(), exercise.id()))?;
        (known.fingerprint == fingerprint).then(|| (known.mark, known.message.clone()))
    }
}

impl MarksFile {
    /// Appends a mark and writes it to the disk. Without a fingerprint, the next run judges the attempt again.
    pub fn append(
        &mut self,
        submission: &Submission,
        exercise: &Exercise,
        (mark, message): (Mark, &str),
        fingerprint: Option<&str>,
    ) -> io::Result<()> {
        let line = json!({
            "student": submission.student,
            "exercise": exercise.id(),
            "result": mark.keyword(),
            "message": message,
            "fingerprint": fingerprint,
        });
        self.0.write_all(format!("{line}\n").as_bytes())?;
        self.0.sync_data()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::catalogue::find;
    use super::*;

    #[test]
    fn marks_file_is_reread_and_truncated_lines_are_ignored() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("marks.jsonl");
        let ada = Submission { student: "ada\n\"".into(), folder: home.path().into() };
        let (kink, knots) = (find("kink").unwrap(), find("knot_vector").unwrap());
        let (known, mut file) = open(&path).unwrap();
        assert_eq!(known.find(&ada, kink, "1"), None);
        file.append(&ada, kink, (Mark::WrongResult, "one"), Some("1")).unwrap();
        file.append(&ada, kink, (Mark::Passed, ""), Some("2")).unwrap();
        file.append(&ada, knots, (Mark::Error, "by us"), None).unwrap();
        assert!(open(&path).unwrap_err().to_string().contains("another process is writing"));
        drop(file);
        let whole = fs::read_to_string(&path).unwrap();
        fs::write(&path, &whole[..whole.len() - 30]).unwrap();
        for _ in 0..2 {
            let (known, mut file) = open(&path).unwrap();
            assert_eq!(known.find(&ada, kink, "1"), None, "the last one holds");
            assert_eq!(known.find(&ada, kink, "2"), Some((Mark::Passed, String::new())));
            assert!(known.find(&ada, knots, "").is_none());
            file.append(&ada, kink, (Mark::Passed, ""), Some("2")).unwrap();
        }
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.lines().count() == 4 && text.lines().all(|line| read_line(line).is_some()));
        fs::write(&path, whole.trim_end()).unwrap();
        drop(open(&path).unwrap());
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            whole,
            "only the end of the line was missing"
        );
        fs::write(&path, "\n").unwrap();
        assert!(open(&path).is_ok(), "there is nothing in it");
        fs::write(&path, &whole[..20]).unwrap();
        drop(open(&path).unwrap());
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            "",
            "the beginning of a first mark is cut off"
        );
        fs::write(&path, "my notes").unwrap();
        assert!(open(&path).unwrap_err().to_string().contains("is not a file of marks"));
        assert_eq!(fs::read_to_string(&path).unwrap(), "my notes");
    }
}
