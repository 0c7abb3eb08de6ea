//! From the command line to what it asks for.

use std::io::{ErrorKind, Write, stdout};
use std::process::ExitCode;

use clap::Parser;

use super::args::{Arguments, Command};
use super::{Exit, docs, learn, run, say, session, view};

/// Runs the program: reads the command line and does what it says.
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
