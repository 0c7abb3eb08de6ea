//! How a run talks to the world outside, and what is wanted of it.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::limits::{HardAbort, Limits};
use super::parts::StudyPart;
use crate::script::messages::progress::{NoProgress, Progress};
use crate::script::source::program::Program;

/// Whether simulations of a run really run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunMode {
    /// Everything of the run really runs.
    Run,
    /// Scenes are built and checked; nothing is stepped, printed, judged or written.
    DryBuild,
}

/// How a run talks to the world outside. Made by the command line, the prompt or a test.
pub struct RunSettings {
    /// Whether simulations of the run really run.
    pub mode: RunMode,
    /// The folder for files of the script; made when the first one is written.
    pub out: PathBuf,
    /// The folder of the script, beside which it may read files.
    pub folder: PathBuf,
    /// The memory that each simulation may take for states to go back to, unless the script says otherwise [bytes].
    pub snapshots: usize,
    /// The flag that is set from outside (Ctrl-C) to stop the run as soon as possible.
    pub interrupt: Arc<AtomicBool>,
    /// The limits of what the run may use.
    pub limits: Limits,
    /// The writer that `print` writes to.
    pub printed: Box<dyn Write + Send>,
    /// The writer to which failed checks and `debug` are told, at once.
    pub told: Box<dyn Write + Send>,
    /// What shows how far a simulation of the run is.
    pub progress: Box<dyn Progress + Send>,
    /// How the studies of the run are made.
    pub studies: StudyPreferences,
    /// What ends the whole program when a limit of the run is passed and nothing hears of it.
    pub last_resort: Option<HardAbort>,
    /// The script of the run, which engines of other threads read too; none where there is no whole one, as at the prompt.
    pub program: Option<Program>,
    /// Why the run may write no files, if it may not.
    pub refuses_files: Option<&'static str>,
}

/// How the studies of a run are made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyPreferences {
    /// Whether the studies can go on where an earlier run of them was interrupted.
    pub journal: JournalPreference,
    /// How often cases of the studies are timed, whatever the script says.
    pub repeats: Option<usize>,
    /// The part of each study that is made; then nothing is written but that.
    pub part: Option<StudyPart>,
    /// The folders of parts that are joined into whole studies, in the place of making them.
    pub merge: Vec<PathBuf>,
}

/// What becomes of finished cases when a study is interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JournalPreference {
    /// Finished cases are lost.
    #[default]
    Without,
    /// Finished cases are kept in the output folder, and those that are there are not run again.
    GoOn,
    /// Finished cases are kept in the output folder; what is there is forgotten first.
    Anew,
}

impl RunSettings {
    /// The settings of a run that writes to nowhere, for dry builds and as a start for others.
    pub fn silent(mode: RunMode) -> Self {
        Self {
            mode,
            out: PathBuf::from("out"),
            folder: PathBuf::from("."),
            snapshots: 0,
            interrupt: Arc::default(),
            limits: Limits::default(),
            printed: Box::new(io::sink()),
            told: Box::new(io::sink()),
            progress: Box::new(NoProgress),
            studies: StudyPreferences::default(),
            last_resort: None,
            program: None,
            refuses_files: None,
        }
    }
}
