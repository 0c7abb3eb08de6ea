//! Lines for the reader of the output.

use std::io::{ErrorKind, Write, stdout};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether something could not be written.
static LOST: AtomicBool = AtomicBool::new(false);

/// Prints a line, at once; one who reads no more has read enough.
pub(super) fn say(text: &str) {
    let mut out = stdout();
    let written = out.write_all(format!("{text}\n").as_bytes()).and_then(|()| out.flush());
    if written.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe) {
        LOST.store(true, Ordering::Relaxed);
    }
}

/// Whether something could not be written, though there was somebody to read it.
pub(super) fn is_output_lost() -> bool {
    LOST.load(Ordering::Relaxed)
}
