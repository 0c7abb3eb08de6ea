//! Ctrl-C: it asks the run to stop after its current step; when that does not help, the next one leaves at once.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::Exit;
use crate::repl::editor::typed_ahead;

/// What is lost when Ctrl-C ends the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtStake {
    /// A run: the second Ctrl-C ends it.
    Run,
    /// A session with everything that was built in it: one ends it that comes a while after the first was not heard.
    Session,
}

/// A flag that Ctrl-C sets.
pub fn flag(at_stake: AtStake) -> Arc<AtomicBool> {
    let patience = match at_stake {
        AtStake::Run => Duration::ZERO,
        AtStake::Session => Duration::from_secs(2),
    };
    let flag = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&flag);
    let mut asked = Instant::now();
    let installed = ctrlc::set_handler(move || {
        if !set.swap(true, Ordering::Relaxed) {
            asked = Instant::now();
        } else if asked.elapsed() >= patience {
            typed_ahead::give_back();
            process::exit(Exit::Interrupted as i32);
        }
    });
    if let Err(error) = installed {
        // Without a handler Ctrl-C ends the process as usual: worth a word, not a failure.
        eprintln!("warning: Ctrl-C will not save what ran: {error}");
    }
    flag
}
