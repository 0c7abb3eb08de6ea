//! The command line: definitions, running, and the progress bar. What it does is done by `script`.

mod args;
mod bar;
mod docs;
mod interrupt;
mod run;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

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
    let arguments = Arguments::parse();
    let exit = match arguments.command {
        Some(Command::Run(options)) => run::run(&options),
        Some(Command::Check(options)) => run::check(&options),
        Some(Command::Docs(options)) => docs::docs(&options),
        None => help(),
    };
    exit.into()
}

fn help() -> Exit {
    match Arguments::command().print_long_help() {
        Ok(()) => Exit::Good,
        // Nobody reads it.
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Exit::Good,
        Err(_) => Exit::Wrong,
    }
}
