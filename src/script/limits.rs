//! What a run may use: time, steps, memory, calls within calls; and what stopped a run before its end.

use std::cell::Cell;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::numbers::format_number;

/// Bytes of a megabyte.
pub const MEGABYTE: u64 = 1_000_000;
/// The default limit of memory, in megabytes.
pub const DEFAULT_MEGABYTES: u64 = 4096;
/// The default limit of calls within calls.
pub const DEFAULT_DEPTH: usize = 400;
/// The most calls within calls that can be allowed: they fit [`STACK_BYTES`](super::runner::STACK_BYTES).
pub const DEEPEST: usize = 1000;

/// How often the watchdog looks.
const INTERVAL: Duration = Duration::from_millis(10);

/// What a run may use. `None` is without limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Time on the clock.
    pub time: Option<Duration>,
    /// Steps of all simulations together, failed tries included.
    pub steps: Option<u64>,
    /// Memory that the whole process really occupies [bytes].
    pub memory: Option<u64>,
    /// Calls of script functions within calls, at most [`DEEPEST`].
    pub depth: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: None,
            steps: None,
            memory: Some(DEFAULT_MEGABYTES * MEGABYTE),
            depth: DEFAULT_DEPTH,
        }
    }
}

/// What stopped a run before its end. Scripts cannot catch it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// Ctrl-C, or whoever else set the interrupt flag.
    Interrupt,
    /// The reader of the output went away.
    PipeClosed,
    /// The run took longer than this.
    Time(Duration),
    /// The simulations wanted more steps than this.
    Steps(u64),
    /// The process occupied more memory than this [bytes].
    Memory(u64),
    /// A dry build pretended to go on with simulations so often that the script must wait for something which only a real one
    /// finds.
    Waiting,
}

impl Stop {
    /// What happened, and what to do about it.
    pub fn words(self) -> (String, Option<String>) {
        match self {
            Self::Interrupt => ("the run was interrupted".into(), None),
            Self::PipeClosed => ("the reader of the output went away".into(), None),
            Self::Time(limit) => (
                format!("the run takes longer than {} s", format_number(limit.as_secs_f64())),
                Some("--max-time SECONDS allows more; is there a loop without an end?".into()),
            ),
            Self::Steps(limit) => (
                format!("the simulations of this run need more than {limit} steps"),
                Some("--max-steps N allows more".into()),
            ),
            Self::Waiting => (
                "the script waits for what a simulation finds: it cannot be checked further".into(),
                None,
            ),
            Self::Memory(limit) => (
                format!("the run needs more than {} MB of memory", limit / MEGABYTE),
                Some("--max-memory MB allows more; does something grow in a loop for ever?".into()),
            ),
        }
    }
}

/// How much of its limits a run has used.
pub struct Meter {
    limits: Limits,
    alarm: Arc<AtomicU8>,
    steps: Cell<u64>,
    wants_too_many_steps: Cell<bool>,
    /// How often a dry build pretended to go on with a simulation.
    pretended: Cell<u64>,
}

/// So often may it do that: a loop that waits for a time is long through by then.
const MOST_PRETENDED: u64 = 100_000;

const QUIET: u8 = 0;
const TOO_LATE: u8 = 1;
const TOO_LARGE: u8 = 2;

impl Meter {
    /// Nothing is used yet.
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            alarm: Arc::default(),
            steps: Cell::new(0),
            wants_too_many_steps: Cell::new(false),
            pretended: Cell::new(0),
        }
    }

    /// What may be used.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Which limit was passed, if one was.
    pub fn passed(&self) -> Option<Stop> {
        match self.alarm.load(Ordering::Relaxed) {
            TOO_LATE => self.limits.time.map(Stop::Time),
            TOO_LARGE => self.limits.memory.map(Stop::Memory),
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

    /// Counts a step, or a try of one.
    pub fn count_step(&self) {
        self.steps.set(self.steps.get() + 1);
    }

    /// Counts the steps of a run that was made elsewhere.
    pub fn count_steps(&self, steps: usize) {
        self.steps.set(self.steps.get().saturating_add(steps as u64));
    }

    /// Whether one more step is allowed; if not, the limit counts as passed.
    pub fn allows_a_step(&self) -> bool {
        let allowed = self.limits.steps.is_none_or(|limit| self.steps.get() < limit);
        if !allowed {
            self.wants_too_many_steps.set(true);
        }
        allowed
    }

    /// Begins to count anew and watches the clock and the memory until the guard is dropped.
    ///
    /// # Errors
    /// When no thread can be started.
    pub fn watch(&self) -> io::Result<Watchdog> {
        self.alarm.store(QUIET, Ordering::Relaxed);
        self.steps.set(0);
        self.wants_too_many_steps.set(false);
        Watchdog::start(self.limits, Arc::clone(&self.alarm))
    }
}

/// A thread that watches the clock and the memory; it ends when this is dropped.
pub struct Watchdog {
    /// The thread ends when this is let go.
    leash: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watchdog {
    fn start(limits: Limits, alarm: Arc<AtomicU8>) -> io::Result<Self> {
        if limits.time.is_none() && limits.memory.is_none() {
            return Ok(Self { leash: None, thread: None });
        }
        let begun = Instant::now();
        let (leash, held) = channel::<()>();
        let watch = move || {
            while let Err(RecvTimeoutError::Timeout) = held.recv_timeout(INTERVAL) {
                if limits.time.is_some_and(|limit| begun.elapsed() > limit) {
                    return alarm.store(TOO_LATE, Ordering::Relaxed);
                }
                if limits.memory.is_some_and(|limit| occupied() > limit) {
                    return alarm.store(TOO_LARGE, Ordering::Relaxed);
                }
            }
        };
        let thread = thread::Builder::new().name("watchdog".into()).spawn(watch)?;
        Ok(Self { leash: Some(leash), thread: Some(thread) })
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.leash = None;
        if let Some(thread) = self.thread.take() {
            // It has nothing to tell, and a panic of it must not become ours.
            let _ = thread.join();
        }
    }
}

/// The memory that the process occupies [bytes]; nothing where the system does not tell.
fn occupied() -> u64 {
    memory_stats::memory_stats().map_or(0, |stats| stats.physical_mem as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn messages_name_the_limit_and_its_flag() {
        let (message, hint) = Stop::Memory(2_000_000).words();
        assert!(message.contains("2 MB") && hint.unwrap().contains("--max-memory"));
    }
}
