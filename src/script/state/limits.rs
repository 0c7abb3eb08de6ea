//! What a run may use: time, steps, memory, calls within calls, what is written; and what stopped a run before its end.

use std::cell::Cell;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::time::Duration;

use super::watchdog::Watchdog;
use crate::script::messages::stop::{MEGABYTE, Stop};

/// The default limit of memory, in megabytes.
pub const DEFAULT_MEGABYTES: u64 = 4096;
/// The default limit of what is written, in megabytes.
pub const DEFAULT_MEGABYTES_WRITTEN: u64 = 10_000;
/// The default limit of files written.
pub const DEFAULT_FILES: u64 = 100_000;
/// The default limit of calls within calls.
pub const DEFAULT_DEPTH: usize = 400;
/// The most calls within calls that can be allowed: they fit [`LEAST_STACK`].
pub const DEEPEST: usize = 1000;
/// Address space for the stack of [`DEEPEST`] calls within calls; memory is used only as deep as a script really goes [bytes].
pub const LEAST_STACK: usize = 256 << 20;
/// Most address space for the stack that values need when they are let go [bytes].
const LARGEST_FOR_VALUES: usize = 16 << 30;

/// The limits of what a run may use. `None` is without limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The longest time of the run by the clock.
    pub time: Option<Duration>,
    /// The most steps of all simulations of the run together, failed tries included.
    pub steps: Option<u64>,
    /// The most memory that the whole process really occupies [bytes].
    pub memory: Option<u64>,
    /// The most calls of script functions within calls, at most [`DEEPEST`].
    pub depth: usize,
    /// The most that is printed and written into files, all together [bytes].
    pub written: Option<u64>,
    /// The most files that are written; one that is written again counts again.
    pub files: Option<u64>,
}

/// Ends the whole program: a limit was passed, and what runs did not hear of it or grows too fast.
pub type HardAbort = Arc<dyn Fn(Stop) + Send + Sync>;

impl Limits {
    /// Address space for a stack that a script within these limits cannot exhaust [bytes].
    ///
    /// Closures that hold closures that hold closures … are let go one within the other. A link of such a chain takes less stack than
    /// twice its memory, so the memory allowed bounds the stack that it may need.
    pub fn stack(&self) -> usize {
        LEAST_STACK + 2 * self.memory_or_default().min(LARGEST_FOR_VALUES)
    }

    /// Address space for the stack of as many calls within calls as are allowed [bytes].
    pub fn least_stack(&self) -> usize {
        LEAST_STACK / DEEPEST * self.depth.clamp(DEFAULT_DEPTH, DEEPEST)
    }

    /// Address space for the values of a script within these limits: what is let go is not given back at once [bytes].
    pub fn address_space(&self) -> usize {
        self.memory_or_default().saturating_mul(2)
    }

    fn memory_or_default(&self) -> usize {
        let memory = self.memory.unwrap_or(DEFAULT_MEGABYTES * MEGABYTE);
        usize::try_from(memory).unwrap_or(LARGEST_FOR_VALUES)
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: None,
            steps: None,
            memory: Some(DEFAULT_MEGABYTES * MEGABYTE),
            depth: DEFAULT_DEPTH,
            written: Some(DEFAULT_MEGABYTES_WRITTEN * MEGABYTE),
            files: Some(DEFAULT_FILES),
        }
    }
}

/// How much of its limits a run has used.
pub struct Meter {
    limits: Limits,
    alarm: Arc<AtomicU8>,
    resort: Option<HardAbort>,
    steps: Cell<u64>,
    wants_too_many_steps: Cell<bool>,
    written: Cell<u64>,
    files: Cell<u64>,
    /// What the run stopped itself by.
    stopped: Cell<Option<Stop>>,
    /// How often a dry build pretended to go on with a simulation.
    pretended: Cell<u64>,
}

/// So often may it do that: a loop that waits for a time is long through by then.
const MOST_PRETENDED: u64 = 100_000;

/// Whether a run of this process has heard that it was interrupted: it is about to stop, and to keep what ran.
pub static INTERRUPT_HEARD: AtomicBool = AtomicBool::new(false);

