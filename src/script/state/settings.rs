//! Settings of a run: input, output, limits, and options of studies.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::limits::{HardAbort, Limits};
use super::parts::StudyPart;
use crate::script::messages::progress::{NoProgress, Progress};
use crate::script::source::program::Program;

/// Mode of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunMode {
    /// Full execution.
    Run,
    /// Scenes are built and checked. Nothing is stepped, printed, judged or written (dry run).
    DryRun,
}

/// Settings of a run, from the command line, the prompt or a test.
pub struct RunSettings {
    /// Mode of the run.
    pub mode: RunMode,
    /// Folder for output files, created with the first file.
    pub out: PathBuf,
    /// Folder of the script, where it may read files.
    pub folder: PathBuf,
    /// Default memory for the snapshots of each simulation [bytes].
    pub snapshots: usize,
    /// Flag set from outside (Ctrl-C) to stop the run as soon as possible.
    pub interrupt: Arc<AtomicBool>,
    /// Resource limits.
    pub limits: Limits,
    /// Writer for `print`.
    pub printed: Box<dyn Write + Send>,
    /// Writer for failed checks and `debug`.
    pub diagnostics: Box<dyn Write + Send>,
    /// Progress display.
    pub progress: Box<dyn Progress + Send>,
    /// Options of the studies.
    pub studies: StudyPreferences,
    /// Estimation of errors at the end of the run.
    pub errors: ErrorEstimation,
    /// Action that ends the whole program when a limit is exceeded and the run does not react.
    pub last_resort: Option<HardAbort>,
    /// Script of the run, which the engines of other threads also compile; `None` at the prompt.
    pub program: Option<Program>,
    /// Reason why the run must not write files; `None` if it may.
    pub refuses_files: Option<&'static str>,
}

/// Options of the studies of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyPreferences {
    /// Use of journals to resume interrupted studies.
    pub journal: JournalPreference,
    /// Number of timing repetitions, overriding the script.
    pub repeats: Option<usize>,
    /// Part of each study to be computed. No other files are written.
    pub part: Option<StudyPart>,
    /// Folders with parts that are merged instead of computing the studies.
    pub merge: Vec<PathBuf>,
}

/// Estimation of the discretisation errors of all simulations at the end of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorEstimation {
    /// No estimate.
    #[default]
    Never,
    /// No estimate, but a remark on how to request one.
    Remark,
    /// Estimate after runs of less than a second, within about the time of the run.
    Auto,
    /// Estimate after every run.
    Always,
}

/// Treatment of finished cases when a study is interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JournalPreference {
    /// Finished cases are lost.
    #[default]
    None,
    /// Finished cases are kept in the output folder and reused.
    Resume,
    /// Finished cases are kept in the output folder. Earlier cases are removed first.
    Restart,
}

impl RunSettings {
    /// Settings without any output, for dry runs and as a base for others.
    pub fn silent(mode: RunMode) -> Self {
        Self {
            mode,
            out: PathBuf::from("out"),
            folder: PathBuf::from("."),
            snapshots: 0,
            interrupt: Arc::default(),
            limits: Limits::default(),
            printed: Box::new(io::sink()),
            diagnostics: Box::new(io::sink()),
            progress: Box::new(NoProgress),
            studies: StudyPreferences::default(),
            errors: ErrorEstimation::Never,
            last_resort: None,
            program: None,
            refuses_files: None,
        }
    }
}
