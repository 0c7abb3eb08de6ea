//! Handles Ctrl-C and termination signals. Ctrl-C stops a run after its current step; if the run does not react, the program ends.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{process, thread};

use super::Exit;
use super::console::print_error;
use super::tui::terminal;
use crate::repl::terminal::typed_ahead;
use crate::script::state::limits::INTERRUPT_HEARD;

/// Time in which a run must react to Ctrl-C before the program ends.
const REACTION_TIME: Duration = Duration::from_millis(900);

const TO_WRITE: Duration = Duration::from_secs(20);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterruptLoss {
    /// Loss of the results of a run. The program ends at a second Ctrl-C, or if the run does not react to the first in time.
    Run,
    /// Loss of a session with all its data. The program ends only if a Ctrl-C has had no effect for a second and Ctrl-C is pressed again.
    Session,
}

pub fn flag(at_stake: InterruptLoss) -> Arc<AtomicBool> {
    let grace_period = match at_stake {
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
                // A separate thread waits for the run to stop, because the thread of the handler must receive the second Ctrl-C.
                thread::spawn(|| {
                    thread::sleep(REACTION_TIME);
                    if INTERRUPT_HEARD.load(Ordering::Relaxed) {
                        thread::sleep(TO_WRITE);
                    }
                    end();
                });
            }
        } else if asked.elapsed() >= grace_period {
            end();
        }
    });
    if let Err(error) = installed {
        // If no handler can be installed, Ctrl-C ends the program, so a warning about lost results is sufficient.
        print_error(&format!("warning: Ctrl-C ends the program without saving results: {error}\n"));
    }
    flag
}

/// Ends a session on SIGTERM and SIGHUP, for example when its terminal window is closed.
/// SIGTERM and SIGHUP must be blocked before other threads start, because threads inherit the signal mask.
#[cfg(unix)]
pub fn end_on_signal() {
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
pub fn end_on_signal() {}

fn end() {
    typed_ahead::restore();
    terminal::restore();
    process::exit(Exit::Interrupted as i32);
}