/// The state of a watchdog that has nothing to say.
pub(super) const QUIET: u8 = 0;
pub(super) const TOO_LATE: u8 = 1;
pub(super) const TOO_LARGE: u8 = 2;

impl Meter {
    /// The meter of a run of which nothing is used yet.
    pub fn new(limits: Limits) -> Self {
        Self::guarded(limits, None)
    }

    /// The meter of a run of which nothing is used yet, with code that ends the program when a limit is passed and nothing hears of it.
    pub fn guarded(limits: Limits, resort: Option<HardAbort>) -> Self {
        Self {
            limits,
            resort,
            alarm: Arc::default(),
            steps: Cell::new(0),
            wants_too_many_steps: Cell::new(false),
            written: Cell::new(0),
            files: Cell::new(0),
            stopped: Cell::new(None),
            pretended: Cell::new(0),
        }
    }

    /// The limits of what the run may use.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The limit of the run that was passed, if one was.
    pub fn passed(&self) -> Option<Stop> {
        match self.alarm.load(Ordering::Relaxed) {
            TOO_LATE => self.limits.time.map(Stop::Time),
            TOO_LARGE => self.limits.memory.map(Stop::Memory),
            _ if self.stopped.get().is_some() => self.stopped.get(),
            _ if self.wants_too_many_steps.get() => self.limits.steps.map(Stop::Steps),
            _ if self.pretended.get() > MOST_PRETENDED => Some(Stop::Waiting),
            _ => None,
        }
    }

    /// Counts that a dry build pretends to go on with a simulation.
    pub fn count_pretended(&self) {
        self.pretended.set(self.pretended.get() + 1);
    }

    /// Whether the script has gone by results that a dry build only pretends to have.
    pub fn has_pretended(&self) -> bool {
        self.pretended.get() > 0
    }

    /// Counts a step of a simulation of the run, or a try of one.
    pub fn count_step(&self) {
        self.steps.set(self.steps.get() + 1);
    }

    /// Counts steps of the run that were made elsewhere.
    pub fn count_steps(&self, steps: usize) {
        self.steps.set(self.steps.get().saturating_add(steps as u64));
    }

    /// The steps of simulations so far, failed tries included.
    pub fn steps(&self) -> u64 {
        self.steps.get()
    }

    /// Whether one more step is allowed; if not, the limit counts as passed.
    pub fn allows_a_step(&self) -> bool {
        let allowed = self.limits.steps.is_none_or(|limit| self.steps.get() < limit);
        if !allowed {
            self.wants_too_many_steps.set(true);
        }
        allowed
    }

    /// Stops the run for a reason, as soon as it asks.
    pub fn stop(&self, why: Stop) {
        self.stopped.set(self.stopped.get().or(Some(why)));
    }

    /// Counts what is to be printed or written, and whether it may be [bytes]; if not, the limit counts as passed.
    pub fn allows_to_write(&self, bytes: u64) -> bool {
        let written = self.written.get().saturating_add(bytes);
        match self.limits.written.filter(|limit| written > *limit) {
            Some(limit) => {
                self.stop(Stop::Written(limit));
                false
            }
            None => {
                self.written.set(written);
                true
            }
        }
    }

    /// How much may be written of what would be lost of a run that was stopped: what is left, and a twentieth of the limit [bytes].
    pub fn left_for_remains(&self) -> u64 {
        let left = |limit: u64| (limit + limit / 20).saturating_sub(self.written.get());
        self.limits.written.map_or(u64::MAX, left)
    }

    /// Counts a file of so many bytes that is to be written, and whether it may be; if not, the limit counts as passed.
    pub fn allows_a_file(&self, bytes: u64) -> bool {
        self.files.set(self.files.get() + 1);
        match self.limits.files.filter(|limit| self.files.get() > *limit) {
            Some(limit) => {
                self.stop(Stop::Files(limit));
                false
            }
            None => self.allows_to_write(bytes),
        }
    }

