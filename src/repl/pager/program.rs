//! The pager of the environment.

use std::io::{self, Write};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, thread};

use crate::repl::editor::typed_ahead::TypedAhead;

/// So often it is looked whether it has ended.
const WATCHFUL: Duration = Duration::from_millis(10);

/// What less is told unless somebody has: to end where all fits, to show colours, to leave what was shown.
const LESS: (&str, &str) = ("LESS", "FRX");

/// Lets a pager program show a text, and waits for its end. Ctrl-C is for that program.
///
/// # Errors
/// When the program does not start.
pub fn show(program: &str, text: &str, was_interrupted: &dyn Fn() -> bool) -> io::Result<()> {
    let mut words = program.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or_default());
    command.args(words).stdin(Stdio::piped());
    if env::var_os(LESS.0).is_none() {
        command.env(LESS.0, LESS.1);
    }
    let lent = TypedAhead::lend();
    let mut child = command.spawn()?;
    if let Some(mut input) = child.stdin.take() {
        let text = format!("{text}\n");
        // Who leaves early does not read to the end.
        thread::spawn(move || input.write_all(text.as_bytes()));
    }
    while child.try_wait()?.is_none() {
        was_interrupted();
        thread::sleep(WATCHFUL);
    }
    drop(lent);
    Ok(())
}
