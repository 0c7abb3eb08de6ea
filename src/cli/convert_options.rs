//! Command line arguments of `withy convert`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::limits::LimitOptions;

/// Options of `withy convert`.
#[derive(Args)]
pub struct ConvertOptions {
    /// Saved simulation (written by sim.save).
    pub file: PathBuf,
    /// Output format.
    #[arg(long, value_enum)]
    pub to: ConvertTarget,
    /// Output folder; by default that of FILE.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Hides the progress bar and the closing lines; errors are still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// Limits of the conversion.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Output format of a conversion.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ConvertTarget {
    /// Frames for ParaView: NAME.pvd and NAME/NAME_0001.vtu …; repeats the run if velocities and section forces are not stored.
    Vtk,
    /// Arrays for NumPy: NAME.npz.
    Npz,
    /// History as a table with a row of units: NAME.csv.
    Csv,
    /// Animated page: NAME.html.
    Html,
}
