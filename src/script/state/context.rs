//! State shared by all native calls of a run.

mod written;

use std::cell::{Cell, RefCell};
use std::collections::HashSet;
use std::io::{self, Write};
use std::path::PathBuf;
use std::rc::{Rc, Weak};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rhai::{Dynamic, Engine, Map};

use super::files::OutputFolder;
use super::files_read::FilesRead;
use super::inputs::Inputs;
use super::journals::Journals;
use super::limits::{INTERRUPT_HEARD, Meter};
use super::settings::{RunMode, RunSettings, StudyPreferences};
use crate::output::{printable, printable_in_colours};
use crate::script::messages::checks::Checks;
use crate::script::messages::error::ScriptError;
use crate::script::messages::progress::Progress;
use crate::script::messages::reports::{Reporter, Reports};
use crate::script::messages::stop::{MEGABYTE, Stop};
use crate::script::source::program::Program;

/// Function that returns the reason why a value of a native type must not be used now; `None` if it may be used.
pub type BusyCheck = fn(&Dynamic) -> Option<String>;

/// Handle to the state of a run. Clones refer to the same state.
#[derive(Clone)]
pub struct Context(Rc<ContextData>);

struct ContextData {
    mode: RunMode,
    interrupt: Arc<AtomicBool>,
    meter: Meter,
    printed: RefCell<Box<dyn Write + Send>>,
    diagnostics: RefCell<Box<dyn Write + Send>>,
    pipe_closed: Cell<bool>,
    progress: Box<dyn Progress + Send>,
    inputs: RefCell<Inputs>,
    parameters: RefCell<Map>,
    files_read: FilesRead,
    studies: StudyPreferences,
    journals: Journals,
    output: OutputFolder,
    program: Option<Program>,
    refuses_files: Cell<Option<&'static str>>,
    checks: RefCell<Checks>,
    reports: Reports,
    study_names: RefCell<HashSet<PathBuf>>,
    snapshots: usize,
    latest_simulation: RefCell<Option<Dynamic>>,
    /// Engine, as a weak reference, because all functions of the engine own this context.
    engine: RefCell<Weak<Engine>>,
    level: Cell<usize>,
    is_calling_back: Cell<bool>,
    is_silent: Cell<bool>,
    busy: RefCell<Vec<BusyCheck>>,
}

impl Context {
    /// Creates the state at the start of a run.
    pub fn new(settings: RunSettings) -> Self {
        let writing = settings.studies.part.map_or(settings.mode, |_| RunMode::DryRun);
        Self(Rc::new(ContextData {
            mode: settings.mode,
            interrupt: settings.interrupt,
            meter: Meter::guarded(settings.limits, settings.last_resort),
            printed: RefCell::new(settings.printed),
            diagnostics: RefCell::new(settings.diagnostics),
            pipe_closed: Cell::new(false),
            progress: settings.progress,
            inputs: RefCell::new(settings.inputs),
            parameters: RefCell::default(),
            studies: settings.studies,
            journals: Journals::default(),
            output: OutputFolder::new(settings.out, settings.folder, writing)
                .recording(settings.files_read.clone()),
            files_read: settings.files_read,
            program: settings.program,
            refuses_files: Cell::new(settings.refuses_files),
            checks: RefCell::default(),
            reports: Reports::default(),
            study_names: RefCell::default(),
            snapshots: settings.snapshots,
            latest_simulation: RefCell::default(),
            engine: RefCell::default(),
            level: Cell::new(0),
            is_calling_back: Cell::new(false),
            is_silent: Cell::new(false),
            busy: RefCell::default(),
        }))
    }

    /// Mode of the run.
    pub fn mode(&self) -> RunMode {
        self.0.mode
    }

    /// Folder for the output files of the script.
    pub fn output(&self) -> &OutputFolder {
        &self.0.output
    }

    /// Script of the run; `None` at the prompt.
    pub fn program(&self) -> Option<&Program> {
        self.0.program.as_ref()
    }

    /// Progress display.
    pub fn progress(&self) -> &dyn Progress {
        &*self.0.progress
    }

    /// Inputs of the script.
    pub fn inputs(&self) -> Inputs {
        self.0.inputs.borrow().clone()
    }

    /// Replaces the inputs.
    pub fn set_inputs(&self, inputs: Inputs) {
        self.0.inputs.replace(inputs);
    }

    /// Calls `work` while the values of `parameters` replace the inputs of the same names.
    pub fn with_parameters<T>(&self, parameters: &Map, work: impl FnOnce() -> T) -> T {
        let before = self.0.parameters.replace(parameters.clone());
        let result = work();
        self.0.parameters.replace(before);
        result
    }

