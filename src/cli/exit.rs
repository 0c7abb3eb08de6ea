//! Exit codes of the program.

use std::process::ExitCode;

/// Exit codes, the same for all commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Success, or the reader of the output has closed the pipe.
    Success = 0,
    /// A `check` in the script failed.
    CheckFailed = 1,
    /// The script or the arguments are wrong, or output could not be written.
    Failure = 2,
    /// Interrupted by Ctrl-C.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
