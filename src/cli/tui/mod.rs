//! `withy learn watch` in a terminal: one screen with task, file, result and hints; key bindings; each attempt in its own process.
//!
//! ```text
//! event_loop → terminal → keys
//!            → judge_process                              one process per run
//!            → screen → result_page, solution → line      lines from the state only
//!            → state                                      effects of keys
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
