//! A thread with a stack that a script within its limits cannot exhaust.

use std::sync::Mutex;
use std::thread;

use crate::panics::caught;
use crate::script::diagnose::Diagnostic;
use crate::script::state::limits::{LEAST_STACK, Limits};

/// Runs `work` on a thread with a stack that a script within these limits cannot exhaust, or a smaller one if the address space is not
/// available.
///
/// # Errors
/// If no thread can be started, or the work panics.
pub fn on_large_stack<T: Send>(
    limits: &Limits,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Diagnostic> {
    let mut bytes = limits.stack();
    let work = Mutex::new(Some(work));
    let take = || work.lock().ok().and_then(|mut work| work.take());
    thread::scope(|scope| {
        let running = loop {
            let thread = thread::Builder::new().name("script".into()).stack_size(bytes);
            match thread.spawn_scoped(scope, || take().map(caught)) {
                Ok(running) => break running,
                Err(_) if bytes > LEAST_STACK => bytes = (bytes / 2).max(LEAST_STACK),
                Err(error) => {
                    let told = format!("cannot start a thread for the script: {error}");
                    return Err(Diagnostic::general(told));
                }
            }
        };
        let done = running.join().map_err(|_| "a thread ended by a panic that was caught");
        let done = done.and_then(|done| done.ok_or("the work of a thread was done twice"));
        done.map_err(Diagnostic::bug)?.map_err(Diagnostic::bug)
    })
}
