//! Fingerprints of all data on which the mark of an attempt depends, for the detection of outdated marks.

use super::attempt;
use super::exercise::Exercise;
use super::submissions::Submission;
use crate::analysis::Journal;
use crate::sandbox_fs::Folder;
use crate::script::source::text::Source;

pub fn fingerprint(submission: &Submission, exercise: &Exercise, limits: &[String]) -> String {
    let file = submission.attempt(exercise);
    let attempt = match file.as_deref().map(|path| attempt::load(path, &submission.folder)) {
        None => "missing".to_owned(),
        Some(Err(why)) => format!("unreadable: {}", why.message),
        Some(Ok(attempt)) => format!("text: {}", &*attempt.text),
    };
    let mut beside = Vec::new();
    if reads_files(&attempt.as_str().into())
        && let Ok(folder) = Folder::open(&submission.folder)
    {
        note_files(&folder, &mut beside, &mut 0);
    }
    let limits = limits.join(" ");
    let parts = [&attempt, exercise.start, exercise.judge, &limits].map(str::as_bytes);
    format!("{:016x}", Journal::fingerprint(&[&parts[..], &[&beside]].concat()))
}

fn reads_files(attempt: &Source) -> bool {
    let reads = |name: &str| matches!(name, "load_simulation" | "Fn") || name.starts_with("study_");
    attempt.imports().next().is_some() || attempt.names().any(reads)
}

/// Maximum number of files that a fingerprint covers.
const MOST_FILES: usize = 1000;
/// Size of a file above which only the length and the time of the last change are hashed, instead of the content [bytes].
const MOST_READ: u64 = 1 << 20;

fn note_files(folder: &Folder, noted: &mut Vec<u8>, count: &mut usize) {
    for entry in folder.entries().unwrap_or_default() {
        *count += 1;
        if *count > MOST_FILES {
            return;
        }
        let name = entry.name.as_encoded_bytes();
        noted.extend_from_slice(format!("\n{} {}: ", name.len(), entry.length).as_bytes());
        noted.extend_from_slice(name);
        if entry.is_folder {
            if let Ok(below) = folder.below(&entry.name) {
                note_files(&below, noted, count);
            }
        } else if let Ok(content) = folder.read(entry.name.as_ref(), MOST_READ) {
            noted.extend_from_slice(&content);
        } else {
            noted.extend_from_slice(format!("{:?}", entry.changed).as_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::catalogue::find;
    use super::*;

    #[test]
    fn fingerprint_changes_with_every_input_of_a_mark() {
        let home = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
        let submission = Submission { student: "ada".into(), folder: home.path().into() };
        let (kink, knots) = (find("kink").unwrap(), find("knot_vector").unwrap());
        let of = |exercise| fingerprint(&submission, exercise, &["--max-time".into(), "1".into()]);
        let missing = of(kink);
        assert_ne!(missing, of(knots));
        put("kink.rhai", "let a = 1;");
        let first = of(kink);
        put("helper.rhai", "fn f() { 1 }");
        assert!(first == of(kink) && first != missing, "it reads no other file");
        assert_ne!(first, fingerprint(&submission, kink, &[]));
        put("kink.rhai", "import \"helper\" as h;");
        let second = of(kink);
        put("helper.rhai", "fn f() { 2 }");
        assert!(second != of(kink) && second != first);
    }

    #[test]
    fn fingerprint_includes_subfolders_and_does_not_follow_links() {
        let (home, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let submission = Submission { student: "ada".into(), folder: home.path().into() };
        let kink = find("kink").unwrap();
        let of = || fingerprint(&submission, kink, &[]);
        fs::write(home.path().join("kink.rhai"), "import \"parts/helper\" as h;").unwrap();
        fs::create_dir(home.path().join("parts")).unwrap();
        let first = of();
        fs::write(home.path().join("parts/helper.rhai"), "fn f() { 1 }").unwrap();
        let second = of();
        assert_ne!(first, second, "a file below");
        fs::write(other.path().join("far.rhai"), "fn f() { 1 }").unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(other.path(), home.path().join("link")).unwrap();
            let third = of();
            assert_ne!(second, third, "the link itself");
            fs::write(other.path().join("far.rhai"), "fn f() { 22 }").unwrap();
            assert_eq!(third, of(), "what the link leads to");
        }
    }
}
