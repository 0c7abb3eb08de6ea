//! Parses the arguments and calls the selected command.

use std::path::Path;
use std::process::ExitCode;

use super::commands::{check, help, run};
use super::completion::complete_at;

pub(super) const FAILURE: u8 = 2;

const USAGE: &str = "\
usage: playground run FILE              runs a script; its files are written to the current folder
       playground check FILE            prints the errors of a script as JSON, without running its simulations
       playground complete FILE OFFSET  prints completions at a byte of a script as JSON
       playground help NAME             prints the help page of a name as JSON
";

/// Parses the arguments, runs the selected command, and returns its exit code.
pub fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        ["run", file] => run(Path::new(file)),
        ["check", file] => check(Path::new(file)),
        ["complete", file, offset] if offset.parse::<usize>().is_ok() => {
            complete_at(Path::new(file), offset.parse().unwrap_or_default())
        }
        ["help", name] => help(name),
        _ => {
            eprint!("{USAGE}");
            ExitCode::from(FAILURE)
        }
    }
}
