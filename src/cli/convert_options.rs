//! Definitions of `withy convert` on the command line, and nothing else.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::limits::LimitOptions;

/// Options of `withy convert`.
#[derive(Args)]
pub struct ConvertOptions {
    /// A simulation that sim.save wrote.
    pub file: PathBuf,
    /// What it becomes.
    #[arg(long, value_enum)]
    pub to: ConvertTarget,
    /// Folder for what is written, under the name of FILE; that of FILE unless given.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// No progress bar and no closing lines; what fails is still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// What the conversion may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// What a saved simulation can become.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ConvertTarget {
    /// Frames for ParaView: NAME.pvd and NAME/NAME_0001.vtu …; runs again where velocities and section forces are forgotten.
    Vtk,
    /// Arrays for NumPy: NAME.npz.
    Npz,
    /// The history as a table, with a line of units: NAME.csv.
    Csv,
    /// A page on which the motion is played: NAME.html.
    Html,
}
