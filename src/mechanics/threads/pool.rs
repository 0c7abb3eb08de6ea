//! Thread pool.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{available_parallelism, yield_now};
use std::time::{Duration, Instant};

use rayon_core::{ThreadPool, ThreadPoolBuilder};

/// Time during which an idle thread polls for new tasks before it sleeps.
/// The tasks of a step follow each other immediately, and waking a thread takes as long as many of these tasks.
const POLLING_TIME: Duration = Duration::from_micros(300);

static HANDED_OUT: AtomicUsize = AtomicUsize::new(0);

/// Pool with one thread for each additional core, created at its first use; `None` for a single core, or if the system provides no threads.
pub(super) fn pool() -> Option<&'static ThreadPool> {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    let start = || {
        let others = available_parallelism().map_or(0, |cores| cores.get() - 1);
        let threads = ThreadPoolBuilder::new().num_threads(others).thread_name(|_| "parts".into());
        (others > 0).then(|| threads.build().ok()).flatten()
    };
    POOL.get_or_init(start).as_ref()
}

pub(super) fn notify_workers() {
    HANDED_OUT.fetch_add(1, Ordering::Release);
}

pub(super) fn keep_polling() {
    let before = HANDED_OUT.load(Ordering::Acquire);
    rayon_core::spawn(move || {
        let begun = Instant::now();
        while HANDED_OUT.load(Ordering::Acquire) == before && begun.elapsed() < POLLING_TIME {
            yield_now();
        }
    });
}