    /// Begins to count anew and watches the clock and the memory until the guard is dropped.
    ///
    /// # Errors
    /// When no thread can be started.
    pub fn watch(&self) -> io::Result<Watchdog> {
        self.alarm.store(QUIET, Ordering::Relaxed);
        self.steps.set(0);
        self.wants_too_many_steps.set(false);
        self.written.set(0);
        self.files.set(0);
        // What is lost stays lost.
        self.stopped.set(self.stopped.get().filter(|stop| matches!(stop, Stop::OutputLost(_))));
        Watchdog::start(self.limits, Arc::clone(&self.alarm), self.resort.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread;
    use std::time::Instant;

    fn without_limits() -> Limits {
        Limits { memory: None, ..Limits::default() }
    }

    fn wait_for(meter: &Meter) -> Option<Stop> {
        let begun = Instant::now();
        while meter.passed().is_none() && begun.elapsed() < Duration::from_secs(5) {
            thread::sleep(Duration::from_millis(1));
        }
        meter.passed()
    }

    #[test]
    fn time_passes_and_a_new_watch_begins_anew() {
        let time = Duration::from_millis(20);
        let meter = Meter::new(Limits { time: Some(time), ..without_limits() });
        let watchdog = meter.watch().unwrap();
        assert_eq!(meter.passed(), None);
        assert_eq!(wait_for(&meter), Some(Stop::Time(time)));
        drop(watchdog);
        let _second = meter.watch().unwrap();
        assert_eq!(meter.passed(), None);
    }

    #[test]
    fn memory_is_that_of_the_process() {
        let meter = Meter::new(Limits { memory: Some(1), ..without_limits() });
        let _watchdog = meter.watch().unwrap();
        assert_eq!(wait_for(&meter), Some(Stop::Memory(1)));
    }

    #[test]
    fn the_last_allowed_step_is_taken_and_no_other() {
        let meter = Meter::new(Limits { steps: Some(2), ..without_limits() });
        for _ in 0..2 {
            assert!(meter.allows_a_step());
            meter.count_step();
        }
        assert_eq!(meter.passed(), None);
        assert!(!meter.allows_a_step());
        assert_eq!(meter.passed(), Some(Stop::Steps(2)));
    }

    #[test]
    fn a_watchdog_ends_at_once() {
        let limits = Limits { time: Some(Duration::from_secs(3600)), ..without_limits() };
        let meter = Meter::new(limits);
        let begun = Instant::now();
        drop(meter.watch().unwrap());
        assert!(begun.elapsed() < Duration::from_secs(2));
    }

    #[test]
    fn what_is_written_is_counted_with_what_is_printed() {
        let meter = Meter::new(Limits { written: Some(10), files: Some(2), ..without_limits() });
        assert!(meter.allows_to_write(6) && meter.allows_a_file(4) && meter.passed().is_none());
        assert!(!meter.allows_to_write(1));
        assert_eq!(meter.passed(), Some(Stop::Written(10)));
        assert_eq!(meter.left_for_remains(), 0);
        let _watchdog = meter.watch().unwrap();
        assert!(meter.allows_a_file(1) && meter.allows_a_file(1) && !meter.allows_a_file(1));
        assert_eq!(meter.passed(), Some(Stop::Files(2)));
        meter.stop(Stop::OutputLost(io::ErrorKind::StorageFull));
        assert_eq!(meter.passed(), Some(Stop::Files(2)), "the first reason holds");
    }

    #[test]
    fn who_does_not_hear_of_a_limit_is_ended() {
        let (send, ended) = std::sync::mpsc::channel();
        let resort: HardAbort = Arc::new(move |stop| _ = send.send(stop));
        let limit = Duration::from_millis(20);
        let begun = Instant::now();
        let meter = Meter::guarded(Limits { time: Some(limit), ..without_limits() }, Some(resort));
        let _watchdog = meter.watch().unwrap();
        let stop = ended.recv_timeout(Duration::from_secs(20)).unwrap();
        assert_eq!(stop, Stop::Time(limit));
        assert!(begun.elapsed() > limit * 2, "whoever hears of it has some time");
    }
}
