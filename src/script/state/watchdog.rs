//! Thread that supervises time and memory of a run, and ends the program if the run does not react.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::limits::{HardAbort, Limits, TOO_LARGE, TOO_LATE};
use crate::script::messages::stop::Stop;

const INTERVAL: Duration = Duration::from_millis(10);

/// Processor time for which a run may continue after it has exceeded a limit, as a fraction of the time limit.
/// On an idle machine, a run with a time limit of some seconds then ends within twice this limit.
const OVERTIME: f64 = 0.7;
const LEAST_OVERTIME: Duration = Duration::from_millis(700);
const MOST_OVERTIME: Duration = Duration::from_secs(5);
/// Ratio of the largest wall-clock time to the allowed processor time after a limit was exceeded.
const SHARE_OF_PROCESSOR: u32 = 10;

/// Guard of the thread that supervises a run. Dropping the guard ends the thread.
pub struct Watchdog {
    leash: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watchdog {
    pub(super) fn start(
        limits: Limits,
        alarm: Arc<AtomicU8>,
        resort: Option<HardAbort>,
    ) -> io::Result<Self> {
        if limits.time.is_none() && limits.memory.is_none() {
            return Ok(Self { leash: None, thread: None });
        }
        let begun = Instant::now();
        let (leash, held) = channel::<()>();
        let watch = move || {
            let mut passed = None;
            while let Err(RecvTimeoutError::Timeout) = held.recv_timeout(INTERVAL) {
                let (stop, since) = match passed {
                    Some(passed) => passed,
                    None => match first_exceeded(&limits, begun) {
                        Some((stop, word)) => {
                            alarm.store(word, Ordering::Relaxed);
                            *passed.insert((stop, Clocks::now()))
                        }
                        None => continue,
                    },
                };
                let Some(resort) = &resort else { return };
                let grows = limits.memory.is_some_and(|limit| occupied() > limit + limit / 2);
                if grows || since.are_over(next_wait(&limits)) {
                    return resort(stop);
                }
            }
        };
        let thread = thread::Builder::new().name("watchdog".into()).spawn(watch)?;
        Ok(Self { leash: Some(leash), thread: Some(thread) })
    }
}

#[derive(Clone, Copy)]
struct Clocks {
    wall: Instant,
    processor: Option<Duration>,
}

impl Clocks {
    fn now() -> Self {
        Self { wall: Instant::now(), processor: processor_time() }
    }

    /// Returns true if wall-clock and processor time since `self` exceed `time_limit`, or the wall-clock time greatly exceeds it.
    fn are_over(self, time_limit: Duration) -> bool {
        let wall = self.wall.elapsed();
        let had = || match (self.processor, processor_time()) {
            (Some(before), Some(now)) => now.saturating_sub(before) > time_limit,
            _ => true,
        };
        wall > time_limit * SHARE_OF_PROCESSOR || wall > time_limit && had()
    }
}

/// Processor time of all threads of the process; `None` if the system does not report it.
fn processor_time() -> Option<Duration> {
    #[cfg(unix)]
    {
        use nix::sys::resource::{UsageWho, getrusage};
        let used = getrusage(UsageWho::RUSAGE_SELF).ok()?;
        let micros = [used.user_time(), used.system_time()]
            .map(|time| time.tv_sec().unsigned_abs() * 1_000_000 + time.tv_usec().unsigned_abs());
        Some(Duration::from_micros(micros.iter().sum()))
    }
    #[cfg(not(unix))]
    None
}

fn first_exceeded(limits: &Limits, begun: Instant) -> Option<(Stop, u8)> {
    let late = limits.time.filter(|limit| begun.elapsed() > *limit);
    let large = || limits.memory.filter(|limit| occupied() > *limit);
    late.map(|limit| (Stop::Time(limit), TOO_LATE))
        .or_else(|| large().map(|limit| (Stop::Memory(limit), TOO_LARGE)))
}

fn next_wait(limits: &Limits) -> Duration {
    let part = limits.time.map_or(LEAST_OVERTIME, |limit| limit.mul_f64(OVERTIME));
    part.clamp(LEAST_OVERTIME, MOST_OVERTIME)
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.leash = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the thread is ignored.
            let _ = thread.join();
        }
    }
}

/// Resident memory of the process [bytes]; 0 if unknown.
fn occupied() -> u64 {
    memory_stats::memory_stats().map_or(0, |stats| stats.physical_mem as u64)
}
