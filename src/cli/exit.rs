//! Exit codes of the program.

use std::process::ExitCode;

/// Exit codes of all commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// The command succeeded, or the reader of its output closed the pipe.
    Success = 0,
    /// A call of `check` in the script failed, an exercise is not passed, or a client ended the language server without the request `shutdown`.
    CheckFailed = 1,
    /// The script or the arguments contain an error, or output could not be written.
    Failure = 2,
    /// The command was interrupted by Ctrl-C.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
