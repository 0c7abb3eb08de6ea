//! What stops a run before its end, and in which words.

use std::io;
use std::time::Duration;

use rhai::Dynamic;

use super::numbers::format_number;

/// The bytes of a megabyte.
pub const MEGABYTE: u64 = 1_000_000;

/// What stopped a run before its end. Scripts cannot catch it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The run was stopped by Ctrl-C, or whoever else set the interrupt flag.
    Interrupt,
    /// The run was stopped, for the reader of the output went away.
    PipeClosed,
    /// The run was stopped, for it took longer than this.
    Time(Duration),
    /// The run was stopped, for its simulations wanted more steps than this.
    Steps(u64),
    /// The run was stopped, for the process occupied more memory than this [bytes].
    Memory(u64),
    /// The run was stopped, for more was to be printed and written than this [bytes].
    Written(u64),
    /// The run was stopped, for more files were to be written than this.
    Files(u64),
    /// The run was stopped, for what the script prints could not be written.
    OutputLost(io::ErrorKind),
    /// A dry build pretended to go on with simulations so often that the script must wait for something which only a real one
    /// finds.
    Waiting,
}

impl Stop {
    /// What stopped a run, from the token that the engine carries.
    pub fn of_token(token: &Dynamic) -> Self {
        token.read_lock::<Self>().map_or(Self::Interrupt, |stop| *stop)
    }

    /// What stopped the run in words, and what to do about it.
    pub fn words(self) -> (String, Option<String>) {
        match self {
            Self::Interrupt => ("the run was interrupted".into(), None),
            Self::PipeClosed => ("the reader of the output went away".into(), None),
            Self::Time(limit) => (
                format!("the run takes longer than {} s", format_number(limit.as_secs_f64())),
                Some("--max-time SECONDS allows more; is there a loop without an end?".into()),
            ),
            Self::Steps(limit) => (
                format!("the simulations of this run need more than {limit} steps"),
                Some("--max-steps N allows more".into()),
            ),
            Self::Written(limit) => (
                format!("the run prints and writes more than {} MB", limit / MEGABYTE),
                Some(
                    "--max-written MB allows more; does something print in a loop for ever?".into(),
                ),
            ),
            Self::Files(limit) => (
                format!("the run writes more than {limit} files"),
                Some("--max-files N allows more".into()),
            ),
            Self::OutputLost(kind) => (
                format!("what the script prints cannot be written: {kind}"),
                Some("see that there is room where the output goes".into()),
            ),
            Self::Waiting => (
                "the script waits for what a simulation finds: it cannot be checked further".into(),
                None,
            ),
            Self::Memory(limit) => (
                format!("the run needs more than {} MB of memory", limit / MEGABYTE),
                Some("--max-memory MB allows more; does something grow in a loop for ever?".into()),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_the_limit_and_its_flag() {
        let (message, hint) = Stop::Memory(2_000_000).words();
        assert!(message.contains("2 MB") && hint.unwrap().contains("--max-memory"));
    }
}
