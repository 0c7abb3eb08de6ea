//! Parses the command line and calls the selected command.

use std::io::{ErrorKind, Write, stdout};
use std::process::ExitCode;

use clap::Parser;

use super::args::{CliArguments, CliCommand};
use super::{Exit, console, convert, docs, learn, lsp, run, session, view};

/// Parses the command line, runs the selected command, and returns its exit code.
pub fn main() -> ExitCode {
    let arguments = match CliArguments::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => return print_clap_answer(&answer).into(),
    };
    let exit = match arguments.command {
        Some(CliCommand::Run(options)) => run::run(&options),
        Some(CliCommand::Study(options)) => run::study(&options),
        Some(CliCommand::Check(options)) => run::check(&options),
        Some(CliCommand::View(options)) => view::view(&options),
        Some(CliCommand::Repl(options)) => session::open(&options),
        Some(CliCommand::Convert(options)) => convert::convert(&options),
        Some(CliCommand::Docs(options)) => docs::docs(&options),
        Some(CliCommand::Learn(options)) => learn::learn(&options),
        Some(CliCommand::Lsp) => lsp::lsp(),
        None => session::start(arguments.session),
    };
    match exit {
        Exit::Success if console::is_output_lost() => Exit::Failure.into(),
        exit => exit.into(),
    }
}

fn print_clap_answer(answer: &clap::Error) -> Exit {
    let printed = answer.print().and_then(|()| stdout().flush());
    let is_lost = printed.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe);
    if is_lost || answer.exit_code() != 0 { Exit::Failure } else { Exit::Success }
}
