//! Ctrl-C: the first asks the run to stop after its current step, the second leaves at once.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;

/// A flag that Ctrl-C sets.
pub fn flag() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&flag);
    let installed = ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            process::exit(Exit::Interrupted as i32);
        }
    });
    if let Err(error) = installed {
        // Without a handler Ctrl-C ends the process as usual: worth a word, not a failure.
        eprintln!("warning: Ctrl-C will not save what ran: {error}");
    }
    flag
}
