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
    /// Dry run: scenes are built and checked, but nothing is stepped, printed, judged or written.
    DryRun,
}

/// Settings of a run, from the command line, the prompt or a test.
pub struct RunSettings {
    /// Mode of the run.
    pub mode: RunMode,
    /// Folder for output files. It is created with the first file.
    pub out: PathBuf,
    /// Folder of the script. The script may read files in it.
    pub folder: PathBuf,
    /// Default memory for the snapshots of each simulation [bytes].
    pub snapshots: usize,
    /// Flag that is set from outside, for example by Ctrl-C. The run then stops as soon as possible.
    pub interrupt: Arc<AtomicBool>,
    /// Resource limits.
    pub limits: Limits,
    /// Writer for the output of `print`.
    pub printed: Box<dyn Write + Send>,
    /// Writer for failed checks and `debug`.
    pub diagnostics: Box<dyn Write + Send>,
    /// Progress display.
    pub progress: Box<dyn Progress + Send>,
    /// Options of the studies.
    pub studies: StudyPreferences,
    /// Estimation of errors at the end of the run.
    pub errors: ErrorEstimation,
    /// Action that ends the whole program if a limit is exceeded and the run does not react.
    pub last_resort: Option<HardAbort>,
    /// Script of the run; `None` at the prompt. The engines of other threads compile it too.
    pub program: Option<Program>,
    /// Reason why the run must not write files; `None` if it may.
    pub refuses_files: Option<&'static str>,
}

/// Options of the studies of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyPreferences {
    /// Use of journals to resume interrupted studies.
    pub journal: JournalPreference,
    /// Number of repetitions when run times are measured; `None` to use the number in the script.
    pub repeats: Option<usize>,
    /// Part of each study to be computed; `None` for all. If it is given, no other files are written.
    pub part: Option<StudyPart>,
    /// Folders with computed parts. If there are any, the parts are merged and nothing is computed.
    pub merge: Vec<PathBuf>,
}

/// Estimation of the discretisation errors of all simulations at the end of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorEstimation {
    /// They are not estimated.
    #[default]
    Never,
    /// They are not estimated, but a remark tells how to request an estimate.
    Remark,
    /// They are estimated after runs of less than a second. This takes about as long as the run.
    Auto,
    /// They are estimated after every run.
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
    /// Completed cases are kept in the output folder. Those of earlier runs are removed first.
    Restart,
}

impl RunSettings {
    /// Settings for a run without any output. They are used for dry runs, and as a base for other settings.
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
