//! Stack sizes of the threads of scripts and workers, computed from the limits of the script and the address space.

use std::io::ErrorKind;
use std::sync::Mutex;
use std::thread;

use crate::panics::caught;
use crate::script::diagnose::Diagnostic;
use crate::script::state::limits::Limits;
use crate::simulation::HAS_THREADS;

/// Calls `work` on a thread with a stack for the limits of the script, or on this thread if the system has no threads.
/// The stack is smaller if the address space of the process is limited.
///
/// # Errors
/// Fails if no thread can be started, or if `work` panics.
pub fn on_large_stack<T: Send>(
    limits: &Limits,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Diagnostic> {
    on_stack(script_stack(limits, room()), limits, work)
}

/// Calls `work` on a thread with a stack of `bytes`, or of less if this fails, down to the minimum for nested calls.
/// On a system without threads, `work` runs on this thread.
///
/// # Errors
/// Fails if no thread can be started, or if `work` panics.
pub fn on_stack<T: Send>(
    mut bytes: usize,
    limits: &Limits,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Diagnostic> {
    let least = limits.least_stack();
    let work = Mutex::new(Some(work));
    let take = || work.lock().ok().and_then(|mut work| work.take());
    thread::scope(|scope| {
        let done = loop {
            let thread = thread::Builder::new().name("script".into()).stack_size(bytes);
            match thread.spawn_scoped(scope, || take().map(caught)) {
                Ok(running) => break running.join(),
                Err(error) if error.kind() == ErrorKind::Unsupported => {
                    break Ok(take().map(caught));
                }
                Err(_) if bytes > least => bytes = (bytes / 2).max(least),
                Err(error) => {
                    let message = format!("cannot start a thread for the script: {error}");
                    return Err(Diagnostic::general(message));
                }
            }
        };
        let done = done.map_err(|_| "a thread ended by a panic that was caught");
        let done = done.and_then(|done| done.ok_or("the work of a thread was done twice"));
        done.map_err(Diagnostic::internal_error)?.map_err(Diagnostic::internal_error)
    })
}

/// Number of workers, at most `most`, and stack size of each [bytes]; `None` without threads or with too little address space.
pub fn workers(limits: &Limits, most: usize) -> Option<(usize, usize)> {
    if HAS_THREADS { worker_stacks(limits, most, room()) } else { None }
}

/// Remaining address space of the process [bytes]; `None` if it is not limited.
fn room() -> Option<usize> {
    #[cfg(unix)]
    {
        use nix::sys::resource::{RLIM_INFINITY, Resource, getrlimit};
        let (limit, _) = getrlimit(Resource::RLIMIT_AS).ok()?;
        let taken = memory_stats::memory_stats().map_or(0, |stats| stats.virtual_mem);
        let limit = usize::try_from(limit).ok().filter(|_| limit != RLIM_INFINITY)?;
        Some(limit.saturating_sub(taken))
    }
    #[cfg(not(unix))]
    None
}

/// Stack size of a script [bytes], at most a quarter of a limited address space unless the call depth requires more.
fn script_stack(limits: &Limits, room: Option<usize>) -> usize {
    let whole = limits.stack();
    match room.filter(|room| *room < whole.saturating_add(limits.address_space())) {
        None => whole,
        Some(room) => whole.min((room / 4).max(limits.least_stack())),
    }
}

/// Number of workers and stack size of each worker [bytes], together at most half of a limited address space.
fn worker_stacks(limits: &Limits, most: usize, room: Option<usize>) -> Option<(usize, usize)> {
    let (whole, least) = (limits.stack(), limits.least_stack());
    let needed = whole.saturating_mul(most).saturating_add(limits.address_space());
    match room.filter(|room| *room < needed) {
        None => Some((most, whole)),
        Some(room) => {
            let count = (room / 2 / least).min(most);
            (count > 0).then(|| (count, whole.min(room / 2 / count)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stacks_use_at_most_half_of_a_limited_address_space() {
        let limits = Limits::default();
        let whole = limits.stack();
        assert_eq!(script_stack(&limits, None), whole);
        assert_eq!(worker_stacks(&limits, 8, None), Some((8, whole)));
        assert_eq!(script_stack(&limits, Some(1 << 40)), whole);
        for room in [1 << 28, 1 << 29, 1 << 30, 1 << 31, 1 << 32, 1 << 33] {
            let own = script_stack(&limits, Some(room));
            assert!(own <= room / 2 && own >= limits.least_stack(), "{room}: {own}");
            let left = room - own;
            for most in [1, 2, 64] {
                let Some((count, bytes)) = worker_stacks(&limits, most, Some(left)) else {
                    assert!(left / 2 < limits.least_stack());
                    continue;
                };
                assert!((1..=most).contains(&count) && bytes >= limits.least_stack());
                assert!(count * bytes <= left / 2, "{room}: {count} of {bytes}");
            }
        }
    }
}
