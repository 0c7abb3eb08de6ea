//! Command line arguments of `withy learn`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::limits::LimitOptions;

/// Options of `withy learn`.
#[derive(Args)]
#[command(after_help = EXIT_CODES)]
pub struct LearnOptions {
    /// Action; without it, shows the progress and the next exercise.
    #[command(subcommand)]
    pub action: Option<LearnAction>,
}

/// Actions of `withy learn`.
#[derive(Subcommand)]
pub enum LearnAction {
    /// Lists all exercises, and marks those that are passed.
    List,
    /// Shows the first exercise that is not passed.
    Next,
    /// Judges one attempt or all; each may take 20 seconds unless --max-time is given.
    Check {
        /// Exercise; without it, all are judged and the passed ones are counted.
        name: Option<String>,
        /// Shows the result of each exercise.
        #[arg(long, conflicts_with = "name")]
        all: bool,
        /// Limits of an attempt.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Gives a hint, one more each time.
    Hint {
        /// Exercise; without it, the next one.
        name: Option<String>,
    },
    /// Shows the model solution of a passed exercise.
    Solution {
        /// Exercise.
        name: String,
    },
    /// Resets an exercise; the old attempt is kept beside it.
    Reset {
        /// Exercise.
        name: String,
    },
    /// Shows task, result and hints on one screen, and judges an attempt each time it is saved.
    ///
    /// Keys: h hint, l list of all exercises, r run again, n next, p previous, s a solution after passing, arrows and PageUp
    /// and PageDown scroll, q quit. Without a terminal it writes lines.
    #[command(verbatim_doc_comment)]
    Watch {
        /// Limits of an attempt.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judges the attempts of a class: a folder with a folder for each student.
    Grade {
        /// Folder of the class, or of one student.
        folder: PathBuf,
        /// Prints JSON with the errors of each attempt.
        #[arg(long)]
        json: bool,
        /// Appends each mark as a line of JSON to this file; marks of unchanged attempts are reused.
        #[arg(long, value_name = "FILE")]
        marks: Option<PathBuf>,
        /// Number of attempts judged at the same time; by default the number of cores.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
        jobs: Option<u16>,
        /// Limits of each attempt.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judges an attempt in a separate process, started by `watch`.
    #[command(hide = true)]
    Try {
        /// Exercise.
        name: String,
        /// Limits of the attempt.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judges one attempt of a class in a separate process, started by `grade`.
    #[command(hide = true)]
    Attempt {
        /// Folder of the student.
        folder: PathBuf,
        /// File of the attempt.
        file: PathBuf,
        /// Exercise.
        name: String,
        /// Limits of the attempt.
        #[command(flatten)]
        limits: LimitOptions,
    },
}

const EXIT_CODES: &str = "Exit codes: 0 passed, 1 not passed, 2 error in an argument or a folder, 130 interrupted by Ctrl-C. `grade` exits with 0 for any marks, and so does `watch` after q or Ctrl-C.";
