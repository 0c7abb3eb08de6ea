//! What all native calls of one run share: where output goes, what was checked, whether to go on.

mod written;

use std::cell::{Cell, RefCell};
use std::collections::HashSet;
use std::io::{self, Write};
use std::path::PathBuf;
use std::rc::{Rc, Weak};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rhai::{Dynamic, Engine};

use super::files::OutputFolder;
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

/// A function that tells why a value of a native type cannot be used now, if the value is busy.
pub type BusyCheck = fn(&Dynamic) -> Option<String>;

/// A cheap handle on the state of one run.
#[derive(Clone)]
pub struct Context(Rc<ContextData>);

struct ContextData {
    mode: RunMode,
    interrupt: Arc<AtomicBool>,
    meter: Meter,
    printed: RefCell<Box<dyn Write + Send>>,
    told: RefCell<Box<dyn Write + Send>>,
    pipe_closed: Cell<bool>,
    progress: Box<dyn Progress + Send>,
    studies: StudyPreferences,
    journals: Journals,
    output: OutputFolder,
    program: Option<Program>,
    refuses_files: Cell<Option<&'static str>>,
    checks: RefCell<Checks>,
    reports: Reports,
    /// The names of studies so far.
    study_names: RefCell<HashSet<PathBuf>>,
    snapshots: usize,
    latest_simulation: RefCell<Option<Dynamic>>,
    /// Weak, for the engine has this context in all its functions.
    engine: RefCell<Weak<Engine>>,
    level: Cell<usize>,
    is_calling_back: Cell<bool>,
    is_silent: Cell<bool>,
    busy: RefCell<Vec<BusyCheck>>,
}

