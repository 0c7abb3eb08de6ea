//! Writes to stdout and stderr.

use std::io::{self, ErrorKind, Write, stderr, stdout};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::output::{printable, printable_in_colours};

static LOST: AtomicBool = AtomicBool::new(false);

/// Prints a line to stdout and flushes stdout. A closed pipe is not an error.
pub(super) fn print_line(text: &str) {
    let mut out = stdout();
    let line = format!("{}\n", printable_in_colours(text));
    record_write_error(out.write_all(line.as_bytes()).and_then(|()| out.flush()));
}

pub(super) fn print_error(text: &str) {
    print_error_styled(&printable(text));
}

pub(super) fn print_error_styled(text: &str) {
    record_write_error(stderr().write_all(printable_in_colours(text).as_bytes()));
}

fn record_write_error(written: io::Result<()>) {
    if written.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe) {
        LOST.store(true, Ordering::Relaxed);
    }
}

pub(super) fn is_output_lost() -> bool {
    LOST.load(Ordering::Relaxed)
}
