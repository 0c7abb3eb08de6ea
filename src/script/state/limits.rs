//! Resource limits of a run: time, steps, memory, call depth, output.

use std::cell::Cell;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::time::Duration;

use super::watchdog::Watchdog;
use crate::script::messages::stop::{MEGABYTE, Stop};

/// Default memory limit [MB].
pub const DEFAULT_MEGABYTES: u64 = 4096;
/// Default limit of written output [MB].
pub const DEFAULT_MEGABYTES_WRITTEN: u64 = 10_000;
/// Default limit of written files.
pub const DEFAULT_FILES: u64 = 100_000;
/// Default limit of the call depth.
pub const DEFAULT_DEPTH: usize = 400;
/// Largest allowed setting of the call depth, for which the stack size [`LEAST_STACK`] is sufficient.
pub const DEEPEST: usize = 1000;
/// Address space of the stack for [`DEEPEST`] nested calls [bytes]. It uses memory only as it grows.
pub const LEAST_STACK: usize = 256 << 20;
/// Memory limit above which the stack size no longer increases with the memory limit [bytes].
/// Below this limit, the stack size increases because dropping deeply nested values needs stack in proportion to their memory.
const LARGEST_FOR_VALUES: u64 = 16 << 30;

/// Resource limits of a run. `None` means unlimited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum wall-clock time.
    pub time: Option<Duration>,
    /// Maximum number of steps of all simulations together, including failed steps.
    pub steps: Option<u64>,
    /// Maximum resident memory of the process [bytes].
    pub memory: Option<u64>,
    /// Maximum depth of script function calls, at most [`DEEPEST`].
    pub depth: usize,
    /// Maximum amount of printed and written output [bytes].
    pub written: Option<u64>,
    /// Maximum number of written files. A file that is written twice counts twice.
    pub files: Option<u64>,
}

/// Action that ends the whole program if a run does not react to an exceeded limit.
pub type HardAbort = Arc<dyn Fn(Stop) + Send + Sync>;

impl Limits {
    /// Address space of a stack that is sufficient for every script within these limits [bytes].
    ///
    /// Nested closures are dropped recursively, which needs stack of up to twice their memory.
    /// Therefore the stack contains twice the memory limit in addition to the space for nested calls.
    pub fn stack(&self) -> usize {
        let for_values = 2 * self.memory_or_default().min(LARGEST_FOR_VALUES);
        LEAST_STACK.saturating_add(usize::try_from(for_values).unwrap_or(usize::MAX))
    }

    /// Stack size for the allowed depth of nested calls [bytes].
    pub fn least_stack(&self) -> usize {
        LEAST_STACK / DEEPEST * self.depth.clamp(DEFAULT_DEPTH, DEEPEST)
    }

    /// Address space for the values of a script [bytes], twice the memory limit, because freed memory is not returned at once.
    pub fn address_space(&self) -> usize {
        usize::try_from(self.memory_or_default().saturating_mul(2)).unwrap_or(usize::MAX)
    }

