//! Outputs of the binary: scripts, short studies, sessions, exercises and marks.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::book::Book;
use crate::language::{measures_times, texts};
use crate::times;

pub fn record(book: &mut Book) {
    scripts(book);
    studies(book);
    sessions(book);
    marks(book);
}

fn withy(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder).env("TERM", "dumb").env("LANG", "C.UTF-8").env_remove("COLUMNS");
    command
}

/// Output of the program, with placeholders for paths that differ between runs.
fn said(output: &Output, folder: &Path) -> String {
    let all = format!(
        "{}\n--- and told\n{}\n--- exit code {:?}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
        output.status.code()
    );
    let root = env!("CARGO_MANIFEST_DIR");
    all.replace(&*folder.to_string_lossy(), "FOLDER").replace(root, "PROJECT")
}

fn scripts(book: &mut Book) {
    for (name, _) in texts("scripts", "rhai") {
        let file = project(&format!("scripts/{name}.rhai"));
        let folder = tempfile::tempdir().unwrap();
        let arguments = ["run", "--quiet", "--out", "out", "--report", "report.json"];
        let output = withy(folder.path()).args(arguments).arg(&file).output().unwrap();
        book.keep(format!("scripts/{name}"), said(&output, folder.path()));
        book.keep_files(&format!("scripts/{name}, files"), &folder.path().join("out"));
        let report = fs::read_to_string(folder.path().join("report.json")).unwrap();
        book.keep(format!("scripts/{name}, report"), times::without_times(&report));
        let output = withy(folder.path()).arg("check").arg(&file).output().unwrap();
        book.keep(format!("scripts/{name}, check"), said(&output, folder.path()));
    }
}

/// Shortened studies.
fn studies(book: &mut Book) {
    for (name, text) in texts("tests/outputs/studies", "rhai") {
        let file = project(&format!("tests/outputs/studies/{name}.rhai"));
        let folder = tempfile::tempdir().unwrap();
        let arguments = ["study", "--quiet", "--out", "out"];
        let output = withy(folder.path()).args(arguments).arg(&file).output().unwrap();
        let all = said(&output, folder.path());
        let (label, files) = (format!("studies/{name}, files"), folder.path().join("out"));
        if measures_times(&text) {
            book.keep(format!("studies/{name}"), times::without_numbers(&all));
            book.keep_file_names(&label, &files);
        } else {
            book.keep(format!("studies/{name}"), all);
            book.keep_files(&label, &files);
        }
    }
}

/// Sessions with inputs from a pipe. An error ends a session, and `---` begins the next one.
fn sessions(book: &mut Book) {
    for (name, text) in texts("tests/outputs/sessions", "txt") {
        for (number, inputs) in text.split("---\n").enumerate() {
            session(book, &format!("sessions/{name}/{number}"), inputs);
        }
    }
}

fn session(book: &mut Book, name: &str, inputs: &str) {
    let folder = tempfile::tempdir().unwrap();
    let mut command = withy(folder.path());
    command.arg("repl").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(inputs.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    book.keep(name, times::without_times(&said(&output, folder.path())));
    book.keep_files(&format!("{name}, files"), folder.path());
}

/// Class of two students: one submits the solutions of the exercises, the other typical mistakes.
fn marks(book: &mut Book) {
    let folder = tempfile::tempdir().unwrap();
    for (student, from) in [("right", "scripts/exercises/solutions"), ("wrong", "tests/attempts")] {
        copy(&project(from), &folder.path().join("class").join(student));
    }
    let output = withy(folder.path()).args(["learn", "grade", "--json", "class"]).output().unwrap();
    book.keep("marks", times::without_times(&said(&output, folder.path())));
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        match path.is_dir() {
            true => copy(&path, &to),
            false => _ = fs::copy(path, to).unwrap(),
        }
    }
}

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
