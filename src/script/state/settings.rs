//! Settings of a run.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::files_read::FilesRead;
use super::inputs::Inputs;
use super::limits::{HardAbort, Limits};
use super::parts::StudyPart;
use crate::script::messages::progress::{NoProgress, Progress};
use crate::script::source::program::Program;

/// Mode of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunMode {
    /// Full execution.
    Run,
    /// Dry run: scenes are built and checked, but no step is computed, no check of the script is evaluated, and nothing is printed or written.
    DryRun,
}

/// Settings of a run, from the command line, the prompt or a test.
pub struct RunSettings {
    /// Mode of the run.
    pub mode: RunMode,
    /// Folder for output files. It is created with the first file.
    pub out: PathBuf,
    /// Folder of the script, in which the script may read files.
    pub folder: PathBuf,
    /// Default memory for the snapshots of each simulation [bytes].
    pub snapshots: usize,
    /// Flag set from outside, for example by Ctrl-C, to stop the run.
    pub interrupt: Arc<AtomicBool>,
    /// Resource limits.
    pub limits: Limits,
    /// Writer for the output of `print`.
    pub printed: Box<dyn Write + Send>,
    /// Writer for messages to the user, failed checks and `debug`.
    pub diagnostics: Box<dyn Write + Send>,
    /// Progress display.
    pub progress: Box<dyn Progress + Send>,
    /// Inputs of the script, with the values given from outside.
    pub inputs: Inputs,
    /// Record of the files that the script reads.
    pub files_read: FilesRead,
    /// Options of the studies.
    pub studies: StudyPreferences,
    /// Estimation of errors at the end of the run.
    pub errors: ErrorEstimation,
    /// Action that ends the whole program if the run does not react to an exceeded limit.
    pub last_resort: Option<HardAbort>,
    /// Script of the run; `None` at the prompt. The engines of other threads also compile it.
    pub program: Option<Program>,
    /// Reason why the run must not write files; `None` if writing is allowed.
    pub refuses_files: Option<&'static str>,
}

/// Options of the studies of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyPreferences {
    /// Use of journals to resume interrupted studies.
    pub journal: JournalPreference,
    /// Number of repetitions for the measurement of run times; `None` for the number in the script.
    pub repeats: Option<usize>,
    /// Computed part of each study; `None` for the whole study. No files other than parts are written.
    pub part: Option<StudyPart>,
    /// Folders with parts of the studies, which are merged without computing; empty for a normal run.
    pub merge: Vec<PathBuf>,
}

/// Estimation of the discretisation errors of all simulations at the end of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorEstimation {
    /// Errors are not estimated.
    #[default]
    Never,
    /// Errors are not estimated, but a remark explains how to request an estimate.
    Remark,
    /// Errors are estimated after runs of less than a second without a limit of steps.
    Auto,
    /// Errors are estimated after every run.
    Always,
}

/// Treatment of completed cases if a study is interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JournalPreference {
    /// Completed cases are lost.
    #[default]
    None,
    /// Completed cases are kept in the output folder and reused.
    Resume,
    /// Completed cases are kept in the output folder, after removal of those of earlier runs.
    Restart,
}

impl RunSettings {
    /// Settings for a run whose printed text, diagnostics and progress are discarded, and the base for other settings.
    /// In the mode [`RunMode::Run`], files are still written to the folder `out`.
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
            inputs: Inputs::default(),
            files_read: FilesRead::default(),
            studies: StudyPreferences::default(),
            errors: ErrorEstimation::Never,
            last_resort: None,
            program: None,
            refuses_files: None,
        }
    }
}
