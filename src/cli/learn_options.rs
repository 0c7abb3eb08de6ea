//! Definitions of `withy learn` on the command line, and nothing else.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::limits::LimitOptions;

/// Options of `withy learn`.
#[derive(Args)]
#[command(after_help = EXIT_CODES)]
pub struct LearnOptions {
    /// What to do; without it: where you are, and what comes next.
    #[command(subcommand)]
    pub action: Option<LearnAction>,
}

/// What `withy learn` can do.
#[derive(Subcommand)]
pub enum LearnAction {
    /// Show all exercises, and which are passed.
    List,
    /// Show the first exercise that is not passed.
    Next,
    /// Judge an attempt, or all of them; each may take 20 seconds unless --max-time says otherwise.
    Check {
        /// The exercise; without it, all, and how many are passed is told.
        name: Option<String>,
        /// Tell the result of each exercise.
        #[arg(long, conflicts_with = "name")]
        all: bool,
        /// What an attempt may use.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Give a hint, one more each time.
    Hint {
        /// The exercise; without it, the next one.
        name: Option<String>,
    },
    /// Show the model solution of an exercise that you have passed.
    Solution {
        /// The exercise.
        name: String,
    },
    /// Begin an exercise anew; the old attempt is kept beside it.
    Reset {
        /// The exercise.
        name: String,
    },
    /// Task, result and hints on one screen: judges an attempt each time it is saved; q leaves.
    ///
    /// Keys: h hint, l list of all exercises, r run again, n next, p previous, s a solution after passing, arrows and PageUp
    /// and PageDown scroll, q quit. Without a terminal it writes lines.
    #[command(verbatim_doc_comment)]
    Watch {
        /// What an attempt may use.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judge the attempts of a class: a folder with a folder for each student.
    Grade {
        /// The folder of the class, or of one student.
        folder: PathBuf,
        /// Print JSON, with what is off in each attempt.
        #[arg(long)]
        json: bool,
        /// Write each mark as a line of JSON behind the end of this file, too, as soon as it is known; marks of attempts that have not
        /// changed since are kept.
        #[arg(long, value_name = "FILE")]
        marks: Option<PathBuf>,
        /// Attempts judged at the same time; without it, as many as there are cores.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
        jobs: Option<u16>,
        /// What each attempt may use.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judge an attempt of one's own, in a process of its own: what `watch` starts.
    #[command(hide = true)]
    Try {
        /// The exercise.
        name: String,
        /// What the attempt may use.
        #[command(flatten)]
        limits: LimitOptions,
    },
    /// Judge one attempt of a class, in a process of its own: what `grade` starts.
    #[command(hide = true)]
    Attempt {
        /// The folder of the student.
        folder: PathBuf,
        /// The file of the attempt.
        file: PathBuf,
        /// The exercise.
        name: String,
        /// What the attempt may use.
        #[command(flatten)]
        limits: LimitOptions,
    },
}

const EXIT_CODES: &str = "Exit codes: 0 what was checked is passed, 1 it is not, 2 an argument or a folder is wrong, 130 \
                          stopped by Ctrl-C. To grade exits with 0 whatever the marks are; so do q and Ctrl-C while watching.";
