//! External pager program.

use std::io::{self, Write};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, thread};

use crate::repl::terminal::typed_ahead::TypedAhead;

const POLLING_INTERVAL: Duration = Duration::from_millis(10);

/// Environment variable of the pager less, and options to quit after a short text (F), show colours (R) and leave the text (X).
const LESS: (&str, &str) = ("LESS", "FRX");

/// Shows a text with a pager program, which handles Ctrl-C itself, and waits until the program ends.
pub fn show(program: &str, text: &str, was_interrupted: &dyn Fn() -> bool) -> io::Result<()> {
    let mut words = program.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or_default());
    command.args(words).stdin(Stdio::piped());
    if env::var_os(LESS.0).is_none() {
        command.env(LESS.0, LESS.1);
    }
    let lent = TypedAhead::restore_for_program();
    let mut child = command.spawn()?;
    if let Some(mut input) = child.stdin.take() {
        let text = format!("{text}\n");
        // A write error is ignored, because the pager may quit before it has read the whole text.
        thread::spawn(move || input.write_all(text.as_bytes()));
    }
    while child.try_wait()?.is_none() {
        was_interrupted();
        thread::sleep(POLLING_INTERVAL);
    }
    drop(lent);
    Ok(())
}
