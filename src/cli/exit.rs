//! What the program tells its caller when it ends.

use std::process::ExitCode;

/// The exit codes, the same for all commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Exit code: all is well; also when the reader of the output went away.
    Good = 0,
    /// Exit code: a `check` in the script failed.
    CheckFailed = 1,
    /// Exit code: the script or the arguments are wrong, or output could not be written.
    Wrong = 2,
    /// Exit code: the program was stopped by Ctrl-C.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