impl Context {
    /// The state at the start of a run with these settings.
    pub fn new(settings: RunSettings) -> Self {
        // Who makes a part of studies writes down nothing else.
        let writing = settings.studies.part.map_or(settings.mode, |_| RunMode::DryBuild);
        Self(Rc::new(ContextData {
            mode: settings.mode,
            interrupt: settings.interrupt,
            meter: Meter::guarded(settings.limits, settings.last_resort),
            printed: RefCell::new(settings.printed),
            told: RefCell::new(settings.told),
            pipe_closed: Cell::new(false),
            progress: settings.progress,
            studies: settings.studies,
            journals: Journals::default(),
            output: OutputFolder::new(settings.out, settings.folder, writing),
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

    /// Whether simulations of the run really run.
    pub fn mode(&self) -> RunMode {
        self.0.mode
    }

    /// The folder for files that the script writes.
    pub fn output(&self) -> &OutputFolder {
        &self.0.output
    }

    /// The script of the run; none where there is no whole one, as at the prompt.
    pub fn program(&self) -> Option<&Program> {
        self.0.program.as_ref()
    }

    /// What shows how far a simulation of the run is.
    pub fn progress(&self) -> &dyn Progress {
        &*self.0.progress
    }

    /// How the studies of the run are made.
    pub fn studies(&self) -> &StudyPreferences {
        &self.0.studies
    }

    /// The journals of the run: what is kept of its studies until the script has come to its end.
    pub fn journals(&self) -> &Journals {
        &self.0.journals
    }

    /// Takes a name for a study of the run; whether no other one had it, however it is written.
    pub fn claim_study(&self, name: &str) -> bool {
        self.0.study_names.borrow_mut().insert(PathBuf::from(name))
    }

    /// Refuses to go on with the run after an interrupt, beyond a limit, or when nobody reads the output any more.
    pub fn proceed(&self) -> Result<(), ScriptError> {
        self.stopped_by().map_or(Ok(()), |stop| Err(ScriptError::Stopped(stop)))
    }

    /// Checks that there is room for something that takes memory all at once, before anybody could stop it [bytes].
    ///
    /// # Errors
    /// When a run may not use so much memory.
    pub fn expect_room(&self, what: &str, bytes: u64) -> Result<(), ScriptError> {
        match self.meter().limits().memory.filter(|limit| bytes > *limit) {
            None => Ok(()),
            Some(limit) => {
                let (needed, limit) = (bytes / MEGABYTE, limit / MEGABYTE);
                let told = format!(
                    "{what} take about {needed} MB of memory, and a run may use {limit} MB"
                );
                Err(ScriptError::new(told).hint("ask for less, or allow more with --max-memory MB"))
            }
        }
    }

    /// Why something that is asked again and again whether to go on did not: the limit or the interrupt that stopped it. `what` stopped
    /// without any would be a mistake of ours.
    pub fn why_stopped(&self, what: &str) -> ScriptError {
        match self.proceed() {
            Err(stopped) => stopped,
            Ok(()) => ScriptError::bug(format!("{what} was stopped by nobody")),
        }
    }

    /// Whether the run should end as soon as it can.
    pub fn is_stopped(&self) -> bool {
        self.stopped_by().is_some()
    }

    /// Why the run should end as soon as it can, if it should.
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

    /// What the run may use, and how much of it is used. Code that lets a script run calls
    /// [`watch`](Meter::watch) before, and keeps the guard until it has ended.
    pub fn meter(&self) -> &Meter {
        &self.0.meter
    }

    /// The flag that stops the run, for native loops that know nothing of scripts.
    pub fn interrupt_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0.interrupt)
    }

    /// Whether the reader of the output went away.
    pub fn is_pipe_closed(&self) -> bool {
        self.0.pipe_closed.get()
    }

    /// Prints a line for the script, as far as a terminal may see it.
    pub fn print(&self, text: &str) {
        self.print_drawn(&printable(text));
    }

    /// Prints a line that may have colours of this program.
    pub fn print_drawn(&self, text: &str) {
        if self.0.is_silent.get() || !self.meter().allows_to_write(text.len() as u64 + 1) {
            return;
        }
        self.0.progress.step_aside(&mut || {
            let text = printable_in_colours(text);
            self.notice(writeln!(self.0.printed.borrow_mut(), "{text}"));
        });
    }

    /// Tells the user something that is not the script's own output.
    pub fn tell(&self, text: &str) {
        self.tell_drawn(&printable(text));
    }

    /// Tells the user something that may have colours of this program.
    pub fn tell_drawn(&self, text: &str) {
        if self.0.is_silent.get() {
            return;
        }
        self.0.progress.step_aside(&mut || {
            // When nobody listens, the exit code still tells.
            let _ = writeln!(self.0.told.borrow_mut(), "{}", printable_in_colours(text));
        });
    }

    /// Does something of which nothing is printed or told.
    pub fn silently<T>(&self, work: impl FnOnce() -> T) -> T {
        let was_silent = self.0.is_silent.replace(true);
        let result = work();
        self.0.is_silent.set(was_silent);
        result
    }

    /// Does something of which nothing is printed or told, and which may write no files; `refusal` says why not.
    pub fn tracelessly<T>(&self, refusal: &'static str, work: impl FnOnce() -> T) -> T {
        let refused_before = self.0.refuses_files.replace(Some(refusal));
        let result = self.silently(work);
        self.0.refuses_files.set(refused_before);
        result
    }

    /// Tells what the script itself asks to be told beside its output, and counts it as what it prints.
    pub fn remark(&self, text: &str) {
        if self.meter().allows_to_write(text.len() as u64 + 1) {
            self.tell(text);
        }
    }

    /// Writes out the printed text that is buffered.
    pub fn flush(&self) {
        let written = self.0.printed.borrow_mut().flush();
        self.notice(written);
    }

    /// A closed pipe ends the run quietly; that the script prints where there is no room is an error.
    fn notice(&self, written: io::Result<()>) {
        match written {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.0.pipe_closed.set(true);
            }
            Err(error) => self.meter().stop(Stop::OutputLost(error.kind())),
            Ok(()) => (),
        }
    }

    /// Changes the record of the checks of the run.
    pub fn with_checks<T>(&self, change: impl FnOnce(&mut Checks) -> T) -> T {
        change(&mut self.0.checks.borrow_mut())
    }

    /// The memory that a simulation may take for states to go back to, unless the script says otherwise [bytes].
    pub fn snapshots(&self) -> usize {
        self.0.snapshots
    }

    /// Remembers the simulation that something was done with last.
    pub fn note_simulation(&self, simulation: Dynamic) {
        self.0.latest_simulation.replace(Some(simulation));
    }

    /// The simulation that was started, loaded, forked, stepped or taken back last.
    pub fn latest_simulation(&self) -> Option<Dynamic> {
        self.0.latest_simulation.borrow().clone()
    }

    /// Forgets which simulation was the last, and lets go of those that the report would tell of.
    pub fn forget_simulations(&self) {
        self.0.latest_simulation.take();
        self.forget_reporters();
    }

    /// Lets functions that the script has stored be called by its own engine, as long as that is kept by the caller.
    pub fn lend(&self, engine: &Rc<Engine>) {
        self.0.engine.replace(Rc::downgrade(engine));
    }

    /// The engine of the script while it runs.
    pub fn engine(&self) -> Option<Rc<Engine>> {
        self.0.engine.borrow().upgrade()
    }

    /// Notes at which depth of calls of script functions the running native call is.
    pub fn enter(&self, level: usize) {
        self.0.level.set(level);
    }

    /// The depth of calls of script functions at which the running native call is.
    pub fn level(&self) -> usize {
        self.0.level.get()
    }

    /// Calls a stored function while a native call is at work.
    pub fn call_back<T>(&self, call: impl FnOnce() -> T) -> T {
        let was_calling_back = self.0.is_calling_back.replace(true);
        let result = call();
        self.0.is_calling_back.set(was_calling_back);
        result
    }

    /// Whether a stored function is running, and with it the native call that called it.
    pub fn is_calling_back(&self) -> bool {
        self.0.is_calling_back.get()
    }

    /// Keeps a function that tells whether values of a native type are busy.
    pub fn know(&self, busy: BusyCheck) {
        self.0.busy.borrow_mut().push(busy);
    }

    /// Why a value cannot be used now, if it is busy.
    pub fn busy(&self, value: &Dynamic) -> Option<String> {
        self.0.busy.borrow().iter().find_map(|busy| busy(value))
    }

    /// Adds a simulation to the report.
    pub fn add_reporter(&self, reporter: Box<dyn Reporter>) {
        self.0.reports.add(reporter);
    }

    /// Writes what would be lost of the simulations, after a script that did not come to its end.
    pub fn save_remains(&self) {
        let (files, note) = self.0.reports.remains(self.meter().left_for_remains());
        for (name, content) in files {
            if let Err(ScriptError::Failure(failure)) =
                self.write_remains(&name, content.as_bytes())
            {
                self.tell(&failure.message);
            }
        }
        note.inspect(|note| self.tell(note));
    }

    /// Lets go of the simulations that the report would tell of, and of the names of studies: a session has no report, and the
    /// next input may make a study anew.
    pub fn forget_reporters(&self) {
        self.0.study_names.borrow_mut().clear();
        self.0.reports.forget();
    }

    /// What all simulations of the run say about themselves; they are let go.
    pub fn report(&self) -> Vec<serde_json::Value> {
        self.0.latest_simulation.take();
        self.0.reports.take()
    }
}
