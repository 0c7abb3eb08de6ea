//! `withy run --watch`: runs a script again whenever one of its files has changed.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use super::Exit;
use super::console::print_error;
use crate::script::state::files_read::FilesRead;

const INTERVAL: Duration = Duration::from_millis(200);

/// Calls `run` again after each change of the script or of a file that the run has read, until Ctrl-C.
/// Returns the exit code of the last run if Ctrl-C interrupted it, otherwise success.
pub fn watch(file: &Path, interrupt: &AtomicBool, run: impl Fn(FilesRead) -> Exit) -> Exit {
    let mut changed = String::new();
    for number in 1.. {
        print_error(&format!("--- run {number} of {}{changed} ---\n", file.display()));
        let read = FilesRead::default();
        read.record(file.to_owned());
        let exit = run(read.clone());
        if interrupt.load(Ordering::Relaxed) {
            return exit;
        }
        print_error("waiting for a changed file; Ctrl-C ends\n");
        match wait(&read, interrupt) {
            Some(path) => changed = format!(": {path} has changed"),
            None => break,
        }
    }
    Exit::Success
}

/// Waits until a file has changed, and returns its path; `None` after Ctrl-C.
fn wait(read: &FilesRead, interrupt: &AtomicBool) -> Option<String> {
    let mut seen = false;
    while !interrupt.load(Ordering::Relaxed) {
        match read.changed() {
            Some(path) if seen => {
                return Some(path.strip_prefix(".").unwrap_or(&path).display().to_string());
            }
            changed => seen = changed.is_some(),
        }
        thread::sleep(INTERVAL);
    }
    None
}
