//! Options for resource limits, common to all commands that run scripts.

use std::time::Duration;

use clap::Args;

use crate::exercises::judging::DEFAULT_TIME_LIMIT;
use crate::script::messages::stop::MEGABYTE;
use crate::script::state::limits::{
    DEEPEST, DEFAULT_DEPTH, DEFAULT_FILES, DEFAULT_MEGABYTES, DEFAULT_MEGABYTES_WRITTEN, Limits,
};

/// Limits of a script.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Limits")]
pub struct LimitOptions {
    /// Largest run time of the script.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    max_time: Option<Duration>,
    /// Largest number of steps of all simulations together, including failed tries.
    #[arg(long, value_name = "N")]
    max_steps: Option<u64>,
    /// Largest memory of the whole program, in megabytes.
    #[arg(long, value_name = "MB", default_value_t = DEFAULT_MEGABYTES, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    max_memory: u64,
    /// Largest depth of nested calls of script functions.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_DEPTH as u64, value_parser = clap::value_parser!(u64).range(1..=DEEPEST as u64))]
    max_depth: u64,
    /// Largest amount of printed text and written files, in megabytes [default: 10000; 100 for a graded attempt].
    #[arg(long, value_name = "MB", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    max_written: Option<u64>,
    /// Largest number of written files [default: 100000; 100 for a graded attempt].
    #[arg(long, value_name = "N")]
    max_files: Option<u64>,
}

/// Default limit of written output for an attempt that is graded [megabytes].
const MEGABYTES_OF_AN_ATTEMPT: u64 = 100;
const FILES_OF_AN_ATTEMPT: u64 = 100;

impl LimitOptions {
    pub fn limits(&self) -> Limits {
        Limits {
            time: self.max_time,
            steps: self.max_steps,
            memory: Some(self.max_memory * MEGABYTE),
            depth: self.max_depth as usize,
            written: Some(self.max_written.unwrap_or(DEFAULT_MEGABYTES_WRITTEN) * MEGABYTE),
            files: Some(self.max_files.unwrap_or(DEFAULT_FILES)),
        }
    }

    /// Returns the limits of a graded attempt: less output by default, and always a limited run time.
    pub fn for_an_attempt(&self) -> Limits {
        Limits {
            time: self.max_time.or(Some(DEFAULT_TIME_LIMIT)),
            written: Some(self.max_written.unwrap_or(MEGABYTES_OF_AN_ATTEMPT) * MEGABYTE),
            files: Some(self.max_files.unwrap_or(FILES_OF_AN_ATTEMPT)),
            ..self.limits()
        }
    }

    /// Returns the options as command line arguments for a child process of this program.
    pub fn to_arguments(&self) -> Vec<String> {
        let time = self.max_time.map(|time| time.as_secs_f64().to_string());
        let given = [
            ("--max-time", time),
            ("--max-steps", self.max_steps.map(|steps| steps.to_string())),
            ("--max-memory", Some(self.max_memory.to_string())),
            ("--max-depth", Some(self.max_depth.to_string())),
            ("--max-written", self.max_written.map(|megabytes| megabytes.to_string())),
            ("--max-files", self.max_files.map(|files| files.to_string())),
        ];
        let given = given.into_iter().filter_map(|(name, value)| Some((name, value?)));
        given.flat_map(|(name, value)| [name.to_owned(), value]).collect()
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| "must be a positive number of seconds".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positive_finite_time_limits_are_accepted() {
        assert_eq!(seconds("0.5"), Ok(Duration::from_millis(500)));
        for wrong in ["0", "-1", "inf", "nan", "1e400", "ten", ""] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
