//! What the program tells its caller when it ends.

use std::process::ExitCode;

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
