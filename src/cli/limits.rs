//! Options that set what a script may use; the same for all commands that run scripts.

use std::time::Duration;

use clap::Args;

use crate::script::limits::{DEEPEST, DEFAULT_DEPTH, DEFAULT_MEGABYTES, Limits, MEGABYTE};

/// What a script may use.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Limits")]
pub struct LimitOptions {
    /// Stop the script after this time on the clock.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    max_time: Option<Duration>,
    /// Most steps of all simulations together; failed tries count.
    #[arg(long, value_name = "N")]
    max_steps: Option<u64>,
    /// Most memory that the whole program may occupy, in megabytes.
    #[arg(long, value_name = "MB", default_value_t = DEFAULT_MEGABYTES, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    max_memory: u64,
    /// Most calls of script functions within calls.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_DEPTH as u64, value_parser = clap::value_parser!(u64).range(1..=DEEPEST as u64))]
    max_depth: u64,
}

impl LimitOptions {
    /// The same for the run.
    pub fn limits(&self) -> Limits {
        Limits {
            time: self.max_time,
            steps: self.max_steps,
            memory: Some(self.max_memory * MEGABYTE),
            depth: self.max_depth as usize,
        }
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| "a positive number of seconds is asked for".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positive_finite_times_are_taken() {
        assert_eq!(seconds("0.5"), Ok(Duration::from_millis(500)));
        for wrong in ["0", "-1", "inf", "nan", "1e400", "ten", ""] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