    /// Value of a parameter in a run of a study; `None` for other names and outside of studies.
    pub fn varied(&self, name: &str) -> Option<Dynamic> {
        self.0.parameters.borrow().get(name).cloned()
    }

    /// Returns true in a run of a study.
    pub fn has_parameters(&self) -> bool {
        !self.0.parameters.borrow().is_empty()
    }

    /// Record of the files that the script has read.
    pub fn files_read(&self) -> FilesRead {
        self.0.files_read.clone()
    }

    /// Options of the studies of the run.
    pub fn studies(&self) -> &StudyPreferences {
        &self.0.studies
    }

    /// Journals of the studies. They are kept until the script ends.
    pub fn journals(&self) -> &Journals {
        &self.0.journals
    }

    /// Reserves the name of a study. Returns false if it is in use.
    pub fn claim_study(&self, name: &str) -> bool {
        self.0.study_names.borrow_mut().insert(PathBuf::from(name))
    }

    /// Returns an error if the run is interrupted, has exceeded a limit, or the reader of the output has closed the pipe.
    pub fn proceed(&self) -> Result<(), ScriptError> {
        self.stopped_by().map_or(Ok(()), |stop| Err(ScriptError::Stopped(stop)))
    }

    /// Checks in advance whether an allocation of the given size is possible [bytes].
    ///
    /// # Errors
    /// Fails if the allocation would exceed the memory limit.
    pub fn expect_room(&self, what: &str, bytes: u64) -> Result<(), ScriptError> {
        match self.meter().limits().memory.filter(|limit| bytes > *limit) {
            None => Ok(()),
            Some(limit) => {
                let (needed, limit) = (bytes / MEGABYTE, limit / MEGABYTE);
                let message = format!(
                    "{what} take about {needed} MB of memory, and a run may use {limit} MB"
                );
                Err(ScriptError::new(message)
                    .hint("request less, or allow more with --max-memory MB"))
            }
        }
    }

    /// Error for a loop that was stopped: the exceeded limit or the interrupt if there is one, otherwise an internal error that names `what`.
    pub fn why_stopped(&self, what: &str) -> ScriptError {
        match self.proceed() {
            Err(stopped) => stopped,
            Ok(()) => ScriptError::internal_error(format!("{what} was stopped by nobody")),
        }
    }

    /// Returns true if the run must end as soon as possible.
    pub fn is_stopped(&self) -> bool {
        self.stopped_by().is_some()
    }

    /// Reason why the run must end; `None` if it may continue.
    pub fn stopped_by(&self) -> Option<Stop> {
        if self.0.pipe_closed.get() {
            return Some(Stop::PipeClosed);
        }
        if self.0.interrupt.load(Ordering::Relaxed) {
            INTERRUPT_HEARD.store(true, Ordering::Relaxed);
            return Some(Stop::Interrupt);
        }
        self.0.meter.passed()
    }

    /// Resource use and limits of the run.
    /// Code that runs a script must call [`watch`](Meter::watch) first, and keep the guard until the script has ended.
    pub fn meter(&self) -> &Meter {
        &self.0.meter
    }

