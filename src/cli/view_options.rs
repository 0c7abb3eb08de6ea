//! Definitions of `withy view` on the command line, and nothing else.

use std::path::PathBuf;

use clap::Args;

use super::limits::LimitOptions;

/// Options of `withy view`.
#[derive(Args)]
pub struct ViewOptions {
    /// A simulation that sim.save wrote, or a script, a .rhai file: the simulations in its variables are shown.
    pub file: PathBuf,
    /// The page; without it, NAME.html beside a saved simulation, or in the folder for what a script writes.
    #[arg(long, short, value_name = "FILE.html")]
    pub output: Option<PathBuf>,
    /// Folder for what the script itself writes; made when the first file is written.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Write the page, and do not open it.
    #[arg(long)]
    pub no_open: bool,
    /// No progress bar and no closing lines; what the script prints and what fails is still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}
