//! The threads that stand ready.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{available_parallelism, yield_now};
use std::time::{Duration, Instant};

use rayon_core::{ThreadPool, ThreadPoolBuilder};

/// So long a thread that has done its part looks for the next one before it falls asleep: the parts of a step follow each other at once, and waking a thread
/// takes as long as many of them.
const AWAKE: Duration = Duration::from_micros(300);

/// How often parts were handed out.
static HANDED_OUT: AtomicUsize = AtomicUsize::new(0);

/// The threads beside the one that works on a scene, one for each further core, from the first time on that any are asked for; none where there is
/// one core, or the system gives none.
pub(super) fn pool() -> Option<&'static ThreadPool> {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    let start = || {
        let others = available_parallelism().map_or(0, |cores| cores.get() - 1);
        let threads = ThreadPoolBuilder::new().num_threads(others).thread_name(|_| "parts".into());
        (others > 0).then(|| threads.build().ok()).flatten()
    };
    POOL.get_or_init(start).as_ref()
}

/// Tells threads that are awake that there are new parts.
pub(super) fn announce_parts() {
    HANDED_OUT.fetch_add(1, Ordering::Release);
}

/// Lets this thread of the pool, once it has ended what it does, look for new parts for a while.
pub(super) fn stay_awake() {
    let before = HANDED_OUT.load(Ordering::Acquire);
    rayon_core::spawn(move || {
        let begun = Instant::now();
        while HANDED_OUT.load(Ordering::Acquire) == before && begun.elapsed() < AWAKE {
            yield_now();
        }
    });
}
