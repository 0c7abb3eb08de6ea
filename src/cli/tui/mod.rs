//! `withy learn watch` in a terminal. One screen shows the task, the file, the result and the hints, and the user presses keys.
//! Each attempt runs in a separate process.
//!
//! ```text
//! event_loop → terminal → keys
//!            → judge_process                              starts one process per run
//!            → screen → result_page, solution → line      converts the state to lines
//!            → state                                      changes the state after a key
//! ```

mod event_loop;
pub(super) mod judge_process;
mod keys;
mod line;
mod result_page;
mod screen;
mod solution;
mod state;
pub(super) mod terminal;

pub(super) use event_loop::watch;
pub(super) use solution::ScriptPainter;