    /// Flag that stops the run, for native loops.
    pub fn interrupt_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0.interrupt)
    }

    /// Returns true if the reader of the output has closed the pipe.
    pub fn is_pipe_closed(&self) -> bool {
        self.0.pipe_closed.get()
    }

    /// Prints a line for the script, without characters that control a terminal.
    pub fn print(&self, text: &str) {
        self.print_drawn(&printable(text));
    }

    /// Prints a line, and keeps colour sequences created by this program.
    pub fn print_drawn(&self, text: &str) {
        if self.0.is_silent.get() || !self.meter().allows_to_write(text.len() as u64 + 1) {
            return;
        }
        self.0.progress.without_progress_bar(&mut || {
            let text = printable_in_colours(text);
            self.check_write(writeln!(self.0.printed.borrow_mut(), "{text}"));
        });
    }

    /// Prints a message to the user, which is not output of the script.
    pub fn print_message(&self, text: &str) {
        self.print_styled_message(&printable(text));
    }

    /// Prints a message to the user, without control sequences other than colours.
    pub fn print_styled_message(&self, text: &str) {
        if self.0.is_silent.get() {
            return;
        }
        self.0.progress.without_progress_bar(&mut || {
            // Write errors are ignored, because the exit code still reports the result.
            let _ = writeln!(self.0.diagnostics.borrow_mut(), "{}", printable_in_colours(text));
        });
    }

    /// Calls `work`, and discards its printed output.
    pub fn silently<T>(&self, work: impl FnOnce() -> T) -> T {
        let was_silent = self.0.is_silent.replace(true);
        let result = work();
        self.0.is_silent.set(was_silent);
        result
    }

    /// Calls `work` without its output. Attempts of `work` to write files fail with the message `refusal`.
    pub fn without_output_or_files<T>(&self, refusal: &'static str, work: impl FnOnce() -> T) -> T {
        let refused_before = self.0.refuses_files.replace(Some(refusal));
        let result = self.silently(work);
        self.0.refuses_files.set(refused_before);
        result
    }

    /// Prints a message requested by the script, such as that of a failed check, which counts towards the output limit.
    pub fn print_debug(&self, text: &str) {
        if self.meter().allows_to_write(text.len() as u64 + 1) {
            self.print_message(text);
        }
    }

    /// Flushes the printed text.
    pub fn flush(&self) {
        let written = self.0.printed.borrow_mut().flush();
        self.check_write(written);
    }

    /// Ends the run without a message if the pipe is closed. Other write failures are errors.
    fn check_write(&self, written: io::Result<()>) {
        match written {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.0.pipe_closed.set(true);
            }
            Err(error) => self.meter().stop(Stop::OutputLost(error.kind())),
            Ok(()) => (),
        }
    }

    /// Calls `change` with write access to the record of checks.
    pub fn with_checks<T>(&self, change: impl FnOnce(&mut Checks) -> T) -> T {
        change(&mut self.0.checks.borrow_mut())
    }

    /// Default memory for the snapshots of a simulation [bytes].
    pub fn snapshots(&self) -> usize {
        self.0.snapshots
    }

    /// Stores the last used simulation.
    pub fn set_latest_simulation(&self, simulation: Dynamic) {
        self.0.latest_simulation.replace(Some(simulation));
    }

    /// Simulation that was started, loaded, copied, stepped or rewound most recently.
    pub fn latest_simulation(&self) -> Option<Dynamic> {
        self.0.latest_simulation.borrow().clone()
    }

    /// Clears the last used simulation and the objects that contribute to the report.
    pub fn clear_simulations(&self) {
        self.0.latest_simulation.take();
        self.clear_reporters();
    }

    /// Sets the engine that calls stored functions, which the caller must keep alive.
    pub fn set_engine(&self, engine: &Rc<Engine>) {
        self.0.engine.replace(Rc::downgrade(engine));
    }

    /// Engine of the running script.
    pub fn engine(&self) -> Option<Rc<Engine>> {
        self.0.engine.borrow().upgrade()
    }

    /// Sets the call depth of script functions at the present native call.
    pub fn enter(&self, level: usize) {
        self.0.level.set(level);
    }

    /// Call depth of script functions at the present native call.
    pub fn level(&self) -> usize {
        self.0.level.get()
    }

    /// Calls a stored script function within a native call.
    pub fn call_back<T>(&self, call: impl FnOnce() -> T) -> T {
        let was_calling_back = self.0.is_calling_back.replace(true);
        let result = call();
        self.0.is_calling_back.set(was_calling_back);
        result
    }

    /// Returns true while a native call runs a stored script function.
    pub fn is_calling_back(&self) -> bool {
        self.0.is_calling_back.get()
    }

    /// Registers a function that detects whether a value must not be used now.
    pub fn register_busy_check(&self, busy: BusyCheck) {
        self.0.busy.borrow_mut().push(busy);
    }

    /// Reason why a value must not be used now; `None` if it may be used.
    pub fn busy(&self, value: &Dynamic) -> Option<String> {
        self.0.busy.borrow().iter().find_map(|busy| busy(value))
    }

    /// Adds a simulation to the report.
    pub fn add_reporter(&self, reporter: Box<dyn Reporter>) {
        self.0.reports.add(reporter);
    }

    /// Simulations of the run, as script values.
    pub fn simulations(&self) -> Vec<Dynamic> {
        self.0.reports.objects()
    }

    /// Number of simulations that the script can no longer reach and whose results are released.
    pub fn released_simulations(&self) -> usize {
        self.0.reports.released()
    }

    /// Writes the rescue files of the simulations after the script has failed.
    pub fn save_remains(&self) {
        let (files, note) = self.0.reports.remains(self.meter().rescue_budget());
        for (name, content) in files {
            if let Err(ScriptError::Failure(failure)) =
                self.write_remains(&name, content.as_bytes())
            {
                self.print_message(&failure.message);
            }
        }
        note.inspect(|note| self.print_message(note));
    }

    /// Removes the objects that contribute to the report, and the reserved names of studies.
    pub fn clear_reporters(&self) {
        self.0.study_names.borrow_mut().clear();
        self.0.reports.clear();
    }

    /// Report entries of all simulations, which are then removed.
    pub fn report(&self) -> Vec<serde_json::Value> {
        self.0.latest_simulation.take();
        self.0.reports.take()
    }
}
