//! Definitions of the command line, and nothing else.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

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
    /// Show help on a name, the whole reference, or write definition files for editors.
    Docs(DocsOptions),
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
}

/// Options of `withy check`.
#[derive(Args)]
pub struct CheckOptions {
    /// The script, a .rhai file.
    pub file: PathBuf,
}

/// Options of `withy docs`.
#[derive(Args)]
pub struct DocsOptions {
    /// A function, type, option, constant or part of the language, such as section or simulation.run_to; without it, an overview.
    #[arg(conflicts_with_all = ["markdown", "definitions"])]
    pub name: Option<String>,
    /// Print the whole reference as Markdown.
    #[arg(long, conflicts_with = "definitions")]
    pub markdown: bool,
    /// Write definition files (.d.rhai) for the Rhai language server into this folder.
    #[arg(long, value_name = "DIR")]
    pub definitions: Option<PathBuf>,
}

const EXIT_CODES: &str = "Exit codes: 0 all is well, 1 a check in the script failed, 2 the script or an argument is wrong, \
                          130 stopped by Ctrl-C.";
