//! The command line: definitions, running, sessions, and the progress bar. What it does is done by `script` and `repl`.

mod args;
mod attempt_process;
mod bar;
mod docs;
mod grade;
mod interrupt;
mod learn;
mod learn_options;
mod limits;
mod run;
mod say;
mod session;
mod view;
mod view_options;
mod watching;

use std::io::{ErrorKind, Write, stdout};
use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};

/// The exit codes, the same for all commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// All is well; also when the reader of the output went away.
    Good = 0,
    /// A `check` in the script failed.
    CheckFailed = 1,
    /// The script or the arguments are wrong.
    Wrong = 2,
    /// Stopped by Ctrl-C.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Reads the command line and does what it says.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => return answered(&answer).into(),
    };
    let exit = match arguments.command {
        Some(Command::Run(options)) => run::run(&options),
        Some(Command::Study(options)) => run::study(&options),
        Some(Command::Check(options)) => run::check(&options),
        Some(Command::View(options)) => view::view(&options),
        Some(Command::Repl(options)) => session::open(&options),
        Some(Command::Docs(options)) => docs::docs(&options),
        Some(Command::Learn(options)) => learn::learn(&options),
        None => session::start(arguments.session),
    };
    match exit {
        Exit::Good if say::is_output_lost() => Exit::Wrong.into(),
        exit => exit.into(),
    }
}

/// Prints what the command line itself asks for, such as its help, or what is wrong with it.
fn answered(answer: &clap::Error) -> Exit {
    let printed = answer.print().and_then(|()| stdout().flush());
    let is_lost = printed.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe);
    if is_lost || answer.exit_code() != 0 { Exit::Wrong } else { Exit::Good }
}
