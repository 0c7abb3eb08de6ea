//! Reasons for stopping a run before its end, and their messages.

use std::io;
use std::time::Duration;

use rhai::Dynamic;

use super::numbers::format_number;

/// Bytes per megabyte.
pub const MEGABYTE: u64 = 1_000_000;

/// Reason for stopping a run before its end. Scripts cannot catch it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// Interrupt by Ctrl-C, or by other code that sets the interrupt flag.
    Interrupt,
    /// The reader of the output has closed the pipe.
    PipeClosed,
    /// The time limit was exceeded.
    Time(Duration),
    /// The limit of the number of steps was exceeded.
    Steps(u64),
    /// The memory limit was exceeded [bytes].
    Memory(u64),
    /// The limit of printed and written output was exceeded [bytes].
    Written(u64),
    /// The limit of the number of written files was exceeded.
    Files(u64),
    /// The output could not be written.
    OutputLost(io::ErrorKind),
    /// A script in a dry run waits for a result that only a real run computes.
    Waiting,
}

impl Stop {
    /// Reason in the token with which the engine was terminated.
    pub fn of_token(token: &Dynamic) -> Self {
        token.read_lock::<Self>().map_or(Self::Interrupt, |stop| *stop)
    }

    /// Message with a hint.
    pub fn message_and_hint(self) -> (String, Option<String>) {
        match self {
            Self::Interrupt => ("the run was interrupted".into(), None),
            Self::PipeClosed => ("the output was closed by its reader".into(), None),
            Self::Time(limit) => (
                format!("the run takes longer than {} s", format_number(limit.as_secs_f64())),
                Some("--max-time SECONDS allows more; a loop may have no end".into()),
            ),
            Self::Steps(limit) => (
                format!("the simulations of this run need more than {limit} steps"),
                Some("--max-steps N allows more".into()),
            ),
            Self::Written(limit) => (
                format!("the run prints and writes more than {} MB", limit / MEGABYTE),
                Some("--max-written MB allows more; a loop may print without end".into()),
            ),
            Self::Files(limit) => (
                format!("the run writes more than {limit} files"),
                Some("--max-files N allows more".into()),
            ),
            Self::OutputLost(kind) => (
                format!("the output of the script cannot be written: {kind}"),
                Some("check the free space of the output device".into()),
            ),
            Self::Waiting => (
                "the script needs results of a simulation: it cannot be checked further".into(),
                None,
            ),
            Self::Memory(limit) => (
                format!("the run needs more than {} MB of memory", limit / MEGABYTE),
                Some("--max-memory MB allows more; a loop may allocate without end".into()),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_the_limit_and_its_flag() {
        let (message, hint) = Stop::Memory(2_000_000).message_and_hint();
        assert!(message.contains("2 MB") && hint.unwrap().contains("--max-memory"));
    }
}
