//! Command line arguments of `withy view`.

use std::path::PathBuf;

use clap::Args;

use super::input_options::InputOptions;
use super::limits::LimitOptions;

/// Options of `withy view`.
#[derive(Args)]
pub struct ViewOptions {
    /// Saved simulation (written by sim.save), or a script. All variables of the script that contain simulations are shown.
    pub file: PathBuf,
    /// Page; by default NAME.html beside a saved simulation, or in the output folder of a script.
    #[arg(long, short, value_name = "FILE.html")]
    pub output: Option<PathBuf>,
    /// Output folder of the script; created with the first file.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Writes the page without opening it.
    #[arg(long)]
    pub no_open: bool,
    /// Hides the progress bar and the closing lines; printed text and errors are still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// Inputs of the script.
    #[command(flatten)]
    pub inputs: InputOptions,
    /// Limits of the script.
    #[command(flatten)]
    pub limits: LimitOptions,
}
