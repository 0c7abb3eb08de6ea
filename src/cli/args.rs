//! Definitions of the command line, and nothing else.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::limits::LimitOptions;

/// Planar dynamics of flexible beams, scripted.
#[derive(Parser)]
#[command(version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What withy can do.
#[derive(Subcommand)]
pub enum Command {
    /// Run a script: simulate, check, draw.
    #[command(after_help = EXIT_CODES)]
    Run(RunOptions),
    /// Parse a script and build its scenes without running, printing or writing anything.
    #[command(after_help = EXIT_CODES)]
    Check(CheckOptions),
}

/// Options of `withy run`.
#[derive(Args)]
pub struct RunOptions {
    /// The script, a .rhai file.
    pub file: PathBuf,
    /// Folder for pictures and tables; made when the first one is written.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Write what each simulation says about itself to this JSON file, whole or not at all, also after a failure.
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// No progress bar and no closing lines; what the script prints and what fails is still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy check`.
#[derive(Args)]
pub struct CheckOptions {
    /// The script, a .rhai file.
    pub file: PathBuf,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

const EXIT_CODES: &str = "Exit codes: 0 all is well, 1 a check in the script failed, 2 the script or an argument is wrong, \
                          130 stopped by Ctrl-C.";
