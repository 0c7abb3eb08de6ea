//! Ctrl-C, and being asked to end: the run is to stop after its current step; where nothing hears of it, the program ends.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{process, thread};

use super::Exit;
use super::console::tell;
use super::tui::terminal;
use crate::repl::editor::typed_ahead;
use crate::script::state::limits::INTERRUPT_HEARD;

/// So long has a run to hear of it,
const GRACE: Duration = Duration::from_millis(900);

/// and so long one that has heard to write what ran: that takes a moment where much did.
const TO_WRITE: Duration = Duration::from_secs(20);

/// What is lost when Ctrl-C ends the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterruptLoss {
    /// A run is at stake: what does not hear of Ctrl-C ends soon after, or with the second one.
    Run,
    /// A session with everything that was built in it is at stake: a Ctrl-C ends it that comes a while after the first was not heard.
    Session,
}

/// A flag that Ctrl-C sets.
pub fn flag(at_stake: InterruptLoss) -> Arc<AtomicBool> {
    let patience = match at_stake {
        InterruptLoss::Run => Duration::ZERO,
        InterruptLoss::Session => Duration::from_secs(1),
    };
    let flag = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&flag);
    let mut asked = Instant::now();
    let installed = ctrlc::set_handler(move || {
        if !set.swap(true, Ordering::Relaxed) {
            asked = Instant::now();
            if at_stake == InterruptLoss::Run {
                // Beside this thread, which waits for the second Ctrl-C.
                thread::spawn(|| {
                    thread::sleep(GRACE);
                    if INTERRUPT_HEARD.load(Ordering::Relaxed) {
                        thread::sleep(TO_WRITE);
                    }
                    end();
                });
            }
        } else if asked.elapsed() >= patience {
            end();
        }
    });
    if let Err(error) = installed {
        // Without a handler Ctrl-C ends the process as usual: worth a word, not a failure.
        tell(&format!("warning: Ctrl-C will not save what ran: {error}\n"));
    }
    flag
}

/// Lets a session end within a second when the system asks for it, as when its window is closed: Ctrl-C is for its inputs.
/// To be called before there are other threads.
#[cfg(unix)]
pub fn end_when_asked() {
    use nix::sys::signal::{SigSet, Signal};
    let mut asked = SigSet::empty();
    asked.add(Signal::SIGTERM);
    asked.add(Signal::SIGHUP);
    if asked.thread_block().is_ok() {
        thread::spawn(move || {
            if asked.wait().is_ok() {
                end();
            }
        });
    }
}

#[cfg(not(unix))]
pub fn end_when_asked() {}

fn end() {
    typed_ahead::give_back();
    terminal::give_back();
    process::exit(Exit::Interrupted as i32);
}