    fn memory_or_default(&self) -> u64 {
        self.memory.unwrap_or(DEFAULT_MEGABYTES * MEGABYTE)
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

/// Resource use of a run.
pub struct Meter {
    limits: Limits,
    alarm: Arc<AtomicU8>,
    resort: Option<HardAbort>,
    steps: Cell<u64>,
    wants_too_many_steps: Cell<bool>,
    written: Cell<u64>,
    files: Cell<u64>,
    stopped: Cell<Option<Stop>>,
    pretended: Cell<u64>,
}

const MOST_DRY_ADVANCES: u64 = 100_000;

/// True if a run of this process has detected an interrupt and will save its results.
pub static INTERRUPT_HEARD: AtomicBool = AtomicBool::new(false);

pub(super) const NO_ALARM: u8 = 0;
pub(super) const TOO_LATE: u8 = 1;
pub(super) const TOO_LARGE: u8 = 2;

impl Meter {
    /// Creates the meter of a new run.
    pub fn new(limits: Limits) -> Self {
        Self::guarded(limits, None)
    }

    /// Creates the meter of a new run. `resort` is called if the run does not react to an exceeded limit.
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

    /// Limits of the run.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Exceeded limit or other reason to stop, such as lost output; `None` if the run may continue.
    pub fn passed(&self) -> Option<Stop> {
        match self.alarm.load(Ordering::Relaxed) {
            TOO_LATE => self.limits.time.map(Stop::Time),
            TOO_LARGE => self.limits.memory.map(Stop::Memory),
            _ if self.stopped.get().is_some() => self.stopped.get(),
            _ if self.wants_too_many_steps.get() => self.limits.steps.map(Stop::Steps),
            _ if self.pretended.get() > MOST_DRY_ADVANCES => Some(Stop::Waiting),
            _ => None,
        }
    }

    /// Counts a call that would advance a simulation and was skipped in a dry run.
    pub fn count_dry_run(&self) {
        self.pretended.set(self.pretended.get() + 1);
    }

    /// Returns true if a dry run has skipped a call that would advance a simulation, so that results may be missing.
    pub fn depends_on_dry_run(&self) -> bool {
        self.pretended.get() > 0
    }

    /// Counts a successful or failed step of a simulation.
    pub fn count_step(&self) {
        self.steps.set(self.steps.get() + 1);
    }

    /// Counts the steps of simulations that ran on other threads.
    pub fn count_steps(&self, steps: usize) {
        self.steps.set(self.steps.get().saturating_add(steps as u64));
    }

    /// Number of simulation steps, including failed steps.
    pub fn steps(&self) -> u64 {
        self.steps.get()
    }

    /// Returns true if another step is allowed; otherwise marks the step limit as exceeded.
    pub fn allows_a_step(&self) -> bool {
        let allowed = self.limits.steps.is_none_or(|limit| self.steps.get() < limit);
        if !allowed {
            self.wants_too_many_steps.set(true);
        }
        allowed
    }

    /// Makes the run stop at its next check.
    pub fn stop(&self, why: Stop) {
        self.stopped.set(self.stopped.get().or(Some(why)));
    }

    /// Counts output [bytes]. Returns false if the limit is exceeded.
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

    /// Size available for rescue files [bytes]: the remainder of the output limit, plus a twentieth of the limit.
    pub fn rescue_budget(&self) -> u64 {
        let left = |limit: u64| (limit + limit / 20).saturating_sub(self.written.get());
        self.limits.written.map_or(u64::MAX, left)
    }

    /// Counts a file and its bytes. Returns false if a limit is exceeded.
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

    /// Resets the counters, and supervises time and memory until the guard is dropped.
    ///
    /// # Errors
    /// Fails if no thread can be started.
    pub fn watch(&self) -> io::Result<Watchdog> {
        self.alarm.store(NO_ALARM, Ordering::Relaxed);
        self.steps.set(0);
        self.wants_too_many_steps.set(false);
        self.written.set(0);
        self.files.set(0);
        // A loss of output is kept, because it must remain an error.
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
        while meter.passed().is_none() && begun.elapsed() < Duration::from_secs(60) {
            thread::sleep(Duration::from_millis(1));
        }
        meter.passed()
    }

    #[test]
    fn time_limit_restarts_with_a_new_watch() {
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
    fn memory_limit_applies_to_the_process() {
        let meter = Meter::new(Limits { memory: Some(1), ..without_limits() });
        let _watchdog = meter.watch().unwrap();
        assert_eq!(wait_for(&meter), Some(Stop::Memory(1)));
    }

    #[test]
    fn steps_up_to_the_limit_are_allowed() {
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
    fn dropped_watchdog_ends_at_once() {
        let limits = Limits { time: Some(Duration::from_secs(3600)), ..without_limits() };
        let meter = Meter::new(limits);
        let begun = Instant::now();
        drop(meter.watch().unwrap());
        assert!(begun.elapsed() < Duration::from_secs(60));
    }

    #[test]
    fn written_and_printed_output_count_towards_one_limit() {
        let meter = Meter::new(Limits { written: Some(10), files: Some(2), ..without_limits() });
        assert!(meter.allows_to_write(6) && meter.allows_a_file(4) && meter.passed().is_none());
        assert!(!meter.allows_to_write(1));
        assert_eq!(meter.passed(), Some(Stop::Written(10)));
        assert_eq!(meter.rescue_budget(), 0);
        let _watchdog = meter.watch().unwrap();
        assert!(meter.allows_a_file(1) && meter.allows_a_file(1) && !meter.allows_a_file(1));
        assert_eq!(meter.passed(), Some(Stop::Files(2)));
        meter.stop(Stop::OutputLost(io::ErrorKind::StorageFull));
        assert_eq!(meter.passed(), Some(Stop::Files(2)), "the first reason holds");
    }

    #[test]
    fn run_that_ignores_a_limit_is_aborted() {
        let (send, ended) = std::sync::mpsc::channel();
        let resort: HardAbort = Arc::new(move |stop| _ = send.send(stop));
        let limit = Duration::from_millis(20);
        let begun = Instant::now();
        let meter = Meter::guarded(Limits { time: Some(limit), ..without_limits() }, Some(resort));
        let _watchdog = meter.watch().unwrap();
        let stop = ended.recv_timeout(Duration::from_secs(60)).unwrap();
        assert_eq!(stop, Stop::Time(limit));
        assert!(begun.elapsed() > limit * 2, "whoever hears of it has some time");
    }
}
